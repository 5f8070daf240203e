//! Emitted doc comments of functions, line by line.

use linkage_ir::Operations;

pub fn lines<const N: usize>(lines: [&str; N]) -> Vec<String> {
    lines.map(str::to_owned).to_vec()
}

/// A code block with these formulas; nothing if there are none.
pub fn fenced(lines: impl Iterator<Item = String>) -> Vec<String> {
    let mut block = vec![String::new(), "```text".to_owned()];
    block.extend(lines);
    block.push("```".to_owned());
    if block.len() > 3 { block } else { Vec::new() }
}

pub fn count(operations: Operations) -> String {
    let Operations { multiplications, additions, divisions, functions } = operations;
    let parts = [
        (functions, "function", "functions"),
        (divisions, "division", "divisions"),
        (multiplications, "multiplication", "multiplications"),
        (additions, "addition", "additions"),
    ];
    let mut text = String::new();
    for (count, one, many) in parts {
        if count > 0 {
            text.push_str(if text.is_empty() { "" } else { ", " });
            text.push_str(&count.to_string());
            text.push(' ');
            text.push_str(if count == 1 { one } else { many });
        }
    }
    text
}

/// Removes the error of a singular J, for functions of a mechanism that has no J.
pub fn without_singular(docs: Vec<String>) -> Vec<String> {
    docs.into_iter().map(|line| line.replace("`PositionError::Singular` if J is singular, ", "")).collect()
}

/// Adds to the doc comment of a function without `Result` what it returns for arguments that are not finite.
pub fn without_result(mut docs: Vec<String>) -> Vec<String> {
    docs.extend(lines([
        "",
        "It does not fail: if an argument is not finite, the result is not finite or meaningless.",
    ]));
    docs
}
