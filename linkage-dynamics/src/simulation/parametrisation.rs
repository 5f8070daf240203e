//! Choice of independent coordinates before each step: the inputs, or others where J is nearly singular. Through a
//! change point, where no choice is regular, the motion goes on its [sheet](super::sheet).
//!
//! The regularity of the inputs is the least of those of the groups, |det| of its block of J divided by the largest
//! value it can take; that of other coordinates is their smallest pivot of [J A].

use super::change_point::Ahead;
use super::data::{AtSingularity, Signs, Simulation};
use super::frame::Change;
use super::independent::{Choice, Independent};
use super::motion::{Motion, Parametrisation, ParametrisationOf};
use super::sheet::Sheet;
use super::watch::Watch;
use crate::integrate::{Method, Tolerance};
use crate::{MotionErrorOf, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::{same_signs, to_f64};
use linkage_runtime::jacobian::Blocks;
use linkage_runtime::{Dim, Mechanism, PerInput, real};

/// Below this regularity of the inputs other coordinates are used: two links of a dyad are then within 6 degrees of a
/// line. At twice this value all simulation tests pass; at half of it that of an engine driven by its piston fails.
const LEAVE_INPUTS_BELOW: f64 = 0.1;

/// Above this regularity of the inputs they are used again. It is larger than [`LEAVE_INPUTS_BELOW`], so that the
/// choice does not alternate.
const RETURN_TO_INPUTS_ABOVE: f64 = 0.2;

/// Below this regularity of the inputs the determinants of the groups are extrapolated to find a singularity ahead.
const WATCH_BELOW: f64 = 0.8;

/// The distance ahead in which a singularity is searched, as the largest change of a coordinate: in radians, or divided
/// by the scale of its length. At half of it all simulation tests pass.
const LOOK_AHEAD: f64 = 0.7;

/// Coordinates other than the inputs are changed if another choice has this many times their regularity. At half this
/// value all simulation tests pass; at twice one fails, of cranks that only come near a change point.
const IMPROVEMENT: f64 = 3.0;

/// The number of steps to stay in other coordinates where the next step in the inputs might pass a singularity, unless
/// it is passed sooner.
pub(super) const STEPS_BEFORE_RETURN: u32 = 16;

/// Below this regularity of the other coordinates the tangent of the motion is only rounding error.
const LEAST_REGULARITY: f64 = 1e-7;

impl<S: Scene, M: Method, W: Watch<S>> Simulation<'_, S, M, W> {
    /// Looks for singularities ahead and chooses the coordinates of the next step.
    pub(super) fn prepare(&mut self) -> Result<(), MotionErrorOf<S>> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let before = self.from.0;
        self.from = (t, y);
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let pose = mechanism.pose_at(&motion.scene.parts_of(&y).q);
        let blocks = Blocks::of(mechanism, &pose);
        let (regularity, _) = blocks.least_regular();
        let determinants = *blocks.determinants();
        match &motion.parametrisation {
            Parametrisation::Inputs
                if regularity < real(LEAVE_INPUTS_BELOW) && self.at_singularity == AtSingularity::Pass =>
            {
                self.leave_inputs()
            }
            Parametrisation::Inputs => {
                let time_left = self.time_to_singularity(t - before, &determinants);
                self.signs = determinants;
                let is_watched = regularity < real(WATCH_BELOW) && self.at_singularity == AtSingularity::Pass;
                if let Some(time) = time_left.filter(|_| is_watched) {
                    self.prepare_for_singularity(time)
                } else {
                    Ok(())
                }
            }
            Parametrisation::Over(sheet) if !motion.leaves(sheet, &y) => self.go_on(),
            _ if regularity > real(RETURN_TO_INPUTS_ABOVE) && self.is_past(&determinants) => {
                let Change::<S> { inputs, .. } = motion.velocity(&y)?;
                self.steps_before_return = 0;
                self.signs = determinants;
                self.exchange(Parametrisation::Inputs, &inputs);
                Ok(())
            }
            &Parametrisation::Others(independent) | &Parametrisation::Over(Sheet { independent, .. }) => {
                self.stay(independent)
            }
        }
    }

    /// The time until the determinant of a group is zero, by linear extrapolation of the last step, of the duration
    /// `last`.
    fn time_to_singularity(&self, last: S::Scalar, determinants: &Signs<S>) -> Option<f64> {
        let groups = self.signs.iter().zip(determinants);
        let falling = groups.filter(|(before, now)| now.abs() < before.abs());
        falling
            .map(|(&before, &now)| to_f64(now / (before - now) * last).abs())
            .reduce(|a, b| if a < b { a } else { b })
    }

    /// Prepares for a singularity of the inputs expected after `time`.
    fn prepare_for_singularity(&mut self, time: f64) -> Result<(), MotionErrorOf<S>> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let velocity = motion.velocity(&y)?;
        let is_near = time * to_f64(motion.scaled_norm(&velocity)) < LOOK_AHEAD;
        let is_next = self.integration.next_length().is_some_and(|next| time < 2.0 * next);
        if !(is_near || is_next) {
            return Ok(());
        }
        let q = motion.scene.parts_of(&y).q;
        let independent =
            Independent::choose(mechanism, &mechanism.pose_at(&q), &motion.scales, &motion.prescribed_inputs(t));
        let rates = independent.of(&velocity);
        let ahead =
            motion.change_point_ahead(&independent, &motion.pack(&q, &rates), self.direction(), real(self.relative));
        match ahead {
            Ahead::Sheet(sheet) => self.exchange(Parametrisation::Over(sheet), &rates),
            Ahead::Near(length) => self.integration.limit_next(to_f64(length)),
            Ahead::Clear if is_next => {
                self.steps_before_return = STEPS_BEFORE_RETURN;
                self.exchange(Parametrisation::Others(independent), &rates);
            }
            Ahead::Clear => {}
        }
        Ok(())
    }

    /// 1 or -1, the direction of time.
    fn direction(&self) -> S::Scalar {
        if self.integration.end() < self.integration.t() { -S::Scalar::one() } else { S::Scalar::one() }
    }

    /// Returns true if the simulation may return to the inputs: the singularity is passed, or was not reached in time.
    fn is_past(&self, signs: &Signs<S>) -> bool {
        self.steps_before_return == 0 || !same_signs(self.signs.as_slice(), signs.as_slice())
    }

    /// Changes to other coordinates, those with the largest pivots.
    pub(super) fn leave_inputs(&mut self) -> Result<(), MotionErrorOf<S>> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let pose = mechanism.pose_at(&motion.scene.parts_of(&y).q);
        let independent = Independent::choose(mechanism, &pose, &motion.scales, &motion.prescribed_inputs(t));
        let rates = independent.of(&motion.velocity(&y)?);
        self.exchange(Parametrisation::Others(independent), &rates);
        self.look_ahead(independent)
    }

    /// Stays on the sheet, moved to the current position: nodes are found from near ones.
    fn go_on(&mut self) -> Result<(), MotionErrorOf<S>> {
        let y = *self.integration.state();
        let motion = self.integration.system();
        let Parametrisation::Over(sheet) = &motion.parametrisation else { return Ok(()) };
        if motion.dims().1.count() == 1 {
            return Ok(());
        }
        let (q, rates) = motion.unpack(&y);
        let z = sheet.independent.of(&Motion::<S, W>::column(&q));
        if let Some(moved) = motion.sheet_through(sheet, &z, &sheet.reach) {
            self.set(Parametrisation::Over(moved), &rates);
        }
        Ok(())
    }

    /// Counts a change point that the last step has passed, to this state.
    pub(super) fn count_passage(&mut self, y: &StateColumn<S>) {
        let motion = self.integration.system();
        let Parametrisation::Over(sheet) = &motion.parametrisation else { return };
        let pivots = motion.factors(&sheet.independent, &motion.scene.parts_of(y).q).pivots();
        let is_beyond = sheet.is_beyond(&pivots);
        if is_beyond != core::mem::replace(&mut self.is_beyond, is_beyond) {
            self.passages.change_points += 1;
        }
    }

    /// Keeps the current coordinates, or changes to better ones.
    fn stay(&mut self, mut independent: Choice<S>) -> Result<(), MotionErrorOf<S>> {
        self.steps_before_return = self.steps_before_return.saturating_sub(1);
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let (q, mut rates) = motion.unpack(&y);
        let pose = mechanism.pose_at(&q);
        let factors = independent.factors(mechanism, &pose, &motion.scales);
        independent.pivots = factors.pivots();
        // Where the current choice is singular, its rates do not determine the others, not even those of a better one.
        if independent.regularity().is_zero() {
            return Err(motion.no_coordinates_error(t, &q));
        }
        let best = Independent::choose(mechanism, &pose, &motion.scales, &motion.prescribed_inputs(t));
        if best.regularity() > independent.regularity() * real(IMPROVEMENT) {
            (rates, independent) = (best.of(&factors.rates(&rates)), best);
            self.passages.exchanges += 1;
        }
        self.set(Parametrisation::Others(independent), &rates);
        self.look_ahead(independent)
    }

    /// Goes on the sheet through a change point if one is near.
    fn look_ahead(&mut self, independent: Choice<S>) -> Result<(), MotionErrorOf<S>> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        match motion.change_point_ahead(&independent, &y, self.direction(), real(self.relative)) {
            Ahead::Sheet(sheet) => self.exchange(Parametrisation::Over(sheet), &motion.unpack(&y).1),
            _ if independent.regularity() < real(LEAST_REGULARITY) => {
                return Err(motion.no_coordinates_error(t, &motion.scene.parts_of(&y).q));
            }
            Ahead::Near(length) => self.integration.limit_next(to_f64(length)),
            Ahead::Clear => {}
        }
        Ok(())
    }

    /// Changes to a parametrisation with these rates of its independent coordinates, and counts the change.
    fn exchange(&mut self, parametrisation: ParametrisationOf<S>, rates: &PerInput<S::Mechanism>) {
        self.passages.exchanges += 1;
        self.is_beyond = false;
        self.set(parametrisation, rates)
    }

    fn set(&mut self, parametrisation: ParametrisationOf<S>, rates: &PerInput<S::Mechanism>) {
        let q = self.integration.system().scene.parts_of(self.integration.state()).q;
        self.integration.system_mut().parametrisation = parametrisation;
        let y = self.integration.system().pack(&q, rates);
        let scale = scale_of(self.integration.system(), self.frequency);
        // It cannot fail: the tolerance is unchanged, and the new scales are positive too.
        if let Ok(tolerance) = Tolerance::new(self.relative, scale) {
            self.integration.set_tolerance(tolerance);
        }
        self.integration.exchange(y);
        // A repeated step begins in these coordinates.
        self.from.1 = y;
    }
}

/// The scales of the components of y: those of the coordinates, and for rates these times `frequency`.
pub(super) fn scale_of<S: Scene, W>(motion: &Motion<'_, S, W>, frequency: S::Scalar) -> StateColumn<S> {
    let scales = &motion.scales.coordinates;
    let scale = S::Mechanism::coordinates(scales.unknowns, scales.inputs);
    let rates = motion.parametrisation.independent().map_or(scales.inputs, |independent| independent.of(scales));
    motion.pack(&scale, &(rates * frequency))
}
