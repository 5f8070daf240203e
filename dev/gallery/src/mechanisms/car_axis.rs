use linkage::linkage;

linkage! {
    /// A car axis whose right wheel rides over bumps: two springs carry the chassis, and the left spring stays
    /// perpendicular to the axis.
    ///
    /// Problem "car axis" of the Test Set for IVP Solvers (F. Mazzia, C. Magherini), there with four coordinates and two
    /// constraints, of index 3. Here it is an open chain with a driven input.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism CarAxis {
        /// The lengths of axis and chassis; the free length of the springs.
        param l = 1, l0 = 0.5;
        /// The height of a bump and its angular frequency.
        param r = 0.1, w = 10;
        /// The mass at each end of the chassis, M eps^2 / 2 with M = 10 and eps = 0.01, for a stiffness of 1.
        param m = 5e-4, k = 1, g = 1;
        /// The angle of the axis, the length of the left spring, and the angle of the chassis.
        input beta, s, phi;

        point Wheel = l@beta;
        point Left = s@(beta + 90deg);
        point Right = Left + l@phi;
        /// The length of the right spring.
        output spring = norm(Right - Wheel);

        body left { mass m; center Left; }
        body right { mass m; center Right; }

        /// The bumps turn the axis.
        scene Riding {
            inertia;
            gravity (0, -g);
            spring k, l0 between (0, 0) and Left;
            spring k, l0 between Wheel and Right;
            drive beta = asin(r * sin(w * t) / l);
            energy;
        }
        derive intervals;
    }
}
