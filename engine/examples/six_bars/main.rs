//! Random six-bars as legs: the best hundred of millions, by an SQL query, drawn on a page.
//!
//! `cargo run --release --example six_bars -- --designs 10000000` in `engine` prints the best designs and writes
//! `target/six_bars.html` and `target/six_bars.csv`; without a number there are 20 000 designs.

use std::error::Error;
use std::num::NonZeroU64;
use std::path::PathBuf;
use std::time::Instant;

use clap::Parser;
use linkage_engine::mechanisms::six_bar::FootPath;
use linkage_engine::print;

mod answer;
mod legs;
#[path = "../../../examples/output/mod.rs"]
mod output;
mod page;
mod picture;
mod query;

use legs::Leg;
use page::thousands;
use query::{POSITIONS, Row};

/// The best hundred of random six-bars whose foot should follow a given curve.
#[derive(Parser)]
struct Options {
    /// The number of random designs.
    #[arg(long, default_value = "20000")]
    designs: NonZeroU64,
    /// The seed of the random numbers.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// The page; the table of the designs is written next to it, as CSV.
    #[arg(long, default_value = "target/six_bars.html")]
    page: PathBuf,
    /// Answers the query on the cluster of this scheduler, HOST:PORT. Otherwise in this process.
    #[arg(long)]
    scheduler: Option<String>,
}

#[tokio::main]
async fn main() -> Result<(), Box<dyn Error>> {
    let Options { designs, seed, page: path, scheduler } = Options::parse();
    let designs = designs.get();
    let query = query::sql(&query::request(designs, seed))?;
    let start = Instant::now();
    let rows = answer::rows(&query, scheduler).await?;
    let seconds = start.elapsed().as_secs_f64();
    let curve = FootPath::new()?;
    let legs = rows.into_iter().map(|row| Leg::new(&curve, row)).collect::<Result<Vec<_>, _>>()?;
    for (place, Leg { row, .. }) in legs.iter().enumerate().take(10) {
        print(format_args!("{:3}. {}", place + 1, line(row)))?;
    }
    let positions = designs.saturating_mul(POSITIONS as u64);
    let numbers = [
        ("designs", thousands(designs)),
        ("positions", thousands(positions)),
        ("seconds", format!("{seconds:.1}")),
        ("positions per second", thousands((positions as f64 / seconds) as u64)),
    ];
    let numbers = numbers.map(|(name, value)| [name.to_owned(), value]);
    for [name, value] in &numbers {
        print(format_args!("{name:24} {value}"))?;
    }
    let html = page::html(&legs, &curve, designs, &query, &numbers)?;
    print(format_args!("Page: {}, {} kB", output::write(&path, &html)?, html.len() / 1000))?;
    print(format_args!("Table: {}", output::write(path.with_extension("csv"), &page::csv(&legs))?))?;
    Ok(())
}

/// A design in words.
fn line(row: &Row) -> String {
    let Row { case, distance, min_mu, size, clearance, .. } = row;
    format!(
        "design {case:8}: distance {:.2} %, transmission {:.0}°, size {size:.2}, clearance {clearance:.2}",
        100.0 * distance,
        min_mu.to_degrees()
    )
}
