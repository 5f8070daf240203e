//! Every public function of every mechanism and scene of the gallery at random arguments: its result or its error.
//!
//! `CALLS=10000 cargo test --release -p linkage-tests --test interpreted same_bits` is the full size: 47 997 843 calls, no
//! difference, in 642 s of one core.

use std::collections::BTreeMap;

use linkage_called::{ALL, Call, Called, Listed};
use linkage_interpreter::{CallError, Data, Design, Error, Mechanism, SceneDesign};

use crate::at_run_time::mechanisms;
use crate::drawn::Drawn;
use crate::printed::{Printed, read};

/// The share of extreme numbers in the second half of the calls.
const EXTREME: f64 = 0.02;

/// The share of numbers near zero in further calls, half as many: groups are often nearly singular and computed in twice the
/// precision, and results are zeros with a sign.
const NEAR_ZERO: f64 = 0.8;

/// A mechanism or a scene at run time.
enum Built {
    Design(Design),
    Scene(SceneDesign),
}

impl Built {
    fn call(&self, function: &str, arguments: &[Data]) -> Result<Data, CallError> {
        match self {
            Self::Design(design) => design.call(function, arguments),
            Self::Scene(scene) => scene.call(function, arguments),
        }
    }
}

/// The findings about the functions that were called.
#[derive(Default)]
struct Found {
    calls: usize,
    results: usize,
    /// The first difference of a function, and the number of them.
    differences: BTreeMap<String, (usize, String)>,
}

#[test]
fn every_function_of_the_gallery() {
    let calls = linkage_trials::count("CALLS", 10, 50);
    let mut found = Found::default();
    let mut last: (&str, Vec<Mechanism>) = ("", Vec::new());
    for one in ALL {
        if last.0 != one.file {
            last = (one.file, mechanisms(one.file));
        }
        let mechanism = last.1.iter().find(|other| other.name() == one.name).expect("the mechanism");
        for (function, run) in one.functions {
            for call in 0..calls + calls / 2 {
                called(one, mechanism, (function, *run), (call, calls), &mut found);
            }
        }
    }
    let Found { calls, results, differences } = found;
    println!("{calls} calls of {} types, {results} with a result", ALL.len());
    let differences: Vec<String> =
        differences.iter().map(|(function, (count, first))| format!("{function}, {count} times: {first}")).collect();
    assert!(differences.is_empty(), "{}", differences.join("\n"));
    assert!(results > calls / 2, "{results} of {calls} calls have a result");
}

fn called(
    of: &Called,
    mechanism: &Mechanism,
    (function, run): (&str, Call),
    (call, calls): (usize, usize),
    found: &mut Found,
) {
    let mut drawn = match call {
        _ if call >= calls => Drawn::near_zero(call as u64, NEAR_ZERO),
        _ if 2 * call >= calls => Drawn::new(call as u64, EXTREME),
        _ => Drawn::new(call as u64, 0.0),
    };
    let parameters: Vec<f64> = mechanism.design().parameters().iter().map(|value| drawn.near(*value)).collect();
    let design = mechanism.design().with_parameters(&parameters);
    let built = match of.scene {
        None => Built::Design(design.clone()),
        Some(scene) => {
            let own: Vec<f64> = (parameters.len()..of.parameters).map(|_| drawn.size()).collect();
            Built::Scene(design.scene(scene).expect("the scene").with_parameters(&own))
        }
    };
    let arguments = match &built {
        Built::Design(design) => design.arguments(function),
        Built::Scene(scene) => scene.arguments(function),
    };
    let key = format!("{}: {}.{function}", of.file, of.scene.unwrap_or(of.name));
    let arguments = arguments.unwrap_or_else(|error| panic!("{key}: {error}"));
    let arguments: Vec<Data> =
        arguments.iter().map(|argument| drawn.argument(mechanism, &design, &argument.shape)).collect();
    let own = built.call(function, &arguments);
    found.calls += 1;
    found.results += usize::from(own.is_ok());
    // The side of a position that is none has the sign of a NaN, which Rust leaves open.
    if function.starts_with("branch_") && drawn.all.iter().any(|number| !number.is_finite()) {
        return;
    }
    let emitted = run(&mut Listed(&drawn.all));
    let difference = match &own {
        Ok(own) => difference("", &read(&emitted), own),
        Err(error) => {
            let own = match error {
                CallError::Function(Error::Position(error)) => format!("Err({error:?})"),
                CallError::Function(Error::Motion(error)) => format!("Err({error:?})"),
                other => other.to_string(),
            };
            (emitted != own).then(|| format!("{emitted} and {own}"))
        }
    };
    if let Some(difference) = difference {
        let first = difference.chars().take(400).collect();
        found.differences.entry(key).or_insert((0, first)).0 += 1;
    }
}

/// The difference between a result as emitted code has it, and one at run time.
fn difference(path: &str, emitted: &Printed, own: &Data) -> Option<String> {
    let differs = || Some(format!("{path}: {emitted:?} and {own:?}"));
    match (emitted, own) {
        (Printed::Number(one), Data::Number(other)) if is_same(*one, *other) => None,
        (Printed::Number(one), Data::Count(other)) if *one == *other as f64 => None,
        (Printed::Word(one), Data::Text(other)) if **other == **one => None,
        (Printed::Word(one), Data::Flag(other)) if *one == other.to_string() => None,
        (Printed::Word(one), Data::Nothing) if ["None", "OfGuess"].contains(&one.as_str()) => None,
        (Printed::List(all), Data::Nothing) if all.is_empty() => None,
        (Printed::Case(name, inside), own) if ["Some", "Ok", "Number"].contains(&name.as_str()) => {
            difference(path, &inside[0], own)
        }
        (Printed::List(all), Data::List(own)) if all.len() == own.len() => {
            let mut pairs = all.iter().zip(own).enumerate();
            let found = pairs.find_map(|(place, (one, other))| difference(&format!("{path}.{place}"), one, other));
            // nalgebra writes a matrix by columns.
            found.filter(|_| !has_numbers(emitted, &by_columns(own)))
        }
        // A case of several, by its name.
        (Printed::Fields(name, all), Data::Fields(own)) if own.len() == 1 && *own[0].0 == **name => {
            difference(path, &Printed::Fields(String::new(), all.clone()), &own[0].1)
        }
        (Printed::Fields(_, all), Data::Fields(own)) => {
            // The mark of a type without numbers.
            let all: Vec<_> = all.iter().filter(|(name, _)| name != "scalar").collect();
            if all.len() != own.len() {
                return differs();
            }
            all.into_iter().find_map(|(name, one)| match own.iter().find(|(field, _)| **field == **name) {
                Some((_, other)) => difference(&format!("{path}.{name}"), one, other),
                None => Some(format!("{path}: no {name} in {own:?}")),
            })
        }
        // A point, a direction, or a matrix of other sizes as it is written: its numbers in order.
        (one, other) if has_numbers(one, &other.numbers()) || has_numbers(one, &by_columns(other.list())) => None,
        _ => differs(),
    }
}

/// True for the same bits. Rust leaves those of NaN open.
fn is_same(one: f64, other: f64) -> bool {
    one.to_bits() == other.to_bits() || one.is_nan() && other.is_nan()
}

/// True if these are the numbers, in order.
fn has_numbers(emitted: &Printed, own: &[f64]) -> bool {
    let mut numbers = Vec::new();
    emitted.numbers(&mut numbers);
    numbers.len() == own.len() && numbers.iter().zip(own).all(|(one, other)| is_same(*one, *other))
}

fn by_columns(rows: &[Data]) -> Vec<f64> {
    let rows: Vec<Vec<f64>> = rows.iter().map(Data::numbers).collect();
    let columns = rows.first().map_or(0, Vec::len);
    (0..columns).flat_map(|column| rows.iter().filter_map(move |row| row.get(column).copied())).collect()
}
