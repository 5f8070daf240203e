//! Outputs that are angles, by their formulas, as the compiler tells them.
//!
//! A sum is an angle if one of its terms is, and none is a length. A term is one if it is a coordinate that is one, an inverse
//! function such as `atan2`, or a number times one of these.

use std::f64::consts::{PI, TAU};

use linkage_runtime::Mechanism;
use linkage_runtime::derivation::notation::Name;
use linkage_runtime::derivation::{ElementaryFunction, Equation, Formula, FormulaView};

/// Rests of Euclid's algorithm below this part of a jump are rounding errors.
const ROUNDED: f64 = 1e-9;

/// The most parts into which a jump is divided.
const MOST_PARTS: f64 = 16.0;

/// An output that is an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OutputAngle {
    /// The jump of its formula where an `atan2` in it goes from pi to -pi; of several, that of which all are multiples. None if
    /// there is no such, and the output is what its formula says.
    pub(super) jump: Option<f64>,
    has_jumps: bool,
}

/// A term of a sum.
enum Term {
    Angle,
    /// A number times an `atan2`, or a sum of such, with the jump.
    Jumping(Option<f64>),
    Length,
    Other,
}

/// The output of these equations, if it is an angle.
pub(super) fn of_output<M: Mechanism>(mechanism: &M, value: &[Equation<'_>]) -> Option<OutputAngle> {
    let [equation] = value else { return None };
    angle(mechanism, equation.right)
}

fn angle<M: Mechanism>(mechanism: &M, formula: Formula<'_>) -> Option<OutputAngle> {
    let terms: Vec<Term> = match formula.view() {
        FormulaView::Sum(terms) => terms.iter().map(|(_, term)| scaled(mechanism, 1.0, term)).collect(),
        _ => vec![scaled(mechanism, 1.0, formula)],
    };
    let jumps = terms.iter().filter_map(|term| if let Term::Jumping(jump) = term { Some(*jump) } else { None });
    let jump = jumps.reduce(|one, other| common(one?, other?));
    let has_angle = terms.iter().any(|term| matches!(term, Term::Angle | Term::Jumping(_)));
    let has_length = terms.iter().any(|term| matches!(term, Term::Length));
    (has_angle && !has_length).then_some(OutputAngle { jump: jump.flatten(), has_jumps: jump.is_some() })
}

/// The largest of which two jumps are multiples, by Euclid's algorithm. None if it is so small that a motion cannot be followed
/// in steps that are small next to it.
fn common(one: f64, other: f64) -> Option<f64> {
    let [small, large] = [one.min(other), one.max(other)];
    let (mut measure, mut rest) = (small, large);
    while rest > ROUNDED * small {
        // The multiple next to it, since a quotient of rounded numbers may be just below.
        (measure, rest) = (rest, (measure - (measure / rest).round() * rest).abs());
    }
    (measure * MOST_PARTS >= small).then_some(measure)
}

/// A number times a term.
fn scaled<M: Mechanism>(mechanism: &M, factor: f64, formula: Formula<'_>) -> Term {
    let product = |factors: &[Formula<'_>]| {
        let (mut factor, mut others) = (factor, factors.iter().filter(|of| number(**of).is_none()));
        for number in factors.iter().filter_map(|of| number(*of)) {
            factor *= number;
        }
        match (others.next(), others.next()) {
            (Some(of), None) => scaled(mechanism, factor, *of),
            _ => Term::Other,
        }
    };
    match formula.view() {
        FormulaView::Name(Name::Plain(name)) => {
            let mut are_angles = mechanism.unknown_angles().iter().chain(mechanism.input_angles()).enumerate();
            let found = are_angles.find(|(column, _)| mechanism.coordinate_name(*column).to_string() == name);
            found.map_or(Term::Other, |(_, is_angle)| if *is_angle { Term::Angle } else { Term::Length })
        }
        FormulaView::Call(ElementaryFunction::Atan2, _) => Term::Jumping(Some(TAU * factor.abs())),
        FormulaView::Call(ElementaryFunction::Asin | ElementaryFunction::Acos | ElementaryFunction::Atan, _) => {
            Term::Angle
        }
        FormulaView::Call(ElementaryFunction::Abs, of) if of.iter().all(|of| angle(mechanism, of).is_some()) => {
            Term::Angle
        }
        FormulaView::Sum(_) => match angle(mechanism, formula) {
            Some(OutputAngle { jump, has_jumps: true }) => Term::Jumping(jump.map(|jump| jump * factor.abs())),
            Some(OutputAngle { has_jumps: false, .. }) => Term::Angle,
            None => Term::Other,
        },
        FormulaView::Product(factors) => product(&factors.iter().collect::<Vec<_>>()),
        FormulaView::Multiple(one, other) => product(&[one, other]),
        FormulaView::Quotient(of, by) => match number(by) {
            Some(by) => scaled(mechanism, factor / by, of),
            None => Term::Other,
        },
        _ => Term::Other,
    }
}

/// The value of a number.
fn number(formula: Formula<'_>) -> Option<f64> {
    match formula.view() {
        FormulaView::Integer(number) => Some(number as f64),
        FormulaView::Decimal(number) => Some(number),
        FormulaView::Pi => Some(PI),
        FormulaView::Quotient(one, other) => Some(number(one)? / number(other)?),
        _ => None,
    }
}

/// True if a name is in a formula.
pub(super) fn has_name(formula: Formula<'_>, name: &str) -> bool {
    match formula.view() {
        FormulaView::Name(Name::Plain(other)) => other == name,
        FormulaView::Sum(terms) => terms.iter().any(|(_, term)| has_name(term, name)),
        FormulaView::Product(all) | FormulaView::Call(_, all) | FormulaView::External(_, _, all) => {
            all.iter().any(|of| has_name(of, name))
        }
        FormulaView::Quotient(one, other) | FormulaView::Multiple(one, other) => {
            has_name(one, name) || has_name(other, name)
        }
        FormulaView::Power(base, _) => has_name(base, name),
        _ => false,
    }
}
