//! The data of a derivation: the coordinates, the blocks, the points and outputs, and what is asked for beyond.

use super::linear::{Row, Solutions};
use super::scene::Scene;
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::{BlockId, ColumnId, InputId, PairId, ParameterId, RowId, Table, UnknownId};
use crate::structure::Group;

/// A coordinate with the names of its velocity, acceleration and jerk.
#[derive(Debug, Clone)]
pub struct Coordinate {
    pub name: String,
    pub value: SymbolId,
    pub rate: SymbolId,
    pub acceleration: SymbolId,
    pub jerk: SymbolId,
}

/// A point or an output with all that is derived from it.
#[derive(Debug, Clone)]
pub struct Quantity {
    /// x and y of a point, the one value of an output.
    pub value: Vec<NodeId>,
    /// d value / d q, one row a component.
    pub jacobian: Vec<Row<ColumnId>>,
    /// In terms of q and q'.
    pub rate: Vec<NodeId>,
    /// In terms of q, q' and q''.
    pub acceleration: Vec<NodeId>,
    /// In terms of q to q'''; like the rest, empty unless asked for.
    pub jerk: Vec<NodeId>,
    /// (l_q w_j)_q w_k, by pair of inputs and component, in terms of q and W.
    pub along_inputs: Table<PairId, Vec<NodeId>>,
    /// l_p, one row a component.
    pub by_parameters: Vec<Row<ParameterId>>,
}

/// The determinant of a block in closed form.
#[derive(Debug, Clone, Copy)]
pub struct Determinant {
    pub value: NodeId,
    /// The name under which everything else refers to it.
    pub symbol: SymbolId,
    /// The largest value that its formula could take at these lengths: what "near zero" is measured by.
    pub size: NodeId,
}

/// Unknowns that are solved together, once all blocks before are solved.
#[derive(Debug, Clone)]
pub struct Block {
    pub equations: Vec<RowId>,
    pub unknowns: Vec<UnknownId>,
    pub group: Group,
    /// Of a block in closed form.
    pub determinant: Option<Determinant>,
}

/// The derivatives of the velocity ratios.
#[derive(Debug, Clone)]
pub struct RatioDerivatives {
    /// The inputs j <= k, each pair once.
    pub pairs: Table<PairId, (InputId, InputId)>,
    /// The pair of two inputs in either order.
    pub places: Table<InputId, Table<InputId, PairId>>,
    /// What stands behind the name of what is derived.
    pub endings: Table<PairId, String>,
    /// The names of L.
    pub names: Solutions<PairId, SymbolId>,
    /// (Psi_q w_j)_q w_k, in terms of W.
    pub terms: Table<PairId, Table<RowId, NodeId>>,
}

/// The sensitivities to the parameters.
#[derive(Debug, Clone)]
pub struct Sensitivity {
    /// The names of du/dp.
    pub names: Solutions<ParameterId, SymbolId>,
    /// Psi_p.
    pub jacobian: Table<RowId, Row<ParameterId>>,
}

/// Everything derived from one mechanism with one choice of independent coordinates.
#[derive(Debug, Clone)]
pub struct Derivation {
    pub graph: Graph,
    pub coordinates: Table<ColumnId, Coordinate>,
    /// The columns of [`Derivation::jacobian`] that are u and v.
    pub unknowns: Table<UnknownId, ColumnId>,
    pub inputs: Table<InputId, ColumnId>,
    /// Psi.
    pub residual: Table<RowId, NodeId>,
    /// The sum of the magnitudes of each closure's terms: what "small residual" is measured by.
    pub residual_scales: Table<RowId, NodeId>,
    /// Psi_q.
    pub jacobian: Table<RowId, Row<ColumnId>>,
    pub blocks: Table<BlockId, Block>,
    /// True if det J is the negative of the product of the determinants of the blocks.
    pub is_odd: bool,
    /// The names of W.
    pub ratios: Solutions<InputId, SymbolId>,
    /// (Psi_q q')_q q'.
    pub gamma: Table<RowId, NodeId>,
    pub points: Vec<Quantity>,
    pub outputs: Vec<Quantity>,
    /// What is left of Psi''' where no coordinate jerks; like what follows only if it is asked for.
    pub eta: Option<Table<RowId, NodeId>>,
    pub ratio_derivatives: Option<RatioDerivatives>,
    pub sensitivity: Option<Sensitivity>,
    /// Those of this driver.
    pub scenes: Vec<Scene>,
}

impl Block {
    /// The name of its branch: those of its unknowns.
    #[must_use]
    pub fn branch(&self, derivation: &Derivation) -> String {
        self.names(derivation).replace(", ", "_")
    }

    /// The names of the unknowns, by which errors name the block.
    #[must_use]
    pub fn names(&self, derivation: &Derivation) -> String {
        let name = |&place: &UnknownId| derivation.coordinates[derivation.unknowns[place]].name.as_str();
        self.unknowns.iter().map(name).collect::<Vec<_>>().join(", ")
    }
}
