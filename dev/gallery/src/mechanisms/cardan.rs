use linkage::linkage;

linkage! {
    /// Cardan gears: a planet rolls inside a ring of twice its radius, and every point of its rim moves on a
    /// diameter of the ring; points within draw ellipses.
    ///
    /// G. Cardano, "Opus novum de proportionibus" (1570), states the theorem; James White's and Matthew Murray's
    /// engines (about 1800) used it for a steam piston. The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Cardan {
        param ring = 2, planet = 1, pen = 0.5;
        input carrier;
        unknown roll;

        /// Rolling: the planet's point of contact stands still.
        equation (ring - planet) * carrier + planet * roll = 0;

        point O = (0, 0);
        point Centre = (ring - planet)@carrier;
        point Rim = Centre + planet@roll;
        point Pen = Centre + pen@roll;
        output slide = x(Rim);
        derive intervals;
    }
}
