//! The reaction of a joint with friction, before and after the elimination of the multipliers.
//!
//! With [J A] x = `rows` the multipliers of `M q'' + Psi_q' lambda = F + S' f` give `rows . lambda = x . (F + S' f - M q'')`:
//! they need no equations of their own. x is zero in the independent coordinates, so that no force of a drive enters.

use crate::contact::Contact;
use crate::{MotionError, Unreduced};
use linkage_runtime::{BorrowedName, Build, Column, Dim, Matrix, PositionError, Real};

/// The reaction R of a joint with friction. Its limit is `factor` |R|, see
/// [`ContactLaw::Bearing`](crate::ContactLaw::Bearing).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, U: Default, V: Default, C: Default"
    ))
)]
pub struct Bearing<T: Real, U: Dim, V: Dim, C: Dim> {
    /// The components of R: two of a pin, the normal force of a guide and zero.
    pub components: [ReactionRow<T, U, V, C>; 2],
}

/// A component of a reaction: `R = constant + unknowns . u'' + inputs . v'' + rows . lambda + contacts . f`,
/// where lambda are the multipliers in `M q'' + Psi_q' lambda = F + S' f` and f the forces of the contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, U: Default, V: Default, C: Default"
    ))
)]
pub struct ReactionRow<T: Real, U: Dim, V: Dim, C: Dim> {
    /// Its value without accelerations, multipliers and contact forces.
    pub constant: T,
    /// The factors of `u''`.
    pub unknowns: Column<T, U>,
    /// The factors of `v''`.
    pub inputs: Column<T, V>,
    /// The factors of lambda.
    pub rows: Column<T, U>,
    /// The factors of f.
    pub contacts: Column<T, C>,
}

/// A reaction in independent coordinates z.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, V: Default, C: Default"
    ))
)]
pub struct ReducedBearing<T: Real, V: Dim, C: Dim> {
    /// The components of R.
    pub components: [ReducedReaction<T, V, C>; 2],
}

/// A component of a reaction in independent coordinates z: `R = constant + accelerations . z'' + contacts . f`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, V: Default, C: Default"
    ))
)]
pub struct ReducedReaction<T: Real, V: Dim, C: Dim> {
    /// Its value without accelerations and contact forces.
    pub constant: T,
    /// The factors of `z''`.
    pub accelerations: Column<T, V>,
    /// The factors of f.
    pub contacts: Column<T, C>,
}

/// The reactions of the contacts that have one.
pub(crate) type Bearings<T, V, C> = Column<Option<ReducedBearing<T, V, C>>, C>;

impl<T: Real, U: Dim, V: Dim, C: Dim> ReactionRow<T, U, V, C> {
    /// A component that is zero: the second one of a guide.
    #[must_use]
    pub fn zero((u, v, c): (U, V, C)) -> Self {
        Self { constant: T::zero(), unknowns: u.zeros(), inputs: v.zeros(), rows: u.zeros(), contacts: c.zeros() }
    }
}

impl<T: Real, V: Dim, C: Dim> ReducedReaction<T, V, C> {
    /// A component that is zero: the second one of a guide.
    #[must_use]
    pub fn zero((v, c): (V, C)) -> Self {
        Self { constant: T::zero(), accelerations: v.zeros(), contacts: c.zeros() }
    }

    fn is_finite(&self) -> bool {
        self.constant.is_finite() && self.accelerations.is_finite() && self.contacts.is_finite()
    }
}

/// A scene at one state in independent coordinates z: `(u', v') = N z'` and `(u'', v'') = N z'' + b`.
pub(crate) struct Reduction<'a, T: Real, U: Dim, V: Dim, C: Dim, N: BorrowedName> {
    /// The rows of N of the unknowns and of the inputs.
    pub basis: (&'a Matrix<T, U, V>, &'a Matrix<T, V, V>),
    /// b.
    pub bias: (&'a Column<T, U>, &'a Column<T, V>),
    /// M and F.
    pub all: &'a Unreduced<T, U, V>,
    /// S.
    pub contacts: &'a Column<Contact<T, U, V, N>, C>,
}

impl<T: Real, U: Dim, V: Dim, C: Dim, N: BorrowedName> Reduction<'_, T, U, V, C, N> {
    /// Reduces the bearings of a scene; `solve` returns the x with [J A] x = `rows` that is zero in z.
    ///
    /// # Errors
    /// Those of `solve`; [`PositionError::NotFinite`] with the name of a contact whose reaction is not finite.
    pub(crate) fn bearings(
        &self,
        scene: N,
        bearings: &Column<Option<Bearing<T, U, V, C>>, C>,
        mut solve: impl FnMut(&Column<T, U>) -> Result<(Column<T, U>, Column<T, V>), MotionError<N>>,
    ) -> Result<Bearings<T, V, C>, MotionError<N>> {
        let mut reduced = self.contacts.dim().repeat(None);
        for (place, bearing) in bearings.iter().enumerate() {
            let Some(Bearing { components }) = bearing else { continue };
            let mut found = [ReducedReaction::zero((self.basis.1.dims().1, self.contacts.dim())); 2];
            for (found, row) in found.iter_mut().zip(components) {
                *found = self.reaction(row, &solve(&row.rows)?);
            }
            if !found.iter().all(ReducedReaction::is_finite) {
                let quantity = self.contacts[place].name;
                return Err(PositionError::NotFinite { mechanism: scene, quantity }.into());
            }
            reduced[place] = Some(ReducedBearing { components: found });
        }
        Ok(reduced)
    }

    /// `R = constant + g . q'' + x . F + (contacts + S x) . f` with g = (`unknowns`, `inputs`) - M x.
    fn reaction(
        &self,
        row: &ReactionRow<T, U, V, C>,
        (of_unknowns, of_inputs): &(Column<T, U>, Column<T, V>),
    ) -> ReducedReaction<T, V, C> {
        let all = self.all;
        let by_unknowns = row.unknowns - all.unknowns * *of_unknowns - all.mixed * *of_inputs;
        let by_inputs = row.inputs - all.mixed.tr_mul(of_unknowns) - all.inputs * *of_inputs;
        let forces = of_unknowns.dot(&all.unknown_forces) + of_inputs.dot(&all.input_forces);
        let quadratic = by_unknowns.dot(self.bias.0) + by_inputs.dot(self.bias.1);
        ReducedReaction {
            constant: row.constant + forces + quadratic,
            accelerations: self.basis.0.tr_mul(&by_unknowns) + self.basis.1.tr_mul(&by_inputs),
            contacts: self.contacts.dim().column(|place| {
                let along = &self.contacts[place].along;
                row.contacts[place] + along.unknowns.dot(of_unknowns) + along.inputs.dot(of_inputs)
            }),
        }
    }
}
