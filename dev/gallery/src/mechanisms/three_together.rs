use linkage::linkage;

linkage! {
    /// Three unknowns that depend on one another.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism ThreeTogether {
        param a = 2, b = 3, c = 0.4, d = 0.3, h = 1;
        input v;
        unknown phi, psi, x;

        loop a@phi + b@psi = (x + v, h);
        point Slider = (x, h);
        output travel = x;
        equation x = c * psi + d * sin(phi);
    }
}
