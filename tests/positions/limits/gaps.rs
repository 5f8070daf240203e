//! Gaps next to the start and at the end of a turn, and lengths that are negative.

use std::f64::consts::{PI, TAU};

use linkage::limits::Limit;
use linkage::linkage;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::limits::{exact, free};

linkage! {
    /// The joint of a link f is on a slider that comes nearest to it while the crank passes its inner dead centre.
    #[derive(Debug, Clone)]
    mechanism Toggle {
        param r = 1, l = 3, e = 2, f = 1.99999;
        input v;
        unknown p, s, u, w;
        loop r@v + l@p = s@0;
        loop s@0 + e@u = f@w;
        derive limits;
    }

    /// One length of a dyad may be negative: a link that points the other way.
    #[derive(Debug, Clone)]
    mechanism Opposed {
        param a = 1, b = 3, c = 3, d = 2;
        input v;
        unknown p, r;
        loop a@v + b@p = d@0 + c@r;
        derive limits;
    }

    /// A point at a distance from two others.
    #[derive(Debug, Clone)]
    mechanism Squares {
        param a = 1, b = 3, c = 3, d = 2;
        input v;
        unknown x, y;
        equation dot((x, y) - a@v, (x, y) - a@v) = b^2;
        equation dot((x, y) - (d, 0), (x, y) - (d, 0)) = c^2;
        derive limits;
    }
}

/// s = cos v + sqrt(9 - sin^2 v) is at most 4 - 4.00001 short of e + f = 3.99999 ...; the gap is |v| < 0.00387.
#[test]
fn a_gap_next_to_the_start() {
    let m = Toggle::default();
    // s(v) = e + f, computed independently.
    let edge = 0.003872987380598997;
    for start in [-0.5, -0.1, -0.02, -0.017, -0.01, -0.005, -0.0039] {
        for pose in m.branches(start).unwrap().filter(|mode| mode.pose.coordinates().s > 0.0) {
            let found = m.limits(start, pose.branch).unwrap();
            let Limit::Bracketed { assembled, unbuildable, group } = found.upper else { panic!("{start}: {found:?}") };
            assert!((assembled + edge).abs() < 1e-11 && (unbuildable + edge).abs() < 1e-11, "{start}: {found:?}");
            assert_eq!(group, "u, w");
        }
    }
}

#[test]
fn a_negative_length_points_the_other_way() {
    for (b, c) in [(3.0, 3.0), (-3.0, 3.0), (3.0, -3.0), (-3.0, -3.0)] {
        let m = Opposed { b, c, ..Opposed::default() };
        let found: Vec<_> = m.branches(0.5).unwrap().map(|pose| m.limits(0.5, pose.branch).unwrap()).collect();
        assert_eq!(found.len(), 2, "{b} {c}");
        found.iter().for_each(free);
        let m = Squares { b, c, ..Squares::default() };
        let found: Vec<_> = m.branches(0.5).unwrap().map(|pose| m.limits(0.5, pose.branch).unwrap()).collect();
        assert_eq!(found.len(), 2, "{b} {c}");
        found.iter().for_each(free);
        // |a@v - d@0| <= 2.5
        let short = Opposed { a: 2.0, b: b * 0.5, c: c / 3.0, ..Opposed::default() };
        let end = ((4.0 + 4.0 - 2.5 * 2.5) / 8.0_f64).acos();
        for pose in short.branches(0.5).unwrap() {
            let found = short.limits(0.5, pose.branch).unwrap();
            exact(found.upper, end, "p, r");
        }
    }
}

/// Gaps of 1e-4 to 0.03 rad, as near as that to the start on one side, and at the end of the turn on the other.
/// `GAPS=1000000` for a larger number.
#[test]
fn random_gaps_next_to_the_start_and_at_the_end_of_a_turn() {
    let count = linkage_trials::count("GAPS", 200, 1000);
    let random = &mut SmallRng::seed_from_u64(linkage_trials::seed(44));
    for _ in 0..count {
        let mut size = || 10_f64.powf(random.random_range(-4.0..-1.52));
        let (half, away) = (0.5 * size(), size());
        let (r, l, e) = (1.0, random.random_range(2.0..5.0), random.random_range(1.0..3.0));
        let slide = |v: f64| r * v.cos() + (l * l - r * r * v.sin() * v.sin()).sqrt();
        let m = Toggle { r, l, e, f: slide(half) - e };
        let sign = if random.random_bool(0.5) { 1.0 } else { -1.0 };
        let start = sign * (half + away);
        // The slider must not come too near on the other side of the turn.
        if slide(PI) < (m.e - m.f).abs() {
            continue;
        }
        for mode in m.branches(start).unwrap().filter(|mode| mode.pose.coordinates().s > 0.0) {
            let found = m.limits(start, mode.branch).unwrap();
            let (near, far) = if sign > 0.0 { (found.lower, found.upper) } else { (found.upper, found.lower) };
            // The error of the edge is that of e + f divided by the slope of s there.
            let error = 1e-14 / half;
            for (limit, edge) in [(near, sign * half), (far, sign * (TAU - half))] {
                let Limit::Bracketed { assembled, .. } = limit else { panic!("{m:?} {start}: {found:?}") };
                assert!((assembled - edge).abs() < error, "{m:?} {start}: {found:?}, {edge}");
            }
        }
    }
}
