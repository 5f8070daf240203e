use linkage::linkage;

linkage! {
    /// A five-bar with both cranks free, or one of them driven.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Pair {
        param a = 1, b = 2.5, c = 2.2, d = 0.8, e = 2;
        param m1 = 1, m2 = 2, m3 = 1.7, m4 = 0.9, j1 = 0.2, j2 = 0.9, j3 = 0.7, j4 = 0.1, g = 9.81, kt = 3, ct = 0.5;
        input theta1, theta4;
        unknown theta2, theta3;
        loop a@theta1 + b@theta2 = e@0 + d@theta4 + c@theta3;

        point G1 = (a/2)@theta1;
        point G2 = a@theta1 + (b/2, 0.1)@theta2;
        point G3 = e@0 + d@theta4 + (c/2)@theta3;
        point G4 = e@0 + (d/2)@theta4;
        output opening = theta2 - theta3;

        body left { mass m1; inertia j1; center G1; angle theta1; }
        body arm { mass m2; inertia j2; center G2; angle theta2; }
        body forearm { mass m3; inertia j3; center G3; angle theta3; }
        body right { mass m4; inertia j4; center G4; angle theta4; }

        scene Free {
            inertia;
            gravity (0, -g);
            spring kt, 0.4 on opening;
            damper ct on opening;
            torque 2 * sin(t) - theta4 on theta1;
            equilibrium;
            energy;
            power;
        }
        scene Half {
            inertia;
            gravity (0, -g);
            damper ct on opening;
            drive theta4 = 0.7 * t + t^2 / 2;
            equilibrium;
            energy;
            power;
        }
        derive intervals;
    }
}
