use linkage::linkage;

linkage! {
    /// A pendulum on a pin with friction: an open chain with one input.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Pendulum {
        param l = 0.5, m = 2, j = 0.04, g = 9.81, mu = 0.3, r = 0.01, load = 20, low = -2.5, high = -0.4, e = 0.5;
        input theta;
        point G = l@theta;
        output height = y(G);

        body bob { mass m; inertia j; center G; angle theta; }

        scene Swinging { inertia; gravity (0, -g); equilibrium; energy; }
        scene Rubbing {
            inertia;
            gravity (0, -g);
            friction mu, r, load on theta;
            stop theta in low..high, restitution e;
        }

        /// A journal bearing: its friction by the force that it carries.
        scene Worn { inertia; gravity (0, -g); friction mu, r, reaction on theta; reactions; energy; power; }

        derive lanes, drawing, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
