//! How far an input can go: in closed form against the law of cosines, bracketed where groups stand on others,
//! and against trying.

use std::f64::consts::{PI, TAU};

use linkage::limits::{Limit, Limits};
use linkage::{Elbow, Error, Slider, Slope, linkage};

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

/// Where C can reach from B and D: cos(theta2) between those of the two stretched positions.
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
        let Limits { lower, upper } = m.limits(start, branch).unwrap();
        let angle = |distance: f64| ((l1 * l1 + l2 * l2 - distance * distance) / (2.0 * l1 * l2)).acos();
        let mirrored = |angle: f64, sign: f64| {
            // The one of the angles +-angle + 2 pi k that is next to the start on that side.
            let turned = [angle, -angle].map(|angle| start + sign * ((angle - start) * sign).rem_euclid(TAU));
            if sign * (turned[0] - turned[1]) < 0.0 { turned[0] } else { turned[1] }
        };
        for (limit, distance, sign) in [(lower, low, -1.0), (upper, high, 1.0)] {
            match distance {
                None => assert_eq!(limit, Limit::None),
                Some(distance) => {
                    exact(limit, mirrored(angle(distance), sign), "theta3, theta4");
                    let input = limit.input().unwrap();
                    assert!(m.assemble(input - sign * 1e-12, branch).is_ok());
                    assert!(matches!(m.assemble(input + sign * 1e-12, branch), Err(Error::Unbuildable { .. })));
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
    let branch = CompressorBranch { phi2: Slope::Rising };
    assert_eq!(compressor.limits(0.3, branch).unwrap(), Limits { lower: Limit::None, upper: Limit::None });
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

/// Each bracket is two neighbours, of which one assembles and the other does not; up to there all do.
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
    assert_eq!(m.limits(1.0, branch).unwrap(), Limits { lower: Limit::None, upper: Limit::None });
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

/// A gap between two steps of the search, where links just fail to reach: a closer look finds it.
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
    assert_eq!(m.limits_of_theta4(inputs, branch).unwrap(), Limits { lower: Limit::None, upper: Limit::None });
}

/// A length whose first group stops in closed form, unless the second stops before.
#[test]
fn of_exact_and_bracketed_the_nearer() {
    let branch = TableBranch { alpha: Slope::Rising, beta_gamma: Elbow::Left };
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
    assert_eq!(m.limits(&guess(0.0), branch).unwrap(), Limits { lower: Limit::None, upper: Limit::None });
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
fn nonsense_is_refused() {
    let m = FourBar::new(80.0, 20.0, 10.0, 10.0);
    let branch = FourBarBranch::new(Elbow::Left);
    assert!(matches!(m.limits(0.3, branch), Err(Error::Unbuildable { .. })));
    assert!(matches!(FourBar::new(80.0, 20.0, 50.0, 70.0).limits(f64::NAN, branch), Err(Error::NotFinite { .. })));
    assert!(matches!(FourBar::new(f64::INFINITY, 20.0, 50.0, 70.0).limits(0.0, branch), Err(Error::NotFinite { .. })));
}
