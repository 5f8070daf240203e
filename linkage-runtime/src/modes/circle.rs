//! The real roots of a trigonometric polynomial g(phi) = sum_k c_k e^(i k phi), c_-k = conj c_k.
//!
//! On an arc of the circle g is a polynomial in t = tan of a quarter angle divided by (1 + t^2)^d. Its coefficients in
//! the basis of Bernstein bound the number of its roots on the arc: their changes of sign exceed it by an even number.
//! Arcs are halved until there is none or one. J. M. Lane and R. F. Riesenfeld, "Bounds on a polynomial", BIT 21, 1981.

use nalgebra::Complex;

use super::number::Number;
use crate::Real;

/// The estimated rounding error of a polynomial is multiplied by this. In all tests 4 is enough.
const SAFETY: f64 = 8.0;

/// The rounding error of a determinant is less than this part of its bound: for the double butterfly of the gallery, at five
/// inputs and with each direction as x, it is 1/700 at most.
const PART_OF_BOUND: f64 = 1.0 / 256.0;

/// The error of one in so many samples is bounded: those of the others are of its size.
const BOUNDED: usize = 4;

/// Ends of arcs and roots that differ less than this are one, in radians.
const SAME: f64 = 1e-9;

/// The arcs at which the search begins. The first starts at an angle that no drawing has, so that roots at round angles
/// are not at the ends of arcs.
const ARCS: usize = 4;
const FIRST: f64 = 0.123_456_789;

/// The most halvings of an arc, down to a width of 1e-10 rad. Roots that are nearer to each other cannot be separated:
/// between them |g| is smaller than its rounding error.
const MOST_HALVINGS: usize = 34;

/// A place where a trigonometric polynomial is zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Root {
    /// A change of sign, the only one near it.
    Simple(f64),
    /// An interval in which the polynomial is zero within rounding error, with any number of roots.
    Cluster([f64; 2]),
}

/// The roots of a polynomial in the order of their angles.
pub struct Roots {
    all: [Root; Self::MOST],
    count: usize,
}

impl Roots {
    /// More than any polynomial of degree 10 has, with a cluster at each end of each arc.
    const MOST: usize = 64;

    /// The roots; `None` if there were too many clusters.
    pub fn as_slice(&self) -> Option<&[Root]> {
        self.all.get(..self.count)
    }

    fn push(&mut self, root: Root) {
        if let Some(place) = self.all.get_mut(self.count) {
            *place = root;
        }
        self.count = (self.count + 1).min(Self::MOST + 1);
    }
}

/// A real trigonometric polynomial of degree d, with room for `TERMS` = 2 d + 1 terms.
#[derive(Debug, Clone, Copy)]
pub struct TrigonometricPolynomial<const TERMS: usize> {
    degree: usize,
    /// c_0, …, c_d.
    coefficients: [Number; TERMS],
    /// The rounding error of a value.
    noise: f64,
}

impl<const TERMS: usize> TrigonometricPolynomial<TERMS> {
    /// The polynomial of this degree that is `value` on the unit circle, up to a factor 1 or i, and `bounded` with a
    /// bound of its error; `None` if it is not real, or if its coefficients may be zero within their
    /// bounds.
    pub fn of(
        degree: usize,
        value: impl Fn(Number) -> Number,
        bounded: impl Fn(Number) -> (Number, f64),
    ) -> Option<Self> {
        let count = 2 * degree + 1;
        let (mut roots, mut values) = ([Number::default(); TERMS], [Number::default(); TERMS]);
        let (roots, values) = (roots.get_mut(..count)?, values.get_mut(..count)?);
        let mut error = 0.0_f64;
        for (k, (root, sample)) in roots.iter_mut().zip(values.iter_mut()).enumerate() {
            *root = direction(core::f64::consts::TAU * k as f64 / count as f64);
            let of;
            (*sample, of) = if k % BOUNDED == 0 { bounded(*root) } else { (value(*root), 0.0) };
            error = error.max(of);
        }
        let largest = |part: fn(&Number) -> f64| values.iter().map(|sample| part(sample).abs()).fold(0.0, f64::max);
        let (real, imaginary) = (largest(|value| value.re), largest(|value| value.im));
        let is_imaginary = imaginary > real;
        let (most, least) = if is_imaginary { (imaginary, real) } else { (real, imaginary) };
        let mut coefficients = [Number::default(); TERMS];
        for (k, coefficient) in coefficients.get_mut(..=degree)?.iter_mut().enumerate() {
            let term = |(j, sample): (usize, &Number)| {
                let sample = if is_imaginary { sample.im } else { sample.re };
                roots[j * k % count].conj() * sample
            };
            *coefficient = values.iter().enumerate().map(term).sum::<Number>() / count as f64;
        }
        // The real or the imaginary part should be zero: its size is the rounding error of the samples. With a factor of 1,
        // 34 of 80 000 positions within 1e-8 rad of a dead point were neither found nor in doubt; with 4 none. It says
        // nothing of numbers that are real in spite of their rounding errors: their bound does.
        let noise = (SAFETY * (count as f64) * (least + most * f64::EPSILON)).max(PART_OF_BOUND * error);
        (most > 64.0 * noise.max(error)).then_some(Self { degree, coefficients, noise })
    }

    /// The roots.
    pub fn roots(&self) -> Roots {
        let mut roots = Roots { all: [Root::Simple(0.0); Roots::MOST], count: 0 };
        let width = core::f64::consts::TAU / ARCS as f64;
        for number in 0..ARCS {
            let arc = Arc::new(self, FIRST + (number as f64 + 0.5) * width, width);
            arc.roots(self.degree, self.noise, &mut roots);
        }
        let mut roots = self.joined(&roots);
        // The last arc ends where the first begins: a root there is in both.
        if let Some([Root::Simple(first), .., Root::Simple(last)]) = roots.as_slice()
            && (last - first - core::f64::consts::TAU).abs() < SAME
        {
            roots.count -= 1;
        }
        roots
    }

    /// Joins neighbouring clusters, and finds those that are simple roots.
    fn joined(&self, found: &Roots) -> Roots {
        let mut roots = Roots { all: [Root::Simple(0.0); Roots::MOST], count: 0 };
        let Some(all) = found.as_slice() else {
            roots.count = Roots::MOST + 1;
            return roots;
        };
        let mut open: Option<[f64; 2]> = None;
        for root in all {
            match (*root, open) {
                (Root::Cluster([low, high]), Some([first, last])) if low <= last + SAME => open = Some([first, high]),
                (Root::Cluster(ends), before) => {
                    before.into_iter().for_each(|cluster| roots.push(self.resolved(cluster)));
                    open = Some(ends);
                }
                (simple, before) => {
                    before.into_iter().for_each(|cluster| roots.push(self.resolved(cluster)));
                    roots.push(simple);
                    open = None;
                }
            }
        }
        open.into_iter().for_each(|cluster| roots.push(self.resolved(cluster)));
        roots
    }

    /// A cluster in which g changes its sign and is monotonic is a simple root.
    fn resolved(&self, [low, high]: [f64; 2]) -> Root {
        let middle = 0.5 * (low + high);
        let [value, slope] = self.value_and_slope(middle);
        let half = (0.5 * (high - low)).max(8.0 * self.noise / slope.abs());
        if slope.abs() > 2.0 * half * self.most_curvature() {
            Root::Simple(middle - value / slope)
        } else {
            Root::Cluster([low, high])
        }
    }

    fn value_and_slope(&self, angle: f64) -> [f64; 2] {
        let x = direction(angle);
        let mut power = Number::new(1.0, 0.0);
        let (mut value, mut slope) = (self.coefficients[0].re, 0.0);
        for (k, coefficient) in self.coefficients.iter().enumerate().take(self.degree + 1).skip(1) {
            power *= x;
            let term = coefficient * power;
            value += 2.0 * term.re;
            slope -= 2.0 * k as f64 * term.im;
        }
        [value, slope]
    }

    /// An upper bound of `|g''|`.
    fn most_curvature(&self) -> f64 {
        let terms = self.coefficients.iter().enumerate().take(self.degree + 1);
        terms.map(|(k, coefficient)| 2.0 * (k * k) as f64 * coefficient.l1_norm()).sum()
    }
}

/// An arc of the circle.
struct Arc<const TERMS: usize> {
    middle: f64,
    /// The tangent of a quarter of its width.
    tangent: f64,
    /// The coefficients of g (1 + t^2)^d in the basis of Bernstein.
    coefficients: [f64; TERMS],
}

impl<const TERMS: usize> Arc<TERMS> {
    fn new(polynomial: &TrigonometricPolynomial<TERMS>, middle: f64, width: f64) -> Self {
        let degree = polynomial.degree;
        let tangent = (0.25 * width).tangent();
        // e^(i k phi) (1 + t^2)^d = u^(d + k) v^(d - k), u = 1 + i t = conj v; both are linear in s, t = T (2 s - 1). The
        // homogeneous polynomial in u and v by Horner's rule, with coefficients of s^j (1 - s)^(m - j).
        let ends = [Complex::new(1.0, -tangent), Complex::new(1.0, tangent)];
        let rotation = direction(middle);
        let mut turned = [Number::default(); TERMS];
        let mut power = Number::new(1.0, 0.0);
        for (to, from) in turned.iter_mut().zip(&polynomial.coefficients).take(degree + 1) {
            *to = from * power;
            power *= rotation;
        }
        let of = |place: usize| if place >= degree { turned[place - degree] } else { turned[degree - place].conj() };
        let mut sum = [Number::default(); TERMS];
        let mut powers = [Number::default(); TERMS];
        (sum[0], powers[0]) = (of(2 * degree), Number::new(1.0, 0.0));
        for order in 1..=2 * degree {
            for place in (0..=order).rev() {
                let before = |all: &[Number; TERMS], factors: [Number; 2]| {
                    let below = if place > 0 { all[place - 1] * factors[1] } else { Number::default() };
                    let same = if place < order { all[place] * factors[0] } else { Number::default() };
                    below + same
                };
                sum[place] = before(&sum, ends);
                powers[place] = before(&powers, ends.map(|end| end.conj()));
            }
            let coefficient = of(2 * degree - order);
            for (to, power) in sum.iter_mut().zip(&powers).take(order + 1) {
                *to += coefficient * power;
            }
        }
        let mut binomial = 1.0;
        let mut coefficients = [0.0; TERMS];
        for (place, to) in coefficients.iter_mut().enumerate().take(2 * degree + 1) {
            *to = sum[place].re / binomial;
            binomial = binomial * (2 * degree - place) as f64 / (place + 1) as f64;
        }
        Self { middle, tangent, coefficients }
    }

    fn angle(&self, s: f64) -> f64 {
        self.middle + 2.0 * (self.tangent * (2.0 * s - 1.0)).arctangent()
    }

    fn roots(&self, degree: usize, noise: f64, roots: &mut Roots) {
        let piece = Piece { start: 0.0, width: 1.0, coefficients: self.coefficients };
        self.search(&piece, 2 * degree + 1, noise, MOST_HALVINGS, roots);
    }

    fn search(&self, piece: &Piece<TERMS>, count: usize, noise: f64, halvings: usize, roots: &mut Roots) {
        let coefficients = &piece.coefficients[..count];
        let range = (f64::INFINITY, f64::NEG_INFINITY);
        let (least, most) =
            coefficients.iter().fold(range, |(least, most), &value| (least.min(value), most.max(value)));
        if least > noise || most < -noise {
            return;
        }
        let are_sure = [coefficients[0], coefficients[count - 1]].iter().all(|end| end.abs() > noise);
        if are_sure && changes(coefficients) == 1 {
            roots.push(Root::Simple(self.angle(piece.start + piece.width * root::<TERMS>(coefficients))));
        } else if halvings == 0 || (least >= -noise && most <= noise) {
            roots.push(Root::Cluster([piece.start, piece.start + piece.width].map(|s| self.angle(s))));
        } else {
            for half in piece.halves(count) {
                self.search(&half, count, noise, halvings - 1, roots);
            }
        }
    }
}

/// A part of an arc.
#[derive(Debug, Clone, Copy)]
struct Piece<const TERMS: usize> {
    start: f64,
    width: f64,
    coefficients: [f64; TERMS],
}

impl<const TERMS: usize> Piece<TERMS> {
    /// Both halves, by de Casteljau's algorithm.
    fn halves(&self, count: usize) -> [Self; 2] {
        let width = 0.5 * self.width;
        let mut right = Self { start: self.start + width, width, ..*self };
        let mut left = Self { width, ..*self };
        for step in 0..count {
            left.coefficients[step] = right.coefficients[0];
            for place in 0..count - 1 - step {
                right.coefficients[place] = 0.5 * (right.coefficients[place] + right.coefficients[place + 1]);
            }
        }
        [left, right]
    }
}

/// The changes of sign in a sequence.
fn changes(coefficients: &[f64]) -> usize {
    let signs = coefficients.iter().filter(|value| **value != 0.0).map(|value| *value > 0.0);
    signs.clone().zip(signs.skip(1)).filter(|(one, other)| one != other).count()
}

/// The only root of a polynomial on (0, 1), between ends of opposite signs: false position, with the value at the end
/// that stays halved (the Illinois rule).
fn root<const TERMS: usize>(coefficients: &[f64]) -> f64 {
    const MOST_STEPS: usize = 40;
    const ENOUGH: f64 = 1e-7;
    let last = coefficients.len() - 1;
    let (mut scaled, mut binomial) = ([0.0; TERMS], 1.0);
    for (place, (to, from)) in scaled.iter_mut().zip(coefficients).enumerate() {
        *to = from * binomial;
        binomial = binomial * (last - place) as f64 / (place + 1) as f64;
    }
    let scaled = &scaled[..=last];
    let [mut low, mut high] = [0.0, 1.0];
    let (mut at_low, mut at_high) = (coefficients[0], coefficients[last]);
    let mut middle = 0.5;
    for _ in 0..MOST_STEPS {
        middle = low + (high - low) * (at_low / (at_low - at_high));
        let value = value(scaled, middle);
        let moved = if (value > 0.0) == (at_high > 0.0) {
            let moved = high - middle;
            (high, at_high, at_low) = (middle, value, 0.5 * at_low);
            moved
        } else {
            let moved = middle - low;
            (low, at_low, at_high) = (middle, value, 0.5 * at_high);
            moved
        };
        if moved < ENOUGH {
            break;
        }
    }
    middle
}

/// sum_j q_j s^j (1 - s)^(n - j)
fn value(coefficients: &[f64], s: f64) -> f64 {
    let (mut sum, mut power) = (0.0, 1.0);
    for coefficient in coefficients {
        sum = sum * (1.0 - s) + coefficient * power;
        power *= s;
    }
    sum
}

/// The unit number of an angle.
pub fn direction(angle: f64) -> Number {
    let (sine, cosine) = angle.sine_cosine();
    Number::new(cosine, sine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::dixon::Dixon;

    /// The double butterfly of the gallery has 16 positions, real or not, at each of three crank angles, as an eigenvalue
    /// solver of another program finds from the same matrices: 8, 8 and 10 of them are real. With the rocker as x the
    /// matrix has no others.
    #[test]
    fn roots_of_the_double_butterfly() {
        let number = |re, im| Number::new(re, im);
        let (pin, upper) = (number(0.2, -1.0), number(5.0, -3.0));
        let (far, lower) = (number(0.4, 1.5), number(2.0, -4.0));
        for (crank, real) in [(0.0, 8), (1.0, 8), (2.5, 10)] {
            let crank = direction(crank);
            let real_part = |length: f64| number(length, 0.0);
            let zero = real_part(0.0);
            let ground = real_part(6.0);
            let rows = [
                [crank - ground, real_part(6.0), real_part(3.5), real_part(-4.0), zero, zero, zero],
                [crank - crank * pin, real_part(6.0), upper, zero, real_part(-2.0), real_part(-3.5), zero],
                [crank * pin - ground, zero, zero, -far, lower, zero, real_part(3.5)],
            ];
            let dixon = Dixon::<20>::new(&rows, &[], 6, 3).unwrap();
            let degree = dixon.degree().unwrap();
            assert_eq!(2 * degree, 16);
            let polynomial = TrigonometricPolynomial::<21>::of(
                degree,
                |x| dixon.determinant::<false>(x).0,
                |x| dixon.determinant::<true>(x),
            )
            .unwrap();
            assert!(polynomial.coefficients[degree].l1_norm() > 1e3 * polynomial.noise);
            assert_eq!(polynomial.roots().as_slice().unwrap().len(), real);
        }
    }

    /// Roots of a product of sines of half angles: one simple root, one root at the end of an arc, and a double root.
    #[test]
    fn simple_and_double_roots() {
        let roots = [0.5, FIRST, 2.0, 2.0];
        let value = |x: Number| roots.iter().map(|root| Number::from((x.arg() - root) / 2.0).sin()).product();
        let found = TrigonometricPolynomial::<7>::of(2, value, |x| (value(x), 0.0)).unwrap().roots();
        let found = found.as_slice().unwrap();
        let simple: Vec<f64> =
            found.iter().filter_map(|root| if let Root::Simple(at) = root { Some(*at) } else { None }).collect();
        let off = |at: f64, from: f64| ((at - from) / 2.0).sin().abs();
        assert!(simple.len() == 2 && off(simple[0], FIRST).min(off(simple[1], FIRST)) < 1e-7, "{found:?}");
        assert!(simple.iter().any(|at| off(*at, 0.5) < 1e-7), "{found:?}");
        let is_double =
            |root: &Root| matches!(root, Root::Cluster([low, high]) if *low < 2.0 && 2.0 < *high && high - low < 1e-5);
        assert_eq!(found.iter().filter(|root| is_double(root)).count(), 1, "{found:?}");
    }
}
