use linkage::{Real, linkage};

fn lift<T: Real>(phi: T) -> (T, T) {
    (phi * phi, phi + phi)
}

linkage! {
    pub mechanism Cam {
        input phi;
        unknown s;
        extern fn lift(phi) -> (law, slope);
        equation s = law(phi);
        output way = slope(phi) * law(1);
    }
}

linkage! {
    pub mechanism Wedge {
        input phi;
        unknown s;
        extern fn lift(phi) -> (law, slope);
        equation s = law(phi);
    }
}

fn main() {}
