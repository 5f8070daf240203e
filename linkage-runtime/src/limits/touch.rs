//! Positions at which motions touch, where Newton's method does not come any further.
//!
//! At a distance h from their touch two motions with one tangent differ by a multiple of h^2, and the determinant is one, too.
//! Newton's method stays on a motion only in steps shorter than that. But the motion is smooth: its positions before the
//! touch, extrapolated, give it beyond, and the positions on both sides give the touch itself.

use super::searched::{Found, Sample, Searched};
use super::walk::Walked;
use crate::jacobian::ulp::{EQUAL_ULPS, nearly_zero, ulps};
use crate::jacobian::{EliminationOf as Elimination, Jacobian};
use crate::scalar::arithmetic::*;
use crate::{Build, Column, Dim, Mechanism, PerUnknown, PositionErrorOf, Real, real};

/// The distances of positions from the input at which the motion stops, in the order in which they are found, divided by the
/// range of the search. They are mirrored at the touch. The interpolation through all eight is exact up to the
/// eighth derivative; what it leaves out is smaller than an ulp of the position.
const DISTANCES: [f64; 4] = [27.0 / 32768.0, 18.0 / 32768.0, 12.0 / 32768.0, 8.0 / 32768.0];

/// The positions before a touch.
const BEFORE: usize = DISTANCES.len();

impl<M: Mechanism> Searched<'_, M> {
    /// A position beyond the touch at which a motion stops. It comes from a regular position at the input `at`, and stops at
    /// the input `end`. `None` if there is no touch.
    ///
    /// Motions that only come close to each other turn back, and leave a gap: in its middle the equations leave a
    /// residual that rounding cannot explain.
    pub(super) fn beyond_touch(
        &self,
        (mut position, at): (M::Coordinates, M::Scalar),
        end: M::Scalar,
        group: M::Name,
    ) -> Result<Option<Sample<M>>, PositionErrorOf<M>> {
        let Some(index) = self.mechanism.groups().position(|other| other.name == group) else { return Ok(None) };
        let mut here = at;
        let (u, ..) = self.mechanism.dims();
        let mut nodes = [(end, u.zeros()); 2 * BEFORE];
        // The square root of the determinant is proportional to the distance.
        let mut roots = [M::Scalar::zero(); BEFORE];
        for ((node, root), distance) in nodes.iter_mut().zip(&mut roots).zip(DISTANCES) {
            let input = end + (self.reach * real(distance)).copysign(at - end);
            let Walked::Arrived(sample) = self.walk((position, here), input, group)? else { return Ok(None) };
            *node = (input, in_turn_of(self.mechanism, M::unknowns(&sample.position), &M::unknowns(&position)));
            *root = sample.determinant(index).sqrt();
            (position, here) = (M::with_unknowns(&sample.position, node.1), input);
        }
        let [.., one, other] = roots;
        let touch = here + (here - nodes[BEFORE - 2].0) * (other / (one - other));
        if !touch.is_finite() || touch == here || (touch > here) != (end > at) {
            return Ok(None);
        }
        let mut beyond = None;
        let before = nodes;
        for (count, (mirrored, _)) in before.iter().take(BEFORE).rev().enumerate() {
            let input = touch + (touch - *mirrored);
            let expected = interpolated(u, nodes.get(..BEFORE + count).unwrap_or_default(), input);
            let Found::Assembled(found) = self.at(&M::with_unknowns(&position, expected), input)? else {
                return Ok(None);
            };
            if let Some(node) = nodes.get_mut(BEFORE + count) {
                *node = (input, in_turn_of(self.mechanism, M::unknowns(&found.position), &expected));
            }
            beyond = Some(found);
        }
        let middle = M::with_unknowns(&self.at_input(&position, touch), interpolated(u, &nodes, touch));
        Ok(beyond.filter(|_| self.is_position(&middle)))
    }

    /// True if there is a position at these inputs near `q`. J has lost one rank there, so that Newton's method corrects Psi
    /// but for N Psi, with the left null vector N. It is a position if N Psi is zero, up to what rounding can make of zero.
    fn is_position(&self, q: &M::Coordinates) -> bool {
        let pose = self.mechanism.pose_at(q);
        let (u, v, _) = self.mechanism.dims();
        let jacobian = Jacobian { unknowns: self.mechanism.jacobian_unknowns(&pose), inputs: u.zero_matrix(v) };
        let elimination = Elimination::<M>::all_but(1, jacobian);
        let (residual, terms) = (self.mechanism.residual(&pose), self.mechanism.residual_scales(&pose));
        let height = elimination.left_null_product(&residual);
        let noise = elimination.left_null_error(&(terms * ulps(EQUAL_ULPS)));
        let is_within = |(value, bound): (&M::Scalar, &M::Scalar)| value.abs() <= *bound;
        height.iter().zip(&noise).all(is_within)
            && residual.iter().zip(&(terms * nearly_zero::<M::Scalar>())).all(is_within)
    }
}

/// Unknowns with each angle in the turn nearest to that of other unknowns: an angle in closed form may jump by a turn.
pub(super) fn in_turn_of<M: Mechanism>(
    mechanism: &M,
    unknowns: PerUnknown<M>,
    others: &PerUnknown<M>,
) -> PerUnknown<M> {
    let turn = M::Scalar::two_pi();
    let each = unknowns.iter().zip(others).zip(mechanism.unknown_angles());
    others.dim().padded(each.map(
        |((&unknown, &other), &is_angle)| {
            if is_angle { unknown + ((other - unknown) / turn).round() * turn } else { unknown }
        },
    ))
}

/// The polynomial through these nodes, by Lagrange's formula.
fn interpolated<T: Real, U: Dim>(u: U, nodes: &[(T, Column<T, U>)], at: T) -> Column<T, U> {
    nodes.iter().enumerate().fold(u.zeros(), |sum, (place, &(here, value))| {
        let others = nodes.iter().enumerate().filter(|(other, _)| *other != place);
        let weight = others.fold(T::one(), |weight, (_, &(there, _))| weight * ((at - there) / (here - there)));
        sum + value * weight
    })
}
