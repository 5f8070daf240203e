use linkage::linkage;

linkage! {
    /// The second leg of Joe Klann's walking machine, the mirror image of `klann` in the vertical through the crank's axis, on
    /// the same crank: at theta its foot is the image of the first leg's foot at 180deg - theta.
    ///
    /// J. C. Klann, "Walking device", United States patent 6,260,862 (2001), table 1.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism KlannMirrored {
        param crank_x = 1.599, crank_y = 0.750, lower_x = 2.189, lower_y = 0.574, upper_x = 1.832, upper_y = 1.366,
            crank = 0.268, lower = 0.3206, upper = 0.5177,
            pin_elbow = 0.590, elbow_knee = 0.5221, elbow_bend = 12.9deg,
            knee_hip = 0.8966, knee_foot = 0.8966, knee_bend = 150deg;
        input theta;
        unknown arm, lower_angle, leg, upper_angle;
        derive jerk, velocity_ratio_derivatives, sensitivity, intervals;

        let pin = (crank_x, crank_y) + crank@theta;
        let elbow = pin + pin_elbow@arm;
        let knee = elbow + elbow_knee@(arm + elbow_bend);

        loop elbow = (lower_x, lower_y) + lower@lower_angle;
        loop knee + knee_hip@leg = (upper_x, upper_y) + upper@upper_angle;

        point Pin = pin;
        point Elbow = elbow;
        point Knee = knee;
        point Hip = knee + knee_hip@leg;
        point Foot = knee + knee_foot@(leg + knee_bend);
        output height = y(Foot);
    }
}
