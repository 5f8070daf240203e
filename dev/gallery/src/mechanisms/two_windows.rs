use linkage::linkage;

linkage! {
    /// Two windows.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism TwoWindows {
        param l = 1, m = 1, g = 9.81;
        input phi0;
        unknown psi1, phi1, psi2, phi2;
        loop l@phi0 + l@psi1 = (1 * l, 0) + l@phi1;
        loop (1 * l, 0) + l@phi1 + l@psi2 = (2 * l, 0) + l@phi2;
        let j = m * l^2 / 12;
        point Corner = l@phi0 + l@psi1;
        output height = y(Corner);
        body upright0 { mass m; inertia j; center (0 * l, 0) + (l/2)@phi0; angle phi0; }
        body upright1 { mass m; inertia j; center (1 * l, 0) + (l/2)@phi1; angle phi1; }
        body upright2 { mass m; inertia j; center (2 * l, 0) + (l/2)@phi2; angle phi2; }
        body bar1 { mass m; inertia j; center (0 * l, 0) + l@phi0 + (l/2)@psi1; angle psi1; }
        body bar2 { mass m; inertia j; center (1 * l, 0) + l@phi1 + (l/2)@psi2; angle psi2; }
        scene TwoFalling { inertia; gravity (0, -g); energy; }
        derive intervals;
    }
}
