use linkage::linkage;

linkage! {
    /// The planar 3-RRR robot: a platform on three legs of two links, all three cranks driven. Its two loops have no
    /// dyad, and up to 6 positions.
    ///
    /// C. Gosselin, J. Angeles, "The optimum kinematic design of a planar three-degree-of-freedom parallel manipulator"
    /// (1988). The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism ThreeRrr {
        /// Cranks, rods, distance of the pivots, and radius of the platform.
        param crank = 2, rod = 3, base = 6, radius = 2;
        input first, second, third;
        unknown x, y, platform, rod1, rod2, rod3;

        let a = (0, 0);
        let b = (base, 0);
        let c = base@60deg;
        loop a + crank@first + rod@rod1 = (x, y) + radius@(platform + 210deg);
        loop b + crank@second + rod@rod2 = (x, y) + radius@(platform + 330deg);
        loop c + crank@third + rod@rod3 = (x, y) + radius@(platform + 90deg);

        point Tool = (x, y);
        point A = (x, y) + radius@(platform + 210deg);
        point B = (x, y) + radius@(platform + 330deg);
        point C = (x, y) + radius@(platform + 90deg);
        output turn = platform;
        derive intervals;
    }
}
