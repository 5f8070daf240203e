//! What the macro costs: expansion time, graph, emitted work and text, over mechanisms of growing size.
//!
//! `cargo bench --profile dev --bench compile` times it as cargo builds macros, unoptimised.

use std::fmt::Write;
use std::time::{Duration, Instant};

use proc_macro2::TokenStream;

/// The four-bar of the tests, with its five points and an output.
fn four_bar(_: usize) -> String {
    let file = include_str!("../tests/mechanisms/four_bar.rs");
    let (open, close) = (file.find('{').map_or(0, |at| at + 1), file.rfind('}').unwrap_or(file.len()));
    file[open..close].to_owned()
}

/// m four-bars, the rocker of each driving the next: m blocks of two unknowns.
fn chain(loops: usize) -> String {
    let (mut parameters, mut unknowns, mut closures) = (String::new(), String::new(), String::new());
    for i in 0..loops {
        let input = if i == 0 { "v".to_owned() } else { format!("s{}", i - 1) };
        let _ = write!(parameters, "param a{i} = 1, b{i} = 3, c{i} = 2, d{i} = 3;");
        let _ = write!(unknowns, "unknown t{i}, s{i};");
        let _ = write!(closures, "loop a{i}@{input} + b{i}@t{i} = d{i}@0 + c{i}@s{i};");
    }
    let last = loops - 1;
    format!("mechanism Chain {{ {parameters} input v; {unknowns} {closures} point P = c{last}@s{last}; }}")
}

/// m loops that all pass through all 2 m unknown links: one block of 2 m unknowns, J without zeros.
fn dense(loops: usize) -> String {
    let (mut parameters, mut unknowns, mut closures) = (String::new(), String::new(), String::new());
    for i in 0..2 * loops {
        let _ = write!(unknowns, "unknown t{i};");
    }
    for row in 0..loops {
        let _ = write!(parameters, "param a{row} = 1, d{row} = 3;");
        let _ = write!(closures, "loop a{row}@v");
        for i in 0..2 * loops {
            let _ = write!(parameters, "param b{row}_{i} = {};", 1 + row + i);
            let _ = write!(closures, " + b{row}_{i}@t{i}");
        }
        let _ = write!(closures, " = d{row}@0;");
    }
    format!("mechanism Dense {{ {parameters} input v; {unknowns} {closures} point P = a0@v + b0_0@t0; }}")
}

struct Measured {
    time: Duration,
    nodes: usize,
    operations: usize,
    bytes: usize,
}

/// The median of a few expansions of one source.
fn measure(source: &str) -> Measured {
    const RUNS: usize = 9;
    let root: TokenStream = "::linkage".parse().expect("a path");
    let tokens: TokenStream = source.parse().expect("tokens");
    let mut times: Vec<Duration> = Vec::new();
    let mut bytes = 0;
    for _ in 0..RUNS {
        let input = tokens.clone();
        let start = Instant::now();
        let output = linkage_compiler::expand(input, &root);
        times.push(start.elapsed());
        bytes = output.to_string().len();
    }
    times.sort_unstable();
    let mechanism = linkage_compiler::read(tokens).expect("a mechanism").remove(0);
    let (operations, nodes) = (0, linkage_compiler::derive(&mechanism)[0].graph.len());
    Measured { time: times[RUNS / 2], nodes, operations, bytes }
}

fn table(title: &str, source: fn(usize) -> String, sizes: &[usize]) {
    println!("{title}\n loops    time ms     nodes  operations      bytes");
    for &loops in sizes {
        let Measured { time, nodes, operations, bytes } = measure(&source(loops));
        println!("{loops:6} {:10.2} {nodes:9} {operations:11} {bytes:10}", time.as_secs_f64() * 1e3);
    }
}

fn main() {
    table("The four-bar", four_bar, &[1]);
    table("A chain of four-bars", chain, &[1, 2, 4, 8, 16, 32, 64]);
    table("Loops through every unknown", dense, &[1, 2, 4, 8]);
}
