use linkage::linkage;

linkage! {
    /// Two loops in a row: a four-bar whose rocker carries a second dyad, offset by `delta`.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism SixBar {
        param a = 2, b = 7, c = 6, d = 8, e = 4, f = 5, g = 5, h = 14, delta = 30deg;
        input theta1;
        unknown theta2, theta3, theta4, theta5;

        loop a@theta1 + b@theta2 = d@0 + c@theta3;
        loop d@0 + e@(theta3 - delta) + f@theta4 = h@0 + g@theta5;

        point P = d@0 + e@(theta3 - delta);
        point Q = P + f@theta4;
        output swing = theta5 - theta3;
        derive intervals;
    }
}
