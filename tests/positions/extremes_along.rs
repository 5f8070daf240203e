//! Smallest and largest values along one motion: ends, dead points and change points included.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use approx::assert_relative_eq;
use linkage::extremes::{Extremes, courses, over};
use linkage::range_of_motion::{RangeOfMotion, RangeOptions};
use linkage::{Elbow, OutputMotion, PathError, PositionError, Slider, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

linkage! {
    mechanism FourBar {
        param ground = 80, crank = 20, coupler = 50, rocker = 70, tilt = 0;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@tilt + rocker@psi;
        output swing = psi;
        output mu = psi - phi;
        output height = crank * sin(theta) + (coupler / 3) * sin(phi);
    }
    mechanism SliderCrank {
        param r = 20, l = 60, e = 15;
        input phi;
        unknown psi, s;
        loop r@phi + l@psi = (s, e);
        output stroke = s;
    }
    mechanism Cylinder {
        param base = 1, arm = 0.6;
        input s;
        unknown phi, psi;
        loop s@psi = base@0 + arm@phi;
        output depth = -arm * sin(phi);
    }
    mechanism Rooted {
        param r = 2, l = 5;
        input phi;
        unknown psi, s;
        loop r@phi + l@psi = (s, 0);
        output root = sqrt(s - 4);
    }
}

fn options() -> RangeOptions {
    RangeOptions::through_change_points()
}

/// By the law of cosines, as where single positions are searched.
#[test]
fn the_transmission_angle_of_a_turn() {
    let m = FourBar::default();
    let range = RangeOfMotion::on_branch(&m, FourBarBranch::new(Elbow::Left), [1.0], options()).unwrap();
    let mu = over(&range, |motion| motion.outputs.mu).unwrap();
    let angle = |diagonal: f64| {
        let FourBar { coupler, rocker, .. } = m;
        ((coupler * coupler + rocker * rocker - diagonal * diagonal) / (2.0 * coupler * rocker)).acos()
    };
    let values = [mu.least.value, mu.largest.value].map(|mu| mu.cos().acos());
    assert_relative_eq!(values[0], angle(m.ground - m.crank), max_relative = 4e-15);
    assert_relative_eq!(values[1], angle(m.ground + m.crank), max_relative = 4e-15);
    // The motion begins at 1.
    assert!((mu.least.input - TAU).abs() < 1e-9 && (mu.largest.input - PI).abs() < 1e-9, "{mu:?}");
}

/// sqrt((l + r)^2 - e^2) and sqrt((l - r)^2 - e^2).
#[test]
fn the_stroke_of_a_slider() {
    let m = SliderCrank::default();
    let range = RangeOfMotion::on_branch(&m, SliderCrankBranch { psi_s: Slider::Far }, [1.0], options()).unwrap();
    let stroke = over(&range, |motion| motion.outputs.stroke).unwrap();
    for (found, reach) in [(stroke.largest, m.l + m.r), (stroke.least, m.l - m.r)] {
        assert_relative_eq!(found.value, (reach * reach - m.e * m.e).sqrt(), max_relative = 4e-16);
    }
}

/// At a dead point the derivative by the input is infinite; the extreme is there, or where the links are in line.
#[test]
fn dead_points_are_ends() {
    let m = FourBar { ground: 4.0, crank: 3.0, coupler: 2.0, rocker: 2.5, tilt: 0.0 };
    let branch = FourBarBranch::new(Elbow::Left);
    let range = RangeOfMotion::on_branch(&m, branch, [0.5], options()).unwrap();
    let mu = over(&range, |motion| motion.outputs.mu).unwrap();
    // In line at both ends: 0 or 180 degrees.
    assert!(range.inputs().contains(&mu.largest.input) || range.inputs().contains(&mu.least.input));
    assert!(mu.least.value.sin().abs().min(mu.largest.value.sin().abs()) < 1e-7);
    // A fine sweep that is refined towards both ends.
    let swing = over(&range, |motion| motion.outputs.swing).unwrap();
    let [low, high] = range.inputs();
    let place = |step: u32| 0.5 - 0.5 * (PI * f64::from(step) / 20_000.0).cos();
    let swept: Vec<f64> = (0..=20_000).map(|step| range.at(low + (high - low) * place(step)).unwrap().psi).collect();
    let [least, most] = [f64::min, f64::max].map(|of: fn(f64, f64) -> f64| swept.iter().copied().reduce(of).unwrap());
    assert!(swing.least.value <= least && least - swing.least.value < 1e-7, "{swing:?} {least}");
    assert!(swing.largest.value >= most && swing.largest.value - most < 1e-7, "{swing:?} {most}");
}

/// A length drives: the arm is lowest where it is vertical, s^2 = base^2 + arm^2.
#[test]
fn a_length_as_input() {
    let m = Cylinder::default();
    let branch = m.branches(0.9).unwrap().find(|found| found.pose.coordinates().phi < 0.0).unwrap().branch;
    let range = RangeOfMotion::on_branch(&m, branch, [0.9], options()).unwrap();
    let depth = over(&range, |motion| motion.outputs.depth).unwrap();
    assert_relative_eq!(depth.largest.value, m.arm, max_relative = 4e-16);
    assert_relative_eq!(depth.largest.input, m.base.hypot(m.arm), max_relative = 1e-8);
    assert!(depth.least.value.abs() < 1e-15 && range.inputs().contains(&depth.least.input), "{depth:?}");
}

/// The cranks of a parallelogram stay parallel through both change points, at which a point of the coupler is highest and
/// lowest.
#[test]
fn extremes_at_change_points() {
    for tilt in [FRAC_PI_2, 0.3] {
        let m = FourBar { ground: 5.0, crank: 2.0, coupler: 5.0, rocker: 2.0, tilt };
        let start = FourBarCoordinates { theta: 0.5, phi: tilt, psi: 0.5 };
        let range = RangeOfMotion::of(&m, &start, options()).unwrap();
        assert_eq!(range.crossings().len(), 2);
        let found: Extremes = over(&range, |motion| motion.outputs.height).unwrap();
        let middle = m.coupler / 3.0 * tilt.sin();
        for (extreme, side) in [(found.largest, 1.0), (found.least, -1.0)] {
            assert_relative_eq!(extreme.value, middle + side * m.crank, max_relative = 1e-14);
            let off = extreme.input - side * FRAC_PI_2;
            assert!((off - TAU * (off / TAU).round()).abs() < 1e-7, "{extreme:?}");
        }
        let mu = over(&range, |motion| motion.outputs.mu).unwrap();
        assert_relative_eq!(mu.largest.value - mu.least.value, TAU, max_relative = 1e-14);
    }
}

/// Each extreme of random linkages against a sweep in small steps, whose best rows are no better, and not much worse.
#[test]
fn random_linkages_against_sweeps() {
    let random = &mut SmallRng::seed_from_u64(48);
    let (mut followed, count) = (0, linkage_trials::count("SWEEPS", 8, 20));
    for _ in 0..count {
        let [ground, crank, coupler, rocker] = [0; 4].map(|_| random.random_range(1.0..4.0));
        let m = FourBar { ground, crank, coupler, rocker, tilt: random.random_range(0.0..TAU) };
        let inputs = (0..36).map(|step| f64::from(step) * TAU / 36.0);
        let Ok(range) = RangeOfMotion::on_branch(&m, FourBarBranch::new(Elbow::Left), inputs, options()) else {
            continue;
        };
        followed += 1;
        let found = over(&range, |motion| motion.outputs.height).unwrap();
        let [low, high] = range.inputs();
        let steps = 3000;
        for step in 0..=steps {
            let part = 0.5 - 0.5 * (PI * f64::from(step) / f64::from(steps)).cos();
            let q = range.at(low + (high - low) * part).unwrap();
            let height = crank * q.theta.sin() + coupler / 3.0 * q.phi.sin();
            assert!(height <= found.largest.value + 1e-14 && height >= found.least.value - 1e-14, "{height} {found:?}");
        }
        for extreme in [found.least, found.largest] {
            let q = range.at(extreme.input).unwrap();
            assert_relative_eq!(crank * q.theta.sin() + coupler / 3.0 * q.phi.sin(), extreme.value, epsilon = 1e-14);
        }
    }
    assert!(4 * followed > 3 * count, "{followed}");
}

/// Turning points of several quantities in one pass; one that does not move has none.
#[test]
fn turning_points_in_order() {
    let m = FourBar::default();
    let range = RangeOfMotion::on_branch(&m, FourBarBranch::new(Elbow::Left), [1.0], options()).unwrap();
    let wave = |input: f64, speed: f64| {
        let (sine, cosine) = (speed * input).sin_cos();
        OutputMotion { value: sine, rate: speed * cosine, acceleration: -speed * speed * sine }
    };
    let still = |input: f64| OutputMotion { value: 1.0 + 1e-16 * (1e5 * input).sin(), rate: 1e-17, acceleration: 0.0 };
    let all = courses(&range, |motion| {
        let input = motion.position.theta;
        // The derivatives of a motion by arc length are those by the input times the rate of the input.
        let rate = motion.rates.theta;
        [wave(input, 3.0), still(input)].map(|one| OutputMotion { rate: one.rate * rate, ..one })
    });
    let all = all.unwrap();
    let places: Vec<f64> = all[0].turning_points.iter().map(|at| at.input).collect();
    assert_eq!(places.len(), 6, "{places:?}");
    for (place, number) in places.iter().zip(1..) {
        assert_relative_eq!(*place, PI / 6.0 + PI / 3.0 * f64::from(number), max_relative = 1e-9);
    }
    assert!(!all[0].is_constant && all[1].is_constant && all[1].turning_points.is_empty());
}

/// The coupler of a parallelogram keeps its direction, and its rocker turns. A few samples are near a change point, with rounding
/// errors much larger than those of the others; the coupler is constant all the same.
#[test]
fn couplers_of_parallelograms_are_constant() {
    let random = &mut SmallRng::seed_from_u64(linkage_trials::seed(0x9a7a));
    let drawn = (0..linkage_trials::count("COUPLERS", 10, 1000))
        .map(|_| [random.random_range(1.0..4.0), random.random_range(1.0..4.0)]);
    // Two neighbours next to 180 degrees have nearly the same error here.
    for [crank, ground] in [[1.963, 3.235]].into_iter().chain(drawn) {
        let m = FourBar { ground, crank, coupler: ground, rocker: crank, tilt: 0.0 };
        let start = FourBarCoordinates { theta: 1.626, phi: 0.0, psi: 1.626 };
        let range = RangeOfMotion::of(&m, &start, RangeOptions::through_change_points()).unwrap();
        let all = courses(&range, |motion| {
            let of = |value, rate, acceleration| OutputMotion { value, rate, acceleration };
            let (q, rates, accelerations) = (&motion.position, &motion.rates, &motion.accelerations);
            [of(q.phi, rates.phi, accelerations.phi), of(q.psi, rates.psi, accelerations.psi)]
        });
        let constant = all.unwrap().iter().map(|course| course.is_constant).collect::<Vec<_>>();
        assert_eq!(constant, [true, false], "{crank} {ground}");
    }
}

/// A turning point at or next to the place at which a closed motion begins again is found once.
#[test]
fn a_turning_point_at_the_start() {
    let m = FourBar::default();
    for start in [0.0, PI, PI - 1e-7, PI + 1e-7, 1e-6] {
        let range = RangeOfMotion::on_branch(&m, FourBarBranch::new(Elbow::Left), [start], options()).unwrap();
        let all = courses(&range, |motion| [motion.outputs.mu]).unwrap();
        assert_eq!(all[0].turning_points.len(), 2, "{:?}", all[0].turning_points);
        // To the rounding errors of an angle whose derivative is zero.
        assert!(all[0].turning_points.iter().all(|at| at.input.sin().abs() < 3e-8), "{:?}", all[0].turning_points);
        // A derivative that is zero at the start itself, and less than its rounding error at the end.
        let all = courses(&range, |motion| {
            let (sine, cosine) = (motion.position.theta - range.inputs()[0]).sin_cos();
            [OutputMotion { value: cosine, rate: -sine * motion.rates.theta, acceleration: -cosine }]
        });
        assert_eq!(all.unwrap()[0].turning_points.len(), 2);
    }
}

/// An output without a value ends the search with the reason.
#[test]
fn a_quantity_without_a_value() {
    let m = Rooted::default();
    let range = RangeOfMotion::on_branch(&m, RootedBranch { psi_s: Slider::Far }, [0.5], options()).unwrap();
    let found = over(&range, |motion| motion.outputs.root);
    assert!(matches!(found, Err(PathError::Position(PositionError::NotFinite { .. }))), "{found:?}");
}
