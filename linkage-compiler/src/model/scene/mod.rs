//! Bodies and scenes: every effect as a potential, or as a law that acts along a scalar.

mod body;
mod contact;
mod effect;
mod finish;

use std::collections::BTreeSet;

use proc_macro2::{Ident, Span};
use syn::Attribute;

use super::name::Name;
use crate::graph::NodeId;
use crate::ids::{BodyId, DriverId, InputId, SceneParameterId, Table};

/// A rigid body.
pub struct Body {
    pub name: Name,
    /// m and its centre.
    pub mass: Option<(NodeId, [NodeId; 2])>,
    /// The moment of inertia about the centre, and the angle that the body turns by.
    pub inertia: Option<(NodeId, NodeId)>,
}

/// A mechanism with the effects that somebody called for.
pub struct Scene {
    pub name: Ident,
    pub attributes: Vec<Attribute>,
    pub driver: DriverId,
    /// The bodies whose inertia counts; nothing accelerates in a scene without.
    pub inertia: Option<Vec<BodyId>>,
    /// A body and the field that its mass is in.
    pub weights: Vec<(BodyId, [NodeId; 2])>,
    pub laws: Vec<Law>,
    pub contacts: Vec<Contact>,
    pub drives: Vec<Drive>,
    pub wishes: BTreeSet<Wish>,
    pub parameters: Vec<SceneParameterId>,
}

/// A force along a scalar: its work is `law` times the change of `along`.
pub struct Law {
    /// The label that errors give.
    pub label: String,
    /// In terms of parameters, coordinates, rates and time.
    pub law: NodeId,
    pub along: NodeId,
    pub account: Account,
}

/// A dry friction or a stop.
pub struct Contact {
    /// The label that errors give.
    pub label: String,
    pub along: NodeId,
    pub law: ContactLaw,
}

/// The law of a contact.
pub enum ContactLaw {
    /// The greatest force is the product of these, in terms of parameters, coordinates, rates and time.
    Friction(Vec<NodeId>),
    /// In terms of parameters.
    Stop { range: [NodeId; 2], restitution: NodeId },
}

/// Where the work of a law goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Account {
    /// From a potential energy.
    Stored(NodeId),
    /// Out of the mechanism.
    Dissipated,
    /// Into the mechanism.
    Applied,
}

/// The motion of an input is given.
pub struct Drive {
    pub input: InputId,
    /// In terms of parameters and time.
    pub law: NodeId,
}

/// Functions that a scene has only if they are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wish {
    Energy,
    Power,
    Reactions,
    Equilibrium,
}

/// What the scenes of a mechanism share while they are read.
#[derive(Default)]
pub(super) struct Reading {
    scenes: Vec<Draft>,
}

/// A scene with names in place of the bodies, drivers and inputs, which are not all known yet.
struct Draft {
    name: Ident,
    attributes: Vec<Attribute>,
    of: Option<Ident>,
    laws: Vec<Law>,
    contacts: Vec<Contact>,
    wishes: BTreeSet<Wish>,
    inertia: Option<(Span, Vec<Ident>)>,
    /// Where the first contact is named.
    contact: Option<(Span, String)>,
    gravity: Vec<([NodeId; 2], Vec<Ident>)>,
    drives: Vec<(Ident, NodeId)>,
}

impl Scene {
    /// Everything whose value it takes: forces, energies, the bounds of contacts.
    #[must_use]
    pub fn values(&self) -> Vec<NodeId> {
        let mut values: Vec<NodeId> = self.laws.iter().map(|law| law.law).collect();
        values.extend(self.laws.iter().filter_map(|law| match law.account {
            Account::Stored(potential) => Some(potential),
            Account::Dissipated | Account::Applied => None,
        }));
        for contact in &self.contacts {
            match &contact.law {
                ContactLaw::Friction(factors) => values.extend(factors),
                ContactLaw::Stop { range, restitution } => {
                    values.extend(range.iter().chain([restitution, &contact.along]));
                }
            }
        }
        values
    }

    /// Everything that forces act along.
    #[must_use]
    pub fn paths(&self, bodies: &Table<BodyId, Body>) -> Vec<NodeId> {
        let mut paths: Vec<NodeId> = self.laws.iter().map(|law| law.along).collect();
        paths.extend(self.contacts.iter().map(|contact| contact.along));
        let heavy = self.inertia.iter().flatten().chain(self.weights.iter().map(|(index, _)| index));
        for &index in heavy {
            let Body { mass, inertia, .. } = &bodies[index];
            paths.extend(mass.iter().flat_map(|(_, center)| *center));
            paths.extend(inertia.iter().map(|(_, angle)| *angle));
        }
        paths
    }

    /// Everything that it is made of.
    fn formulas(&self, bodies: &Table<BodyId, Body>) -> Vec<NodeId> {
        let mut formulas: Vec<NodeId> = self.laws.iter().flat_map(|law| [law.law, law.along]).collect();
        for (index, field) in &self.weights {
            formulas.extend(field);
            formulas.extend(bodies[*index].mass.iter().flat_map(|(mass, center)| [*mass, center[0], center[1]]));
        }
        for contact in &self.contacts {
            formulas.push(contact.along);
            match &contact.law {
                ContactLaw::Friction(factors) => formulas.extend(factors),
                ContactLaw::Stop { range, restitution } => formulas.extend(range.iter().chain([restitution])),
            }
        }
        formulas.extend(self.drives.iter().map(|drive| drive.law));
        for &index in self.inertia.iter().flatten() {
            let Body { mass, inertia, .. } = &bodies[index];
            formulas.extend(mass.iter().flat_map(|(mass, center)| [*mass, center[0], center[1]]));
            formulas.extend(inertia.iter().flat_map(|(inertia, angle)| [*inertia, *angle]));
        }
        formulas
    }
}
