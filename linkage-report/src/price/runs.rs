//! Runs of a scene.

use linkage_double::DoubleDouble;
use linkage_dynamics::integrate::{Counts, Dop853, Dopri5, Method};
use linkage_dynamics::simulation::{Simulation, Start, State, simulate};
use linkage_dynamics::{MotionError, MotionErrorOf, Scene, StateColumn, StateParts};
use linkage_runtime::__shared::to_f64;
use linkage_runtime::jacobian::Scales;
use linkage_runtime::{Column, Mechanism};

/// A method of integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Order {
    /// Dormand and Prince, order 8(5,3): `Dop853`.
    Eight,
    /// Dormand and Prince, order 5(4): `Dopri5`.
    Five,
}

/// The states at the sampled times, and the cost.
pub(super) struct Run<S: Scene> {
    pub(super) states: Vec<StateColumn<S>>,
    pub(super) counts: Counts,
}

/// A run that ended early, with its time.
pub(super) struct Failed {
    pub(super) t: f64,
    pub(super) error: MotionError,
}

/// The most steps of a run in double-double.
const MOST_STEPS: usize = 10_000_000;

/// A simulation from a state.
pub(super) fn simulate_from<'a, S: Scene>(
    scene: &'a S,
    (t, y): (S::Scalar, &StateColumn<S>),
    end: S::Scalar,
    tolerance: f64,
) -> Result<Simulation<'a, S>, MotionErrorOf<S>> {
    let StateParts { q, input_rates } = scene.parts_of(y);
    simulate(scene, Start { t, q, input_rates }, end, tolerance)
}

pub(super) fn run_by<S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>>>(
    scene: &S,
    from: (f64, &StateColumn<S>),
    times: &[f64],
    (order, tolerance): (Order, f64),
) -> Result<Run<S>, Failed> {
    let mut found = match order {
        Order::Eight => run::<S, Dop853>(scene, from, times, tolerance),
        Order::Five => run::<S, Dopri5>(scene, from, times, tolerance),
    }?;
    // Outputs within steps cost right-hand sides of their own.
    let end = times.last().copied().unwrap_or(from.0);
    let counts = run_to_end(scene, from, end, (order, tolerance));
    found.counts = counts.map_err(|error| Failed { t: from.0, error })?;
    Ok(found)
}

/// The states of a run at these times, the last of which is its end.
pub(super) fn run<S: Scene<Mechanism: Mechanism<Name = &'static str>>, M: Method>(
    scene: &S,
    from: (S::Scalar, &StateColumn<S>),
    times: &[S::Scalar],
    tolerance: f64,
) -> Result<Run<S>, Failed> {
    let end = times.last().copied().unwrap_or(from.0);
    let failed = |t: S::Scalar| move |error| Failed { t: to_f64(t), error };
    let mut motion = simulate_from(scene, from, end, tolerance)
        .and_then(|motion| Ok(motion.method::<M>()?.most_steps(MOST_STEPS)))
        .map_err(failed(from.0))?;
    let mut states = Vec::with_capacity(times.len());
    let column = |state: &State<S>| {
        let (_, inputs) = S::Mechanism::rate_parts(&state.rates);
        scene.state_of(&state.q, &inputs.into())
    };
    loop {
        let next = motion.advance();
        let t = motion.t();
        if next.map_err(failed(t))?.is_none() {
            break;
        }
        while let Some(at) = times.get(states.len()).copied().filter(|at| *at < t || *at == t && t != end) {
            let state = motion.at([at]).next().transpose().map_err(failed(at))?;
            states.push(column(&state.unwrap_or(*motion.state())));
        }
    }
    states.push(column(motion.state()));
    states.truncate(times.len());
    Ok(Run { states, counts: motion.counts() })
}

/// The cost of a run without outputs.
pub(super) fn run_to_end<S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>>>(
    scene: &S,
    from: (f64, &StateColumn<S>),
    end: f64,
    (order, tolerance): (Order, f64),
) -> Result<Counts, MotionError> {
    fn finished<S: Scene<Mechanism: Mechanism<Name = &'static str>>, M: Method>(
        motion: Simulation<'_, S>,
    ) -> Result<Counts, MotionError> {
        let mut motion = motion.method::<M>()?.most_steps(MOST_STEPS);
        motion.finish(|_, _| true)?;
        Ok(motion.counts())
    }
    let motion = simulate_from(scene, from, end, tolerance)?;
    match order {
        Order::Eight => finished::<S, Dop853>(motion),
        Order::Five => finished::<S, Dopri5>(motion),
    }
}

/// The largest of these differences of coordinates from a state, each divided by its scale; infinite if one is NaN.
pub(super) fn error<S: Scene<Scalar = f64>>(
    scene: &S,
    difference: &Column<DoubleDouble, S::State>,
    at: &StateColumn<S>,
) -> f64 {
    let (m, q) = (scene.mechanism(), scene.parts_of(at).q);
    let scales = Scales::of(m, &m.pose_at(&q)).coordinates;
    let difference = scene.parts_of(&difference.map(DoubleDouble::high)).q;
    let (unknowns, inputs) = S::Mechanism::parts(&difference);
    let unknowns = unknowns.component_div(&scales.unknowns).abs();
    let inputs = inputs.component_div(&scales.inputs).abs();
    let all = unknowns.iter().chain(inputs.iter());
    all.fold(0.0, |largest: f64, error| if error.is_nan() { f64::INFINITY } else { largest.max(*error) })
}
