linkage::linkage! {
    mechanism Extreme {
        param a = 1e-320;
        input v;
        unknown u;
        equation u = a * v;
        output o1 = v / 5e-324;
        output o2 = (1e200 * v)^2;
        output o3 = v * pi * 1e308;
        output o4 = sqrt(1e300 * v * 1e300);
        output o5 = 1e-200 * v * 1e-200;
    }
}

linkage::linkage! {
    mechanism Derived {
        input v;
        unknown u, w;
        equation 1e-200 * u + 2 * w = v;
        equation u = 1e-200 * w;
    }
}

fn main() {}
