//! The mechanisms whose poses are timed. Nothing reads an angle, so that none is computed.

use linkage::linkage;

linkage! {
    /// Four-bar linkage.
    #[derive(Clone)]
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta;
        unknown theta3, theta4;

        loop l2@theta + l3@theta3 + l4@theta4 = l1@0;

        derive lanes;
    }
}

linkage! {
    /// Slider-crank with an offset.
    pub mechanism SliderCrank {
        param crank = 1, rod = 3, offset = 0.25;
        input theta;
        unknown phi, s;

        loop crank@theta + rod@phi = (s, offset);
    }
}

linkage! {
    /// Stephenson's six-bar with a ternary coupler.
    pub mechanism StephensonIII {
        param a = 2, b = 7, c = 6, d = 8, px = 5, py = 4, e = 9, f = 5, fx = 12, fy = 3;
        input theta;
        unknown theta3, theta4, theta5, theta6;

        loop a@theta + b@theta3 = d@0 + c@theta4;
        loop a@theta + (px, py)@theta3 + e@theta5 = (fx, fy) + f@theta6;
    }
}

linkage! {
    /// A leg of Theo Jansen's walking machine.
    #[derive(Clone)]
    pub mechanism Jansen {
        param a = 38, b = 41.5, c = 39.3, d = 40.1, e = 55.8,
            f = 39.4, g = 36.7, h = 65.7, i = 49, j = 50, k = 61.9, l = 7.8, m = 15;
        input theta;
        unknown angle_b, angle_j, angle_d, angle_e, angle_c, angle_k, angle_f, angle_g, angle_h, angle_i;

        let pivot = (-a, -l);
        loop m@theta + j@angle_j = pivot + b@angle_b;
        loop b@angle_b + e@angle_e = d@angle_d;
        loop m@theta + k@angle_k = pivot + c@angle_c;
        loop d@angle_d + f@angle_f = c@angle_c + g@angle_g;
        loop g@angle_g + h@angle_h = i@angle_i;

        derive lanes;
    }
}

linkage! {
    /// Four four-bars, the rocker of each the crank of the next.
    pub mechanism ShortChain {
        param a0 = 1, b0 = 3, c0 = 2, d0 = 3;
        param a1 = 1, b1 = 3, c1 = 2, d1 = 3;
        param a2 = 1, b2 = 3, c2 = 2, d2 = 3;
        param a3 = 1, b3 = 3, c3 = 2, d3 = 3;
        input theta;
        unknown t0, s0;
        unknown t1, s1;
        unknown t2, s2;
        unknown t3, s3;

        loop a0@theta + b0@t0 = d0@0 + c0@s0;
        loop a1@s0 + b1@t1 = d1@0 + c1@s1;
        loop a2@s1 + b2@t2 = d2@0 + c2@s2;
        loop a3@s2 + b3@t3 = d3@0 + c3@s3;
    }
}
