//! The time of a method as its operations predict it: the number of each kind times the measured time of one.

use std::hint::black_box;
use std::time::Instant;

use linkage::Real;
use linkage::derivation::{Derivation, Operations};
use linkage_double::DoubleDouble;

use crate::methods::scalar;

/// The length of a chain of dependent operations, and how often it is measured.
const CHAIN: usize = 400;
const ROUNDS: usize = 15;

/// Nanoseconds of one operation of each kind, in two chains of dependent ones: emitted code has about two independent
/// operations at a time.
#[derive(Debug, Clone, Copy)]
pub struct Costs {
    function: f64,
    division: f64,
    multiplication: f64,
    addition: f64,
}

impl Costs {
    fn measured<T: Real>() -> Self {
        let near_one = scalar::<T>(1.0 + 1e-6);
        Self {
            function: nanoseconds(|x: T| {
                let (sine, cosine) = x.sine_cosine();
                sine + cosine
            }),
            division: nanoseconds(move |x: T| near_one / x),
            multiplication: nanoseconds(move |x: T| near_one * x),
            addition: nanoseconds(move |x: T| near_one + x),
        }
    }

    /// The time of these operations one after another.
    fn of(self, operations: Operations) -> f64 {
        let Operations { functions, divisions, multiplications, additions } = operations;
        self.function * functions as f64
            + self.division * divisions as f64
            + self.multiplication * multiplications as f64
            + self.addition * additions as f64
    }
}

/// The costs in each scalar.
#[derive(Debug, Clone, Copy)]
pub struct Machine {
    pub single: Costs,
    pub double: Costs,
    pub twice: Costs,
}

impl Machine {
    pub fn measured() -> Self {
        Self {
            single: Costs::measured::<f32>(),
            double: Costs::measured::<f64>(),
            twice: Costs::measured::<DoubleDouble>(),
        }
    }

    /// The predicted nanoseconds in the scalar `T`.
    pub fn time<T>(&self, operations: Operations) -> f64 {
        let costs = match size_of::<T>() {
            4 => self.single,
            8 => self.double,
            _ => self.twice,
        };
        costs.of(operations)
    }
}

/// The median time of one operation in two chains.
fn nanoseconds<T: Real>(operation: impl Fn(T) -> T) -> f64 {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let mut chains = black_box([scalar::<T>(0.7), scalar::<T>(0.8)]);
            let start = Instant::now();
            for _ in 0..CHAIN {
                chains = chains.map(&operation);
            }
            black_box(chains);
            start.elapsed().as_secs_f64() * 1e9 / (2 * CHAIN) as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[ROUNDS / 2]
}

/// The operations of the methods for one mechanism.
#[derive(Debug, Clone, Copy)]
pub struct Counts {
    pub derivation: &'static Derivation<'static>,
    /// The unknowns of the group that is solved by factorisation, or zero.
    pub factorised: usize,
}

impl Counts {
    fn of(&self, function: &str) -> Operations {
        let kernel = self.derivation.kernels.iter().find(|kernel| kernel.function == function);
        kernel.map_or_else(Operations::default, |kernel| kernel.operations)
    }

    fn solved(&self, function: &str) -> Operations {
        sum([self.of(function), factorisation(self.factorised)])
    }

    /// The rates of this order at a pose.
    fn rates(&self, order: usize) -> Operations {
        sum(["velocity", "acceleration"].into_iter().take(order).map(|function| self.solved(function)))
    }

    /// The closed form.
    pub fn closed(&self, order: usize) -> Operations {
        sum([self.of("assemble"), self.rates(order)])
    }

    /// The closed form, and each dyad by Cramer's rule in products of stored sines.
    pub fn products(&self, order: usize) -> Operations {
        let dyads = self.derivation.unknowns.len() / 2;
        let dyad = Operations { functions: 0, divisions: 1, multiplications: 14, additions: 5 };
        let solved = ["jacobian_inputs", "gamma"].into_iter().take(order).map(|right| {
            let all = std::iter::repeat_n(dyad, dyads);
            sum([self.of(right), sum(all)])
        });
        sum([self.of("assemble"), sum(solved)])
    }

    /// The prediction by the velocity ratios, Newton steps, and the rates.
    pub fn newton(&self, steps: usize, order: usize) -> Operations {
        let predicted = sum([self.of("jacobian_inputs"), self.solved("solve_jacobian"), self.of("pose_at")]);
        let step = sum([self.of("residual"), self.solved("solve_jacobian"), self.of("pose_at")]);
        sum([predicted, sum(std::iter::repeat_n(step, steps)), self.rates(order)])
    }

    /// A cubic for each unknown, and the rates.
    pub fn table(&self, order: usize) -> Operations {
        let unknowns = self.derivation.unknowns.len();
        let cubics = Operations { functions: 0, divisions: 0, multiplications: 6 * unknowns, additions: 9 * unknowns };
        sum([cubics, self.of("pose_at"), self.rates(order)])
    }
}

/// Gaussian elimination of `n` unknowns with scaled rows and columns, and one solution; the power of two near a scale
/// takes two functions.
fn factorisation(n: usize) -> Operations {
    let eliminated = n * n.saturating_sub(1) * (2 * n).saturating_sub(1) / 6;
    Operations {
        functions: 4 * n,
        divisions: 2 * n,
        multiplications: eliminated + 3 * n * n,
        additions: eliminated + n * n,
    }
}

fn sum(all: impl IntoIterator<Item = Operations>) -> Operations {
    all.into_iter().fold(Operations::default(), |sum, one| Operations {
        functions: sum.functions + one.functions,
        divisions: sum.divisions + one.divisions,
        multiplications: sum.multiplications + one.multiplications,
        additions: sum.additions + one.additions,
    })
}
