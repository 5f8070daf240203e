use linkage::linkage;

linkage! {
    /// The pin of a crank in the slot of a lever, which is shorter than the way of the pin along it: the crank turns from one
    /// end of the slot to the other.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism SlottedLever {
        param crank = 2, frame = 3, inner = 1.5, slot = 3;
        input theta;
        unknown phi, s in inner..inner + slot;

        loop crank@theta = frame@0 + s@phi;

        point Pin = crank@theta;
        output rest = inner + slot - s;
        derive limits, intervals;
    }
}
