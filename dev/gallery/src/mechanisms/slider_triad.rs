use linkage::linkage;

linkage! {
    /// A crank with a slider, whose coupler moves a rocker through a rod. With the crank driven, two dyads follow one
    /// another; with the rocker driven, three angles and the length along the guide are solved together.
    ///
    /// The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism SliderTriad {
        param a = 3, b = 4, h = -1, tilt = 0.2, px = -2.5, py = 5, e = 5, f = 3, fx = 2, fy = 2.5;
        coordinate crank, coupler, slide, rod, swing;

        loop a@crank + b@coupler = (slide, h)@tilt;
        loop a@crank + (px, py)@coupler + e@rod = (fx, fy) + f@swing;

        drive SliderTriadNear by crank;
        drive SliderTriadFar by swing;

        point A = (0, 0);
        point F = (fx, fy);
        point B = a@crank;
        point C = B + b@coupler;
        point P = B + (px, py)@coupler;
        point Q = F + f@swing;
        output travel = slide;
        derive intervals;
    }
}
