use linkage::linkage;

linkage! {
    /// A block on a belt that runs, held by a spring.
    #[derive(Debug, Clone)]
    pub mechanism Belt {
        param m = 2, g = 9.81, mu = 0.3, k = 50, speed = 0.5;
        input x, z;
        unknown slip;
        equation slip = x - z;
        point Block = (x, 0);
        output lead = 2 * slip;
        body block { mass m; center (x, 0); }
        scene Carried {
            inertia;
            spring k on x;
            drive z = speed * t;
            friction mu, m * g on slip;
        }
        scene Driven {
            inertia;
            drive z = speed * t;
            stop z in -1..1, restitution 0.5;
        }
        derive intervals;
    }
}
