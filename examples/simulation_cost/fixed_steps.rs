//! Steps of one length by Kutta's method: ours in the inputs, and the formulations with multipliers.

use std::rc::Rc;

use linkage::Scene;
use linkage::nalgebra::{Const, DimMin, SVector};
use linkage::simulation::RealTime;

use super::formulations::{Hold, Multipliers};
use super::list::{ACCELERATIONS, Outcome, PROJECTED, REAL_TIME, STRONGLY, WEAKLY, Work};
use super::problem::Problem;

/// Doublings of the number of steps: code that is not optimised is not timed for long.
const DOUBLINGS: u32 = if cfg!(debug_assertions) { 0 } else { 4 };

/// With so many steps at the least, and Baumgarte's two alphas in 1/s.
pub fn works<const C: usize, const D: usize, S, const U: usize, const V: usize, const N: usize>(
    problem: &Rc<Problem<S, U, V, N>>,
    least: u32,
    [weak, strong]: [f64; 2],
) -> Vec<Work>
where
    S: Scene<f64, U, V, N, 0> + 'static,
    Const<D>: DimMin<Const<D>, Output = Const<D>>,
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
                    None => in_the_inputs(&problem, steps),
                    Some(hold) => with_multipliers::<C, D, _, U, V, N>(&problem, hold, steps),
                };
                let y = y.map_err(|error| error.to_string())?;
                Ok(Outcome { error: problem.error(&y), gap: problem.gap(&y), evaluations: 4 * steps as usize })
            };
            Work { method, setting, run: Box::new(run) }
        })
        .collect()
}

/// The end by `RealTime`.
pub fn in_the_inputs<S, const U: usize, const V: usize, const N: usize>(
    problem: &Problem<S, U, V, N>,
    steps: u32,
) -> Result<SVector<f64, N>, Box<dyn std::error::Error>>
where
    S: Scene<f64, U, V, N, 0>,
{
    let (q, rates) = S::parts(&problem.start);
    let mut clock = RealTime::new(&problem.scene, (0.0, q, rates), problem.end / f64::from(steps))?;
    for _ in 0..steps {
        clock.step()?;
    }
    Ok(S::state(&clock.state()?.q, &rates))
}

/// The end by index 1.
pub fn with_multipliers<const C: usize, const D: usize, S, const U: usize, const V: usize, const N: usize>(
    problem: &Problem<S, U, V, N>,
    hold: Hold,
    steps: u32,
) -> Result<SVector<f64, N>, Box<dyn std::error::Error>>
where
    S: Scene<f64, U, V, N, 0>,
    Const<D>: DimMin<Const<D>, Output = Const<D>>,
{
    let mut motion = Multipliers::<S, U, V, N, C, D>::new(problem, hold)?;
    let h = problem.end / f64::from(steps);
    for step in 0..steps {
        motion.step(f64::from(step) * h, h)?;
    }
    Ok(motion.y())
}
