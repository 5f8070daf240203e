use linkage::linkage;

linkage! {
    /// Pantograph: the pen repeats what the tracer draws, `ratio` times as large. The tracer's position is the
    /// input; the arms are a dyad, and the parallelogram on them another.
    ///
    /// Christoph Scheiner, "Pantographice seu ars delineandi" (Rome, 1631), invented 1603. The dimensions are this
    /// gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Pantograph {
        param a = 3, b = 4, ratio = 2.5;
        input x, y;
        unknown alpha, beta, gamma, delta;

        let tracer = a@alpha + b@beta;
        loop tracer = (x, y);
        let knee = (ratio * a)@alpha;
        loop tracer + ((ratio - 1) * a)@gamma = knee + b@delta;

        point O = (0, 0);
        point A = a@alpha;
        point Tracer = (x, y);
        point Knee = knee;
        point B = knee + b@delta;
        point Pen = knee + (ratio * b)@delta;
        output opening = beta - alpha;
        derive intervals;
    }
}
