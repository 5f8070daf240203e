//! Accuracy and time of simulation, with `diffsol` among the integrators.

use std::error::Error;

#[path = "../chart.rs"]
mod chart;
mod diffsol;
#[path = "../fixed_steps.rs"]
mod fixed_steps;
#[path = "../formulations.rs"]
mod formulations;
#[path = "../four_bars.rs"]
mod four_bars;
#[path = "../integrators.rs"]
mod integrators;
#[path = "../list.rs"]
mod list;
#[path = "../../output/mod.rs"]
mod output;
#[path = "../page.rs"]
mod page;
#[path = "../../price/mod.rs"]
mod price;
#[path = "../problem.rs"]
mod problem;
#[path = "../problems.rs"]
mod problems;
#[path = "../reading.rs"]
mod reading;
#[path = "../report.rs"]
mod report;

fn main() -> Result<(), Box<dyn Error>> {
    let problems = report::Problems::new();
    let mut works = problems.works();
    works[0].extend(diffsol::works(&problems.squeezer));
    works[1].extend(diffsol::works(&problems.windows));
    works[2].extend(diffsol::works(&problems.sprung));
    works[3].extend(diffsol::works(&problems.turning));
    report::write(works)
}
