use linkage::linkage;

linkage! {
    /// A six-bar linkage with all of its loops: the outer one follows from the other two, and so does the length of a
    /// link. The dimensions are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism ImpliedLoops {
        param a = 20, b = 55, c = 45, d = 60, e = 50, f = 60, pivot_x = 110, pivot_y = 35;
        input theta2;
        unknown theta3, theta4, theta5, theta6;
        derive jerk, velocity_ratio_derivatives, sensitivity, lanes, intervals;

        loop a@theta2 + b@theta3 = d@0 + c@theta4;
        loop d@0 + c@theta4 + e@theta5 = (pivot_x, pivot_y) + f@theta6;
        /// The outer loop.
        implied loop a@theta2 + b@theta3 + e@theta5 = (pivot_x, pivot_y) + f@theta6;
        let link = (pivot_x, pivot_y) + f@theta6 - d@0 - c@theta4;
        implied equation dot(link, link) = e^2;

        point B = a@theta2;
        point C = B + b@theta3;
        point E = C + e@theta5;
        output swing = theta6;
    }
}
