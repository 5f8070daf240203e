//! The branch of another mechanism, and a pose of another one, are one message each.

use linkage::{Elbow, linkage};

linkage! {
    mechanism FourBar {
        param a = 2, b = 7, c = 6, d = 8;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = d@0 + c@psi;
    }
    mechanism Second {
        param a = 2, b = 7, c = 6, d = 8;
        input theta;
        unknown alpha, beta;
        loop a@theta + b@alpha = d@0 + c@beta;
    }
}

fn main() {
    let (m, second) = (FourBar::default(), Second::default());
    let pose = m.assemble(0.3, SecondBranch::new(Elbow::Left));
    let other = second.assemble(0.3, SecondBranch::new(Elbow::Left)).unwrap();
    let branch = m.branch_of(&other);
}
