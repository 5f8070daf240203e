use linkage::linkage;

linkage! {
    /// An arm of three links with its angles from link to link.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism ThreeLinkArm {
        param a = 0.6, b = 0.5, c = 0.3;
        param m1 = 4, j1 = 0.12, m2 = 3, j2 = 0.08, m3 = 1.5, j3 = 0.02, load = 2, g = 9.81, mu = 0.8, rub = 6;
        input phi1, phi2, phi3;
        let theta2 = phi1 + phi2;
        let theta3 = theta2 + phi3;
        point Elbow = a@phi1;
        point Wrist = Elbow + b@theta2;
        point Tool = Wrist + c@theta3;
        output reach = norm(Tool);
        output tilt = theta3;

        body upper { mass m1; inertia j1; center (a/2)@phi1; angle phi1; }
        body lower { mass m2; inertia j2; center Elbow + (b/2)@theta2; angle theta2; }
        body hand { mass m3; inertia j3; center Wrist + (c/2)@theta3; angle theta3; }
        body part { mass load; center Tool; }

        scene Falling { inertia; gravity (0, -g); equilibrium; energy; power; }
        /// Dry friction in the wrist and a force on the tool.
        scene Pushed {
            inertia;
            gravity (0, -g);
            force (8 * cos(2 * t), 3) at Tool;
            damper 0.5 + 0.1 * rate(phi2)^2 on phi2;
            friction mu, rub on phi3;
            reactions;
            energy;
            power;
        }
        /// Inverse dynamics of two joints; the wrist is free.
        scene Moved {
            inertia;
            gravity (0, -g);
            drive phi1 = 0.5 + 0.4 * sin(2 * t);
            drive phi2 = -0.8 * t;
            energy;
            power;
        }
        /// Inverse dynamics of all joints.
        scene Led {
            inertia;
            gravity (0, -g);
            drive phi1 = 0.5 + 0.4 * sin(2 * t);
            drive phi2 = -0.8 * t;
            drive phi3 = t^2 / 3;
        }

        derive lanes, drawing, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
