//! Accuracy and time of the position methods on the four-bar, the Jansen leg and the double butterfly, at
//! well-conditioned and at nearly singular poses.
//!
//! `cargo run --release --example accuracy_cost` prints the tables and writes `target/accuracy_cost.html`;
//! with `-- --patient` it measures longer, for three stable digits of the times.

use std::error::Error;

mod chart;
#[macro_use]
mod methods;
mod comparison;
mod motion;
mod page;

mod double_butterfly;
mod four_bar;
mod jansen;

use linkage::price::{Machine, cheapest};
use linkage_examples::output;

use comparison::{Comparison, Point, QUANTITIES, Work};

/// All methods, in the order of the tables.
const METHODS: [&str; 10] = [
    "f32",
    "f64, products",
    "f64",
    "double-double",
    "Newton, 1 step",
    "Newton, 2 steps",
    "Newton, 3 steps",
    "Newton to tolerance",
    "table of 64",
    "table of 1024",
];

/// The error that the recommendations allow.
const WANTED: f64 = 1e-6;

fn main() -> Result<(), Box<dyn Error>> {
    let is_patient = std::env::args().any(|argument| argument == "--patient");
    let (rounds, span) = if is_patient { (61, 4e-4) } else { (7, 2e-5) };
    let machine = Machine::measured();
    let open = |name, works: Vec<Work>| Comparison::measure(name, &METHODS, works, rounds, span);
    let mut comparisons = [
        open("four-bar", four_bar::works(&machine)),
        open("Jansen leg", jansen::works(&machine)),
        open("double butterfly", double_butterfly::works(&machine)),
    ];
    comparison::compare(&mut comparisons);
    for comparison in &comparisons {
        print(comparison);
    }
    for comparison in &comparisons {
        print_motions(comparison);
    }
    println!("Over all three:");
    for (name, by) in METHODS.iter().zip(&comparisons[0].dominated) {
        match by {
            Some(by) => println!("  {name:<20} dominated by {}, not recommended", METHODS[*by]),
            None => println!("  {name:<20} recommended"),
        }
    }
    for comparison in &comparisons {
        for point in comparison.points.iter().filter(|point| point.pose == "benign" && !point.angles_given) {
            println!("{}", answer(comparison, point));
        }
    }
    if cfg!(debug_assertions) {
        println!("The times are for unoptimised code: run with --release.");
    }
    let html = page::html(&comparisons);
    let path = output::write("target/accuracy_cost.html", &html)?;
    println!("Tables: {path}, {} kB", html.len() / 1000);
    check(&comparisons);
    Ok(())
}

/// Prints errors and nanoseconds, a line for each method.
fn print(comparison: &Comparison) {
    println!("The {}: largest error, nanoseconds", comparison.mechanism);
    for (index, point) in comparison.points.iter().enumerate() {
        println!("  {}", describe(point));
        let (prices, front) = (comparison.at(index), comparison.front(index));
        for (method, price) in prices.iter().enumerate() {
            let mark = if front.contains(&method) { '*' } else { ' ' };
            if let Some(price) = price {
                println!("    {mark} {:<20} {:8.1e} {:9.1} ns", METHODS[method], price.error, 1e9 * price.time);
            } else if let Some((.., error)) = comparison.failures.iter().find(|(m, p, _)| (*m, *p) == (method, index)) {
                println!("      {:<20} {error}", METHODS[method]);
            }
        }
    }
}

/// Prints the largest error of each method along each motion, and its time next to that of its operations.
fn print_motions(comparison: &Comparison) {
    for motion in &comparison.motions {
        let errors = METHODS.iter().enumerate().filter_map(|(method, name)| Some((name, motion.largest(method)?)));
        let errors: Vec<String> = errors.map(|(name, error)| format!("{name} {error:.0e}")).collect();
        println!("The {}, {}: {}", comparison.mechanism, motion.title(), errors.join(", "));
    }
    println!("The {}, nanoseconds of position and velocity: predicted by operations, measured", comparison.mechanism);
    for (name, predicted, measured) in chart::times(comparison) {
        let predicted = predicted.map_or_else(String::new, |predicted| format!("{:.0}", 1e9 * predicted));
        println!("    {name:<20} {predicted:>9} {:9.0}", 1e9 * measured);
    }
}

fn describe(point: &Point) -> String {
    let from = if point.angles_given { "angles given" } else { "from the input" };
    let pose = if point.pose == "benign" { "benign".to_owned() } else { format!("sin {}", point.pose) };
    format!("{}, {pose}, {from}", QUANTITIES[point.order])
}

/// The fastest method with an error of `WANTED` or less, and the next faster one with its error.
fn answer(comparison: &Comparison, point: &Point) -> String {
    let index = comparison.points.iter().position(|other| other == point).expect("a point of the list");
    let prices = comparison.offered(index);
    let what = format!("Fastest with error {WANTED:.0e}: {} of the {}", QUANTITIES[point.order], comparison.mechanism);
    let Some((best, faster)) = cheapest(&prices, WANTED) else { return format!("{what}: none") };
    let price = |method: usize| prices[method].expect("a price");
    let reason = faster.map_or_else(
        || "no listed method is faster".to_owned(),
        |faster| {
            format!(
                "{} takes {:.0} ns, but its error is {:.0e}",
                METHODS[faster],
                1e9 * price(faster).time,
                price(faster).error
            )
        },
    );
    format!("{what}: {}, {:.0} ns, error {:.0e}; {reason}", METHODS[best], 1e9 * price(best).time, price(best).error)
}

/// Checks relations that hold on every machine.
fn check(comparisons: &[Comparison]) {
    for comparison in comparisons {
        let price = |name: &str, point: usize| {
            let method = METHODS.iter().position(|method| *method == name).expect("a method of the list");
            comparison.costs[method][point]
        };
        for (index, point) in comparison.points.iter().enumerate() {
            let (prices, front) = (comparison.at(index), comparison.front(index));
            let errors: Vec<f64> = front.iter().map(|&method| prices[method].expect("a price").error).collect();
            assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "errors fall along the front");
            let best = front.last().map(|&method| METHODS[method]);
            assert_eq!(best, Some("double-double"), "{} {}", comparison.mechanism, describe(point));
            if point.pose == "benign" {
                let [single, double] = ["f32", "f64"].map(|name| price(name, index).map(|price| price.error));
                assert!(single.is_none_or(|error| error < 1e-4) && double.is_none_or(|error| error < 1e-12));
            }
        }
    }
}
