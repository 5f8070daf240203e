//! A long chain.

use linkage::linkage;

linkage! {
    /// Sixteen four-bars, the rocker of each the crank of the next.
    #[derive(Clone)]
    pub mechanism Chain {
        param a0 = 1, b0 = 3, c0 = 2, d0 = 3;
        param a1 = 1, b1 = 3, c1 = 2, d1 = 3;
        param a2 = 1, b2 = 3, c2 = 2, d2 = 3;
        param a3 = 1, b3 = 3, c3 = 2, d3 = 3;
        param a4 = 1, b4 = 3, c4 = 2, d4 = 3;
        param a5 = 1, b5 = 3, c5 = 2, d5 = 3;
        param a6 = 1, b6 = 3, c6 = 2, d6 = 3;
        param a7 = 1, b7 = 3, c7 = 2, d7 = 3;
        param a8 = 1, b8 = 3, c8 = 2, d8 = 3;
        param a9 = 1, b9 = 3, c9 = 2, d9 = 3;
        param a10 = 1, b10 = 3, c10 = 2, d10 = 3;
        param a11 = 1, b11 = 3, c11 = 2, d11 = 3;
        param a12 = 1, b12 = 3, c12 = 2, d12 = 3;
        param a13 = 1, b13 = 3, c13 = 2, d13 = 3;
        param a14 = 1, b14 = 3, c14 = 2, d14 = 3;
        param a15 = 1, b15 = 3, c15 = 2, d15 = 3;
        input theta;
        unknown t0, s0;
        unknown t1, s1;
        unknown t2, s2;
        unknown t3, s3;
        unknown t4, s4;
        unknown t5, s5;
        unknown t6, s6;
        unknown t7, s7;
        unknown t8, s8;
        unknown t9, s9;
        unknown t10, s10;
        unknown t11, s11;
        unknown t12, s12;
        unknown t13, s13;
        unknown t14, s14;
        unknown t15, s15;

        loop a0@theta + b0@t0 = d0@0 + c0@s0;
        loop a1@s0 + b1@t1 = d1@0 + c1@s1;
        loop a2@s1 + b2@t2 = d2@0 + c2@s2;
        loop a3@s2 + b3@t3 = d3@0 + c3@s3;
        loop a4@s3 + b4@t4 = d4@0 + c4@s4;
        loop a5@s4 + b5@t5 = d5@0 + c5@s5;
        loop a6@s5 + b6@t6 = d6@0 + c6@s6;
        loop a7@s6 + b7@t7 = d7@0 + c7@s7;
        loop a8@s7 + b8@t8 = d8@0 + c8@s8;
        loop a9@s8 + b9@t9 = d9@0 + c9@s9;
        loop a10@s9 + b10@t10 = d10@0 + c10@s10;
        loop a11@s10 + b11@t11 = d11@0 + c11@s11;
        loop a12@s11 + b12@t12 = d12@0 + c12@s12;
        loop a13@s12 + b13@t13 = d13@0 + c13@s13;
        loop a14@s13 + b14@t14 = d14@0 + c14@s14;
        loop a15@s14 + b15@t15 = d15@0 + c15@s15;

        derive lanes;
    }
}
