//! The data of the derivation of one scene.

use std::collections::BTreeMap;

use super::linear::{Row, System};
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::{ColumnId, InputId, RowId, SceneId, Table, UnknownId};
use crate::structure::Elimination;

/// The formulas of one scene, in terms of q, q', W and t.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The id in [`Mechanism::scenes`](crate::model::Mechanism::scenes).
    pub id: SceneId,
    /// The symbols of `u''` at `v'' = 0`.
    pub bias: Table<UnknownId, SymbolId>,
    /// M by rows, if anything has inertia.
    pub mass_matrix: Option<Table<InputId, Table<InputId, NodeId>>>,
    /// Q, including the quadratic velocity terms.
    pub forces: Table<InputId, NodeId>,
    /// The contributions of bodies and effects to Q, with their names in errors.
    pub parts: Vec<(String, Table<InputId, NodeId>)>,
    /// The frictions and stops.
    pub contacts: Vec<Contact>,
    /// The masses, the inertias and the constant factors of friction limits, with their names in errors.
    pub masses: Vec<(String, NodeId)>,
    pub drives: BTreeMap<InputId, Prescribed>,
    /// The kinks of its laws, if it has inertia.
    pub kinks: Vec<Kink>,
    /// The change of the gap of each contact while the coordinates move, where it is known and no polynomial, if it has inertia. The
    /// moves are in place of the rates.
    pub gap_changes: Vec<Option<NodeId>>,
    pub kinetic: NodeId,
    pub potential: NodeId,
    /// The applied power, and the dissipated power in the next field.
    pub applied: NodeId,
    pub dissipated: NodeId,
    /// M and F in all coordinates, if anything has inertia.
    pub unreduced: Option<Unreduced>,
    /// The forces in joints, if a statement names one.
    pub reactions: Option<Reactions>,
    pub equilibrium: Option<Equilibrium>,
}

/// A law of motion with its derivatives with respect to time.
#[derive(Debug, Clone, Copy)]
pub struct Prescribed {
    pub value: NodeId,
    pub rate: NodeId,
    pub acceleration: NodeId,
}

/// A kink or a jump of a law, where an expression changes its sign.
#[derive(Debug, Clone)]
pub struct Kink {
    /// The effect with the law, as in errors.
    pub label: String,
    pub argument: NodeId,
    /// True if the argument depends on time and parameters only.
    pub is_timed: bool,
}

/// The formulas of one friction or stop, in terms of q, q' and t.
#[derive(Debug, Clone)]
pub struct Contact {
    /// The name in errors.
    pub label: String,
    pub value: NodeId,
    /// `ds/dq`.
    pub row: Row<ColumnId>,
    pub rate: NodeId,
    /// `s''` at `q'' = 0`.
    pub bias: NodeId,
    pub law: ContactFormula,
}

/// The law of a contact.
#[derive(Debug, Clone)]
pub enum ContactFormula {
    Friction {
        limit: NodeId,
        /// The factors of the limit that depend on parameters only.
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
    /// The nonzero entries of the upper triangle of M.
    pub mass_matrix: BTreeMap<(ColumnId, ColumnId), NodeId>,
    /// F, including the quadratic velocity terms.
    pub forces: Table<ColumnId, NodeId>,
}

/// The system of the Lagrange multipliers.
#[derive(Debug, Clone)]
pub struct Multipliers {
    /// lambda of the rows as written.
    pub names: Table<RowId, SymbolId>,
    /// lambda of the rows of Psi.
    pub solved: Table<RowId, SymbolId>,
    /// The steps from the rows as written to those of Psi.
    pub eliminations: Vec<Elimination>,
    /// `F_u - (M q'')_u`, in terms of q, `q'`, `q''` and t.
    pub side: Table<UnknownId, NodeId>,
}

/// The forces in joints, in terms of q, `q'`, `q''`, t, lambda and the forces of contacts.
#[derive(Debug, Clone)]
pub struct Reactions {
    /// The opened joints, as indices in [`Opened::loads`](crate::model::Opened::loads).
    pub opened: Vec<usize>,
    /// The force of each friction and stop along its scalar.
    pub contact_forces: Vec<SymbolId>,
    pub multipliers: Multipliers,
    /// The two components of each.
    pub forces: Vec<[NodeId; 2]>,
    /// The reactions that limit frictions, by contact.
    pub bearings: Vec<Option<[BearingRow; 2]>>,
}

/// A component of a reaction, `R = constant + b q'' + c lambda + d f`, with the multipliers lambda of the rows of Psi and
/// the forces f of contacts.
#[derive(Debug, Clone)]
pub struct BearingRow {
    pub constant: NodeId,
    pub accelerations: Row<ColumnId>,
    pub multipliers: Row<RowId>,
    pub contacts: Vec<NodeId>,
}

impl BearingRow {
    /// True if the component is zero in every motion.
    pub(super) fn is_zero(&self, graph: &Graph) -> bool {
        let is_zero = |&node: &NodeId| graph.is_zero(node);
        self.accelerations.is_empty()
            && self.multipliers.is_empty()
            && is_zero(&self.constant)
            && self.contacts.iter().all(is_zero)
    }
}

/// The formulas of the equilibrium of a scene, in terms of q, t, W and L.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    /// Q at rest.
    pub forces: Table<InputId, NodeId>,
    /// The sums of the magnitudes of the contributions to Q.
    pub sizes: Table<InputId, NodeId>,
    /// dQ/dv by rows.
    pub slopes: Table<InputId, Table<InputId, NodeId>>,
    /// The systems of W and L.
    pub systems: Vec<System>,
}
