//! Numbers of formulas that go on where an angle jumps.
//!
//! `atan2` jumps by a turn at the negative x axis, but its derivatives do not. A sum of angles times constants jumps by
//! multiples of one number, and is known up to these without the jump. Any other function of such a number has the values that
//! the formula says.

use std::ops::{Add, Div, Mul, Neg, Sub};

use linkage_ir::Ratio;
use linkage_runtime::Number;

use crate::Interval;
use crate::ratio::enclosure;
use crate::series::Series;

/// A number of a formula, and the same without its jumps.
#[derive(Debug, Clone, Copy)]
pub(super) struct OnTurns {
    /// The number that the formula says.
    pub(super) own: Series<Interval>,
    kind: Kind,
}

/// The jumps of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Jump {
    Never,
    /// They are multiples of this number.
    By(Interval),
}

/// The part that a number has in jumps. It depends on the formula alone, not on the values in it.
#[derive(Debug, Clone, Copy)]
enum Kind {
    /// A constant of the formula.
    Constant(Ratio),
    /// Another number without jumps.
    Plain,
    /// A number that may jump, and is not known without.
    Jumping,
    /// The number without its jumps: the one of the formula and some multiple of this part of a turn, the same for all
    /// operands.
    Turning(Series<Interval>, Ratio),
}

impl Kind {
    fn constant(value: Option<Ratio>) -> Self {
        value.map_or(Self::Plain, Self::Constant)
    }

    fn turning(series: Series<Interval>, jump: Option<Ratio>) -> Self {
        jump.filter(|jump| !jump.is_zero()).map_or(Self::Jumping, |jump| Self::Turning(series, jump))
    }

    /// The part of a function of numbers.
    fn of(operands: &[OnTurns]) -> Self {
        let jumps = |operand: &OnTurns| matches!(operand.kind, Self::Jumping | Self::Turning(..));
        if operands.iter().any(jumps) { Self::Jumping } else { Self::Plain }
    }
}

impl OnTurns {
    /// A number that does not jump, such as a coordinate or a parameter.
    pub(super) fn plain(own: Series<Interval>) -> Self {
        Self { own, kind: Kind::Plain }
    }

    /// The number without its jumps, where that is known.
    pub(super) fn series(self) -> Series<Interval> {
        if let Kind::Turning(series, _) = self.kind { series } else { self.own }
    }

    /// The number of which all jumps are multiples, or that there are none; `None` if it is not known without its jumps.
    pub(super) fn jump(self) -> Option<Jump> {
        match self.kind {
            Kind::Constant(_) | Kind::Plain => Some(Jump::Never),
            Kind::Turning(_, part) => Some(Jump::By((Interval::pi() + Interval::pi()) * enclosure(part))),
            Kind::Jumping => None,
        }
    }

    /// The part of a sum.
    fn sum(self, other: Self) -> Kind {
        match (self.kind, other.kind) {
            (Kind::Constant(one), Kind::Constant(other)) => Kind::constant(one.plus(other)),
            (Kind::Turning(one, jump), Kind::Turning(other, by)) => Kind::turning(one + other, jump.common_part(by)),
            (Kind::Turning(series, jump), Kind::Constant(_) | Kind::Plain) => Kind::Turning(series + other.own, jump),
            (Kind::Constant(_) | Kind::Plain, Kind::Turning(series, jump)) => Kind::Turning(self.own + series, jump),
            _ => Kind::of(&[self, other]),
        }
    }

    /// Its own number by a function of formulas.
    fn function(self, of: impl Fn(Series<Interval>) -> Series<Interval>) -> Self {
        Self { own: of(self.own), kind: Kind::of(&[self]) }
    }
}

impl Add for OnTurns {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { own: self.own + other.own, kind: self.sum(other) }
    }
}
impl Neg for OnTurns {
    type Output = Self;
    fn neg(self) -> Self {
        let kind = match self.kind {
            Kind::Constant(value) => Kind::Constant(value.negative()),
            Kind::Turning(series, jump) => Kind::Turning(-series, jump),
            other => other,
        };
        Self { own: -self.own, kind }
    }
}
impl Sub for OnTurns {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { own: self.own - other.own, kind: self.sum(-other) }
    }
}
impl Mul for OnTurns {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let kind = match (self.kind, other.kind) {
            (Kind::Constant(one), Kind::Constant(other)) => Kind::constant(one.times(other)),
            (Kind::Turning(series, jump), Kind::Constant(by)) => {
                Kind::turning(series * other.own, jump.times(by.magnitude()))
            }
            (Kind::Constant(by), Kind::Turning(series, jump)) => {
                Kind::turning(self.own * series, jump.times(by.magnitude()))
            }
            _ => Kind::of(&[self, other]),
        };
        Self { own: self.own * other.own, kind }
    }
}
impl Div for OnTurns {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let kind = match (self.kind, other.kind) {
            (Kind::Constant(one), Kind::Constant(by)) => Kind::constant(by.inverse().and_then(|by| one.times(by))),
            (Kind::Turning(series, jump), Kind::Constant(by)) => {
                Kind::turning(series / other.own, by.magnitude().inverse().and_then(|by| jump.times(by)))
            }
            _ => Kind::of(&[self, other]),
        };
        Self { own: self.own / other.own, kind }
    }
}

impl Number for OnTurns {
    fn exactly(value: f64) -> Self {
        Self { own: Series::exactly(value), kind: Kind::constant(Ratio::of(value)) }
    }
    fn near(value: f64) -> Self {
        Self::plain(Series::near(value))
    }
    fn unknown() -> Self {
        Self::plain(Series::unknown())
    }
    fn pi() -> Self {
        Self::plain(Series::pi())
    }
    fn square(self) -> Self {
        self.function(Series::square)
    }
    fn abs(self) -> Self {
        self.function(Series::abs)
    }
    fn sqrt(self) -> Self {
        self.function(Series::sqrt)
    }
    fn exponential(self) -> Self {
        self.function(Series::exponential)
    }
    fn logarithm(self) -> Self {
        self.function(Series::logarithm)
    }
    fn sine_cosine(self) -> (Self, Self) {
        let (sine, cosine) = self.own.sine_cosine();
        (Self { own: sine, kind: Kind::of(&[self]) }, Self { own: cosine, kind: Kind::of(&[self]) })
    }
    fn tangent(self) -> Self {
        self.function(Series::tangent)
    }
    fn arcsine(self) -> Self {
        self.function(Series::arcsine)
    }
    fn arccosine(self) -> Self {
        self.function(Series::arccosine)
    }
    fn arctangent(self) -> Self {
        self.function(Series::arctangent)
    }
    fn arctangent2(self, x: Self) -> Self {
        let (x, y) = (x.own, self.own);
        let [first, second] = y.angle_rates(x);
        let series = Series { value: y.value.angle_on_one_turn(x.value), first, second };
        Self { own: y.arctangent2(x), kind: Kind::Turning(series, Ratio::ONE) }
    }
    fn hypotenuse(self, y: Self) -> Self {
        Self { own: self.own.hypotenuse(y.own), kind: Kind::of(&[self, y]) }
    }
}
