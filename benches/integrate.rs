//! Accuracy and time of `linkage::integrate` and of the crates `ode_solvers` and `differential-equations`, with the
//! same methods on the same problems, timed alternately.
//!
//! `cargo bench --bench integrate`
//!
//! Columns: the error of the final state, the calls of the right-hand side, and the median time in microseconds.

use std::cell::Cell;
use std::hint::black_box;
use std::time::Instant;

use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use linkage::MotionError;
use linkage::integrate::{Tolerance, dop853, dopri5};
use linkage::nalgebra::SVector;

/// The number of readings of each crate; the median counts.
const READINGS: usize = 21;

type State<const N: usize> = SVector<f64, N>;
type TheirState<const N: usize> = ode_solvers::SVector<f64, N>;

/// A motion with known final state.
trait Problem<const N: usize>: Copy {
    const NAME: &str;
    const START: [f64; N];
    const INTERVAL: f64;
    fn rate(y: [f64; N]) -> [f64; N];
    /// The error of the final state.
    fn miss(end: [f64; N]) -> f64;
}

/// A pendulum of 1 m released at the horizontal, for 10 s.
#[derive(Clone, Copy)]
struct Pendulum;

impl Problem<2> for Pendulum {
    const NAME: &str = "pendulum";
    const START: [f64; 2] = [std::f64::consts::FRAC_PI_2, 0.0];
    const INTERVAL: f64 = 10.0;

    #[inline(always)]
    fn rate(y: [f64; 2]) -> [f64; 2] {
        [y[1], -9.81 * y[0].sin()]
    }

    /// The error of the bob's position, relative to the exact solution by elliptic functions.
    fn miss(end: [f64; 2]) -> f64 {
        let (x, z) = (end[0].sin() - 0.275_087_462_576_116_9, -end[0].cos() + 0.961_419_205_099_125_1);
        x.abs().max(z.abs())
    }
}

/// A periodic orbit of a satellite around earth and moon (Hairer, Norsett and Wanner, section II.0).
#[derive(Clone, Copy)]
struct Arenstorf;

impl Problem<4> for Arenstorf {
    const NAME: &str = "Arenstorf's orbit";
    const START: [f64; 4] = [0.994, 0.0, 0.0, -2.001_585_106_379_082_5];
    const INTERVAL: f64 = 17.065_216_560_157_963;

    #[inline(always)]
    fn rate(y: [f64; 4]) -> [f64; 4] {
        let moon = 0.012_277_471;
        let earth = 1.0 - moon;
        let [d1, d2] = [y[0] + moon, y[0] - earth].map(|x| {
            let square = x * x + y[1] * y[1];
            square * square.sqrt()
        });
        [
            y[2],
            y[3],
            y[0] + 2.0 * y[3] - earth * (y[0] + moon) / d1 - moon * (y[0] - earth) / d2,
            y[1] - 2.0 * y[2] - earth * y[1] / d1 - moon * y[1] / d2,
        ]
    }

    fn miss(end: [f64; 4]) -> f64 {
        end.iter().zip(Self::START).fold(0.0, |most, (end, start)| most.max((end - start).abs()))
    }
}

#[derive(Clone, Copy)]
enum Order {
    Five,
    Eight,
}

/// The right-hand side with a count of its calls.
#[derive(Clone, Copy)]
struct Called<'a, P>(P, &'a Cell<usize>);

impl<P: Problem<N>, const N: usize> ode_solvers::System<f64, TheirState<N>> for Called<'_, P> {
    #[inline(always)]
    fn system(&self, _: f64, y: &TheirState<N>, rate: &mut TheirState<N>) {
        self.1.set(self.1.get() + 1);
        *rate = P::rate((*y).into()).into();
    }
}

fn ours<P: Problem<N>, const N: usize>(called: Called<P>, order: Order, relative: f64) -> [f64; N] {
    let rate = |_: f64, y: &State<N>| {
        called.1.set(called.1.get() + 1);
        Ok::<State<N>, MotionError>(P::rate((*y).into()).into())
    };
    let start = (0.0, P::START);
    let tolerance = Tolerance::new(relative, [1.0; N]).expect("a tolerance that can be met");
    let state = match order {
        Order::Five => dopri5(rate, start, P::INTERVAL, tolerance).and_then(|mut motion| {
            motion.finish(|_, _| true)?;
            Ok(*motion.state())
        }),
        Order::Eight => dop853(rate, start, P::INTERVAL, tolerance).and_then(|mut motion| {
            motion.finish(|_, _| true)?;
            Ok(*motion.state())
        }),
    };
    state.expect("an end").into()
}

fn ode_solvers<P: Problem<N>, const N: usize>(called: Called<P>, order: Order, relative: f64) -> [f64; N] {
    let (end, start) = (P::INTERVAL, TheirState::<N>::from(P::START));
    let last = |states: &Vec<TheirState<N>>| *states.last().expect("an end");
    let state = match order {
        Order::Five => {
            let mut stepper = ode_solvers::Dopri5::new(called, 0.0, end, end, start, relative, relative);
            stepper.set_output(ode_solvers::dop_shared::OutputType::Sparse);
            stepper.integrate().expect("an end");
            last(stepper.y_out())
        }
        Order::Eight => {
            let mut stepper = ode_solvers::Dop853::new(called, 0.0, end, end, start, relative, relative);
            stepper.set_output(ode_solvers::dop_shared::OutputType::Sparse);
            stepper.integrate().expect("an end");
            last(stepper.y_out())
        }
    };
    state.into()
}

fn differential_equations<P: Problem<N>, const N: usize>(called: Called<P>, order: Order, relative: f64) -> [f64; N] {
    let rate = |_: f64, y: &State<N>, rate: &mut State<N>| {
        called.1.set(called.1.get() + 1);
        *rate = P::rate((*y).into()).into();
    };
    let problem = IVP::ode_from_fn(rate, 0.0, P::INTERVAL, State::<N>::from(P::START));
    let most = 1_000_000;
    let solution = match order {
        Order::Five => {
            problem.method(ExplicitRungeKutta::dopri5().rtol(relative).atol(relative).max_steps(most)).solve()
        }
        Order::Eight => {
            problem.method(ExplicitRungeKutta::dop853().rtol(relative).atol(relative).max_steps(most)).solve()
        }
    };
    (*solution.expect("an end").y.last().expect("an end")).into()
}

fn median(mut readings: Vec<f64>) -> f64 {
    readings.sort_unstable_by(f64::total_cmp);
    readings[readings.len() / 2]
}

fn rows<P: Problem<N>, const N: usize>(problem: P, order: Order) {
    let name = match order {
        Order::Five => "5(4)",
        Order::Eight => "8(5,3)",
    };
    println!("\n{}, order {name}", P::NAME);
    println!("{:9} {:^29} {:^29} {:^29}", "tolerance", "linkage", "ode_solvers", "differential-equations");
    println!("{:9}{}", "", format!(" {:>9} {:>8} {:>10}", "error", "calls", "us").repeat(3));
    for relative in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let calls = Cell::new(0);
        let called = Called(problem, &calls);
        let solvers = [ours::<P, N>, ode_solvers::<P, N>, differential_equations::<P, N>];
        let costs = solvers.map(|solver| {
            calls.set(0);
            let miss = P::miss(solver(called, order, relative));
            (miss, calls.get())
        });
        let mut times = [const { vec![] }; 3];
        for _ in 0..READINGS {
            for (solver, times) in solvers.iter().zip(&mut times) {
                let start = Instant::now();
                black_box(solver(black_box(called), order, black_box(relative)));
                times.push(start.elapsed().as_secs_f64() * 1e6);
            }
        }
        print!("{relative:9.0e}");
        for ((miss, calls), times) in costs.into_iter().zip(times) {
            print!(" {miss:9.1e} {calls:8} {:10.1}", median(times));
        }
        println!();
    }
}

fn main() {
    for order in [Order::Eight, Order::Five] {
        rows(Pendulum, order);
        rows(Arenstorf, order);
    }
}
