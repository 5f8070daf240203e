use linkage::linkage;

linkage! {
    /// Not a machine: every function of the language, each as an output that moves.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism EveryFunction {
        param a = 1.2, b = 0.3;
        input v;
        unknown u;

        let w = 0.3 + 0.1 * sin(u + v);

        equation a * u + b * sin(v) = exp(-v) / 2;

        point P = (hypot(u, v), w * cos(u) ^ 3)@(u - 2 * v);
        output f_sin = sin(u * v);
        output f_cos = cos(u - v / 3);
        output f_tan = tan(w);
        output f_asin = asin(w);
        output f_acos = acos(w);
        output f_atan = atan(u * v);
        output f_atan2 = atan2(u + 2, v - 5);
        output f_sqrt = sqrt(1 + u ^ 2);
        output f_abs = abs(v - 7) * u;
        output f_exp = exp(u / (1 + w));
        output f_ln = ln(w * (2 + cos(v)));
        output f_hypot = hypot(u + 3, v);
        output f_power = powi(u, 3) / w ^ 2 + (u + v).powi(-1);
        output f_vector = dot(P, (1, 2)) + cross(P, (u, v)) + norm(P) + angle(P + (40, 0)) + x(P) * y(P) + pi / 7;

        derive lanes, jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
