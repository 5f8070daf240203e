use linkage::linkage;

linkage! {
    /// Disc cam with a translating roller follower, offset from the axis of the cam: rise, dwell, return and dwell
    /// by the 3-4-5 polynomial.
    ///
    /// Pressure angle and pitch curve as in R. L. Norton, *Design of Machinery*, chapter 8; the dimensions are
    /// this gallery's. The cam turns counterclockwise, and its profile is passed clockwise.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism CamFollower {
        param prime = 40, offset = 10, roller = 8, height = 20, rise = 120deg;
        input theta;
        unknown s;

        /// Lift of the follower and its derivatives by the angle of the cam.
        extern fn crate::cam_laws::polynomial_strokes(theta, height, rise) -> (lift, lift1, lift2, lift3);

        equation s = lift(theta, height, rise);

        let reach = sqrt(prime^2 - offset^2) + s;
        let aside = offset - lift1(theta, height, rise);
        let normal = (aside, reach) / hypot(aside, reach);
        point Roller = (offset, reach);
        point Contact = Roller - roller * normal;
        /// The path of the roller's axis on the cam.
        point Pitch = Roller@(-theta);
        /// The profile of the cam: what the roller envelops.
        point Profile = Contact@(-theta);
        output pressure = atan(-aside / reach);
        derive intervals;
    }
}
