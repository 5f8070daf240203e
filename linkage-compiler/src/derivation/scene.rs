//! The data that are derived for one scene.

use std::collections::BTreeMap;

use super::linear::{Row, System};
use crate::graph::{NodeId, SymbolId};
use crate::ids::{ColumnId, InputId, RowId, SceneId, Table, UnknownId};

/// What is derived for one scene, in terms of q, q', W and t.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The place in [`Mechanism::scenes`](crate::model::Mechanism::scenes).
    pub place: SceneId,
    /// The names of u'' at v'' = 0.
    pub bias: Table<UnknownId, SymbolId>,
    /// M by rows, if anything has inertia.
    pub mass_matrix: Option<Table<InputId, Table<InputId, NodeId>>>,
    /// Q with the quadratic velocity terms.
    pub forces: Table<InputId, NodeId>,
    /// What each body and effect adds to them, by what errors call it.
    pub parts: Vec<(String, Table<InputId, NodeId>)>,
    /// The frictions and stops.
    pub contacts: Vec<Contact>,
    /// The masses, the inertias and the limits of frictions as far as they are given, by what errors call them.
    pub masses: Vec<(String, NodeId)>,
    pub drives: BTreeMap<InputId, Prescribed>,
    pub kinetic: NodeId,
    pub potential: NodeId,
    /// The power of the laws that drive and that brake.
    pub applied: NodeId,
    pub dissipated: NodeId,
    /// In all coordinates, if anything has inertia.
    pub unreduced: Option<Unreduced>,
    pub reactions: Option<Reactions>,
    pub equilibrium: Option<Equilibrium>,
}

/// A law of motion with its derivatives by time.
#[derive(Debug, Clone, Copy)]
pub struct Prescribed {
    pub value: NodeId,
    pub rate: NodeId,
    pub acceleration: NodeId,
}

/// The formulas of one friction or stop, in terms of q, q' and t.
#[derive(Debug, Clone)]
pub struct Contact {
    /// The label that errors give.
    pub label: String,
    pub value: NodeId,
    /// `ds/dq`.
    pub row: Row<ColumnId>,
    pub rate: NodeId,
    /// s'' at q'' = 0.
    pub bias: NodeId,
    pub law: ContactFormula,
}

/// The law of a contact.
#[derive(Debug, Clone)]
pub enum ContactFormula {
    Friction {
        limit: NodeId,
        /// The factors of the limit that are made of parameters.
        given: Vec<NodeId>,
    },
    Stop {
        range: [NodeId; 2],
        restitution: NodeId,
    },
}

/// M and F, in terms of q, q' and t.
#[derive(Debug, Clone)]
pub struct Unreduced {
    /// The entries of M that are not zero, on its diagonal and above.
    pub mass_matrix: BTreeMap<(ColumnId, ColumnId), NodeId>,
    /// F with the quadratic velocity terms of the inertia.
    pub forces: Table<ColumnId, NodeId>,
}

/// The system of the reactions.
#[derive(Debug, Clone)]
pub struct Reactions {
    /// lambda.
    pub names: Table<RowId, SymbolId>,
    /// F_u - (M q'')_u, in terms of q, q', q'' and t.
    pub side: Table<UnknownId, NodeId>,
}

/// The formulas of the equilibrium of a scene, in terms of q, t, W and L.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    /// Q at rest.
    pub forces: Table<InputId, NodeId>,
    /// The sum of the magnitudes of what each is made of.
    pub sizes: Table<InputId, NodeId>,
    /// dQ/dv by rows.
    pub slopes: Table<InputId, Table<InputId, NodeId>>,
    /// The systems of W and L with the names of their solutions.
    pub systems: Vec<System>,
}
