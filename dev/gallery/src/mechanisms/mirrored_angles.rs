use linkage::linkage;

linkage! {
    /// Angles that are measured against the sense of rotation: a four-bar linkage with the angles of its coupler and its
    /// rocker so, a rod from its joint to a slider, and a slotted arm. The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism MirroredAngles {
        param a = 20, b = 55, c = 45, d = 60, rod = 90, guide = 12, pivot_x = -70, pivot_y = 15, arm = 8, slope = 10deg;
        input theta2;
        unknown beta, theta4, psi, s, chi, slide;
        derive jerk, velocity_ratio_derivatives, sensitivity, intervals;

        loop a@theta2 + b@(-beta) = d@0 + c@(pi - theta4);
        loop d@0 + c@(pi - theta4) + rod@(-psi) = (0, guide) + s@slope;
        loop a@theta2 = (pivot_x, pivot_y) + slide@(-chi) + arm@(90deg - chi);

        point B = a@theta2;
        point C = B + b@(-beta);
        point Slider = (0, guide) + s@slope;
        output rocker = theta4;
        output stroke = slide;
    }
}
