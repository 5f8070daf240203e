//! Newton's method from random starts finds no position that the list does not have.

use rand::SeedableRng;
use rand::rngs::SmallRng;

use linkage_runtime::modes::Loops;
use linkage_runtime::position::newton_group;

use crate::modes::group::{Number, all, angles, butterfly, closed, evaluate, nearest, random_triad};

fn check<const L: usize, const N: usize>(seed: u64, factors: impl Fn(&mut SmallRng) -> [[Number; N]; L]) {
    let starts = linkage_trials::count("STARTS", 1000, 1000);
    let mut random = SmallRng::seed_from_u64(seed);
    let planted = angles(&mut random);
    let loops: Loops<f64, L, N> = closed(factors(&mut random), &planted);
    let list = all(&loops).unwrap();
    let mut reached = vec![false; list.len()];
    for _ in 0..starts {
        let start = angles(&mut random);
        let Ok(found) = newton_group("Group", "t", start, |angles| evaluate(&loops, angles)) else { continue };
        assert!(nearest(&list, &found) < 1e-6, "not in the list: {found:?}");
        let place = list.iter().position(|one| nearest(&[*one], &found) < 1e-6).unwrap();
        reached[place] = true;
    }
    assert!(reached.iter().all(|reached| *reached), "{reached:?}");
}

#[test]
fn two_loops() {
    (0..5).for_each(|seed| check::<2, 4>(seed, random_triad));
}

#[test]
fn three_loops() {
    (0..5).for_each(|seed| check::<3, 6>(seed, butterfly));
}
