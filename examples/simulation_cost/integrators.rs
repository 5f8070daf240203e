//! Adaptive steps: `simulate` with projection, and `integrate` on the right-hand side alone.

use std::rc::Rc;

use linkage::integrate::{Dop853, Dopri5, Integration, Method, Tolerance};
use linkage::simulation::{Start, simulate};
use linkage::{Build, MotionError, StateParts};

use super::list::{INTEGRATE_5, INTEGRATE_8, Outcome, SIMULATE_5, SIMULATE_8, Work};
use super::problem::{Emitted, Problem, State};

/// The limit on steps: the default of `linkage` and `ode_solvers`.
pub const MOST_STEPS: usize = 100_000;

/// The final state of a run and its number of right-hand sides, or its error.
pub type End<S> = Result<(State<S>, usize), String>;

/// A run with a given tolerance.
pub type Run<S> = fn(&Problem<S>, f64) -> End<S>;

pub fn works<S: Emitted + 'static>(problem: &Rc<Problem<S>>) -> Vec<Work> {
    let methods: [(usize, Run<S>); 4] = [
        (SIMULATE_8, Problem::simulated::<Dop853>),
        (SIMULATE_5, Problem::simulated::<Dopri5>),
        (INTEGRATE_8, Problem::integrated::<Dop853>),
        (INTEGRATE_5, Problem::integrated::<Dopri5>),
    ];
    methods.into_iter().flat_map(|(method, end)| by_tolerance(problem, method, end)).collect()
}

/// The digits of the tightest tolerance; fewer for unoptimised code.
const MOST_DIGITS: i32 = if cfg!(debug_assertions) { 7 } else { 13 };

/// The runs of a method at tolerances from 1e-3 downwards.
pub fn by_tolerance<S: Emitted + 'static>(
    problem: &Rc<Problem<S>>,
    method: usize,
    end: impl Fn(&Problem<S>, f64) -> End<S> + Copy + 'static,
) -> impl Iterator<Item = Work> {
    (3..=MOST_DIGITS).map(move |digits| {
        let (problem, setting) = (Rc::clone(problem), 10.0_f64.powi(-digits));
        let run = move || {
            let (y, evaluations) = end(&problem, setting)?;
            Ok(Outcome { error: problem.error(&y), gap: problem.gap(&y), evaluations })
        };
        Work { method, setting, run: Box::new(run) }
    })
}

impl<S: Emitted> Problem<S> {
    fn simulated<M: Method>(&self, tolerance: f64) -> End<S> {
        let end = || {
            let StateParts { q, input_rates } = S::parts(&self.start);
            let mut motion =
                simulate(&self.scene, Start { t: 0.0, q, input_rates }, self.end, tolerance)?.method::<M>()?;
            motion.finish(|_, _| true)?;
            Ok((S::state(&motion.state().q, &input_rates), motion.counts().evaluations))
        };
        end().map_err(|error: MotionError| error.to_string())
    }

    fn integrated<M: Method>(&self, tolerance: f64) -> End<S> {
        let end = || {
            let rate = |t: f64, y: &State<S>| self.scene.derivative(t, y);
            let tolerance = Tolerance::new(tolerance, self.start.dim().repeat(1.0))?;
            let mut motion = Integration::<_, M>::new(rate, (0.0, self.start), self.end, tolerance)?;
            motion.finish(|_, _| true)?;
            Ok((*motion.state(), motion.counts().evaluations))
        };
        end().map_err(|error: MotionError| error.to_string())
    }

    /// y', or NaN on an error, for integrators without error handling.
    #[inline]
    pub fn rate(&self, t: f64, y: &State<S>) -> State<S> {
        self.scene.derivative(t, y).unwrap_or_else(|_| y.dim().repeat(f64::NAN))
    }
}
