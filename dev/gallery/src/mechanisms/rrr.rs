use linkage::linkage;

linkage! {
    /// The dyad RRR of the lecture notes (1.3) between two moving points A and B: `z_t - z2 + z1 = 0`.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Rrr {
        param z1 = 2, z2 = 1.5;
        input xa, ya, xb, yb;
        unknown phi1, phi2;

        loop (xb - xa, yb - ya) - z2@phi2 + z1@phi1 = 0;

        point Elbow = (xa, ya) - z1@phi1;
        output elbow = phi1 - phi2;
        derive intervals;
    }
}
