//! The motion near a position, to second order, as functions of one coordinate.

use linkage_runtime::{Certifiable, Number};

use super::system::{Dimensions, System};
use crate::Interval;
use crate::matrix::{Floats, defect, inverse, product, solution, times};
use crate::series::{Series, lines};

/// The most steps of Newton's method: it doubles the digits in each, or it does not converge.
const NEWTON_STEPS: usize = 25;

/// Relative to the scales of the coordinates, or to their magnitudes if these are larger, Newton steps this short are the
/// last ones. Halved or doubled, the box around the position becomes no smaller.
const SHORT: f64 = 1e-14;

/// A Newton step that is no shorter than half of the one before shows rounding error if it is shorter than this, else
/// that there is no position.
const STAGNANT: f64 = 1e-9;

/// A position in floats and the motion through it as a function of the coordinate with index `parameter`:
/// p(c) = q + (c - c0) w + (c - c0)^2 a / 2, and a float inverse Y of the derivative of Psi by the other coordinates.
///
/// None of these floats is trusted: the tests hold for any.
#[derive(Debug, Clone)]
pub(super) struct Expansion {
    pub(super) parameter: usize,
    pub(super) q: Vec<f64>,
    /// The rates w; 1 for the parameter.
    pub(super) w: Vec<f64>,
    /// The accelerations a; 0 for the parameter.
    pub(super) a: Vec<f64>,
    y: Floats,
}

/// A coefficient matrix Y J(box), as I - Y J, with J by columns.
pub(super) struct Linear {
    pub(super) defect: Vec<Vec<Interval>>,
    columns: Vec<Vec<Interval>>,
}

/// All columns but that of the parameter.
pub(super) fn others<X>(parameter: usize, columns: &[X]) -> impl Iterator<Item = &X> {
    columns.iter().enumerate().filter(move |&(place, _)| place != parameter).map(|(_, column)| column)
}

/// Adds an entry for the parameter to the entries for the other coordinates.
pub(super) fn with_parameter<X: Clone>(parameter: usize, mut entries: Vec<X>, entry: X) -> Vec<X> {
    entries.insert(parameter.min(entries.len()), entry);
    entries
}

impl Expansion {
    /// The expansion about the position near a guess; the parameter keeps its value.
    pub(super) fn near<M: Certifiable>(system: &System<M>, parameter: usize, guess: &[f64]) -> Option<Self> {
        let mut q = guess.to_vec();
        let mut last = f64::INFINITY;
        for _ in 0..NEWTON_STEPS {
            let y = inverse_at(system, parameter, &q)?.1;
            let point: Vec<_> = q.iter().map(|&x| Series::constant(x)).collect();
            let psi: Vec<f64> = system.float_psi(&point).iter().map(|psi| psi.value).collect();
            let step = with_parameter(parameter, product(&y, &psi), 0.0);
            q.iter_mut().zip(&step).for_each(|(x, step)| *x -= step);
            let lengths =
                step.iter().zip(&q).zip(&system.scales).map(|((step, x), scale)| step.abs() / x.abs().max(*scale));
            let length = lengths.fold(0.0, f64::max);
            if !length.is_finite() || length > STAGNANT && length > 0.5 * last && last < 1.0 {
                return None;
            }
            if length <= SHORT || length <= STAGNANT && length > 0.5 * last {
                return Self::at(system, parameter, q);
            }
            last = length;
        }
        None
    }

    fn at<M: Certifiable>(system: &System<M>, parameter: usize, q: Vec<f64>) -> Option<Self> {
        let (columns, y) = inverse_at(system, parameter, &q)?;
        let negative = |column: &[f64]| product(&y, column).iter().map(|x| -x).collect::<Vec<f64>>();
        let w = with_parameter(parameter, negative(columns.get(parameter)?), 1.0);
        let gamma: Vec<f64> = system.float_psi(&lines(&q, &w)).iter().map(|psi| psi.second).collect();
        let a = with_parameter(parameter, negative(&gamma), 0.0);
        let numbers = q.iter().chain(&w).chain(&a);
        numbers.into_iter().all(|number| number.is_finite()).then_some(Self { parameter, q, w, a, y })
    }

    /// The value of the parameter.
    pub(super) fn middle(&self) -> f64 {
        self.q.get(self.parameter).copied().unwrap_or(f64::NAN)
    }

    /// p(c) in floats.
    pub(super) fn float_at(&self, c: f64) -> Vec<f64> {
        let s = c - self.middle();
        let parts = self.q.iter().zip(&self.w).zip(&self.a);
        let q = parts.map(|((q, w), a)| q + s * (w + 0.5 * s * a)).collect();
        replaced(q, self.parameter, c)
    }

    /// p(c) for all c of an interval.
    pub(super) fn over(&self, c: Interval) -> Vec<Interval> {
        let s = self.distance(c);
        let half = s.square() * Interval::from(0.5);
        let parts = self.q.iter().zip(&self.w).zip(&self.a);
        let q = parts.map(|((&q, &w), &a)| Interval::from(q) + s * w.into() + half * a.into()).collect();
        replaced(q, self.parameter, c)
    }

    fn distance(&self, c: Interval) -> Interval {
        c - Interval::from(self.middle())
    }

    /// Y Psi(p(c)) for all c of an interval and all dimensions, by Taylor's theorem about the middle:
    /// `Psi(p(c0)) + s (Psi p)'(c0) + s^2 / 2 (Psi p)''(C)`, and the mean-value theorem for the parameters.
    pub(super) fn residual<M: Certifiable>(
        &self,
        system: &System<M>,
        dimensions: Dimensions,
        c: Interval,
    ) -> Vec<Interval> {
        let s = self.distance(c);
        let half = s.square() * Interval::from(0.5);
        let over = self.over(c);
        let parts = self.q.iter().zip(&self.w).zip(&self.a);
        let line = parts.map(|((&q, &w), &a)| Series { value: q.into(), first: w.into(), second: a.into() });
        let parts = over.iter().zip(&self.w).zip(&self.a);
        let tube = parts.map(|((&value, &w), &a)| {
            let a = Interval::from(a);
            Series { value, first: Interval::from(w) + s * a, second: a }
        });
        let at = system.psi(Dimensions::Nominal, &line.collect::<Vec<_>>());
        let in_tube = system.psi(Dimensions::Nominal, &tube.collect::<Vec<_>>());
        let terms = at.iter().zip(&in_tube).map(|(at, tube)| at.value + s * at.first + half * tube.second);
        let mut b = times(&self.y, &terms.collect::<Vec<_>>());
        if dimensions == Dimensions::All && system.has_tolerances() {
            for (by, difference) in system.by_parameters(&over) {
                for (b, by) in b.iter_mut().zip(times(&self.y, &by)) {
                    *b = *b + by * difference;
                }
            }
        }
        b
    }

    /// I - Y J over a box.
    pub(super) fn linear<M: Certifiable>(&self, system: &System<M>, dimensions: Dimensions, q: &[Interval]) -> Linear {
        let columns = system.jacobian(dimensions, q);
        let square: Vec<&[Interval]> = others(self.parameter, &columns).map(Vec::as_slice).collect();
        Linear { defect: defect(&self.y, &square), columns }
    }

    /// The solution x of J x = c for all J of the box of `linear`, with an entry for the parameter.
    pub(super) fn solve<M: Certifiable>(
        &self,
        system: &System<M>,
        linear: &Linear,
        c: &[Interval],
        entry: Interval,
    ) -> Option<Vec<Interval>> {
        let scales: Vec<f64> = others(self.parameter, &system.scales).copied().collect();
        let x = solution(&self.y, &linear.defect, c, &scales)?;
        Some(with_parameter(self.parameter, x, entry))
    }

    /// q'(c) over a box: J q' = -(the column of the parameter).
    pub(super) fn rates<M: Certifiable>(&self, system: &System<M>, linear: &Linear) -> Option<Vec<Interval>> {
        let column: Vec<Interval> = linear.columns.get(self.parameter)?.iter().map(|&x| -x).collect();
        self.solve(system, linear, &column, Interval::one())
    }

    /// `q''(c)` over a box: `J q'' = -gamma(q')`.
    pub(super) fn accelerations<M: Certifiable>(
        &self,
        system: &System<M>,
        dimensions: Dimensions,
        linear: &Linear,
        q: &[Interval],
        rates: &[Interval],
    ) -> Option<Vec<Interval>> {
        let gamma: Vec<Interval> = system.psi(dimensions, &lines(q, rates)).iter().map(|psi| -psi.second).collect();
        self.solve(system, linear, &gamma, Interval::zero())
    }
}

/// The columns of [J A], and the inverse of those of all coordinates but the parameter.
fn inverse_at<M: Certifiable>(system: &System<M>, parameter: usize, q: &[f64]) -> Option<(Floats, Floats)> {
    let columns = system.float_jacobian(q);
    let square: Vec<&[f64]> = others(parameter, &columns).map(Vec::as_slice).collect();
    let inverse = inverse(&square, &system.rows)?;
    Some((columns, inverse))
}

fn replaced<X>(mut entries: Vec<X>, place: usize, entry: X) -> Vec<X> {
    if let Some(own) = entries.get_mut(place) {
        *own = entry;
    }
    entries
}
