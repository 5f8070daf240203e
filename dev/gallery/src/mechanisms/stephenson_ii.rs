use linkage::linkage;

linkage! {
    /// Stephenson's six-bar chain on a link of its dyad (Stephenson II): the ternary crank holds the ternary link `C D
    /// E` by two couplers, and a rocker holds it to the ground. No loop has two unknowns only: four angles are solved
    /// together.
    ///
    /// Names of the inversions as in J. M. McCarthy and G. S. Soh, "Geometric Design of Linkages". The dimensions
    /// are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism StephensonII {
        param a = 1, bx = 0.5, by = -1, p = 4, q = 4.25, cd = 1.5, ex = 2, ey = 2, r = 2.5, gx = 5, gy = -2;
        input theta;
        unknown alpha, beta, tau, rho;

        let first = a@theta + p@alpha;
        loop first + cd@tau = (bx, by)@theta + q@beta;
        loop first + (ex, ey)@tau = (gx, gy) + r@rho;

        point O = (0, 0);
        point G = (gx, gy);
        point A = a@theta;
        point B = (bx, by)@theta;
        point C = first;
        point D = B + q@beta;
        point E = G + r@rho;
        output turn = tau - theta;

        derive lanes, intervals;
    }
}
