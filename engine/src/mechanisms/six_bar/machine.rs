//! The six-bar as a mechanism.

use linkage::linkage;

linkage! {
    /// Stephenson III six-bar as a leg: the coupler point P of the four-bar A-B-C-D carries the leg P-Q-Foot, and the lever
    /// F-Q holds it. J. Klann's walking machine has such legs (US patent 6 260 862, 2001).
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism SixBar {
        param crank = 1, coupler = 3, rocker = 2.5, ground = 3, px = 2, py = 2, leg = 4, lever = 3.5, fx = 2, fy = 0.5,
            u = 6, v = 2;
        input theta;
        unknown beta, gamma, delta, phi;

        let pin = crank@theta;
        loop pin + coupler@beta = ground@0 + rocker@gamma;
        loop pin + (px, py)@beta + leg@delta = (fx, fy) + lever@phi;

        point A = (0, 0);
        point B = pin;
        point C = pin + coupler@beta;
        point D = ground@0;
        point P = pin + (px, py)@beta;
        point Q = P + leg@delta;
        point F = (fx, fy);
        point Foot = P + (u, v)@delta;

        /// The sine of the transmission angle between coupler and rocker.
        output sine_c = sin(gamma - beta);
        /// The sine of the transmission angle between leg and lever.
        output sine_q = sin(phi - delta);

        derive lanes;
    }
}
