//! Derivatives of the unknowns along curves, with their mean-value form.

use linkage_runtime::{Certifiable, Number};

use super::EncloseErrorOf;
use super::linear::{Linear, psi};
use crate::Interval;
use crate::series::Series;

/// The order of a derivative along a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    First,
    Second,
}

/// A part of a series that may be an interval: the number itself, or a derivative of it that is given.
const PARTS: [fn(&mut Series<Interval>) -> &mut Interval; 3] =
    [|series| &mut series.value, |series| &mut series.first, |series| &mut series.second];

impl Order {
    fn of<N: Number>(self, series: Series<N>) -> N {
        match self {
            Self::First => series.first,
            Self::Second => series.second,
        }
    }
}

/// J over the box of a curve, and in the middle of it.
pub(super) struct Solver<'a, M> {
    pub(super) mechanism: &'a M,
    pub(super) linear: &'a Linear,
    pub(super) middle: &'a Linear,
    pub(super) order: Order,
    /// The name of the right-hand side.
    pub(super) derivative: &'static str,
}

impl<M: Certifiable> Solver<'_, M> {
    /// The derivatives x of this order of the unknowns along a curve of all numbers, in which they are zero: J x = -Psi'
    /// or `J x = -Psi''`. They are intersected with their mean-value form.
    pub(super) fn solve(&self, curve: &[Series<Interval>]) -> Result<Vec<Interval>, EncloseErrorOf<M>> {
        let x = self.natural(self.linear, curve)?;
        let narrower = self.centered(curve, &x);
        let both = |centered: Vec<Interval>| {
            x.iter().zip(centered).map(|(x, centered)| x.intersection(centered)).collect::<Option<Vec<_>>>()
        };
        Ok(narrower.and_then(both).unwrap_or(x))
    }

    fn natural(&self, linear: &Linear, curve: &[Series<Interval>]) -> Result<Vec<Interval>, EncloseErrorOf<M>> {
        let right: Vec<Interval> = psi(self.mechanism, curve).iter().map(|&psi| -self.order.of(psi)).collect();
        linear.solve(self.mechanism, &right, self.derivative)
    }

    /// The mean-value form x(m) + sum of dx/dz (z - m) over all intervals z of the curve: numbers, rates, accelerations.
    ///
    /// F(z, x) = 0, the derivative of Psi along the curve with x, gives J dx/dz = -F_z: a series of series in which z
    /// grows. `None` if the curve has no interval, or the form no bounds.
    fn centered(&self, curve: &[Series<Interval>], x: &[Interval]) -> Option<Vec<Interval>> {
        let middle = |x: Interval| Interval::from(x.middle());
        let middles: Vec<Series<Interval>> = curve
            .iter()
            .map(|z| Series { value: middle(z.value), first: middle(z.first), second: middle(z.second) })
            .collect();
        if middles == curve {
            return None;
        }
        let mut sum = self.natural(self.middle, &middles).ok()?;
        let mut solved = curve.to_vec();
        for (own, &x) in solved.iter_mut().zip(x) {
            match self.order {
                Order::First => own.first = x,
                Order::Second => own.second = x,
            }
        }
        let still = Series::constant(Interval::zero());
        let mut along: Vec<Series<Series<Interval>>> = solved.iter().map(|&z| Series::line(z, still)).collect();
        for place in 0..curve.len() {
            for part in PARTS {
                let (mut z, mut m) = (curve[place], middles[place]);
                let (z, m) = (*part(&mut z), *part(&mut m));
                if z == m {
                    continue;
                }
                *part(&mut along[place].first) = Interval::one();
                let right: Vec<Interval> =
                    psi(self.mechanism, &along).iter().map(|psi| -self.order.of(psi.first)).collect();
                along[place].first = still;
                let by = self.linear.solve(self.mechanism, &right, self.derivative).ok()?;
                sum.iter_mut().zip(by).for_each(|(sum, by)| *sum = *sum + by * (z - m));
            }
        }
        Some(sum)
    }
}
