//! The analysis by hand of every mechanism of the gallery: its formulas, which the compiler derives and a reader of
//! formulas evaluates, against its numbers, which the library finds from J, A and gamma of the emitted code.

use linkage::derivation::{Equation, FormulaMatrix, SheetDerivation};
use linkage::sheet::Values;
use linkage_gallery::checks::each;
use linkage_gallery::listed::{Analysed, ByHand, analysed};
use linkage_gallery::source;
use linkage_oracle::Oracle;
use linkage_report::lend::Lender;
use nalgebra::DMatrix;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Relative error of a number against the largest of its matrix.
const TOLERANCE: f64 = 1e-11;

/// Relative error of accelerations and determinants at random poses, of which some are near a singular one.
const SOLVED: f64 = 1e-8;

/// Poses per mechanism.
const POSES: usize = 5;

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most, number| most.max(number.abs()))
}

/// Numbers that are close to those of formulas, relative to the largest of all; the number of those that have a formula.
fn close(what: &str, found: &[f64], formulas: &[Option<f64>], scale: f64, tolerance: f64) -> usize {
    assert_eq!(found.len(), formulas.len(), "{what}");
    let pairs = found.iter().zip(formulas).filter_map(|(found, formula)| Some((*found, (*formula)?)));
    let checked = pairs.inspect(|&(found, formula)| {
        assert!((found - formula).abs() <= tolerance * scale, "{what}: {found}, by its formula {formula}");
    });
    checked.count()
}

fn entries(matrix: &FormulaMatrix<'_>, values: &Values) -> Vec<Option<f64>> {
    let places = (0..matrix.columns).flat_map(|column| (0..matrix.rows).map(move |row| (row, column)));
    places.map(|(row, column)| matrix.entry(row, column).map_or(Some(0.0), |entry| values.value(entry))).collect()
}

fn right_sides(equations: &[Equation<'_>], values: &Values) -> Vec<Option<f64>> {
    equations.iter().map(|equation| values.value(equation.right)).collect()
}

/// The numbers of the sheet with a formula; the sheet itself is none for a mechanism with groups without formulas.
fn compared(sheet: &SheetDerivation<'_>, at: &ByHand) -> usize {
    let values = &at.values;
    let mut count = 0;
    let names = ["J'", "A'", "(J u')_u", "(A v')_v"];
    let numbers = at.jacobian_rates.iter().chain(&at.jacobians_of_rates);
    let formulas = sheet.jacobian_rates.iter().chain(&sheet.jacobians_of_rates);
    let scale = numbers.clone().map(|matrix: &DMatrix<f64>| largest(matrix.as_slice())).fold(0.0, f64::max);
    for ((name, numbers), formulas) in names.into_iter().zip(numbers).zip(formulas) {
        count += close(name, numbers.as_slice(), &entries(formulas, values), scale, TOLERANCE);
    }
    let scale = at.terms.iter().chain(&at.gamma_parts).map(|column| largest(column)).fold(0.0, f64::max);
    for (numbers, formulas) in at.terms.iter().chain(&at.gamma_parts).zip(sheet.terms.iter().chain(&sheet.gamma)) {
        count += close(&formulas.name.to_string(), numbers, &entries(formulas, values), scale, TOLERANCE);
    }
    for (numbers, formulas) in at.accelerations.iter().zip(sheet.accelerations) {
        count += close("u''", numbers, &right_sides(formulas, values), largest(numbers), SOLVED);
    }
    count
}

#[test]
fn formulas_give_the_numbers() {
    let (count, without) = (AtomicUsize::new(0), AtomicUsize::new(0));
    each(&analysed(), |of| {
        let mechanism = linkage_compiler::read(source::tokens_of(of.file())).unwrap().remove(0);
        let Ok(documents) = linkage_compiler::sheets(&mechanism) else {
            without.fetch_add(1, Ordering::Relaxed);
            return;
        };
        let document = documents.iter().find(|document| document.record.mechanism == of.name()).unwrap();
        let lender = Lender::default();
        let sheet = lender.sheet(document).unwrap();
        let oracle = Oracle::of(of);
        for sample in oracle.samples(POSES) {
            let pick = |list: &[f64]| -> Vec<f64> {
                oracle.derivation.inputs.iter().map(|input| list[linkage_compiler::ids::Id::index(*input)]).collect()
            };
            let (rates, given) = (pick(&sample.rates), pick(&sample.accelerations));
            let Ok(at) = of.analysis(&sample.parameters, &sample.q, &rates, &given) else { continue };
            count.fetch_add(compared(&sheet, &at), Ordering::Relaxed);
            count.fetch_add(singular(of, &sheet, &oracle, &sample, &at), Ordering::Relaxed);
        }
    });
    if std::env::var("MECHANISM").is_err() {
        let (count, without) = (count.into_inner(), without.into_inner());
        assert!(count > 10_000 && without > 5, "{count} numbers, {without} without formulas");
    }
}

/// The determinant of each choice of inputs by its formula, and by elimination.
fn singular(
    of: &dyn Analysed,
    sheet: &SheetDerivation<'_>,
    oracle: &Oracle,
    sample: &linkage_oracle::Sample,
    at: &ByHand,
) -> usize {
    let d = &oracle.derivation;
    let order: Vec<&str> =
        d.unknowns.iter().chain(&d.inputs).map(|column| d.coordinates[*column].name.as_str()).collect();
    let place = |name: String| order.iter().position(|other| *other == name);
    let names = |formula: &linkage::derivation::Formula<'_>| match formula.view() {
        linkage::derivation::FormulaView::Name(linkage::derivation::notation::Name::Plain(name)) => name.to_owned(),
        _ => String::new(),
    };
    let choices: Option<Vec<Vec<usize>>> = sheet
        .choices
        .iter()
        .map(|choice| choice.inputs.iter().map(|input| place(names(input))).collect::<Option<Vec<usize>>>())
        .collect();
    let choices = choices.unwrap();
    let numbers = of.determinants(&sample.parameters, &sample.q, &choices).unwrap();
    let formulas: Vec<Option<f64>> = sheet
        .choices
        .iter()
        .map(|choice| choice.determinant.and_then(|equation| at.values.value(equation.right)))
        .collect();
    close("det J of a choice", &numbers, &formulas, largest(&numbers), SOLVED)
}

/// H2 + H3 is gamma, as are its parts; both methods give the acceleration that the emitted code gives.
#[test]
fn the_terms_are_those_of_the_emitted_code() {
    each(&analysed(), |of| {
        let oracle = Oracle::of(of);
        for sample in oracle.samples(POSES) {
            let pick = |list: &[f64]| -> Vec<f64> {
                oracle.derivation.inputs.iter().map(|input| list[linkage_compiler::ids::Id::index(*input)]).collect()
            };
            let (rates, given) = (pick(&sample.rates), pick(&sample.accelerations));
            let Ok(at) = of.analysis(&sample.parameters, &sample.q, &rates, &given) else { continue };
            let scale = at.terms.iter().chain(&at.gamma_parts).map(|column| largest(column)).fold(0.0, f64::max);
            let [h1, h2, h3, h0] = &at.terms;
            let [by_unknowns, by_inputs, mixed] = &at.gamma_parts;
            for row in 0..at.gamma.len() {
                for sum in [h2[row] + h3[row], by_unknowns[row] + by_inputs[row] + mixed[row], h0[row] - h1[row]] {
                    assert!((sum - at.gamma[row]).abs() <= TOLERANCE * scale, "row {row}: {sum}, {}", at.gamma[row]);
                }
            }
            let [first, second] = &at.accelerations;
            for (first, other) in first.iter().zip(second) {
                assert!((first - other).abs() <= SOLVED * largest(second), "{first}, {other}");
            }
        }
    });
}

/// Every property of the velocity ratios by W and without it, at positions.
#[test]
fn velocity_ratios_have_their_properties() {
    let found = AtomicUsize::new(0);
    each(&analysed(), |of| {
        let oracle = Oracle::of(of);
        let sample = oracle.samples(1).next().unwrap();
        let rates = vec![1.5; oracle.derivation.inputs.len()];
        let Ok(properties) = of.properties(&sample.parameters, &sample.q, &rates) else { return };
        found.fetch_add(1, Ordering::Relaxed);
        // Difference quotients have the error of their step, displacements that of the second order.
        let tolerances = [1e-9, 1e-5, 1e-9, 0.1, 1e-9, 1e-9];
        for (number, (property, tolerance)) in (1..).zip(properties.iter().zip(tolerances)) {
            let scale = property.numbers.iter().fold(0.0_f64, |most, one| most.max(one.otherwise.abs()));
            for one in &property.numbers {
                let error = (one.by_ratios - one.otherwise).abs();
                assert!(error <= tolerance * scale, "property {number}, {}: {one:?}", one.name);
            }
        }
        assert_eq!(
            properties[5].numbers.is_empty(),
            rates.len() > 1 || properties[0].numbers.is_empty() && properties[4].numbers.is_empty()
        );
    });
    assert!(std::env::var("MECHANISM").is_ok() || found.into_inner() > 30);
}
