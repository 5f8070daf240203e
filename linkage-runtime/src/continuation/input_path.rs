//! Paths of the inputs of a mechanism by one parameter.

use crate::scalar::arithmetic::*;
use crate::{Build, Dim, InputError, Mechanism, Name, PerInput};

/// The inputs of a mechanism as functions v(s) of one parameter.
///
/// Functions that return v, dv/ds and d2v/ds2 implement it, with a parameter that is treated as an angle.
pub trait InputPath<M: Mechanism> {
    /// The name of the parameter, as in error messages.
    fn parameter(&self, _: &M) -> M::Name {
        Name::from_static("the parameter")
    }
    /// True if the parameter is an angle: its scale is 1, and a motion may close after whole turns of it.
    fn is_angle(&self, _: &M) -> bool {
        true
    }

    /// v, dv/ds and d2v/ds2.
    fn at(&self, parameter: M::Scalar) -> [PerInput<M>; 3];

    /// The ends of the parameter, if the path has ends.
    ///
    /// # Errors
    /// [`InputError`] if the path has no length.
    fn range(&self, _: &M) -> Result<Option<[M::Scalar; 2]>, InputError<M::Name>> {
        Ok(None)
    }

    /// The scale of a parameter that is no angle, if no constraint depends on it.
    #[must_use]
    fn length_scale(_: &M, _: &M::Pose) -> M::Scalar {
        M::Scalar::one()
    }
}

impl<M, F, I> InputPath<M> for F
where
    M: Mechanism,
    F: Fn(M::Scalar) -> [I; 3],
    I: Into<PerInput<M>>,
{
    fn at(&self, parameter: M::Scalar) -> [PerInput<M>; 3] {
        self(parameter).map(Into::into)
    }
}

/// The input with the index `INPUT` as the parameter, with the others held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OneInput<I, const INPUT: usize> {
    /// The inputs; the value of that which is the parameter is unused.
    pub held: I,
}

impl<M, const INPUT: usize> InputPath<M> for OneInput<M::Inputs, INPUT>
where
    M: Mechanism,
{
    fn parameter(&self, mechanism: &M) -> M::Name {
        mechanism.input_name(INPUT)
    }

    fn is_angle(&self, mechanism: &M) -> bool {
        mechanism.input_angles().get(INPUT).copied().unwrap_or_default()
    }

    fn at(&self, parameter: M::Scalar) -> [PerInput<M>; 3] {
        const { assert!(INPUT < M::V::CAPACITY, "a mechanism has no input with this index") };
        let held: PerInput<M> = self.held.into();
        let unit = |place: usize| if place == INPUT { M::Scalar::one() } else { M::Scalar::zero() };
        let v = held.dim();
        let inputs = v.column(|place| if place == INPUT { parameter } else { held[place] });
        [inputs, v.column(unit), v.zeros()]
    }

    fn length_scale(mechanism: &M, pose: &M::Pose) -> M::Scalar {
        mechanism.length_scale(pose)
    }
}

/// The input at a place that is known when the program runs, as the parameter, with the others held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputAt<I> {
    /// The inputs; the value of that which is the parameter is unused.
    pub held: I,
    /// The place of the input that moves; at a place beyond the last no input does.
    pub place: usize,
}

impl<M: Mechanism> InputPath<M> for InputAt<M::Inputs> {
    fn parameter(&self, mechanism: &M) -> M::Name {
        mechanism.input_name(self.place)
    }

    fn is_angle(&self, mechanism: &M) -> bool {
        mechanism.input_angles().get(self.place).copied().unwrap_or_default()
    }

    fn at(&self, parameter: M::Scalar) -> [PerInput<M>; 3] {
        let held: PerInput<M> = self.held.into();
        let unit = |place: usize| if place == self.place { M::Scalar::one() } else { M::Scalar::zero() };
        let v = held.dim();
        let inputs = v.column(|place| if place == self.place { parameter } else { held[place] });
        [inputs, v.column(unit), v.zeros()]
    }

    fn length_scale(mechanism: &M, pose: &M::Pose) -> M::Scalar {
        mechanism.length_scale(pose)
    }
}

/// The straight line between two inputs, with a parameter from 0 to 1. At both ends the inputs are exactly these.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line<I> {
    /// The inputs at 0.
    pub from: I,
    /// The inputs at 1.
    pub to: I,
}

impl<M: Mechanism> InputPath<M> for Line<M::Inputs> {
    fn parameter(&self, _: &M) -> M::Name {
        Name::from_static("the part of the way")
    }

    fn is_angle(&self, _: &M) -> bool {
        false
    }

    fn at(&self, parameter: M::Scalar) -> [PerInput<M>; 3] {
        let [from, to]: [PerInput<M>; 2] = [self.from.into(), self.to.into()];
        let inputs = from * (M::Scalar::one() - parameter) + to * parameter;
        [inputs, to - from, from.dim().zeros()]
    }

    fn range(&self, mechanism: &M) -> Result<Option<[M::Scalar; 2]>, InputError<M::Name>> {
        let [from, to]: [PerInput<M>; 2] = [self.from.into(), self.to.into()];
        if from == to {
            let (of, quantity) = (Some(mechanism.name()), Name::from_static("the way between the inputs"));
            return Err(InputError::OutOfRange {
                of,
                quantity,
                value: 0.0,
                least: f64::MIN_POSITIVE,
                most: f64::INFINITY,
            });
        }
        Ok(Some([M::Scalar::zero(), M::Scalar::one()]))
    }
}
