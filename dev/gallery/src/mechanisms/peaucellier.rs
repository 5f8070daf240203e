use linkage::linkage;

linkage! {
    /// The Peaucellier-Lipkin cell: the rhombus inverts the circle of `P` through `O` into a straight line of `Q`,
    /// x = (long^2 - short^2) / (2 crank). Three dyads RRR.
    ///
    /// C.-N. Peaucellier's letter in Nouvelles Annales de Mathématiques, 2nd series, volume 3 (1864), which states
    /// that it can be done, and his note in volume 12 (1873), which shows how; L. I. Lipkin found it independently
    /// and published in 1871. The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Peaucellier {
        param crank = 1.6, long = 5, short = 3;
        input theta;
        unknown upper, upper_side, lower, lower_side, upper_tip, lower_tip;

        let inner = crank@0 + crank@theta;
        loop long@upper = inner + short@upper_side;
        loop long@lower = inner + short@lower_side;
        loop long@upper + short@upper_tip = long@lower + short@lower_tip;

        point O = (0, 0);
        point Centre = (crank, 0);
        point P = inner;
        point Upper = long@upper;
        point Lower = long@lower;
        point Q = Upper + short@upper_tip;
        output product = norm(P) * norm(Q);
        derive intervals;
    }
}
