use linkage::linkage;

linkage! {
    /// Whitworth's quick return: the crank is longer than the distance of the pivots, so that the slotted arm turns
    /// all the way round, and drives a ram whose line passes through the arm's pivot.
    ///
    /// Joseph Whitworth, British patent 12907 of 19 December 1849, first on a slotting machine (E. S. Ferguson,
    /// "Kinematics of Mechanisms from the Time of Watt", 1962). The dimensions are this gallery's, with
    /// offset : crank = 3 : 5.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Whitworth {
        param crank = 50, offset = 30, arm = 60, rod = 200;
        input theta;
        unknown psi, s, phi, x;

        let pivot = (0, -offset);
        loop crank@theta = pivot + s@psi;
        loop pivot + arm@(psi + 180deg) + rod@phi = (x, -offset);

        point O = (0, 0);
        point C = pivot;
        point Pin = crank@theta;
        /// The arm's other end.
        point E = pivot + arm@(psi + 180deg);
        point Ram = (x, -offset);
        output stroke = x - (rod - arm);
        derive intervals;
    }
}
