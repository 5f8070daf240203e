//! Bounds of guards between two samples, from how much they can change near these.
//!
//! In a step the state is a polynomial, and a guard of which [changes](System::guard_changes) are known is analytic. If it
//! changes by at most C while the fraction of the step moves by at most R from a place, in any complex direction, its Taylor
//! coefficients there are at most C / R^k (Cauchy's estimate). Around the middle of a part of the step, at a distance d from this place,
//! they are at most C / (R - d)^k. Between the ends of the part, r = s (R - d) from its middle, the fourth derivative is then at most
//! 24 C / ((R - d)^4 (1 - s)^5), and the cubic with the values and rates at both ends has an error of at most 16 E x^2 (1 - x)^2 with
//! E = C s^4 / (1 - s)^5, where x runs from 0 to 1.

use super::sampled::SampledStep;
use super::system::{StateOf, System};
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Build, Column, Dim, real};

/// R / r for the middle of a part. The cubic of the sine of an angle that moves by 2 d in a part has an error of d^4 / 24, and the
/// change e^(d R / r) - 1: the bound is 13 times the error if the angle moves by a quarter radian.
const RADIUS: f64 = 16.0;

/// A guard in the complex plane of the fractions of a step: its largest change from its value at the middle of a disc.
#[derive(Debug, Clone, Copy)]
struct Disc {
    middle: f64,
    radius: f64,
    change: f64,
}

impl Disc {
    /// The bound E of the error of the cubic through the ends of a part.
    fn error(&self, [from, to]: [f64; 2]) -> f64 {
        let off = (0.5 * (from + to) - self.middle).abs();
        let s = 0.5 * (to - from) / (self.radius - off);
        if !(s > 0.0 && s < 1.0) {
            return f64::INFINITY;
        }
        let (square, rest) = (s * s, 1.0 - s);
        self.change * square * square / (rest * rest * rest * rest * rest)
    }
}

/// The best disc of each guard for a part of a step, None where no bound is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Discs<C: Dim> {
    of: Column<Option<Disc>, C>,
    /// True if smaller ones bound nothing better.
    is_settled: bool,
}

/// A number for each guard; None where no bound is known.
pub(super) type Bounds<S> = Column<Option<f64>, <S as System>::Guards>;

impl<C: Dim> Discs<C> {
    /// No disc for any guard.
    pub(super) fn none(guards: C) -> Self {
        Self { of: guards.repeat(None), is_settled: false }
    }

    /// The bounds E of the errors of the cubics through the ends of a part, where they are larger than what is tolerated.
    pub(super) fn errors(&self, part: [f64; 2], tolerated: &Column<Option<f64>, C>) -> Column<Option<f64>, C> {
        tolerated.dim().column(|place| {
            let error = self.of[place].map_or(f64::INFINITY, |disc| disc.error(part));
            tolerated[place].filter(|&tolerated| error > tolerated).map(|_| error)
        })
    }
}

impl<S: System> SampledStep<'_, S> {
    /// The change of each guard while the state moves by so much or less; infinite where there is no bound at this state.
    pub(super) fn changes(system: &mut S, y: &StateOf<S>, moves: &StateOf<S>) -> Bounds<S> {
        let finite = |change: f64| if change >= 0.0 { change } else { f64::INFINITY };
        system.guard_changes(y, moves).map(|change| change.map(|change| finite(to_f64(change))))
    }

    /// The best discs for a part, from those of a larger one.
    pub(super) fn discs(&mut self, part: [f64; 2], known: &Discs<S::Guards>) -> Discs<S::Guards> {
        let errors = known.errors(part, &self.tolerated);
        if known.is_settled || errors.iter().all(|error| error.is_none()) {
            return *known;
        }
        let middle = 0.5 * (part[0] + part[1]);
        let y = self.step.at_fraction(real(middle));
        let changes = Self::changes(self.system, &y, &self.step.moves(part, RADIUS));
        let radius = 0.5 * RADIUS * (part[1] - part[0]);
        let mut discs = Discs { is_settled: true, ..*known };
        for (place, error) in errors.iter().enumerate() {
            let (Some(error), Some(change)) = (*error, changes[place]) else { continue };
            let disc = Disc { middle, radius, change };
            if error == f64::INFINITY || disc.error(part) < error {
                discs.of[place] = Some(disc);
                discs.is_settled = false;
            }
        }
        discs
    }
}
