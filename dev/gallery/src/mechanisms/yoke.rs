use linkage::linkage;

linkage! {
    /// A scotch yoke, whose slider has exactly no lever at phi = 0.
    #[derive(Debug, Clone)]
    pub mechanism Yoke {
        param r = 0.1, j = 0.02, m = 0.8, force = 8, torque = 3;
        input phi;
        unknown x;
        equation x = r * cos(phi);
        point Slider = (x, 0);
        output travel = x;
        body crank { inertia j; angle phi; }
        body slider { mass m; center (x, 0); }
        scene Scotch {
            inertia;
            torque torque on phi;
            friction force on x;
        }
        derive intervals;
    }
}
