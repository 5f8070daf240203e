//! Bodies and scenes; every effect is a potential, or a law that acts along a scalar.

mod along;
mod body;
mod contact;
mod effect;
mod finish;
mod joint;

use std::collections::BTreeSet;

use proc_macro2::{Ident, Span};
use syn::Attribute;

use super::name::{Name, TypeName};
use crate::graph::{NodeId, SymbolId};
use crate::ids::{BodyId, DriverId, InputId, SceneParameterId, Table};
pub(super) use along::Written;
pub(super) use joint::Wanted;

/// A rigid body.
pub struct Body {
    pub name: Name,
    /// The mass and its centre.
    pub mass: Option<(NodeId, [NodeId; 2])>,
    /// The moment of inertia about the centre, and the angle of the body.
    pub inertia: Option<(NodeId, NodeId)>,
    /// The symbols that its statement mentions.
    pub(super) mentions: BTreeSet<SymbolId>,
}

/// A mechanism with forces and inertia.
pub struct Scene {
    pub name: TypeName,
    pub attributes: Vec<Attribute>,
    pub driver: DriverId,
    /// The bodies with inertia; `None` in a static scene.
    pub inertia: Option<Vec<BodyId>>,
    /// Bodies with weight, and their gravitational field.
    pub weights: Vec<(BodyId, [NodeId; 2])>,
    pub laws: Vec<Law>,
    pub contacts: Vec<Contact>,
    pub drives: Vec<Drive>,
    pub requests: BTreeSet<SceneRequest>,
    pub parameters: Vec<SceneParameterId>,
    /// The joints whose forces it shows, as indices of [`Opened::loads`](super::Opened::loads).
    pub loads: Vec<usize>,
    /// The joints that its statements name.
    pub(super) wanted: Vec<Wanted>,
    pub(super) written: Written,
}

/// A force along a scalar: its work is `law` times the change of `along`.
pub struct Law {
    /// The name in errors.
    pub label: String,
    /// The force, in terms of parameters, coordinates, rates and time.
    pub law: NodeId,
    pub along: NodeId,
    pub account: Account,
}

/// A dry friction or a stop.
pub struct Contact {
    /// The name in errors.
    pub label: String,
    pub along: NodeId,
    pub law: ContactLaw,
    /// The joint whose force is a factor of the limit of a friction.
    pub bearing: Option<usize>,
}

/// The law of a contact.
pub enum ContactLaw {
    /// The factors of the largest force, in terms of parameters, coordinates, rates and time.
    Friction(Vec<NodeId>),
    /// The range and the restitution, in terms of parameters.
    Stop { range: [NodeId; 2], restitution: NodeId },
}

/// The account of the work of a law in the energy balance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Account {
    /// Taken from a potential energy.
    Stored(NodeId),
    /// Dissipated.
    Dissipated,
    /// Applied from outside.
    Applied,
}

/// A driven input: its motion is prescribed.
pub struct Drive {
    pub input: InputId,
    /// The value of the input, in terms of parameters and time.
    pub law: NodeId,
}

/// A statement of a scene that adds functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum SceneRequest {
    Energy,
    Power,
    Reactions,
    Equilibrium,
}

/// The scenes read so far, before their names are resolved.
#[derive(Default)]
pub(super) struct Reading {
    scenes: Vec<Draft>,
}

/// A scene with unresolved names of bodies, drivers and inputs.
struct Draft {
    name: Ident,
    attributes: Vec<Attribute>,
    of: Option<Ident>,
    laws: Vec<Law>,
    contacts: Vec<Contact>,
    requests: BTreeSet<SceneRequest>,
    wanted: Vec<Wanted>,
    written: Written,
    inertia: Option<(Span, Vec<Ident>)>,
    /// The keyword of the first contact.
    contact: Option<(Span, String)>,
    gravity: Vec<([NodeId; 2], Vec<Ident>)>,
    drives: Vec<(Ident, NodeId)>,
    /// The symbols that its effects mention.
    mentions: BTreeSet<SymbolId>,
    /// True if it has no mistake.
    is_complete: bool,
}

impl Scene {
    /// The expressions that the scene evaluates: forces, energies, limits of contacts.
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

    /// The scalars that forces act along.
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

    /// All expressions of the scene.
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
