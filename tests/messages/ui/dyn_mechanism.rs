//! Mechanisms as trait objects: their types differ in the numbers of unknowns and inputs.

use linkage::{Kinematic, Mechanism};

linkage::linkage! {
    mechanism Crank {
        param r = 2;
        input phi;
        unknown x;
        equation x = r * cos(phi);
    }
}

fn area(_: &dyn Mechanism) {}

fn main() {
    let all: Vec<Box<dyn Kinematic<Scalar = f64>>> = vec![Box::new(Crank::default())];
    area(&Crank::default());
}
