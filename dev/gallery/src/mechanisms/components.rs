use linkage::linkage;

linkage! {
    /// The four-bar of the Maple sheet, its loop written by component as `vincoloX` and `vincoloY`.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Components {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;

        equation l2 * cos(theta2) + l3 * cos(theta3) + l4 * cos(theta4) - l1 = 0;
        equation l2 * sin(theta2) + l3 * sin(theta3) + l4 * sin(theta4) = 0;

        point C = (l1, 0) - l4@theta4;
        output mu = theta3 - theta4;

        derive jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
