use linkage::linkage;

linkage! {
    /// Points and outputs at whole multiples, sums and differences of solved angles.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Multiples {
        param l1 = 8, l2 = 2, l3 = 5, l4 = 7;
        input v;
        unknown u, w;

        loop l2@v + l3@u = l1@0 + l4@w;

        point Difference = 3@(u - w);
        point Opposite = 2@(-w);
        point Twice = 2@(2*u);
        point Thrice = (1, 2)@(-3*w + v);
        point Both = 2@(-4*u + 2*w - v);
        point Fifth = 1@(5*u - 6*w);
        output difference = sin(u - w);
        output opposite = cos(1 - w) + sin(-2*u);
        derive intervals;
    }
}
