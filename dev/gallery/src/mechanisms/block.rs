use linkage::linkage;

linkage! {
    /// A block on a table, with two coordinates for one position.
    #[derive(Debug, Clone)]
    pub mechanism Block {
        param m = 2, g = 9.81, mu = 0.3, k = 50, push = 0, omega = 20, lower = -1, upper = 1, e = 0.4;
        input x;
        unknown y;
        equation y = x;
        point Center = (x, 0);
        output height = 2 * y;
        body block { mass m; center (x, 0); }

        scene Sliding {
            inertia;
            friction mu, m * g on x;
            energy;
            power;
        }
        scene Sprung {
            inertia;
            spring k on x;
            friction mu, m * g on x;
        }
        scene Pushed {
            inertia;
            torque push on x;
            friction mu, m * g on x;
        }
        scene Swelling {
            inertia;
            torque push * t on x;
            friction mu, m * g on x;
        }
        scene Rocked {
            inertia;
            torque push * sin(omega * t) on x;
            friction mu, m * g on x;
        }
        scene Bouncing {
            inertia;
            torque -m * g on x;
            stop height in lower..upper, restitution e;
        }
        derive intervals;
    }
}
