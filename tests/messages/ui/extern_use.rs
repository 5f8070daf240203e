use linkage::linkage;

linkage! {
    pub mechanism Cam {
        input phi;
        unknown s;
        extern fn lift(phi) -> (law, slope, bend);
        extern fn unused(phi) -> (f, df, ddf);
        equation s = law(phi) + lift(phi);
        output a = law(phi, 2);
        output b = law((1, 2));
        output c = slope;
        output d = bent(phi);
    }
}

linkage! {
    pub mechanism Unused {
        input phi;
        unknown s;
        extern fn lift(phi) -> (law, slope, bend);
        equation s = phi;
    }
}

fn main() {}
