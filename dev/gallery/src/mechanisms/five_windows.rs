use linkage::linkage;

linkage! {
    /// Five windows.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism FiveWindows {
        param l = 1, m = 1, g = 9.81;
        input phi0;
        unknown psi1, phi1, psi2, phi2, psi3, phi3, psi4, phi4, psi5, phi5;
        loop l@phi0 + l@psi1 = (1 * l, 0) + l@phi1;
        loop (1 * l, 0) + l@phi1 + l@psi2 = (2 * l, 0) + l@phi2;
        loop (2 * l, 0) + l@phi2 + l@psi3 = (3 * l, 0) + l@phi3;
        loop (3 * l, 0) + l@phi3 + l@psi4 = (4 * l, 0) + l@phi4;
        loop (4 * l, 0) + l@phi4 + l@psi5 = (5 * l, 0) + l@phi5;
        let j = m * l^2 / 12;
        point Corner = l@phi0 + l@psi1;
        output height = y(Corner);
        body upright0 { mass m; inertia j; center (0 * l, 0) + (l/2)@phi0; angle phi0; }
        body upright1 { mass m; inertia j; center (1 * l, 0) + (l/2)@phi1; angle phi1; }
        body upright2 { mass m; inertia j; center (2 * l, 0) + (l/2)@phi2; angle phi2; }
        body upright3 { mass m; inertia j; center (3 * l, 0) + (l/2)@phi3; angle phi3; }
        body upright4 { mass m; inertia j; center (4 * l, 0) + (l/2)@phi4; angle phi4; }
        body upright5 { mass m; inertia j; center (5 * l, 0) + (l/2)@phi5; angle phi5; }
        body bar1 { mass m; inertia j; center (0 * l, 0) + l@phi0 + (l/2)@psi1; angle psi1; }
        body bar2 { mass m; inertia j; center (1 * l, 0) + l@phi1 + (l/2)@psi2; angle psi2; }
        body bar3 { mass m; inertia j; center (2 * l, 0) + l@phi2 + (l/2)@psi3; angle psi3; }
        body bar4 { mass m; inertia j; center (3 * l, 0) + l@phi3 + (l/2)@psi4; angle psi4; }
        body bar5 { mass m; inertia j; center (4 * l, 0) + l@phi4 + (l/2)@psi5; angle psi5; }
        scene FiveFalling { inertia; gravity (0, -g); energy; }
        derive intervals;
    }
}
