//! Products of powers, and sums of their magnitudes.

use super::angle::{AngleId, Angles};
use crate::graph::{LARGEST_EXPONENT, SymbolId};

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Factor {
    Symbol(SymbolId),
    Sine(AngleId),
    Cosine(AngleId),
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Monomial {
    pub(super) coefficient: f64,
    /// Ascending, no exponent zero.
    pub(super) factors: Vec<(Factor, i32)>,
}

/// Two products of a sine and a cosine each, as in an addition theorem.
pub(super) enum Pair {
    /// sin a cos b and cos a sin b.
    Mixed([AngleId; 2]),
    /// cos a cos b and sin a sin b, with true if the sines come first.
    Alike([AngleId; 2], bool),
}

impl Monomial {
    pub(super) fn number(coefficient: f64) -> Self {
        Self { coefficient, factors: Vec::new() }
    }

    pub(super) fn of(factor: Factor) -> Self {
        Self { coefficient: 1.0, factors: vec![(factor, 1)] }
    }

    /// This times a power of a factor.
    pub(super) fn multiply(&mut self, factor: Factor, exponent: i32) {
        if exponent == 0 {
            return;
        }
        match self.factors.binary_search_by_key(&factor, |(other, _)| *other) {
            Ok(index) => {
                self.factors[index].1 = self.factors[index].1.saturating_add(exponent);
                if self.factors[index].1 == 0 {
                    self.factors.remove(index);
                }
            }
            Err(index) => self.factors.insert(index, (factor, exponent)),
        }
    }

    pub(super) fn times(mut self, other: &Self) -> Self {
        self.coefficient *= other.coefficient;
        other.factors.iter().for_each(|&(factor, exponent)| self.multiply(factor, exponent));
        self
    }

    pub(super) fn inverse(mut self) -> Self {
        self.coefficient = 1.0 / self.coefficient;
        self.factors.iter_mut().for_each(|(_, exponent)| *exponent = exponent.saturating_neg());
        self
    }

    /// The sine or cosine that this is.
    pub(super) fn only_factor(&self) -> Option<Factor> {
        self.factors.first().map(|(factor, _)| *factor)
    }

    /// True if no exponent is beyond those of formulas: those of a product of two such are in the range of `i32`.
    pub(super) fn is_moderate(&self) -> bool {
        self.factors.iter().all(|(_, exponent)| exponent.unsigned_abs() <= LARGEST_EXPONENT.unsigned_abs())
    }

    pub(super) fn magnitude(mut self) -> Self {
        self.coefficient = self.coefficient.abs();
        self
    }

    pub(super) fn exponent(&self, factor: Factor) -> i32 {
        self.factors.iter().find(|(other, _)| *other == factor).map_or(0, |(_, exponent)| *exponent)
    }

    /// The common factors of two products that belong to one addition theorem, with coefficient 1.
    pub(super) fn pair(&self, other: &Self) -> Option<(Self, Pair)> {
        let mut rest = self.clone().times(&other.clone().inverse());
        rest.coefficient = 1.0;
        // (sin a cos b) / (cos a sin b), or (cos a cos b) / (sin a sin b).
        let mut angles: Vec<(AngleId, i32)> = Vec::new();
        for &(factor, exponent) in &rest.factors {
            if let Factor::Sine(angle) = factor {
                angles.push((angle, exponent));
            }
        }
        let (quotient, pair) = match *angles.as_slice() {
            [(a, 1), (b, -1)] => ([(a, 1), (b, -1)], Pair::Mixed([a, b])),
            [(b, -1), (a, 1)] => ([(a, 1), (b, -1)], Pair::Mixed([a, b])),
            [(a, 1), (b, 1)] => ([(a, 1), (b, 1)], Pair::Alike([a, b], true)),
            [(a, -1), (b, -1)] => ([(a, -1), (b, -1)], Pair::Alike([a, b], false)),
            [(a, 2)] => ([(a, 2), (a, 0)], Pair::Alike([a, a], true)),
            [(a, -2)] => ([(a, -2), (a, 0)], Pair::Alike([a, a], false)),
            _ => return None,
        };
        for (angle, exponent) in quotient {
            rest.multiply(Factor::Sine(angle), -exponent);
            rest.multiply(Factor::Cosine(angle), exponent);
        }
        if !rest.factors.is_empty() {
            return None;
        }
        let mut common = Self { coefficient: 1.0, ..self.clone() };
        for (angle, exponent) in quotient {
            let factor = if exponent > 0 { Factor::Sine(angle) } else { Factor::Cosine(angle) };
            if exponent != 0 {
                common.multiply(factor, -exponent.abs());
            }
        }
        // A factor below a fraction is none of a sine in it.
        let was_above = |(factor, exponent): &(Factor, i32)| *exponent >= 0 || self.exponent(*factor) < 0;
        common.factors.iter().all(was_above).then_some((common, pair))
    }
}

/// A sum of magnitudes of products.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Size(pub(super) Vec<Monomial>);

/// The most terms of a size: a law of more terms tells a reader nothing.
const MOST_TERMS: usize = 24;

impl Size {
    pub(super) fn of(monomial: Monomial) -> Self {
        Self(vec![monomial.magnitude()])
    }

    pub(super) fn times(&self, other: &Self) -> Option<Self> {
        if self.0.len() * other.0.len() > MOST_TERMS {
            return None;
        }
        let products = self.0.iter().flat_map(|a| other.0.iter().map(|b| a.clone().times(b)));
        Self::sum(products)
    }

    pub(super) fn over(&self, divisor: &Monomial) -> Self {
        let inverse = divisor.clone().inverse().magnitude();
        Self(self.0.iter().map(|one| one.clone().times(&inverse)).collect())
    }

    /// The sum, shorter by |sin a cos b| + |cos a sin b| <= 1 and |cos a cos b| + |sin a sin b| <= 1.
    pub(super) fn sum(terms: impl IntoIterator<Item = Monomial>) -> Option<Self> {
        let mut all: Vec<Monomial> = Vec::new();
        for mut term in terms {
            loop {
                let with = all.iter().position(|other| {
                    other.factors == term.factors
                        || other.coefficient == term.coefficient && other.pair(&term).is_some()
                });
                let Some(index) = with else { break };
                let other = all.swap_remove(index);
                if other.factors == term.factors {
                    term.coefficient += other.coefficient;
                } else if let Some((common, _)) = other.pair(&term) {
                    term = Monomial { coefficient: term.coefficient, ..common };
                }
            }
            all.push(term);
            if all.len() > MOST_TERMS {
                return None;
            }
        }
        all.sort_by(|a, b| a.factors.cmp(&b.factors));
        Some(Self(all))
    }

    /// The size without one sine, which is at most 1, if each term has it.
    pub(super) fn without(&self, factor: Factor) -> Option<Self> {
        if self.0.iter().any(|one| one.exponent(factor) < 1) {
            return None;
        }
        let mut shorter = self.clone();
        shorter.0.iter_mut().for_each(|one| one.multiply(factor, -1));
        Some(shorter)
    }

    /// The size for a reader: sines and cosines in numerators are at most 1.
    pub(super) fn simplified(&self) -> Option<Self> {
        let is_kept = |(factor, exponent): &(Factor, i32)| matches!(factor, Factor::Symbol(_)) || *exponent < 0;
        let terms = self.0.iter().map(|one| {
            let factors = one.factors.iter().copied().filter(is_kept).collect();
            Monomial { coefficient: one.coefficient, factors }
        });
        Self::sum(terms)
    }
}

/// A sine or cosine with the sign of its angle.
pub(super) fn circular(is_sine: bool, (angle, is_negative): (AngleId, bool)) -> Monomial {
    let factor = if is_sine { Factor::Sine(angle) } else { Factor::Cosine(angle) };
    let coefficient = if is_sine && is_negative { -1.0 } else { 1.0 };
    Monomial { coefficient, factors: vec![(factor, 1)] }
}

/// The addition theorem for two products with their signs: their common factor with its sign, and the sine or cosine;
/// `None` if they belong to none.
pub(super) fn addition_theorem(angles: &mut Angles, [one, other]: [&Monomial; 2]) -> Option<[Monomial; 2]> {
    if one.coefficient.abs() != other.coefficient.abs() {
        return None;
    }
    let (common, pair) = one.pair(other)?;
    let is_same_sign = one.coefficient.signum() == other.coefficient.signum();
    let (is_sine, angle, sign) = match pair {
        // sin a cos b +- cos a sin b = sin(a +- b)
        Pair::Mixed(of) => (true, angles.combined(of, !is_same_sign)?, 1.0),
        // cos a cos b -+ sin a sin b = cos(a +- b)
        Pair::Alike(of, has_sines_first) => {
            let sign = if has_sines_first && !is_same_sign { -1.0 } else { 1.0 };
            (false, angles.combined(of, is_same_sign)?, sign)
        }
    };
    let common = Monomial { coefficient: sign * one.coefficient, ..common };
    Some([common, circular(is_sine, angle)])
}
