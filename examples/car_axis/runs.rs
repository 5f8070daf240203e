//! Runs of the car axis to its published end.

use std::time::Instant;

use linkage::integrate::Method;
use linkage::simulation::{Start, State, simulate};
use linkage::{Error, PositionError};

use linkage_gallery::car_axis::Riding;
use linkage_gallery::car_axis_motion::{END, END_TIME, END_VELOCITIES, START, START_RATES};

/// The number of repetitions; the fastest counts.
pub const REPETITIONS: usize = if cfg!(debug_assertions) { 1 } else { 50 };

/// The cost of a run, and its error.
pub struct Run {
    pub tolerance: f64,
    /// The largest relative errors of the positions and of the velocities of both ends of the chassis.
    pub errors: [f64; 2],
    /// Accepted steps.
    pub steps: usize,
    /// Evaluations of the equations of motion.
    pub evaluations: usize,
    /// The fastest run in milliseconds.
    pub milliseconds: f64,
}

/// The positions of the left and the right end, and their velocities.
///
/// # Errors
/// [`PositionError`] if they are not finite.
pub fn ends(state: &State<Riding>, scene: &Riding) -> Result<[[f64; 4]; 2], PositionError> {
    let axis = &scene.mechanism;
    let pose = axis.pose_at(&state.q);
    let (at, moving) = (axis.points(&pose)?, axis.point_velocities(&pose, &state.rates)?);
    Ok([[at.left.x, at.left.y, at.right.x, at.right.y], [moving.left.x, moving.left.y, moving.right.x, moving.right.y]])
}

/// The largest relative errors of the positions and of the velocities at the end.
///
/// # Errors
/// [`PositionError`] if one is not finite.
pub fn errors(state: &State<Riding>, scene: &Riding) -> Result<[f64; 2], PositionError> {
    let largest = |found: [f64; 4], expected: [f64; 4]| {
        let relative = found.into_iter().zip(expected).map(|(found, expected)| (found / expected - 1.0).abs());
        relative.fold(0.0, f64::max)
    };
    let [at, moving] = ends(state, scene)?;
    Ok([largest(at, END), largest(moving, END_VELOCITIES)])
}

/// Rides to the end by a method at a tolerance.
///
/// # Errors
/// Those of the simulation.
pub fn run<M: Method>(tolerance: f64) -> Result<Run, Error> {
    let scene = Riding::default();
    let mut fastest = f64::INFINITY;
    let (mut errors_at_end, mut counts) = ([0.0; 2], Default::default());
    for _ in 0..REPETITIONS {
        let clock = Instant::now();
        let start = Start { t: 0.0, q: START, input_rates: START_RATES };
        let mut motion = simulate(&scene, start, END_TIME, tolerance)?.method::<M>()?;
        motion.finish(|_, _| true)?;
        fastest = fastest.min(clock.elapsed().as_secs_f64());
        errors_at_end = errors(motion.state(), &scene)?;
        counts = motion.counts();
    }
    let linkage::integrate::Counts { accepted: steps, evaluations, .. } = counts;
    Ok(Run { tolerance, errors: errors_at_end, steps, evaluations, milliseconds: 1e3 * fastest })
}
