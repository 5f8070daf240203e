use linkage::linkage;

linkage! {
    /// The dyad RPR of the lecture notes (1.3): `z1 - z2 - z3 + z_t = 0` with phi1, phi2, phi3 turning as one.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Rpr {
        param z1 = 0.4, z3 = 0.3, alpha = 90deg, beta = 0.2;
        input xa, ya, xb, yb;
        unknown phi1, z2;

        loop z1@phi1 - z2@(phi1 + alpha) - z3@(phi1 + beta) + (xa - xb, ya - yb) = (0, 0);

        point Slide = (xa, ya) + z1@phi1;
        output reach = norm((xa - xb, ya - yb));
        derive intervals;
    }
}
