use linkage::linkage;

linkage! {
    /// Two groups without a formula in a row, in other coordinates than the angles of links: joint angles measured from
    /// the link before, and an angle that turns clockwise. A dyad comes before them.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism TwoTriads {
        param a = 2, b = 5, c = 4, d = 6, e = 3, f = 7, px = 3, py = 2, r = 1.5;
        input v;
        unknown psi, chi, u1, u2, u3, u4, w1, w2, w3, w4;

        loop a@v + b@psi = d@0 + c@chi;
        loop (1, -5) + r@psi + b@u1 + c@(u1 + u2) = d@0 + c@(-u3);
        loop (1, -5) + r@psi + b@u1 + (px, py)@(u1 + u2) + e@u4 = (6, 3) + f@chi;
        loop (-4, 2) + r@u1 + b@w1 + c@w2 = d@w3;
        loop (-4, 2) + r@u1 + b@w1 + (px, py)@w2 + e@(w4 + v) = (-6, 3) + f@-u3;

        point First = (1, -5) + r@psi + b@u1;
        point Second = (-4, 2) + r@u1 + b@w1;
        output turn = w2;
    }
}
