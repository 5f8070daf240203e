use linkage::linkage;

linkage! {
    /// Andrews' squeezing mechanism with its seven bodies, the spring and the motor, as in `andrews`.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Squeezer {
        param xa = -0.06934, ya = -0.00227, xb = -0.03635, yb = 0.03273, xc = 0.014, yc = 0.072,
            rr = 0.007, d = 0.028, e = 0.02, ss = 0.035, sc = 0.018, sd = 0.02, zt = 0.04, zf = 0.02, u = 0.04;
        param ra = 0.00092, da = 0.0115, ea = 0.01421, sa = 0.01874, sb = 0.01043, ta = 0.02308, tb = 0.00916,
            ua = 0.01228, ub = 0.00449, fa = 0.01421;
        param m1 = 0.04325, m2 = 0.00365, m3 = 0.02373, m4 = 0.00706, m5 = 0.0705, m6 = 0.00706, m7 = 0.05498;
        param i1 = 2.194e-6, i2 = 4.41e-7, i3 = 5.255e-6, i4 = 5.667e-7, i5 = 1.169e-5, i6 = 5.667e-7, i7 = 1.912e-5;
        param c0 = 4530, l0 = 0.07785, mom = 0.033;
        input beta;
        unknown theta, gamma, phi, delta, omega, epsilon;

        let pin = rr@beta - d@(beta + theta);
        loop pin - (0, -ss)@gamma = (xb, yb);
        loop pin - e@(phi + delta - 90deg) - zt@delta = (xa, ya);
        loop pin - zf@(omega + epsilon) + u@(epsilon + 90deg) = (xa, ya);

        let A = (xa, ya);
        let B = (xb, yb);

        point Corner = B + (sd, -sc)@gamma;
        output reach = x(Corner);

        body k1 { mass m1; inertia i1; center ra@beta; angle beta; }
        body k2 { mass m2; inertia i2; center rr@beta - da@(beta + theta); angle beta + theta; }
        body k3 { mass m3; inertia i3; center B + (sa, sb)@gamma; angle gamma; }
        body k4 { mass m4; inertia i4; center A + zt@delta + (e - ea)@(phi + delta - 90deg); angle phi + delta; }
        body k5 { mass m5; inertia i5; center A + (ta, tb)@delta; angle delta; }
        body k6 { mass m6; inertia i6; center A - u@(epsilon + 90deg) + (zf - fa)@(omega + epsilon); angle omega + epsilon; }
        body k7 { mass m7; inertia i7; center A + (ua, ub)@epsilon; angle epsilon; }

        /// The motor turns against the spring.
        scene Squeezing {
            inertia;
            spring c0, l0 between B + (sd, -sc)@gamma and (xc, yc);
            torque mom on beta;
            energy;
            power;
            reactions;
        }
        derive intervals;
    }
}
