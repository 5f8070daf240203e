//! Arguments: ordinary numbers, extreme ones, and mixtures.

use std::collections::BTreeMap;

use linkage::nalgebra::{Complex, SMatrix, Unit, UnitComplex};
use linkage::{Column, Dim, Matrix, Mechanism, PerInput, PerUnknown};
use rand::{Rng, RngCore};

use crate::called::{Kind, Numbers};

/// Numbers at the ends of the range, beyond it, and where squares and products overflow or underflow.
const EXTREME: [f64; 24] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE,
    5e-324,
    -5e-324,
    // 2^-540, 2^540
    2.7785e-163,
    3.5991e162,
    1e-160,
    1e-154,
    1e154,
    1e155,
    -1e155,
    1e300,
    -1e308,
    1e16,
    -1e5,
    1.0,
    -1.0,
];

/// The source of the numbers of one trial.
pub struct Source {
    random: Box<dyn RngCore>,
    /// The name of the trial.
    pub seed: u64,
    /// The share of extreme numbers, and of numbers of any size.
    extreme: f64,
    sized: f64,
    /// The size of ordinary lengths and of other ordinary numbers.
    length: f64,
    scale: f64,
    /// The parameters of the mechanism of the trial, and those that were given to the present call.
    parameters: Vec<f64>,
    given: usize,
    /// Results that become arguments, and the numbers that come next of one of them.
    results: BTreeMap<Kind, Pool<Vec<f64>>>,
    next: Vec<f64>,
}

impl Source {
    pub fn new(mut random: Box<dyn RngCore>, seed: u64) -> Self {
        let power = |random: &mut dyn RngCore| 2_f64.powi(random.random_range(-540..=540));
        let [mut extreme, mut sized, mut length, mut scale] = [0.0, 0.0, 1.0, 1.0];
        match random.random_range(0..8) {
            // Ordinary mechanisms, of which some are scaled.
            0 => {}
            1 => length = power(&mut random),
            // One or two numbers are bad.
            2..=4 => extreme = random.random_range(0.0..0.1),
            5 => sized = random.random_range(0.0..0.2),
            6 => (extreme, sized, length, scale) = (0.05, 0.05, power(&mut random), power(&mut random)),
            // All numbers are bad.
            _ => [extreme, sized] = [0, 1].map(|_| random.random_range(0.0..1.0)),
        }
        let (parameters, results, next) = (Vec::new(), BTreeMap::new(), Vec::new());
        Self { random, seed, extreme, sized, length, scale, parameters, given: 0, results, next }
    }

    /// Begins a call of a function of the same mechanism.
    pub fn begin_call(&mut self) {
        (self.given, self.next) = (0, Vec::new());
    }

    /// A number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.random.random_range(0..count)
    }

    /// A number that is usually of this size.
    fn about(&mut self, size: f64, ordinary: f64) -> f64 {
        if self.random.random_bool(self.extreme) {
            EXTREME[self.below(EXTREME.len())]
        } else if self.random.random_bool(self.sized) {
            self.random.random_range(-2.0..2.0) * 2_f64.powi(self.random.random_range(-1070..=1020))
        } else {
            ordinary * size
        }
    }

    /// A new number.
    pub fn number(&mut self) -> f64 {
        let ordinary = self.random.random_range(-3.2..3.2);
        self.about(self.scale, ordinary)
    }
}

impl Numbers for Source {
    fn number(&mut self) -> f64 {
        self.next.pop().unwrap_or_else(|| Source::number(self))
    }

    /// A parameter is the same in all calls of a trial.
    fn parameter(&mut self, usual: f64) -> f64 {
        if self.given == self.parameters.len() {
            let ordinary = if usual.is_nan() {
                self.random.random_range(-3.2..3.2)
            } else if self.random.random_bool(0.5) {
                usual
            } else {
                usual * self.random.random_range(0.5..1.5)
            };
            let size = if usual.is_nan() { self.scale } else { self.length };
            let parameter = self.about(size, ordinary);
            self.parameters.push(parameter);
        }
        self.given += 1;
        self.parameters[self.given - 1]
    }

    fn side(&mut self) -> bool {
        self.below(2) == 1
    }

    /// Usually a number, of which not all exist.
    fn position(&mut self) -> Option<usize> {
        match self.below(8) {
            0 => None,
            1 => Some(usize::MAX),
            _ => Some(self.below(8)),
        }
    }

    fn turns(&mut self) -> i32 {
        match self.below(16) {
            0 => i32::MAX,
            1 => i32::MIN,
            other => i32::try_from(other).unwrap_or_default() / 4 - 2,
        }
    }

    fn begin(&mut self, kind: Kind) {
        // New numbers are drawn one by one.
        let kept = self.results.remove(&kind).unwrap_or_default();
        self.next = kept.take(self, |_| Vec::new());
        self.next.reverse();
        self.results.insert(kind, kept);
    }

    fn keep(&mut self, kind: Kind, numbers: &[f64]) {
        if numbers.iter().all(|number| number.is_finite()) {
            self.results.entry(kind).or_default().keep(numbers.to_vec());
        }
    }

    /// One in five poses, as far as there are positions.
    fn is_any_pose(&mut self) -> bool {
        self.results.get(&Kind::Coordinates).is_none_or(Pool::is_empty) || self.below(5) == 0
    }

    /// Usually a direction.
    fn direction(&mut self) -> UnitComplex<f64> {
        if self.below(8) == 0 {
            Unit::new_unchecked(Complex { re: Source::number(self), im: Source::number(self) })
        } else {
            UnitComplex::new(Source::number(self))
        }
    }
}

/// A type that can be an argument.
pub trait Draw {
    fn draw(source: &mut Source) -> Self;
}

impl Draw for f64 {
    fn draw(source: &mut Source) -> Self {
        source.number()
    }
}

impl<const R: usize, const C: usize> Draw for SMatrix<f64, R, C> {
    fn draw(source: &mut Source) -> Self {
        Self::from_fn(|_, _| source.number())
    }
}

impl<const N: usize> Draw for [f64; N] {
    fn draw(source: &mut Source) -> Self {
        std::array::from_fn(|_| source.number())
    }
}

impl<R: Dim + Default> Draw for Column<f64, R> {
    fn draw(source: &mut Source) -> Self {
        Self::from_fn(|_| source.number())
    }
}

impl<R: Dim + Default, C: Dim + Default> Draw for Matrix<f64, R, C> {
    fn draw(source: &mut Source) -> Self {
        Self::from_fn(|_, _| source.number())
    }
}

/// Coordinates of a mechanism.
pub fn coordinates<M: Mechanism<Scalar = f64, U: Default, V: Default>>(source: &mut Source) -> M::Coordinates {
    M::coordinates(PerUnknown::<M>::draw(source), PerInput::<M>::draw(source))
}

/// Rates of a mechanism.
pub fn rates<M: Mechanism<Scalar = f64, U: Default, V: Default>>(source: &mut Source) -> M::Rates {
    M::rates(PerUnknown::<M>::draw(source), PerInput::<M>::draw(source))
}

/// Results that become arguments.
pub struct Pool<Q>(Vec<Q>);

impl<Q> Default for Pool<Q> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

/// The capacity of a pool.
const MOST: usize = 6;

impl<Q: Clone> Pool<Q> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn keep(&mut self, q: Q) {
        if self.0.len() < MOST {
            self.0.push(q);
        }
    }

    /// A kept value, or a new one.
    pub fn take(&self, source: &mut Source, new: impl FnOnce(&mut Source) -> Q) -> Q {
        if self.0.is_empty() || source.below(5) == 0 { new(source) } else { self.0[source.below(self.0.len())].clone() }
    }
}
