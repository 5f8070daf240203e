//! The forces of joints, and the formulas of a mechanism with opened joints.

use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::{BodyId, SceneId, Table};

/// The force of a joint on a link.
#[derive(Debug, Clone)]
pub struct Load {
    /// The name of its field; a guide has one for each part of its force.
    pub field: String,
    pub kind: LoadKind,
    /// The position of the joint; for a guide, of its end.
    pub at: [NodeId; 2],
    /// The direction of the normal force of a guide; `None` for a pin.
    pub normal: Option<[NodeId; 2]>,
    /// The components of the displacement that opens the joint: along x and y; for a guide, along its normal, and the
    /// angle about its end.
    pub displacement: [SymbolId; 2],
    /// False if an `implied` loop may carry a part of the force.
    pub is_determined: bool,
    /// The residuals of equations in the coordinates of its links, if these equations name no points: their forces act
    /// along their scalars and are no part of the force of the joint.
    pub left_out: Vec<NodeId>,
}

impl Load {
    /// The fields of its force in the reactions of a scene.
    #[must_use]
    pub fn fields(&self) -> Vec<String> {
        match self.kind {
            LoadKind::Pin { .. } => vec![self.field.clone()],
            LoadKind::Guide { .. } => ["normal", "moment"].map(|part| format!("{}_{part}", self.field)).into(),
        }
    }

    /// Names the force.
    #[must_use]
    pub fn description(&self) -> String {
        match &self.kind {
            LoadKind::Pin { joint, link } => format!("the force on {link} in the pin at {joint}"),
            LoadKind::Guide { coordinate, block, .. } => format!("the force on {block} in the guide of {coordinate}"),
        }
    }

    /// The equations whose forces are left out, as a list of code; `None` if there are none.
    #[must_use]
    pub fn left_out(&self, graph: &Graph) -> Option<String> {
        let all: Vec<String> = self.left_out.iter().map(|&row| format!("`{} = 0`", graph.text(row))).collect();
        (!all.is_empty()).then(|| all.join(", "))
    }
}

/// The kind of an opened joint, with the names of its parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LoadKind {
    /// The force of a pin on a link.
    Pin { joint: String, link: String },
    /// The force and the moment of a guide on what slides along it.
    Guide { coordinate: String, guide: String, block: String, end: Option<String> },
}

/// An opened joint: a link at a joint, or a guide by its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Site {
    Pin { joint: usize, link: usize },
    Guide { ends: [usize; 2], block: usize },
}

/// The opened joints of a mechanism, and its formulas with all of them displaced.
#[derive(Debug, Clone, Default)]
pub struct Opened {
    pub loads: Vec<Load>,
    /// The rows of the constraints in order.
    pub rows: Vec<NodeId>,
    /// The rows of the `implied` ones.
    pub implied: Vec<NodeId>,
    pub bodies: Table<BodyId, OpenedBody>,
    pub scenes: Table<SceneId, Paths>,
}

/// The centre and the angle of a body.
#[derive(Debug, Clone, Copy)]
pub struct OpenedBody {
    pub center: Option<[NodeId; 2]>,
    pub angle: Option<NodeId>,
}

/// The scalars that the effects of a scene act along.
#[derive(Debug, Clone, Default)]
pub struct Paths {
    pub laws: Vec<NodeId>,
    pub contacts: Vec<NodeId>,
}
