//! By which coordinates a simulation goes on: the inputs, others where they are singular, or straight over a change point.

use nalgebra::SVector;

use super::independent::Independent;
use super::motion::{Motion, Position, Road};
use super::over::Ahead;
use super::run::{Rates, Signs, Simulation};
use super::verdict::weakest;
use super::watch::Watch;
use crate::Scene;
use crate::integrate::{Interpolant, Method, Tolerance};
use linkage_runtime::__shared::same_signs;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Error, Mechanism, Real, real};

/// Below this regularity of the inputs other coordinates are taken: two links are then within 6 degrees of a line.
const LEAVE: f64 = 0.05;

/// Above this they are taken again.
const RETURN: f64 = 0.1;

/// Below this the determinants of the groups are watched.
const NEAR: f64 = 0.4;

/// How far ahead a singularity is looked for, in radians or as a part of the sizes of lengths.
const SIGHT: f64 = 0.7;

/// Another choice must be this much better to be taken.
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
    /// It ends with [`Error::Singular`].
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

impl<S, T, const U: usize, const V: usize, const N: usize, const C: usize, M, W, const K: usize>
    Simulation<'_, S, T, U, V, N, C, M, W, K>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
    M: Method,
    W: Watch<T, Position<S, T, U, V, N, C>, Rates<S, T, U, V, N, C>, K, C>,
{
    /// Looks where the next step may go, and takes the coordinates for it.
    pub(super) fn prepare(&mut self) -> Result<(), Error> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let before = self.from.0;
        self.from = (t, y);
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let pose = mechanism.pose_at(&S::parts(&y).0);
        let (regularity, _) = weakest(mechanism, &pose);
        match motion.road {
            Road::Inputs if regularity < real(LEAVE) && self.at_singularity == AtSingularity::Pass => {
                self.leave_inputs()
            }
            Road::Inputs => {
                let determinants = mechanism.block_determinants(&pose);
                let rest = self.rest(t - before, &determinants);
                self.signs = determinants;
                let is_watched = regularity < real(NEAR) && self.at_singularity == AtSingularity::Pass;
                if let Some(rest) = rest.filter(|_| is_watched) { self.watch(rest) } else { Ok(()) }
            }
            _ if regularity > real(RETURN) && self.is_past(&mechanism.block_determinants(&pose)) => {
                let (_, inputs) = motion.velocity(t, &y)?;
                self.warned = 0;
                self.signs = mechanism.block_determinants(&pose);
                self.take(Road::Inputs, &inputs);
                Ok(())
            }
            Road::Others(independent) | Road::Over(independent, _) => self.stay(independent),
        }
    }

    /// The time until the determinant of a group is zero, if it goes on as in the last step.
    fn rest(&self, last: T, determinants: &Signs<S, T, U, V, N, C>) -> Option<f64> {
        let groups = self.signs.as_ref().iter().zip(determinants.as_ref());
        let falling = groups.filter(|(before, now)| now.abs() < before.abs());
        falling
            .map(|(&before, &now)| to_f64(now / (before - now) * last).abs())
            .reduce(|a, b| if a < b { a } else { b })
    }

    /// In the inputs, where they may soon be singular: a change point is passed from afar, as the step over it suffers
    /// the less from rounding the longer it is.
    fn watch(&mut self, rest: f64) -> Result<(), Error> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let (unknowns, inputs) = motion.velocity(t, &y)?;
        let is_near = rest * to_f64(motion.scales.speed(&unknowns, &inputs)) < SIGHT;
        let is_next = self.integration.next_length().is_some_and(|next| rest < 2.0 * next);
        if !(is_near || is_next) {
            return Ok(());
        }
        let (q, _) = S::parts(&y);
        let independent = Independent::choose(mechanism, &mechanism.pose_at(&q), &motion.scales, &motion.held(t));
        let rates = independent.of(&unknowns, &inputs);
        let ahead = motion.over(
            &independent,
            (t, &Motion::<S, W, T, U, V, N, C>::pack(&q, &rates)),
            self.way(),
            self.relative(),
        )?;
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

    fn way(&self) -> T {
        if self.integration.end() < self.integration.t() { -T::one() } else { T::one() }
    }

    fn relative(&self) -> T {
        real(self.relative)
    }

    fn pass(&mut self, independent: Independent<T, U, V>, step: Interpolant<T, N>) {
        self.integration.system_mut().road = Road::Over(independent, step);
        self.integration.pass(step.up_to(self.integration.end()).unwrap_or(step));
        self.passages.change_points += 1;
    }

    /// Whether nothing speaks for staying in other coordinates: a singularity that was met is passed, or seems to be
    /// avoided.
    fn is_past(&self, signs: &Signs<S, T, U, V, N, C>) -> bool {
        self.warned == 0 || !same_signs(self.signs.as_ref(), signs.as_ref())
    }

    pub(super) fn leave_inputs(&mut self) -> Result<(), Error> {
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let pose = mechanism.pose_at(&S::parts(&y).0);
        let independent = Independent::choose(mechanism, &pose, &motion.scales, &motion.held(t));
        let (unknowns, inputs) = motion.velocity(t, &y)?;
        self.take(Road::Others(independent), &independent.of(&unknowns, &inputs));
        self.look_ahead(independent)
    }

    /// True if a step ends just before what may be a change point, though it came from afar.
    pub(super) fn ends_too_near(&self, start: &SVector<T, N>, end: &SVector<T, N>) -> bool {
        if self.at_singularity == AtSingularity::Stop {
            return false;
        }
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let regularity = |y: &SVector<T, N>| {
            Independent::choose(mechanism, &mechanism.pose_at(&S::parts(y).0), &motion.scales, &[false; V]).regularity()
        };
        // No group is more regular by its inputs than all coordinates are together.
        let (by_inputs, _) = weakest(mechanism, &mechanism.pose_at(&S::parts(end).0));
        if by_inputs > real(CLEAR) {
            return false;
        }
        let at_end = regularity(end);
        at_end < real(CLEAR) && at_end < regularity(start) * real(0.25)
    }

    /// In other coordinates than the inputs: still the same, or better ones.
    fn stay(&mut self, mut independent: Independent<T, U, V>) -> Result<(), Error> {
        self.warned = self.warned.saturating_sub(1);
        let (t, y) = (self.integration.t(), *self.integration.state());
        let motion = self.integration.system();
        let mechanism = motion.scene.mechanism();
        let (q, mut rates) = Motion::<S, W, T, U, V, N, C>::unpack(&y);
        let pose = mechanism.pose_at(&q);
        let factors = independent.factors(mechanism, &pose, &motion.scales);
        independent.pivots = factors.pivots();
        let best = Independent::choose(mechanism, &pose, &motion.scales, &motion.held(t));
        if best.regularity() > independent.regularity() * real(BETTER) {
            let (unknowns, inputs) = independent.apart(&(factors.basis() * rates), &rates);
            (rates, independent) = (best.of(&unknowns, &inputs), best);
            self.passages.exchanges += 1;
        }
        self.set(Road::Others(independent), &rates);
        self.look_ahead(independent)
    }

    /// Goes over a change point if one is near.
    fn look_ahead(&mut self, independent: Independent<T, U, V>) -> Result<(), Error> {
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

    fn take(&mut self, road: Road<T, U, V, N>, rates: &SVector<T, V>) {
        self.passages.exchanges += 1;
        self.set(road, rates)
    }

    fn set(&mut self, road: Road<T, U, V, N>, rates: &SVector<T, V>) {
        let (q, _) = S::parts(self.integration.state());
        self.integration.system_mut().road = road;
        let y = Motion::<S, W, T, U, V, N, C>::pack(&q, rates);
        let scale = scale_of(self.integration.system(), &q, self.frequency);
        // The same tolerance with other scales, which are positive as those before were.
        if let Ok(tolerance) = Tolerance::new(self.relative, scale) {
            self.integration.set_tolerance(tolerance);
        }
        self.integration.exchange(y);
    }
}

/// The sizes of the components of y.
pub(super) fn scale_of<S, W, T, const U: usize, const V: usize, const N: usize, const C: usize>(
    motion: &Motion<'_, S, W, T, U, V, N, C>,
    q: &Position<S, T, U, V, N, C>,
    frequency: T,
) -> SVector<T, N>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    let scales = &motion.scales;
    let sizes = Motion::<S, W, T, U, V, N, C>::joined(q, (scales.unknowns, scales.inputs));
    let rates = match &motion.road {
        Road::Inputs => scales.inputs,
        Road::Others(independent) | Road::Over(independent, _) => independent.of(&scales.unknowns, &scales.inputs),
    };
    Motion::<S, W, T, U, V, N, C>::pack(&sizes, &(rates * frequency))
}
