use linkage::linkage;

linkage! {
    /// Stephenson's six-bar chain on a ternary link (Stephenson III): a four-bar whose coupler point is held by a
    /// dyad to a third pivot, as wherever a coupler curve is used for a dwell.
    ///
    /// Names of the inversions as in J. M. McCarthy and G. S. Soh, "Geometric Design of Linkages". The dimensions
    /// are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism StephensonIII {
        param a = 2, b = 7, c = 6, d = 8, px = 5, py = 4, e = 9, f = 5, fx = 12, fy = 3;
        input theta2;
        unknown theta3, theta4, theta5, theta6;

        loop a@theta2 + b@theta3 = d@0 + c@theta4;
        loop a@theta2 + (px, py)@theta3 + e@theta5 = (fx, fy) + f@theta6;

        point A = (0, 0);
        point D = (d, 0);
        point F = (fx, fy);
        point B = a@theta2;
        point C = D + c@theta4;
        point P = B + (px, py)@theta3;
        point Q = P + e@theta5;
        output swing = theta6;
        derive intervals;
    }
}
