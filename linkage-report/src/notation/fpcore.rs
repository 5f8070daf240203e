//! Expressions of FPCore.

use linkage_runtime::derivation::notation::Name;
use linkage_runtime::derivation::{Formula, FormulaList, FormulaView};

/// A formula as an expression: operators stand before their operands.
pub(super) fn expression(formula: Formula<'_>) -> String {
    match formula.view() {
        FormulaView::Name(Name::Plain(name)) => name.to_owned(),
        FormulaView::Integer(number) => number.to_string(),
        FormulaView::Decimal(number) => literal(number),
        FormulaView::Pi => "PI".to_owned(),
        FormulaView::Sum(terms) => {
            let terms = terms.iter().map(|(is_negative, term)| (if is_negative { '-' } else { '+' }, expression(term)));
            left_to_right(&terms.collect::<Vec<_>>())
        }
        FormulaView::Product(factors) => product(factors.iter().map(expression)),
        FormulaView::Multiple(one, other) => product([one, other].map(expression)),
        FormulaView::Quotient(above, below) => format!("(/ {} {})", expression(above), expression(below)),
        FormulaView::Power(base, exponent) => {
            let base = expression(base);
            product((0..exponent).map(|_| base.clone()))
        }
        FormulaView::Call(function, arguments) => call(function.in_fpcore(), arguments),
        FormulaView::External(name, _, arguments) => call(name, arguments),
        FormulaView::AtMost(parts) => call("<=", parts),
        FormulaView::NonZero(inside) => format!("(!= {} 0)", expression(inside)),
        // Code has no other parts.
        _ => formula.to_string(),
    }
}

fn call(name: &str, arguments: FormulaList<'_>) -> String {
    arguments.iter().fold(format!("({name}"), |text, argument| text + " " + &expression(argument)) + ")"
}

fn product(factors: impl IntoIterator<Item = String>) -> String {
    left_to_right(&factors.into_iter().map(|factor| ('*', factor)).collect::<Vec<_>>())
}

/// `(- (+ a b) c)`: each operator with everything to its left; a sum may begin with a minus.
fn left_to_right(operands: &[(char, String)]) -> String {
    let mut text: String = operands.iter().skip(1).rev().map(|(operator, _)| format!("({operator} ")).collect();
    for (number, (operator, operand)) in operands.iter().enumerate() {
        match (number, operator) {
            (0, '-') => text += &format!("(- {operand})"),
            (0, _) => text += operand,
            _ => text += &format!(" {operand})"),
        }
    }
    text
}

/// A number of FPCore.
pub(crate) fn literal(number: f64) -> String {
    match number {
        _ if number.is_nan() => "NAN".to_owned(),
        _ if number.is_infinite() => if number > 0.0 { "INFINITY" } else { "(- INFINITY)" }.to_owned(),
        _ => format!("{number:?}").trim_end_matches(".0").to_owned(),
    }
}
