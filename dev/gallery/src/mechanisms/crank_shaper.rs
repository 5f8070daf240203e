use linkage::linkage;

linkage! {
    /// Crank and slotted lever of the shaping machine: the crank is shorter than the distance of the pivots, so that
    /// the slotted lever swings; the ram runs above.
    ///
    /// A textbook mechanism (R. Willis, "Principles of Mechanism", 1841, describes the slotted lever), whose inventor
    /// is not known for certain. The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism CrankShaper {
        param crank = 50, offset = 120, lever = 300, rod = 100, height = 166;
        input theta;
        unknown psi, s, phi, x;

        let pivot = (0, -offset);
        loop crank@theta = pivot + s@psi;
        loop pivot + lever@psi + rod@phi = (x, height);

        point O = (0, 0);
        point C = pivot;
        point Pin = crank@theta;
        /// The lever's upper end.
        point E = pivot + lever@psi;
        point Ram = (x, height);
        output swing = psi - 90deg;

        derive lanes, intervals;
    }
}
