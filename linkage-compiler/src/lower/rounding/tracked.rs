//! The rounding error of a value, and the rules of the operations.

use super::angle::{AngleId, Angles, is_power_of_two};
use super::count::{Amplifier, Count};
use super::monomial::{Factor, Monomial, Size, addition_theorem, circular};
use crate::graph::Number;

/// The relative error of a sine or a cosine of an angle up to 1e5, in units of 2^-53: `SINE_ERROR` of the runtime, which
/// is proved there.
const SINE: f64 = 1.29;

/// A value x with an error of at most (relative |x| + scattered size) 2^-53, to first order.
#[derive(Debug, Clone)]
pub(super) struct Tracked {
    /// The value, if it is a product of powers.
    pub(super) exact: Option<Monomial>,
    /// At least |x|.
    pub(super) size: Size,
    pub(super) relative: Count,
    pub(super) scattered: Count,
}

/// The most different angles in a count: a law of more tells a reader nothing.
const MOST_AMPLIFIERS: usize = 4;

impl Tracked {
    fn product_of(exact: Monomial, relative: Count) -> Self {
        Self { size: Size::of(exact.clone()), exact: Some(exact), relative, scattered: Count::default() }
    }

    /// An argument.
    pub(super) fn stored(factor: Factor) -> Self {
        Self::product_of(Monomial::of(factor), Count::default())
    }

    /// A ratio of integers: one rounding, unless it is a double.
    pub(super) fn constant(number: Number) -> Option<Self> {
        let Number::Ratio(numerator, denominator) = number else { return None };
        let is_double = denominator.unsigned_abs().is_power_of_two() && numerator.unsigned_abs() <= 1 << 53;
        let rounding = if is_double { 0.0 } else { 1.0 };
        Some(Self::product_of(Monomial::number(number.to_f64()), Count::of(rounding)))
    }

    /// A sine or cosine: its own error, and that of the angle x, of which |x cot x| or |x tan x| remain.
    pub(super) fn sine(angles: &Angles, is_sine: bool, angle: (AngleId, bool)) -> Option<Self> {
        let amplifier = if is_sine { Amplifier::Cotangent } else { Amplifier::Tangent };
        let relative = Count::of(SINE).with(amplifier, angle.0, angles.rounding(angle.0)?);
        Some(Self::product_of(circular(is_sine, angle), relative))
    }

    /// (1 + a)(1 + b)(1 + u) = 1 + a + b + u: relative errors add, one rounding for each product that is not exact.
    pub(super) fn product<'t>(factors: impl IntoIterator<Item = &'t Self>) -> Option<Self> {
        let mut factors = factors.into_iter();
        let mut whole = factors.next()?.clone();
        for factor in factors {
            let rounding = if whole.is_shift() || factor.is_shift() { 0.0 } else { 1.0 };
            whole.relative = whole.relative.plus(&factor.relative).plus(&Count::of(rounding));
            whole.scattered = whole.scattered.plus(&factor.scattered);
            whole.size = whole.size.times(&factor.size)?;
            whole.exact = whole.exact.zip(factor.exact.as_ref()).map(|(one, other)| one.times(other));
        }
        whole.readable()
    }

    pub(super) fn square(&self) -> Option<Self> {
        Self::product([self, self])
    }

    /// A quotient by a divisor with a relative bound.
    pub(super) fn over(&self, divisor: &Self) -> Option<Self> {
        let exact = divisor.exact.as_ref()?;
        if !divisor.scattered.is_zero() || exact.coefficient == 0.0 {
            return None;
        }
        let rounding = if divisor.is_shift() { 0.0 } else { 1.0 };
        let relative = self.relative.clone().plus(&divisor.relative).plus(&Count::of(rounding));
        let whole = Self {
            exact: self.exact.clone().map(|above| above.times(&exact.clone().inverse())),
            size: self.size.over(exact),
            relative,
            scattered: self.scattered.clone(),
        };
        whole.readable()
    }

    pub(super) fn magnitude(&self) -> Self {
        Self { exact: None, ..self.clone() }
    }

    pub(super) fn negative(mut self) -> Self {
        if let Some(exact) = &mut self.exact {
            exact.coefficient = -exact.coefficient;
        }
        self
    }

    /// t_1 + ... + t_n from left to right: the errors of the terms, n - 2 rounding errors of partial sums, each at most the
    /// sum of the sizes, and the last of the sum itself.
    pub(super) fn sum(angles: &mut Angles, terms: &[Self]) -> Option<Self> {
        let spread: Vec<(Size, Count)> = terms.iter().map(Self::spread).collect();
        let most = spread.iter().fold(Count::default(), |most, (_, count)| most.most(count));
        let scattered = most.plus(&Count::of(terms.len().saturating_sub(2) as f64));
        let size = Size::sum(spread.into_iter().flat_map(|(size, _)| size.0))?;
        let one = Count::of(1.0);
        let theorem = match terms {
            [Self { exact: Some(one), .. }, Self { exact: Some(other), .. }] => addition_theorem(angles, [one, other]),
            _ => None,
        };
        let whole = match theorem {
            // Relative to c sin x an error of c is 1/|sin x|.
            Some([common, circular]) => {
                let is_spread_over = scattered.amplified.is_empty() && size == Size::of(common.clone());
                let exact = common.times(&circular);
                match circular.only_factor() {
                    Some(Factor::Sine(angle)) if is_spread_over => {
                        Self::product_of(exact, one.with(Amplifier::Cosecant, angle, scattered.constant))
                    }
                    Some(Factor::Cosine(angle)) if is_spread_over => {
                        Self::product_of(exact, one.with(Amplifier::Secant, angle, scattered.constant))
                    }
                    _ => Self { exact: Some(exact), size, relative: one, scattered },
                }
            }
            None => Self { exact: None, size, relative: one, scattered },
        };
        whole.readable()
    }

    /// The error of a term of a sum, relative to a size: |x cot x sin x| <= |x| for a rounded angle, 1/|sin x| |sin x| = 1.
    fn spread(&self) -> (Size, Count) {
        let mut size = self.size.clone();
        let mut count = Count::of(self.relative.constant);
        for &(amplifier, angle, factor) in &self.relative.amplified {
            let circular = match amplifier {
                Amplifier::Cotangent | Amplifier::Cosecant => Factor::Sine(angle),
                Amplifier::Tangent | Amplifier::Secant => Factor::Cosine(angle),
                Amplifier::Size => {
                    count = count.with(amplifier, angle, factor);
                    continue;
                }
            };
            let Some(shorter) = size.without(circular) else {
                count = count.with(amplifier, angle, factor);
                continue;
            };
            size = shorter;
            match amplifier {
                Amplifier::Cosecant | Amplifier::Secant => count.constant += factor,
                _ => count = count.with(Amplifier::Size, angle, factor),
            }
        }
        (size, count.plus(&self.scattered))
    }

    /// A square root halves a relative error.
    pub(super) fn root(&self) -> Option<Self> {
        if !self.scattered.is_zero() {
            return None;
        }
        let halved = |&(factor, exponent): &(Factor, i32)| (exponent % 2 == 0).then_some((factor, exponent / 2));
        let exact = self.exact.as_ref()?;
        let factors = exact.factors.iter().map(halved).collect::<Option<Vec<_>>>()?;
        let root = Monomial { coefficient: exact.coefficient.abs().sqrt(), factors };
        let relative = self.relative.clone().times(0.5).plus(&Count::of(1.0));
        Some(Self { exact: None, ..Self::product_of(root, relative) })
    }

    /// True for a power of two: a product with it is exact.
    fn is_shift(&self) -> bool {
        let number = self.exact.as_ref().filter(|exact| exact.factors.is_empty());
        number.is_some_and(|exact| is_power_of_two(exact.coefficient)) && self.relative.is_zero()
    }

    fn readable(self) -> Option<Self> {
        let is_short = |count: &Count| count.amplified.len() <= MOST_AMPLIFIERS;
        let is_moderate = self.exact.iter().chain(&self.size.0).all(Monomial::is_moderate);
        (is_moderate && is_short(&self.relative) && is_short(&self.scattered)).then_some(self)
    }
}
