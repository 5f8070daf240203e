//! Decides whether a difference that is not zero formally is zero in value.
//!
//! Functions of the symbols are always independent (Ax). For constants this is known only in part: for pi alone
//! (Lindemann), or for exponentials of algebraic numbers alone (Lindemann and Weierstrass). A coefficient that contains
//! both is not zero if its numerical value is larger than rounding errors explain.

use std::collections::BTreeMap;

use crate::constants::{Complex, Constant};
use crate::fraction::Fraction;
use crate::normal_form::NormalForms;
use crate::polynomial::{Polynomial, Powers};
use crate::{Answer, Reason};

/// A sum of terms is not zero if it exceeds this part of the sum of their magnitudes: rounding errors are many orders
/// of magnitude smaller.
const MARGIN: f64 = 1e-6;

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
