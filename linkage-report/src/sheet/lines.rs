//! Breaks long sums into lines.

use crate::Notation;
use linkage_runtime::derivation::Equation;

/// The widest right side, in characters; a wider one is broken at its terms.
const WIDEST: usize = 58;

/// The MathML of an equation; a long sum is broken into lines.
pub(super) fn equation(equation: &Equation<'_>) -> String {
    let (left, right) = (equation.left.to_mathml(), equation.right.to_mathml());
    if equation.right.to_string().chars().count() > WIDEST {
        let lines = lines(&right);
        if lines.len() > 1 {
            let row = |(index, line): (usize, &String)| {
                let (left, sign) = if index == 0 { (left.as_str(), "<mo>=</mo>") } else { ("", "") };
                format!("<mtr><mtd>{left}</mtd><mtd>{sign}</mtd><mtd><mrow>{line}</mrow></mtd></mtr>")
            };
            let rows: String = lines.iter().enumerate().map(row).collect();
            return format!("<mtable class=\"lines\" displaystyle=\"true\">{rows}</mtable>");
        }
    }
    format!("<mrow>{left}<mo>=</mo>{right}</mrow>")
}

/// The terms of a sum, packed into lines; a single line for any other formula.
fn lines(mathml: &str) -> Vec<String> {
    let Some(inside) = mathml.strip_prefix("<mrow>").and_then(|inside| inside.strip_suffix("</mrow>")) else {
        return Vec::new();
    };
    let mut lines: Vec<(String, usize)> = Vec::new();
    let mut term = String::new();
    let flush = |term: &mut String, lines: &mut Vec<(String, usize)>| {
        let width = visible(term);
        match lines.last_mut() {
            Some((line, sum)) if *sum + width <= WIDEST => {
                line.push_str(term);
                *sum += width;
            }
            _ => lines.push((term.clone(), width)),
        }
        term.clear();
    };
    for element in elements(inside) {
        if matches!(element, "<mo>+</mo>" | "<mo>−</mo>") && !term.is_empty() {
            flush(&mut term, &mut lines);
            // A sign at the start of a line is still a binary operator.
            let sign = &element["<mo>".len()..];
            term.push_str("<mo form=\"infix\">");
            term.push_str(sign);
        } else {
            term.push_str(element);
        }
    }
    flush(&mut term, &mut lines);
    lines.into_iter().map(|(line, _)| line).collect()
}

/// The top-level elements.
fn elements(mathml: &str) -> Vec<&str> {
    let (mut elements, mut depth, mut start) = (Vec::new(), 0_usize, 0);
    for (at, _) in mathml.match_indices('<') {
        let closes = mathml[at..].starts_with("</");
        depth = if closes { depth.saturating_sub(1) } else { depth + 1 };
        if depth == 0 {
            let end = mathml[at..].find('>').map_or(mathml.len(), |length| at + length + 1);
            elements.push(&mathml[start..end]);
            start = end;
        }
    }
    elements
}

/// The number of characters outside the tags.
fn visible(mathml: &str) -> usize {
    let pieces = mathml.split('<').map(|piece| piece.rsplit('>').next().unwrap_or(piece));
    pieces.map(|piece| piece.chars().count()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_broken_at_their_terms_only() {
        let term = format!("<mrow><mi>{}</mi><mo>+</mo><mi>b</mi></mrow>", "a".repeat(30));
        let sum = format!("<mrow><mo>−</mo>{term}<mo>+</mo>{term}<mo>−</mo>{term}</mrow>");
        let infix = |sign| format!("<mo form=\"infix\">{sign}</mo>{term}");
        assert_eq!(lines(&sum), [format!("<mo>−</mo>{term}"), infix('+'), infix('−')]);
        assert_eq!(lines("<mi>a</mi>").len(), 0);
        assert_eq!(lines("<mrow><mi>a</mi><mo>+</mo><mi>b</mi></mrow>").len(), 1);
    }
}
