//! Certified motions.
mod certificate;
mod curve;
mod dead_point;
mod error;
mod extremes;
mod expansion;
mod jet;
mod matrix;
mod motion;
mod series;
mod system;
mod tube;
mod turn;

use linkage_runtime::{Certifiable, Column};

pub use certificate::{Certificate, End};
pub use curve::Curve;
pub use dead_point::DeadPoint;
pub use error::CertifyError;
pub use extremes::Enclosure;
pub use series::Series;
pub use tube::Tube;

use crate::Interval;
use system::System;

/// The most tests of tubes.
const MOST_BOXES: usize = 20_000;

/// Certifies motions of a mechanism.
#[derive(Debug, Clone)]
pub struct Certify<'a, M: Certifiable> {
    mechanism: &'a M,
    input: usize,
    turns: u32,
    parameters: Column<Interval, <M as Certifiable>::P>,
    positions: Vec<M::Coordinates>,
    most_boxes: usize,
}

impl<'a, M: Certifiable> Certify<'a, M> {
    /// Certifies motions by the first input, with exact parameters.
    #[must_use]
    pub fn new(mechanism: &'a M) -> Self {
        let parameters = mechanism.parameters().map(Interval::from);
        Self { mechanism, input: 0, turns: 1, parameters, positions: Vec::new(), most_boxes: MOST_BOXES }
    }

    /// Moves the input with this index; the others stay at those of the start.
    #[must_use]
    pub fn input(mut self, index: usize) -> Self {
        self.input = index;
        self
    }

    /// The number of turns of the input: those after which the formulas of gears repeat, for instance.
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

    /// Other positions at the input of the start, at which a motion may arrive after a turn.
    #[must_use]
    pub fn positions(mut self, positions: impl IntoIterator<Item = M::Coordinates>) -> Self {
        self.positions = positions.into_iter().collect();
        self
    }

    /// The most tests of tubes, by default 20 000.
    #[must_use]
    pub fn most_boxes(mut self, most: usize) -> Self {
        self.most_boxes = most;
        self
    }

    fn invalid(&self, what: &'static str) -> CertifyError {
        CertifyError::Invalid { mechanism: M::NAME, what }
    }

    fn system(&self, start: &M::Coordinates) -> Result<System<M>, CertifyError> {
        let of_group = |(group, function): (&linkage_runtime::Group, &Option<&'static str>)| {
            function.map(|function| CertifyError::UserFunction { mechanism: M::NAME, group: group.name, function })
        };
        if let Some(error) = M::GROUPS.iter().zip(M::USER_FUNCTIONS).find_map(of_group) {
            return Err(error);
        }
        System::new(self.mechanism, start, self.input, self.parameters.as_slice())
    }
}

/// Certifies one full turn of the first input: [`Certify::turn`] without options.
///
/// # Errors
/// Those of [`Certify::turn`].
pub fn turn<M: Certifiable>(mechanism: &M, start: &M::Coordinates) -> Result<Certificate<M>, CertifyError> {
    Certify::new(mechanism).turn(start)
}

/// Certifies the motion up to another value of the first input: [`Certify::range`] without options.
///
/// # Errors
/// Those of [`Certify::range`].
pub fn range<M: Certifiable>(mechanism: &M, start: &M::Coordinates, to: f64) -> Result<Certificate<M>, CertifyError> {
    Certify::new(mechanism).range(start, to)
}

/// Certifies the motion through a position as a closed curve: [`Certify::curve`] without options.
///
/// # Errors
/// Those of [`Certify::curve`].
pub fn curve<M: Certifiable>(mechanism: &M, start: &M::Coordinates) -> Result<Curve<M>, CertifyError> {
    Certify::new(mechanism).curve(start)
}
