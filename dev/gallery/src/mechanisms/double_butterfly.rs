use linkage::linkage;

linkage! {
    /// The double butterfly: an eight-bar of four ternary links (the crank `A C D`, the rocker `B F J`, and `E F G`,
    /// `D H I` that float) and three couplers. It has no four-bar loop and no dyad at the input: six angles are solved
    /// together.
    ///
    /// A benchmark of position analysis: J. Nielsen and B. Roth, "Solving the input/output problem for planar
    /// mechanisms" (1999); C. W. Wampler, "Solving the kinematics of planar mechanisms by Dixon determinant and a
    /// complex-plane formulation" (2001). The dimensions are this gallery's, such that the crank turns all the way.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism DoubleButterfly {
        param ab = 6, ac = 1, dx = 0.2, dy = -1, ce = 6, ef = 3.5, gx = 5, gy = -3, bf = 4, jx = 0.4, jy = 1.5,
            dh = 2, ix = 2, iy = -4, gh = 3.5, ij = 3.5;
        input crank;
        unknown coupler, upper, rocker, lower, link, strut;

        let c = ac@crank;
        let d = (dx, dy)@crank;
        let e = c + ce@coupler;
        let b = ab@0;
        loop e + ef@upper = b + bf@rocker;
        loop e + (gx, gy)@upper = d + dh@lower + gh@link;
        loop d + (ix, iy)@lower + ij@strut = b + (jx, jy)@rocker;

        point A = (0, 0);
        point B = b;
        point C = c;
        point D = d;
        point E = e;
        point F = b + bf@rocker;
        point G = e + (gx, gy)@upper;
        point H = d + dh@lower;
        point I = d + (ix, iy)@lower;
        point J = b + (jx, jy)@rocker;
        output swing = rocker;

        derive limits, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
