use linkage::linkage;

linkage! {
    /// Scotch yoke by one scalar equation: the smallest block there is.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism ScotchYoke {
        param r = 0.75;
        input phi;
        unknown x;

        equation x = r * cos(phi);

        point Slider = (x, 0);
        output lift = r - x;

        derive lanes, intervals;
    }
}
