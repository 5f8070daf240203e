//! `diffsol` on the right-hand side alone: Tsitouras's pair of order 5(4), on vectors of nalgebra.

use std::cell::Cell;
use std::rc::Rc;

use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason};
use linkage::{Column, Dim, Scene};

use linkage_examples::simulation_cost::integrators::{End, MOST_STEPS, by_tolerance};
use linkage_examples::simulation_cost::list::{METHODS, Work};
use linkage_examples::simulation_cost::problem::{Emitted, Problem};

pub fn works<S: Emitted + 'static>(problem: &Rc<Problem<S>>) -> Vec<Work> {
    let method = METHODS.iter().position(|method| method.name.starts_with("diffsol")).expect("a method of the list");
    by_tolerance(problem, method, |problem, tolerance| end(problem, tolerance)).collect()
}

fn end<S: Emitted>(problem: &Problem<S>, tolerance: f64) -> End<S> {
    let calls = Cell::new(0);
    let rhs = |y: &[f64], _: &[f64], t: f64, slope: &mut [f64]| {
        calls.set(calls.get() + 1);
        slope.copy_from_slice(problem.rate(t, &Column::from_fn(|row| y[row])).as_slice());
    };
    let init = |_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(problem.start.as_slice());
    let motion = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tolerance)
        .atol([tolerance])
        .rhs(rhs)
        .init(init, S::State::COUNT)
        .build();
    let motion = motion.map_err(|error| error.to_string())?;
    let mut solver = motion.tsit45().map_err(|error| error.to_string())?;
    solver.set_stop_time(problem.end).map_err(|error| error.to_string())?;
    for step in 0.. {
        if step == MOST_STEPS {
            return Err(format!("the limit of {MOST_STEPS} steps is reached at t = {}", solver.state().t));
        }
        if solver.step().map_err(|error| error.to_string())? == OdeSolverStopReason::TstopReached {
            break;
        }
    }
    let y = Column::from_fn(|component| solver.state().y[component]);
    Ok((y, calls.get()))
}
