//! Columns and rows of positions: each has the bits of the function for one position, or its error.

use linkage_gallery::FILES;
use linkage_interpreter::{CallError, Columns, Data, Design, Values};

use crate::at_run_time::mechanisms;
use crate::drawn::Drawn;

/// More than one block, and a part of one.
const POSITIONS: usize = 150;

#[test]
fn columns_have_the_bits_of_one_position() {
    let (mut compared, mut rejected) = (0, 0);
    for (seed, file) in FILES.iter().enumerate() {
        for mechanism in mechanisms(file) {
            let seed = seed as u64;
            let all =
                [(Drawn::new(seed, 0.0), false), (Drawn::new(seed, 0.02), true), (Drawn::near_zero(seed, 0.8), true)];
            for (mut drawn, has_columns_of_parameters) in all {
                let branch = drawn.branch(&mechanism);
                let design = mechanism.design();
                let all = Given::drawn(&design, &mut drawn, has_columns_of_parameters);
                let columns = all.computed(&design, &branch);
                all.each_row_is_that_of(&columns, &design, &branch);
                let mut left = columns.rejected.iter().peekable();
                for place in 0..POSITIONS {
                    let alone = all.alone(&design, &branch, place);
                    match (alone, left.next_if(|rejected| rejected.place == place)) {
                        (Ok(alone), None) => compared += same(&all, &columns, place, &alone, mechanism.name()),
                        (Err(CallError::Function(error)), Some(one)) => {
                            assert_eq!(
                                format!("{error:?}"),
                                format!("{:?}", one.error),
                                "{} {place}",
                                mechanism.name()
                            );
                            rejected += 1;
                        }
                        (alone, one) => panic!("{} {place}: {alone:?} {one:?}", mechanism.name()),
                    }
                }
            }
        }
    }
    assert!(compared > 50_000 && rejected > 1000, "{compared} numbers, {rejected} positions without a result");
}

/// The given columns of a design.
struct Given {
    names: Vec<String>,
    values: Vec<Vec<f64>>,
    found: Vec<String>,
    parameters: usize,
    inputs: usize,
}

impl Given {
    fn drawn(design: &Design, drawn: &mut Drawn, has_columns_of_parameters: bool) -> Self {
        let names = design.given_columns().expect("columns").to_vec();
        let found = design.found_columns().expect("columns").to_vec();
        let parameters = design.parameters().len();
        let values = names.iter().enumerate().map(|(place, _)| match design.parameters().get(place) {
            Some(value) if has_columns_of_parameters => (0..POSITIONS).map(|_| drawn.near(*value)).collect(),
            Some(value) => vec![drawn.near(*value); POSITIONS],
            None => (0..POSITIONS).map(|_| drawn.number()).collect(),
        });
        let inputs = design.mechanism().sizes()[1];
        Self { values: values.collect(), names, found, parameters, inputs }
    }

    fn computed(&self, design: &Design, branch: &Data) -> Columns {
        let given: Vec<(&str, Values<'_>)> =
            self.names.iter().zip(&self.values).map(|(name, values)| (name.as_str(), Values::Each(values))).collect();
        let found: Vec<&str> = self.found.iter().map(String::as_str).collect();
        design.columns(&given, branch, &found).expect("columns")
    }

    /// Some of the same positions one at a time.
    fn each_row_is_that_of(&self, columns: &Columns, design: &Design, branch: &Data) {
        let [names, found] = [&self.names, &self.found].map(|all| all.iter().map(String::as_str).collect::<Vec<_>>());
        let mut row = design.row(&names, branch, &found).expect("a row");
        let mut numbers = vec![0.0; found.len()];
        for place in (0..POSITIONS).step_by(11) {
            let rejected = columns.rejected.iter().find(|rejected| rejected.place == place);
            let given: Vec<f64> = self.values.iter().map(|values| values[place]).collect();
            match (row.find(&given, &mut numbers), rejected) {
                (Ok(()), None) => {
                    let expected = columns.columns.iter().map(|column| column[place].to_bits());
                    assert!(expected.eq(numbers.iter().map(|number| number.to_bits())), "{place}");
                }
                (Err(CallError::Function(error)), Some(one)) => {
                    assert_eq!(format!("{error:?}"), format!("{:?}", one.error), "{place}");
                }
                (alone, one) => panic!("{place}: {alone:?} {one:?}"),
            }
        }
    }

    fn alone(&self, design: &Design, branch: &Data, place: usize) -> Result<Data, CallError> {
        let at =
            |from: usize, to: usize| -> Vec<f64> { self.values[from..to].iter().map(|values| values[place]).collect() };
        let end = self.names.len();
        let (rates, accelerations) = (end - 2 * self.inputs, end - self.inputs);
        let start = at(self.parameters, rates);
        let design = design.clone().with_parameters(&at(0, self.parameters));
        // A mechanism without closed form starts at a guess, with all its coordinates.
        let function = if design.arguments("kinematics_near").is_ok() { "kinematics_near" } else { "kinematics" };
        let moving = [at(rates, accelerations), at(accelerations, end)];
        let [rates, accelerations] = moving.each_ref().map(|numbers| Data::from(numbers.as_slice()));
        design.call(function, &[Data::from(start.as_slice()), branch.clone(), rates, accelerations])
    }
}

/// Compares the columns of a position by name with the result for it; returns how many.
fn same(given: &Given, columns: &Columns, place: usize, alone: &Data, mechanism: &str) -> usize {
    let mut compared = 0;
    for (part, ending) in [("rates", "_rate"), ("accelerations", "_acceleration")] {
        let Some(Data::Fields(fields)) = alone.get(part) else { panic!("{alone:?}") };
        for (field, value) in fields {
            let name = format!("{field}{ending}");
            let Some(column) = given.found.iter().position(|other| *other == name) else { continue };
            let (own, value) = (columns.columns[column][place], value.number().expect("a number"));
            assert_eq!(own.to_bits(), value.to_bits(), "{mechanism} {name} {place}: {own} and {value}");
            compared += 1;
        }
    }
    compared
}

/// The mistakes of a row, and numbers that it takes as constants.
#[test]
fn a_row_has_the_numbers_that_it_asks_for() {
    let mechanism = mechanisms("four_bar").remove(0);
    let design = mechanism.design();
    let branch = Data::fields([("theta3_theta4", "left".into())]);
    let mistake = |result: Result<(), CallError>| match result {
        Err(CallError::Mistake(mistake)) => mistake.to_string(),
        other => panic!("{other:?}"),
    };
    let row = |given: &[&str], found: &[&str]| design.row(given, &branch, found).map(|_| ());
    assert_eq!(
        mistake(row(&[], &["theta3_rate"])),
        mistake(design.columns(&[], &branch, &["theta3_rate"]).map(|_| ()))
    );
    assert!(mistake(row(&["theta5"], &["theta3_rate"])).contains("theta5"));
    assert!(mistake(row(&["theta2"], &["theta5_rate"])).contains("theta5_rate"));

    let mut row = design.row(&["theta2_rate", "theta2"], &branch, &["theta4_rate", "theta3_rate"]).unwrap();
    let mut found = [0.0; 2];
    assert_eq!(mistake(row.find(&[1.0], &mut found)), "the list of given numbers has 1 of 2");
    assert_eq!(mistake(row.find(&[1.0, 0.5], &mut found[..1])), "the list of found numbers has 1 of 2");
    row.find(&[2.0, 0.5], &mut found).unwrap();
    let given = [("theta2", Values::Same(0.5)), ("theta2_rate", Values::Same(2.0))];
    let columns = design.columns(&given, &branch, &["theta4_rate", "theta3_rate"]).unwrap();
    assert_eq!(found.as_slice(), columns.columns.concat());
    // A position after one that does not exist.
    assert!(matches!(row.find(&[1.0, f64::NAN], &mut found), Err(CallError::Function(_))));
    let before = found;
    row.find(&[2.0, 0.5], &mut found).unwrap();
    assert_eq!(found, before);
}
