//! The formulas of emitted functions as FPCore: a reader of the standard evaluates each of them, in doubles with the
//! bits of the functions, in 48 digits to their rounding.
//!
//! `MECHANISM=four_bar cargo test --all-features --test digits fpcore` reads those of one mechanism, by its file or its name.

mod arithmetic;
mod one;
mod reader;

use std::collections::BTreeMap;

use linkage::Document;
use linkage::derivation::Derivation;
use linkage_gallery::checks::each;
use linkage_gallery::listed::{Listed, all};
use linkage_gallery::source;
use linkage_report::lend::Lender;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use reader::Core;

/// Mechanisms without formulas for rates: by pivoting, and equal to those of the input.
const WITHOUT: [&str; 2] = ["ThreeTogether", "Block"];

/// The derivation of a file as `derive fpcore` makes it, from that without.
fn with_code<'a>(lender: &'a Lender, file: &str, derivation: &Derivation) -> Derivation<'a> {
    let mechanism = linkage_compiler::read(source::tokens_of(file)).unwrap().remove(0);
    let (documents, _) = linkage_compiler::documents(&mechanism).unwrap();
    let document = documents.iter().find(|document| document.record.mechanism == derivation.mechanism).unwrap();
    lender.derivation(document).unwrap()
}

/// The formulas of a mechanism by name, each as it was read.
fn cores(derivation: &Derivation) -> BTreeMap<String, Core> {
    let all: Vec<Core> = derivation.fpcore().iter().map(|core| Core::read(&core.to_string())).collect();
    let count = all.len();
    let cores: BTreeMap<String, Core> = all.into_iter().map(|core| (core.name.clone(), core)).collect();
    assert_eq!(cores.len(), count, "a name twice");
    cores
}

/// The names of coordinates in the order of their fields.
fn coordinates(of: &dyn Listed<f64>) -> Vec<String> {
    let names: Vec<&str> = of.unknowns().iter().chain(of.inputs()).copied().collect();
    let numbers: Vec<f64> = (0..names.len()).map(|number| number as f64).collect();
    let (unknowns, inputs) = numbers.split_at(of.unknowns().len());
    of.coordinates(unknowns, inputs).into_iter().map(|number| names[number as usize].to_lowercase()).collect()
}

/// The sides of a branch as numbers, from its text: `phi_s: Far` is 1.
fn sides(branch: &str) -> Vec<(String, f64)> {
    let fields = branch.split(['{', '}', ',']).filter_map(|field| field.trim().split_once(": "));
    let sides = fields.filter(|(_, side)| side.parse::<i32>().is_err());
    let number = |side: &str| if ["Left", "Far", "Rising"].contains(&side) { 1.0 } else { -1.0 };
    sides.map(|(name, side)| (format!("{name}_side"), number(side))).collect()
}

/// Compares one number of a function with its formula, if it has one. Returns true if it was compared.
fn compare(cores: &BTreeMap<String, Core>, name: &str, data: &BTreeMap<String, f64>, emitted: f64) -> bool {
    let Some(core) = cores.get(name).filter(|core| core.is_valid(data)) else { return false };
    let value = core.value(data);
    // Zeros may differ in their signs: an angle of no turns is the sum of the principal value and zero.
    assert!(value == emitted, "{name}: {value:e} by its text, {emitted:e} by the function, at {data:?}");
    true
}

/// The names and numbers of a list.
fn numbered<'a>(names: &'a [String], list: &'a [f64]) -> impl Iterator<Item = (&'a str, f64)> {
    names.iter().map(String::as_str).zip(list.iter().copied())
}

#[test]
fn the_texts_have_the_bits_of_the_functions() {
    each(all(), agrees);
}

fn agrees(listed: &dyn Listed<f64>) {
    let derivation = listed.derivation();
    let lender = Lender::default();
    let (of, cores) = (listed.name(), cores(&with_code(&lender, listed.file(), derivation)));
    let (names, defaults) = (coordinates(listed), listed.defaults());
    let branches: Vec<_> = listed.branches().iter().map(|branch| sides(branch)).collect();
    let parameters: Vec<String> = derivation.parameters.iter().map(|symbol| symbol.name.to_lowercase()).collect();
    let points: Vec<String> = derivation.points.iter().map(|point| point.name.to_lowercase()).collect();
    let components: Vec<String> = points.iter().flat_map(|name| [format!("{name}.x"), format!("{name}.y")]).collect();
    let motions: Vec<String> =
        points.iter().flat_map(|name| [format!("{name}.acceleration.x"), format!("{name}.acceleration.y")]).collect();
    let mut rng = SmallRng::seed_from_u64(linkage_trials::seed(7));
    let mut compared = 0;
    for pose in 0..linkage_trials::count("FPCORE", 5, 20) {
        let values: Vec<f64> = defaults.iter().map(|value| value * rng.random_range(0.98..1.02)).collect();
        let m = listed.with_parameters(&values);
        let mut draw = || -> Vec<f64> { names.iter().map(|_| rng.random_range(-3.0..3.0)).collect() };
        let [q, rates, bent] = [draw(), draw(), draw()];
        let mut data: BTreeMap<String, f64> =
            numbered(&parameters, &values).map(|(name, x)| (name.to_owned(), x)).collect();
        for (list, ending) in [(&q, ""), (&rates, "_rate"), (&bent, "_acceleration")] {
            data.extend(numbered(&names, list).map(|(name, x)| (format!("{name}{ending}"), x)));
        }
        let mut compare = |function: &str, names: &[String], list: &[f64], data: &BTreeMap<String, f64>| {
            for (name, emitted) in numbered(names, list) {
                compared += usize::from(self::compare(&cores, &format!("{of}::{function}.{name}"), data, emitted));
            }
        };
        let [v_rates, v_bent] = [&rates, &bent].map(|list| listed.inputs_of(list));
        let at = m.pose(&q);
        if let Ok(list) = at.velocity(&v_rates) {
            compare("velocity", &names, &list, &data);
        }
        if let Ok(list) = at.acceleration(&rates, &v_bent) {
            compare("acceleration", &names, &list, &data);
        }
        if let Ok(list) = at.point_accelerations(&rates, &bent) {
            compare("point_accelerations", &components, &list, &data);
        }
        if let Ok(motion) = m.motion(&q, &v_rates, &v_bent) {
            compare("motion.accelerations", &names, &motion.coordinates[2], &data);
            compare("motion.points", &motions, &motion.points[2], &data);
        }
        let Some(sides) = branches.get(pose % branches.len().max(1)) else { continue };
        data.extend(sides.iter().cloned());
        if let Ok(moving) = m.moving(&q, pose % branches.len(), &v_rates, &v_bent, true) {
            compare("kinematics.rates", &names, &moving.rates, &data);
            compare("kinematics.accelerations", &names, &moving.accelerations, &data);
            if let Some([_, _, accelerations]) = moving.points {
                compare("full_kinematics.points", &motions, &accelerations, &data);
            }
        }
    }
    println!("| {of} | {} | {compared} |", cores.len());
    assert_eq!(compared > 0, !WITHOUT.contains(&of), "{of}: {compared} numbers compared");
}

/// An iteration, pivoting and user functions have no formula; all else of such a mechanism has one.
#[test]
fn functions_without_formulas() {
    let functions = |file: &str| {
        let mechanism = linkage_compiler::read(source::tokens_of(file)).unwrap().remove(0);
        let kernels = linkage_compiler::documents(&mechanism).unwrap().0.remove(0).record.kernels.into_iter();
        let with_code = kernels.filter(|kernel| !kernel.code.results.is_empty());
        with_code.map(|kernel| kernel.function).collect::<Vec<_>>()
    };
    for (file, with, without) in [
        ("double_butterfly", ["residual", "points"], ["velocity", "acceleration"]),
        ("cam_rocker", ["points", "jacobian_unknowns"], ["velocity", "acceleration"]),
    ] {
        let functions = functions(file);
        assert!(with.iter().all(|name| functions.iter().any(|function| function == name)), "{functions:?}");
        assert!(without.iter().all(|name| functions.iter().all(|function| function != name)), "{functions:?}");
    }
}
