//! Truncated power series in one variable.

use std::ops::{Add, Div, Mul, Neg, Sub};

use linkage_runtime::Number;

/// A number that depends on one variable t: its value and its first two derivatives by t.
///
/// Formulas over it compute derivatives along a line or a curve from the formulas alone: with q + t w in place of q, the
/// first derivative of Psi is J w, the second the quadratic velocity term (Psi_q w)_q w. Over intervals each of the three
/// contains the value for all numbers of the operands.
///
/// ```
/// use linkage_interval::certify::Series;
/// use linkage_runtime::Number;
///
/// // x^2 sin x at x = 1 + t.
/// let x = Series::line(1.0, 1.0);
/// let f = x.square() * x.sine();
/// assert_eq!(f.value, 1_f64.sin());
/// assert!((f.first - (2.0 * 1_f64.sin() + 1_f64.cos())).abs() < 1e-15);
/// assert!((f.second - (1_f64.sin() + 4.0 * 1_f64.cos())).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Series<N> {
    /// The value at t = 0.
    pub value: N,
    /// The derivative by t.
    pub first: N,
    /// The second derivative by t.
    pub second: N,
}

impl<N: Number> Series<N> {
    /// A number that does not depend on t.
    #[must_use]
    pub fn constant(value: N) -> Self {
        Self { value, first: N::zero(), second: N::zero() }
    }

    /// A number that grows with t at this rate.
    #[must_use]
    pub fn line(value: N, rate: N) -> Self {
        Self { value, first: rate, second: N::zero() }
    }

    /// The two derivatives of the angle of (x, y), y = `self`, on both sides of its jump: theta' = (x y' - y x') / r^2, and its
    /// derivative.
    pub(crate) fn angle_rates(self, x: Self) -> [N; 2] {
        let y = self;
        let squared = x.value.square() + y.value.square();
        let first = (x.value * y.first - y.value * x.first) / squared;
        let along = x.value * x.first + y.value * y.first;
        let second = (x.value * y.second - y.value * x.second - double(first * along)) / squared;
        [first, second]
    }

    /// f(x) from f and its two derivatives at the value: `f' x'`, `f'' x'^2 + f' x''`.
    fn chain(self, value: N, by: N, twice: N) -> Self {
        Self { value, first: by * self.first, second: twice * self.first.square() + by * self.second }
    }
}

/// x + t r: numbers that grow with t at these rates.
pub(crate) fn lines<N: Number>(x: &[N], rates: &[N]) -> Vec<Series<N>> {
    x.iter().zip(rates).map(|(&x, &rate)| Series::line(x, rate)).collect()
}

/// x + t e, where e is the unit vector with its 1 at this index.
pub(crate) fn unit_line<N: Number>(x: &[N], moving: usize) -> Vec<Series<N>> {
    let rate = |place| if place == moving { N::one() } else { N::zero() };
    x.iter().enumerate().map(|(place, &x)| Series::line(x, rate(place))).collect()
}

/// Twice a number.
fn double<N: Number>(x: N) -> N {
    x + x
}

impl<N: Number> Add for Series<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, first: self.first + other.first, second: self.second + other.second }
    }
}
impl<N: Number> Sub for Series<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, first: self.first - other.first, second: self.second - other.second }
    }
}
impl<N: Number> Neg for Series<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, first: -self.first, second: -self.second }
    }
}
impl<N: Number> Mul for Series<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            first: self.first * other.value + self.value * other.first,
            second: self.second * other.value + double(self.first * other.first) + self.value * other.second,
        }
    }
}
impl<N: Number> Div for Series<N> {
    type Output = Self;
    /// q = a / b from a = q b, differentiated twice.
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        let first = (self.first - value * other.first) / other.value;
        let second = (self.second - double(first * other.first) - value * other.second) / other.value;
        Self { value, first, second }
    }
}

impl<N: Number> Number for Series<N> {
    fn exactly(value: f64) -> Self {
        Self::constant(N::exactly(value))
    }
    fn near(value: f64) -> Self {
        Self::constant(N::near(value))
    }
    fn unknown() -> Self {
        Self { value: N::unknown(), first: N::unknown(), second: N::unknown() }
    }
    fn pi() -> Self {
        Self::constant(N::pi())
    }
    fn square(self) -> Self {
        let by = double(self.value);
        self.chain(self.value.square(), by, N::exactly(2.0))
    }
    /// Its derivative is x / |x|, of which nothing is known at zero.
    fn abs(self) -> Self {
        let value = self.value.abs();
        self.chain(value, self.value / value, N::zero() / value)
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        let by = N::exactly(0.5) / root;
        self.chain(root, by, -by / double(self.value))
    }
    fn exponential(self) -> Self {
        let value = self.value.exponential();
        self.chain(value, value, value)
    }
    fn logarithm(self) -> Self {
        let by = N::one() / self.value;
        self.chain(self.value.logarithm(), by, -by.square())
    }
    fn sine_cosine(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sine_cosine();
        (self.chain(sine, cosine, -sine), self.chain(cosine, -sine, -cosine))
    }
    /// Over a pole nothing is known of its derivatives, not even that the first is positive.
    fn tangent(self) -> Self {
        let (_, cosine) = self.value.sine_cosine();
        let value = self.value.tangent();
        // Zero, or unknown.
        let pole = N::zero() / cosine;
        let by = N::one() + value.square() + pole;
        self.chain(value, by, double(value * by))
    }
    fn arcsine(self) -> Self {
        let by = N::one() / (N::one() - self.value.square()).sqrt();
        self.chain(self.value.arcsine(), by, self.value * by.square() * by)
    }
    fn arccosine(self) -> Self {
        let by = -(N::one() / (N::one() - self.value.square()).sqrt());
        self.chain(self.value.arccosine(), by, self.value * by.square() * by)
    }
    fn arctangent(self) -> Self {
        let by = N::one() / (N::one() + self.value.square());
        self.chain(self.value.arctangent(), by, -double(self.value * by.square()))
    }
    /// Over the negative x axis, where the angle jumps, nothing is known of its derivatives: there the value reaches pi.
    fn arctangent2(self, x: Self) -> Self {
        let value = self.value.arctangent2(x.value);
        // Zero, or unknown. A double on the axis itself has the derivative of its side.
        let cut = N::zero() / (N::pi() - value.abs() + N::exactly(f64::MIN_POSITIVE));
        let [first, second] = self.angle_rates(x);
        Self { value, first: first + cut, second: second + cut }
    }
    /// r' = (x x' + y y') / r, and its derivative.
    fn hypotenuse(self, y: Self) -> Self {
        let x = self;
        let value = x.value.hypotenuse(y.value);
        let first = (x.value * x.first + y.value * y.first) / value;
        let along = x.first.square() + y.first.square() + x.value * x.second + y.value * y.second;
        Self { value, first, second: (along - first.square()) / value }
    }
}
