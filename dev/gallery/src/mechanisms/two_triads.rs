use linkage::linkage;

linkage! {
    /// Two groups without a formula in a row, in other coordinates than the angles of links: joint angles measured from
    /// the link before, and an angle that turns clockwise. A dyad comes before them.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism TwoTriads {
        param a = 2, b = 5, c = 4, d = 6, e = 3, f = 7, px = 3, py = 2, r = 1.5, x1 = -4.7, y1 = 3.6, x2 = 12.2, y2 = -2.4,
            x3 = -8.7, y3 = -3.4, x4 = 7.6, y4 = 3.2;
        input v;
        unknown psi, chi, u1, u2, u3, u4, w1, w2, w3, w4;

        loop a@v + b@psi = d@0 + c@chi;
        loop (x1, y1) + r@psi + b@u1 + c@(u1 + u2) = d@0 + c@(-u3);
        loop r@psi + b@u1 + (px, py)@(u1 + u2) + e@u4 = (x2, y2) + f@chi;
        loop (x3, y3) + r@u1 + b@w1 + c@w2 = d@w3;
        loop r@u1 + b@w1 + (px, py)@w2 + e@(w4 + v) = (x4, y4) + f@(-u3);

        point First = r@psi + b@u1;
        point Second = r@u1 + b@w1;
        output turn = w2;
        derive intervals;
    }
}
