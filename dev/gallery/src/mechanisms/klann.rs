use linkage::linkage;

linkage! {
    /// A leg of Joe Klann's walking machine: crank, connecting arm bent at the elbow, leg bent at the knee, and two
    /// rockers.
    ///
    /// J. C. Klann, "Walking device", United States patent 6,260,862 (2001), table 1. The table gives the bent links
    /// by their sides; the bends here give its third sides, 29-35 = 1.1051 and 33-37 = 1.732, to their digits. Its
    /// reference pose closes to three digits.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Klann {
        param crank_x = 1.599, crank_y = 0.750, lower_x = 1.009, lower_y = 0.574, upper_x = 1.366, upper_y = 1.366,
            crank = 0.268, lower = 0.3206, upper = 0.5177,
            pin_elbow = 0.590, elbow_knee = 0.5221, elbow_bend = -12.9deg,
            knee_hip = 0.8966, knee_foot = 0.8966, knee_bend = -150deg;
        input theta;
        unknown arm, lower_angle, leg, upper_angle;

        let pin = (crank_x, crank_y) + crank@theta;
        let elbow = pin + pin_elbow@arm;
        let knee = elbow + elbow_knee@(arm + elbow_bend);

        loop elbow = (lower_x, lower_y) + lower@lower_angle;
        loop knee + knee_hip@leg = (upper_x, upper_y) + upper@upper_angle;

        point O = (crank_x, crank_y);
        point Lower = (lower_x, lower_y);
        point Upper = (upper_x, upper_y);
        point Pin = pin;
        point Elbow = Lower + lower@lower_angle;
        point Knee = knee;
        point Hip = Upper + upper@upper_angle;
        point Foot = knee + knee_foot@(leg + knee_bend);
        output height = y(Foot);

        derive lanes, intervals;
    }
}
