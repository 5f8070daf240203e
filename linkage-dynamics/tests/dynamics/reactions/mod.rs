//! Friction by the reaction of its joint, against textbooks, an independent search and closed-form motions.

mod curve;
mod dead_point;
mod errors;
mod random;
mod search;
mod simulation;
mod textbook;
mod three_numbers;

use linkage_dynamics::contact::{
    ContactMotion, Contacts, ReducedBearing, ReducedContact, ReducedEquations, ReducedReaction,
};
use linkage_dynamics::{ContactLaw, MotionError};
use linkage_runtime::{Column, D, Matrix};

type Equations<const V: usize, const C: usize> = ReducedEquations<f64, D<V>, D<C>>;
/// A contact and its reaction.
type Touching<const V: usize, const C: usize> = (ReducedContact<f64, D<V>>, Option<ReducedBearing<f64, D<V>, D<C>>>);
/// The modes, and the motion in them.
type Moved<const V: usize, const C: usize> = (Contacts<f64, D<C>>, ContactMotion<f64, D<V>, D<C>>);
type Reaction<const V: usize, const C: usize> = ReducedReaction<f64, D<V>, D<C>>;

/// R = constant + accelerations . z'' + contacts . f.
fn reaction<const V: usize, const C: usize>(
    constant: f64,
    accelerations: [f64; V],
    contacts: [f64; C],
) -> Reaction<V, C> {
    ReducedReaction { constant, accelerations: accelerations.into(), contacts: contacts.into() }
}

/// The reaction of a guide.
fn guide<const V: usize, const C: usize>(normal: Reaction<V, C>) -> Option<ReducedBearing<f64, D<V>, D<C>>> {
    Some(ReducedBearing { components: [normal, ReducedReaction::zero((D, D))] })
}

/// A friction by a reaction with this row and rate of s.
fn bearing<const V: usize>(name: &'static str, factor: f64, row: [f64; V], rate: f64) -> ReducedContact<f64, D<V>> {
    let law = ContactLaw::Bearing { factor };
    ReducedContact { name, value: 0.0, row: row.into(), drift: rate, bias: 0.0, law }
}

/// Equations with the rates zero.
fn equations<const V: usize, const C: usize>(
    mass: [[f64; V]; V],
    forces: [f64; V],
    contacts: [Touching<V, C>; C],
) -> Equations<V, C> {
    ReducedEquations {
        scene: "Scene",
        coordinates: Column::repeat("z"),
        mass: Matrix::from(mass),
        forces: forces.into(),
        rates: Column::zeros(),
        contacts: Column::from(contacts.map(|contact| contact.0)),
        bearings: Column::from(contacts.map(|contact| contact.1)),
    }
}

/// The modes at this state, the accelerations and the forces.
fn solved<const V: usize, const C: usize>(equations: &Equations<V, C>) -> Result<Moved<V, C>, MotionError> {
    let at = |rates: &Column<f64, D<V>>| Ok(ReducedEquations { rates: *rates, ..*equations });
    let (contacts, _) = Contacts::begin(0.0, &Column::zeros(), at)?;
    Ok((contacts, contacts.motion(equations)?))
}
