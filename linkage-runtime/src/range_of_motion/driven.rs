//! Mechanisms that one parameter drives.

use crate::continuation::{Along, InputPath};
use crate::jacobian::ulp::nearly_zero;
use crate::same_position::modulo_turns;
use crate::scalar::arithmetic::*;
use crate::scalar::larger;
use crate::{Column, D, InputError, Kinematic, Mechanism, PerInput};

/// A mechanism that one parameter drives: its only input, or the parameter of a path of its inputs ([`Along`]).
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a mechanism that one parameter drives",
    note = "a mechanism with several inputs is driven along a path of them: see `linkage::continuation::Along`"
)]
pub trait Driven: Mechanism<V = D<1>> {
    /// The mechanism that is driven.
    type Of: Kinematic<Scalar = Self::Scalar, Name = Self::Name, U = Self::U, Branch = Self::Branch>;

    /// The mechanism that is driven.
    fn driven(&self) -> &Self::Of;

    /// Its inputs at a parameter, and their first and second derivatives by it.
    fn inputs_at(&self, parameter: Self::Scalar) -> [PerInput<Self::Of>; 3];

    /// The ends of the parameter, if it has ends.
    ///
    /// # Errors
    /// [`InputError`] if a path of the inputs has no length.
    fn parameter_range(&self) -> Result<Option<[Self::Scalar; 2]>, InputError<Self::Name>> {
        Ok(None)
    }

    /// The coordinates of the mechanism.
    fn position_of(&self, q: &Self::Coordinates) -> <Self::Of as Mechanism>::Coordinates {
        let (unknowns, parameter) = Self::parts(q);
        let [inputs, ..] = self.inputs_at(parameter[0]);
        Self::Of::coordinates(unknowns, inputs)
    }
}

impl<M: Kinematic<V = D<1>>> Driven for M {
    type Of = M;

    fn driven(&self) -> &M {
        self
    }

    fn inputs_at(&self, parameter: M::Scalar) -> [PerInput<M>; 3] {
        [parameter, M::Scalar::one(), M::Scalar::zero()].map(|value| Column::from([value]))
    }
}

impl<M: Kinematic, F: InputPath<M>> Driven for Along<M, F> {
    type Of = M;

    fn driven(&self) -> &M {
        &self.mechanism
    }

    fn inputs_at(&self, parameter: M::Scalar) -> [PerInput<M>; 3] {
        self.inputs.at(parameter)
    }

    fn parameter_range(&self) -> Result<Option<[M::Scalar; 2]>, InputError<M::Name>> {
        self.inputs.range(&self.mechanism)
    }
}

/// The coordinates of the mechanism that is driven.
pub(super) type PositionOf<M> = <<M as Driven>::Of as Mechanism>::Coordinates;

/// True if the inputs of the mechanism that is driven are the same, up to rounding errors and whole turns.
pub(super) fn same_inputs<M: Driven>(mechanism: &M, one: &M::Coordinates, other: &M::Coordinates) -> bool {
    let [one, other] = [one, other].map(|q| mechanism.inputs_at(M::inputs(q)[0])[0]);
    let size = larger(one.largest(), other.largest());
    one.iter().zip(&other).zip(mechanism.driven().input_angles()).all(|((one, other), is_angle)| {
        let least = if *is_angle { M::Scalar::one() } else { M::Scalar::zero() };
        modulo_turns(*one - *other, *is_angle).abs() <= larger(size, least) * nearly_zero()
    })
}
