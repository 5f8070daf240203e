//! Random mechanisms against closed formulas.

use std::f64::consts::{PI, TAU};

use linkage_interval::Interval;
use linkage_interval::certify::{self, CertifyError, End};
use linkage_trials::count;

use crate::certify::loops::{Loops, exactly};
use crate::certify::shapes::{FourBar, SixBar};

/// Numbers from 0 to 1 by a linear congruential generator (D. E. Knuth, "The Art of Computer Programming" 2, 3.3.4).
pub struct Random(pub u64);

impl Random {
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The angles of two links p and q with p - q = (x, y), on one side: p at the angle of the distance plus an angle from
/// the law of cosines.
pub fn dyad([x, y]: [f64; 2], p: f64, q: f64, side: f64) -> Option<[f64; 2]> {
    let distance = x.hypot(y);
    let cosine = (distance * distance + p * p - q * q) / (2.0 * distance * p);
    let angle = y.atan2(x) + side * (1.0 - cosine * cosine).sqrt().atan2(cosine);
    let other = (p * angle.sin() - y).atan2(p * angle.cos() - x);
    (cosine.abs() <= 1.0).then_some([angle, other])
}

/// The position of a four-bar.
pub fn four_bar([ground, crank, coupler, rocker]: [f64; 4], side: f64, input: f64) -> Option<[f64; 2]> {
    dyad([ground - crank * input.cos(), -crank * input.sin()], coupler, rocker, side)
}

/// The position of a four-bar and the dyad that its rocker drives.
pub fn six_bar(first: [f64; 4], [along, across, rod, rocker, x, y]: [f64; 6], input: f64) -> Option<[f64; 4]> {
    let [coupler, first_rocker] = four_bar(first, 1.0, input)?;
    let (sine, cosine) = first_rocker.sin_cos();
    let arm = [x - along * cosine + across * sine, y - along * sine - across * cosine];
    let [rod, rocker] = dyad(arm, rod, rocker, 1.0)?;
    Some([coupler, first_rocker, rod, rocker])
}

/// True if a number is in an interval up to full turns.
pub fn is_angle_in(angle: f64, interval: Interval, slack: f64) -> bool {
    let turns = ((interval.middle() - angle) / TAU).round();
    let interval = Interval::around(interval.middle(), 0.5 * interval.width() + slack).unwrap();
    interval.contains(angle + turns * TAU)
}

/// The first input beyond `from` at which the distance of the outer joints is that of links in line.
fn limit([ground, crank, coupler, rocker]: [f64; 4], from: f64) -> Option<f64> {
    let of = |distance: f64| {
        let cosine = (ground * ground + crank * crank - distance * distance) / (2.0 * ground * crank);
        (cosine.abs() <= 1.0).then(|| cosine.acos())
    };
    let limits = [of(coupler + rocker), of((coupler - rocker).abs())];
    let all = limits.into_iter().flatten().flat_map(|limit| [limit, TAU - limit]);
    all.map(|limit| limit + ((from - limit) / TAU).ceil() * TAU).reduce(f64::min)
}

#[test]
fn four_bars_turn_as_grashofs_limits_say() {
    let mut random = Random(7);
    let (mut closed, mut dead, mut open) = (0, 0, 0);
    for _ in 0..count("FOUR_BARS", 4, 12) {
        let lengths = [(); 4].map(|()| random.between(0.1, 1.0));
        let input = random.between(-PI, PI);
        let side = if random.between(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 };
        let Some(unknowns) = four_bar(lengths, side, input) else { continue };
        let mechanism = Loops::<FourBar, f64>::new(lengths);
        let start = Loops::<FourBar, f64>::at(unknowns, input);
        let expected = limit(lengths, input);
        match (certify::turn(&mechanism, &start), expected) {
            (Ok(certificate), None) => {
                // Freudenstein's branches of a crank are closed after one turn.
                assert!(matches!(certificate.end(), End::Closed { .. }), "{lengths:?}");
                for _ in 0..4 {
                    let input = random.between(input, input + TAU);
                    let exact = four_bar(lengths, side, input).unwrap();
                    let found = certificate.unknowns_at(exactly(input)).unwrap();
                    assert!(
                        exact.iter().zip(&found).all(|(&angle, &box_)| is_angle_in(angle, box_, 1e-9)),
                        "{lengths:?}"
                    );
                }
                closed += 1;
            }
            (Err(CertifyError::DeadPoint { limit, .. }), Some(expected)) => {
                // The closed formula loses half of the digits where cos = 1.
                assert!((limit.middle() - expected).abs() < 1e-7, "{lengths:?} {limit:?} {expected} {input} {side}");
                dead += 1;
            }
            (Err(CertifyError::Singular { .. } | CertifyError::NoPosition { .. }), _) => open += 1,
            (result, expected) => panic!("{lengths:?} {:?} {expected:?}", result.map(|found| found.end().clone())),
        }
    }
    println!("{closed} closed, {dead} with a dead point, {open} not certified");
    assert!(open * 100 <= closed + dead);
}

#[test]
fn positions_of_six_bars_are_in_their_tubes() {
    let mut random = Random(11);
    let (mut closed, mut dead, mut boxes) = (0, 0, 0);
    for _ in 0..count("SIX_BARS", 3, 3) {
        // A crank-rocker, and a dyad that may lock.
        let first = [1.0, random.between(0.1, 0.3), random.between(0.8, 1.2), random.between(0.6, 1.0)];
        let second = [0.6, 0.3, 0.9, 0.8, 0.7, 0.4].map(|length| length * random.between(0.7, 1.3));
        let position = |input: f64| six_bar(first, second, input);
        let input = random.between(-PI, PI);
        let Some(unknowns) = position(input) else { continue };
        let parameters: Vec<f64> = first.into_iter().chain(second).collect();
        let mechanism = Loops::<SixBar, f64>::new(<[f64; 10]>::try_from(parameters).unwrap());
        match certify::turn(&mechanism, &Loops::<SixBar, f64>::at(unknowns, input)) {
            Ok(certificate) => {
                assert!(certificate.is_closed());
                for _ in 0..20 {
                    let input = random.between(input, input + TAU);
                    let found = certificate.unknowns_at(exactly(input)).unwrap();
                    let exact = position(input).expect("a certified position exists");
                    assert!(exact.iter().zip(&found).all(|(&angle, &box_)| is_angle_in(angle, box_, 1e-9)));
                }
                (closed, boxes) = (closed + 1, boxes + certificate.boxes());
            }
            Err(CertifyError::DeadPoint { limit, .. }) => {
                let inside = (limit.middle() - input).signum();
                assert!(
                    position(limit.least() - 1e-7 * inside).is_some()
                        && position(limit.most() + 1e-7 * inside).is_none()
                );
                dead += 1;
            }
            Err(error) => panic!("{first:?} {second:?} {error}"),
        }
    }
    println!("{closed} closed with {boxes} boxes, {dead} with a dead point");
    assert!(closed > 0);
}
