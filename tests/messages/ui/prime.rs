//! A name with a prime: the quote begins a character, and the macro is not called.

linkage::linkage! {
    mechanism SliderCrank {
        param r = 1, l = 3;
        input phi;
        unknown psi, s;
        loop r@phi + l@psi = s@0;
        output psi' = psi + phi;
    }
}

fn main() {
    SliderCrank::default();
}
