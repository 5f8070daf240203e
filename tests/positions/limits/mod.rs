//! The range of an input: in closed form against the law of cosines, bracketed where groups depend on other groups, and
//! against trial positions.

mod gaps;
mod many_turns;

use std::f64::consts::{PI, TAU};

use linkage::limits::{Limit, Limits};
use linkage::{Elbow, PositionError, Slider, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

linkage! {
    #[derive(Debug, Clone, PartialEq)]
    mechanism FourBar {
        param l1, l2, l3, l4;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        derive limits;
    }

    #[derive(Debug, Clone, PartialEq)]
    mechanism SliderCrank {
        param r = 1, l = 3;
        coordinate phi1, phi2, z3;
        loop r@phi1 + l@phi2 = z3@0;
        drive Compressor by phi1;
        drive Engine by z3;
        derive limits;
    }

    /// A block on an arm that turns, with an offset.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Inverted {
        param a = 40, c = 20, d = 50;
        input theta2;
        unknown theta4, b;
        loop a@theta2 = d@0 + c@theta4 + b@(theta4 + 90deg);
        derive limits;
    }

    #[derive(Debug, Clone, PartialEq)]
    mechanism SixBar {
        param a = 2, b = 7, c = 6, d = 8, e = 4, f = 5, g = 5, h = 14, delta = 30deg;
        input theta1;
        unknown theta2, theta3, theta4, theta5;
        loop a@theta1 + b@theta2 = d@0 + c@theta3;
        loop d@0 + e@(theta3 - delta) + f@theta4 = h@0 + g@theta5;
        derive limits;
    }

    #[derive(Debug, Clone, PartialEq)]
    mechanism FiveBar {
        param a = 1, b = 2.5, c = 2.2, d = 0.8, e = 4;
        input theta1, theta4;
        unknown theta2, theta3;
        loop a@theta1 + b@theta2 = e@0 + d@theta4 + c@theta3;
        derive limits;
    }

    /// A table on two links, driven by its height: a length before a length.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Table {
        param arm = 2, strut = 3, base = 4;
        input height;
        unknown alpha, reach, beta, gamma;
        loop arm@alpha = (reach, height);
        loop arm@alpha + strut@beta = base@0 + strut@gamma;
        derive limits;
    }

    /// Kepler's equation behind a dyad.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Kepler {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70, e = 0.3;
        input theta2;
        unknown theta3, theta4, psi;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        equation psi - e * sin(psi) = 2 * theta4 + 1.7;
        derive limits;
    }
}

/// Checks that an input has no limit.
#[track_caller]
fn free(found: &Limits<f64>) {
    assert_eq!([found.lower, found.upper], [Limit::Unlimited; 2]);
}

#[track_caller]
fn exact(limit: Limit<f64>, expected: f64, group: &str) {
    match limit {
        Limit::Exact { input, group: other } => {
            assert!((input - expected).abs() <= 4.0 * f64::EPSILON * (1.0 + expected.abs()), "{input:?}, {expected:?}");
            assert_eq!(other, group);
        }
        _ => panic!("{limit:?}"),
    }
}

/// The next double away from zero, or toward it.
fn next(value: f64, up: bool) -> f64 {
    if up { value.next_up() } else { value.next_down() }
}

/// The range in which C reaches from B and D: cos(theta2) between those of the two stretched positions.
#[test]
fn a_four_bar_in_closed_form() {
    let branch = FourBarBranch::new(Elbow::Left);
    // Crank-rocker; drag-link; neither link turns: about 0, about pi, and on one side only.
    for (lengths, start, low, high) in [
        ([80.0, 20.0, 50.0, 70.0], 0.3, None, None),
        ([20.0, 80.0, 50.0, 70.0], 0.3, None, None),
        ([50.0, 40.0, 45.0, 35.0], 0.3, Some(80.0), Some(80.0)),
        ([50.0, 40.0, 45.0, 30.0], 0.3, Some(15.0), Some(75.0)),
        ([50.0, 20.0, 80.0, 40.0], PI - 0.2, Some(40.0), Some(40.0)),
        ([70.0, 60.0, 30.0, 50.0], 1.0, Some(20.0), Some(80.0)),
        ([70.0, 60.0, 30.0, 50.0], -1.0, Some(80.0), Some(20.0)),
    ] {
        let [l1, l2, l3, l4] = lengths;
        let m = FourBar::new(l1, l2, l3, l4);
        let Limits { lower, upper, .. } = m.limits(start, branch).unwrap();
        let angle = |distance: f64| ((l1 * l1 + l2 * l2 - distance * distance) / (2.0 * l1 * l2)).acos();
        let mirrored = |angle: f64, sign: f64| {
            // The one of the angles +-angle + 2 pi k that is next to the start on that side.
            let turned = [angle, -angle].map(|angle| start + sign * ((angle - start) * sign).rem_euclid(TAU));
            if sign * (turned[0] - turned[1]) < 0.0 { turned[0] } else { turned[1] }
        };
        for (limit, distance, sign) in [(lower, low, -1.0), (upper, high, 1.0)] {
            match distance {
                None => assert_eq!(limit, Limit::Unlimited),
                Some(distance) => {
                    exact(limit, mirrored(angle(distance), sign), "theta3, theta4");
                    let input = limit.input().unwrap();
                    assert!(m.assemble(input - sign * 1e-12, branch).is_ok());
                    assert!(matches!(m.assemble(input + sign * 1e-12, branch), Err(PositionError::Unbuildable { .. })));
                }
            }
        }
    }
}

#[test]
fn sliders_in_closed_form() {
    // Driven by the piston: between the dead centres, and of the crank none.
    let engine = Engine::from(SliderCrank::default());
    let found = engine.limits(3.0, EngineBranch { phi1_phi2: Elbow::Right }).unwrap();
    exact(found.lower, 2.0, "phi1, phi2");
    exact(found.upper, 4.0, "phi1, phi2");
    let negative = engine.limits(-2.5, EngineBranch { phi1_phi2: Elbow::Right }).unwrap();
    exact(negative.lower, -4.0, "phi1, phi2");
    exact(negative.upper, -2.0, "phi1, phi2");
    let compressor = Compressor::from(SliderCrank::default());
    let branch = CompressorBranch { phi2_z3: Slider::Far };
    free(&compressor.limits(0.3, branch).unwrap());
    // A rod shorter than the crank: sin(phi1) = l/r.
    let short = Compressor::from(SliderCrank::new(2.0, 1.0));
    let found = short.limits(0.3, branch).unwrap();
    exact(found.lower, -PI / 6.0, "phi2");
    exact(found.upper, PI / 6.0, "phi2");
    // RPR: the arm's offset circle reaches A while |D A| >= c; A is on it where the cosine law says.
    let m = Inverted::default();
    let found = m.limits(2.0, InvertedBranch { theta4_b: Slider::Far }).unwrap();
    let expected = ((50.0_f64 * 50.0 + 40.0 * 40.0 - 20.0 * 20.0) / (2.0 * 50.0 * 40.0)).acos();
    exact(found.lower, expected, "theta4, b");
    exact(found.upper, TAU - expected, "theta4, b");
}

/// Each bracket is two neighbours, one that assembles and one that does not; all inputs up to the first assemble.
#[track_caller]
fn bracketed(limit: Limit<f64>, group: &str, start: f64, assembles: impl Fn(f64) -> bool) {
    let Limit::Bracketed { assembled, unbuildable, group: other } = limit else { panic!("{limit:?}") };
    assert_eq!(other, group);
    assert_eq!(next(assembled, unbuildable > assembled), unbuildable);
    assert!(assembles(assembled) && !assembles(unbuildable));
    assert!((0..=1000).all(|part| assembles(start + (assembled - start) * f64::from(part) / 1000.0)));
}

/// The distance that the second dyad of the six-bar spans.
fn span(theta1: f64, branch: SixBarBranch) -> f64 {
    let m = SixBar { f: 100.0, g: 100.0, ..SixBar::default() };
    let theta3 = m.assemble(theta1, branch).unwrap().coordinates().theta3 - m.delta;
    (m.h - m.d - m.e * theta3.cos()).hypot(m.e * theta3.sin())
}

#[test]
fn groups_on_groups_are_bracketed() {
    let branch = SixBarBranch::new(Elbow::Left, Elbow::Left);
    let m = SixBar::default();
    free(&m.limits(1.0, branch).unwrap());
    // The second dyad too short for all of the swing.
    let turn = || (0..360).map(|degree| f64::from(degree).to_radians());
    let [near, far] = [f64::min, f64::max].map(|of| turn().map(|v| span(v, branch)).reduce(of).unwrap());
    let m = SixBar { f: 0.25 * (near + far), g: 0.25 * (near + far), ..SixBar::default() };
    let start = turn().find(|&v| m.assemble(v, branch).is_ok()).unwrap();
    let found = m.limits(start, branch).unwrap();
    for limit in [found.lower, found.upper] {
        bracketed(limit, "theta4, theta5", start, |v| m.assemble(v, branch).is_ok());
    }
}

/// A gap between two steps of the search, in which links just fail to reach: the closer search finds it.
#[test]
fn a_narrow_gap_is_seen() {
    let branch = SixBarBranch::new(Elbow::Left, Elbow::Left);
    let distance = |v| span(v, branch);
    let farthest =
        (0..36_000).map(|i| f64::from(i) * TAU / 36_000.0).max_by(|a, b| distance(*a).total_cmp(&distance(*b)));
    let farthest = farthest.unwrap();
    let reach = distance(farthest) - 1e-7;
    let m = SixBar { f: 0.5 * reach, g: 0.5 * reach, ..SixBar::default() };
    assert!(m.assemble(farthest, branch).is_err());
    let start = farthest - 1.0;
    let found = m.limits(start, branch).unwrap();
    let stop = found.upper.input().expect("a limit");
    assert!((stop - farthest).abs() < 1e-2 && m.assemble(farthest + 1e-2, branch).is_ok(), "{stop} {farthest}");
    bracketed(found.upper, "theta4, theta5", start, |v| m.assemble(v, branch).is_ok());
}

#[test]
fn one_input_at_a_time() {
    let m = FiveBar::default();
    let branch = FiveBarBranch { theta2_theta3: Elbow::Left };
    let inputs = FiveBarInputs { theta1: 0.3, theta4: 1.0 };
    let found = m.limits_of_theta1(inputs, branch).unwrap();
    for (limit, sign) in [(found.lower, -1.0), (found.upper, 1.0)] {
        let Limit::Exact { input, .. } = limit else { panic!("{limit:?}") };
        let at = |theta1| m.assemble(FiveBarInputs { theta1, ..inputs }, branch);
        assert!(at(input - sign * 1e-12).is_ok() && at(input + sign * 1e-12).is_err());
    }
    // Of the other input there is no limit: its crank is short.
    free(&m.limits_of_theta4(inputs, branch).unwrap());
}

/// A length whose first group stops in closed form, unless the second stops before.
#[test]
fn of_exact_and_bracketed_the_nearer() {
    let branch = TableBranch { alpha_reach: Slider::Far, beta_gamma: Elbow::Left };
    let m = Table::default();
    let found = m.limits(0.5, branch).unwrap();
    exact(found.lower, -2.0, "alpha");
    exact(found.upper, 2.0, "alpha");
    let short = Table { strut: 1.2, ..m };
    let found = short.limits(0.5, branch).unwrap();
    // |arm@alpha - base| = 2 strut, by the law of cosines.
    let cosine: f64 = (4.0 + 16.0 - 5.76) / 16.0;
    for (limit, expected) in [(found.lower, -2.0), (found.upper, 2.0)] {
        bracketed(limit, "beta, gamma", 0.5, |v| short.assemble(v, branch).is_ok());
        let height = (1.0 - cosine * cosine).sqrt() * expected;
        assert!((limit.input().unwrap() - height).abs() < 1e-12, "{limit:?} {height}");
    }
}

#[test]
fn groups_without_closed_form_are_followed() {
    let m = Kepler::default();
    let branch = KeplerBranch { theta3_theta4: Elbow::Left };
    let guess = |psi| KeplerCoordinates { theta2: 0.3, psi, theta3: 0.0, theta4: 0.0 };
    free(&m.limits(&guess(0.0), branch).unwrap());
    // Steep enough for dead points of psi on the way.
    let steep = Kepler { e: 1.3, ..m };
    let position = steep.assemble_near(&guess(-2.0), branch).unwrap().coordinates();
    let found = steep.limits(&position, branch).unwrap();
    let stops = [found.lower, found.upper].into_iter().filter(|limit| matches!(limit, Limit::Bracketed { .. }));
    for limit in stops.clone() {
        let Limit::Bracketed { group, .. } = limit else { continue };
        assert_eq!(group, "psi");
    }
    assert!(stops.count() > 0, "{found:?}");
}

#[test]
fn scale_free() {
    let m = FourBar::new(70.0, 60.0, 30.0, 50.0);
    let branch = FourBarBranch::new(Elbow::Right);
    let found = m.limits(1.0, branch).unwrap();
    for exponent in [-300, -60, 60, 300] {
        let scaled = m.clone().map(|length| length * 2_f64.powi(exponent));
        assert_eq!(scaled.limits(1.0, branch).unwrap(), found);
    }
}

#[test]
fn invalid_input_is_an_error() {
    let m = FourBar::new(80.0, 20.0, 10.0, 10.0);
    let branch = FourBarBranch::new(Elbow::Left);
    assert!(matches!(m.limits(0.3, branch), Err(PositionError::Unbuildable { .. })));
    assert!(matches!(
        FourBar::new(80.0, 20.0, 50.0, 70.0).limits(f64::NAN, branch),
        Err(PositionError::NotFinite { .. })
    ));
    assert!(matches!(
        FourBar::new(f64::INFINITY, 20.0, 50.0, 70.0).limits(0.0, branch),
        Err(PositionError::NotFinite { .. })
    ));
}

linkage! {
    /// A pin on a planet wheel that turns forty times as fast as its carrier.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Fast {
        param ground = 3, carrier = 0.05, pin = 1, coupler = 2, rocker = 1.8, ratio = 40;
        input theta;
        unknown planet, alpha, beta;
        equation planet = ratio * theta;
        loop carrier@theta + pin@planet + coupler@alpha + rocker@beta = ground@0;
        derive limits;
    }

    /// The table on struts that differ.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Uneven {
        param arm, strut, other, base;
        input height;
        unknown alpha, reach, beta, gamma;
        loop arm@alpha = (reach, height);
        loop arm@alpha + strut@beta = base@0 + other@gamma;
        derive limits;
    }

    /// A dyad between the origin and a joint on a slide.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Slide {
        param p = 1.5, q = 1, offset = 2.5, aside = 0;
        input v;
        unknown alpha, beta;
        loop p@alpha + q@beta = (v + offset, aside);
        derive limits;
    }

    /// A wheel, a rack, and a dyad on the rack.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Train {
        param radius = 0.5, ratio = 3, p = 2, q = 1.5;
        input theta, y;
        unknown wheel, rack, alpha, beta;
        equation wheel = ratio * theta;
        equation rack = -radius * wheel;
        loop p@alpha + q@beta = (rack, y);
        derive limits;
    }
}

/// Through linear equations a group depends on the inputs alone: |(rack, y)| <= p + q.
#[test]
fn behind_wheels_and_racks_in_closed_form() {
    let branch = TrainBranch { alpha_beta: Elbow::Right };
    let m = Train::default();
    let inputs = TrainInputs { theta: 0.4, y: 2.1 };
    let found = m.limits_of_theta(inputs, branch).unwrap();
    // 3.5^2 - 2.1^2 = 2.8^2
    exact(found.lower, -2.8 / 1.5, "alpha, beta");
    exact(found.upper, 2.8 / 1.5, "alpha, beta");
    let found = m.limits_of_y(inputs, branch).unwrap();
    exact(found.upper, (3.5_f64 * 3.5 - 0.6 * 0.6).sqrt(), "alpha, beta");
    // Of nearly straight links the joints come near each other: the other end.
    exact(found.lower, -(3.5_f64 * 3.5 - 0.6 * 0.6).sqrt(), "alpha, beta");
    let standing = Train { ratio: 0.0, ..m };
    free(&standing.limits_of_theta(inputs, branch).unwrap());
}

/// A group that turns forty times as fast as the input stops it within a degree or two, and many times in a turn; the
/// limit is the first.
#[test]
fn a_fast_group_is_followed() {
    let m = Fast::default();
    let branch = FastBranch { alpha_beta: Elbow::Left };
    let found = m.limits(0.0, branch).unwrap();
    for limit in [found.lower, found.upper] {
        bracketed(limit, "alpha, beta", 0.0, |v| m.assemble(v, branch).is_ok());
        assert!((0.06..0.065).contains(&limit.input().unwrap().abs()), "{limit:?}");
    }
}

/// A gap that is narrower than a step and lies in the middle of one: the determinants on its two sides are equal.
#[test]
fn a_gap_between_equal_determinants_is_seen() {
    let arm = 4.0 + 1.0 / 128.0;
    // From here the steps to the exact limit are of 1/64, and none is at 0.
    let start = arm - 360.0 / 64.0;
    let branch = UnevenBranch { alpha_reach: Slider::Far, beta_gamma: Elbow::Left };
    // The joints of the struts are too near each other while |height| is less than the width.
    let width: f64 = 1.0 / 300.0;
    let nearest = (36.0 + arm * arm - 12.0 * (arm * arm - width * width).sqrt()).sqrt();
    let m = Uneven { arm, strut: 5.0, other: 5.0 - nearest, base: 6.0 };
    let found = m.limits(start, branch).unwrap().upper;
    bracketed(found, "beta, gamma", start, |v| m.assemble(v, branch).is_ok());
    assert!((found.input().unwrap() + width).abs() < 1e-9, "{found:?}");
    // Without a gap there is nothing to see.
    exact(Uneven { other: 4.0, ..m }.limits(start, branch).unwrap().upper, arm, "alpha");
}

/// Zeros on both sides of 0, at 0, and of very different size.
#[test]
fn limits_of_a_slide() {
    let branch = SlideBranch { alpha_beta: Elbow::Left };
    let m = Slide::default();
    // |v + 2.5| between 0.5 and 2.5.
    for (start, lower, upper) in [(-1.0, -2.0, 0.0), (-4.0, -5.0, -3.0), (0.0, -2.0, 0.0), (-5.0, -5.0, -3.0)] {
        let found = m.limits(start, branch).unwrap();
        exact(found.lower, lower, "alpha, beta");
        exact(found.upper, upper, "alpha, beta");
    }
    for (offset, upper) in [(2.5 - 1e-9, 1e-9), (-2.5 + 1e-9, 5.0 - 1e-9)] {
        let found = Slide { offset, ..m }.limits(upper - 0.5, branch).unwrap().upper;
        let Limit::Exact { input, .. } = found else { panic!("{found:?}") };
        // The offset is rounded.
        assert!((input - upper).abs() <= 4.0 * f64::EPSILON, "{input:?} {upper:?}");
    }
}

/// A start at a limit, or beyond it by a rounding error: the limit is there, and the other one unchanged.
#[test]
fn a_start_at_a_limit() {
    let m = FourBar::new(70.0, 60.0, 30.0, 50.0);
    let branch = FourBarBranch { theta3_theta4: Elbow::Left };
    let whole = m.limits(1.0, branch).unwrap();
    let [lower, upper] = [whole.lower, whole.upper].map(|limit| limit.input().unwrap());
    let slide = Slide { aside: 0.3, ..Slide::default() };
    let of_slide = SlideBranch { alpha_beta: Elbow::Left };
    let whole = slide.limits(-1.0, of_slide).unwrap();
    let [left, right] = [whole.lower, whole.upper].map(|limit| limit.input().unwrap());
    let near = |found: f64, expected: f64| (found - expected).abs() <= 4.0 * f64::EPSILON * (1.0 + expected.abs());
    for (end, other) in [(lower, upper), (upper, lower), (left, right), (right, left)] {
        let is_slide = end == left || end == right;
        for start in [end, next(end, false), next(end, true)] {
            let found = if is_slide { slide.limits(start, of_slide) } else { m.limits(start, branch) };
            let found = found.unwrap();
            let ends = [found.lower, found.upper].map(|limit| limit.input().unwrap());
            assert!(ends[0] <= start && start <= ends[1], "{start:?}: {found:?}");
            let [same, far] = if end < other { ends } else { [ends[1], ends[0]] };
            assert!(near(same, end) && near(far, other), "{start:?} of {end:?}: {found:?}");
        }
    }
}

/// Links that reach each other at one input only, flat: decimal lengths, which round to either side.
#[test]
fn links_that_touch_at_one_input() {
    let mut count = 0;
    for (i, j, k) in (1..9).flat_map(|i| (1..9).flat_map(move |j| (1..9).map(move |k| (i, j, k)))) {
        let [p, q, crank] = [i, j, k].map(|tenths| 0.1 * f64::from(tenths));
        let s = 0.1 * f64::from(i + j);
        let bar = FourBar::new(0.1 * f64::from(i + j + k), crank, p, q);
        let slide = Slide { p, q, offset: crank, aside: s };
        let found = [
            (bar.limits(0.0, FourBarBranch { theta3_theta4: Elbow::Left }), 0.0),
            (slide.limits(-crank, SlideBranch { alpha_beta: Elbow::Left }), -crank),
        ];
        for (found, only) in found {
            // Too short by a rounding error of the sum, at most.
            let found = found.unwrap();
            count += 1;
            for limit in [found.lower, found.upper] {
                let Limit::Exact { input, .. } = limit else { panic!("{bar:?} {limit:?}") };
                assert!((input - only).abs() < 1e-7, "{bar:?} {limit:?}");
            }
        }
    }
    assert_eq!(count, 1024);
}

/// Wherever there are positions, a limit is the same number in any unit of length; and none is infinite or NaN.
#[test]
fn no_limit_is_not_finite() {
    let slide = Slide { p: 0.3, q: 0.2, offset: 0.1, aside: 0.05 };
    let bar = FourBar::new(0.4, 0.3, 0.15, 0.25);
    let (on_slide, on_bar) = (SlideBranch { alpha_beta: Elbow::Left }, FourBarBranch { theta3_theta4: Elbow::Left });
    let inverted = Inverted { a: 0.4, c: 0.2, d: 0.5 };
    let on_arm = InvertedBranch { theta4_b: Slider::Far };
    let expected = slide.limits(0.2, on_slide).unwrap();
    assert!(matches!((expected.lower, expected.upper), (Limit::Exact { .. }, Limit::Exact { .. })), "{expected:?}");
    for exponent in [-330, -300, 300, 330] {
        let scale = 2_f64.powi(exponent);
        let scaled = slide.clone().map(|length| length * scale).limits(0.2 * scale, on_slide).unwrap();
        for (limit, other) in [(scaled.lower, expected.lower), (scaled.upper, expected.upper)] {
            assert_eq!(limit.input().map(|input| input / scale), other.input(), "2^{exponent}");
        }
        let scaled = bar.clone().map(|length| length * scale).limits(0.7, on_bar);
        assert_eq!(scaled, bar.limits(0.7, on_bar), "2^{exponent}");
        let scaled = inverted.clone().map(|length| length * scale).limits(2.0, on_arm);
        assert_eq!(scaled, inverted.limits(2.0, on_arm), "2^{exponent}");
    }
    let random = &mut SmallRng::seed_from_u64(7);
    let mut found = 0;
    let mut check = |limits: Result<Limits<f64>, PositionError>, start: f64, case: &dyn std::fmt::Debug| {
        let Ok(Limits { lower, upper, .. }) = limits else { return };
        found += 1;
        for limit in [lower, upper] {
            let numbers = match limit {
                Limit::Unlimited => vec![],
                Limit::Exact { input, .. } | Limit::JointRange { input, .. } => vec![input],
                Limit::Bracketed { assembled, unbuildable, .. } => vec![assembled, unbuildable],
            };
            assert!(numbers.iter().all(|number| number.is_finite()), "{case:?} {start:?}: {limit:?}");
        }
        assert!(lower.input().is_none_or(|lower| lower <= start), "{case:?} {start:?}: {lower:?}");
        assert!(upper.input().is_none_or(|upper| upper >= start), "{case:?} {start:?}: {upper:?}");
    };
    for _ in 0..20_000 {
        // One unit for all, or for each its own.
        let most = [3, 100, 520][random.random_range(0..3)];
        let unit: i32 = random.random_range(-1070..1020);
        let mut length = || {
            let exponent = random.random_range(-most..=most).clamp(-1070, 1020);
            let exponent = if most == 3 { unit + exponent } else { exponent };
            random.random_range(-2.0..2.0) * 2_f64.powi(exponent.clamp(-1074, 1022))
        };
        let lengths: [f64; 4] = std::array::from_fn(|_| length());
        let start = length();
        let m = FourBar::from(lengths);
        check(m.limits(start, on_bar), start, &m);
        let m = Slide::from(lengths);
        check(m.limits(start, on_slide), start, &m);
        check(m.limits(start - m.offset, on_slide), start - m.offset, &m);
        let m = Inverted::new(lengths[0], lengths[1], lengths[2]);
        check(m.limits(start, on_arm), start, &m);
        let m = Engine { r: lengths[0], l: lengths[1] };
        let v = 0.5 * (lengths[0] + lengths[1]);
        check(m.limits(v, EngineBranch { phi1_phi2: Elbow::Left }), v, &m);
        let m = Train { radius: lengths[0], ratio: start, p: lengths[1], q: lengths[2] };
        let inputs = TrainInputs { theta: lengths[1] / (start * lengths[0]), y: lengths[3] };
        let on_train = TrainBranch { alpha_beta: Elbow::Left };
        check(m.limits_of_theta(inputs, on_train), inputs.theta, &m);
        check(m.limits_of_y(inputs, on_train), inputs.y, &m);
    }
    // Joints far from the origin and near each other: the squares of the coordinates overflow, that of the line does
    // not.
    let mut errors = 0;
    for exponent in 480..600 {
        let (far, near) = (2_f64.powi(exponent), 2_f64.powi(320));
        let m = FourBar::new(far, far, 0.6 * near, 0.7 * near);
        let start = near / far;
        assert!(m.assemble(start, on_bar).is_ok());
        let limits = m.limits(start, on_bar);
        errors +=
            usize::from(matches!(limits, Err(PositionError::NotFinite { mechanism: "FourBar", quantity: "a limit" })));
        check(limits, start, &m);
    }
    assert!((80..100).contains(&errors), "{errors}");
    println!("{found} limits");
    assert!(found > 10_000, "{found}");
}
