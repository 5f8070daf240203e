use linkage::linkage;

linkage! {
    pub mechanism Gears {
        param n = 3;
        input phi1;
        unknown phi2, phi3;
        equation phi2 = n * phi1;
        equation phi2 + phi1 = 0;
        output both = phi2 + phi3;
    }
}

linkage! {
    pub mechanism Closed {
        param a = 3;
        input phi1;
        unknown phi2;
        equation a = 2 * phi1;
        output both = phi2 + phi1;
    }
}

linkage! {
    pub mechanism TwoForOne {
        param a = 1, b = 2;
        input v;
        unknown x, y, z;
        equation x = a * v;
        equation 2 * x = b + v;
        equation y + z = x;
    }
}

fn main() {}
