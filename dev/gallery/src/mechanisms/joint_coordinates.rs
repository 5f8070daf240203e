use linkage::linkage;

linkage! {
    /// A six-bar linkage with the coordinates of its joints as unknowns, with the angles of its links: each joint ends
    /// one loop and begins the next. The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism JointCoordinates {
        param a = 20, b = 55, c = 45, d = 60, e = 50, f = 60, pivot_x = 110, pivot_y = 35;
        input theta2;
        unknown x, y, theta3, theta4, u, v, theta5, theta6;
        derive jerk, velocity_ratio_derivatives, sensitivity, intervals;

        loop a@theta2 + b@theta3 = (x, y);
        loop (x, y) = d@0 + c@theta4;
        loop (x, y) + e@theta5 = (u, v);
        loop (u, v) = (pivot_x, pivot_y) + f@theta6;

        point B = a@theta2;
        point C = (x, y);
        point E = (u, v);
        output rocker = theta6;
    }
}
