//! Groups of two and three loops, whose positions are listed by number: numbers change places while all positions are
//! regular, and a full turn may end on another mode.

use std::f64::consts::TAU;

use linkage::circuits::{CircuitOptions, Circuits, CurveEnd, CurveEvent};
use linkage::position::newton;
use linkage::{Branches, D, Mechanism, linkage};

use linkage_gallery::double_butterfly::*;
use linkage_gallery::stephenson_ii::*;

use crate::circuits::by_steps::partition;
use crate::circuits::{circuits, counts};

linkage! {
    /// Stephenson III, driven by the far link of its dyad: no loop has two unknowns only. The dimensions are one of 13
    /// cases among 1500 at random with a full turn that ends on another mode.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Triad {
        param a = 4.9, b = 1.23, c = 4.18, d = 1.52, px = 0.83, py = -2.31, e = 4.26, f = 2.25, fx = 2.04, fy = 1.17;
        input theta;
        unknown alpha, beta, gamma, epsilon;
        loop a@alpha + b@beta = d@0 + c@gamma;
        loop a@alpha + (px, py)@beta + e@epsilon = (fx, fy) + f@theta;
    }
}

/// Positions in small steps of the input, by Newton's method from the one before; all are on one branch.
fn by_newton<M: Mechanism<Scalar = f64, V = D<1>>>(
    m: &M,
    start: &M::Coordinates,
    turned: f64,
    steps: u32,
) -> Vec<M::Coordinates> {
    let input = M::inputs(start)[0];
    let first = m.pose_at(start);
    let mut all = vec![*start];
    for step in 1..=steps {
        let next = input + turned * f64::from(step) / f64::from(steps);
        let q = newton(m, &M::with_inputs(&all[all.len() - 1], [next].into())).unwrap().coordinates;
        assert!(m.same_branch(&first, &m.pose_at(&q)), "{q:?}");
        all.push(q);
    }
    all
}

/// The least determinant divided by the largest.
fn regularity<M: Mechanism<Scalar = f64, V = D<1>>>(m: &M, motion: &[M::Coordinates]) -> f64 {
    let determinants = motion.iter().map(|q| m.determinant(&m.pose_at(q)).abs());
    determinants.clone().fold(f64::INFINITY, f64::min) / determinants.fold(0.0, f64::max)
}

/// The number of a position among all at its input.
fn number<M: Branches<Scalar = f64, V = D<1>>>(m: &M, q: &M::Coordinates) -> usize {
    let is_here = |other: &M::Coordinates| {
        let off = M::unknowns(q) - M::unknowns(other);
        off.iter().all(|off| (off / 2.0).sin().abs() < 1e-7)
    };
    let all: Vec<M::Coordinates> = m.all_positions(M::inputs(q).into()).unwrap().map(|(_, other)| other).collect();
    let found: Vec<usize> = (0..all.len()).filter(|&place| is_here(&all[place])).collect();
    assert_eq!(found.len(), 1, "{q:?} in {all:?}");
    found[0]
}

/// A turn of the crank from mode 1, far from a dead point all the way, is at mode 3. There it goes on to a dead point: the
/// crank turns once in the whole motion, and mode 2 is passed backwards.
#[test]
fn full_turn_ends_on_another_mode() {
    let m = Triad::default();
    let found = circuits(&m, 0.5);
    assert_eq!(counts(&found), [4, 2, 0]);
    let motion = &found.motions[1];
    let events: Vec<_> = motion
        .points
        .iter()
        .filter_map(|point| match point.event? {
            CurveEvent::Mode(mode) => Some(mode),
            _ => None,
        })
        .collect();
    assert_eq!(events, [Some(1), Some(3), Some(2)]);
    assert_eq!(motion.end, CurveEnd::Closed { turns: 1 });
    let meetings: Vec<_> = motion.dead_points().map(|at| at.modes).collect();
    assert_eq!(meetings, [[Some(3), Some(2)], [Some(2), Some(1)]]);
    // Between its first and last dead point the other motion does not pass the start input.
    let meetings: Vec<_> = found.motions[0].dead_points().map(|at| at.modes).collect();
    assert_eq!(meetings, [[Some(0), None], [None; 2], [None; 2], [None, Some(0)]]);
    // By Newton's method.
    let turn = by_newton(&m, &found.modes[1].position, TAU, 1000);
    assert!(regularity(&m, &turn) > 0.3);
    assert_eq!([&turn[0], &turn[1000]].map(|q| number(&m, q)), [1, 3]);
    assert_eq!(partition(&m, 0.5, 500), found.modes.iter().map(|mode| mode.motion).collect::<Vec<_>>());
}

/// The first unknowns of modes 0 and 1 are equal near 0.641 rad and near 1.128 rad: there the modes change places, while
/// both are regular.
#[test]
fn modes_change_places_while_regular() {
    let m = Triad::default();
    let found = circuits(&m, 0.5);
    let motions = [0, 1].map(|mode| by_newton(&m, &found.modes[mode].position, 0.8, 80));
    assert!(
        motions.iter().all(|motion| regularity(&m, motion) > 0.2),
        "{:?}",
        motions.map(|motion| regularity(&m, &motion))
    );
    let numbers = |step: usize| [0, 1].map(|mode: usize| number(&m, &motions[mode][step]));
    // At 0.5, 0.8 and 1.3 rad.
    assert_eq!([0, 30, 80].map(numbers), [[0, 1], [1, 0], [0, 1]]);
    let apart = |step: usize| motions[0][step].alpha - motions[1][step].alpha;
    assert!((0..=80).all(|step| apart(step).abs() < 0.1) && apart(0) < 0.0 && apart(30) > 0.0);
}

/// The modes of each motion are those that small steps of the listed positions connect.
#[test]
fn groups_of_two_and_three_loops_by_small_steps() {
    let butterfly = DoubleButterfly::default();
    for (crank, modes) in [(0.0, 8), (1.0, 8), (2.5, 10)] {
        let found = circuits(&butterfly, crank);
        assert_eq!(counts(&found), [modes, 7, 5], "{crank}");
        let motions: Vec<usize> = found.modes.iter().map(|mode| mode.motion).collect();
        assert_eq!(motions, partition(&butterfly, crank, 200), "{crank}");
    }
    let six_bar = StephensonII::default();
    for (theta, expected) in [(0.1, [4, 3, 2]), (2.0, [4, 3, 2]), (4.0, [2, 2, 2])] {
        let found = circuits(&six_bar, theta);
        assert_eq!(counts(&found), expected, "{theta}");
        let motions: Vec<usize> = found.modes.iter().map(|mode| mode.motion).collect();
        assert_eq!(motions, partition(&six_bar, theta, 500), "{theta}");
    }
}

/// The number of positions of the double butterfly along the turn: it changes by two at the dead points of its circuits and
/// nowhere else.
#[test]
fn positions_of_the_double_butterfly_along_the_turn() {
    let m = DoubleButterfly::default();
    let starts: Vec<f64> = (0..12).map(|step| 0.2 + TAU / 12.0 * f64::from(step)).collect();
    let found = Circuits::over(&m, starts, CircuitOptions::default()).unwrap();
    let meetings = found.motions.iter().flat_map(|motion| motion.dead_points().collect::<Vec<_>>());
    let mut dead_points: Vec<f64> = meetings.map(|meeting| meeting.point.input.rem_euclid(TAU)).collect();
    dead_points.sort_by(f64::total_cmp);
    dead_points.dedup_by(|next, last| *next - *last < 1e-9);
    let count = |crank: f64| m.branches(crank).unwrap().count();
    let next = dead_points.iter().skip(1).copied().chain([dead_points[0] + TAU]);
    let stretches: Vec<(f64, usize)> = dead_points
        .iter()
        .zip(next)
        .map(|(&from, to)| {
            let counts: Vec<usize> = (1..20).map(|part| count(from + (to - from) * f64::from(part) / 20.0)).collect();
            assert!(counts.iter().all(|one| *one == counts[0]), "{counts:?} from {from} to {to}");
            (from, counts[0])
        })
        .collect();
    println!("{stretches:?}");
    let last = stretches.last().map(|(_, count)| *count);
    let before = last.into_iter().chain(stretches.iter().map(|(_, count)| *count));
    assert!(before.zip(&stretches).all(|(before, (_, after))| before.abs_diff(*after) == 2), "{stretches:?}");
}
