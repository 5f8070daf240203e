//! Fractions whose denominators stay factored.
//!
//! Sums over one denominator then add numerators only, and a power of a denominator is an exponent. Units are taken out
//! of factors, so that b - a and a - b are one factor.

use std::collections::BTreeMap;

use crate::polynomial::{Polynomial, Ring};
use crate::ratio::Ratio;
use crate::{Outcome, Reason};

/// factor^exponent; each factor has at least two terms and is free of units.
pub(super) type Denominator = BTreeMap<Polynomial, u32>;

/// numerator / denominator, not necessarily in lowest terms.
#[derive(Debug, Clone, Default)]
pub(super) struct Fraction {
    pub(super) numerator: Polynomial,
    pub(super) denominator: Denominator,
}

impl From<Polynomial> for Fraction {
    fn from(numerator: Polynomial) -> Self {
        Self { numerator, denominator: Denominator::new() }
    }
}

impl Fraction {
    /// The sum of coefficient * fraction: numerators over one denominator first, then over the least common multiple of
    /// the factored denominators.
    pub(super) fn sum<'a>(ring: &Ring, items: impl IntoIterator<Item = (Polynomial, &'a Self)>) -> Outcome<Self> {
        let mut numerators: BTreeMap<&Denominator, Polynomial> = BTreeMap::new();
        for (coefficient, fraction) in items {
            let numerator = ring.multiply(&coefficient, &fraction.numerator)?;
            ring.accumulate(numerators.entry(&fraction.denominator).or_default(), &numerator)?;
        }
        numerators.retain(|_, numerator| !numerator.is_zero());
        let mut denominator = Denominator::new();
        for (factor, &exponent) in numerators.keys().copied().flatten() {
            let entry = denominator.entry(factor.clone()).or_insert(0);
            *entry = exponent.max(*entry);
        }
        let mut sum = Polynomial::default();
        for (own, mut numerator) in numerators {
            for (factor, exponent) in &denominator {
                let missing = exponent - own.get(factor).copied().unwrap_or(0);
                numerator = ring.multiply(&numerator, &ring.power(factor, missing)?)?;
            }
            ring.accumulate(&mut sum, &numerator)?;
        }
        Self { numerator: sum, denominator }.reduce(ring)
    }

    /// coefficient * product of base^exponent.
    pub(super) fn product<'a>(
        ring: &Ring,
        coefficient: Polynomial,
        factors: impl IntoIterator<Item = (&'a Self, i32)>,
    ) -> Outcome<Self> {
        let mut product = Self::from(coefficient);
        // The factors of the numerator, multiplied out only when the whole denominator is known.
        let mut above: Denominator = Denominator::new();
        for (base, exponent) in factors {
            let times = exponent.unsigned_abs();
            if base.numerator.is_zero() {
                if exponent < 0 {
                    return Err(Reason::Undefined.into());
                }
                return Ok(Self::default());
            }
            if exponent > 0 && base.denominator.is_empty() && base.numerator.is_unit() {
                product.numerator = ring.multiply(&product.numerator, &ring.power(&base.numerator, times)?)?;
                continue;
            }
            let split = ring.split(&base.numerator)?;
            let unit = if exponent > 0 { split.unit } else { split.inverse };
            product.numerator = ring.multiply(&product.numerator, &ring.power(&unit, times)?)?;
            let (ours, theirs) = if exponent > 0 {
                (&mut above, &mut product.denominator)
            } else {
                (&mut product.denominator, &mut above)
            };
            if !split.factor.is_one() {
                raise(ours, &split.factor, times)?;
            }
            for (factor, &inner) in &base.denominator {
                raise(theirs, factor, inner.checked_mul(times).ok_or(Reason::TooLarge)?)?;
            }
        }
        for (factor, mut exponent) in above {
            if let Some(below) = product.denominator.get_mut(&factor) {
                let shared = exponent.min(*below);
                (exponent, *below) = (exponent - shared, *below - shared);
            }
            product.numerator = ring.multiply(&product.numerator, &ring.power(&factor, exponent)?)?;
        }
        product.denominator.retain(|_, exponent| *exponent > 0);
        product.reduce(ring)
    }

    /// Divides factors of the denominator out of the numerator.
    fn reduce(mut self, ring: &Ring) -> Outcome<Self> {
        if self.numerator.is_zero() {
            return Ok(Self::default());
        }
        for (factor, exponent) in &mut self.denominator {
            while *exponent > 0
                && let Some(quotient) = ring.divide(&self.numerator, factor)?
            {
                self.numerator = quotient;
                *exponent -= 1;
            }
        }
        self.denominator.retain(|_, exponent| *exponent > 0);
        Ok(self)
    }

    /// self - other.
    pub(super) fn minus(&self, ring: &Ring, other: &Self) -> Outcome<Self> {
        let signs = [Ratio::ONE, Ratio::integer(-1)].map(Polynomial::constant);
        Self::sum(ring, signs.into_iter().zip([self, other]))
    }
}

fn raise(denominator: &mut Denominator, factor: &Polynomial, by: u32) -> Outcome<()> {
    let entry = denominator.entry(factor.clone()).or_insert(0);
    *entry = entry.checked_add(by).ok_or(Reason::TooLarge)?;
    Ok(())
}
