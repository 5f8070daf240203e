//! A tube about a part of the motion, and the test that certifies it.

use linkage_runtime::Certifiable;

use super::expansion::{Expansion, Linear, others, with_parameter};
use super::system::{Dimensions, System};
use crate::Interval;
use crate::matrix::{apply, symmetric};

/// The radius of a tube divided by the bound of its residual. With less the test needs a nearly constant J, with more
/// the tube is wider than necessary; 1.1 to 2 take about as many boxes.
const INFLATION: f64 = 1.3;

/// The smallest radius relative to the scale of a coordinate, or to its magnitude if that is larger, as after many turns:
/// about a hundred rounding errors.
const LEAST_RADIUS: f64 = 1.0 / (1_u64 << 46) as f64;

/// The largest radius relative to the scale of a coordinate: beyond it an angle has no direction.
const LARGEST_RADIUS: f64 = 1.0;

/// Tests of one tube with growing radius.
const TRIALS: usize = 3;

/// The most steps that shrink the box of a position: the error is squared in each.
const SHRINKING_STEPS: usize = 4;

/// A part of the width of a box that needs no further step.
const NEGLIGIBLE: f64 = 0.05;

/// A box that moves: for each value c of one coordinate in a range there is exactly one position in the box at c, and J
/// by the other coordinates is regular in all of it.
///
/// The box is p(c) plus and minus the radius, p(c) = q + (c - c0) w + (c - c0)^2 a / 2.
#[derive(Debug, Clone)]
pub(super) struct Tube {
    pub(super) expansion: Expansion,
    pub(super) range: Interval,
    /// True if the motion goes from the end of the range to its start.
    pub(super) is_backward: bool,
    /// The value of the parameter where the next tube takes over, and of the last one that at the end of the motion.
    pub(super) joint: Interval,
    /// The radii of all coordinates but the parameter.
    radius: Vec<f64>,
}

/// The positions of a tube over a part of its range, and the linear system of their rates.
pub(super) struct Part {
    pub(super) expansion: Expansion,
    pub(super) linear: Linear,
    pub(super) q: Vec<Interval>,
}

impl Tube {
    /// Certifies a tube about the motion near a guess, whose parameter is inside the range; `floor` are its least radii.
    ///
    /// The test of Krawczyk with a parameter: with Z the product of [-r, r], b = Y Psi(p(c)) and
    /// K = -b + (I - Y J(p(c) + Z)) Z, if K is in the interior of Z, then for each c there is exactly one zero of Psi in
    /// p(c) + Z, and J is regular there. Sources: R. Krawczyk, Computing 4 (1969); A. Guillemot, P. Lairez, "Validated
    /// numerics for algebraic path tracking", ISSAC 2024.
    pub(super) fn certify<M: Certifiable>(
        system: &System<M>,
        parameter: usize,
        guess: &[f64],
        range: Interval,
        floor: &[f64],
    ) -> Option<Self> {
        let expansion = Expansion::near(system, parameter, guess)?;
        let b = expansion.residual(system, Dimensions::All, range);
        let scales: Vec<f64> = others(parameter, &system.scales).copied().collect();
        let magnitudes = others(parameter, &expansion.q).zip(&scales).map(|(x, scale)| x.abs().max(*scale));
        let floors = others(parameter, floor).zip(magnitudes).map(|(&floor, of)| floor.max(LEAST_RADIUS * of));
        let mut radius: Vec<f64> =
            b.iter().zip(floors).map(|(b, floor)| (INFLATION * b.magnitude()).max(floor)).collect();
        for _ in 0..TRIALS {
            // NaN is not below.
            if !radius.iter().zip(&scales).all(|(radius, scale)| *radius <= LARGEST_RADIUS * scale) {
                return None;
            }
            let tube = Self { expansion: expansion.clone(), range, is_backward: false, joint: range, radius };
            let z: Vec<Interval> = tube.radius.iter().map(|&radius| symmetric(radius)).collect();
            let linear = tube.expansion.linear(system, Dimensions::All, &tube.over(range));
            let k: Vec<Interval> = b.iter().zip(apply(&linear.defect, &z)).map(|(&b, part)| part - b).collect();
            if k.iter().zip(&z).all(|(&k, &z)| k.is_interior(z)) {
                return Some(tube);
            }
            radius = tube.radius.iter().zip(&k).map(|(radius, k)| radius.max(INFLATION * k.magnitude())).collect();
        }
        None
    }

    /// The value of the parameter at which the motion enters.
    pub(super) fn start(&self) -> f64 {
        if self.is_backward { self.range.most() } else { self.range.least() }
    }

    /// The box at a value of the parameter, or the union of those of an interval of it.
    pub(super) fn over(&self, c: Interval) -> Vec<Interval> {
        let radius = with_parameter(self.expansion.parameter, self.radius.clone(), 0.0);
        let center = self.expansion.over(c);
        let around = |(center, radius): (Interval, f64)| if radius > 0.0 { center + symmetric(radius) } else { center };
        center.into_iter().zip(radius).map(around).collect()
    }

    /// True if all points of a box are inside.
    pub(super) fn contains(&self, q: &[Interval]) -> bool {
        let Some(&c) = q.get(self.expansion.parameter) else { return false };
        let center = self.expansion.over(c);
        let places = others(self.expansion.parameter, q).zip(others(self.expansion.parameter, &center));
        let within =
            |((&q, &center), &radius): ((&Interval, &Interval), &f64)| (q - center).is_within(symmetric(radius));
        c.is_within(self.range) && places.zip(&self.radius).all(within)
    }

    /// The positions of the tube over a part of its range, in a box that is about as small as they allow.
    ///
    /// The tube has exactly one position for each c; with any Y the Krawczyk operator of a box that contains it contains
    /// it, too, so that each intersection is an enclosure.
    pub(super) fn part<M: Certifiable>(&self, system: &System<M>, dimensions: Dimensions, c: Interval) -> Option<Part> {
        let parameter = self.expansion.parameter;
        let c = c.intersection(self.range)?;
        let expansion = Expansion::near(system, parameter, &self.expansion.float_at(c.middle()))?;
        let b = expansion.residual(system, dimensions, c);
        let center = expansion.over(c);
        let mut q = self.over(c);
        let mut last = f64::INFINITY;
        for step in 1.. {
            let linear = expansion.linear(system, dimensions, &q);
            let z: Vec<Interval> =
                others(parameter, &q).zip(others(parameter, &center)).map(|(&q, &p)| q - p).collect();
            let errors = apply(&linear.defect, &z);
            // Smaller errors than the residual would make the box no smaller.
            let is_last = errors.iter().zip(&b).all(|(error, b)| error.magnitude() <= NEGLIGIBLE * b.width());
            let k = b.iter().zip(errors).map(|(&b, part)| part - b);
            let next = others(parameter, &center).zip(k).map(|(&center, k)| center + k);
            let next: Vec<Interval> =
                others(parameter, &q).zip(next).map(|(q, next)| q.intersection(next)).collect::<Option<_>>()?;
            q = with_parameter(parameter, next, c);
            let width = q.iter().zip(&system.scales).map(|(q, scale)| q.width() / scale).fold(0.0, f64::max);
            if is_last || step == SHRINKING_STEPS || width > 0.9 * last {
                return Some(Part { expansion, linear, q });
            }
            last = width;
        }
        None
    }
}
