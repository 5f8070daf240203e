//! Formulas, velocities and motions over intervals.

#[path = "../at_run_time.rs"]
mod at_run_time;
mod certificates;
mod certified_ranges;
mod intervals;
