//! The modes of each motion and its dead points.

use std::f64::consts::TAU;

use linkage::circuits::{CircuitOptions, Circuits, CurveEnd};
use rand::SeedableRng;
use rand::rngs::SmallRng;

use crate::by_continuation::continuation::{End, Passed};
use crate::by_continuation::count;
use crate::by_continuation::families::{Family, Slider, Stephenson, Watt, start};

/// The outcomes of a family.
#[derive(Debug, Default)]
struct Tally {
    linkages: usize,
    motions: usize,
    dead_points: usize,
    /// Without a position at the start input.
    empty: usize,
    /// Typed errors at singular positions.
    singular: usize,
    /// Other typed errors.
    errors: usize,
    /// Motions that the continuation did not close, or on which it went to and fro at a change point.
    undecided: usize,
    /// Motions without a turn whose dead points are odd in number.
    odd: usize,
    /// Motions with other modes or other dead points.
    wrong: usize,
}

/// The difference of two inputs, modulo whole turns.
fn apart(one: f64, other: f64) -> f64 {
    let off = one - other;
    (off - TAU * (off / TAU).round()).abs()
}

fn compare<M: Family>(seed: u64) -> Tally {
    let random = &mut SmallRng::seed_from_u64(seed);
    let mut tally = Tally::default();
    for number in 0..count() {
        let (m, input) = (M::random(random, number % 2 == 1), start(random));
        let found = match Circuits::of(&m, input, CircuitOptions::default()) {
            Ok(found) => found,
            Err(error) => {
                // A motion may consist of singular positions.
                let modes = m.all_positions(M::Inputs::from([input].into())).unwrap();
                let least = modes.map(|(_, q)| m.equations().regularity(&M::position(&q))).fold(1.0, f64::min);
                println!("{number} {input} {m:?}: regularity {least}, {error}");
                tally.singular += usize::from(least < 1e-7);
                tally.errors += usize::from(least >= 1e-7);
                continue;
            }
        };
        tally.linkages += 1;
        tally.empty += usize::from(found.modes.is_empty());
        let equations = m.equations();
        let positions: Vec<_> = found.modes.iter().map(|mode| M::position(&mode.position)).collect();
        for (place, motion) in found.motions.iter().enumerate() {
            tally.motions += 1;
            let mut dead: Vec<f64> = motion.dead_points().map(|at| at.point.input).collect();
            let mut reversals = dead.len();
            tally.dead_points += dead.len();
            let (mut modes, mut others) = (Vec::new(), Vec::new());
            let first = found.modes.iter().position(|mode| mode.motion == place).unwrap();
            modes.push(first);
            let end = equations.follow(&positions[first], 1.0, |passed| {
                match passed {
                    Passed::Start(at) => {
                        modes.push(positions.iter().position(|of| equations.are_one(of, &at)).unwrap_or(usize::MAX));
                    }
                    Passed::DeadPoint(at) => others.push(at[0]),
                    Passed::Step(_) => {}
                }
                false
            });
            let mut inputs = others.clone();
            inputs.sort_by(f64::total_cmp);
            let repeats = inputs.windows(3).any(|three| three[2] - three[0] < 1e-9);
            if end != End::Closed || repeats {
                println!("{end:?} {number} {input} {m:?}: {others:?}");
                tally.undecided += 1;
                continue;
            }
            modes.sort_unstable();
            let mut expected: Vec<usize> = motion.modes().collect();
            expected.sort_unstable();
            expected.dedup();
            modes.dedup();
            let mut left = others.clone();
            dead.retain(|&dead| match left.iter().position(|&other| apart(dead, other) < 1e-6) {
                Some(place) => {
                    left.swap_remove(place);
                    false
                }
                None => true,
            });
            // At a change point the input may reverse, too.
            left.retain(|&other| {
                let is_change = motion.change_points().any(|at| apart(at.point.input, other) < 1e-3);
                reversals += usize::from(is_change);
                !is_change
            });
            if motion.end == (CurveEnd::Closed { turns: 0 }) && reversals % 2 == 1 {
                println!(
                    "odd {number} {input} {m:?}: {:?}",
                    motion.dead_points().map(|at| at.point.input).collect::<Vec<_>>()
                );
                tally.odd += 1;
            }
            if modes != expected || !dead.is_empty() || !left.is_empty() {
                println!(
                    "{number} {input} {m:?}: modes {expected:?}, by steps {modes:?}; dead points {dead:?}, by steps {left:?}"
                );
                let change: Vec<f64> = motion.change_points().map(|at| at.point.input).collect();
                println!("   change points {change:?}");
                tally.wrong += 1;
            }
        }
    }
    println!("{} {tally:?}", std::any::type_name::<M>());
    tally
}

#[test]
fn circuits_of_random_linkages() {
    for tally in [compare::<Stephenson>(1), compare::<Watt>(2), compare::<Slider>(3)] {
        assert!(200 * (tally.undecided + tally.singular) <= tally.linkages.max(1000), "{tally:?}");
        assert_eq!([tally.errors, tally.odd, tally.wrong], [0; 3]);
    }
}
