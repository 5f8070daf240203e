//! Velocities, accelerations and sensitivities over boxes against closed formulas and difference quotients.

use linkage_interval::Interval;
use linkage_interval::certify::{self, Certify};
use linkage_interval::enclose::{EncloseError, PoseBox};
use linkage_runtime::Column;
use linkage_trials::count;

use crate::certify::loops::{Loops, exactly};
use crate::certify::random::{Random, four_bar, six_bar};
use crate::certify::shapes::{FourBar, SixBar, UserFunction};

const LENGTHS: [f64; 4] = [100.0, 40.0, 120.0, 80.0];

/// Coupler and rocker of a four-bar per turn of the crank, at any angles (R. L. Norton, "Design of Machinery", 6.18).
fn ratios([_, crank, coupler, rocker]: [f64; 4], [theta2, theta3, theta4]: [f64; 3]) -> [f64; 2] {
    let of_coupler = crank * (theta4 - theta2).sin() / (coupler * (theta3 - theta4).sin());
    let of_rocker = crank * (theta2 - theta3).sin() / (rocker * (theta4 - theta3).sin());
    [of_coupler, of_rocker]
}

/// Intervals around numbers, each with this part of its scale as radius.
fn around<const N: usize>(middles: [f64; N], radius: f64, is_length: bool) -> [Interval; N] {
    middles.map(|x| Interval::around(x, if is_length { radius * x } else { radius }).unwrap())
}

fn boxed(lengths: [f64; 4], angles: [f64; 3], radius: f64) -> Result<PoseBox<Loops<FourBar, f64>>, EncloseError> {
    let [crank, coupler, rocker] = around(angles, radius, false);
    let parameters = around(lengths, radius, true).into();
    PoseBox::with_parameters(&Loops::new(lengths), parameters, [coupler, rocker].into(), [crank].into())
}

/// A number up to rounding errors of the formulas in doubles.
fn nearly(x: f64) -> Interval {
    Interval::around(x, 1e-12 * (1.0 + x.abs())).unwrap()
}

#[test]
fn ratios_of_random_boxes() {
    let mut random = Random(17);
    let (mut proved, mut quotients) = (0, Vec::new());
    let boxes = count("BOXES", 100, 300);
    for _ in 0..boxes {
        let lengths = [(); 4].map(|()| random.between(0.3, 1.0));
        let angles = [(); 3].map(|()| random.between(-3.0, 3.0));
        let radius = 10_f64.powf(random.between(-6.0, -0.5));
        let found = match boxed(lengths, angles, radius) {
            Ok(found) => found.velocity_ratios().unwrap()[0],
            Err(EncloseError::NotRegular { group: "phi, psi", norm, .. }) if norm >= 1.0 => continue,
            Err(error) => panic!("{error}"),
        };
        proved += 1;
        let mut range: [Option<Interval>; 2] = [None; 2];
        for _ in 0..200 {
            // At the ends of most intervals.
            let mut inside = |x: f64, radius: f64| x + radius * (3.0 * random.between(-1.0, 1.0)).clamp(-1.0, 1.0);
            let at = ratios(lengths.map(|x| inside(x, radius * x)), angles.map(|x| inside(x, radius)));
            for ((found, range), at) in found.iter().zip(&mut range).zip(at) {
                assert!(found.intersection(nearly(at)).is_some(), "{at} is outside {found:?}");
                *range = Some(range.map_or(at.into(), |range| range.hull(at.into())));
            }
        }
        if radius < 1e-2 {
            quotients.extend(found.iter().zip(range).map(|(found, range)| found.width() / range.unwrap().width()));
        }
    }
    quotients.sort_by(f64::total_cmp);
    let [median, most] = [quotients[quotients.len() / 2], quotients[quotients.len() - 1]];
    println!("{proved} boxes, width by range of samples: median {median:.2}, most {most:.2}");
    assert!(2 * proved > boxes && median < 1.5, "{proved} {median}");
}

/// The links are in line where both angles are equal: the largest box that is proved reaches almost up to there.
#[test]
fn a_box_across_a_dead_point() {
    let distance = 0.1;
    let at = |radius: f64| {
        let four_bar = Loops::<FourBar, f64>::new(LENGTHS);
        let [coupler, rocker] = around([1.0, 1.0 + 2.0 * distance], radius, false);
        PoseBox::new(&four_bar, [coupler, rocker].into(), [exactly(0.7)].into()).map(|all| all.norms()[0])
    };
    for radius in [distance, 1.5 * distance, 3.0] {
        let error = at(radius).err();
        assert!(
            matches!(error, Some(EncloseError::NotRegular { group: "phi, psi", norm, .. }) if norm >= 1.0),
            "{error:?}"
        );
    }
    assert!(matches!(at(0.0), Ok(norm) if norm < 1e-13));
    let largest = (1..100).rev().map(|part| 0.01 * f64::from(part)).find(|part| at(part * distance).is_ok()).unwrap();
    println!("proved up to {largest:.2} of the distance");
    assert!(largest > 0.5, "{largest}");
    let middle = at(0.0).unwrap();
    assert!(middle < at(0.1 * distance).unwrap() && at(0.1 * distance).unwrap() < at(0.5 * distance).unwrap());
    // In line in the middle: no inverse.
    let four_bar = Loops::<FourBar, f64>::new(LENGTHS);
    let error = PoseBox::new(&four_bar, [exactly(0.0); 2].into(), [exactly(0.7)].into()).err();
    assert!(matches!(error, Some(EncloseError::NotRegular { norm: f64::INFINITY, .. })), "{error:?}");
}

#[test]
fn the_group_in_line_is_named() {
    let six_bar = Loops::<SixBar, f64>::new(SIX_BAR);
    let unknowns = [0.3, 1.2, 0.5, 0.6];
    let radii = [0.01, 0.01, 0.1, 0.1];
    let all = Column::from_fn(|place| Interval::around(unknowns[place], radii[place]).unwrap());
    let error = PoseBox::new(&six_bar, all, [exactly(0.7)].into()).err().unwrap();
    assert!(matches!(error, EncloseError::NotRegular { group: "rod, second", .. }), "{error:?}");
    let text = error.to_string();
    assert!(text.contains("rod, second") && text.contains("not proved regular at every point"), "{text}");
}

#[test]
fn infinite_intervals_are_an_error() {
    let four_bar = Loops::<FourBar, f64>::new(LENGTHS);
    let (unknowns, inputs) = ([exactly(0.35), exactly(1.0)], [exactly(0.7)]);
    let kind = |error: Option<EncloseError>| match error {
        Some(EncloseError::Invalid { kind, .. }) => kind,
        error => panic!("{error:?}"),
    };
    let half = Interval::new(0.0, f64::INFINITY).unwrap();
    for wrong in [Interval::from(f64::NAN), Interval::from(f64::INFINITY), half, Interval::ENTIRE] {
        let at = |unknowns: [Interval; 2], input: Interval| PoseBox::new(&four_bar, unknowns.into(), [input].into());
        assert_eq!(kind(at([exactly(0.35), wrong], exactly(0.7)).err()), "unknown");
        assert_eq!(kind(at(unknowns, wrong).err()), "input");
        let lengths = [exactly(100.0), wrong, exactly(120.0), exactly(80.0)];
        let of = PoseBox::with_parameters(&four_bar, lengths.into(), unknowns.into(), inputs.into());
        assert_eq!(kind(of.err()), "parameter");
        let pose = at(unknowns, exactly(0.7)).unwrap();
        assert_eq!(kind(pose.velocity(&[wrong].into()).err()), "rate");
        let one = Column::from([exactly(1.0)]);
        assert_eq!(kind(pose.acceleration(&[exactly(1.0), wrong].into(), &one, &one).err()), "rate");
        assert_eq!(kind(pose.acceleration(&unknowns.into(), &one, &[wrong].into()).err()), "acceleration");
    }
    let nan = Loops::<FourBar, f64>::new([f64::NAN, 40.0, 120.0, 80.0]);
    assert_eq!(kind(PoseBox::new(&nan, unknowns.into(), inputs.into()).err()), "parameter");
    // A parameter so large that products of it overflow.
    let huge = Loops::<FourBar, f64>::new([100.0, 40.0, 1e308, 80.0]);
    let wide = PoseBox::new(&huge, [Interval::new(-1.0, 1.0).unwrap(); 2].into(), inputs.into()).err();
    assert!(wide.is_some());
}

#[test]
fn a_user_function_has_no_enclosure() {
    let mechanism = Loops::<UserFunction, f64>::new(LENGTHS);
    let error = PoseBox::new(&mechanism, [exactly(0.35), exactly(1.0)].into(), [exactly(0.7)].into()).err();
    let expected = EncloseError::UserFunction { mechanism: "Loops", group: "phi, psi", function: "lift" };
    assert_eq!(error, Some(expected));
}

/// A difference quotient, to about seven digits.
fn quotient(f: impl Fn(f64) -> f64, at: f64, step: f64) -> Interval {
    let [low, high] = [f(at - step), f(at + step)];
    let slope = (high - low) / (2.0 * step);
    Interval::around(slope, 1e-6 * (1.0 + slope.abs())).unwrap()
}

/// The rates along the certified motion of a four-bar, at inputs of a step of it.
#[test]
fn a_certified_step() {
    let mechanism = Loops::<FourBar, f64>::new(LENGTHS);
    let start = Loops::<FourBar, f64>::at(four_bar(LENGTHS, 1.0, 0.7).unwrap(), 0.7);
    let certificate = certify::turn(&mechanism, &start).unwrap();
    let position = |input: f64| four_bar(LENGTHS, 1.0, input).unwrap();
    let all_ratios = certificate.velocity_ratios();
    let one = Column::from([exactly(1.0)]);
    let mut hulls: [Option<Interval>; 2] = [None; 2];
    for step in 0..600 {
        let inputs = Interval::new(0.7 + 0.01 * f64::from(step), 0.7 + 0.01 * f64::from(step + 1)).unwrap();
        let pose = certificate.pose_box(inputs).unwrap();
        let rates = pose.velocity(&one).unwrap();
        let accelerations = pose.acceleration(&rates, &one, &[exactly(0.0)].into()).unwrap();
        let by_lengths = pose.sensitivity().unwrap();
        assert_eq!(rates.as_slice(), pose.velocity_ratios().unwrap()[0].as_slice());
        for part in [0.0, 0.3, 1.0] {
            let input = inputs.least() + part * inputs.width().min(0.01);
            let closed = ratios(LENGTHS, [input, position(input)[0], position(input)[1]]);
            for place in 0..2 {
                assert!(rates[place].intersection(nearly(closed[place])).is_some());
                let along = |input: f64| ratios(LENGTHS, [input, position(input)[0], position(input)[1]])[place];
                let second = quotient(along, input, 1e-5);
                assert!(accelerations[place].intersection(second).is_some(), "{second:?} {:?}", accelerations[place]);
                for length in 0..4 {
                    let by = |x: f64| {
                        let mut lengths = LENGTHS;
                        lengths[length] = x;
                        four_bar(lengths, 1.0, input).unwrap()[place]
                    };
                    let by = quotient(by, LENGTHS[length], 1e-4);
                    assert!(by_lengths[length][place].intersection(by).is_some());
                }
            }
        }
        for (hull, &rate) in hulls.iter_mut().zip(&rates) {
            *hull = Some(hull.map_or(rate, |hull| hull.hull(rate)));
        }
    }
    // The extremes of the whole turn, up to the part of it that is left out and the width of a step.
    for (hull, all) in hulls.iter().zip(&all_ratios) {
        let (hull, all) = (hull.unwrap(), all.values());
        assert!(hull.width() < 1.1 * all.width() && hull.width() > 0.9 * all.width(), "{hull:?} {all:?}");
    }
    let beyond = Interval::new(6.0, 8.0).unwrap();
    assert!(matches!(certificate.pose_box(beyond).err(), Some(EncloseError::Outside { .. })));
    assert!(matches!(certificate.pose_box(Interval::ENTIRE).err(), Some(EncloseError::Outside { .. })));
}

/// Ground, crank, coupler, rocker; the arm of the rocker, rod, second rocker, second ground.
const SIX_BAR: [f64; 10] = [100.0, 40.0, 120.0, 80.0, 60.0, 20.0, 110.0, 70.0, 150.0, 10.0];

/// The second dyad of a six-bar with tolerances follows the first.
#[test]
fn a_six_bar_with_tolerances() {
    let [first, rest] = [&SIX_BAR[..4], &SIX_BAR[4..]];
    let (first, rest): ([f64; 4], [f64; 6]) = (first.try_into().unwrap(), rest.try_into().unwrap());
    let position = |input: f64| six_bar(first, rest, input).unwrap();
    let mechanism = Loops::<SixBar, f64>::new(SIX_BAR);
    let start = Loops::<SixBar, f64>::at(position(0.7), 0.7);
    for tolerance in [0.0, 1e-4] {
        let certificate = Certify::new(&mechanism).tolerance(tolerance).range(&start, 1.7).unwrap();
        for input in [0.7, 1.0, 1.3, 1.7] {
            let pose = certificate.pose_box(exactly(input)).unwrap();
            assert_eq!(pose.parameters()[1].width() > 0.0, tolerance > 0.0);
            let one = Column::from([exactly(1.0)]);
            let rates = pose.velocity(&one).unwrap();
            let accelerations = pose.acceleration(&rates, &one, &[exactly(0.0)].into()).unwrap();
            for place in 0..4 {
                let first = quotient(|input| position(input)[place], input, 1e-5);
                let slope = |input: f64| quotient(|input| position(input)[place], input, 1e-4).middle();
                let second = Interval::around(quotient(slope, input, 1e-3).middle(), 1e-3).unwrap();
                assert!(rates[place].intersection(first).is_some(), "{:?} {first:?}", rates[place]);
                assert!(accelerations[place].intersection(second).is_some(), "{:?} {second:?}", accelerations[place]);
                if tolerance == 0.0 {
                    assert!(rates[place].width() < 1e-9 && accelerations[place].width() < 1e-8);
                }
            }
        }
    }
}
