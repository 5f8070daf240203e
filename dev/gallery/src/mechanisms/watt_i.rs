use linkage::linkage;

linkage! {
    /// Watt's six-bar chain with a binary link as the ground (Watt I): a four-bar whose coupler and rocker are both
    /// ternary, and a dyad between them.
    ///
    /// Names of the inversions as in J. M. McCarthy and G. S. Soh, "Geometric Design of Linkages". The dimensions
    /// are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism WattI {
        param a = 2, b = 7, c = 6, d = 8, px = 4, py = 4, qx = 8, qy = -2, e = 6, f = 7;
        input theta2;
        unknown theta3, theta4, theta5, theta6;

        loop a@theta2 + b@theta3 = d@0 + c@theta4;
        let coupler_pin = a@theta2 + (px, py)@theta3;
        let rocker_pin = d@0 + (qx, qy)@theta4;
        loop coupler_pin + e@theta5 = rocker_pin + f@theta6;

        point A = (0, 0);
        point D = (d, 0);
        point B = a@theta2;
        point C = D + c@theta4;
        point P = coupler_pin;
        point Q = rocker_pin;
        /// The pin of the dyad: it floats, two links away from the ground.
        point R = P + e@theta5;
        output mu = theta5 - theta6;
        derive intervals;
    }
}
