use linkage::linkage;

linkage! {
    /// The centred slider-crank of the lecture notes (1.2): z1 + z2 + z3 = 0, the slider's `z3` against the x axis.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism SliderCrank {
        param z1 = 1, z2 = 3;
        coordinate z3, phi1, phi2;

        loop z1@phi1 + z2@phi2 + z3@180deg = 0;

        /// The slider moves, the crank is driven.
        drive Engine by z3;
        /// The crank moves, the slider is driven.
        drive Compressor by phi1;

        point Pin = z1@phi1;
        output stroke = z3 - (z2 - z1);
        derive intervals;
    }
}
