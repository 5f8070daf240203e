//! Rates, accelerations, points and outputs along a motion.

use super::driven::PositionOf;
use super::{Driven, RangeOfMotion, between, crossed, follow::Step};
use crate::kinematic::{FullKinematics, FullKinematicsOf, Motion, MotionOf};
use crate::scalar::arithmetic::*;
use crate::{Kinematic, Mechanism, PathError, PathErrorOf, PerInput, PositionError};

impl<M: Driven> RangeOfMotion<'_, M> {
    /// The position at an input with rates, accelerations, points and outputs.
    ///
    /// Where the position has a closed form, it is computed by that; next to a change point, where that loses digits, it is
    /// the position of the path. At a change point that the motion passes the rates are the limits of those on both sides,
    /// with an error below 1e-9.
    ///
    /// # Errors
    /// Those of [`at`](Self::at), and of [`Kinematic::motion`]: at an end that is a dead point or a change point
    /// [`PositionError::Singular`].
    pub fn motion(
        &self,
        input: M::Scalar,
        rate: M::Scalar,
        acceleration: M::Scalar,
    ) -> Result<MotionOf<M::Of>, PathErrorOf<M>> {
        match self.regular_motion(input, rate, acceleration) {
            Err(error @ PathError::Position(PositionError::Singular { .. })) => {
                self.crossing_motion(input, rate, acceleration).ok_or(error)
            }
            found => found,
        }
    }

    /// The inputs at a parameter, their rates and their accelerations.
    fn input_motion(
        &self,
        input: M::Scalar,
        rate: M::Scalar,
        acceleration: M::Scalar,
    ) -> (PerInput<M::Of>, PerInput<M::Of>) {
        // v' = dv/ds s', v'' = d2v/ds2 s'^2 + dv/ds s''
        let [_, slope, bend] = self.mechanism().inputs_at(input);
        (slope * rate, bend * (rate * rate) + slope * acceleration)
    }

    /// The motion where J is singular and the motion goes on to both sides.
    fn crossing_motion(&self, input: M::Scalar, rate: M::Scalar, acceleration: M::Scalar) -> Option<MotionOf<M::Of>> {
        let slopes = |parameter: M::Scalar| {
            let motion = self.regular_motion(parameter, M::Scalar::one(), M::Scalar::zero()).ok()?;
            let first = M::Of::rate_parts(&motion.rates).0;
            Some([first, M::Of::acceleration_parts(&motion.accelerations).0])
        };
        let [first, second] = crossed::slopes(&self.same, input, slopes)?;
        let (m, q) = (self.driven(), self.at(input).ok()?);
        let (input_rates, input_accelerations) = self.input_motion(input, rate, acceleration);
        let rates = M::Of::rates(first * rate, input_rates);
        let accelerations = M::Of::accelerations(second * (rate * rate) + first * acceleration, input_accelerations);
        crossed::motion_at(m, &q, rates, accelerations).ok()
    }

    fn regular_motion(
        &self,
        input: M::Scalar,
        rate: M::Scalar,
        acceleration: M::Scalar,
    ) -> Result<MotionOf<M::Of>, PathErrorOf<M>> {
        let m = self.driven();
        let (rates, accelerations) = self.input_motion(input, rate, acceleration);
        let (rates, accelerations) = (rates.into(), accelerations.into());
        if let Some(motion) = self.in_closed_form(input, rates, accelerations)? {
            return Ok(motion);
        }
        let (near, _) = self.near(input)?;
        let q = self.mechanism().position_of(&near);
        let branch = m.branch_of(&m.pose_at(&q));
        if let Ok(found) = m.full_kinematics(&q, branch, rates, accelerations)
            && let closed = M::Of::coordinates_of(&found.pose)
            && self.same.are_equal(self.mechanism(), &M::with_unknowns(&near, M::Of::unknowns(&closed)), &near)
        {
            return self.with_turns(found, &q, rates, accelerations);
        }
        Ok(m.motion(&q, rates, accelerations)?)
    }

    /// The motion at an input between two regular steps on one branch; none where a path is needed.
    fn in_closed_form(
        &self,
        input: M::Scalar,
        rates: InputsOf<M>,
        accelerations: InputsOf<M>,
    ) -> Result<Option<MotionOf<M::Of>>, PathErrorOf<M>> {
        let (within, cycles, place) = self.place(input)?;
        let Some([before, after]) = self.steps.get(place..place + 2) else { return Ok(None) };
        let (steps, mechanism, m) = ([before, after], self.mechanism(), self.driven());
        let branch_of = |step: &Step<M>| mechanism.branch_of(&mechanism.pose_at(&step.position));
        let Some(guess) = between::guess(&self.same, steps, within) else { return Ok(None) };
        let branch = branch_of(before);
        if branch_of(after) != branch {
            return Ok(None);
        }
        let q = mechanism.position_of(&self.turned(&guess, input, cycles));
        let Ok(found) = m.full_kinematics(&q, branch, rates, accelerations) else { return Ok(None) };
        let closed = turned_to(self.driven(), M::Of::coordinates_of(&found.pose), &q);
        let closed_here = M::coordinates(M::Of::unknowns(&closed), [input].into());
        let guess_here = M::coordinates(M::Of::unknowns(&q), [input].into());
        if !between::is_between(&self.same, steps, &guess_here, &closed_here) {
            return Ok(None);
        }
        self.with_turns(found, &q, rates, accelerations).map(Some)
    }

    /// The motion of a position in closed form, with the turns of another next to it.
    fn with_turns(
        &self,
        found: FullKinematicsOf<M::Of>,
        like: &PositionOf<M>,
        rates: InputsOf<M>,
        accelerations: InputsOf<M>,
    ) -> Result<MotionOf<M::Of>, PathErrorOf<M>> {
        let closed = M::Of::coordinates_of(&found.pose);
        let position = turned_to(self.driven(), closed, like);
        if position != closed {
            return Ok(self.driven().motion(&position, rates, accelerations)?);
        }
        let FullKinematics { rates, accelerations, points, outputs, .. } = found;
        Ok(Motion { position, rates, accelerations, points, outputs })
    }
}

/// The inputs of the mechanism that is driven.
type InputsOf<M> = <<M as Driven>::Of as Mechanism>::Inputs;

/// A position with the turns of another next to it.
fn turned_to<M: Mechanism>(mechanism: &M, position: M::Coordinates, like: &M::Coordinates) -> M::Coordinates {
    let mut unknowns = M::unknowns(&position);
    for ((angle, like), is_angle) in unknowns.iter_mut().zip(&M::unknowns(like)).zip(mechanism.unknown_angles()) {
        let turns = ((*like - *angle) / M::Scalar::two_pi()).round();
        if *is_angle && !turns.is_zero() {
            *angle += turns * M::Scalar::two_pi();
        }
    }
    M::with_unknowns(&position, unknowns)
}
