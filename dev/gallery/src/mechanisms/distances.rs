use linkage::linkage;

linkage! {
    /// Joints that are given by their distances: a four-bar linkage, a dyad in squares, a slider on a horizontal guide, and a
    /// link with an angle whose end is at a distance. The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Distances {
        param a = 20, b = 55, c = 45, d = 60, e = 50, f = 60, pivot_x = 110, pivot_y = 35, guide = 12, rod = 90,
            arm = 50, stay = 65, post_x = -40, post_y = 20;
        input theta2;
        unknown x, y, u, v, s, z_x, z_y, phi;
        derive jerk, velocity_ratio_derivatives, sensitivity, intervals;

        equation norm((x, y) - a@theta2) = b;
        equation norm((x, y) - (d, 0)) = c;
        let E = (u, v) - (x, y);
        equation dot(E, E) = e^2;
        equation (u - pivot_x)^2 + (v - pivot_y)^2 = f^2;
        equation norm((s, guide) - (u, v)) = rod;
        loop a@theta2 + arm@phi = (z_x, z_y);
        equation norm((z_x, z_y) - (post_x, post_y)) = stay;

        point B = a@theta2;
        point C = (x, y);
        point Joint = (u, v);
        point Slider = (s, guide);
        point End = (z_x, z_y);
        output swing = phi;
    }
}
