use linkage::linkage;

linkage! {
    /// Watt's six-bar chain with a ternary link as the ground (Watt II): two four-bars in series, the rocker of the
    /// first, with a second arm at the angle `delta`, being the crank of the second.
    ///
    /// Names of the inversions as in J. M. McCarthy and G. S. Soh, "Geometric Design of Linkages". The dimensions
    /// are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism WattII {
        param a = 2, b = 7, c = 6, d = 8, e = 4, delta = 30deg, f = 6, g = 5, fx = 15, fy = -1;
        input theta2;
        unknown theta3, theta4, theta5, theta6;

        loop a@theta2 + b@theta3 = d@0 + c@theta4;
        loop d@0 + e@(theta4 - delta) + f@theta5 = (fx, fy) + g@theta6;

        point A = (0, 0);
        point D = (d, 0);
        point F = (fx, fy);
        point B = a@theta2;
        point C = B + b@theta3;
        point P = D + e@(theta4 - delta);
        point Q = P + f@theta5;
        output swing = theta6 - theta4;
        derive intervals;
    }
}
