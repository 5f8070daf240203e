//! Adaptive steps: `simulate` with projection, and `integrate` and other crates on the right-hand side alone.

use std::cell::Cell;
use std::rc::Rc;

use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use linkage::integrate::{Dop853, Dopri5, Integration, Method, Tolerance};
use linkage::nalgebra::SVector;
use linkage::simulation::{Start, simulate};
use linkage::{Build, D, MotionError, StateParts};

use super::list::{
    DIFFERENTIAL_EQUATIONS_5, DIFFERENTIAL_EQUATIONS_8, INTEGRATE_5, INTEGRATE_8, ODE_SOLVERS_5, ODE_SOLVERS_8,
    Outcome, SIMULATE_5, SIMULATE_8, Work,
};
use super::problem::{Emitted, Problem, State};

/// The limit on steps: the default of `linkage` and `ode_solvers`.
pub const MOST_STEPS: usize = 100_000;

/// The final state of a run and its number of right-hand sides, or its error.
pub type End<S> = Result<(State<S>, usize), String>;

/// A run with a given tolerance.
type Run<S> = fn(&Problem<S>, f64) -> End<S>;

pub fn works<S: Emitted<State = D<N>> + 'static, const N: usize>(problem: &Rc<Problem<S>>) -> Vec<Work> {
    let methods: [(usize, Run<S>); 8] = [
        (SIMULATE_8, Problem::simulated::<Dop853>),
        (SIMULATE_5, Problem::simulated::<Dopri5>),
        (INTEGRATE_8, Problem::integrated::<Dop853>),
        (INTEGRATE_5, Problem::integrated::<Dopri5>),
        (ODE_SOLVERS_8, Problem::by_ode_solvers::<true>),
        (ODE_SOLVERS_5, Problem::by_ode_solvers::<false>),
        (DIFFERENTIAL_EQUATIONS_8, Problem::by_differential_equations::<true>),
        (DIFFERENTIAL_EQUATIONS_5, Problem::by_differential_equations::<false>),
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

impl<S: Emitted<State = D<N>>, const N: usize> Problem<S> {
    fn by_ode_solvers<const IS_EIGHT: bool>(&self, tolerance: f64) -> End<S> {
        let calls = Cell::new(0);
        let start = ode_solvers::SVector::<f64, N>::from(<[f64; N]>::from(self.start));
        let called = Called(self, &calls);
        let sparse = ode_solvers::dop_shared::OutputType::Sparse;
        let last = if IS_EIGHT {
            let mut stepper = ode_solvers::Dop853::new(called, 0.0, self.end, self.end, start, tolerance, tolerance);
            stepper.set_output(sparse);
            stepper.integrate().map(|_| stepper.y_out().last().copied())
        } else {
            let mut stepper = ode_solvers::Dopri5::new(called, 0.0, self.end, self.end, start, tolerance, tolerance);
            stepper.set_output(sparse);
            stepper.integrate().map(|_| stepper.y_out().last().copied())
        };
        let last = last.map_err(|error| error.to_string())?.ok_or("no state")?;
        Ok((<[f64; N]>::from(last).into(), calls.get()))
    }

    fn by_differential_equations<const IS_EIGHT: bool>(&self, tolerance: f64) -> End<S> {
        let calls = Cell::new(0);
        let system = |t: f64, y: &SVector<f64, N>, slope: &mut SVector<f64, N>| {
            calls.set(calls.get() + 1);
            *slope = self.rate(t, &(*y).into()).into();
        };
        let motion = IVP::ode_from_fn(system, 0.0, self.end, SVector::from(self.start));
        let solution = if IS_EIGHT {
            motion.method(ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).max_steps(MOST_STEPS)).solve()
        } else {
            motion.method(ExplicitRungeKutta::dopri5().rtol(tolerance).atol(tolerance).max_steps(MOST_STEPS)).solve()
        };
        let solution = solution.map_err(|error| format!("{error:?}"))?;
        Ok(((*solution.y.last().ok_or("no state")?).into(), calls.get()))
    }
}

/// The right-hand side with a count of its calls.
struct Called<'a, S: Emitted>(&'a Problem<S>, &'a Cell<usize>);

impl<S, const N: usize> ode_solvers::System<f64, ode_solvers::SVector<f64, N>> for Called<'_, S>
where
    S: Emitted<State = D<N>>,
{
    #[inline]
    fn system(&self, t: f64, y: &ode_solvers::SVector<f64, N>, slope: &mut ode_solvers::SVector<f64, N>) {
        self.1.set(self.1.get() + 1);
        *slope = <[f64; N]>::from(self.0.rate(t, &<[f64; N]>::from(*y).into())).into();
    }
}
