//! Motions that are followed: paths, steps over change points, circuits, and the cases at which usual formulas fail.

#[path = "../at_run_time.rs"]
mod at_run_time;
mod by_continuation;
mod circuits;
mod continuation;
mod crossings;
mod hard_cases;
mod held;
mod joint_ranges;
mod parameters;
mod range_of_motion;
mod reports;
