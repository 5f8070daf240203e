use linkage::linkage;

linkage! {
    /// Stephenson's six-bar chain on a ternary link, driven from the link of the third pivot: no four-bar loop is at the
    /// input, and four angles are solved together, with up to 6 positions. A dyad follows.
    ///
    /// The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism StephensonFar {
        param a = 2, b = 7, c = 6, d = 8, px = 5, py = 4, e = 9, f = 5, fx = 12, fy = 3, g = 6, h = 7;
        input swing;
        unknown crank, coupler, rocker, rod, link, arm;

        loop a@crank + b@coupler = d@0 + c@rocker;
        loop a@crank + (px, py)@coupler + e@rod = (fx, fy) + f@swing;
        loop d@0 + c@rocker + g@link = (fx, fy) + h@arm;

        point A = (0, 0);
        point D = (d, 0);
        point F = (fx, fy);
        point B = a@crank;
        point C = D + c@rocker;
        point P = B + (px, py)@coupler;
        point Q = P + e@rod;
        point R = C + g@link;
        output drive = crank;
        derive intervals;
    }
}
