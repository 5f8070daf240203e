use linkage::linkage;

linkage! {
    /// Dyads whose slider is named before their angle, and whose second link is named first: a determinant has the
    /// sign of the order of its columns.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism SliderNamedFirst {
        param r = 1, l = 3, k = 0.2, a = 2, d = 1.5, b = 2.2, c = 2.6, e = 0.4;
        input p;
        unknown s, phi, reach, swing, outer, inner;

        loop r@p + l@phi = s@k;
        loop a@p = d@0 + reach@swing + e@(swing + 1);
        loop b@inner + c@(outer + inner) = (3, 0.5) + (r/2)@p;

        point A = s@k;
        point B = d@0 + reach@swing;
        output width = y(B);
        derive intervals;
    }
}
