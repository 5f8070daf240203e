use linkage::linkage;

linkage! {
    /// Three unknowns that depend on one another, none of them with a number as its factor.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism ThreeTogether {
        param a = 2, b = 3, c = 0.4, d = 0.3, h = 1, k = 1;
        input v;
        unknown phi, psi, x;

        loop a@phi + b@psi = (k*x + v, h);
        point Slider = (x, h);
        output travel = x;
        equation k * x = c * psi + d * sin(phi);
        derive intervals;
    }
}
