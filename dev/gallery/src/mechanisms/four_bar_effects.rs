use linkage::linkage;

linkage! {
    /// Four-bar linkage, and each effect in a scene of its own: a parameter and a scene a line.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism FourBar {
        param l1 = 0.8;
        param l2 = 0.2;
        param l3 = 0.5;
        param l4 = 0.7;
        param j2 = 0.02;
        param m3 = 2.5;
        param j3 = 0.05;
        param a3 = 0.25;
        param b3 = 0.05;
        param m4 = 3;
        param j4 = 0.1;
        param a4 = 0.35;
        param g = 9.81;
        param k = 120;
        param s0 = 0.3;
        param xp = 0.6;
        param yp = 0.9;
        param kt = 4;
        param phi0 = -1.2;
        param c = 0.6;
        param f = 5;
        param t0 = 3;
        param kw = 0.4;
        param mu = 0.1;
        param radius = 0.02;
        param load = 60;
        param lower = -2.5;
        param upper = -0.5;
        param e = 0.4;
        param omega = 12;

        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point C = l2@theta2 + l3@theta3;
        output height = y(C);

        body crank { inertia j2; angle theta2; }
        body coupler { mass m3; inertia j3; center l2@theta2 + (a3, b3)@theta3; angle theta3; }
        body rocker { mass m4; inertia j4; center l1@0 - a4@theta4; angle theta4; }

        scene Bare { inertia; }
        scene Weighed { inertia; gravity (0, -g); }
        scene Sprung { inertia; spring k, s0 between C and (xp, yp); }
        scene Twisted { inertia; spring kt, phi0 on theta4; }
        scene Damped { inertia; damper c on theta4; }
        scene Pushed { inertia; force (0, -f * t) at C; }
        scene Turned { inertia; torque t0 - kw * rate(theta2) + sin(t) on theta2; }
        scene Rough { inertia; friction mu, radius, load on theta4; }
        scene Stopped { inertia; stop theta4 in lower..upper, restitution e; }
        scene Worn { inertia; friction mu, radius, reaction on theta4; }
        scene Measured { inertia; reaction at C; }
        scene Loaded { inertia; reactions; }
        scene Driven { inertia; drive theta2 = omega * t + sin(3 * t); }
        scene Mounted { inertia; gravity (0, -g); spring k, s0 between C and (xp, yp); damper c on theta4; }
        scene Smooth { inertia; gravity (0, -g); spring k, s0 between C and (xp, yp); spring kt, phi0 on theta4; damper c on theta4; force (0, -f * t) at C; torque t0 - kw * rate(theta2) + sin(t) on theta2; }
        scene Everything { inertia; gravity (0, -g); spring k, s0 between C and (xp, yp); spring kt, phi0 on theta4; damper c on theta4; force (0, -f * t) at C; torque t0 - kw * rate(theta2) + sin(t) on theta2; friction mu, radius, load on theta4; stop theta4 in lower..upper, restitution e; }
        derive intervals;
    }
}
