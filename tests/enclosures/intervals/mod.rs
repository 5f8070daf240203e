//! `derive intervals`: the formulas over numbers of any kind, of every mechanism of the gallery.
//!
//! ```text
//! INTERVALS=3000 cargo test --release --all-features --test enclosures intervals -- --nocapture    poses of each mechanism
//! MECHANISM=four_bar cargo test --all-features --test enclosures intervals    one mechanism, by its file or its name
//! ```

mod cuts;
mod doubles;
mod duals;
mod enclosures;
mod facts;
mod formulas;
mod functions;
mod published;
mod sampled;
mod velocities;
mod wheels;

use linkage_gallery::checks::each;
use linkage_gallery::listed::{self, same_as};
use linkage_oracle::scalars;

/// Poses of each mechanism.
fn poses() -> usize {
    linkage_trials::count("INTERVALS", 2, 4)
}

#[test]
fn doubles_are_those_of_a_position() {
    each(&formulas::all(), |of| doubles::are_those_of_a_position(of, same_as(listed::all(), of)));
}

#[test]
fn derivatives_are_dual_numbers() {
    each(&formulas::all(), duals::are_the_derivatives);
}

#[test]
fn points_are_enclosed() {
    each(&formulas::all(), enclosures::of_points);
}

#[test]
fn boxes_are_enclosed() {
    each(&formulas::all(), enclosures::of_boxes);
}

#[test]
fn velocities_at_points_are_enclosed() {
    each(&formulas::all(), velocities::of_points);
}

#[test]
fn velocities_over_boxes_are_enclosed() {
    each(&formulas::all(), |of| velocities::of_boxes(of, same_as(scalars::rounded(), of)));
}

#[test]
fn sensitivities_are_enclosed() {
    let all = formulas::all();
    each(scalars::rounded_with_orders(), |emitted| velocities::of_sensitivities(same_as(&all, emitted), emitted));
}

#[test]
fn turns_leave_the_residual() {
    each(&formulas::all(), facts::turns_leave_the_residual);
}
