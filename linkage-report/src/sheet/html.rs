//! Helpers for HTML.

use crate::Notation;
use crate::document::outline::GeneralEquation;
use linkage_runtime::derivation::{Formula, FormulaMatrix};

/// Escapes text for an element or for an attribute in double quotes.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            _ => escaped.push(c),
        }
    }
    escaped
}

/// An inline formula.
pub(super) fn inline(formula: &Formula<'_>) -> String {
    format!("<math>{}</math>", formula.to_mathml())
}

/// A displayed formula, with its LaTeX source as an annotation for copying.
pub(super) fn display(mathml: &str, latex: &str) -> String {
    format!(
        "<div class=\"scroll\"><math display=\"block\"><semantics>{mathml}<annotation encoding=\"application/x-tex\">\
         {}</annotation></semantics></math></div>",
        escape(latex)
    )
}

/// A matrix with more rows or columns than this is written as a list of its entries.
pub(super) const LARGEST_MATRIX: usize = 6;

/// The MathML and LaTeX of `name = matrix`, or of each entry of a large matrix. A `general` such as J = ∂Ψ/∂u defines
/// the matrix.
pub(super) fn matrix(matrix: &FormulaMatrix<'_>, general: Option<&GeneralEquation>) -> Vec<(String, String)> {
    let FormulaMatrix { name, factor, rows, columns, .. } = matrix;
    let (before, before_latex) = factor.map_or_else(Default::default, |factor| (factor.to_mathml(), factor.to_latex()));
    if *rows.max(columns) > LARGEST_MATRIX {
        let entries = matrix.entries.iter().map(|entry| {
            let (row, column, value) = (entry.row + 1, entry.column + 1, entry.value);
            let index = format!("<mrow><mn>{row}</mn><mo>,</mo><mn>{column}</mn></mrow>");
            let mathml =
                format!("<mrow><msub>{}{index}</msub><mo>=</mo>{before}{}</mrow>", name.to_mathml(), value.to_mathml());
            (mathml, format!("{{{}}}_{{{row},{column}}} = {before_latex} {}", name.to_latex(), value.to_latex()))
        });
        let general = general.map(|general| (general.mathml.to_owned(), general.latex.to_owned()));
        return general.into_iter().chain(entries).collect();
    }
    let (mut mathml, mut latex) = (String::new(), String::new());
    for row in 0..*rows {
        let entries: Vec<_> = (0..*columns).map(|column| matrix.entry(row, column)).collect();
        mathml.push_str("<mtr>");
        for entry in &entries {
            let entry = entry.map_or_else(|| "<mn>0</mn>".to_owned(), |entry| entry.to_mathml());
            mathml.push_str(&format!("<mtd>{entry}</mtd>"));
        }
        mathml.push_str("</mtr>");
        let entries: Vec<String> =
            entries.iter().map(|entry| entry.map_or_else(|| "0".to_owned(), |entry| entry.to_latex())).collect();
        latex.push_str(&format!(" {} \\\\", entries.join(" & ")));
    }
    // J = ∂Ψ/∂u = (…) is one chain of equations.
    let (name, name_latex) = match general {
        Some(general) => (general.mathml.to_owned(), general.latex.to_owned()),
        None => (name.to_mathml(), name.to_latex()),
    };
    // Fractions are large if there is room.
    let large = *columns <= 3;
    let mathml = format!(
        "<mrow>{name}<mo>=</mo>{before}<mrow><mo>(</mo><mtable class=\"matrix\" displaystyle=\"{large}\">{mathml}</mtable><mo>)</mo></mrow></mrow>"
    );
    vec![(mathml, format!("{name_latex} = {before_latex} \\begin{{pmatrix}}{latex} \\end{{pmatrix}}"))]
}

/// An SVG file as a data URL.
pub(crate) fn svg_address(svg: &str) -> String {
    let mut address = String::from("data:image/svg+xml,");
    for byte in svg.trim().bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' => address.push(char::from(byte)),
            _ => address.push_str(&format!("%{byte:02X}")),
        }
    }
    address
}
