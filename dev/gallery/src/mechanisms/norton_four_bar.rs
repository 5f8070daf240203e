use linkage::linkage;

linkage! {
    /// Four-bar linkage in the layout and letters of R. L. Norton, "Design of Machinery", chapter 4: the crank
    /// `a`, the coupler `b`, the rocker `c` and the ground `d`, with everything that `derive` offers.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism NortonFourBar {
        param a = 40, b = 120, c = 80, d = 100;
        input theta2;
        unknown theta3, theta4;

        loop a@theta2 + b@theta3 = c@theta4 + d@0;

        point P = a@theta2 + (b/2, 30)@theta3;
        output mu = theta4 - theta3;

        derive lanes, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
