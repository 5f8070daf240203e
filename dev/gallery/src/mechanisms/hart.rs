use linkage::linkage;

linkage! {
    /// Hart's inversor: a crossed parallelogram `A B C D`, on a line across which `O`, `P` and `Q` stay in line with
    /// OP OQ = part (1 - part) (long^2 - short^2); two links fewer than Peaucellier's, for the same straight line of
    /// `Q`. Two dyads RRR.
    ///
    /// H. Hart, "On certain conversions of motion", Messenger of Mathematics 4 (1875). The dimensions are this
    /// gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Hart {
        param crank = 0.8, long = 5, short = 3, part = 0.5;
        input theta;
        unknown alpha, beta, gamma, delta;

        let inner = crank@0 + crank@theta;
        loop (part * short)@beta = inner + (part * long)@alpha;
        let a = -(part * long)@alpha;
        let b = a + long@alpha;
        loop b + short@gamma = a + short@beta + long@delta;

        point O = (0, 0);
        point Centre = (crank, 0);
        point P = inner;
        point A = a;
        point B = b;
        point C = b + short@gamma;
        point D = a + short@beta;
        point Q = b + ((1 - part) * short)@gamma;
        output product = dot(P, Q);
        derive intervals;
    }
}
