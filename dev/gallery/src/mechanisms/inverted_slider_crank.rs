use linkage::linkage;

linkage! {
    /// Inverted slider-crank: the crank's pin slides on an arm that turns about `D`, as in the oscillating
    /// cylinder of steam engines.
    ///
    /// Layout and letters of R. L. Norton, "Design of Machinery", section 4.7; the slide passes its pivot at the
    /// distance `c`, at the angle `gamma` to it. The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism InvertedSliderCrank {
        param a = 40, c = 20, d = 100, gamma = 90deg;
        input theta2;
        unknown theta4, b;

        loop a@theta2 = d@0 + c@theta4 + b@(theta4 + gamma);

        point O = (0, 0);
        point D = (d, 0);
        /// The crank's pin.
        point A = a@theta2;
        /// Foot of the slide on the arm.
        point B = D + c@theta4;
        output slide_angle = theta4 + gamma;

        derive lanes, intervals;
    }
}
