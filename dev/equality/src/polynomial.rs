//! Laurent polynomials with rational exponents over the rationals and a root of unity.
//!
//! A term is coefficient * zeta^root * product of variable^exponent with `root` below phi(N): the powers of zeta form a
//! basis, so a polynomial is zero iff it has no term. Exponents of exponentials are fractions, exp(i x / 2) being the
//! square root of exp(i x); those of symbols are integers.

use std::cell::Cell;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use linkage_compiler::budget::Budget;

use crate::cyclotomic::Cyclotomic;
use crate::ratio::Ratio;
use crate::{MOST_TERMS, Outcome, Reason};

/// An element with more conjugates than this is not inverted.
const MOST_CONJUGATES: usize = 16;

/// The number of a variable.
pub(super) type Index = u32;

/// A product of powers of variables: variables ascend, no exponent is zero.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Powers(Vec<(Index, Ratio)>);

impl Powers {
    pub(super) fn one(variable: Index, exponent: Ratio) -> Self {
        Self(if exponent.is_zero() { Vec::new() } else { vec![(variable, exponent)] })
    }

    pub(super) fn is_one(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (Index, Ratio)> {
        self.0.iter().copied()
    }

    pub(super) fn times(&self, other: &Self) -> Outcome<Self> {
        self.merge(other, Ratio::plus)
    }

    fn lowest(&self, other: &Self) -> Outcome<Self> {
        self.merge(other, |a, b| Ok(a.min(b)))
    }

    /// The exponents combined one by one; a missing one is zero.
    fn merge(&self, other: &Self, combine: fn(Ratio, Ratio) -> Outcome<Ratio>) -> Outcome<Self> {
        let (mut ours, mut theirs) = (self.0.iter().copied().peekable(), other.0.iter().copied().peekable());
        let mut result = Vec::with_capacity(self.0.len() + other.0.len());
        loop {
            let order = match (ours.peek(), theirs.peek()) {
                (None, None) => return Ok(Self(result)),
                (Some(_), None) => Ordering::Less,
                (None, Some(_)) => Ordering::Greater,
                (Some((a, _)), Some((b, _))) => a.cmp(b),
            };
            let left = if order.is_le() { ours.next() } else { None };
            let right = if order.is_ge() { theirs.next() } else { None };
            let exponent = |side: Option<(Index, Ratio)>| side.map_or(Ratio::ZERO, |(_, exponent)| exponent);
            let combined = combine(exponent(left), exponent(right))?;
            if let (Some((variable, _)), false) = (left.or(right), combined.is_zero()) {
                result.push((variable, combined));
            }
        }
    }

    pub(super) fn scale(&self, factor: Ratio) -> Outcome<Self> {
        if factor.is_zero() {
            return Ok(Self::default());
        }
        let scaled: Outcome<Vec<_>> = self.iter().map(|(variable, e)| Ok((variable, e.times(factor)?))).collect();
        Ok(Self(scaled?))
    }

    pub(super) fn inverse(&self) -> Outcome<Self> {
        self.scale(Ratio::integer(-1))
    }

    /// Splits into the powers of the wanted variables and the others.
    pub(super) fn partition(&self, wanted: impl Fn(Index) -> bool) -> (Self, Self) {
        let (ours, theirs) = self.iter().partition(|(variable, _)| wanted(*variable));
        (Self(ours), Self(theirs))
    }

    fn is_nonnegative(&self) -> bool {
        self.0.iter().all(|(_, exponent)| *exponent > Ratio::ZERO)
    }
}

// Lexicographic by exponent, a missing one being zero: an order that multiplication keeps.
impl Ord for Powers {
    fn cmp(&self, other: &Self) -> Ordering {
        let mut position = 0;
        loop {
            match (self.0.get(position), other.0.get(position)) {
                (None, None) => return Ordering::Equal,
                (Some((_, e)), None) => return e.cmp(&Ratio::ZERO),
                (None, Some((_, f))) => return Ratio::ZERO.cmp(f),
                (Some((a, e)), Some((b, f))) => {
                    let order = match a.cmp(b) {
                        Ordering::Less => e.cmp(&Ratio::ZERO),
                        Ordering::Greater => Ratio::ZERO.cmp(f),
                        Ordering::Equal => e.cmp(f),
                    };
                    if order.is_ne() {
                        return order;
                    }
                }
            }
            position += 1;
        }
    }
}

impl PartialOrd for Powers {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// zeta^root * powers.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Monomial {
    pub(super) powers: Powers,
    pub(super) root: u32,
}

/// A sum of coefficient * monomial; no coefficient is zero.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Polynomial(BTreeMap<Monomial, Ratio>);

impl Polynomial {
    pub(super) fn constant(value: Ratio) -> Self {
        Self::term(Monomial::default(), value)
    }

    pub(super) fn one() -> Self {
        Self::constant(Ratio::ONE)
    }

    pub(super) fn variable(variable: Index) -> Self {
        Self::term(Monomial { powers: Powers::one(variable, Ratio::ONE), root: 0 }, Ratio::ONE)
    }

    /// The root of the monomial is below phi(N).
    fn term(monomial: Monomial, coefficient: Ratio) -> Self {
        Self(if coefficient.is_zero() { BTreeMap::new() } else { BTreeMap::from([(monomial, coefficient)]) })
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn is_one(&self) -> bool {
        self.0.len() == 1 && self.0.get(&Monomial::default()) == Some(&Ratio::ONE)
    }

    /// True if there is one power product only, times roots of unity.
    pub(super) fn is_unit(&self) -> bool {
        let mut powers = self.0.keys().map(|monomial| &monomial.powers);
        powers.next().is_some_and(|first| powers.all(|other| other == first))
    }

    pub(super) fn terms(&self) -> impl DoubleEndedIterator<Item = (&Monomial, Ratio)> {
        self.0.iter().map(|(monomial, coefficient)| (monomial, *coefficient))
    }

    fn add(&mut self, monomial: Monomial, coefficient: Ratio) -> Outcome<()> {
        if let Some(entry) = self.0.get_mut(&monomial) {
            *entry = entry.plus(coefficient)?;
            if entry.is_zero() {
                self.0.remove(&monomial);
            }
        } else if !coefficient.is_zero() {
            self.0.insert(monomial, coefficient);
        }
        Ok(())
    }

    /// The largest power product and its coefficient.
    fn leading(&self) -> (Powers, Self) {
        let Some((first, _)) = self.0.last_key_value() else { return (Powers::default(), Self::default()) };
        let terms = self.terms().rev().take_while(|(monomial, _)| monomial.powers == first.powers);
        let coefficient = terms.map(|(m, c)| (Monomial { powers: Powers::default(), root: m.root }, c)).collect();
        (first.powers.clone(), Self(coefficient))
    }

    /// The lowest exponent of each variable.
    fn content(&self) -> Outcome<Powers> {
        let mut powers = self.0.keys().map(|monomial| &monomial.powers);
        let first = powers.next().cloned().unwrap_or_default();
        powers.try_fold(first, |content, powers| content.lowest(powers))
    }

    fn shift(&self, by: &Powers) -> Outcome<Self> {
        let shifted: Outcome<_> = self
            .terms()
            .map(|(monomial, c)| Ok((Monomial { powers: monomial.powers.times(by)?, root: monomial.root }, c)))
            .collect();
        Ok(Self(shifted?))
    }
}

/// A polynomial = unit * factor; polynomials that differ by a unit only have the same factor.
pub(super) struct Split {
    pub(super) unit: Polynomial,
    /// 1 / unit.
    pub(super) inverse: Polynomial,
    /// Lowest exponents zero, leading coefficient 1.
    pub(super) factor: Polynomial,
}

/// The arithmetic: the roots of unity, and the remaining work.
pub(super) struct Ring {
    pub(super) roots: Cyclotomic,
    work: Cell<usize>,
    budget: Budget,
}

impl Ring {
    pub(super) fn new(order: u32, budget: &Budget) -> Self {
        Self { roots: Cyclotomic::new(order), work: Cell::new(MOST_TERMS), budget: budget.clone() }
    }

    fn spend(&self, terms: usize) -> Outcome<()> {
        match self.work.get().checked_sub(terms) {
            Some(left) if self.budget.spend(terms).is_ok() => {
                self.work.set(left);
                Ok(())
            }
            _ => {
                self.work.set(0);
                Err(Reason::TooManyTerms.into())
            }
        }
    }

    /// Adds coefficient * zeta^root * powers.
    fn deposit(&self, sum: &mut Polynomial, powers: &Powers, root: u32, coefficient: Ratio) -> Outcome<()> {
        let basis = self.roots.root(root);
        self.spend(basis.len())?;
        for &(root, factor) in basis {
            sum.add(Monomial { powers: powers.clone(), root }, coefficient.times(Ratio::integer(factor))?)?;
        }
        Ok(())
    }

    /// coefficient * zeta^root * powers.
    pub(super) fn monomial(&self, powers: &Powers, root: u32, coefficient: Ratio) -> Outcome<Polynomial> {
        let mut sum = Polynomial::default();
        self.deposit(&mut sum, powers, root, coefficient)?;
        Ok(sum)
    }

    /// sum += other.
    pub(super) fn accumulate(&self, sum: &mut Polynomial, other: &Polynomial) -> Outcome<()> {
        self.spend(other.0.len())?;
        other.terms().try_for_each(|(monomial, coefficient)| sum.add(monomial.clone(), coefficient))
    }

    pub(super) fn negate(&self, polynomial: &Polynomial) -> Outcome<Polynomial> {
        self.multiply(polynomial, &Polynomial::constant(Ratio::integer(-1)))
    }

    pub(super) fn multiply(&self, left: &Polynomial, right: &Polynomial) -> Outcome<Polynomial> {
        if left.is_one() {
            return Ok(right.clone());
        }
        if right.is_one() {
            return Ok(left.clone());
        }
        let mut product = Polynomial::default();
        for (one, ours) in left.terms() {
            for (other, theirs) in right.terms() {
                let powers = one.powers.times(&other.powers)?;
                self.deposit(&mut product, &powers, one.root + other.root, ours.times(theirs)?)?;
            }
        }
        Ok(product)
    }

    pub(super) fn power(&self, base: &Polynomial, exponent: u32) -> Outcome<Polynomial> {
        // A single term needs no loop: x^1000000 is no work.
        if let (1, Some((monomial, coefficient))) = (base.0.len(), base.terms().next()) {
            let powers = monomial.powers.scale(Ratio::integer(i128::from(exponent)))?;
            let root = u64::from(monomial.root) * u64::from(exponent) % u64::from(self.roots.order());
            return self.monomial(&powers, u32::try_from(root).unwrap_or(0), coefficient.power(exponent)?);
        }
        let mut product = Polynomial::one();
        for _ in 0..exponent {
            product = self.multiply(&product, base)?;
            // Zero and one cost no work, so that the limit of work would not end the loop.
            if product.is_zero() {
                break;
            }
        }
        Ok(product)
    }

    /// The polynomial, which is not zero, without its unit.
    pub(super) fn split(&self, polynomial: &Polynomial) -> Outcome<Split> {
        let content = polynomial.content()?;
        let (_, lead) = polynomial.leading();
        // If the leading coefficient is too hard to invert, its own leading coefficient is used.
        let (lead, inverse) = match self.invert(&lead) {
            Ok(inverse) => (lead, inverse),
            Err(_) => {
                let lead = lead.terms().next_back().map_or(Ratio::ONE, |(_, coefficient)| coefficient);
                (Polynomial::constant(lead), Polynomial::constant(lead.inverse()?))
            }
        };
        let unit = lead.shift(&content)?;
        let inverse = inverse.shift(&content.inverse()?)?;
        let factor = self.multiply(polynomial, &inverse)?;
        Ok(Split { unit, inverse, factor })
    }

    /// 1 / c of a combination of roots of unity: the product of the other conjugates over the norm.
    fn invert(&self, c: &Polynomial) -> Outcome<Polynomial> {
        let order = self.roots.order();
        if let (1, Some((monomial, coefficient))) = (c.0.len(), c.terms().next()) {
            return self.monomial(&Powers::default(), order - monomial.root, coefficient.inverse()?);
        }
        let mut conjugates = BTreeSet::new();
        // Conjugates send zeta to zeta^k, k prime to N.
        for k in (1..order).filter(|k| prime_to(*k, order)) {
            let mut conjugate = Polynomial::default();
            for (monomial, coefficient) in c.terms() {
                let root = u64::from(monomial.root) * u64::from(k) % u64::from(order);
                self.deposit(&mut conjugate, &Powers::default(), u32::try_from(root).unwrap_or(0), coefficient)?;
            }
            conjugates.insert(conjugate);
            if conjugates.len() > MOST_CONJUGATES {
                return Err(Reason::TooManyTerms.into());
            }
        }
        conjugates.remove(c);
        let cofactor =
            conjugates.iter().try_fold(Polynomial::one(), |product, factor| self.multiply(&product, factor))?;
        let norm = self.multiply(&cofactor, c)?;
        match norm.0.get(&Monomial::default()) {
            Some(norm) => self.multiply(&cofactor, &Polynomial::constant(norm.inverse()?)),
            None => Err(Reason::TooLarge.into()),
        }
    }

    /// dividend / factor, where that is a polynomial; the factor comes from [`Self::split`].
    pub(super) fn divide(&self, dividend: &Polynomial, factor: &Polynomial) -> Outcome<Option<Polynomial>> {
        let (top, lead) = factor.leading();
        if dividend.is_zero() || !lead.is_one() {
            return Ok(None);
        }
        self.spend(dividend.0.len())?;
        let content = dividend.content()?;
        let down = top.inverse()?;
        let mut rest = dividend.shift(&content.inverse()?)?;
        let mut quotient = Polynomial::default();
        let longest = rest.0.len();
        // Long division from the top; a power product below that of the factor is a remainder.
        while !rest.is_zero() {
            let (powers, lead) = rest.leading();
            let powers = powers.times(&down)?;
            if !powers.is_nonnegative() || quotient.0.len() > longest {
                return Ok(None);
            }
            let term = lead.shift(&powers)?;
            let taken = self.multiply(&self.negate(&term)?, factor)?;
            self.accumulate(&mut rest, &taken)?;
            self.accumulate(&mut quotient, &term)?;
        }
        Ok(Some(quotient.shift(&content)?))
    }
}

fn prime_to(mut a: u32, mut b: u32) -> bool {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a == 1
}
