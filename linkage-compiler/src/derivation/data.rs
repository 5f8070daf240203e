//! The data of a derivation: coordinates, groups, points, outputs, scenes, and the results of `derive` statements.

use std::collections::{BTreeMap, BTreeSet};

use super::joints::Joints;
use super::linear::{Row, Solutions};
use super::scene::Scene;
use super::skeleton::Skeleton;
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::{ColumnId, GroupId, InputId, PairId, ParameterId, RowId, Table, UnknownId};
use crate::structure::{GroupKind, Slide};

/// A coordinate with the symbols of its rate, acceleration and jerk.
#[derive(Debug, Clone)]
pub struct Coordinate {
    pub name: String,
    pub value: SymbolId,
    pub rate: SymbolId,
    pub acceleration: SymbolId,
    pub jerk: SymbolId,
}

/// A point or an output with its derivatives.
#[derive(Debug, Clone)]
pub struct Quantity {
    /// x and y of a point, or the value of an output.
    pub value: Vec<NodeId>,
    /// d value / d q, one row for each component.
    pub jacobian: Vec<Row<ColumnId>>,
    /// The rate, in terms of q and q'.
    pub rate: Vec<NodeId>,
    /// The acceleration, in terms of q, `q'` and `q''`.
    pub acceleration: Vec<NodeId>,
    /// The jerk, in terms of q to `q'''`. This and the next fields are empty without a `derive` statement.
    pub jerk: Vec<NodeId>,
    /// (l_q w_j)_q w_k, by pair of inputs and component, in terms of q and W.
    pub along_inputs: Table<PairId, Vec<NodeId>>,
    /// l_p, one row for each component.
    pub by_parameters: Vec<Row<ParameterId>>,
}

/// The determinant of a group in closed form.
#[derive(Debug, Clone, Copy)]
pub struct Determinant {
    pub value: NodeId,
    /// The symbol that other formulas use.
    pub symbol: SymbolId,
    /// An upper bound of its magnitude at these lengths: the scale of "near zero".
    pub scale: NodeId,
}

/// Unknowns that are solved together, once all groups before are solved.
#[derive(Debug, Clone)]
pub struct Group {
    pub equations: Vec<RowId>,
    pub unknowns: Vec<UnknownId>,
    pub kind: GroupKind,
    /// The slider, if it is the angle of a dyad whose length another group has.
    pub slide: Option<Slide>,
    /// The joints of two links.
    pub joints: Option<Joints>,
    /// Its mirrored angles.
    pub mirrored: Vec<SymbolId>,
    /// The determinant, if the group has at most two unknowns.
    pub determinant: Option<Determinant>,
}

/// The derivatives of the velocity ratios.
#[derive(Debug, Clone)]
pub struct RatioDerivatives {
    /// The inputs j <= k, each pair once.
    pub pairs: Table<PairId, (InputId, InputId)>,
    /// The pair of two inputs in either order.
    pub indices: Table<InputId, Table<InputId, PairId>>,
    /// The ending of the names of the second derivatives for each pair.
    pub endings: Table<PairId, String>,
    /// The symbols of L.
    pub names: Solutions<PairId, SymbolId>,
    /// (Psi_q w_j)_q w_k, in terms of W.
    pub terms: Table<PairId, Table<RowId, NodeId>>,
}

/// The sensitivities to the parameters.
#[derive(Debug, Clone)]
pub struct Sensitivity {
    /// The symbols of du/dp.
    pub names: Solutions<ParameterId, SymbolId>,
    /// Psi_p.
    pub jacobian: Table<RowId, Row<ParameterId>>,
}

/// A scalar equation that follows from Psi(q) = 0.
#[derive(Debug, Clone)]
pub struct Implied {
    /// Its name in errors.
    pub name: String,
    pub residual: NodeId,
    /// The sum of the magnitudes of its terms.
    pub scale: NodeId,
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
    /// For each row of Psi, the sum of the magnitudes of its terms: the scale of its residual.
    pub residual_scales: Table<RowId, NodeId>,
    /// The equations that follow from Psi(q) = 0.
    pub implied: Vec<Implied>,
    /// Psi_q.
    pub jacobian: Table<RowId, Row<ColumnId>>,
    pub groups: Table<GroupId, Group>,
    /// True if det J is the negative of the product of the determinants of the groups.
    pub is_odd: bool,
    /// The symbols of W.
    pub ratios: Solutions<InputId, SymbolId>,
    /// (Psi_q q')_q q'.
    pub gamma: Table<RowId, NodeId>,
    pub points: Vec<Quantity>,
    pub outputs: Vec<Quantity>,
    /// `Psi'''` at `q''' = 0`. This and the next two fields are `None` without a `derive` statement.
    pub eta: Option<Table<RowId, NodeId>>,
    pub ratio_derivatives: Option<RatioDerivatives>,
    pub sensitivity: Option<Sensitivity>,
    /// The parts of a drawing.
    pub skeleton: Option<Skeleton>,
    /// The scenes of this driver.
    pub scenes: Vec<Scene>,
    /// The least and the largest value of angles that count turns.
    pub ranges_of_turns: BTreeMap<SymbolId, [NodeId; 2]>,
    /// The angles of which a range counts turns.
    pub counted_by_ranges: BTreeSet<SymbolId>,
}

impl Group {
    /// The name of its field in the branch: the names of the unknowns of its dyad.
    #[must_use]
    pub fn branch(&self, derivation: &Derivation) -> String {
        let mut unknowns = self.unknowns.clone();
        unknowns.extend(self.slide.map(|slide| slide.length));
        unknowns.sort_unstable();
        named(&unknowns, derivation).join("_")
    }

    /// Its name in errors: the names of its unknowns, and the joints of a dyad.
    #[must_use]
    pub fn title(&self, derivation: &Derivation) -> String {
        let joints = self.joints.as_ref().and_then(Joints::names);
        let joints = joints.map_or_else(String::new, |names| format!(" ({})", names.join("-")));
        self.names(derivation) + &joints
    }

    /// The names of its unknowns.
    #[must_use]
    pub fn names(&self, derivation: &Derivation) -> String {
        named(&self.unknowns, derivation).join(", ")
    }
}

fn named<'a>(unknowns: &[UnknownId], derivation: &'a Derivation) -> Vec<&'a str> {
    unknowns.iter().map(|&index| derivation.coordinates[derivation.unknowns[index]].name.as_str()).collect()
}
