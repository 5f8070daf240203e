use linkage::linkage;

linkage! {
    /// Oscillating roller follower of a disc cam with a dyad behind it: the follower swings with cycloidal motion,
    /// and a rod carries the swing to a rocker. The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism CamRocker {
        param swing = 18deg, rise = 120deg, rest = 75deg, bend = 80deg, lever = 50, distance = 80, arm = 60, rod = 90;
        param rocker = 70, base = 100;
        input theta;
        unknown psi, phi, beta;

        extern fn crate::cam_laws::cycloidal_strokes(theta, height, rise) -> (turn, turn1, turn2);

        equation psi = rest + turn(theta, swing, rise);
        loop arm@psi + rod@phi = base@0 + rocker@beta;

        point A = arm@psi;
        point B = A + rod@phi;
        point C = (base, 0);
        point Roller = lever@(psi + bend);
        /// The pitch curve, about the axis of the cam.
        point Pitch = (Roller + (distance, 0))@(-theta);
        output mu = beta - phi;

        derive lanes, intervals;
    }
}
