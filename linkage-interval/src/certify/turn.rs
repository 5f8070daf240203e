//! Motions as functions of the input.

use linkage_runtime::{Certifiable, Number};

use super::certificate::{Certificate, End, Moved};
use super::error::{CertifyError, CertifyErrorOf};
use super::motion::{Motion, certified_position};
use super::reason::no_position;
use super::system::System;
use super::{Certify, curve};
use crate::Interval;

impl<M: Certifiable> Certify<'_, M> {
    /// Certifies the motion over full turns of the input, one unless [`turns`](Self::turns) says otherwise.
    ///
    /// # Errors
    /// [`CertifyError::DeadPoint`] if the input turns back, and the others of [`CertifyError`].
    pub fn turn(&self, start: &M::Coordinates) -> Result<Certificate<M>, CertifyErrorOf<M>> {
        if self.turns == 0 {
            return Err(self.invalid("the number of turns"));
        }
        if self.mechanism.input_angles().get(self.input) == Some(&false) {
            return Err(CertifyError::NoTurn { mechanism: self.mechanism.name() });
        }
        let from = self.start_input(start)?;
        let turns = i64::from(self.turns);
        let to = Interval::from(from) + (Interval::pi() + Interval::pi()) * Interval::from(f64::from(self.turns));
        let mut certificate = self.over_inputs(start, from, to)?;
        certificate.end = self.end(&certificate, turns);
        Ok(certificate)
    }

    /// Certifies the motion from the start to another value of the input.
    ///
    /// # Errors
    /// [`CertifyError::DeadPoint`] if the input turns back before, and the others of [`CertifyError`].
    pub fn range(&self, start: &M::Coordinates, to: f64) -> Result<Certificate<M>, CertifyErrorOf<M>> {
        let from = self.start_input(start)?;
        if !to.is_finite() || to == from {
            return Err(self.invalid("the range of the input"));
        }
        self.over_inputs(start, from, to.into())
    }

    fn start_input(&self, start: &M::Coordinates) -> Result<f64, CertifyErrorOf<M>> {
        M::parts(start).1.iter().nth(self.input).copied().ok_or_else(|| self.invalid("the index of the input"))
    }

    fn over_inputs(
        &self,
        start: &M::Coordinates,
        from: f64,
        to: Interval,
    ) -> Result<Certificate<M>, CertifyErrorOf<M>> {
        let system = self.system(start)?;
        let input = system.count();
        let guess = system.position(start).ok_or_else(|| self.invalid("the start"))?;
        self.check_emitted(&system, &guess)?;
        let first = certified_position(&system, input, &guess).ok_or_else(|| no_position(&system, &guess))?;
        let (direction, end) = if to.middle() > from { (1.0, to.most()) } else { (-1.0, to.least()) };
        let mut motion = Motion::new(&system, first.clone(), self.most_tests);
        while motion.input().middle() != end {
            match motion.advance(input, direction, Some(end), 0.0) {
                Err(error @ (CertifyError::Singular { .. } | CertifyError::Undecided { .. })) => {
                    return Err(curve::dead_point_ahead(&motion, direction).unwrap_or(error));
                }
                result => result?,
            }
            self.check_emitted_at(&motion)?;
        }
        let (tubes, tests) = (motion.tubes, motion.tests);
        let inputs = Interval::from(from).hull(end.into());
        Ok(Certificate { system, tubes, end: End::Open, tests, inputs, start: first })
    }

    /// The first position, of the start and those given, that is at the end of full turns.
    fn end(&self, certificate: &Certificate<M>, turns: i64) -> End {
        let Certificate { system, tubes, start, .. } = certificate;
        let Some(last) = tubes.last() else { return End::Open };
        let reached = |position: &[Interval]| {
            let moved = Moved::into_tube(system, last, position)?;
            (moved.input_turns == turns).then_some(moved.turns)
        };
        if let Some(turns) = reached(start) {
            return End::Closed { turns };
        }
        let mut others = self.positions.iter().enumerate().filter_map(|(position, coordinates)| {
            let guess = system.position(coordinates)?;
            // At the start input only.
            let is_at_start = guess.last().copied() == start.last().map(|input| input.middle());
            let other = is_at_start.then(|| certified_position(system, system.count(), &guess))??;
            Some(End::Arrives { position, turns: reached(&other)? })
        });
        others.next().unwrap_or(End::Open)
    }
}

impl<M: Certifiable> Certify<'_, M> {
    /// Compares the emitted derivatives with those of Psi at the end of a motion.
    pub(super) fn check_emitted_at(&self, motion: &Motion<'_, M>) -> Result<(), CertifyErrorOf<M>> {
        motion.system.check_emitted(&motion.joint)
    }

    pub(super) fn check_emitted(&self, system: &System<M>, guess: &[f64]) -> Result<(), CertifyErrorOf<M>> {
        let point: Vec<Interval> = guess.iter().map(|&x| x.into()).collect();
        system.check_emitted(&point)
    }
}
