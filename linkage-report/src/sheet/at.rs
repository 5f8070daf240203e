//! Numbers of matrices at a position.

use crate::Notation;
use linkage_runtime::derivation::FormulaMatrix;

use super::html::LARGEST_MATRIX;
use super::values::Values;
use crate::words::Words;

/// The numbers of a matrix at a position; none if it is large, or if one of its entries has no number.
pub(super) fn matrix(words: &Words, matrix: &FormulaMatrix<'_>, values: &Values) -> Option<String> {
    let FormulaMatrix { name, rows, columns, .. } = matrix;
    if *rows.max(columns) > LARGEST_MATRIX || matrix.factor.is_some() {
        return None;
    }
    let mut mathml = String::new();
    for row in 0..*rows {
        mathml.push_str("<mtr>");
        for column in 0..*columns {
            let value = matrix.entry(row, column).map_or(Some(0.0), |entry| values.value(entry))?;
            mathml.push_str(&format!("<mtd><mn>{}</mn></mtd>", words.number(value)));
        }
        mathml.push_str("</mtr>");
    }
    let name = name.to_mathml();
    Some(format!(
        "<div class=\"scroll\"><math display=\"block\"><mrow>{name}<mo>=</mo><mrow><mo>(</mo><mtable class=\"matrix\">\
         {mathml}</mtable><mo>)</mo></mrow></mrow></math></div>"
    ))
}
