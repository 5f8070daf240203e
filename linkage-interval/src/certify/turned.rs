//! Formulas after full turns of their angles: a motion is at its start again where none of them has changed.
//!
//! A single angle with a sine repeats after a turn. Angles that are linked by numbers, as `cam = theta` or
//! `psi = -theta / 2`, repeat together: after one turn of both, after two turns and minus one. The vectors of turns after
//! which Psi is the same for all coordinates are a lattice; whether one belongs to it is computed by Psi itself, over
//! numbers that know how much they change.

use std::ops::{Add, Div, Mul, Neg, Sub};

use linkage_ir::Ratio;
use linkage_runtime::{Certifiable, Column, Formulas, Number};

use crate::Interval;

/// The most parameters with tolerances that may be factors of angles. Of those beyond, nothing is known.
const MOST_FACTORS: usize = 16;

/// A ratio times powers of parameters that have tolerances: their values are any within these.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Factor {
    ratio: Ratio,
    powers: [i8; MOST_FACTORS],
}

impl Factor {
    const ZERO: Self = Self { ratio: Ratio::ZERO, powers: [0; MOST_FACTORS] };

    fn of(ratio: Ratio) -> Self {
        Self { ratio, ..Self::ZERO }
    }

    /// A parameter with a tolerance, by its number among them.
    fn parameter(place: usize) -> Option<Self> {
        let mut factor = Self::of(Ratio::ONE);
        *factor.powers.get_mut(place)? = 1;
        Some(factor)
    }

    fn is_zero(self) -> bool {
        self.ratio.is_zero()
    }

    /// A ratio that depends on no parameter with a tolerance.
    fn ratio(self) -> Option<Ratio> {
        (self.is_zero() || self.powers == Self::ZERO.powers).then_some(self.ratio)
    }

    fn plus(self, other: Self) -> Option<Self> {
        if self.is_zero() || other.is_zero() {
            return Some(if self.is_zero() { other } else { self });
        }
        // A sum of different parameters has no form here.
        if self.powers != other.powers {
            return None;
        }
        Some(Self { ratio: self.ratio.plus(other.ratio)?, ..self })
    }

    fn times(self, other: Self) -> Option<Self> {
        if self.is_zero() || other.is_zero() {
            return Some(Self::ZERO);
        }
        let mut powers = self.powers;
        for (own, other) in powers.iter_mut().zip(other.powers) {
            *own = own.checked_add(other)?;
        }
        Some(Self { ratio: self.ratio.times(other.ratio)?, powers })
    }

    fn inverse(self) -> Option<Self> {
        let mut powers = self.powers;
        for own in &mut powers {
            *own = own.checked_neg()?;
        }
        Some(Self { ratio: self.ratio.inverse()?, powers })
    }

    fn negative(self) -> Self {
        Self { ratio: self.ratio.negative(), ..self }
    }
}

/// A number of formulas of which some angles are turned.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turned {
    /// Its value, where it depends on no coordinate and is known exactly.
    value: Option<Factor>,
    /// The full turns by which it changes, for all coordinates; `None` if they are not the same for all, or not known.
    change: Option<Factor>,
}

impl Turned {
    /// A coordinate that is an angle, turned, or one that stays.
    fn coordinate(turns: i64) -> Self {
        Self { value: None, change: Ratio::quotient(turns.into(), 1).map(Factor::of) }
    }

    fn constant(value: Option<Factor>) -> Self {
        Self { value, change: Some(Factor::ZERO) }
    }

    fn is_unchanged(self) -> bool {
        self.change.is_some_and(Factor::is_zero)
    }

    /// A function of numbers: unchanged if they are.
    fn function(arguments: &[Self]) -> Self {
        if arguments.iter().all(|argument| argument.is_unchanged()) { Self::constant(None) } else { Self::unknown() }
    }

    /// A function that repeats after each multiple of a full turn divided by this number.
    fn periodic(self, divisor: f64) -> Self {
        let parts = || self.change?.ratio()?.times(Ratio::of(divisor)?);
        if parts().is_some_and(Ratio::is_integer) { Self::constant(None) } else { Self::unknown() }
    }
}

impl Add for Turned {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = |one: Option<Factor>, other: Option<Factor>| one?.plus(other?);
        Self { value: sum(self.value, other.value), change: sum(self.change, other.change) }
    }
}
impl Neg for Turned {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: self.value.map(Factor::negative), change: self.change.map(Factor::negative) }
    }
}
impl Sub for Turned {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}
impl Mul for Turned {
    type Output = Self;
    /// (a + da) b - a b = da b, where b does not change.
    fn mul(self, other: Self) -> Self {
        let product = |one: Option<Factor>, other: Option<Factor>| one?.times(other?);
        let value = product(self.value, other.value);
        let change = match (self.is_unchanged(), other.is_unchanged()) {
            (true, true) => Some(Factor::ZERO),
            (false, true) => product(self.change, other.value),
            (true, false) => product(self.value, other.change),
            (false, false) => None,
        };
        Self { value, change }
    }
}
impl Div for Turned {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if !other.is_unchanged() {
            return Self::unknown();
        }
        let inverse = other.value.and_then(Factor::inverse);
        self * Self::constant(inverse)
    }
}

impl Number for Turned {
    fn exactly(value: f64) -> Self {
        Self::constant(Ratio::of(value).map(Factor::of))
    }
    fn near(_: f64) -> Self {
        Self::constant(None)
    }
    fn unknown() -> Self {
        Self { value: None, change: None }
    }
    fn pi() -> Self {
        Self::constant(None)
    }
    fn square(self) -> Self {
        self * self
    }
    fn abs(self) -> Self {
        Self::function(&[self])
    }
    fn sqrt(self) -> Self {
        Self::function(&[self])
    }
    fn exponential(self) -> Self {
        Self::function(&[self])
    }
    fn logarithm(self) -> Self {
        Self::function(&[self])
    }
    fn sine_cosine(self) -> (Self, Self) {
        (self.periodic(1.0), self.periodic(1.0))
    }
    fn tangent(self) -> Self {
        self.periodic(2.0)
    }
    fn arcsine(self) -> Self {
        Self::function(&[self])
    }
    fn arccosine(self) -> Self {
        Self::function(&[self])
    }
    fn arctangent(self) -> Self {
        Self::function(&[self])
    }
    fn arctangent2(self, x: Self) -> Self {
        Self::function(&[self, x])
    }
    fn hypotenuse(self, y: Self) -> Self {
        Self::function(&[self, y])
    }
}

/// True if Psi is the same for all values of the coordinates after these full turns of the unknowns and the inputs.
pub(super) fn repeats<M: Certifiable>(
    mechanism: &M,
    parameters: &Column<Interval, <M as Certifiable>::P>,
    unknowns: &Column<i64, M::U>,
    inputs: &Column<i64, M::V>,
) -> bool {
    let mut tolerances = 0;
    let parameters = parameters.map(|parameter| {
        if parameter.width() == 0.0 {
            return Turned::exactly(parameter.middle());
        }
        tolerances += 1;
        Turned::constant(Factor::parameter(tolerances - 1))
    });
    let formulas = mechanism.over::<Turned>(parameters);
    let psi = formulas.residual(&unknowns.map(Turned::coordinate), &inputs.map(Turned::coordinate));
    psi.iter().all(|psi| psi.is_unchanged())
}
