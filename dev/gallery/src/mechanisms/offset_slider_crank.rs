use linkage::linkage;

linkage! {
    /// Slider-crank whose slider passes the crank's pivot at the offset `c`.
    ///
    /// Layout, letters and dimensions of R. L. Norton, "Design of Machinery", chapter 4: the loop equation is
    /// a - b - c - d = 0, so that `b` points from the slider to the crank's pin.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism OffsetSliderCrank {
        param a = 40, b = 120, c = -20;
        input theta2;
        unknown theta3, d;

        loop a@theta2 = b@theta3 + (d, c);

        point O = (0, 0);
        point A = a@theta2;
        point B = (d, c);
        /// Angle between rod and slideway.
        output mu = 180deg - theta3;

        derive lanes, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
