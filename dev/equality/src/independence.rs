//! Decides whether a difference that is not zero formally is zero in value.
//!
//! Functions of the symbols are always independent (Ax). For constants this is known only in part: for pi alone
//! (Lindemann), or for exponentials of algebraic numbers alone (Lindemann and Weierstrass). A coefficient that contains
//! both is not zero if its numerical value is larger than rounding errors explain.

use std::collections::BTreeMap;

use crate::fraction::Fraction;
use crate::normal_form::NormalForms;
use crate::polynomial::{Polynomial, Powers};
use crate::{Answer, Reason};

/// A sum of terms is not zero if it exceeds this part of the sum of their magnitudes: rounding errors are many orders
/// of magnitude smaller.
const MARGIN: f64 = 1e-6;

/// Exponents of e up to this magnitude keep the digits that [`MARGIN`] relies on.
const LARGEST_EXPONENT: f64 = 1e3;

/// A variable that depends on no symbol.
pub(super) enum Constant {
    Pi,
    /// e^exponent.
    Exponential {
        exponent: Complex,
        algebraic: bool,
    },
}

impl Constant {
    pub(super) fn power(&self, exponent: f64) -> Complex {
        match self {
            Self::Pi => Complex { re: std::f64::consts::PI.powf(exponent), im: 0.0 },
            Self::Exponential { exponent: inner, .. } => inner.times(Complex { re: exponent, im: 0.0 }).exponential(),
        }
    }
}

/// A complex number in floats.
#[derive(Clone, Copy)]
pub(super) struct Complex {
    re: f64,
    im: f64,
}

impl Complex {
    pub(super) const ONE: Self = Self { re: 1.0, im: 0.0 };
    pub(super) const I: Self = Self { re: 0.0, im: 1.0 };

    /// exp(2 pi i power / order).
    pub(super) fn root(power: u32, order: u32) -> Self {
        let (im, re) = (std::f64::consts::TAU * f64::from(power) / f64::from(order)).sin_cos();
        Self { re, im }
    }

    pub(super) fn times(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }

    fn exponential(self) -> Self {
        if self.re.abs().max(self.im.abs()) > LARGEST_EXPONENT {
            return Self { re: f64::NAN, im: f64::NAN };
        }
        let (sine, cosine) = self.im.sin_cos();
        Self { re: self.re.exp() * cosine, im: self.re.exp() * sine }
    }
}

/// Decides if a fraction is zero.
pub(super) fn answer(forms: &NormalForms, difference: &Fraction) -> Answer {
    if difference.numerator.is_zero() {
        return Answer::Equal;
    }
    let parts = difference.denominator.keys().chain([&difference.numerator]);
    match parts.clone().find_map(|part| part.terms().find_map(|(monomial, _)| forms.outside(&monomial.powers))) {
        Some(reason) => Answer::Undecided(reason),
        None if parts.clone().all(|part| is_nonzero(forms, part)) => Answer::Different,
        None => Answer::Undecided(Reason::Constants),
    }
}

/// True if a polynomial with terms is certainly not zero: one of its coefficients, as a polynomial in functions of the
/// symbols, is not.
fn is_nonzero(forms: &NormalForms, polynomial: &Polynomial) -> bool {
    let mut coefficients: BTreeMap<Powers, Coefficient> = BTreeMap::new();
    for (monomial, factor) in polynomial.terms() {
        let (constants, functions) =
            monomial.powers.partition(|variable| forms.variables[variable as usize].constant.is_some());
        let coefficient = coefficients.entry(functions).or_default();
        for (variable, _) in constants.iter() {
            match forms.variables[variable as usize].constant {
                Some(Constant::Pi) => coefficient.pi = true,
                Some(Constant::Exponential { algebraic: true, .. }) => coefficient.exponential = true,
                _ => coefficient.unknown = true,
            }
        }
        let root = Complex::root(monomial.root, forms.ring.roots.order());
        if let Some(value) = forms.constant_value(&constants) {
            let Complex { re, im } = value.times(root);
            let factor = factor.to_f64();
            coefficient.re += factor * re;
            coefficient.im += factor * im;
            coefficient.size += (factor * re).abs() + (factor * im).abs();
        }
    }
    coefficients.values().any(Coefficient::is_nonzero)
}

/// The sum of terms that differ by constants only: the kinds of constants, and the numerical value.
#[derive(Default)]
struct Coefficient {
    pi: bool,
    exponential: bool,
    unknown: bool,
    re: f64,
    im: f64,
    size: f64,
}

impl Coefficient {
    fn is_nonzero(&self) -> bool {
        let mixed = self.pi && self.exponential;
        !(self.unknown || mixed) || self.re.abs() + self.im.abs() > MARGIN * self.size
    }
}
