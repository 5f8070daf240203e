use linkage::linkage;

linkage! {
    pub mechanism Cam {
        input phi;
        unknown s;
        extern lift(phi) -> (a, da, dda);
        extern fn |x| x -> (b, db, ddb);
        extern fn 3(phi) -> (c, dc, ddc);
        extern fn lift;
        extern fn lift(phi);
        extern fn lift() -> (d, dd, ddd);
        extern fn lift(phi) -> f;
        extern fn lift(phi) -> ();
        extern fn lift(phi: f64) -> (e, de, dde);
        extern fn lift(phi) = law;
        equation s = phi;
    }
}

fn main() {}
