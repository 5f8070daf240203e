//! Mechanisms with a slider on a guide that turns with an unknown angle: all positions are listed, whatever coincides.
//!
//! `GUIDES=1000000 cargo test --release --test positions turning_guides` for a larger number of random mechanisms.

use std::f64::consts::{PI, TAU};

use linkage::position::hadamard_ratio;
use linkage::{Mechanism, PositionError, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

linkage! {
    /// A slider on a guide that turns with a link, and one along a given line, in three loops.
    #[derive(Debug)]
    mechanism Three {
        param a = 2, b = 1, d = 0.5, h = -1.5, px = 0, py = 0, e = 8.5, n = -0.5, tilt = 0.5, qx = 1, qy = 3, g = 8;
        input v;
        unknown p, q, s, r, m, u;
        loop a@v + b@p = d@0 + (s, h)@q;
        loop a@v + (px, py)@p + e@r = (m, n)@tilt;
        loop d@0 + (qx, qy)@q + g@u = (m, n)@tilt;
    }

    /// A slider on a guide that turns with a link, in two loops.
    #[derive(Debug)]
    mechanism Two {
        param a = 2, b = 1, d = 0.5, h = -1.5, px = 0, py = 0, e = 8.5, qx = 1, qy = 3;
        input v;
        unknown p, q, s, r;
        loop a@v + b@p = d@0 + (s, h)@q;
        loop a@v + (px, py)@p + e@r = d@0 + (qx, qy)@q;
    }

    /// Two sliders on one guide that turns.
    #[derive(Debug)]
    mechanism Both {
        param a = 2, b = 1, d = 0.5, h = -1.5, px = 1, py = 0.5, x = 1, y = 2, k = 0.5;
        input v;
        unknown p, q, s, t;
        loop a@v + b@p = d@0 + (s, h)@q;
        loop a@v + (px, py)@p = (x, y) + (t, k)@q;
    }

    /// Three sliders on one guide that turns.
    #[derive(Debug)]
    mechanism Triple {
        param a = 2, b = 1, d = 0.5, h = -1.5, px = 1, py = 0.5, x = 1, y = 2, k = 0.5, e = 1.5, f = 1, z = 0.5, l = 0.25;
        input v;
        unknown p, q, r, s, t, u;
        loop a@v + b@p = d@0 + (s, h)@q;
        loop a@v + (px, py)@p + e@r = (x, y) + (t, k)@q;
        loop f@v + e@r = (z, x) + (u, l)@q;
    }
}

/// |det J| divided by the product of the norms of its columns.
fn regularity<M: Mechanism<Scalar = f64>>(mechanism: &M, pose: &M::Pose) -> f64 {
    hadamard_ratio(mechanism.determinant(pose), &mechanism.jacobian_unknowns(pose))
}

fn is_same_angle(one: f64, other: f64) -> bool {
    let turn = one - other;
    (turn - (turn / TAU).round() * TAU).abs() < 1e-4
}

/// With the guide's angle free of p, both positions of p are at each direction of the guide: no direction has a single one.
/// The position was computed independently, by Newton's method in 40 digits.
#[test]
fn both_positions_of_a_link_at_each_direction_of_the_guide() {
    let m = Three::default();
    let all: Vec<_> = m.branches(1.5).unwrap().collect();
    assert_eq!(all.len(), 4);
    let is_known = |q: &ThreeCoordinates| {
        let lengths = [(q.s, -2.628), (q.m, 9.2955)];
        let angles = [(q.p, -48.471), (q.q, 10.670), (q.r, 0.2403), (q.u, -5.449)];
        lengths.iter().all(|(one, other)| (one - other).abs() < 1e-3)
            && angles.iter().all(|(one, other)| ((one - other) / 2.0).sin().abs() < 1e-3)
    };
    assert_eq!(all.iter().filter(|one| is_known(&one.pose.coordinates())).count(), 1);
    for one in &all {
        assert!(regularity(&m, &one.pose) > 0.1);
        assert_eq!(m.assemble(1.5, one.branch).unwrap().coordinates(), one.pose.coordinates());
    }
}

/// Three guides in one direction have the third power of it in the determinant: no index is out of range.
#[test]
fn three_sliders_on_one_guide() {
    let m = Triple::default();
    let mut most = 0;
    for step in 0..40 {
        let v = 0.157 * f64::from(step);
        let all: Vec<_> = m.branches(v).unwrap().collect();
        most = most.max(all.len());
        for one in &all {
            for (residual, scale) in m.residual(&one.pose).iter().zip(&m.residual_scales(&one.pose)) {
                assert!(residual.abs() <= 4.0 * f64::EPSILON * scale);
            }
        }
    }
    assert!(most >= 2, "{most}");
}

#[derive(Debug, Clone, Copy)]
enum Class {
    Usual,
    Round,
    Short,
    Extreme,
    Coincident,
}

const CLASSES: [Class; 5] = [Class::Usual, Class::Round, Class::Short, Class::Extreme, Class::Coincident];

impl Class {
    /// Some lengths.
    fn lengths<const N: usize>(self, random: &mut SmallRng) -> [f64; N] {
        let mut all = std::array::from_fn(|_| match self {
            Self::Round => 0.5 * f64::from(random.random_range(1..=16)),
            Self::Extreme => 10_f64.powf(random.random_range(-2.0..1.0)),
            _ => random.random_range(0.5..4.0),
        });
        match self {
            Self::Short => all[random.random_range(0..N)] *= 1e-3,
            // All are the same.
            Self::Coincident if random.random_bool(0.5) => all = [all[0]; N],
            _ => {}
        }
        all
    }

    /// A joint on a link: in the class of coincident joints it lies in the first one in half of the mechanisms.
    fn joint(self, random: &mut SmallRng) -> [f64; 2] {
        let [x, y] = self.lengths(random);
        match self {
            Self::Coincident if random.random_bool(0.5) => [0.0; 2],
            Self::Round if random.random_bool(0.3) => [0.0; 2],
            _ => [x, -y],
        }
    }
}

fn sum(parts: &[[f64; 2]]) -> [f64; 2] {
    parts.iter().fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    [x * cosine - y * sine, x * sine + y * cosine]
}

fn negative([x, y]: [f64; 2]) -> [f64; 2] {
    [-x, -y]
}

/// The planted position is listed, or an error is true: it says `Undecided` near a singular position, `Undetermined` of a
/// position that is singular.
macro_rules! is_listed {
    ($m:expr, $v:expr, $planted:expr, $Coordinates:ident, [$($angle:ident)+], [$($length:ident)+], $counts:expr) => {{
        let (m, v, planted) = (&$m, $v, $planted);
        let regularity = regularity(m, &m.pose_at(&planted));
        match m.branches(v).map(|all| all.map(|one| one.pose.coordinates()).collect::<Vec<_>>()) {
            Ok(all) => {
                let is_planted = |q: &$Coordinates| {
                    let size = [$(planted.$length.abs()),+].into_iter().fold(1.0, f64::max);
                    let lengths = [$(q.$length - planted.$length),+];
                    $(is_same_angle(q.$angle, planted.$angle))&&+ && lengths.iter().all(|off| off.abs() < 1e-4 * size)
                };
                if all.iter().any(is_planted) {
                    $counts[0] += 1;
                } else {
                    assert!(regularity < 1e-7, "{regularity:e}: {m:?} at {v} has {planted:?}, not in {all:?}");
                    $counts[1] += 1;
                }
            }
            Err(PositionError::Undecided { regularity, .. }) => {
                assert!(regularity < 1e-3, "{regularity:e}: {m:?} at {v} has {planted:?}");
                $counts[2] += 1;
            }
            Err(error) => panic!("{error}: {m:?} at {v}"),
        }
    }};
}

/// Mechanisms with planted positions; a twentieth as many from random starts.
fn count() -> usize {
    linkage_trials::count("GUIDES", 600, 3000)
}

#[test]
fn planted_positions() {
    let count = count();
    let random = &mut SmallRng::seed_from_u64(44);
    let mut counts = [[0; 3]; CLASSES.len()];
    for case in 0..count {
        let class = CLASSES[case % CLASSES.len()];
        let counts = &mut counts[case % CLASSES.len()];
        let mut angle = || random.random_range(-PI..PI);
        let [v, p, q, r, u, tilt] = [angle(), angle(), angle(), angle(), angle(), angle()];
        let [a, b, d, e, g] = class.lengths(random);
        let [px, py] = class.joint(random);
        // (s, h)@q, the joint of the crank and p from the pivot of the guide.
        let crank = turned([a, 0.0], v);
        let [s, h] = turned(sum(&[crank, turned([b, 0.0], p), [-d, 0.0]]), -q);
        let tip = sum(&[crank, turned([px, py], p), turned([e, 0.0], r)]);
        if case % 2 == 0 {
            let [m, n] = turned(tip, -tilt);
            let [qx, qy] = turned(sum(&[tip, [-d, 0.0], negative(turned([g, 0.0], u))]), -q);
            let mechanism = Three { a, b, d, h, px, py, e, n, tilt, qx, qy, g };
            is_listed!(mechanism, v, ThreeCoordinates { v, p, q, s, r, m, u }, ThreeCoordinates, [p q r u], [s m], counts);
        } else if case % 4 == 1 {
            let [qx, qy] = turned(sum(&[tip, [-d, 0.0]]), -q);
            let mechanism = Two { a, b, d, h, px, py, e, qx, qy };
            is_listed!(mechanism, v, TwoCoordinates { v, p, q, s, r }, TwoCoordinates, [p q r], [s], counts);
        } else {
            let [x, y] = class.joint(random);
            let joint = sum(&[crank, turned([px, py], p)]);
            let [t, k] = turned(sum(&[joint, [-x, -y]]), -q);
            let mechanism = Both { a, b, d, h, px, py, x, y, k };
            is_listed!(mechanism, v, BothCoordinates { v, p, q, s, t }, BothCoordinates, [p q], [s t], counts);
        }
    }
    for (class, [listed, singular, undecided]) in CLASSES.iter().zip(counts) {
        println!("{class:?}: {listed} listed, {singular} singular and not listed, {undecided} undecided");
        assert!(undecided <= 2 + listed / 500);
    }
}

/// All lengths and the input are multiples of 1/2 and 1/4: no regular position that Newton's method finds is left out.
#[test]
fn round_lengths_against_random_starts() {
    let count = count() / 20;
    let random = &mut SmallRng::seed_from_u64(45);
    let (mut reached, mut empty) = (0, 0);
    for _ in 0..count {
        let mut round = |least: i32| 0.5 * f64::from(random.random_range(least..=16));
        let [a, b, d, e, g] = std::array::from_fn(|_| round(1));
        let [h, px, py, n, qx, qy] = std::array::from_fn(|_| round(-16)).map(|length| 0.25 * length);
        let (v, tilt) = (round(0), 0.25 * round(0));
        let m = Three { a, b, d, h, px: px.floor(), py: py.floor(), e, n, tilt, qx, qy: qy.floor(), g };
        let all = match m.branches(v) {
            Ok(all) => all.map(|one| one.pose.coordinates()).collect::<Vec<_>>(),
            Err(error) => {
                assert!(
                    matches!(error, PositionError::Undecided { regularity, .. } if regularity < 1e-3),
                    "{error}: {m:?}"
                );
                continue;
            }
        };
        empty += usize::from(all.is_empty());
        for _ in 0..20 {
            let [p, q, r, u] = std::array::from_fn(|_| random.random_range(-PI..PI));
            let [s, length] = std::array::from_fn(|_| random.random_range(-8.0..8.0));
            let guess = ThreeCoordinates { v, p, q, s, r, m: length, u };
            let Ok(near) = m.assemble_near(&guess, ThreeBranch::default()) else { continue };
            let one = near.coordinates();
            let is_there = |q: &&ThreeCoordinates| {
                let angles = [(q.p, one.p), (q.q, one.q), (q.r, one.r), (q.u, one.u)];
                angles.into_iter().all(|(one, other)| is_same_angle(one, other))
                    && (q.s - one.s).abs() < 1e-4
                    && (q.m - one.m).abs() < 1e-4
            };
            if regularity(&m, &near) > 1e-6 {
                assert_eq!(all.iter().filter(is_there).count(), 1, "{m:?} at {v} has {one:?}, {all:?}");
                reached += 1;
            }
        }
    }
    println!("{count} mechanisms, {empty} without positions, {reached} positions reached");
    assert!(reached > count);
}
