//! The time of a method as its operations predict it: the number of each kind times the measured time of one.

use std::hint::black_box;
use std::iter::repeat_n;
use std::time::Instant;

use linkage_double::DoubleDouble;
use linkage_runtime::derivation::{Derivation, GroupMethod, Kernel, Operations};
use linkage_runtime::{Real, real};

/// The length of a chain of dependent operations, and how often it is measured.
const CHAIN: usize = 400;
const ROUNDS: usize = 15;

/// Seconds of one operation of each kind, in two chains of dependent ones: emitted code has about two independent
/// operations at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Costs {
    function: f64,
    division: f64,
    multiplication: f64,
    addition: f64,
}

impl Costs {
    fn measured<T: Real>() -> Self {
        let near_one = real::<T>(1.0 + 1e-6);
        Self {
            function: seconds(|x: T| {
                let (sine, cosine) = x.sine_cosine();
                sine + cosine
            }),
            division: seconds(move |x: T| near_one / x),
            multiplication: seconds(move |x: T| near_one * x),
            addition: seconds(move |x: T| near_one + x),
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

/// The measured times of operations in each scalar, on this machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Machine {
    single: Costs,
    double: Costs,
    twice: Costs,
}

impl Machine {
    /// Measures them, in some milliseconds.
    #[must_use]
    pub fn measured() -> Self {
        Self {
            single: Costs::measured::<f32>(),
            double: Costs::measured::<f64>(),
            twice: Costs::measured::<DoubleDouble>(),
        }
    }

    /// The predicted seconds in the scalar `T`: `f32`, `f64` or `DoubleDouble`.
    #[must_use]
    pub fn time<T: Real>(&self, operations: Operations) -> f64 {
        let costs = match size_of::<T>() {
            4 => self.single,
            8 => self.double,
            _ => self.twice,
        };
        costs.of(operations)
    }
}

/// The median time of one operation in two chains.
fn seconds<T: Real>(operation: impl Fn(T) -> T) -> f64 {
    let time = |_| {
        let mut chains = black_box([real::<T>(0.7), real::<T>(0.8)]);
        let start = Instant::now();
        for _ in 0..CHAIN {
            chains = chains.map(&operation);
        }
        black_box(chains);
        start.elapsed().as_secs_f64() / (2 * CHAIN) as f64
    };
    let mut times: Vec<f64> = (0..ROUNDS).map(time).collect();
    times.sort_by(f64::total_cmp);
    times[ROUNDS / 2]
}

/// The operations of the methods for one mechanism.
#[derive(Debug, Clone, Copy)]
pub struct Counts<'a> {
    kernels: &'a [Kernel<'a>],
    unknowns: usize,
    /// The operations of the factorisations of one solution of J x = b.
    factorised: Operations,
}

impl<'a> Counts<'a> {
    /// Those of a derivation.
    #[must_use]
    pub fn of(derivation: &Derivation<'a>) -> Self {
        let by_number = derivation.groups.iter().filter(|group| group.method == GroupMethod::Factorization);
        let factorised = sum(by_number.map(|group| factorisation(group.unknowns.len())));
        Self { kernels: derivation.kernels, unknowns: derivation.unknowns.len(), factorised }
    }

    /// The operations of a function.
    #[must_use]
    pub fn function(&self, name: &str) -> Operations {
        self.kernels.iter().find(|kernel| kernel.function == name).map_or_else(Operations::default, |of| of.operations)
    }

    fn solved(&self, function: &str) -> Operations {
        sum([self.function(function), self.factorised])
    }

    /// The rates up to this order at a pose.
    fn rates(&self, order: usize) -> Operations {
        sum(["velocity", "acceleration"].into_iter().take(order).map(|function| self.solved(function)))
    }

    /// The closed form, and rates up to this order.
    #[must_use]
    pub fn closed(&self, order: usize) -> Operations {
        sum([self.function("assemble"), self.rates(order)])
    }

    /// The closed form, and for each order a solution with so many operations.
    #[must_use]
    pub fn solved_by(&self, solution: Operations, order: usize) -> Operations {
        let solved = ["jacobian_inputs", "gamma"].into_iter().take(order);
        let solved = solved.map(|right| sum([self.function(right), solution]));
        sum([self.function("assemble"), sum(solved)])
    }

    /// The prediction by the velocity ratios, Newton steps, and the rates.
    #[must_use]
    pub fn newton(&self, steps: usize, order: usize) -> Operations {
        let function = |name| self.function(name);
        let predicted = sum([function("jacobian_inputs"), self.solved("solve_jacobian"), function("pose_at")]);
        let step = sum([function("residual"), self.solved("solve_jacobian"), function("pose_at")]);
        sum([predicted, sum(repeat_n(step, steps)), self.rates(order)])
    }

    /// A cubic for each unknown, and the rates.
    #[must_use]
    pub fn table(&self, order: usize) -> Operations {
        let unknowns = self.unknowns;
        let cubics = Operations { functions: 0, divisions: 0, multiplications: 6 * unknowns, additions: 9 * unknowns };
        sum([cubics, self.function("pose_at"), self.rates(order)])
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

pub(super) fn sum(all: impl IntoIterator<Item = Operations>) -> Operations {
    all.into_iter().fold(Operations::default(), |sum, one| Operations {
        functions: sum.functions + one.functions,
        divisions: sum.divisions + one.divisions,
        multiplications: sum.multiplications + one.multiplications,
        additions: sum.additions + one.additions,
    })
}
