use linkage::linkage;

linkage! {
    /// Five-bar with both cranks driven.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism FiveBar {
        param a = 1, b = 2.5, c = 2.2, d = 0.8, e = 2;
        input theta1, theta4;
        unknown theta2, theta3;

        loop a@theta1 + b@theta2 = e@0 + d@theta4 + c@theta3;

        point P = a@theta1 + b@theta2;
        point Pen = P + (0.3, -0.2)@theta2;
        output reach = norm(P);

        derive lanes, limits, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
