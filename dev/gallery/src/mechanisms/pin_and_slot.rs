use linkage::linkage;

linkage! {
    /// A pin on one wheel drives a slot in another wheel about an axis nearby; the second wheel drives a pointer, and
    /// a third wheel in two steps.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism PinAndSlot {
        param pin = 9.6, ecc = 1.1;
        input month;
        unknown slot, s, out, big, small;

        loop pin@month = ecc@0 + s@slot;
        equation 2 * out = -slot;
        equation big = 2 * slot;
        equation 4 * small = big;

        point Pointer = 10@out;
        point Small = 3@small;
        output lag = small - month;
        derive intervals;
    }
}
