//! Certified motions: a proof that a motion exists, is one, and has no singular position, in doubles.
//!
//! - [`turn`] and [`range`] certify a motion as a function of its input: for each value of the input there is exactly one
//!   position in a tube about the motion, the determinant of J is not zero in the whole tube, and the tubes meet. After a
//!   full turn the motion is closed, or arrives at another position given, or neither ([`End`]). Wheels are at their start
//!   again after full turns of all together ([`Certify::repeats`]).
//! - [`curve`] certifies a motion as a curve through dead points of the input, which it encloses, until it is at its start
//!   again.
//! - [`Certificate::quantities`] and [`Certificate::velocity_ratios`] enclose smallest and largest values over the whole
//!   motion, such as those of a transmission angle that is declared as an output. [`Certificate::quantity_on_turns`] does so for
//!   an angle by `atan2` that goes on at pi.
//! - [`Certificate::joint_ranges`] and [`Curve::joint_ranges`] prove that the motion keeps the ranges that the mechanism declares,
//!   or leaves one.
//! - [`Certify`] has the options: the moving input, tolerances of parameters, other positions, the bound of the work. With
//!   tolerances all of this holds for every mechanism whose parameters are within them.
//!
//! A motion that cannot be certified is an error that says why ([`CertifyError`]). At a change point, where motions cross,
//! there are two positions in every box, and no certificate; near one the boxes become small: those of a turn of a
//! parallelogram 3-1-3-(1 + e) are 19, 29, 52 and 74 for e = 1e-1, 1e-2, 1e-4 and 1e-6.
//!
//! # What is trusted
//!
//! A certificate depends on the emitted formulas of Psi and of the quantities, on IEEE arithmetic, and on the functions of
//! [`Interval`]. It does not depend on Newton's method, on floats that approximate the motion, nor on the emitted J, A and
//! gamma: all derivatives come from Psi itself, by [`Series`]. The emitted ones are compared with them at the end of every
//! tube, and an error says so if they differ. Loops that are declared as implied are not part of Psi, and not of the
//! proof.
//!
//! # Method
//!
//! About a position in the middle of a step the motion is p(s) = q + s w + s^2 a / 2 in floats. Taylor's theorem over
//! intervals bounds Psi(p(s)) with a width of order s^3, and one test of Krawczyk bounds the distance of the motion from
//! p(s), for all s of the step together. The box of the position at the end of a step is inside both tubes that meet
//! there; being the one position in each, it joins them. The step grows after a tube and shrinks after a failed test.
//! With tolerances the mean-value theorem in the parameters keeps the tubes as narrow as the motions that they contain.
//!
//! Sources: R. Krawczyk, "Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken", Computing 4 (1969);
//! S. M. Rump, "Verification methods: rigorous results using floating-point arithmetic", Acta Numerica 19 (2010);
//! A. Guillemot, P. Lairez, "Validated numerics for algebraic path tracking", ISSAC 2024 (arXiv 2401.17973).

mod certificate;
mod circuits;
mod curve;
mod dead_point;
mod error;
mod expansion;
mod extremes;
mod jet;
mod joint_ranges;
mod motion;
mod on_turns;
mod reason;
mod system;
mod tube;
mod turn;
mod turned;
mod unwound;

use linkage_runtime::{Certifiable, Column};

pub use certificate::{Certificate, End};
pub use curve::Curve;
pub use dead_point::DeadPoint;
pub use error::{CertifyError, CertifyErrorOf};
pub use extremes::Enclosure;
pub use joint_ranges::{CertifiedRange, RangeProof};

use crate::Interval;
pub use crate::series::Series;
use system::System;

/// The most tests of tubes. A turn takes tens, one that passes a singularity at 1e-6 about a hundred.
const MOST_TESTS: usize = 20_000;

/// The options of certificates; [`turn`], [`range`] and [`curve`] are those without options.
#[derive(Debug, Clone)]
pub struct Certify<'a, M: Certifiable> {
    mechanism: &'a M,
    input: usize,
    turns: u32,
    parameters: Column<Interval, <M as Certifiable>::P>,
    positions: Vec<M::Coordinates>,
    most_tests: usize,
}

impl<'a, M: Certifiable> Certify<'a, M> {
    /// Certifies motions by the first input, with exact parameters.
    #[must_use]
    pub fn new(mechanism: &'a M) -> Self {
        let parameters = mechanism.parameters().map(Interval::from);
        Self { mechanism, input: 0, turns: 1, parameters, positions: Vec::new(), most_tests: MOST_TESTS }
    }

    /// Moves the input with this index, by default the first; the others stay at those of the start.
    #[must_use]
    pub fn input(mut self, index: usize) -> Self {
        self.input = index;
        self
    }

    /// The number of full turns of [`turn`](Self::turn), by default 1. A motion that arrives at another position may be
    /// closed after several, and with wheels the formulas repeat only then.
    #[must_use]
    pub fn turns(mut self, turns: u32) -> Self {
        self.turns = turns;
        self
    }

    /// Certifies all mechanisms whose parameters are in these intervals, which contain those of the mechanism.
    #[must_use]
    pub fn parameters(mut self, parameters: Column<Interval, <M as Certifiable>::P>) -> Self {
        self.parameters = parameters;
        self
    }

    /// Certifies all mechanisms whose parameters differ from those of the mechanism by at most this part of each.
    #[must_use]
    pub fn tolerance(self, relative: f64) -> Self {
        let around = |value: f64| Interval::around(value, (relative * value).abs()).unwrap_or(Interval::ENTIRE);
        let parameters = self.mechanism.parameters().map(around);
        self.parameters(parameters)
    }

    /// Other positions at the inputs of the start, at which a motion may arrive after a turn.
    #[must_use]
    pub fn positions(mut self, positions: impl IntoIterator<Item = M::Coordinates>) -> Self {
        self.positions = positions.into_iter().collect();
        self
    }

    /// The most tests of tubes, by default 20 000.
    #[must_use]
    pub fn most_tests(mut self, most: usize) -> Self {
        self.most_tests = most;
        self
    }

    /// True if Psi is the same, at all positions, after these full turns of the unknowns and the inputs: the motion that
    /// arrives there is at its start again.
    ///
    /// Angles with sines only repeat each by itself, those of wheels together: `psi = -theta / 2` after two turns of
    /// theta and minus one of psi. Where a ratio is one of parameters, their doubles are taken as they are: 0.3 / 0.1 is
    /// not 3. If parameters have tolerances, the same turns must repeat for all their values. Points and outputs may
    /// differ: an output may be the angle itself.
    #[must_use]
    pub fn repeats(&self, unknowns: &Column<i64, M::U>, inputs: &Column<i64, M::V>) -> bool {
        turned::repeats(self.mechanism, &self.parameters, unknowns, inputs)
    }

    fn invalid(&self, what: &'static str) -> CertifyErrorOf<M> {
        CertifyError::Invalid { mechanism: self.mechanism.name(), what }
    }

    fn system(&self, start: &M::Coordinates) -> Result<System<M>, CertifyErrorOf<M>> {
        let mut users = self.mechanism.groups().enumerate().filter_map(|(place, group)| {
            let function = self.mechanism.user_function(place)?;
            Some(CertifyError::UserFunction { mechanism: self.mechanism.name(), group: group.name, function })
        });
        if let Some(error) = users.next() {
            return Err(error);
        }
        System::new(self.mechanism, start, self.input, self.parameters)
    }
}

/// Certifies one full turn of the first input: [`Certify::turn`] without options.
///
/// # Errors
/// Those of [`Certify::turn`].
pub fn turn<M: Certifiable>(mechanism: &M, start: &M::Coordinates) -> Result<Certificate<M>, CertifyErrorOf<M>> {
    Certify::new(mechanism).turn(start)
}

/// Certifies the motion up to another value of the first input: [`Certify::range`] without options.
///
/// # Errors
/// Those of [`Certify::range`].
pub fn range<M: Certifiable>(
    mechanism: &M,
    start: &M::Coordinates,
    to: f64,
) -> Result<Certificate<M>, CertifyErrorOf<M>> {
    Certify::new(mechanism).range(start, to)
}

/// Certifies the motion through a position as a closed curve: [`Certify::curve`] without options.
///
/// # Errors
/// Those of [`Certify::curve`].
pub fn curve<M: Certifiable>(mechanism: &M, start: &M::Coordinates) -> Result<Curve<M>, CertifyErrorOf<M>> {
    Certify::new(mechanism).curve(start)
}
