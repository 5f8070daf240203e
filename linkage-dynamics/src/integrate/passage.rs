//! Passages of a function through zero between two samples, by its values and rates there.
//!
//! Between the samples the function is the cubic with their values and rates, plus an error of at most
//! 16 E x^2 (1 - x)^2, where x runs from 0 to 1 and E is estimated at the middle. The function has no zero there if the
//! cubic minus this error is not negative: if its Bernstein coefficients are not, after some halvings.

use nalgebra::ComplexField;

/// The number of halvings of a cubic before it counts as undecided. They evaluate no function. With 2 an oscillator that
/// passes its wall at a distance of 1e-6 takes 1.4 % more samples.
const HALVINGS: u32 = 5;

/// The largest error of a cubic with a minimum, divided by the depth of the minimum below the higher end. With a larger
/// one the minimum of the function may be much deeper. With 1/4 one in 5000 random functions with a narrow minimum is
/// missed.
const ERROR_OF_MINIMUM: f64 = 0.0625;

/// The factor by which the estimated error of interpolated states is increased. With 8 an oscillator at three amplitudes
/// from its wall takes 5 % more samples.
const ERROR_OF_STATES: f64 = 2.0;

/// The rate of a cubic through values and rates at both ends has an error of at most this times E. (Birkhoff and Priver, *Hermite
/// interpolation errors for derivatives*, Journal of Mathematics and Physics 46 (1967): sqrt(3) / 216 of the fourth derivative,
/// which is 384 E.)
const ERROR_OF_RATE: f64 = 3.08;

/// A function between two samples: the Bernstein coefficients of its cubic, and its error E; infinite if unknown.
#[derive(Debug, Clone, Copy)]
pub(super) struct Course {
    cubic: [f64; 4],
    error: f64,
    /// True if the error is a bound, not an estimate.
    is_bound: bool,
}

/// The next step of the search for a zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Next {
    /// The function has no zero before the end.
    Done,
    /// It may have: sample it at this fraction of the distance.
    Sample(f64),
}

impl Course {
    /// The course between two values with rates by the fraction x.
    pub(super) fn new([value, rate]: [f64; 2], [next, next_rate]: [f64; 2], error: f64) -> Self {
        Self { cubic: [value, value + rate / 3.0, next - next_rate / 3.0, next], error, is_bound: false }
    }

    /// This course with a bound of its error.
    pub(super) fn with_bound(self, error: f64) -> Self {
        Self { error, is_bound: true, ..self }
    }

    /// True if the function falls from end to end.
    fn falls(&self) -> bool {
        let [a, b, c, d] = self.cubic;
        [b - a, c - b, d - c].into_iter().all(|third| 3.0 * third + ERROR_OF_RATE * self.error < 0.0)
    }

    /// The error of the cubic, from the value and rate of the function at the middle. An error K x^2 (1 - x)^2 is
    /// K / 16 there; one of the next degree, K x^2 (1 - x)^2 (x - 1/2), has the rate K / 16 and is at most 0.143 of that.
    fn error_at_middle(&self, [value, rate]: [f64; 2]) -> f64 {
        let [a, b, c, d] = self.cubic;
        let of_value = 0.125 * (a + 3.0 * (b + c) + d) - value;
        let of_rate = 0.75 * (d + c - b - a) - rate;
        of_value.abs() + 0.143 * of_rate.abs()
    }

    /// The error of each half from the value and rate of the function at the middle: that of the whole, sixteen times as
    /// large for a smooth function. It is not accepted if it is smaller by chance.
    pub(super) fn error_of_half(&self, sample: [f64; 2]) -> f64 {
        let error = self.error_at_middle(sample);
        if self.error < f64::INFINITY && !self.is_bound { error.max(self.error / 64.0) } else { error }
    }

    /// Returns true if the function is not negative, with `more` as an additional error in Bernstein coefficients of
    /// degree four.
    fn is_positive(&self, more: [f64; 5]) -> bool {
        let [a, b, c, d] = self.cubic;
        // x^2 (1 - x)^2 is a sixth of the middle basis function.
        let middle = 0.5 * (b + c) - self.error * (16.0 / 6.0);
        let whole = [a, 0.25 * (a + 3.0 * b), middle, 0.25 * (3.0 * c + d), d];
        is_positive(core::array::from_fn(|i| whole[i] - more[i]), HALVINGS)
    }

    /// The places of the local minimum and maximum of the cubic between the samples.
    fn extrema(&self) -> [Option<f64>; 2] {
        let [a, b, c, d] = self.cubic;
        // A third of the rate: p (1 - x)^2 + 2 q x (1 - x) + r x^2.
        let (p, q, r) = (b - a, c - b, d - c);
        let (square, half) = (p - 2.0 * q + r, q - p);
        let discriminant = half * half - square * p;
        if discriminant < 0.0 {
            return [None, None];
        }
        // square x^2 + 2 half x + p = 0 with the roots (-half +- root) / square, + for the minimum, without cancellation.
        let root = ComplexField::sqrt(discriminant);
        let (minimum, maximum) = if half < 0.0 {
            ((root - half) / square, p / (root - half))
        } else {
            (-p / (half + root), -(half + root) / square)
        };
        [minimum, maximum].map(|x| (x > 0.0 && x < 1.0).then_some(x))
    }

    fn at(&self, x: f64) -> f64 {
        let [a, b, c, d] = self.cubic;
        let y = 1.0 - x;
        y * y * (y * a + 3.0 * x * b) + x * x * (3.0 * y * c + x * d)
    }

    /// The depth of a value below the higher end.
    fn depth(&self, value: f64) -> f64 {
        self.cubic[0].max(self.cubic[3]) - value
    }

    /// The next step of the search for the first zero of a function that begins at zero or above. Extrema nearer to an
    /// end than `near` change the value there by its rounding error only.
    pub(super) fn next(&self, has_passed: bool, near: f64) -> Next {
        if near >= 0.5 {
            return Next::Done;
        }
        if self.error == f64::INFINITY {
            return Next::Sample(0.5);
        }
        let [minimum, maximum] = self.extrema();
        let is_inside = |x: &f64| *x > near && *x < 1.0 - near;
        // From zero the function may rise before it passes zero.
        if self.cubic[0] <= 0.0
            && self.cubic[3] < 0.0
            && let Some(rise) = maximum.filter(|x| *x < 1.0 - near)
        {
            return Next::Sample(rise);
        }
        let lowest = minimum.filter(is_inside).map(|x| (x, self.at(x)));
        let is_accurate = |value: f64| self.error <= ERROR_OF_MINIMUM * self.depth(value);
        let place = lowest.filter(|&(_, value)| is_accurate(value)).map_or(0.5, |(x, _)| x);
        let is_done = if has_passed && self.is_bound {
            self.falls()
        } else if has_passed {
            // No passage before that at the end.
            is_accurate(self.cubic[3]) && lowest.is_none_or(|(_, value)| value > self.error)
        } else {
            (self.is_bound || lowest.is_none_or(|(_, value)| is_accurate(value)))
                && self.without_extrema_near_ends(minimum, near).is_positive([0.0; 5])
        };
        if is_done { Next::Done } else { Next::Sample(place) }
    }

    /// Sets the rates at the ends to zero if the minimum is near.
    fn without_extrema_near_ends(mut self, minimum: Option<f64>, near: f64) -> Self {
        let [a, _, _, d] = self.cubic;
        match minimum {
            Some(x) if x <= near => self.cubic[1] = a,
            Some(x) if x >= 1.0 - near => self.cubic[2] = d,
            _ => {}
        }
        self
    }
}

/// Returns true if a polynomial with these Bernstein coefficients is not negative, to some halvings.
fn is_positive(c: [f64; 5], halvings: u32) -> bool {
    if c.iter().all(|&c| c >= 0.0) {
        return true;
    }
    if halvings == 0 || c[0] < 0.0 || c[4] < 0.0 {
        return false;
    }
    let (mut left, mut right) = (c, c);
    // De Casteljau: row after row of means of neighbours.
    for row in 1..5 {
        for i in (row..5).rev() {
            left[i] = 0.5 * (left[i - 1] + left[i]);
        }
        for i in 0..5 - row {
            right[i] = 0.5 * (right[i] + right[i + 1]);
        }
    }
    is_positive(left, halvings - 1) && is_positive(right, halvings - 1)
}

/// Returns true if a function may pass zero in a step, by its values and its rates by the fraction of the step at the
/// ends of four equal parts. Its states are those of the cubic, whose error has the form x^2 (1 - x)^2 in the whole
/// step: it is estimated from the integral of the rates, which are interpolated independently of the values. `bounds` are those of
/// the errors of the cubics in the four parts, zero where none is known.
pub(super) fn may_pass(samples: [[f64; 2]; 5], bounds: [f64; 4]) -> bool {
    // The quartic through the rates, integrated from the start.
    const WEIGHTS: [([f64; 5], f64); 4] = [
        ([251.0, 646.0, -264.0, 106.0, -19.0], 720.0),
        ([29.0, 124.0, 24.0, 4.0, -1.0], 90.0),
        ([27.0, 102.0, 72.0, 42.0, -3.0], 80.0),
        ([14.0, 64.0, 24.0, 64.0, 14.0], 45.0),
    ];
    let start = samples[0][0];
    let errors = WEIGHTS
        .map(|(weights, divisor)| weights.iter().zip(&samples).map(|(w, [_, rate])| w * rate).sum::<f64>() / divisor);
    let errors: [f64; 4] = core::array::from_fn(|i| samples[i + 1][0] - start - 0.25 * errors[i]);
    let of_states = errors.iter().fold(0.0_f64, |most, error| most.max(error.abs()).max((error - errors[3]).abs()));
    let of_states = ERROR_OF_STATES * of_states;
    let course = |from: usize, to: usize, error: f64| {
        let width = 0.25 * (to - from) as f64;
        let [start, end] = [from, to].map(|i| [samples[i][0], samples[i][1] * width]);
        Course::new(start, end, error)
    };
    let middle = |from: usize, to: usize| {
        let width = 0.25 * (to - from) as f64;
        let [value, rate] = samples[usize::midpoint(from, to)];
        course(from, to, 0.0).error_at_middle([value, rate * width])
    };
    let whole = middle(0, 4);
    !(0..4).all(|part| {
        let half = part / 2 * 2;
        let error = middle(half, half + 2).max(whole / 64.0).max(bounds[part]);
        let more = match part {
            0 => [0.0, 0.0, of_states / 6.0, of_states / 2.0, of_states],
            3 => [of_states, of_states / 2.0, of_states / 6.0, 0.0, 0.0],
            _ => [of_states; 5],
        };
        let course = course(part, part + 1, error);
        let [minimum, _] = course.extrema();
        let is_accurate = |value: f64| error + of_states <= ERROR_OF_MINIMUM * course.depth(value);
        minimum.is_none_or(|x| is_accurate(course.at(x))) && course.is_positive(more)
    })
}

#[cfg(test)]
mod tests {
    use super::{Course, may_pass};

    /// The function 1 - 16 E x^2 (1 - x)^2 has its minimum 1 - E at the middle; its cubic is 1.
    #[test]
    fn a_function_below_its_cubic_by_the_error_is_not_positive() {
        for error in [0.1, 0.9, 0.99] {
            assert!(Course::new([1.0, 0.0], [1.0, 0.0], error).is_positive([0.0; 5]), "{error}");
        }
        for error in [1.01, 1.1, 1.9] {
            assert!(!Course::new([1.0, 0.0], [1.0, 0.0], error).is_positive([0.0; 5]), "{error}");
        }
    }

    /// The cubic 4 (x - low)^2 (x - 3/2 high + low / 2) has the derivative 12 (x - low) (x - high).
    #[test]
    fn a_course_is_the_cubic_with_its_values_and_rates() {
        for (high, low) in [(0.25, 0.75), (0.5, 0.875), (-2.0, 0.125), (-0.5, 1.5), (0.625, 3.0)] {
            let value = |x: f64| 4.0 * (x - low) * (x - low) * (x - 1.5 * high + 0.5 * low);
            let rate = |x: f64| 12.0 * (x - low) * (x - high);
            let course = Course::new([value(0.0), rate(0.0)], [value(1.0), rate(1.0)], 0.0);
            let size = value(0.0).abs().max(value(1.0).abs());
            for x in [0.0, 0.125, 0.25, 0.5, 0.6875, 0.75, 1.0] {
                assert!((course.at(x) - value(x)).abs() <= 1e-14 * size, "{high} {low} {x}: {}", course.at(x));
            }
            let inside = |x: f64| (0.0 < x && x < 1.0).then_some(x);
            for (found, expected) in course.extrema().into_iter().zip([inside(low), inside(high)]) {
                assert_eq!(found.is_some(), expected.is_some(), "{high} {low}");
                assert!(found.zip(expected).is_none_or(|(a, b)| (a - b).abs() <= 1e-14), "{high} {low}: {found:?}");
            }
        }
    }

    /// Parabolas that are positive at all samples, with the vertex between two of them.
    #[test]
    fn a_parabola_may_pass_if_its_vertex_is_below_zero() {
        for curvature in [1e-3, 1.0, 1e3, 1e6] {
            for vertex in [0.125, 0.3, 0.375, 0.45, 0.6, 0.875] {
                for (height, passes) in [(-1e-3, true), (1e-3, false), (1.0, false)] {
                    let samples = [0.0, 0.25, 0.5, 0.75, 1.0].map(|x: f64| {
                        let off = x - vertex;
                        [curvature * (off * off + height), 2.0 * curvature * off]
                    });
                    assert!(samples.iter().all(|[value, _]| *value > 0.0));
                    assert_eq!(may_pass(samples, [0.0; 4]), passes, "{curvature:e} {vertex} {height}");
                }
            }
        }
    }
}
