use linkage::linkage;

linkage! {
    /// A slider-crank whose slider or crank may be driven, with a spring at the slider and gas behind it.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Machine {
        param r = 0.05, l = 0.18;
        param m2 = 0.8, j2 = 1.2e-3, m3 = 0.6, j3 = 2e-3, m4 = 0.9, g = 9.81, c = 40, k = 900, z0 = 0.15, speed = 80, mu = 0.1, rp = 8e-3;
        coordinate phi, psi, z;
        loop r@phi + l@psi = (z, 0);
        drive Crank by phi;
        drive Piston by z;

        point Pin = r@phi;
        point G3 = Pin + (l/3)@psi;

        output stroke = z;

        body crank { mass m2; center (r/4)@phi; inertia j2; angle phi; }
        body rod { mass m3; inertia j3; center G3; angle psi; }
        body piston { mass m4; center (z, 0); }

        scene Turning of Crank {
            inertia;
            gravity (0, -g);
            force (-c * rate(z), 0) at (z, 0);
            spring k, z0 on z;
            energy;
            power;
        }
        /// Friction by the forces in a pin and in the guide.
        scene Worn of Crank {
            inertia;
            gravity (0, -g);
            friction mu, rp, reaction on psi - phi;
            friction mu, reaction on z;
            reactions;
            energy;
            power;
        }
        scene Steady of Crank {
            inertia;
            drive phi = speed * t;
        }
        scene Pushed of Piston {
            inertia rod, piston;
            damper c on phi;
            force (30 * cos(9 * t), 0) at (z, 0);
            energy;
            power;
        }
        derive intervals;
    }
}
