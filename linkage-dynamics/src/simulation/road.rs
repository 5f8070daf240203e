//! By which coordinates a simulation goes on: the inputs, others where they are singular, or straight over a change point.

use super::independent::Independent;
use super::motion::{Change, Choice, Motion, Polynomial, Road, RoadOf};
use super::over::Ahead;
use super::run::{Signs, Simulation};
use super::watch::Watch;
use crate::integrate::{Method, Tolerance};
use crate::{MotionError, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::{same_signs, to_f64};
use linkage_runtime::jacobian::Blocks;
use linkage_runtime::{Column, Mechanism, PerInput, real};

/// Below this regularity of the inputs other coordinates are taken: two links are then within 6 degrees of a line. At
/// twice this value every test of simulations holds; at half of it that of an engine by its piston fails.
const LEAVE: f64 = 0.1;

/// Above this they are taken again.
const RETURN: f64 = 0.2;

/// Below this the determinants of the groups are watched.
const NEAR: f64 = 0.8;

/// How far ahead a singularity is looked for, in radians or as a part of the sizes of lengths. At half of it every test of
/// simulations holds.
const SIGHT: f64 = 0.7;

/// Another choice must be this much better to be taken. At half of it every test of simulations holds; at twice one
/// fails, of cranks that only come near a change point.
const BETTER: f64 = 3.0;

/// Steps in other coordinates after one in the inputs went over a singularity, if it is not met before.
pub(super) const WARNED: u32 = 16;

/// Nearer to a change point nothing is left of the tangent.
const NEAREST: f64 = 1e-7;

/// The regularity of all coordinates below which no step ends that begins at four times as much, about the angle in
/// radians that is left to the change point: a step over it from so near loses too many digits, the more the more groups
/// are singular there. Of 450 falls of 10, 20 and 40 windows at tolerances from 1e-12 to 1e-4 none stops, nor at half
/// this value or at twice it; at a quarter 5 do, and 48 where no step is taken back.
const CLEAR: f64 = 0.15;

/// What a simulation does where the inputs cannot drive the mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtSingularity {
    /// It goes on: in other coordinates at a dead point, straight on at a change point.
    #[default]
    Pass,
    /// It ends with [`PositionError::Singular`](linkage_runtime::PositionError::Singular).
    Stop,
}

/// What a simulation has met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Passages {
    /// Changes of the independent coordinates, those back to the inputs included.
    pub exchanges: usize,
    /// Change points passed.
    pub change_points: usize,
}

impl<S: Scene, M: Method, W: Watch<S>> Simulation<'_, S, M, W> {
    /// Looks where the next step may go, and takes the coordinates for it.
    pub(super) fn prepare(&mut self) -> Result<(), MotionError> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let before = self.from.0;
        self.from = (t, y);
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let pose = mechanism.pose_at(&S::parts(&y).0);
        let blocks = Blocks::of(mechanism, &pose);
        let (regularity, _) = blocks.weakest();
        let determinants = *blocks.determinants();
        match motion.road {
            Road::Inputs if regularity < real(LEAVE) && self.at_singularity == AtSingularity::Pass => {
                self.leave_inputs()
            }
            Road::Inputs => {
                let rest = self.rest(t - before, &determinants);
                self.signs = determinants;
                let is_watched = regularity < real(NEAR) && self.at_singularity == AtSingularity::Pass;
                if let Some(rest) = rest.filter(|_| is_watched) { self.watch(rest) } else { Ok(()) }
            }
            _ if regularity > real(RETURN) && self.is_past(&determinants) => {
                let Change::<S> { inputs, .. } = motion.velocity(t, &y)?;
                self.warned = 0;
                self.signs = determinants;
                self.take(Road::Inputs, &inputs);
                Ok(())
            }
            Road::Others(independent) | Road::Over(independent, _) => self.stay(independent),
        }
    }

    /// The time until the determinant of a group is zero, if it goes on as in the last step.
    fn rest(&self, last: S::Scalar, determinants: &Signs<S>) -> Option<f64> {
        let groups = self.signs.iter().zip(determinants);
        let falling = groups.filter(|(before, now)| now.abs() < before.abs());
        falling
            .map(|(&before, &now)| to_f64(now / (before - now) * last).abs())
            .reduce(|a, b| if a < b { a } else { b })
    }

    /// In the inputs, where they may soon be singular: a change point is passed from afar, as the step over it suffers
    /// the less from rounding the longer it is.
    fn watch(&mut self, rest: f64) -> Result<(), MotionError> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let velocity = motion.velocity(t, &y)?;
        let is_near = rest * to_f64(motion.size_of(&velocity)) < SIGHT;
        let is_next = self.integration.next_length().is_some_and(|next| rest < 2.0 * next);
        if !(is_near || is_next) {
            return Ok(());
        }
        let (q, _) = S::parts(&y);
        let independent = Independent::choose(mechanism, &mechanism.pose_at(&q), &motion.scales, &motion.held(t));
        let rates = independent.of(&velocity);
        let ahead = motion.over(&independent, (t, &Motion::<S, W>::pack(&q, &rates)), self.way(), self.relative())?;
        match ahead {
            Ahead::ChangePoint(step) => {
                self.take(Road::Others(independent), &rates);
                self.pass(independent, step);
            }
            Ahead::Near(length) => self.integration.limit_next(to_f64(length)),
            Ahead::Clear if is_next => {
                self.warned = WARNED;
                self.take(Road::Others(independent), &rates);
            }
            Ahead::Clear => {}
        }
        Ok(())
    }

    fn way(&self) -> S::Scalar {
        if self.integration.end() < self.integration.t() { -S::Scalar::one() } else { S::Scalar::one() }
    }

    fn relative(&self) -> S::Scalar {
        real(self.relative)
    }

    fn pass(&mut self, independent: Choice<S>, step: Polynomial<S>) {
        self.integration.system_mut().road = Road::Over(independent, step);
        self.integration.pass(step.up_to(self.integration.end()).unwrap_or(step));
        self.passages.change_points += 1;
    }

    /// Whether nothing speaks for staying in other coordinates: a singularity that was met is passed, or seems to be
    /// avoided.
    fn is_past(&self, signs: &Signs<S>) -> bool {
        self.warned == 0 || !same_signs(self.signs.as_slice(), signs.as_slice())
    }

    pub(super) fn leave_inputs(&mut self) -> Result<(), MotionError> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let pose = mechanism.pose_at(&S::parts(&y).0);
        let independent = Independent::choose(mechanism, &pose, &motion.scales, &motion.held(t));
        let rates = independent.of(&motion.velocity(t, &y)?);
        self.take(Road::Others(independent), &rates);
        self.look_ahead(independent)
    }

    /// True if a step ends just before what may be a change point, though it came from afar.
    pub(super) fn ends_too_near(&self, start: &StateColumn<S>, end: &StateColumn<S>) -> bool {
        if self.at_singularity == AtSingularity::Stop {
            return false;
        }
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let regularity = |y: &StateColumn<S>| {
            Independent::choose(mechanism, &mechanism.pose_at(&S::parts(y).0), &motion.scales, &Column::repeat(false))
                .regularity()
        };
        // At a change point some group is singular by its inputs too: where none is near that the rest is not looked at.
        let (by_inputs, _) = Blocks::of(mechanism, &mechanism.pose_at(&S::parts(end).0)).weakest();
        if by_inputs > real(2.0 * CLEAR) {
            return false;
        }
        let at_end = regularity(end);
        at_end < real(CLEAR) && at_end < regularity(start) * real(0.25)
    }

    /// In other coordinates than the inputs: still the same, or better ones.
    fn stay(&mut self, mut independent: Choice<S>) -> Result<(), MotionError> {
        self.warned = self.warned.saturating_sub(1);
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let (q, mut rates) = Motion::<S, W>::unpack(&y);
        let pose = mechanism.pose_at(&q);
        let factors = independent.factors(mechanism, &pose, &motion.scales);
        independent.pivots = factors.pivots();
        // At a singularity of the choice its rates do not tell the others.
        if independent.regularity().is_zero() {
            return Err(motion.cannot_go_on(t, &q));
        }
        let best = Independent::choose(mechanism, &pose, &motion.scales, &motion.held(t));
        if best.regularity() > independent.regularity() * real(BETTER) {
            (rates, independent) = (best.of(&factors.rates(&rates)), best);
            self.passages.exchanges += 1;
        }
        self.set(Road::Others(independent), &rates);
        self.look_ahead(independent)
    }

    /// Goes over a change point if one is near.
    fn look_ahead(&mut self, independent: Choice<S>) -> Result<(), MotionError> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        match motion.over(&independent, (t, &y), self.way(), self.relative())? {
            Ahead::ChangePoint(step) => self.pass(independent, step),
            _ if independent.regularity() < real(NEAREST) => return Err(motion.cannot_go_on(t, &S::parts(&y).0)),
            Ahead::Near(length) => self.integration.limit_next(to_f64(length)),
            Ahead::Clear => {}
        }
        Ok(())
    }

    fn take(&mut self, road: RoadOf<S>, rates: &PerInput<S::Mechanism>) {
        self.passages.exchanges += 1;
        self.set(road, rates)
    }

    fn set(&mut self, road: RoadOf<S>, rates: &PerInput<S::Mechanism>) {
        let (q, _) = S::parts(self.integration.state());
        self.integration.system_mut().road = road;
        let y = Motion::<S, W>::pack(&q, rates);
        let scale = scale_of(self.integration.system(), self.frequency);
        // The same tolerance with other scales, which are positive as those before were.
        if let Ok(tolerance) = Tolerance::new(self.relative, scale) {
            self.integration.set_tolerance(tolerance);
        }
        self.integration.exchange(y);
    }
}

/// The sizes of the components of y.
pub(super) fn scale_of<S: Scene, W>(motion: &Motion<'_, S, W>, frequency: S::Scalar) -> StateColumn<S> {
    let scales = &motion.scales.coordinates;
    let sizes = S::Mechanism::coordinates(scales.unknowns, scales.inputs);
    let rates = match &motion.road {
        Road::Inputs => scales.inputs,
        Road::Others(independent) | Road::Over(independent, _) => independent.of(scales),
    };
    Motion::<S, W>::pack(&sizes, &(rates * frequency))
}
