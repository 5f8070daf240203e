use linkage::linkage;

linkage! {
    /// Four-bar linkage with three bodies and forces of all kinds.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism LoadedFourBar {
        param l1 = 0.8, l2 = 0.2, l3 = 0.5, l4 = 0.7;
        param m2 = 1.5, j2 = 0.02, m3 = 2.5, j3 = 0.05, m4 = 3, j4 = 0.1;
        param g = 9.81;
        /// The linear spring: stiffness, free length and where it is fixed.
        param k = 120, s0 = 0.3, xp = 0.6, yp = 0.9;
        param kt = 4, phi0 = -1.2, c = 7, ct = 0.6, t0 = 3, kw = 0.4, f = 5, omega = 12;
        input theta2;
        unknown theta3, theta4;

        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;

        point B = l2@theta2;
        point C = B + l3@theta3;
        point G2 = (l2/2)@theta2;
        point G3 = B + (l3/2, 0.05)@theta3;
        point G4 = C + (l4/2)@theta4;

        output height = y(C);

        let P = (xp, yp);
        let V = 2 * sin(theta4) * (theta3 - theta2)^2;

        body crank { mass m2; inertia j2; center G2; angle theta2; }
        body coupler { mass m3; inertia j3; center G3; angle theta3; }
        body rocker { mass m4; inertia j4; center G4; angle theta4; }

        /// Inertia and weight alone.
        scene Idle {
            inertia;
            gravity (0, -g);
            energy;
        }
        scene Loaded {
            inertia;
            gravity (0, -g);
            spring k, s0 between C and P;
            spring kt, phi0 on theta4;
            damper c between C and P;
            damper ct on theta4;
            torque t0 - kw * rate(theta2) + sin(t) on theta2;
            force (0, -f * t) at C;
            potential V;
            energy;
            power;
            reactions;
        }
        scene Driven {
            inertia;
            gravity (0, -g);
            damper ct on theta4;
            drive theta2 = omega * t + sin(3 * t);
            energy;
            power;
            reactions;
        }
        scene Balanced {
            gravity (0, -g) on coupler, rocker;
            spring kt, phi0 on theta4;
            reactions;
            equilibrium;
        }
        derive intervals;
    }
}
