use linkage::linkage;

linkage! {
    /// Five-bar whose second crank is geared to the first: three equations, one of them between angles.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism GearedFiveBar {
        param a = 1, b = 2.5, c = 2.2, d = 0.8, e = 2, ratio = -2, phase = 40deg;
        input theta1;
        unknown theta2, theta3, theta4;

        loop a@theta1 + b@theta2 = e@0 + d@theta4 + c@theta3;
        /// The gear train.
        equation theta4 = ratio * theta1 + phase;

        point P = a@theta1 + b@theta2;
        output slip = theta4 / theta1;

        derive lanes, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
