//! Runs a mechanism from its text a number of times, for `tests/instructions.rs`: compiles it and assembles one position, or
//! calls `kinematics` by its name.
//!
//! `cargo bench --bench from_text -- four_bar from_text 10` does so ten times.

use std::hint::black_box;

use linkage_interpreter::{Data, Design, Program};

const FOUR_BAR: &str = include_str!("../examples/linkages/four_bar.linkage");
const JANSEN: &str = include_str!("../examples/linkages/jansen.linkage");

const INPUT: f64 = 0.3;
const RATE: f64 = 41.9;
const ACCELERATION: f64 = 3.7;

/// The mechanism of a text.
fn design(text: &str) -> Design {
    let program = Program::compile(black_box(text)).expect("it compiles");
    program.mechanisms()[0].design()
}

/// The first solution of each group.
fn branch(design: &Design) -> Data {
    let [sides, ..] = design.mechanism().branch_fields();
    Data::fields(sides.iter().map(|(name, solutions)| (*name, solutions[0].into())))
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let [mechanism, function, calls] = arguments.as_slice() else { panic!("a mechanism, a function, a number") };
    let calls: usize = calls.parse().expect("a number of calls");
    let text = match mechanism.as_str() {
        "four_bar" => FOUR_BAR,
        "jansen" => JANSEN,
        other => panic!("no mechanism {other}"),
    };
    match function.as_str() {
        "from_text" => {
            for _ in 0..calls {
                let design = design(text);
                black_box(design.call("assemble", &[INPUT.into(), branch(&design)]).expect("a position"));
            }
        }
        "by_name" => {
            let design = design(text);
            let given = [INPUT.into(), branch(&design), RATE.into(), ACCELERATION.into()];
            for _ in 0..calls {
                black_box(design.call("kinematics", black_box(&given)).expect("a position"));
            }
        }
        other => panic!("no function {other}"),
    }
}
