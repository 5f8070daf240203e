//! Arguments: ordinary numbers, extreme ones, and mixtures.

use std::marker::PhantomData;

use linkage::nalgebra::{Complex, SMatrix, Unit, UnitComplex};
use linkage::{AssemblyMode, Column, Dim, Elbow, Matrix, Slider, Slope};
use rand::{Rng, RngCore};

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
        Self { random, seed, extreme, sized, length, scale }
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

    pub fn number(&mut self) -> f64 {
        let ordinary = self.random.random_range(-3.2..3.2);
        self.about(self.scale, ordinary)
    }

    /// A parameter with a default.
    pub fn parameter(&mut self, default: f64) -> f64 {
        let ordinary =
            if self.random.random_bool(0.5) { default } else { default * self.random.random_range(0.5..1.5) };
        self.about(self.length, ordinary)
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

/// Turns of an angle.
impl Draw for i32 {
    fn draw(source: &mut Source) -> Self {
        match source.below(16) {
            0 => i32::MAX,
            1 => i32::MIN,
            other => i32::try_from(other).unwrap_or_default() / 4 - 2,
        }
    }
}

/// Usually a direction.
impl Draw for UnitComplex<f64> {
    fn draw(source: &mut Source) -> Self {
        if source.below(8) == 0 {
            Unit::new_unchecked(Complex { re: source.number(), im: source.number() })
        } else {
            Self::new(source.number())
        }
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

impl<T> Draw for PhantomData<T> {
    fn draw(_: &mut Source) -> Self {
        Self
    }
}

macro_rules! draw_choices {
    ($($name:ident $one:ident $other:ident)*) => {$(
        impl Draw for $name {
            fn draw(source: &mut Source) -> Self {
                if source.below(2) == 0 { Self::$one } else { Self::$other }
            }
        }
    )*};
}
draw_choices! { Elbow Left Right Slider Near Far Slope Rising Falling }

/// Usually a number, of which not all exist.
impl Draw for AssemblyMode {
    fn draw(source: &mut Source) -> Self {
        match source.below(8) {
            0 => Self::OfGuess,
            1 => Self::Number(usize::MAX),
            _ => Self::Number(source.below(8)),
        }
    }
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

impl<Q: Draw + Copy> Pool<Q> {
    pub fn keep(&mut self, q: Q) {
        if self.0.len() < MOST {
            self.0.push(q);
        }
    }

    /// A kept value, or a new one.
    pub fn take(&mut self, source: &mut Source) -> Q {
        if self.0.is_empty() || source.below(5) == 0 { Q::draw(source) } else { self.0[source.below(self.0.len())] }
    }
}
