use linkage::linkage;

linkage! {
    mechanism Twice {
        param a = 1, b = 2;
        input v;
        unknown x, y;
        equation a * x + b * y = v;
        equation 2 * a * x + 2 * b * y = 2 * v;
    }
}

fn main() {
    let _ = Twice::default();
}
