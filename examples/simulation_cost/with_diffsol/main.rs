//! Accuracy and time of simulation, with `diffsol` among the integrators.

use std::error::Error;

mod diffsol;
#[path = "../others.rs"]
mod others;

use linkage_examples::simulation_cost::report;

fn main() -> Result<(), Box<dyn Error>> {
    let problems = report::Problems::all();
    let mut works = problems.works(others::works(&problems));
    works[0].extend(diffsol::works(&problems.squeezer));
    works[1].extend(diffsol::works(&problems.windows));
    works[2].extend(diffsol::works(&problems.sprung));
    works[3].extend(diffsol::works(&problems.turning));
    report::write(works)
}
