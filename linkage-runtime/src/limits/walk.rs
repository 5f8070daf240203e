//! The motion in steps along its tangent, which are short next to singular positions.

use super::searched::{Found, Sample, Searched};
use crate::scalar::arithmetic::*;
use crate::{Build, Mechanism, PositionErrorOf, real};

/// The first step, divided by the range of the search. Each is at most twice as long as the one before.
const FIRST: f64 = 1.0 / 1_048_576.0;

/// The shortest step, divided by the range of the search: a shorter one follows neither a motion that turns back nor one that
/// touches another.
const SHORTEST: f64 = 1.0 / 1_073_741_824.0;

/// The longest step, divided by the distance from a position at which motions touch. Along the tangent of a parabola half of
/// the distance leads to its vertex, where Newton's method fails; a whole one may lead over a gap to another motion.
const LONGEST: f64 = 0.25;

/// The most steps: about a hundred lead to a singular position.
const MOST_STEPS: usize = 512;

/// The end of a motion in steps.
pub(super) enum Walked<M: Mechanism> {
    Arrived(Sample<M>),
    Stuck(Stuck<M>),
}

/// The last position that was found, and an input beyond at which the mechanism was not assembled: from there, but for a
/// motion of too many steps.
pub(super) struct Stuck<M: Mechanism> {
    pub(super) last: Sample<M>,
    pub(super) unbuildable: M::Scalar,
}

impl<M: Mechanism> Searched<'_, M> {
    /// Follows the motion from a position and its input to the input `to`, which this group stops.
    pub(super) fn walk(
        &self,
        (position, input): (M::Coordinates, M::Scalar),
        to: M::Scalar,
        group: M::Name,
    ) -> Result<Walked<M>, PositionErrorOf<M>> {
        let index = self.mechanism.groups().position(|other| other.name == group).unwrap_or_default();
        let determinants = self.mechanism.block_determinants(&self.mechanism.pose_at(&position)).abs();
        let mut last = Sample { input, position, determinants };
        let (first, shortest) = (self.reach * real(FIRST), self.reach * real(SHORTEST));
        let (mut step, mut unbuildable) = (first.copysign(to - input), to);
        for _ in 0..MOST_STEPS {
            let is_last = (to - last.input).abs() <= step.abs();
            let next = if is_last { to } else { last.input + step };
            if let Found::Assembled(there) = self.along(&last, next)? {
                if is_last {
                    return Ok(Walked::Arrived(there));
                }
                // Where motions touch, the square root of the determinant is proportional to the distance.
                let [one, other] = [&last, &there].map(|sample| sample.determinant(index).sqrt());
                let distance = (step * (other / (other - one))).abs();
                let longest = (distance * real(LONGEST)).max(shortest);
                let double = step * real(2.0);
                step = if longest < double.abs() { longest.copysign(step) } else { double };
                (last, unbuildable) = (there, to);
            } else {
                unbuildable = next;
                step = (next - last.input) * real(0.5);
                if step.abs() < shortest {
                    break;
                }
            }
        }
        Ok(Walked::Stuck(Stuck { last, unbuildable }))
    }

    /// The position at another input, from the tangent at a position, or from this itself if J is singular.
    pub(super) fn along(&self, from: &Sample<M>, input: M::Scalar) -> Result<Found<M>, PositionErrorOf<M>> {
        let pose = self.mechanism.pose_at(&from.position);
        let by_inputs = self.mechanism.jacobian_inputs(&pose);
        let by_input =
            by_inputs.columns().as_slice().get(self.place).copied().unwrap_or_else(|| self.mechanism.dims().0.zeros());
        let unknowns = M::unknowns(&from.position);
        let guess = match self.mechanism.solve_jacobian(&pose, &by_input) {
            Ok(slopes) => unknowns - slopes * (input - from.input),
            Err(_) => unknowns,
        };
        self.at(&M::with_unknowns(&from.position, guess), input)
    }
}
