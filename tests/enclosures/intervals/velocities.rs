//! Velocities, accelerations and sensitivities over boxes contain the results of Gaussian elimination in 48 digits and
//! those of the emitted functions within their bounds of rounding error.

use std::cmp::Ordering;

use linkage::Interval;
use linkage_compiler::graph::NodeId;
use linkage_compiler::ids::Id;
use linkage_gallery::listed::{Listed, ListedWithOrders, Named as _};
use linkage_oracle::precise::{Big, Scalar, big};
use linkage_oracle::tape::Tape;
use linkage_oracle::{Oracle, Sample};
use linkage_rounding::Rounded;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::intervals::enclosures::contain;
use crate::intervals::formulas::{At, Enclosable, Enclosed, Unproved, nodes};
use crate::intervals::poses;

/// The mechanism in 48 digits: J, A, Psi_p and gamma.
struct Reference {
    oracle: Oracle,
    tape: Tape,
}

/// The radii of a box about a sample: of coordinates and rates, and of parameters.
#[derive(Clone, Copy)]
struct Radii {
    coordinates: f64,
    parameters: f64,
}

impl Reference {
    fn of(of: &Enclosable) -> Self {
        let mut oracle = Oracle::of(of);
        let residual = oracle.derivation.residual.to_vec();
        let (u, v) = (oracle.derivation.unknowns.len(), oracle.derivation.inputs.len());
        let all = nodes(&mut oracle);
        let mut roots: Vec<NodeId> = all[u..u + u * (u + v)].to_vec();
        for parameter in oracle.parameters().collect::<Vec<_>>() {
            roots.extend(oracle.derivation.graph.partial(&residual, parameter));
        }
        roots.extend(&oracle.derivation.gamma);
        let tape = oracle.tape(&roots);
        Self { oracle, tape }
    }

    /// The numbers of `Enclosed` by elimination; `None` if J is singular to 40 digits.
    fn precisely(&self, sample: &Sample) -> Option<Vec<Big>> {
        let values = self.oracle.precisely(&self.tape, sample);
        let at = At::of(sample, &self.oracle.derivation);
        let (u, v) = (at.unknowns.len(), at.inputs.len());
        let mut columns: Vec<Vec<Big>> =
            if u == 0 { Vec::new() } else { values.chunks(u).map(<[Big]>::to_vec).collect() };
        let mut right = columns.split_off(u);
        let gamma = right.pop().unwrap_or_default();
        let along = |rates: &[f64], start: Vec<Big>| {
            let add = |sum: Vec<Big>, (column, &rate): (&Vec<Big>, &f64)| {
                sum.iter().zip(column).map(|(sum, entry)| sum + entry * big(rate)).collect()
            };
            right[..v.min(right.len())].iter().zip(rates).fold(start, add)
        };
        let accelerations: Vec<f64> =
            self.oracle.derivation.inputs.iter().map(|column| sample.accelerations[column.index()]).collect();
        let velocity = along(&at.input_rates, vec![big(0.0); u]);
        let acceleration = along(&accelerations, gamma);
        right.extend([velocity, acceleration]);
        right
            .iter()
            .map(|column| solve(&columns, column.iter().map(|x| -x.clone()).collect()))
            .collect::<Option<Vec<_>>>()
            .map(|all| all.concat())
    }
}

/// Gaussian elimination with partial pivoting, J by its columns.
fn solve(columns: &[Vec<Big>], mut x: Vec<Big>) -> Option<Vec<Big>> {
    let count = x.len();
    let mut j: Vec<Vec<Big>> =
        (0..count).map(|row| columns.iter().map(|column| column[row].clone()).collect()).collect();
    let size = |row: &Vec<Big>, step: usize| row[step].double().abs();
    for step in 0..count {
        let pivot = (step..count).max_by(|&one, &other| {
            size(&j[one], step).partial_cmp(&size(&j[other], step)).unwrap_or(Ordering::Equal)
        })?;
        j.swap(step, pivot);
        x.swap(step, pivot);
        if size(&j[step], step) < 1e-40 {
            return None;
        }
        let (leading, right) = (j[step].clone(), x[step].clone());
        for (_, (row, x)) in j.iter_mut().zip(&mut x).enumerate().filter(|&(row, _)| row != step) {
            let factor = &row[step] / &leading[step];
            row.iter_mut().zip(&leading).for_each(|(entry, leading)| *entry = &*entry - &factor * leading);
            *x = &*x - &factor * &right;
        }
    }
    Some((0..count).map(|row| &x[row] / &j[row][row]).collect())
}

/// Encloses everything over a box about a sample.
fn enclosed(of: &Enclosable, oracle: &Oracle, sample: &Sample, radii: Radii) -> Result<Enclosed, Unproved> {
    let at = At::of(sample, &oracle.derivation);
    let around = |value: f64, radius: f64| Interval::around(value, radius).unwrap();
    let wide = At {
        parameters: at.parameters.iter().map(|&value| around(value, radii.parameters * value.abs())).collect(),
        ..at.map(|value| around(value, radii.coordinates))
    };
    let given = oracle.derivation.inputs.iter().map(|column| Interval::from(sample.accelerations[column.index()]));
    of.enclosed(&sample.parameters, &wide, &given.collect::<Vec<_>>())
}

/// A sample with its numbers moved inside the box; each function takes a number and its radius.
fn moved(oracle: &Oracle, sample: &Sample, radii: Radii, mut inner: impl FnMut(f64, f64) -> f64) -> Sample {
    let other = oracle.moved(sample, |parameter| inner(parameter, radii.parameters * parameter.abs()), |x| x);
    oracle.moved(&other, |parameter| parameter, |x| inner(x, radii.coordinates))
}

/// Asserts that an error is that of a mechanism whose equations call a user function.
fn has_user_function(of: &Enclosable, error: Unproved) {
    match error {
        Unproved::UserFunction => assert!(of.has_user_function()),
        Unproved::NotRegular { norm } => panic!("not regular: {norm}"),
        Unproved::Other(error) => panic!("{error}"),
    }
}

/// At numbers, where only rounding errors make an interval wide.
pub fn of_points(of: &Enclosable) {
    let reference = Reference::of(of);
    let mut widths = Vec::new();
    reference.oracle.at_samples(poses(), |_, sample| {
        let point = Radii { coordinates: 0.0, parameters: 0.0 };
        match enclosed(of, &reference.oracle, sample, point) {
            Ok(Enclosed { all, .. }) => {
                let exact = reference.precisely(sample).unwrap();
                contain(&all, &exact);
                let largest = all.iter().map(|x| x.magnitude()).fold(0.0, f64::max);
                widths.extend(all.iter().map(|x| x.width() / (f64::EPSILON * largest)));
            }
            Err(error) => has_user_function(of, error),
        }
    });
    print_quartiles(&format!("{}, widths in epsilons of the largest", of.name()), widths);
}

/// Over boxes: at random numbers inside, in 48 digits and by the emitted functions. The widths are compared with the
/// range to first order: the sum over all numbers of the difference of the results at the two ends of its interval.
pub fn of_boxes(of: &Enclosable, emitted: &dyn Listed<Rounded>) {
    let reference = Reference::of(of);
    let oracle = &reference.oracle;
    let mut random = SmallRng::seed_from_u64(linkage_trials::seed(20_091_123));
    let mut quotients = [Vec::new(), Vec::new(), Vec::new()];
    let (mut regular, mut singular) = (0, 0);
    oracle.at_samples(poses(), |number, sample| {
        let coordinates = 10_f64.powf(random.random_range(-7.0..-2.0));
        let radii = Radii { coordinates, parameters: if number % 2 == 0 { coordinates } else { 0.0 } };
        let found = match enclosed(of, oracle, sample, radii) {
            Ok(found) => found,
            Err(Unproved::NotRegular { norm }) => {
                assert!(norm >= 1.0);
                singular += 1;
                return;
            }
            Err(error) => return has_user_function(of, error),
        };
        regular += 1;
        for _ in 0..3 {
            let inner = moved(oracle, sample, radii, |x, radius| x + radius * random.random_range(-1.0..1.0));
            contain(&found.all, &reference.precisely(&inner).unwrap());
            contain_emitted(emitted, oracle, &found, &inner);
        }
        let ranges = first_order_ranges(&reference, sample, radii);
        for (place, (interval, range)) in found.all.iter().zip(ranges).enumerate() {
            // A result that depends on nothing, or does so by rounding errors only.
            if range > 1e-9 * coordinates * interval.magnitude() {
                let kind = found.ends.iter().filter(|&&end| place >= end).count();
                quotients[kind].push(interval.width() / range);
            }
        }
    });
    println!("{}: {regular} regular boxes, {singular} not proved", of.name());
    assert_eq!(regular > 0, !of.has_user_function(), "{regular} regular boxes");
    for (what, quotients) in ["ratios and sensitivities", "velocities", "accelerations"].iter().zip(quotients) {
        let median = print_quartiles(&format!("{}, {what}, width by range", of.name()), quotients);
        assert!(median.is_none_or(|median| median < 1.5), "{what}: {median:?}");
    }
}

/// The emitted velocity and acceleration, each within its bound of rounding error, meet the enclosures.
fn contain_emitted(emitted: &dyn Listed<Rounded>, oracle: &Oracle, found: &Enclosed, sample: &Sample) {
    let pose = emitted.with_parameters(&rounded(&sample.parameters)).pose(&rounded(&sample.q));
    let inputs = |list: &[f64]| emitted.inputs_of(&rounded(list));
    let unknowns = |all: Vec<Rounded>| oracle.derivation.unknowns.iter().map(move |column| all[column.index()]);
    let velocity = pose.velocity(&inputs(&sample.rates));
    let acceleration = pose.acceleration(&rounded(&sample.rates), &inputs(&sample.accelerations));
    let [start, end] = found.ends;
    for (what, intervals, emitted) in
        [("velocity", &found.all[start..end], velocity), ("acceleration", &found.all[end..], acceleration)]
    {
        // An error near a singular position, where the intervals are regular all the same.
        let Ok(emitted) = emitted else { continue };
        for (interval, emitted) in intervals.iter().zip(unknowns(emitted)) {
            meets(what, *interval, emitted);
        }
    }
}

fn rounded(list: &[f64]) -> Vec<Rounded> {
    list.iter().copied().map(Rounded::from).collect()
}

/// An emitted result within its bound, and an enclosure have numbers in common.
fn meets(what: &str, interval: Interval, emitted: Rounded) {
    // Nothing is known of a result with an infinite bound.
    let Some(all) = Interval::around(emitted.value(), emitted.error()) else { return };
    assert!(interval.intersection(all).is_some(), "{what}: {emitted} is outside {interval:?}");
}

/// The range of each result to first order.
fn first_order_ranges(reference: &Reference, sample: &Sample, radii: Radii) -> Vec<f64> {
    let numbers = sample.parameters.len() + 2 * sample.q.len();
    let mut ranges = Vec::new();
    for number in 0..numbers {
        let at = |sign: f64| {
            let mut place = 0;
            let inner = |x: f64, radius: f64| {
                place += 1;
                if place == number + 1 { x + sign * radius } else { x }
            };
            reference.precisely(&moved(&reference.oracle, sample, radii, inner)).unwrap()
        };
        let (low, high) = (at(-1.0), at(1.0));
        ranges.resize(low.len(), 0.0);
        for (range, (low, high)) in ranges.iter_mut().zip(low.iter().zip(&high)) {
            *range += (high - low).double().abs();
        }
    }
    ranges
}

/// The emitted sensitivities, each within its bound of rounding error, meet the enclosures.
pub fn of_sensitivities(of: &Enclosable, emitted: &dyn ListedWithOrders<Rounded>) {
    let oracle = Oracle::of(of);
    let ratios = oracle.derivation.unknowns.len() * oracle.derivation.inputs.len();
    let mut random = SmallRng::seed_from_u64(linkage_trials::seed(20_091_124));
    oracle.at_samples(poses(), |_, sample| {
        let coordinates = 10_f64.powf(random.random_range(-7.0..-2.0));
        let radii = Radii { coordinates, parameters: 1e-2 * coordinates };
        let Ok(found) = enclosed(of, &oracle, sample, radii) else { return };
        let inner = moved(&oracle, sample, radii, |x, radius| x + radius * random.random_range(-1.0..1.0));
        let pose = emitted.at(&rounded(&inner.parameters), &rounded(&inner.q));
        let Ok(emitted) = pose.sensitivity() else { return };
        assert_eq!(emitted.len(), found.ends[0] - ratios);
        for (interval, emitted) in found.all[ratios..].iter().zip(emitted.as_slice()) {
            meets("sensitivity", *interval, *emitted);
        }
    });
}

/// Prints the median and the largest of numbers, and returns the median.
fn print_quartiles(what: &str, mut numbers: Vec<f64>) -> Option<f64> {
    numbers.sort_by(f64::total_cmp);
    let (median, most) = (*numbers.get(numbers.len() / 2)?, *numbers.last()?);
    println!("{what}: {} numbers, median {median:.3}, most {most:.3}", numbers.len());
    Some(median)
}
