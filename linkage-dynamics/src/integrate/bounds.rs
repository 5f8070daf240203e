//! Bounds of guards between two samples, from how much they can change near these.
//!
//! In a step the state is a polynomial, and a guard of which [changes](System::guard_changes) are known is analytic. If it
//! changes by at most C while the fraction of the step moves by at most R from the middle of a part, in any complex direction, its
//! Taylor coefficients are at most C / R^k (Cauchy's estimate). Between the ends of the part, at a distance of r = s R, its fourth
//! derivative is then at most 24 C / (R^4 (1 - s)^5), and the cubic with its values and rates at both ends has an error of at most
//! 16 E x^2 (1 - x)^2 with E = C s^4 / (1 - s)^5, where x runs from 0 to 1.

use super::sampled::SampledStep;
use super::system::{StateOf, System};
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Column, real};

/// R / r. The cubic of the sine of an angle that moves by 2 d in a part has an error of d^4 / 24, and the change e^(d R / r) - 1: the
/// bound is 13 times the error if the angle moves by a quarter radian.
const RADIUS: f64 = 16.0;

/// s^4 / (1 - s)^5
const ERROR: f64 = {
    let (s, rest) = (1.0 / RADIUS, 1.0 - 1.0 / RADIUS);
    s * s * s * s / (rest * rest * rest * rest * rest)
};

/// A number for each guard; None where no bound is known.
pub(super) type Bounds<S> = Column<Option<f64>, <S as System>::Guards>;

impl<S: System> SampledStep<'_, S> {
    /// The change of each guard while the state moves by so much or less; infinite where there is no bound at this state.
    pub(super) fn changes(system: &mut S, y: &StateOf<S>, moves: &StateOf<S>) -> Bounds<S> {
        let finite = |change: f64| if change >= 0.0 { change } else { f64::INFINITY };
        system.guard_changes(y, moves).map(|change| change.map(|change| finite(to_f64(change))))
    }

    /// The bounds E of the errors of the cubics through the ends of a part, of those guards where it is not tolerated.
    pub(super) fn errors(&mut self, part: [f64; 2]) -> Bounds<S> {
        if self.tolerated.iter().all(|bound| bound.is_none()) {
            return self.tolerated;
        }
        let middle = self.step.at_fraction(real(0.5 * (part[0] + part[1])));
        let changes = Self::changes(self.system, &middle, &self.step.moves(part, RADIUS));
        changes.zip_map(&self.tolerated, |change, tolerated| {
            let (error, tolerated) = (ERROR * change?, tolerated?);
            (error > tolerated).then_some(error)
        })
    }
}
