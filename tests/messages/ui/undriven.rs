use linkage::linkage;

linkage! {
    pub mechanism SliderCrank {
        param r, l;
        coordinate phi1, phi2, z3;
        loop r@phi1 + l@phi2 = z3@0;
    }
}

linkage! {
    pub mechanism Driven {
        param r, l;
        coordinate phi1, phi2, z3;
        loop r@phi1 + l@phi2 = z3@0;
        drive Engine by z4;
        drive Compressor by phi1;
    }
}

fn main() {}
