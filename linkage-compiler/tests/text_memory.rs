//! Nothing is kept between texts: as many bytes are allocated after many texts as after a few.
//!
//! An allocator counts the bytes of this process, which has one test. `TEXTS` is the number of texts.

use std::alloc::System;

use cap::Cap;
use linkage_compiler::budget::Budget;
use linkage_compiler::text;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// A text with a number in its names: right, with mistakes of both kinds of checks, and no tokens.
fn text_of(number: usize) -> String {
    let name = format!("Crank{number}");
    match number % 5 {
        0 => {
            format!("mechanism {name} {{ param r{number} = 2; input v; unknown u; equation u = r{number} * sin(v); }}")
        }
        1 => format!("mechanism {name} {{ param r = 2; input v; unknown u; equation u = r * sn(v) + x{number}; }}"),
        2 => format!(
            "mechanism {name} {{ input v; unknown u; equation u = 1e-200 * v; output o = (u * 1e-200)^{number}; }}"
        ),
        3 => format!("mechanism {name} {{ loop }} mechanism {name} {{ parm a = {number}theta; }}"),
        _ => format!("mechanism {name} {{ output o = ({number}; }}"),
    }
}

fn compile(number: usize) {
    let budget = Budget::default();
    let found = text::compile(&text_of(number), &budget, |of| of.program.functions.iter().count());
    assert_eq!(found.is_ok(), number.is_multiple_of(5), "{:?}", found.err());
}

#[test]
fn texts_leave_nothing_behind() {
    let count = linkage_trials::count("TEXTS", 400, 2000);
    let a_few = count / 100;
    (0..a_few).for_each(compile);
    let after_a_few = ALLOCATOR.allocated();
    (a_few..count).for_each(compile);
    let after_all = ALLOCATOR.allocated();
    println!("{after_a_few} bytes after {a_few} texts, {after_all} after {count}");
    assert_eq!(after_a_few, after_all);
}
