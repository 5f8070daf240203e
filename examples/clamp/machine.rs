//! The clamps, in metres, kilograms and seconds.

use linkage::linkage;

linkage! {
    /// A block between a vertical guide and a wedge on the floor; the friction is that between block and wedge.
    #[derive(Debug, Clone)]
    pub mechanism Wedge {
        param alpha = 20deg, h = 0.3;
        param m1 = 1, m2 = 2, mu = 0.25, load = 400;
        input x;
        unknown y, s;
        loop (x, 0) + s@(pi - alpha) = (h, y);
        point Toe = (x, 0);
        point Block = (h, y);
        body wedge { mass m1; center Toe; }
        body block { mass m2; center Block; }
        scene Released {
            inertia;
            force (0, -load) at Block + (0, 0.01);
            friction mu, reaction on s;
            reaction on s;
        }
    }
}

linkage! {
    /// A knee of a lever and a strut that presses a jaw against a spring, the workpiece; its pins have friction.
    #[derive(Debug, Clone)]
    pub mechanism Toggle {
        param a = 0.06, b = 0.08;
        param m1 = 0.15, j1 = 6e-5, m2 = 0.12, j2 = 8e-5, m3 = 0.3;
        /// Stiffness of the workpiece, and the place of the jaw where it touches it.
        param k = 2e5, touch = 0.138;
        /// Friction in the pins of this radius, and the torque of the hand.
        param mu = 0.15, radius = 0.006, hand = 0;
        input theta;
        unknown psi, s;
        loop a@theta + b@psi = (s, 0);
        point O = (0, 0);
        point A = a@theta;
        point B = (s, 0);
        body lever { mass m1; inertia j1; center (a / 2)@theta; angle theta; }
        body strut { mass m2; inertia j2; center A + (b / 2)@psi; angle psi; }
        body jaw { mass m3; center B; }
        scene Closed {
            inertia;
            spring k, touch on s;
            torque hand on theta;
            friction mu, radius, reaction on theta;
            friction mu, radius, reaction on psi - theta;
            friction mu, radius, reaction on psi;
            reaction at A;
        }
    }
}
