//! Fixed steps by Kutta's method: `RealTime` in the inputs, and the formulations with multipliers.

use std::error::Error;
use std::rc::Rc;

use linkage::nalgebra::{Const, DimMin};
use linkage::simulation::{RealTime, Start};
use linkage::{D, MotionError, StateParts};

use super::formulations::{Hold, Multipliers};
use super::list::{ACCELERATIONS, Outcome, PROJECTED, REAL_TIME, STRONGLY, WEAKLY, Work};
use super::problem::{Emitted, Problem, State};

/// The number of doublings of the number of steps; 0 for unoptimised code.
const DOUBLINGS: u32 = if cfg!(debug_assertions) { 0 } else { 4 };

/// The runs from `least` steps upwards, with two values of Baumgarte's alpha in 1/s.
pub fn works<const N: usize, const U: usize, S>(
    problem: &Rc<Problem<S>>,
    least: u32,
    [weak, strong]: [f64; 2],
) -> Vec<Work>
where
    S: Emitted<U = D<U>, Contacts = D<0>> + 'static,
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    let holds = [
        (REAL_TIME, None),
        (ACCELERATIONS, Some(Hold::Accelerations)),
        (WEAKLY, Some(Hold::Baumgarte(weak))),
        (STRONGLY, Some(Hold::Baumgarte(strong))),
        (PROJECTED, Some(Hold::Projection)),
    ];
    let steps = (0..=DOUBLINGS).map(|doublings| least << doublings);
    let settings = holds.into_iter().flat_map(|hold| steps.clone().map(move |steps| (hold, steps)));
    settings
        .map(|((method, hold), steps)| {
            let problem = Rc::clone(problem);
            let setting = problem.end / f64::from(steps);
            let run = move || {
                let y = match hold {
                    None => in_the_inputs(&problem, steps).map_err(Into::into),
                    Some(hold) => with_multipliers::<N, _, _>(&problem, hold, steps),
                };
                let y = y.map_err(|error| error.to_string())?;
                Ok(Outcome { error: problem.error(&y), gap: problem.gap(&y), evaluations: 4 * steps as usize })
            };
            Work { method, setting, run: Box::new(run) }
        })
        .collect()
}

/// The final state by `RealTime`.
fn in_the_inputs<S>(problem: &Problem<S>, steps: u32) -> Result<State<S>, MotionError>
where
    S: Emitted<Contacts = D<0>>,
{
    let StateParts { q, input_rates } = S::parts(&problem.start);
    let mut clock = RealTime::new(&problem.scene, Start { t: 0.0, q, input_rates }, problem.end / f64::from(steps))?;
    for _ in 0..steps {
        clock.step()?;
    }
    Ok(S::state(&clock.state()?.q, &input_rates))
}

/// The final state by the index-1 formulation.
fn with_multipliers<const N: usize, const U: usize, S>(
    problem: &Problem<S>,
    hold: Hold,
    steps: u32,
) -> Result<State<S>, Box<dyn Error>>
where
    S: Emitted<U = D<U>>,
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    let mut motion = Multipliers::<S, U, N>::new(problem, hold)?;
    let h = problem.end / f64::from(steps);
    for step in 0..steps {
        motion.step(f64::from(step) * h, h)?;
    }
    Ok(motion.y())
}
