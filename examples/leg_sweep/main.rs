//! A million legs: the path of the foot of Theo Jansen's leg for random lengths around the known ones. A flat path on the
//! ground and a high step exclude each other; the page shows the best compromises.
//!
//! `cargo run --release --features simd --example leg_sweep 1000000` prints the designs by their fate and writes
//! `target/leg_sweep.html`; without a number there are 4000 designs.

use std::error::Error;
use std::num::NonZeroU64;

mod chart;
mod density;
mod fates;
mod gait;
mod legs;
mod machine;
mod page;
mod study;
mod ticks;

use legs::Walker;
use linkage_examples::output;
use study::Study;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let designs = match arguments.next() {
        Some(text) => {
            let designs = text.parse::<NonZeroU64>();
            designs.map_err(|error| format!("the number of designs is {text}: {error}"))?.get()
        }
        None => 4000,
    };
    let path = arguments.next().unwrap_or_else(|| "target/leg_sweep.html".to_owned());
    let known = Walker::new(machine::Leg::default())?.ok_or("Jansen's leg does not walk")?;
    let study = Study::new(designs, &known)?;
    let rows = report(&study);
    for [name, value] in &rows {
        println!("{name:48} {value}");
    }
    let legs = study.chosen(known)?;
    for leg in &legs {
        println!("{}  {:60} {}", leg.letter, leg.name, page::gait(&leg.walker.gait));
    }
    let html = page::html(&study, &legs, &rows)?;
    let path = output::write(path, &html)?;
    println!("Page: {path}, {} kB", html.len() / 1000);
    Ok(())
}

/// The sweep in numbers.
fn report(study: &Study) -> Vec<[String; 2]> {
    let counted: u64 = study.fates.values().sum();
    assert_eq!(counted, study.designs, "each design has one fate");
    let mut rows = vec![
        ["designs".to_owned(), page::thousands(study.designs)],
        ["positions".to_owned(), page::thousands(study.rows)],
        ["seconds".to_owned(), format!("{:.2}", study.seconds)],
        ["positions per second".to_owned(), page::thousands((study.rows as f64 / study.seconds) as u64)],
    ];
    rows.extend(study.fates.iter().map(|(fate, count)| [fate.to_string(), page::thousands(*count)]));
    rows.push(["on the Pareto front".to_owned(), study.front.len().to_string()]);
    rows
}
