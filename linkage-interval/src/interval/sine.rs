//! Sine, cosine and tangent.
//!
//! Up to 1e5 the sines and cosines of bounds are those of the runtime, whose relative error has the proven bound
//! `SINE_ERROR`; between the bounds of an argument the functions are monotone or pass an extremum. Beyond 1e5 sine and
//! cosine are in [-1, 1], and of a tangent nothing is known.

use std::f64::consts::PI;

use linkage_runtime::__shared::SINE_ERROR;
use linkage_runtime::{Number, Real};

use super::Interval;

/// The largest magnitude of an angle, in radians, for which `SINE_ERROR` holds.
const LIMIT: f64 = 1e5;

impl Interval {
    pub(super) fn sine_of(self) -> Self {
        self.wave(Real::sine, 1.0)
    }

    pub(super) fn cosine_of(self) -> Self {
        self.wave(Real::cosine, 0.0)
    }

    /// A sine or cosine, whose maximum is at `quarters` pi/2.
    fn wave(self, function: impl Fn(f64) -> f64, quarters: f64) -> Self {
        const ALL: Interval = Interval { least: -1.0, most: 1.0 };
        if self.magnitude() > LIMIT {
            return ALL;
        }
        let turns = self / (Self::pi() * Self::exactly(0.5));
        let [one, other] = [self.least, self.most].map(|bound| Self::near_result(function(bound), SINE_ERROR));
        let Self { least, most } = one.hull(other);
        let least = if turns.has_fourth_integer(quarters + 2.0) { -1.0 } else { least.max(-1.0) };
        let most = if turns.has_fourth_integer(quarters) { 1.0 } else { most.min(1.0) };
        Self { least, most }
    }

    /// True if one of the numbers is `first` plus a multiple of four. The difference is rounded, which moves it beyond no
    /// integer.
    fn has_fourth_integer(self, first: f64) -> bool {
        let next = ((self.least - first) / 4.0).ceil();
        4.0 * next + first <= self.most
    }

    /// All real numbers if there is a pole between the bounds: the cosine changes its sign.
    pub(super) fn tangent(self) -> Self {
        if self.magnitude() > LIMIT || self.width() > PI {
            return Self::ENTIRE;
        }
        let of = |bound: f64| {
            let [sine, cosine] =
                [Real::sine(bound), Real::cosine(bound)].map(|value| Self::near_result(value, SINE_ERROR));
            (sine / cosine, cosine.least > 0.0)
        };
        let ((one, is_right), (other, is_still_right)) = (of(self.least), of(self.most));
        if is_right == is_still_right { Self { least: one.least, most: other.most } } else { Self::ENTIRE }
    }
}
