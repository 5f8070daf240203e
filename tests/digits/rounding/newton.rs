//! Positions by Newton's method from a guess that is a position within rounding error: the search takes no step, or one,
//! and the position of 31 digits is within the bound.

use linkage_double::DoubleDouble;
use linkage_gallery::listed::{Listed, listed, same_as};
use linkage_oracle::{Oracle, scalars};
use linkage_rounding::Rounded;

use crate::rounding::every_function::{arguments, median};
use crate::rounding::poses;
use crate::rounding::results::Arguments;

/// Positions of each mechanism, if no number is asked for.
const POSITIONS: usize = 200;

fn positions_are_within_their_bounds(of: &dyn Listed<f64>) {
    let (in_bounds, precise) = (same_as(scalars::rounded(), of), same_as(scalars::doubled(), of));
    let mut ratios = Vec::new();
    for plain in Oracle::of(of).samples(poses(POSITIONS)).map(arguments) {
        let Ok(pose) = of.with_parameters(&plain.parameters).position(&plain.q, 0) else { continue };
        let plain = Arguments { q: pose.coordinates(), ..plain };
        let (rounded, doubled) = (plain.map(Rounded::from), plain.map(DoubleDouble::from));
        let found = in_bounds.with_parameters(&rounded.parameters).position(&rounded.q, 0);
        let exact = precise.with_parameters(&doubled.parameters).position(&doubled.q, 0);
        let (Ok(found), Ok(exact)) = (found, exact) else { continue };
        for (found, exact) in found.coordinates().into_iter().zip(exact.coordinates()) {
            let off = (exact - DoubleDouble::from(found.value())).high().abs();
            assert!(
                off <= found.error() * (1.0 + 1e-12),
                "{}: {found:?} is off by {off:e} at {:?}",
                of.file(),
                plain.q
            );
            if off > 0.0 {
                ratios.push(found.error() / off);
            }
        }
    }
    let ratio = median(ratios.iter().copied());
    println!("{}: {} unknowns, median of bound / error {ratio:.1}", of.file(), ratios.len());
    // A bound of the whole search would grow by the condition number in each step.
    assert!(ratio < 100.0 && !ratios.is_empty(), "{ratio}");
}

#[test]
fn from_their_own_solutions() {
    positions_are_within_their_bounds(listed("stephenson_ii", "StephensonII"));
    positions_are_within_their_bounds(listed("double_butterfly", "DoubleButterfly"));
}
