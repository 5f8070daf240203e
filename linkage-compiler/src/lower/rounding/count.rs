//! Relative errors in units of 2^-53: a number, and multiples of quantities that can be large.

use super::angle::AngleId;

/// A quantity of an angle x.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Amplifier {
    /// |x cot x|: a rounded x in a sine.
    Cotangent,
    /// |x tan x|: a rounded x in a cosine.
    Tangent,
    /// |x|: a rounded x in a term of a sum.
    Size,
    /// 1/|sin x|: a sine by the addition theorem.
    Cosecant,
    /// 1/|cos x|: a cosine by the addition theorem.
    Secant,
}

/// A number of rounding errors.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Count {
    pub(super) constant: f64,
    /// Ascending.
    pub(super) amplified: Vec<(Amplifier, AngleId, f64)>,
}

impl Count {
    pub(super) fn of(constant: f64) -> Self {
        Self { constant, amplified: Vec::new() }
    }

    pub(super) fn with(mut self, amplifier: Amplifier, angle: AngleId, factor: f64) -> Self {
        if factor != 0.0 {
            self.insert(amplifier, angle, factor, |a, b| a + b);
        }
        self
    }

    fn insert(&mut self, amplifier: Amplifier, angle: AngleId, factor: f64, join: fn(f64, f64) -> f64) {
        match self.amplified.binary_search_by_key(&(amplifier, angle), |(kind, of, _)| (*kind, *of)) {
            Ok(index) => self.amplified[index].2 = join(self.amplified[index].2, factor),
            Err(index) => self.amplified.insert(index, (amplifier, angle, factor)),
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.constant == 0.0 && self.amplified.is_empty()
    }

    pub(super) fn plus(mut self, other: &Self) -> Self {
        self.constant += other.constant;
        other.amplified.iter().for_each(|&(kind, of, factor)| self.insert(kind, of, factor, |a, b| a + b));
        self
    }

    /// A count that is at least each of two.
    pub(super) fn most(mut self, other: &Self) -> Self {
        self.constant = self.constant.max(other.constant);
        other.amplified.iter().for_each(|&(kind, of, factor)| self.insert(kind, of, factor, f64::max));
        self
    }

    pub(super) fn times(mut self, factor: f64) -> Self {
        self.constant *= factor;
        self.amplified.iter_mut().for_each(|(.., of)| *of *= factor);
        self
    }
}
