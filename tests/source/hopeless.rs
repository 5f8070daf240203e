//! Mechanisms that nobody writes, as text.

use std::fmt::Write;

/// A mechanism whose output is a sine of a sine of a sine ….
pub fn nested(depth: usize) -> String {
    let mut source = String::from("mechanism M { param a = 2; input v; unknown u; equation u = a * v; let x0 = v * u;");
    for index in 0..depth {
        let _ = write!(source, "let x{} = sin(x{index});", index + 1);
    }
    source + &format!("output o = x{depth}; }}")
}

/// A mechanism whose output is a sum of many sines.
pub fn wide(terms: usize) -> String {
    let sum: Vec<String> = (0..terms).map(|index| format!("sin({index}*v)")).collect();
    let sum = sum.join(" + ");
    format!("mechanism M {{ param a = 2; input v; unknown u; equation u = a * v; output o = {sum} + v; }}")
}
