//! Groups at which the search could go wrong: a position is found, or the error says why not.

use std::f64::consts::PI;

use linkage_runtime::PositionError;
use linkage_runtime::modes::Loops;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::modes::group::{Number, ZERO, all, angles, closed, evaluate, nearest, triad, turned};

const PLATFORM: [Number; 2] = [[1.0, 0.4], [0.3, 1.1]];
const LEGS: [f64; 3] = [1.3, -0.9, -1.7];
const PLANTED: [f64; 4] = [0.3, 1.2, -0.7, 2.0];

fn check(factors: [[Number; 4]; 2], planted: &[f64; 4]) {
    let found = all(&closed(factors, planted)).unwrap();
    let error = nearest(&found, planted);
    assert!(error < 1e-12, "{factors:?} misses its position by {error:e} rad");
}

fn is_undetermined(error: &PositionError) -> bool {
    matches!(error, PositionError::Undetermined { mechanism: "Group", group: "t" })
}

fn is_undecided(error: &PositionError) -> bool {
    matches!(error, PositionError::Undecided { mechanism: "Group", group: "t", .. })
}

/// The determinant is zero for every direction of the platform: another direction is kept.
#[test]
fn pins_of_the_platform_coincide() {
    check(triad([PLATFORM[0], PLATFORM[0]], LEGS), &PLANTED);
}

/// A platform congruent to its base on legs of equal length moves while its inputs stand still.
#[test]
fn a_congruent_platform_on_equal_legs() {
    let factors = triad(PLATFORM, [1.3, -1.3, -1.3]);
    check(factors, &PLANTED);
    let error = all(&closed(factors, &[0.0, 1.0, 1.0, 1.0])).unwrap_err();
    assert!(is_undecided(&error) || is_undetermined(&error), "{error}");
}

/// A link of no length has no direction.
#[test]
fn lengths_of_zero() {
    for (platform, legs) in [([ZERO; 2], LEGS), (PLATFORM, [1.3, 0.0, -1.7]), ([ZERO; 2], [0.0; 3])] {
        let error = all(&closed(triad(platform, legs), &PLANTED)).unwrap_err();
        assert!(is_undetermined(&error), "{error}");
    }
}

/// The unit of length does not matter, not even one of each loop.
#[test]
fn any_unit() {
    for unit in [1e-300, 1e-150, 1e-9, 1e150, 1e300] {
        let scaled = triad(PLATFORM, LEGS).map(|row| row.map(|factor| factor.map(|part| part * unit)));
        check(scaled, &PLANTED);
        check([scaled[0], triad(PLATFORM, LEGS)[1]], &PLANTED);
    }
}

/// A leg a billion times as short as the others is found to the digits that its direction has.
#[test]
fn one_length_of_another_size() {
    let found = all(&closed(triad(PLATFORM, [1.3, 1e-9, -1.7]), &PLANTED)).unwrap();
    assert!(nearest(&found, &PLANTED) < 1e-6);
    for length in [1e-300, 1e-150, 1e150, 1e300] {
        let error = all(&closed(triad(PLATFORM, [1.3, length, -1.7]), &PLANTED)).unwrap_err();
        assert!(is_undecided(&error), "{length:e}: {error}");
    }
}

#[test]
fn numbers_that_are_not_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let loops = closed(triad(PLATFORM, LEGS), &PLANTED);
        let mut places = [loops; 3];
        places[0].constants[0][1] = bad;
        places[1].factors[1][0][0] = bad;
        places[2].factors[0][3][1] = bad;
        for loops in places {
            let error = all(&loops).unwrap_err();
            assert!(matches!(error, PositionError::NotFinite { mechanism: "Group", .. }), "{error}");
        }
    }
}

/// Legs that do not reach: no position, and no error.
#[test]
fn out_of_reach() {
    let mut loops = closed(triad(PLATFORM, LEGS), &PLANTED);
    loops.constants[0][0] += 100.0;
    assert_eq!(all(&loops), Ok(Vec::new()));
}

/// Two regular positions with one direction of the platform: a double root of the determinant, with a null space of
/// two dimensions. The second position mirrors the first leg in the line through both far joints.
#[test]
fn two_positions_share_a_direction() {
    let mut random = SmallRng::seed_from_u64(3);
    for _ in 0..500 {
        let (platform, leg, line) =
            (random.random_range(-PI..PI), random.random_range(-PI..PI), random.random_range(-PI..PI));
        let (length, along) = (random.random_range(0.5..1.5), random.random_range(-2.0..2.0));
        let far = [1.2, 1.2 * along].map(|radius| turned(radius, line));
        let others = |leg: f64| {
            let tip = turned(length, leg);
            far.map(|far| [far[0] + tip[0], far[1] + tip[1]])
        };
        let position = |leg: f64| {
            let [second, third] = others(leg).map(|[x, y]| y.atan2(x));
            [platform, leg, second, third]
        };
        let [second, third] = others(leg).map(|[x, y]| -x.hypot(y));
        let (one, other) = (position(leg), position(2.0 * line - leg));
        let found = all(&closed(triad(PLATFORM, [length, second, third]), &one)).unwrap();
        for planted in [one, other] {
            assert!(nearest(&found, &planted) < 1e-6, "{planted:?} is not in {found:?}");
        }
    }
}

/// At a dead point two positions meet, and near it they are closer than rounding error shows: an error, or both.
#[test]
fn positions_that_meet() {
    let count = linkage_trials::count("MEETING", 30, 100);
    let mut random = SmallRng::seed_from_u64(5);
    for from_dead_point in [0.0, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3] {
        let (mut listed, mut undecided) = (0, 0);
        for _ in 0..count {
            let legs = LEGS.map(|length| length * random.random_range(0.5..1.5));
            let factors = triad(PLATFORM, legs);
            let mut position: [f64; 4] = angles(&mut random);
            let Some(dead) = dead_point(&factors, position) else { continue };
            position[3] = dead + from_dead_point;
            match all(&closed(factors, &position)) {
                Ok(found) => {
                    assert!(nearest(&found, &position) < 1e-5);
                    // The position that it meets is there, too.
                    assert!(found.len().is_multiple_of(2), "{found:?}");
                    listed += 1;
                }
                Err(error) => {
                    assert!(is_undecided(&error), "{error}");
                    undecided += 1;
                }
            }
        }
        println!("{from_dead_point:e} rad from a dead point: {listed} listed, {undecided} undecided");
        assert!(10 * (listed + undecided) > 9 * count);
        assert!(from_dead_point > 0.0 || listed == 0);
        assert!(from_dead_point < 1e-4 || undecided == 0);
    }
}

/// The angle of the third leg at which J is singular.
fn dead_point(factors: &[[Number; 4]; 2], position: [f64; 4]) -> Option<f64> {
    let determinant = |third: f64| {
        let angles = [position[0], position[1], position[2], third];
        let (_, _, columns) = evaluate(&Loops { constants: [ZERO; 2], factors: *factors }, angles);
        linkage_runtime::nalgebra::SMatrix::<f64, 4, 4>::from_fn(|row, column| columns[column][row]).determinant()
    };
    let (mut low, mut high) = (-PI / 2.0, PI / 2.0);
    let is_positive = determinant(low) > 0.0;
    (is_positive != (determinant(high) > 0.0)).then_some(())?;
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if (determinant(middle) > 0.0) == is_positive { low = middle } else { high = middle }
    }
    Some(low)
}
