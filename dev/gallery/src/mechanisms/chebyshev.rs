use linkage::linkage;

linkage! {
    /// Chebyshev's straight line: crossed equal rockers, drawn by the middle of the coupler. The coupler is the
    /// shortest link and can turn all the way round; driven by a rocker only the nearly straight stretch is reached.
    ///
    /// P. L. Chebyshev, "Théorie des mécanismes connus sous le nom de parallélogrammes" (1854), is the theory;
    /// A. B. Kempe, "How to Draw a Straight Line" (1877), describes the linkage. The proportions 2 : 4 : 5 are the
    /// usual ones.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Chebyshev {
        param ground = 4, rocker = 5, coupler = 2;
        coordinate theta2, theta3, theta4;

        loop rocker@theta2 + coupler@theta3 = ground@0 + rocker@theta4;

        /// A rocker drives.
        drive ChebyshevRocker by theta2;
        /// The coupler drives, through full turns.
        drive ChebyshevCoupler by theta3;

        point A = (0, 0);
        point D = (ground, 0);
        point B = rocker@theta2;
        point C = D + rocker@theta4;
        point P = B + (coupler/2)@theta3;
        output height = y(P);
        derive intervals;
    }
}
