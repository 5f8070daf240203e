//! Groups with infinitely many positions, some with others apart from them, and groups that only seem to have them.

use std::f64::consts::PI;

use linkage_runtime::PositionError;
use linkage_runtime::modes::{AssemblyMode, Memory, Unknown};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::modes::group::{Number, ZERO, all, angles, closed, nearest, turned};
use crate::modes::lengths::Sliding;

fn is_undetermined(error: &PositionError) -> bool {
    matches!(error, PositionError::Undetermined { mechanism: "Group", group: "t" })
}

/// Two loops that combine two dyads: both positions of one have each direction of the other. A determinant in one direction
/// has only double roots, although each position is regular.
#[test]
fn combinations_of_two_dyads() {
    let mut random = SmallRng::seed_from_u64(1);
    for _ in 0..linkage_trials::count("DYADS", 100, 500) {
        let mut link = || turned(random.random_range(0.2..2.0), random.random_range(-PI..PI));
        let dyads: [[Number; 4]; 2] = [[link(), link(), ZERO, ZERO], [ZERO, ZERO, link(), link()]];
        let weights: [[f64; 2]; 2] = [[1.0, random.random_range(-1.0..1.0)], [random.random_range(-0.5..0.5), 1.0]];
        let combined: [[Number; 4]; 2] = weights.map(|[one, other]| {
            let part = |place: usize, axis: usize| one * dyads[0][place][axis] + other * dyads[1][place][axis];
            std::array::from_fn(|place| [part(place, 0), part(place, 1)])
        });
        let planted = angles(&mut random);
        let found = all(&closed(combined, &planted)).unwrap();
        assert_eq!(found.len(), 4, "{planted:?}");
        assert!(nearest(&found, &planted) < 1e-9);
    }
}

/// A pin of a slotted link that lies in its pivot, at one position of the dyad that carries it: there the guide turns freely.
/// The positions at the other one of the dyad are apart from these, and are listed.
#[test]
fn a_family_and_positions_apart_from_it() {
    // k + 2 t1 + 1.5 t3 = 0, and s t0 = p + q t1, which is zero at the planted t1.
    let factors = [[ZERO, [0.8, 0.0], ZERO, ZERO], [ZERO, [2.0, 0.0], ZERO, [1.5, 0.0]]];
    let along = [-1.0, 0.0];
    let are = [Unknown::Angle, Unknown::Angle, Unknown::Length { in_loop: 0, along, with: Some(0) }, Unknown::Angle];
    let planted = [0.7, 1.1, 0.0, -0.4];
    let group = Sliding::new(factors, are, &planted);
    let mut memory = Memory::default();
    let modes = memory
        .modes_with_lengths("Group", "t", group.loops, group.are, |all| all, |all| group.evaluate(all))
        .expect("the other position of the dyad is regular");
    assert!(modes.has_family());
    // Along one line, in both senses.
    assert_eq!(modes.as_slice().len(), 2);
    let [one, other] = [modes.as_slice()[0], modes.as_slice()[1]];
    assert!((one[1] - other[1]).abs() < 1e-12 && (one[1] - planted[1]).abs() > 0.1, "{one:?} {other:?}");
    assert!((one[2] + other[2]).abs() < 1e-12 && ((one[0] - other[0]).abs() - PI).abs() < 1e-12, "{one:?} {other:?}");
    assert_eq!(modes.take("Group", "t", AssemblyMode::Number(1)), Ok(other));
    assert!(is_undetermined(&modes.take("Group", "t", AssemblyMode::Number(2)).unwrap_err()));
}

/// A guide of no direction leaves its length free: infinitely many positions if the loop closes without it, else none.
#[test]
fn a_guide_without_direction() {
    let factors: [[Number; 4]; 2] = [[[1.0, 0.0], [0.7, 0.2], ZERO, ZERO], [[0.3, 0.4], [0.5, 0.0], ZERO, [0.9, 0.0]]];
    let are =
        [Unknown::Angle, Unknown::Angle, Unknown::Length { in_loop: 0, along: [0.0; 2], with: None }, Unknown::Angle];
    let mut group = Sliding::new(factors, are, &[0.3, 1.2, 0.5, -0.7]);
    assert!(is_undetermined(&group.all().unwrap_err()));
    group.loops.constants[1][0] += 0.1;
    assert_eq!(group.all(), Ok(Vec::new()));
    group.are[2] = Unknown::Length { in_loop: 0, along: [f64::INFINITY, 0.0], with: None };
    assert!(matches!(group.all(), Err(PositionError::NotFinite { mechanism: "Group", .. })));
}

/// Links that are too short for the rounding error of their loop do not make infinitely many positions.
#[test]
fn short_links_are_no_family() {
    for length in [1e-13, 1e-16, 1e-20, 1e-200] {
        let factors = [[[1.0, 0.4], [1.3, 0.0], [length, 0.0], ZERO], [[0.3, 1.1], [1.3, 0.0], ZERO, [-1.7, 0.0]]];
        let planted = [0.3, 1.2, -0.7, 2.0];
        match all(&closed(factors, &planted)) {
            Ok(found) => assert!(nearest(&found, &planted) < 1e-15 / length, "{length:e}: {found:?}"),
            Err(error) => assert!(matches!(error, PositionError::Undecided { .. }), "{length:e}: {error}"),
        }
    }
}

/// The unit of a direction does not matter.
#[test]
fn any_size_of_a_direction() {
    let factors: [[Number; 4]; 2] = [[[1.0, 0.0], [0.7, 0.2], ZERO, ZERO], [[0.3, 0.4], [0.5, 0.0], ZERO, [0.9, 0.0]]];
    let position = [0.3, 1.2, 0.5, -0.7];
    let of = |unit: f64, with: Option<usize>| {
        let length = Unknown::Length { in_loop: 0, along: [0.6 * unit, 0.3 * unit], with };
        let are = [Unknown::Angle, Unknown::Angle, length, Unknown::Angle];
        let planted = [position[0], position[1], position[2] / unit, position[3]];
        (Sliding::new(factors, are, &planted).all().unwrap(), planted)
    };
    for with in [None, Some(0)] {
        let (all, _) = of(1.0, with);
        for exponent in [-250, -60, 60, 250] {
            let unit = 2_f64.powi(exponent);
            let (found, planted) = of(unit, with);
            assert_eq!(found.len(), all.len());
            let is_planted = |one: &[f64; 4]| (0..4).all(|place| (one[place] / planted[place] - 1.0).abs() < 1e-12);
            assert!(found.iter().any(is_planted), "{exponent}: {found:?}");
        }
    }
}
