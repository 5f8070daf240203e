use linkage::linkage;

linkage! {
    /// A crank whose coupler slides through a swivel, and moves a rocker through a rod. With the crank driven, two dyads
    /// follow one another; with the rocker driven, three angles are solved together with the length on the coupler, along
    /// a line that turns.
    ///
    /// The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism SwivelTriad {
        param a = 4, d = 4.5, h = 0.5, px = 4.5, py = 2.5, e = 8.5, f = 3.5, fx = -0.5, fy = 6;
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
        derive intervals;
    }
}
