use linkage::linkage;

linkage! {
    /// A double pendulum with both angles from the ground; the centre of the lower rod is off its line.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism DoublePendulum {
        param l1 = 1, l2 = 0.8, s1 = 0.5, s2 = 0.45, h2 = 0.1;
        param m1 = 1.5, j1 = 0.13, m2 = 0.9, j2 = 0.06, g = 9.81, k = 3, c = 0.4, low = -1, high = 1.2, e = 0.6;
        input theta1, theta2;
        point A = l1@theta1;
        point B = A + l2@theta2;
        point G1 = s1@theta1;
        point G2 = A + (s2, h2)@theta2;
        output fold = theta2 - theta1;

        body upper { mass m1; inertia j1; center G1; angle theta1; }
        body lower { mass m2; inertia j2; center G2; angle theta2; }

        scene Swinging { inertia; gravity (0, -g); equilibrium; energy; power; }
        scene Damped {
            inertia;
            gravity (0, -g);
            spring k, 0.3 on fold;
            damper c on fold;
            torque 2 * sin(3 * t) on theta1;
            stop fold in low..high, restitution e;
            equilibrium;
            energy;
            power;
        }
        /// The lower rod turns at a given speed.
        scene Half { inertia; gravity (0, -g); drive theta2 = 0.3 + 2 * t; equilibrium; energy; power; }

        derive lanes, drawing, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
