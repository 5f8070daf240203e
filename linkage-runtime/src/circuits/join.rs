//! Circuits: motions joined at the change points where they cross.

use std::vec::Vec;

use super::motion::MotionCurve;
use crate::Real;

/// The motions of each circuit, in order.
pub(super) fn circuits<Q: Copy, T: Real, N: Copy>(
    motions: &[MotionCurve<Q, T, N>],
    are_near: impl Fn(&Q, &Q) -> bool,
) -> Vec<Vec<usize>> {
    let change_points: Vec<Vec<Q>> =
        motions.iter().map(|motion| motion.change_points().map(|at| at.point.position).collect()).collect();
    let cross = |one: usize, other: usize| {
        change_points[one].iter().any(|at| change_points[other].iter().any(|other| are_near(at, other)))
    };
    let mut circuits: Vec<Vec<usize>> = Vec::new();
    for motion in 0..motions.len() {
        let (joined, mut others): (Vec<_>, Vec<_>) =
            circuits.into_iter().partition(|circuit| circuit.iter().any(|&other| cross(motion, other)));
        let mut circuit: Vec<usize> = joined.into_iter().flatten().chain([motion]).collect();
        circuit.sort_unstable();
        others.push(circuit);
        circuits = others;
    }
    circuits.sort_unstable();
    circuits
}
