//! The price list: what each method's digits cost, error against time, on the four-bar, the Jansen leg and the double
//! butterfly, at benign poses and near singular ones.
//!
//! `cargo run --release --example accuracy_cost` prints it and writes `target/accuracy_cost.html` and `.svg`; with
//! `-- --patient` it times long enough for the third digit, and any machine's mood.

use std::error::Error;

mod chart;
mod dominance;
#[macro_use]
mod methods;
mod oracle;
mod page;
#[path = "../price/mod.rs"]
mod price;
mod stall;

mod double_butterfly;
mod four_bar;
mod jansen;

use price::frontier;
use stall::{Point, QUANTITIES, Stall, Work};

/// Every method, in the order of the list.
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

/// What a practical question asks for.
const WANTED: f64 = 1e-6;

fn main() -> Result<(), Box<dyn Error>> {
    let is_patient = std::env::args().any(|argument| argument == "--patient");
    let (rounds, span) = if is_patient { (61, 4e-4) } else { (7, 2e-5) };
    let open = |name, works: Vec<Work>| Stall::open(name, &METHODS, works, rounds, span);
    let mut stalls = [
        open("four-bar", four_bar::works()),
        open("Jansen leg", jansen::works()),
        open("double butterfly", double_butterfly::works()),
    ];
    stall::compare(&mut stalls);
    for stall in &stalls {
        print(stall);
    }
    println!("Over all three:");
    for (name, by) in METHODS.iter().zip(&stalls[0].dominated) {
        match by {
            Some(by) => println!("  {name:<20} dominated by {}, not offered", METHODS[*by]),
            None => println!("  {name:<20} on the list"),
        }
    }
    for stall in &stalls {
        for point in stall.points.iter().filter(|point| point.pose == "benign" && !point.angles_given) {
            println!("{}", answer(stall, point));
        }
    }
    if cfg!(debug_assertions) {
        println!("The times are those of code that is not optimised: run with --release.");
    }
    std::fs::write("target/accuracy_cost.svg", chart::svg(&stalls))?;
    let html = page::html(&stalls);
    std::fs::write("target/accuracy_cost.html", &html)?;
    println!("Price list: target/accuracy_cost.html, {} kB, and .svg", html.len() / 1000);
    check(&stalls);
    Ok(())
}

/// Nanoseconds and errors, a line for each method.
fn print(stall: &Stall) {
    println!("The {}: largest error, nanoseconds", stall.mechanism);
    for (index, point) in stall.points.iter().enumerate() {
        println!("  {}", describe(point));
        let (prices, front) = (stall.at(index), stall.front(index));
        for (method, price) in prices.iter().enumerate() {
            let mark = if front.contains(&method) { '*' } else { ' ' };
            if let Some(price) = price {
                println!("    {mark} {:<20} {:8.1e} {:9.1} ns", METHODS[method], price.error, price.time);
            } else if let Some((.., error)) = stall.refusals.iter().find(|(m, p, _)| (*m, *p) == (method, index)) {
                println!("      {:<20} {error}", METHODS[method]);
            }
        }
    }
}

fn describe(point: &Point) -> String {
    let from = if point.angles_given { "angles given" } else { "from the input" };
    let pose = if point.pose == "benign" { "benign".to_owned() } else { format!("sin {}", point.pose) };
    format!("{}, {pose}, {from}", QUANTITIES[point.order])
}

/// The least time for `WANTED`, and why nothing cheaper will do.
fn answer(stall: &Stall, point: &Point) -> String {
    let index = stall.points.iter().position(|other| other == point).expect("a point of the list");
    let prices = stall.offered(index);
    let what = format!("Cheapest for {WANTED:.0e}: {} of the {}", QUANTITIES[point.order], stall.mechanism);
    let Some((best, faster)) = frontier::cheapest(&prices, WANTED) else { return format!("{what}: none") };
    let price = |method: usize| prices[method].expect("a price");
    let reason = faster.map_or_else(
        || "nothing on the list is faster".to_owned(),
        |faster| {
            format!(
                "{} would take {:.0} ns, but is off by {:.0e}",
                METHODS[faster],
                price(faster).time,
                price(faster).error
            )
        },
    );
    format!("{what}: {}, {:.0} ns, off by {:.0e}; {reason}", METHODS[best], price(best).time, price(best).error)
}

/// What holds on every machine.
fn check(stalls: &[Stall]) {
    for stall in stalls {
        let price = |name: &str, point: usize| {
            let method = METHODS.iter().position(|method| *method == name).expect("a method of the list");
            stall.prices[method][point]
        };
        for (index, point) in stall.points.iter().enumerate() {
            let (prices, front) = (stall.at(index), stall.front(index));
            let errors: Vec<f64> = front.iter().map(|&method| prices[method].expect("a price").error).collect();
            assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "a frontier buys digits with time");
            let best = front.last().map(|&method| METHODS[method]);
            assert_eq!(best, Some("double-double"), "{} {}", stall.mechanism, describe(point));
            if point.pose == "benign" {
                let [single, double] = ["f32", "f64"].map(|name| price(name, index).map(|price| price.error));
                assert!(single.is_none_or(|error| error < 1e-4) && double.is_none_or(|error| error < 1e-12));
            }
        }
    }
}
