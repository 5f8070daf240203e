//! Circuits: all assembly modes at one input, followed by paths, against the theorems on four-bars and against a count by
//! small steps of the listed positions.

mod by_steps;
mod chart;
mod dead_points;
mod four_bars;
mod listed;
mod pairs;
mod several_turns;
mod six_bars;

use linkage::circuits::{CircuitOptions, Circuits, MotionCurve};
use linkage::{BorrowedName, Branches, D};

/// The circuits of a mechanism at one input.
pub fn circuits<M>(mechanism: &M, input: f64) -> Circuits<M::Coordinates, M::Branch, f64, M::Name>
where
    M: Branches<Scalar = f64, V = D<1>>,
{
    Circuits::of(mechanism, input, CircuitOptions::default()).unwrap()
}

/// The numbers of modes, of circuits and of full turns.
pub fn counts<Q: Copy, B: Copy, N: BorrowedName>(found: &Circuits<Q, B, f64, N>) -> [usize; 3] {
    [found.modes.len(), found.circuits.len(), found.full_turns()]
}

/// The inputs of the dead points of a motion, sorted.
pub fn dead_inputs<Q: Copy>(motion: &MotionCurve<Q>) -> Vec<f64> {
    let mut inputs: Vec<f64> = motion.dead_points().map(|at| at.point.input).collect();
    inputs.sort_by(f64::total_cmp);
    inputs
}
