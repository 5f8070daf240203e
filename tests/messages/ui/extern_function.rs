use linkage::linkage;

fn plain(phi: f64) -> (f64, f64, f64) {
    (phi, 1.0, 0.0)
}

linkage! {
    pub mechanism Cam {
        input phi;
        unknown s, x;
        extern fn missing(phi) -> (law, slope, bend);
        extern fn plain(phi) -> (f, df, ddf);
        equation s = law(phi);
        equation x = f(phi);
    }
}

fn main() {}
