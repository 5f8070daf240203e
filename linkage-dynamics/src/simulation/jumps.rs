//! Jumps of the rates of drives, and the impulse that they transmit.
//!
//! At a kink the law of a drive changes its rate by dv_p. The momenta of the free coordinates remain,
//! M_ff dv_f + M_fp dv_p = 0, because the drive exerts its impulse on its own coordinate only. Then the rules of impacts
//! hold for the contacts: a stop on which s rests, and towards which the new rates move it, is hit, and impulses of
//! friction are neglected.
//!
//! Each step is compared with the laws at its end: a drive that does not follow from its rate and acceleration has a
//! jump within the step, in the rate or in the position. So kinks without an expression are found too, as in a user
//! function.

use super::corners::{Corner, CornerOf};
use super::data::{Gap, Simulation};
use super::motion::{Motion, ParametrisationOf};
use super::state::State;
use super::watch::Watch;
use crate::contact::{Change, ReducedEquations};
use crate::inertia::Inertia;
use crate::integrate::Method;
use crate::{MotionError, MotionErrorOf, Prescribed, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Build, Column, Dim, Mechanism, PerInput, Real, real};

/// The deviation of a drive from its law at the end of a step, relative to the tolerance, that counts as a jump. The
/// error of a step is below 1 by its estimate.
const LARGEST_DEVIATION: f64 = 100.0;

/// The most times in a row that a step is shortened to a quarter because a drive deviates from a law without a jump.
const MAX_SHORTENED: u32 = 3;

/// A jump of a rate below this many ulps of the rates is none.
const LEAST_JUMP_ULPS: f64 = 64.0;

/// y, and the change of each contact.
type Crossed<S> = (StateColumn<S>, Column<Option<Change>, <S as Scene>::Contacts>);
/// A prescribed motion and its scales.
type Law<T> = (Prescribed<T>, [T; 2]);
/// The prescribed motion of each input.
type Laws<S> = Column<Option<Prescribed<<S as Scene>::Scalar>>, <S as Scene>::V>;

/// The jumps of the value and of the rate of a law between two times, relative to their scales, if each follows from its
/// derivatives at both.
fn defects<T: Real>(length: T, a: &Prescribed<T>, (b, scales): &Law<T>) -> [T; 2] {
    let half = length * real(0.5);
    [
        (b.value - a.value - (a.rate + b.rate) * half).abs() / scales[0],
        (b.rate - a.rate - (a.acceleration + b.acceleration) * half).abs() / scales[1],
    ]
}

/// The place of an input among the independent coordinates.
fn place_of<S: Scene>(parametrisation: &ParametrisationOf<S>, input: usize) -> Option<usize> {
    parametrisation.independent().map_or(Some(input), |independent| independent.place_of(input))
}

impl<S: Scene, W> Motion<'_, S, W> {
    /// The first input whose position or rate deviates from its law at the end of a step by more than `most` times its
    /// scale or its size at the start and the end.
    fn deviation(
        &self,
        before: &StateColumn<S>,
        (t, y): (S::Scalar, &StateColumn<S>),
        (most, frequency): (S::Scalar, S::Scalar),
    ) -> Option<usize> {
        let ((q, rates), (q_before, rates_before)) = (self.unpack(y), self.unpack(before));
        let inputs_before = S::Mechanism::inputs(&q_before);
        let inputs = S::Mechanism::inputs(&q);
        let laws = self.prescribed(t);
        (0..self.dims().1.count()).find(|&input| {
            let Some(law) = laws[input] else { return false };
            let scale = self.scales.coordinates.inputs[input];
            let place = place_of::<S>(&self.parametrisation, input);
            let (rate, rate_before) = place.map_or((law.rate, law.rate), |place| (rates[place], rates_before[place]));
            let size = law.value.abs() + inputs_before[input].abs() + scale;
            let speed = law.rate.abs() + rate_before.abs() + scale * frequency;
            // Not true for NaN: a law that is not finite is reported elsewhere.
            (law.value - inputs[input]).abs() > most * size || (law.rate - rate).abs() > most * speed
        })
    }

    /// Finds the jump of the law of an input between two times: the half in which it deviates most from its derivatives,
    /// again and again. None if there is no jump.
    fn jump(
        &self,
        input: usize,
        [from, to]: [S::Scalar; 2],
        (most, frequency): (S::Scalar, S::Scalar),
    ) -> Option<CornerOf<S>> {
        let scale = self.scales.coordinates.inputs[input];
        let law = |t: S::Scalar| -> Option<Law<S::Scalar>> {
            let law = self.prescribed(t)[input]?;
            let scales = [law.value.abs() + scale, law.rate.abs() + scale * frequency];
            Some((law, scales))
        };
        let (mut a, mut b) = ((from, law(from)?), (to, law(to)?));
        loop {
            let middle = a.0 + (b.0 - a.0) * real(0.5);
            if middle == a.0 || middle == b.0 {
                break;
            }
            let m = (middle, law(middle)?);
            let size = |a: &(S::Scalar, Law<S::Scalar>), b: &(S::Scalar, Law<S::Scalar>)| {
                let [value, rate] = defects(b.0 - a.0, &a.1.0, &b.1);
                value.max(rate)
            };
            if size(&a, &m) >= size(&m, &b) {
                b = m;
            } else {
                a = m;
            }
        }
        let [value, rate] = defects(b.0 - a.0, &a.1.0, &b.1);
        let effect = self.scene.mechanism().input_name(input);
        (value > most || rate > most).then_some(Corner { before: a.0, after: b.0, effect })
    }

    /// Returns the rates after jumps of prescribed rates, by which the momenta of the other coordinates do not change.
    fn kicked(
        &self,
        t: S::Scalar,
        y: &StateColumn<S>,
        jumps: &PerInput<S::Mechanism>,
    ) -> Result<PerInput<S::Mechanism>, MotionErrorOf<S>> {
        let (q, rates) = self.unpack(y);
        let mut equations = match self.frame(&q, &rates)? {
            None => ReducedEquations::unprescribed(&*self.scene, t, y)?.0,
            Some((independent, frame)) => self.unprescribed_by(independent, &frame, (t, y))?.0,
        };
        equations.forces = rates.dim().zeros();
        for (input, is_prescribed) in self.prescribed_inputs(t).into_iter().enumerate() {
            if let Some(place) = place_of::<S>(&self.parametrisation, input).filter(|_| is_prescribed) {
                equations.prescribe(place, jumps[input]);
            }
        }
        let inertia = Inertia::new(self.scene.name(), &equations.coordinates, &equations.mass)?;
        Ok(rates + inertia.solve(&equations.forces))
    }

    /// The jumps of prescribed rates from those of y to these laws; zero where they are rounding errors.
    fn jumps(&self, y: &StateColumn<S>, laws: &Laws<S>, frequency: S::Scalar) -> PerInput<S::Mechanism> {
        let rates = self.unpack(y).1;
        rates.dim().column(|input| {
            let (Some(law), Some(place)) = (laws[input], place_of::<S>(&self.parametrisation, input)) else {
                return S::Scalar::zero();
            };
            let (jump, scale) = (law.rate - rates[place], self.scales.coordinates.inputs[input] * frequency);
            let least = real::<S::Scalar>(LEAST_JUMP_ULPS) * S::Scalar::default_epsilon();
            let is_jump = jump.abs() > least * (law.rate.abs() + rates[place].abs() + scale);
            if is_jump { jump } else { S::Scalar::zero() }
        })
    }

    /// Moves y, which is projected, over the change of a law; returns y after it and the change of each contact.
    ///
    /// # Errors
    /// [`MotionError::DriveJumps`] if a drive jumps in position, and those of impacts.
    fn crossed(
        &mut self,
        corner: &CornerOf<S>,
        y: &StateColumn<S>,
        frequency: S::Scalar,
    ) -> Result<Crossed<S>, MotionErrorOf<S>> {
        let Corner { before, after, .. } = *corner;
        let inputs = S::Mechanism::inputs(&self.unpack(y).0);
        let laws = self.scene.prescribed(after);
        let most = S::Scalar::default_epsilon().sqrt();
        for (input, law) in laws.iter().enumerate() {
            let Some(law) = law else { continue };
            let size = law.value.abs() + inputs[input].abs() + self.scales.coordinates.inputs[input];
            let near = (law.value - inputs[input]).abs() <= most * size;
            if !near {
                let (scene, coordinate) = (self.scene.name(), self.scene.mechanism().input_name(input));
                return Err(MotionError::DriveJumps { scene, coordinate, t: to_f64(after) });
            }
        }
        let velocity = self.velocity(y)?;
        let jumps = self.jumps(y, &laws, frequency);
        let has_jump = jumps.iter().any(|jump| !jump.is_zero());
        let rates = if has_jump { self.kicked(before, y, &jumps)? } else { self.unpack(y).1 };
        let q = Self::moved(&self.unpack(y).0, &(velocity * (after - before)));
        self.corners.from = after;
        let kicked = self.projected(after, &self.pack(&q, &rates))?;
        if !has_jump {
            return Ok((kicked, self.scene.contact_count().repeat(None)));
        }
        self.resumed(after, &kicked)
    }

    /// Projects y, and changes the free rates where a drive has jumped since: for steps that do not end at kinks.
    pub(super) fn projected_with_jumps(
        &self,
        t: S::Scalar,
        y: &StateColumn<S>,
    ) -> Result<StateColumn<S>, MotionErrorOf<S>> {
        let projected = self.projected(t, y)?;
        let jumps = self.jumps(y, &self.prescribed(t), S::Scalar::zero());
        let (before, after) = (self.unpack(y).1, self.unpack(&projected).1);
        let least = S::Scalar::default_epsilon().sqrt();
        let has_jump = (0..jumps.dim().count()).any(|i| jumps[i].abs() > least * (before[i].abs() + after[i].abs()));
        if !has_jump {
            return Ok(projected);
        }
        let q = self.unpack(&projected).0;
        let rates = self.kicked(t, &self.pack(&q, &before), &jumps)?;
        self.projected(t, &self.pack(&q, &rates))
    }
}

impl<S: Scene, M: Method, W: Watch<S>> Simulation<'_, S, M, W> {
    /// The largest deviation of a drive from its law and of s from the stop on which it rests, relative to its scale.
    pub(super) fn largest_deviation(&self) -> S::Scalar {
        real::<S::Scalar>(LARGEST_DEVIATION * self.relative).max(S::Scalar::default_epsilon().sqrt())
    }

    /// Returns false if a drive deviates from its law at the end of a new step: the step is then repeated, to the jump.
    pub(super) fn follows_laws(&mut self) -> bool {
        let [(from, y), (to, next)] = self.integration.last_step();
        self.integration.system_mut().note_step(from, to);
        let motion = self.integration.system();
        let is_driven = motion.prescribed_inputs(from).iter().any(|&held| held);
        if !is_driven {
            return true;
        }
        let limit = (self.largest_deviation(), self.frequency);
        let Some(input) = motion.deviation(&y, (to, &next), limit) else {
            self.integration.system_mut().corners.shortened = 0;
            return true;
        };
        if let Some(corner) = motion.jump(input, [from, to], limit) {
            self.integration.system_mut().corners.found = Some(corner);
        } else if motion.corners.shortened < MAX_SHORTENED {
            self.integration.system_mut().corners.shortened += 1;
            self.integration.limit_next(0.25 * to_f64(to - from).abs());
        } else {
            return true;
        }
        self.integration.go_back(from, y);
        false
    }

    /// True if the last step is longer than the rounding error of the time.
    pub(super) fn is_long(&self) -> bool {
        let [(from, _), (to, _)] = self.integration.last_step();
        let least = from.abs().max(to.abs()) * S::Scalar::default_epsilon() * real(4.0 * LEAST_JUMP_ULPS);
        (to - from).abs() > least
    }

    /// Repeats the last step with a quarter of its length.
    pub(super) fn repeat_shorter(&mut self) {
        let [(from, y), (to, _)] = self.integration.last_step();
        self.integration.go_back(from, y);
        self.integration.limit_next(0.25 * to_f64(to - from).abs());
        self.integration.system_mut().corners.forget_approach();
        self.is_prepared = true;
    }

    /// The change of a law at this time, if a step has ended there.
    pub(super) fn corner(&self, t: S::Scalar) -> Option<CornerOf<S>> {
        self.integration.system().corners.ahead.filter(|corner| corner.before == t)
    }

    /// Continues after the change of a law.
    pub(super) fn cross(
        &mut self,
        corner: &CornerOf<S>,
        state: &mut State<S>,
        y: &StateColumn<S>,
    ) -> Result<(), MotionErrorOf<S>> {
        state.kink = Some(corner.effect);
        let frequency = self.frequency;
        // A jump of a drive may change the modes of contacts.
        if self.integration.system().names.dim().count() > 0 {
            self.integration.keep_dense_output()?;
        }
        let motion = self.integration.system_mut();
        motion.corners.note(motion.scene.name(), corner.effect, corner.before)?;
        let contacts = motion.contacts;
        let (after, changes) = motion.crossed(corner, y, frequency)?;
        motion.corners.found = None;
        self.gap = Some(Gap { before: *state, y: *y, contacts, after: corner.after });
        self.integration.restart_at(corner.after, after)?;
        self.from = (corner.after, after);
        self.note(state, changes);
        Ok(())
    }

    /// Continues after the change of a law at the time reached, without a step.
    pub(super) fn cross_here(&mut self, corner: &CornerOf<S>) -> Result<(), MotionErrorOf<S>> {
        let (t, motion) = (self.integration.t(), self.integration.system());
        let y = motion.projected(t, self.integration.state())?;
        let y = motion.on_stops(&motion.contacts, t, &y, self.largest_deviation())?;
        let mut state = motion.state(t, &y)?;
        self.contacts = motion.contacts;
        self.failure = self.cross(corner, &mut state, &y).err();
        self.state = state;
        Ok(())
    }
}
