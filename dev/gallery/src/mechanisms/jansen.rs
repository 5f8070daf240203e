use linkage::linkage;

linkage! {
    /// A leg of Theo Jansen's walking machine with his thirteen numbers ("The Great Pretender", 2007): five
    /// dyads RRR, two of which are the rigid triangles `b d e` and `g h i`.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Jansen {
        param a = 38, b = 41.5, c = 39.3, d = 40.1, e = 55.8,
            f = 39.4, g = 36.7, h = 65.7, i = 49, j = 50, k = 61.9, l = 7.8, m = 15;
        input crank;
        unknown angle_b, angle_j, angle_d, angle_e, angle_c, angle_k, angle_f, angle_g, angle_h, angle_i;

        let pivot = (-a, -l);
        loop m@crank + j@angle_j = pivot + b@angle_b;
        loop b@angle_b + e@angle_e = d@angle_d;
        loop m@crank + k@angle_k = pivot + c@angle_c;
        loop d@angle_d + f@angle_f = c@angle_c + g@angle_g;
        loop g@angle_g + h@angle_h = i@angle_i;

        point O = (0, 0);
        point Pivot = pivot;
        point Pin = m@crank;
        point Upper = pivot + b@angle_b;
        point Back = pivot + d@angle_d;
        point Knee = pivot + c@angle_c;
        point Ankle = Knee + g@angle_g;
        point Foot = Knee + i@angle_i;
        output bend = angle_h - angle_d;

        derive lanes, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
