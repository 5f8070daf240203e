use linkage::linkage;

linkage! {
    /// The Geneva drive while its pin is in a slot: the crank's pin moves along the slot of a wheel, which it enters
    /// and leaves perpendicular to its own path. Engaged from theta = -(90deg - 180deg/slots) to the opposite.
    ///
    /// From the watchmakers' stop work that gave it its name, the Maltese cross; analysis in J. H. Bickford,
    /// "Mechanisms for Intermittent Motion" (1972). The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Geneva {
        param crank = 1, slots = 4;
        input theta;
        unknown psi, s;

        let base = crank / sin(pi / slots);
        loop crank@theta = base@0 + s@(psi + 180deg);

        point O = (0, 0);
        point Wheel = (base, 0);
        point Pin = crank@theta;
        /// The slot's mouth, where pin and slot meet.
        point Mouth = Wheel + (crank / tan(pi / slots))@(psi + 180deg);
        output depth = crank / tan(pi / slots) - s;

        derive lanes, intervals;
    }
}
