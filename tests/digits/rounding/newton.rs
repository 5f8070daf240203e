//! Positions by Newton's method from a guess that is a position within rounding error: the search takes no step, or one,
//! and the position of 31 digits is within the bound.

use linkage_double::DoubleDouble;
use linkage_gallery::double_butterfly::DoubleButterfly;
use linkage_gallery::stephenson_ii::StephensonII;
use linkage_gallery::{Fixture, Kinematics};
use linkage_oracle::Oracle;
use linkage_rounding::Rounded;

use crate::rounding::every_function::{arguments, median};
use crate::rounding::poses;

/// Positions of each mechanism, if no number is asked for.
const POSITIONS: usize = 200;

fn positions_are_within_their_bounds<F: Fixture>() {
    let mut ratios = Vec::new();
    for plain in Oracle::of::<F>().samples(poses(POSITIONS)).map(arguments) {
        let Ok(pose) = F::with_parameters(&plain.parameters).position(&plain.q, 0) else { continue };
        let q = F::listed(&pose);
        let rounded = |list: &[f64]| list.iter().copied().map(Rounded::from).collect::<Vec<_>>();
        let precise = |list: &[f64]| list.iter().copied().map(DoubleDouble::from).collect::<Vec<_>>();
        let found = F::Of::<Rounded>::with_parameters(&rounded(&plain.parameters)).position(&rounded(&q), 0);
        let exact = F::Of::<DoubleDouble>::with_parameters(&precise(&plain.parameters)).position(&precise(&q), 0);
        let (Ok(found), Ok(exact)) = (found, exact) else { continue };
        for (found, exact) in F::Of::<Rounded>::listed(&found).into_iter().zip(F::Of::<DoubleDouble>::listed(&exact)) {
            let off = (exact - DoubleDouble::from(found.value())).high().abs();
            assert!(off <= found.error() * (1.0 + 1e-12), "{}: {found:?} is off by {off:e} at {q:?}", F::FILE);
            if off > 0.0 {
                ratios.push(found.error() / off);
            }
        }
    }
    let ratio = median(ratios.iter().copied());
    println!("{}: {} unknowns, median of bound / error {ratio:.1}", F::FILE, ratios.len());
    // A bound of the whole search would grow by the condition number in each step.
    assert!(ratio < 100.0 && !ratios.is_empty(), "{ratio}");
}

#[test]
fn from_their_own_solutions() {
    positions_are_within_their_bounds::<StephensonII>();
    positions_are_within_their_bounds::<DoubleButterfly>();
}
