use linkage::linkage;

linkage! {
    /// A pendulum on a cart that rolls on a level track.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism CartPendulum {
        param l = 0.7, mc = 3, m = 1, j = 0.02, g = 9.81, k = 40;
        param push = 20, mu = 0.15, normal = 30, left = -0.5, right = 0.6, e = 0.4;
        input x, phi;
        point Cart = (x, 0);
        point Bob = Cart + l@phi;
        output height = y(Bob);

        body cart { mass mc; center Cart; }
        body bob { mass m; inertia j; center Bob; angle phi; }

        scene Rolling { inertia; gravity (0, -g); equilibrium; energy; power; }
        scene Sprung { inertia; gravity (0, -g); spring k on x; damper 2 on x; equilibrium; energy; power; }
        scene Rubbing {
            inertia;
            gravity (0, -g);
            force (push * sin(4 * t), 0) at Cart;
            friction mu, normal on x;
            stop x in left..right, restitution e;
        }
        /// The track shakes the pivot.
        scene Shaken { inertia; gravity (0, -g); drive x = 0.1 * sin(9 * t); equilibrium; energy; power; }

        derive lanes, drawing, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
