//! Names and columns in tables of numbers.

use crate::Notation;
use linkage_runtime::derivation::notation::Name;
use linkage_runtime::derivation::{Derivation, Equation, Formula, FormulaView, Quantity};

use super::html::escape;

/// The name of a column: as a formula if it is that of a symbol, of an equation's left side or of a rate, else as text.
pub(super) fn name(derivation: &Derivation<'_>, name: &str) -> String {
    match formula(derivation, name) {
        Some(mathml) => format!("<math>{mathml}</math>"),
        None => escape(name),
    }
}

/// The MathML of the name of a symbol, of the left side of an equation, of `theta3/theta2` for the partial derivative
/// of one symbol by another, or of `theta3_rate` or `theta3_acceleration`; None for other names.
fn formula(derivation: &Derivation<'_>, name: &str) -> Option<String> {
    let symbol = |name: &str| {
        let mut symbols = derivation.parameters.iter().chain(derivation.inputs).chain(derivation.unknowns);
        symbols.find(|symbol| symbol.name == name || symbol.formula.to_string() == name)
    };
    if let Some(symbol) = symbol(name) {
        return Some(symbol.formula.to_mathml());
    }
    let quantities = derivation.points.iter().chain(derivation.outputs);
    // A symbol, or a component of a point or an output.
    let named = |name: &str| {
        let is_name = |of: &Formula<'_>| matches!(of.view(), FormulaView::Name(Name::Plain(text)) if text == name);
        let mut components = quantities.clone().flat_map(|quantity| quantity.value).map(|equation| equation.left);
        symbol(name).map(|symbol| symbol.formula).or_else(|| components.find(is_name))
    };
    let mut equations = derivation
        .ratios
        .iter()
        .chain(derivation.residual)
        .chain(derivation.gamma)
        .chain(derivation.groups.iter().flat_map(|group| group.position.iter().chain(&group.determinant)))
        .chain(derivation.ratio_derivatives.into_iter().flatten())
        .chain(derivation.sensitivity.iter().flat_map(|sensitivity| sensitivity.formulas))
        .chain(quantities.clone().flat_map(|quantity| {
            let Quantity { value, ratios, ratio_derivatives, sensitivities, .. } = quantity;
            value.iter().chain(*ratios).chain(*ratio_derivatives).chain(*sensitivities)
        }));
    if let Some(Equation { left, .. }) = equations.find(|equation| equation.left.to_string() == name) {
        return Some(left.to_mathml());
    }
    if let Some((of, by)) = name.split_once('/') {
        let side = |of: Formula<'_>| format!("<mrow><mo>∂</mo>{}</mrow>", of.to_mathml());
        return Some(format!("<mfrac>{}{}</mfrac>", side(named(of)?), side(named(by)?)));
    }
    let dotted = [("_rate", "˙"), ("_acceleration", "¨")];
    dotted.into_iter().find_map(|(ending, dots)| Some(dot(named(name.strip_suffix(ending)?)?, dots)))
}

/// A symbol with dots above its letter.
fn dot(of: Formula<'_>, dots: &str) -> String {
    let mathml = of.to_mathml();
    let over = |letter: &str| format!("<mover>{letter}<mo>{dots}</mo></mover>");
    match mathml.strip_prefix("<msub>").and_then(|inside| inside.split_once("</mi>")) {
        Some((letter, rest)) => format!("<msub>{}{rest}", over(&format!("{letter}</mi>"))),
        None => over(&mathml),
    }
}

/// The numbers of a column, aligned at the decimal points in fonts with digits of equal width.
pub(super) fn column(texts: Vec<String>) -> Vec<String> {
    let places =
        |text: &str| if text.contains('·') { 0 } else { text.find('.').map_or(0, |point| text.len() - point) };
    let most = texts.iter().map(|text| places(text)).max().unwrap_or(0);
    let pad = |text: String| {
        let missing = most - places(&text);
        let mut padding = String::new();
        for index in 0..missing {
            // Spaces with the width of a decimal point and of a digit.
            let point = index == 0 && places(&text) == 0;
            padding.push(if point { '\u{2008}' } else { '\u{2007}' });
        }
        text + &padding
    };
    texts.into_iter().map(pad).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_aligned_at_their_points() {
        let column = column(vec!["80".to_owned(), "1.25".to_owned()]);
        assert_eq!(column, ["80\u{2008}\u{2007}\u{2007}", "1.25"]);
    }
}
