//! Turn 0 of a counted angle is the one in its range.

use std::f64::consts::{PI, TAU};

use linkage::{Branches, Mechanism, Slider, linkage};
use linkage_gallery::sprocket_strand::*;

linkage! {
    /// The strand of the gallery without a range.
    #[derive(Debug, Clone)]
    mechanism Loose {
        param r = 0.5, lever = 0.5, across = 1.75, down = 2.5;
        input theta;
        unknown phi2, s2, c2;
        loop r@phi2 + s2@(phi2 + pi/2) = (across, -down) + lever@theta;
        equation c2 = s2 + r * (phi2 - pi);
    }
    /// With a range from parameters, the strand on the other side.
    #[derive(Debug, Clone)]
    mechanism Ranged {
        param r = 0.5, lever = 0.5, across = 1.75, down = 2.5, from, to;
        input theta;
        unknown phi2 in from..to, s2, c2;
        loop r@phi2 + s2@(phi2 + pi/2) = (across, -down) + lever@theta;
        equation c2 = s2 + r * (phi2 - pi);
    }
}

/// s2 and phi2 from the distance D of the pin and its direction: D^2 = r^2 + s2^2, phi2 = arg D - atan2(s2, r).
fn strand(theta: f64, m: &SprocketStrand<f64>, side: f64) -> [f64; 2] {
    let (x, y) = (m.across + m.lever * theta.cos(), -m.down + m.lever * theta.sin());
    let s2 = side * (x * x + y * y - m.r * m.r).sqrt();
    let phi2 = y.atan2(x) - s2.atan2(m.r);
    [s2, phi2]
}

/// The strand is listed with its arc on the sprocket, not short by its circumference.
#[test]
fn a_counted_angle_is_in_its_range() {
    let (m, loose) = (SprocketStrand::default(), Loose::default());
    for step in 0..72 {
        let theta = f64::from(5 * step).to_radians();
        let all: Vec<_> = m.all_positions(theta.into()).unwrap().collect();
        assert_eq!(all.len(), 2);
        for (branch, q) in all {
            let side = if branch.phi2_s2 == Slider::Far { 1.0 } else { -1.0 };
            let [s2, direction] = strand(theta, &m, side);
            assert!(((q.phi2 - direction) / 2.0).sin().abs() < 1e-15 && (q.s2 - s2).abs() < 1e-15);
            assert_eq!(branch.phi2_turn, 0);
            // The value nearest to the middle of the range.
            assert!((q.phi2 - 1.25 * PI).abs() <= PI, "{}", q.phi2);
            assert_eq!(m.is_within_ranges(&q).unwrap(), branch.phi2_s2 == Slider::Far, "{q:?}");
            assert!((q.c2 - (s2 + m.r * (q.phi2 - PI))).abs() < 1e-14, "{q:?}");
            // The branch of the position reproduces it.
            let pose = m.assemble(theta, branch).unwrap();
            assert_eq!((m.branch_of(&pose), pose.coordinates()), (branch, q));
            assert_eq!(m.kinematics(theta, branch, 1.0, 0.0).unwrap().pose.coordinates(), q);
            assert_eq!(m.assemble_near(&q, branch).unwrap().coordinates(), q);
            let next = m.assemble(theta, SprocketStrandBranch { phi2_turn: 1, ..branch }).unwrap().coordinates();
            assert!((next.phi2 - q.phi2 - TAU).abs() < 4e-15);
            // Without a range the principal value.
            let branch = LooseBranch { phi2_s2: branch.phi2_s2, phi2_turn: 0 };
            let principal = loose.assemble(theta, branch).unwrap().coordinates();
            let turns = f64::from(u8::from(q.phi2 > PI));
            assert!((q.c2 - principal.c2 - turns * TAU * m.r).abs() < 1e-14, "{q:?} {principal:?}");
            if branch.phi2_s2 == Slider::Far {
                assert!(principal.phi2 < 0.0 && (q.c2 - principal.c2 - TAU * m.r).abs() < 1e-14);
            }
        }
    }
}

/// Ranges in any turn, from parameters; one of more than a turn, or without numbers, chooses no turn.
#[test]
fn the_range_chooses_the_turn() {
    let at = |from: f64, to: f64| {
        let m = Ranged { r: 0.5, lever: 0.5, across: 1.75, down: 2.5, from, to };
        let branch = RangedBranch { phi2_s2: Slider::Far, phi2_turn: 0 };
        m.assemble(0.3, branch).unwrap().coordinates().phi2
    };
    let principal = at(-PI, PI);
    assert!(principal.abs() < PI);
    for turn in -3..=3 {
        let by = f64::from(turn) * TAU;
        for (from, to) in [(principal - 0.1, principal + 0.1), (principal - 0.1, principal + 3.0), (-PI, PI)] {
            let found = at(from + by, to + by);
            assert!((found - principal - by).abs() < 1e-14, "{found} {principal} {turn}");
        }
    }
    for (from, to) in [(5.0, 5.0 + 1.01 * TAU), (f64::NAN, 9.0), (5.0, f64::INFINITY), (f64::NEG_INFINITY, -9.0)] {
        assert_eq!(at(from, to), principal, "{from} {to}");
    }
}
