//! Operations as text: `let`, `check` and `return` lines, in the order of the code.

use std::fmt::Write;

use super::name::{ascii, reserved, symbol};
use super::operations::{Check, Operation, Operations, Place};
use super::value::{Role, Value};
use crate::emit::rust::parts_of_pi;
use crate::graph::Number;
use crate::model::Mechanism;
use crate::program::{Order, Taken};

/// The lines of the formulas that numbers of a value have; empty if none has one.
pub(super) fn written(mechanism: &Mechanism, operations: &Operations, checks: &[Check], value: &Value) -> String {
    let mut results = Vec::new();
    value.each_number("", &mut |path, place| results.push((path.to_owned(), place)));
    // An argument or a constant as a result is exact.
    results.retain(|(_, place)| !operations.operation(*place).is_leaf());
    let uses = Uses::of(operations, checks, &results);
    let mut text = String::new();
    if results.is_empty() {
        return text;
    }
    let reserved = reserved();
    let mut names = Names { operations, taken: Taken::new(&reserved), texts: vec![String::new(); uses.counts.len()] };
    names.arguments(mechanism, &uses);
    for place in operations.places().filter(|place| uses.is_used(*place)) {
        let formula = names.formula(place);
        names.texts[place.index()] = if uses.has_line[place.index()] {
            let name = names.unique(operations.preferred(place).unwrap_or("value"));
            let _ = writeln!(text, "let {name} {formula}");
            name
        } else {
            formula
        };
    }
    for Check { word, of } in checks {
        let _ = writeln!(text, "check {word} {}", names.all(of));
    }
    for (path, place) in results {
        let _ = writeln!(text, "return {} {}", ascii(&path), names.texts[place.index()]);
    }
    text
}

/// The operations that results and checks need.
struct Uses {
    counts: Vec<usize>,
    /// True for an operation with a name or with several uses.
    has_line: Vec<bool>,
}

impl Uses {
    fn of(operations: &Operations, checks: &[Check], results: &[(String, Place)]) -> Self {
        let count = operations.places().count();
        let mut uses = Self { counts: vec![0; count], has_line: vec![false; count] };
        let mut of_checks = vec![false; count];
        for check in checks {
            check.of.iter().for_each(|place| uses.counts[place.index()] += 1);
            // The first decides the results that the check is for: it needs a name.
            check.of.iter().take(1).for_each(|place| of_checks[place.index()] = true);
        }
        let mut is_inner = vec![false; count];
        results.iter().for_each(|(_, place)| uses.counts[place.index()] += 1);
        // Operands come before their operations.
        for place in operations.places().rev() {
            if uses.is_used(place) {
                operations.operation(place).each_operand(|operand| {
                    uses.counts[operand.index()] += 1;
                    is_inner[operand.index()] = true;
                });
            }
        }
        for place in operations.places() {
            let at = place.index();
            let is_named = operations.preferred(place).is_some() && is_inner[at];
            let is_line = is_named || uses.counts[at] > 1 || of_checks[at];
            uses.has_line[at] = is_line && !operations.operation(place).is_leaf();
        }
        uses
    }

    fn is_used(&self, place: Place) -> bool {
        self.counts[place.index()] > 0
    }
}

/// The names and texts of operations so far.
struct Names<'a> {
    operations: &'a Operations,
    taken: Taken<'a>,
    texts: Vec<String>,
}

impl Names<'_> {
    /// Names all arguments, before the lines. Parameters and coordinates come first, also those that are not used: an
    /// argument has one name in all functions.
    fn arguments(&mut self, mechanism: &Mechanism, uses: &Uses) {
        let parameters = mechanism.parameters.iter().chain(&mechanism.scene_parameters);
        let parameters = parameters.map(|parameter| (Role::Parameters, &parameter.name.field));
        let coordinates = Order::ALL.into_iter().flat_map(|order| {
            mechanism.coordinates.iter().map(move |coordinate| (Role::Motion(order), &coordinate.name.field))
        });
        for (role, field) in parameters.chain(coordinates) {
            let name = self.unique(&role.name(field));
            if let Some(place) = self.operations.known(&role.key(std::slice::from_ref(field))) {
                self.texts[place.index()] = name;
            }
        }
        let is_new = |place: &Place| uses.is_used(*place) && self.texts[place.index()].is_empty();
        let others: Vec<Place> = self.operations.places().filter(is_new).collect();
        for place in others {
            if matches!(self.operations.operation(place), Operation::Argument) {
                let name = self.unique(self.operations.preferred(place).unwrap_or_default());
                self.texts[place.index()] = name;
            }
        }
    }

    fn unique(&mut self, preferred: &str) -> String {
        self.taken.unique(&symbol(preferred))
    }

    fn text(&self, place: Place) -> &str {
        &self.texts[place.index()]
    }

    fn all(&self, places: &[Place]) -> String {
        places.iter().map(|place| self.text(*place)).collect::<Vec<_>>().join(" ")
    }

    /// The formula of an operation whose operands have texts.
    fn formula(&self, place: Place) -> String {
        match self.operations.operation(place) {
            Operation::Argument => self.text(place).to_owned(),
            Operation::Number(number) => constant(*number),
            Operation::Sum(terms) => {
                let signed = terms.iter().map(|(is_negative, term)| (if *is_negative { "-" } else { "+" }, *term));
                self.left_to_right(signed)
            }
            Operation::Product(factors) => self.left_to_right(factors.iter().map(|factor| ("*", *factor))),
            Operation::Quotient(parts) => format!("(/ {})", self.all(parts)),
            Operation::Square(base) => format!("(* {0} {0})", self.text(*base)),
            Operation::Negative(inside) => format!("(- {})", self.text(*inside)),
            Operation::Call(name, arguments) => format!("({name} {})", self.all(arguments)),
        }
    }

    /// `(- (+ a b) c)`: each operator with everything to its left; a sum may begin with a minus.
    fn left_to_right<'o>(
        &self,
        operands: impl DoubleEndedIterator<Item = (&'o str, Place)> + Clone + ExactSizeIterator,
    ) -> String {
        let mut text: String = operands.clone().skip(1).rev().map(|(operator, _)| format!("({operator} ")).collect();
        for (number, (operator, operand)) in operands.enumerate() {
            let operand = self.text(operand);
            text += &match (number, operator) {
                (0, "-") => format!("(- {operand})"),
                (0, _) => operand.to_owned(),
                _ => format!(" {operand})"),
            };
        }
        text
    }
}

/// The constant as emitted code computes it.
fn constant(number: Number) -> String {
    if let Some((count, parts)) = parts_of_pi(number) {
        let multiple = if count == 1.0 { "PI".to_owned() } else { format!("(* PI {count})") };
        return if parts == 1.0 { multiple } else { format!("(/ {multiple} {parts})") };
    }
    let value = number.to_f64();
    match number {
        _ if value.is_nan() => "NAN".to_owned(),
        _ if value.is_infinite() => if value > 0.0 { "INFINITY" } else { "(- INFINITY)" }.to_owned(),
        Number::Ratio(n, d) if format!("{value}").len() > 8 => format!("(/ {n} {d})"),
        _ => format!("{value:?}").trim_end_matches(".0").to_owned(),
    }
}
