//! Mechanisms of any size, as text.

use std::fmt::Write;

/// m four-bars, the rocker of each driving the next: m blocks of two unknowns. All names are of the same length.
#[must_use]
pub fn chain(loops: usize) -> String {
    let (mut parameters, mut unknowns, mut equations) = (String::new(), String::new(), String::new());
    for i in 0..loops {
        let input = if i == 0 { "v".to_owned() } else { format!("s{:02}", i - 1) };
        let _ = write!(parameters, "param a{i:02} = 1, b{i:02} = 3, c{i:02} = 2, d{i:02} = 3;");
        let _ = write!(unknowns, "unknown t{i:02}, s{i:02};");
        let _ = write!(equations, "loop a{i:02}@{input} + b{i:02}@t{i:02} = d{i:02}@0 + c{i:02}@s{i:02};");
    }
    let last = loops - 1;
    format!("mechanism Chain {{ {parameters} input v; {unknowns} {equations} point P = c{last:02}@s{last:02}; }}")
}

/// m loops that all pass through all 2 m unknown links: one block of 2 m unknowns, J without zeros.
#[must_use]
pub fn dense(loops: usize) -> String {
    let (mut parameters, mut unknowns, mut equations) = (String::new(), String::new(), String::new());
    for i in 0..2 * loops {
        let _ = write!(unknowns, "unknown t{i};");
    }
    for row in 0..loops {
        let _ = write!(parameters, "param a{row} = 1, d{row} = 3;");
        let _ = write!(equations, "loop a{row}@v");
        for i in 0..2 * loops {
            let _ = write!(parameters, "param b{row}_{i} = {};", 1 + row + i);
            let _ = write!(equations, " + b{row}_{i}@t{i}");
        }
        let _ = write!(equations, " = d{row}@0;");
    }
    format!("mechanism Dense {{ {parameters} input v; {unknowns} {equations} point P = a0@v + b0_0@t0; }}")
}

/// A mechanism whose output is a sine of a sine of a sine ….
#[must_use]
pub fn nested(depth: usize) -> String {
    let mut source = String::from("mechanism M { param a = 2; input v; unknown u; equation u = a * v; let x0 = v * u;");
    for index in 0..depth {
        let _ = write!(source, "let x{} = sin(x{index});", index + 1);
    }
    source + &format!("output o = x{depth}; }}")
}

/// A mechanism whose output is a sum of many sines.
#[must_use]
pub fn wide(terms: usize) -> String {
    let sum: Vec<String> = (0..terms).map(|index| format!("sin({index}*v)")).collect();
    let sum = sum.join(" + ");
    format!("mechanism M {{ param a = 2; input v; unknown u; equation u = a * v; output o = {sum} + v; }}")
}
