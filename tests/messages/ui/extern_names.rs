use linkage::linkage;

linkage! {
    pub mechanism Cam {
        param slope = 2;
        input phi;
        unknown s;
        extern fn lift(phi) -> (sin, slope, bend);
        extern fn table::lift(phi, phi) -> (other, bend, pi);
        extern fn lift(phi) -> (again);
        equation s = slope * phi;
    }
}

fn main() {}
