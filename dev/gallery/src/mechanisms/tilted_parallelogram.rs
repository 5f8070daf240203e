use linkage::linkage;

linkage! {
    /// A parallelogram whose frame is tilted: its links are in line at 5 and at 185 degrees, where an antiparallelogram crosses
    /// its motion.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism TiltedParallelogram {
        param a = 2, b = 5, tilt = 5deg;
        input theta;
        unknown phi, psi;

        loop a@theta + b@phi = b@tilt + a@psi;

        point Middle = a@theta + (b/2)@phi;
        output lag = theta - psi;
        derive drawing, intervals;
    }
}
