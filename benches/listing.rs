//! Microseconds for a position by number, which needs no guess, and by Newton's method from a guess one degree away:
//! medians of alternating rounds.
//!
//! `cargo bench --bench listing`

use std::hint::black_box;
use std::time::Instant;

use linkage_gallery::double_butterfly::*;
use linkage_gallery::stephenson_far::*;

const ROUNDS: usize = 21;
const COUNT: usize = 400;

/// The microseconds for one call, over some arguments.
fn time<A, R>(arguments: &[A], work: impl Fn(&A) -> R) -> f64 {
    let start = Instant::now();
    for argument in arguments {
        black_box(&work(black_box(argument)));
    }
    start.elapsed().as_secs_f64() * 1e6 / arguments.len() as f64
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// A row for a mechanism: its inputs with positions, and the same by Newton's method from one degree before.
macro_rules! row {
    ($title:literal, $m:expr, $input:ident, $inputs:expr) => {{
        let m = $m;
        let listed = $inputs.filter_map(|input: f64| Some((input, m.branches(input).ok()?.next()?)));
        let listed: Vec<_> = listed.take(COUNT).map(|(input, first)| (input, first.branch, first.pose)).collect();
        let guesses = listed.iter().filter_map(|(input, branch, pose)| {
            let mut before = pose.coordinates();
            before.$input = input - 1f64.to_radians();
            let mut guess = m.assemble_near(&before, *branch).ok()?.coordinates();
            guess.$input = *input;
            Some((guess, *branch))
        });
        let guesses: Vec<_> = guesses.collect();
        let (mut by_number, mut near, mut all) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            by_number.push(time(&listed, |(input, branch, _)| m.assemble(*input, *branch)));
            near.push(time(&guesses, |(guess, branch)| m.assemble_near(guess, *branch)));
            all.push(time(&listed, |(input, ..)| m.branches(*input).map(Iterator::count)));
        }
        let [by_number, near, all] = [by_number, near, all].map(|mut times| median(&mut times));
        println!("{}, {} inputs", $title, listed.len());
        println!("  a position by its number            {by_number:7.2} us, {:.1} times Newton", by_number / near);
        println!("  by Newton from one degree away      {near:7.2} us");
        println!("  the list of all positions           {all:7.2} us");
    }};
}

fn main() {
    // Steps of the golden angle over a turn.
    let turn = (0..).map(|index| std::f64::consts::TAU * (0.618_034 * f64::from(index)).fract());
    row!("Stephenson III driven from its far side", StephensonFar::default(), swing, turn.clone().take(4 * COUNT));
    row!("Double butterfly", DoubleButterfly::default(), crank, turn.take(COUNT));
}
