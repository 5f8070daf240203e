//! The bounds of rounding errors in the docs of emitted functions, against the functions of 31 digits: at random coordinates
//! of the whole gallery no error exceeds its bound; 1000 of each mechanism have 2.3 million results.
//!
//! ```text
//! BOUNDED=1000 cargo test --release --all-features --test digits rounding_bounds -- --nocapture
//! MECHANISM=four_bar cargo test --all-features --test digits rounding_bounds    one mechanism, by its file or its name
//! ```

use std::collections::{BTreeMap, BTreeSet};

use linkage_compiler::Bounds;
use linkage_double::DoubleDouble;
use linkage_gallery::checks::each;
use linkage_gallery::listed::{Listed, all, listed, same_as};
use linkage_gallery::source;
use linkage_oracle::precise::{Big, big};
use linkage_oracle::scalars;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// Random coordinates of each mechanism.
fn poses() -> usize {
    linkage_trials::count("BOUNDED", 10, 40)
}

/// The bound, the error and the magnitude of each rounded result, by function.
type Measured = BTreeMap<&'static str, Vec<[f64; 3]>>;

/// The bounds of the type that a derivation is of.
fn bounds_of(file: &str, of: &str) -> Bounds {
    let mechanisms = linkage_compiler::read(source::tokens_of(file)).unwrap();
    let all = mechanisms.iter().flat_map(|mechanism| linkage_compiler::bounds(mechanism).unwrap());
    all.into_iter().find(|bounds| bounds.driver == of).unwrap_or_else(|| panic!("no {of}"))
}

/// Random numbers: mostly of the size of one, some small.
fn numbers(rng: &mut SmallRng, count: usize) -> Vec<f64> {
    let mut number = || rng.random_range(-3.0..3.0) * if rng.random_range(0..8) == 0 { 1e-6 } else { 1.0 };
    (0..count).map(|_| number()).collect()
}

/// Angles, some of them nearly equal or opposite.
fn coordinates(rng: &mut SmallRng, count: usize) -> Vec<f64> {
    let mut all = numbers(rng, count);
    if count > 1 && rng.random_range(0..3) == 0 {
        let [from, to] = [0; 2].map(|_| rng.random_range(0..count));
        let turn = [0.0, std::f64::consts::PI][rng.random_range(0..2)];
        all[to] = all[from] + turn + 10.0_f64.powf(rng.random_range(-9.0..0.0));
    }
    all
}

/// Angles of a turn and rates of the size of one.
fn ordinary(rng: &mut SmallRng, count: usize) -> [Vec<f64>; 3] {
    [std::f64::consts::PI, 3.0, 3.0].map(|most| (0..count).map(|_| rng.random_range(-most..most)).collect())
}

/// Coordinates near dead points and small rates among others.
fn extreme(rng: &mut SmallRng, count: usize) -> [Vec<f64>; 3] {
    [coordinates(rng, count), numbers(rng, count), numbers(rng, count)]
}

/// Random coordinates, rates and accelerations of this count.
type Motion = fn(&mut SmallRng, usize) -> [Vec<f64>; 3];

/// The functions of [`results`] that need no regular J.
const FUNCTIONS: [&str; 7] =
    ["gamma", "points", "point_velocities", "point_accelerations", "outputs", "output_rates", "output_accelerations"];

/// The results of a mechanism in any scalar, by function, in the order of the code.
fn results<T: linkage::Real>(
    of: &dyn Listed<T>,
    parameters: &[T],
    motion: &[Vec<f64>; 3],
) -> BTreeMap<&'static str, Vec<T>> {
    let [q, rates, bent] =
        motion.each_ref().map(|list| list.iter().copied().map(linkage::nalgebra::convert).collect::<Vec<T>>());
    let pose = of.with_parameters(parameters).pose(&q);
    let [v_rates, v_bent] = [&rates, &bent].map(|list| of.inputs_of(list));
    let flat = |matrices: Vec<linkage::nalgebra::DMatrix<T>>| {
        matrices.iter().flat_map(|matrix| matrix.as_slice().to_vec()).collect::<Vec<T>>()
    };
    let all = [
        ("velocity_ratios", pose.velocity_ratios().ok().map(|ratios| ratios.as_slice().to_vec())),
        ("velocity", pose.velocity(&v_rates).ok()),
        ("acceleration", pose.acceleration(&rates, &v_bent).ok()),
        ("gamma", Some(pose.gamma(&rates))),
        ("points", pose.points().ok()),
        ("point_velocities", pose.point_velocities(&rates).ok()),
        ("point_accelerations", pose.point_accelerations(&rates, &bent).ok()),
        ("point_ratios", pose.point_ratios().ok().map(flat)),
        ("outputs", pose.outputs().ok()),
        ("output_rates", pose.output_rates(&rates).ok()),
        ("output_accelerations", pose.output_accelerations(&rates, &bent).ok()),
        ("output_ratios", pose.output_ratios().ok().map(flat)),
    ];
    all.into_iter().filter_map(|(name, list)| Some((name, list?))).collect()
}

/// The bound, the error and the magnitude of each rounded result at random coordinates.
fn measured(of: &dyn Listed<f64>, precise: &dyn Listed<DoubleDouble>, motion: Motion, poses: usize) -> Measured {
    let bounds = bounds_of(of.file(), of.name());
    let defaults = of.defaults();
    let mut rng = SmallRng::seed_from_u64(linkage_trials::seed(31));
    let (mut measured, mut silent) = (Measured::new(), BTreeSet::new());
    for pose in 0..poses {
        let parameters: Vec<f64> = defaults.iter().map(|value| value * rng.random_range(0.7..1.3)).collect();
        let motion = motion(&mut rng, bounds.coordinates.len());
        let exact: Vec<DoubleDouble> = parameters.iter().map(|value| DoubleDouble::from(*value)).collect();
        let emitted = results(of, &parameters, &motion);
        let precise = results(precise, &exact, &motion);
        // Coordinates at which a function has no result are few.
        match pose {
            0 => silent = FUNCTIONS.into_iter().filter(|function| !emitted.contains_key(function)).collect(),
            _ => silent.retain(|function| !emitted.contains_key(function)),
        }
        let mut values: BTreeMap<&str, f64> = bounds.parameters.iter().map(String::as_str).zip(parameters).collect();
        for (order, list) in motion.iter().enumerate() {
            values.extend(bounds.coordinates.iter().map(|names| names[order].as_str()).zip(list.iter().copied()));
        }
        let value = |name: &str| *values.get(name).unwrap_or_else(|| panic!("no {name}"));
        for (function, list) in emitted {
            let (Some(bound), Some(precise)) = (bounds.functions.get(function), precise.get(function)) else {
                continue;
            };
            for (place, (found, exact)) in list.iter().zip(precise).enumerate() {
                let error = (*exact - DoubleDouble::from(*found)).high().abs();
                match bound.at(place, exact.high(), &value) {
                    Some(most) => measured.entry(function).or_default().push([most, error, exact.high().abs()]),
                    None => assert_eq!(error, 0.0, "{function} has a rounded result {place} without a bound"),
                }
            }
        }
    }
    assert!(poses == 0 || silent.is_empty(), "no result of {silent:?}");
    measured
}

/// Terms of second order in 2^-53: a bound is of first order, and errors at 1e-9 of a dead point are not small.
const SECOND_ORDER: f64 = 1e-6;

/// A result that is smaller underflows in its factors.
const SMALLEST: f64 = 1e-290;

#[test]
fn no_error_exceeds_its_bound() {
    each(all(), |of| is_bounded(of, same_as(scalars::doubled(), of)));
}

fn is_bounded(of: &dyn Listed<f64>, precise: &dyn Listed<DoubleDouble>) {
    for (function, all) in measured(of, precise, extreme, poses()) {
        let mut largest = 0.0_f64;
        for [bound, error, _] in all.iter().filter(|[bound, ..]| *bound > SMALLEST) {
            assert!(
                *error <= bound * (1.0 + SECOND_ORDER),
                "{function}: an error of {error:e} exceeds its bound {bound:e}"
            );
            largest = largest.max(error / bound);
        }
        println!("| {}::{function} | {} | {largest:.3} |", of.name(), all.len());
    }
}

/// The middle of a list.
fn median(mut list: Vec<f64>) -> f64 {
    list.sort_by(f64::total_cmp);
    list[list.len() / 2]
}

/// The distance of a number to the next larger one.
fn ulp(number: f64) -> f64 {
    number.next_up() - number
}

/// A bound far above all errors would say nothing. Both in ulps of the results, where these are not exact.
#[test]
fn the_bounds_of_the_four_bar_are_near_its_errors() {
    let of = listed("four_bar", "FourBar");
    let limits = [("velocity_ratios", 17.0), ("velocity", 17.0), ("acceleration", 24.0), ("points", 10.0)];
    let motions: [(&str, Motion); 2] = [("ordinary", ordinary), ("extreme", extreme)];
    for (name, motion) in motions {
        let measured = measured(of, same_as(scalars::doubled(), of), motion, poses().max(2000));
        for (function, most) in limits {
            let inexact = measured[function].iter().filter(|[_, error, _]| *error > 0.0);
            let ulps: Vec<[f64; 2]> =
                inexact.map(|[bound, error, exact]| [bound, error].map(|part| part / ulp(*exact))).collect();
            let [bound, error] = [0, 1].map(|part| median(ulps.iter().map(|pair| pair[part]).collect()));
            println!("{name} {function}: bound {bound:.2} ulp, error {error:.2} ulp, {:.1} times", bound / error);
            assert!(bound <= most * error, "{name} {function}: {bound:e} bounds {error:e} in the median");
        }
    }
}

/// The velocity ratios of the four-bar by their textbook law in 48 digits: sin(theta2 - theta4) / sin(theta4 - theta3).
#[test]
fn ratios_of_the_four_bar_in_48_digits() {
    let bounds = bounds_of("four_bar", "FourBar");
    let bound = &bounds.functions["velocity_ratios"];
    let mut rng = SmallRng::seed_from_u64(linkage_trials::seed(48));
    let four_bar = listed("four_bar", "FourBar");
    let parameters = four_bar.defaults();
    let m = four_bar.with_parameters(&parameters);
    for _ in 0..200 {
        let names = bounds.coordinates.iter().map(|[name, ..]| name.as_str());
        let q = coordinates(&mut rng, 3);
        let values: BTreeMap<&str, f64> = names
            .zip(q.iter().copied())
            .chain(bounds.parameters.iter().map(String::as_str).zip(parameters.iter().copied()))
            .collect();
        let Ok(ratios) = m.pose(&q).velocity_ratios() else { continue };
        let exact = |name: &str| big(values[name]);
        let sine = |a: &str, b: &str| (exact(a) - exact(b)).sin_cos().0;
        let law = |above: Big, length: &str| exact("l2") * above / (exact(length) * sine("theta3", "theta4"));
        let laws = [law(sine("theta2", "theta4"), "l3"), law(sine("theta2", "theta3"), "l4")];
        let angle = |a: &str, b: &str| values[a] - values[b];
        let d = angle("theta3", "theta4");
        for (place, other) in ["theta4", "theta3"].into_iter().enumerate() {
            // Counted by hand: the sines of the numerator and their products 1.29 + 1.29 + 1, the difference 1, its product
            // with a length 1; the determinant 1.29, its two products 2, its angle |d cot d|; quotient and last product 2.
            let by_hand = 7.29 + (d / d.tan()).abs() + 3.58 / angle("theta2", other).sin().abs();
            let found = ratios.as_slice()[place].abs();
            let most = bound.at(place, found, &|name| values[name]).unwrap();
            assert!((most / found / (f64::EPSILON / 2.0) - by_hand).abs() <= 1e-9 * by_hand, "{most:e} at {values:?}");
            let exact = laws[place].clone();
            let exact = if exact < big(0.0) { exact * big(-1.0) } else { exact };
            let error = (big(found) - exact).to_f64().value().abs();
            assert!(error <= most, "{place}: {error:e} exceeds {most:e} at {values:?}");
        }
    }
}
