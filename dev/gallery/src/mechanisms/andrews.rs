use linkage::linkage;

linkage! {
    /// Andrews' squeezing mechanism: seven bodies, of which a motor turns the first; three dyads RRR from `beta`.
    ///
    /// G. C. Andrews (1985), spread by W. Schiehlen (editor), "Multibody Systems Handbook" (1990), and by
    /// E. Hairer and G. Wanner, "Solving Ordinary Differential Equations II"; geometry and signs here are those of
    /// the Test Set for IVP Solvers (F. Mazzia, C. Magherini). Some copies print `B` at x = +0.03635, with which the
    /// published initial values do not close. Lengths in metres; `theta` and `phi`, `omega` are relative angles.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Andrews {
        param xa = -0.06934, ya = -0.00227, xb = -0.03635, yb = 0.03273, xc = 0.014, yc = 0.072,
            rr = 0.007, d = 0.028, e = 0.02, ss = 0.035, sc = 0.018, sd = 0.02, zt = 0.04, zf = 0.02, u = 0.04;
        input beta;
        unknown theta, gamma, phi, delta, omega, epsilon;

        let pin = rr@beta - d@(beta + theta);
        loop pin + ss@(gamma + 90deg) = (xb, yb);
        loop pin - e@(phi + delta - 90deg) - zt@delta = (xa, ya);
        loop pin - zf@(omega + epsilon) + u@(epsilon + 90deg) = (xa, ya);

        point O = (0, 0);
        point A = (xa, ya);
        point B = (xb, yb);
        /// The first body's end.
        point F = rr@beta;
        /// The pin of all three dyads.
        point E = pin;
        point H = A + zt@delta;
        point G = A - u@(epsilon + 90deg);
        /// The joint of the spring on the third body.
        point D = B + (sd, -sc)@gamma;
        point C = (xc, yc);
        /// Length of the spring.
        output spring = norm(D - C);
        derive intervals;
    }
}
