//! The integrators of other crates, on the right-hand side alone. They are no part of the library of the examples, so that its
//! tests do not build them.

use std::cell::Cell;
use std::rc::Rc;

use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use linkage::D;
use linkage::nalgebra::SVector;
use linkage_examples::simulation_cost::integrators::{End, MOST_STEPS, Run, by_tolerance};
use linkage_examples::simulation_cost::list::{
    DIFFERENTIAL_EQUATIONS_5, DIFFERENTIAL_EQUATIONS_8, ODE_SOLVERS_5, ODE_SOLVERS_8, Work,
};
use linkage_examples::simulation_cost::problem::{Emitted, Problem};
use linkage_examples::simulation_cost::report::Problems;

/// The runs for each problem.
pub fn works(Problems { squeezer, windows, sprung, turning }: &Problems) -> [Vec<Work>; 4] {
    [of(squeezer), of(windows), of(sprung), of(turning)]
}

fn of<S: Emitted<State = D<N>> + 'static, const N: usize>(problem: &Rc<Problem<S>>) -> Vec<Work> {
    let methods: [(usize, Run<S>); 4] = [
        (ODE_SOLVERS_8, by_ode_solvers::<true, S, N>),
        (ODE_SOLVERS_5, by_ode_solvers::<false, S, N>),
        (DIFFERENTIAL_EQUATIONS_8, by_differential_equations::<true, S, N>),
        (DIFFERENTIAL_EQUATIONS_5, by_differential_equations::<false, S, N>),
    ];
    methods.into_iter().flat_map(|(method, end)| by_tolerance(problem, method, end)).collect()
}

fn by_ode_solvers<const IS_EIGHT: bool, S, const N: usize>(problem: &Problem<S>, tolerance: f64) -> End<S>
where
    S: Emitted<State = D<N>>,
{
    let calls = Cell::new(0);
    let start = ode_solvers::SVector::<f64, N>::from(<[f64; N]>::from(problem.start));
    let (called, end) = (Called(problem, &calls), problem.end);
    let sparse = ode_solvers::dop_shared::OutputType::Sparse;
    let last = if IS_EIGHT {
        let mut stepper = ode_solvers::Dop853::new(called, 0.0, end, end, start, tolerance, tolerance);
        stepper.set_output(sparse);
        stepper.integrate().map(|_| stepper.y_out().last().copied())
    } else {
        let mut stepper = ode_solvers::Dopri5::new(called, 0.0, end, end, start, tolerance, tolerance);
        stepper.set_output(sparse);
        stepper.integrate().map(|_| stepper.y_out().last().copied())
    };
    let last = last.map_err(|error| error.to_string())?.ok_or("no state")?;
    Ok((<[f64; N]>::from(last).into(), calls.get()))
}

fn by_differential_equations<const IS_EIGHT: bool, S, const N: usize>(problem: &Problem<S>, tolerance: f64) -> End<S>
where
    S: Emitted<State = D<N>>,
{
    let calls = Cell::new(0);
    let system = |t: f64, y: &SVector<f64, N>, slope: &mut SVector<f64, N>| {
        calls.set(calls.get() + 1);
        *slope = problem.rate(t, &(*y).into()).into();
    };
    let motion = IVP::ode_from_fn(system, 0.0, problem.end, SVector::from(problem.start));
    let solution = if IS_EIGHT {
        motion.method(ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).max_steps(MOST_STEPS)).solve()
    } else {
        motion.method(ExplicitRungeKutta::dopri5().rtol(tolerance).atol(tolerance).max_steps(MOST_STEPS)).solve()
    };
    let solution = solution.map_err(|error| format!("{error:?}"))?;
    Ok(((*solution.y.last().ok_or("no state")?).into(), calls.get()))
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
