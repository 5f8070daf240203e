//! Groups of two and three loops, whose positions are listed by number: numbers change places while all positions are
//! regular, and a full turn may end on another mode.

use std::f64::consts::TAU;

use linkage::circuits::{CircuitOptions, Circuits, CurveEnd};
use linkage::continuation::Options;
use linkage::position::newton;
use linkage::{Branches, D, Mechanism, linkage};

use linkage_gallery::double_butterfly::*;
use linkage_gallery::stephenson_ii::*;

use crate::by_steps::partition;
use crate::{circuits, counts};

linkage! {
    /// Stephenson III, driven by the far link of its dyad: no loop has two unknowns only.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Triad {
        param a = 1.3, b = 1.1, c = 4.4, d = 4.6, px = -1.2, py = -3.7, e = 5.1, f = 5.2, fx = 1.5, fy = 0.5;
        input theta;
        unknown alpha, beta, gamma, epsilon;
        loop a@alpha + b@beta = d@0 + c@gamma;
        loop a@alpha + (px, py)@beta + e@epsilon = (fx, fy) + f@theta;
    }
}

/// The positions of a turn in small steps, by Newton's method from the one before; all are on one branch.
fn by_newton<M: Mechanism<Scalar = f64, V = D<1>>>(m: &M, start: &M::Coordinates, steps: u32) -> Vec<M::Coordinates> {
    let input = M::inputs(start)[0];
    let first = m.pose_at(start);
    let mut all = vec![*start];
    for step in 1..=steps {
        let guess = M::with_inputs(&all[all.len() - 1], [input + TAU * f64::from(step) / f64::from(steps)].into());
        let q = newton(m, &guess).unwrap().coordinates;
        assert!(m.same_branch(&first, &m.pose_at(&q)), "{q:?}");
        all.push(q);
    }
    all
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

/// A turn of the crank without a dead point from mode 0 is at mode 3, a second one is back at mode 0.
#[test]
fn full_turn_ends_on_another_mode() {
    let m = Triad::default();
    let found = circuits(&m, 0.5);
    assert_eq!(counts(&found), [4, 2, 2]);
    for (motion, modes) in found.motions.iter().zip([[0, 3], [1, 2]]) {
        assert_eq!((motion.end, motion.dead_points().count()), (CurveEnd::Closed { turns: 2 }, 0));
        assert_eq!(motion.modes().collect::<Vec<_>>(), modes);
        // Far from a dead point all the way.
        let determinants = motion.points.iter().map(|at| m.determinant(&m.pose_at(&at.position)).abs());
        let [least, most] = [determinants.clone().fold(f64::INFINITY, f64::min), determinants.fold(0.0, f64::max)];
        println!("{least} {most}");
        assert!(least > 0.01 * most, "{least} {most}");
        // By Newton's method in small steps.
        let mut mode = modes[0];
        for next in [modes[1], modes[0]] {
            let turn = by_newton(&m, &found.modes[mode].position, 2000);
            assert_eq!(number(&m, &turn[2000]), next);
            mode = next;
        }
    }
    assert_eq!(partition(&m, 0.5, 500), [0, 1, 1, 0]);
    // With shorter steps of the path the same.
    let path = Options { longest_step: 0.02, ..Options::default() };
    let fine = Circuits::of(&m, 0.5, CircuitOptions { path, ..CircuitOptions::default() }).unwrap();
    assert_eq!(fine.motions.iter().map(|motion| motion.full_turns()).collect::<Vec<_>>(), [2, 2]);
}

#[test]
fn search_exchange() {
    let m = Triad::default();
    let found = circuits(&m, 0.5);
    let turns: Vec<Vec<TriadCoordinates>> = found.modes.iter().map(|mode| by_newton(&m, &mode.position, 400)).collect();
    for i in 0..4 { for j in 0..i {
        for step in 0..400 {
            let gap = |step: usize| turns[i][step].alpha - turns[j][step].alpha;
            let wrap = |x: f64| x - TAU * (x / TAU).round();
            let (a, b) = (wrap(gap(step)), wrap(gap(step + 1)));
            if a * b < 0.0 && (a - b).abs() < 1.0 {
                println!("{i} {j} {step} {} {a} {b} {} {}", turns[i][step].theta, number(&m, &turns[i][step]), number(&m, &turns[i][step+1]));
            }
        }
    }}
    for crank in [0.0, 1.0, 2.5] {
        let found = circuits(&DoubleButterfly::default(), crank);
        println!("butterfly {crank} {:?} {:?}", counts(&found), found.motions.iter().map(|m| (m.full_turns(), m.modes().collect::<Vec<_>>(), m.dead_points().count())).collect::<Vec<_>>());
        println!("{:?}", partition(&DoubleButterfly::default(), crank, 300));
    }
    for theta in [0.1, 2.0, 4.0] {
        let found = circuits(&StephensonII::default(), theta);
        println!("ii {theta} {:?} {:?}", counts(&found), found.motions.iter().map(|m| (m.full_turns(), m.modes().collect::<Vec<_>>(), m.dead_points().count())).collect::<Vec<_>>());
        println!("{:?}", partition(&StephensonII::default(), theta, 500));
    }
}
