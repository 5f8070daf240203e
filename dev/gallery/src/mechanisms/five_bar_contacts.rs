use linkage::linkage;

linkage! {
    /// A five-bar in the plane of a table, with both cranks free.
    #[derive(Debug, Clone)]
    pub mechanism Pair {
        param a = 1, b = 2.5, c = 2.2, d = 0.8, e = 2, m2 = 2, m3 = 1.7, j1 = 0.7, j4 = 0.4, j2 = 0.9, j3 = 0.8;
        param brake1 = 9, brake4 = 0.6, torque = -2.5, place = 0, sign = 1, upper1 = 1.2, lower4 = 0.5, upper4 = 9, e1 = 0.6, middle = 0, half = 1;
        input theta1, theta4;
        unknown theta2, theta3;
        loop a@theta1 + b@theta2 = e@0 + d@theta4 + c@theta3;
        output opening = theta2 - theta3;
        point G2 = a@theta1 + (b/2)@theta2;
        point G3 = e@0 + d@theta4 + (c/2)@theta3;
        body left { inertia j1; angle theta1; }
        body arm { mass m2; inertia j2; center G2; angle theta2; }
        body forearm { mass m3; inertia j3; center G3; angle theta3; }
        body right { inertia j4; angle theta4; }
        scene Braked {
            inertia;
            torque torque on theta4;
            friction brake1 on theta1;
            friction brake4 on theta4;
            energy;
        }
        /// `Braked` with a clamped crank.
        scene Clamped {
            inertia;
            torque torque on theta4;
            drive theta1 = place;
            torque -sign * brake4 on theta4;
        }
        scene Stopped {
            inertia;
            stop theta1 in -9..upper1, restitution e1;
            stop theta4 in lower4..upper4, restitution e1;
            stop opening in -9..9, restitution 0;
            energy;
        }
        scene Narrow {
            inertia;
            stop opening in middle - half..middle + half, restitution e1;
            energy;
        }
        scene Shaken {
            inertia;
            torque torque * sin(5 * t) on theta1;
            torque torque * cos(3 * t) / 2 on theta4;
            friction brake1 on theta1;
            friction brake4 on theta4;
            stop theta1 in -1..upper1, restitution e1;
            stop theta4 in lower4..2, restitution e1;
            energy;
            power;
        }
        scene Curved {
            inertia;
            friction brake1, 1 + rate(theta3)^2 on theta1 * sin(theta2);
        }
        derive intervals;
    }
}
