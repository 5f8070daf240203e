use linkage::linkage;

linkage! {
    /// A crank whose coupler slides through a swivel, and moves a rocker through a rod. With the crank driven, two dyads
    /// follow one another; with the rocker driven, three angles are solved together with the length on the coupler, along
    /// a line that turns.
    ///
    /// The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism SwivelTriad {
        param a = 2, d = 6, h = 0.5, px = 5, py = 4, e = 9, f = 5, fx = 12, fy = 3;
        coordinate crank, coupler, reach, rod, swing;

        loop a@crank + (reach, h)@coupler = d@0;
        loop a@crank + (px, py)@coupler + e@rod = (fx, fy) + f@swing;

        drive SwivelTriadNear by crank;
        drive SwivelTriadFar by swing;

        point A = (0, 0);
        point D = (d, 0);
        point F = (fx, fy);
        point B = a@crank;
        point P = B + (px, py)@coupler;
        point Q = F + f@swing;
        output free = reach;
    }
}
