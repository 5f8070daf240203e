use linkage::{Real, linkage};

fn lift<T: Real>(phi: T, height: T) -> (T, T, T) {
    (height * phi, height, T::zero())
}

linkage! {
    pub mechanism Cam {
        input phi;
        unknown s, x;
        extern fn lift(phi, height) -> (law, slope, bend);
        equation s = law(phi, 2);
        equation x = law(phi, s);
    }
}

fn main() {}
