//! The errors of the emitted code in ulp times condition number, and its bits in another unit of length.

use linkage_compiler::ids::{Id, UnknownId};
use linkage_gallery::listed::Listed;
use linkage_oracle::precise::{Big, Scalar, big};
use rand::SeedableRng;
use rand::rngs::SmallRng;

use super::reference::{Motion, Reference};
use super::run;

/// The error bound, in ulp times condition number.
pub(super) const ULPS: f64 = 8.0;

/// Poses of each mechanism; the environment variable asks for the full number.
fn poses() -> usize {
    linkage_trials::count("POSES", 10, 40)
}

/// The largest error in ulp times condition number, with its place.
#[derive(Default, Clone)]
pub(super) struct Worst {
    pub(super) error: f64,
    pub(super) place: String,
}

impl Worst {
    fn note(&mut self, found: &[f64], expected: &[Big], conditions: &[f64], place: impl Fn(usize) -> String) {
        for (index, ((&found, expected), condition)) in found.iter().zip(expected).zip(conditions).enumerate() {
            assert!(found.is_finite(), "{}", place(index));
            let size = condition.max(expected.double().abs());
            let error = (big(found) - expected).double().abs();
            let error = if error == 0.0 { 0.0 } else { error / (f64::EPSILON * size) };
            if error > self.error {
                *self = Self { error, place: place(index) };
            }
        }
    }
}

pub(super) fn largest_errors(of: &dyn Listed<f64>) -> [Worst; 3] {
    let (reference, file, branches) = (Reference::new(of), of.name(), of.branch_count());
    let mut random = SmallRng::seed_from_u64(linkage_trials::seed(20_091_121));
    let mut worst: [Worst; 3] = Default::default();
    let (mut count, mut missed) = (0, 0);
    let (unknowns, place_of) = (&reference.derivation.unknowns, &reference.derivation.coordinates);
    while count < poses() {
        let data = reference.data(&mut random, branches);
        let Some(motions) = run(of, &data) else {
            missed += 1;
            // Two groups of four unknowns assemble at few random inputs.
            assert!(missed < 400 * poses().max(40), "{file}: hardly anything can be assembled");
            continue;
        };
        let of_unknowns = |motion: &Motion| -> Vec<f64> {
            motion.coordinates.iter().flat_map(|q| unknowns.iter().map(|&place| q[place.index()])).collect()
        };
        let found = of_unknowns(&motions[0]);
        let Some(y) = reference.solve(&data, &found, &vec![0.0; found.len()]) else {
            // At a dead point half of the digits are lost, and Newton's method halves the rest step by step.
            if reference.regularity(&data, &found) < 1e-7 {
                missed += 1;
                continue;
            }
            let near = &motions[0].coordinates;
            panic!("{file}: nothing near {near:?} closes {:?} at {:?}", data.parameters, data.inputs)
        };
        count += 1;
        let n = unknowns.len();
        let rounded: Vec<f64> = y.iter().map(Scalar::double).collect();
        let (conditions_of_unknowns, of_points) = reference.conditions(&data, &rounded);
        let points = reference.evaluate(&reference.points, &data, &y);
        let third = points.len() / 3;
        for motion in &motions {
            let found = of_unknowns(motion);
            for (order, worst) in worst.iter_mut().enumerate() {
                let at = |what: String| {
                    format!("{what} at {:?}, branch {}, of {:?}", data.inputs, data.branch, data.parameters)
                };
                let part = order * n..(order + 1) * n;
                worst.note(&found[part.clone()], &y[part.clone()], &conditions_of_unknowns[part], |index| {
                    at(place_of[unknowns[UnknownId::new(index)]].name.clone())
                });
                let part = order * third..(order + 1) * third;
                let (expected, conditions) = (&points[part.clone()], &of_points[part.clone()]);
                let of_point = |index| at(format!("point {}", index / 2 + 1));
                let mut off = Worst::default();
                off.note(&motion.points[order], expected, conditions, of_point);
                if off.error > ULPS {
                    println!("{file}: {:.2} ulp x condition as differentiated, {}", off.error, off.place);
                    let measured = reference.measured_conditions(&data, &y, &found).expect("positions an ulp away");
                    off = Worst::default();
                    off.note(&motion.points[order], expected, &measured[part], of_point);
                    println!("{file}: {:.2} ulp x condition as measured, {}", off.error, off.place);
                }
                if off.error > worst.error {
                    *worst = off;
                }
            }
        }
    }
    for (order, worst) in ["position", "velocity", "acceleration"].iter().zip(&worst) {
        println!("{file:22} {order:13} {:6.2} ulp x condition: {}", worst.error, worst.place);
    }
    worst
}

/// Mechanisms with a number as a length in a constraint, which do not scale.
const WITH_NUMBERS: [&str; 2] = ["drag_link_drive", "slider_named_first"];

/// At lengths 2^k times as long, everything has the same bits but for its exponent; angles are equal. Points with a
/// number as a length are left out.
pub(super) fn unit_of_length(of: &dyn Listed<f64>) {
    let reference = Reference::new(of);
    let with_points = reference.powers_of_length(true);
    let scales_points = with_points.is_some();
    let Some(powers) = with_points.or_else(|| reference.powers_of_length(false)) else {
        assert!(WITH_NUMBERS.contains(&of.file()), "a number for a length: add it to WITH_NUMBERS");
        return;
    };
    assert!(!WITH_NUMBERS.contains(&of.file()), "no number for a length: it is not one of WITH_NUMBERS");
    let mut random = SmallRng::seed_from_u64(linkage_trials::seed(5));
    let (mut found, most) = (0, linkage_trials::count("UNITS", 20, 100));
    for _ in 0..5000 {
        let data = reference.data(&mut random, of.branch_count());
        let Some(plain) = run(of, &data) else { continue };
        found += 1;
        if found > most {
            break;
        }
        for k in [-300, -37, -1, 2, 101, 300] {
            let scale = 2_f64.powi(k);
            let scaled = reference.scaled(&data, &powers, scale);
            let other = run(of, &scaled).unwrap_or_else(|| panic!("at 2^{k}: no position at {:?}", data.inputs));
            let of_coordinates = &powers[reference.mechanism.parameters.len()..];
            for ((plain, other), order) in
                plain.iter().zip(&other).flat_map(|pair| (0..3).map(move |order| (pair, order)))
            {
                let pairs = plain.coordinates[order].iter().zip(&other.coordinates[order]).zip(of_coordinates);
                for ((&one, &other), &power) in pairs {
                    assert_eq!(one * scale.powf(power), other, "at 2^{k}, order {order}, {:?}", data.inputs);
                }
                let points = plain.points[order].iter().zip(&other.points[order]).filter(|_| scales_points);
                for (&one, &other) in points {
                    assert_eq!(one * scale, other, "at 2^{k}: a point, order {order}, {:?}", data.inputs);
                }
            }
        }
    }
    assert!(found > 10, "{found} positions");
}
