//! The cost of the macro: expansion time, graph, emitted operations and text, over mechanisms of growing size.
//!
//! `cargo bench --profile dev --bench compile` measures it unoptimised, as cargo builds macros.

use std::time::{Duration, Instant};

use linkage_compiler::Expansion;
use linkage_gallery::families::{chain, dense, nested, wide};
use linkage_gallery::source;
use proc_macro2::TokenStream;

/// The four-bar of the tests, with its five points and an output.
fn four_bar(_: usize) -> String {
    source::tokens_of("four_bar").to_string()
}

struct Measured {
    time: Duration,
    nodes: usize,
    operations: usize,
    bytes: usize,
}

/// The median time of nine expansions of one source, fewer if they take more than a second.
fn measure(source: &str) -> Measured {
    const FEWEST: usize = 9;
    let root: TokenStream = "::linkage".parse().expect("a path");
    let tokens: TokenStream = source.parse().expect("tokens");
    let mut times: Vec<Duration> = Vec::new();
    let mut bytes = 0;
    while times.len() < FEWEST || times.iter().sum::<Duration>() < Duration::from_secs(1) {
        let input = tokens.clone();
        let start = Instant::now();
        let output = linkage_compiler::expand(input, &root);
        times.push(start.elapsed());
        bytes = output.to_string().len();
    }
    times.sort_unstable();
    let mechanism = linkage_compiler::read(tokens).expect("a mechanism").remove(0);
    let Expansion { nodes, operations, .. } =
        linkage_compiler::compile(&mechanism, &root).expect("a mechanism without mistakes");
    let operations = operations.functions + operations.divisions + operations.multiplications + operations.additions;
    Measured { time: times[times.len() / 2], nodes, operations, bytes }
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
    table("Loops with all unknowns", dense, &[1, 2, 4, 8]);
    println!("Extreme inputs\n     ms");
    let inputs = [
        ("a sine of a sine of …, 1000 deep", nested(1000)),
        ("a sine of a sine of …, 3000 deep", nested(3000)),
        ("a sine of a sine of …, 10000 deep", nested(10_000)),
        ("a sum of 900 sines", wide(900)),
        ("a sum of 200000 sines, a million nodes", wide(200_000)),
        ("a divisor that is zero", wide(1).replace("sin", "1/(v - v) + sin")),
    ];
    for (what, source) in inputs {
        let tokens: TokenStream = source.parse().expect("tokens");
        let start = Instant::now();
        let expansion = linkage_compiler::expand(tokens, &"::linkage".parse().expect("a path")).to_string();
        let result = if expansion.contains("compile_error") { "error" } else { "expanded" };
        println!("{:8.1} {what}: {result}", start.elapsed().as_secs_f64() * 1e3);
    }
}
