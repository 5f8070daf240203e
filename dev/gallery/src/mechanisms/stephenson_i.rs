use linkage::linkage;

linkage! {
    /// Stephenson's six-bar chain on a binary link of its four-bar loop (Stephenson I): crank and rocker of a
    /// four-bar are both ternary, and a dyad joins their other arms.
    ///
    /// Names of the inversions as in J. M. McCarthy and G. S. Soh, "Geometric Design of Linkages". The dimensions
    /// are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism StephensonI {
        param a = 2, b = 7, c = 6, d = 8, px = 1, py = -2, qx = 3, qy = -4, e = 7, f = 6;
        input theta2;
        unknown theta3, theta4, theta5, theta6;

        loop a@theta2 + b@theta3 = d@0 + c@theta4;
        loop (px, py)@theta2 + e@theta5 = d@0 + (qx, qy)@theta4 + f@theta6;

        point A = (0, 0);
        point D = (d, 0);
        point B = a@theta2;
        point C = B + b@theta3;
        point P = (px, py)@theta2;
        point Q = D + (qx, qy)@theta4;
        point R = P + e@theta5;
        output mu = theta5 - theta6;
        derive intervals;
    }
}
