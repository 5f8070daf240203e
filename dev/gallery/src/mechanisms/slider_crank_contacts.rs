use linkage::linkage;

linkage! {
    /// A slider-crank in metres and kilograms with friction where the slider runs and in its three joints.
    #[derive(Debug, Clone)]
    pub mechanism Machine {
        param r = 0.1, l = 0.35, j = 0.02, m = 0.8, mu = 0.2, normal = 40, t0 = 3, r1 = 0.01, r2 = 0.012, r3 = 0.008, n1 = 90;
        input phi;
        unknown psi, z;
        loop r@phi - l@psi = (z, 0);
        point Piston = (z, 0);
        output joint = phi - psi;
        body crank { inertia j; angle phi; }
        body piston { mass m; center (z, 0); }
        scene Guided {
            inertia;
            torque t0 on phi;
            friction mu, normal on z;
        }
        scene Jointed {
            inertia;
            torque t0 * t on phi;
            friction mu, r1, n1 on phi;
            friction mu, r2, n1 on joint;
            friction mu, r3, n1 on psi;
            friction mu, normal on z;
        }
        derive intervals;
    }
}
