use linkage::linkage;

linkage! {
    /// The introductory mechanism of the lecture notes (1.1.1): a crank `z1` and a slider on an arm of
    /// variable length `z2`, with `z3` fixed to the arm at the angle `delta`.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Introductory {
        param z1 = 1, z3 = 0.5, z4 = 3, delta = 60deg;
        input phi1;
        unknown phi2, z2;

        loop z1@phi1 + z2@phi2 + z3@(phi2 - delta) = z4@0;

        point P = z1@phi1 + z2@phi2;
        output slope = tan(phi2 / 4);
        derive intervals;
    }
}
