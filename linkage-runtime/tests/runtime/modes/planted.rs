//! Random groups with a planted position: it is in the list.

use rand::SeedableRng;
use rand::rngs::SmallRng;

use crate::modes::group::{Number, all, angles, butterfly, closed, evaluate, nearest, random_triad};

/// The number of groups of two loops; of three a tenth as many.
fn count() -> usize {
    linkage_trials::count("MODES", 400, 2000)
}

fn check<const L: usize, const N: usize>(
    count: usize,
    most: usize,
    factors: impl Fn(&mut SmallRng) -> [[Number; N]; L],
) {
    let mut random = SmallRng::seed_from_u64(7);
    let mut largest = 0.0_f64;
    let mut counts = [0; 21];
    for case in 0..count {
        let planted = angles(&mut random);
        let loops = closed(factors(&mut random), &planted);
        let found = all(&loops).unwrap_or_else(|error| panic!("case {case}: {error}"));
        let error = nearest(&found, &planted);
        assert!(error < 1e-9, "case {case} misses its position by {error:e} rad");
        largest = largest.max(error);
        // Each position closes every loop to 4 ulps of the sum of its links, and the order is that of the angles.
        for position in &found {
            let (residuals, scales, _) = evaluate(&loops, *position);
            let closes = residuals.iter().zip(&scales).all(|(psi, scale)| psi.abs() <= 4.0 * f64::EPSILON * scale);
            assert!(closes, "case {case}: {residuals:?}");
        }
        assert!(found.is_sorted());
        assert!(found.len().is_multiple_of(2) && found.len() <= most, "case {case}: {} positions", found.len());
        counts[found.len()] += 1;
    }
    println!("{count} groups of {L} loops: largest error {largest:e} rad, by number of positions {counts:?}");
}

#[test]
fn two_loops() {
    check::<2, 4>(count(), 6, random_triad);
}

#[test]
fn three_loops() {
    check::<3, 6>(count() / 10, 16, butterfly);
}
