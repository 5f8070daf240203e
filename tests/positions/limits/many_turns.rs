//! Limits after many turns of the input. One ulp of an input of a thousand turns is a thousand ulp of an angle near 1.

use std::f64::consts::TAU;

use linkage::Elbow;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use super::{FourBar, FourBarBranch};

/// The mechanism assembles at both limits, wherever the start is.
#[test]
fn a_limit_after_many_turns_assembles() {
    let mut random = SmallRng::seed_from_u64(1);
    let branch = FourBarBranch::new(Elbow::Left);
    let mut limited = 0;
    for _ in 0..2000 {
        let [l1, l2, l3, l4] = [0; 4].map(|_| random.random_range(20.0..80.0));
        let m = FourBar::new(l1, l2, l3, l4);
        let start = random.random_range(0.0..TAU) + TAU * f64::from(random.random_range(0..1000));
        let Ok(found) = m.limits(start, branch) else { continue };
        for input in [found.lower.input(), found.upper.input()].into_iter().flatten() {
            limited += 1;
            assert!(m.assemble(input, branch).is_ok(), "{m:?} from {start} at {input}");
        }
    }
    assert!(limited > 1000, "{limited}");
}
