//! The data that the functions of one driver or scene share.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use linkage_ir::code::Names;

use crate::derivation::Derivation;
use crate::graph::NodeId;
use crate::ids::FunctionId;
use crate::program::PosePlan;

/// The functions of a type by their names in planned code.
pub(super) type FunctionIds = BTreeMap<String, FunctionId>;

/// The data that the functions of one driver or scene share.
pub struct Context<'a> {
    pub derivation: &'a Derivation,
    pub pose: &'a PosePlan,
    /// Names that the user gave to expressions.
    pub named: &'a [(NodeId, String)],
    /// Names that no value may have: those of the arguments.
    pub reserved: &'a BTreeSet<String>,
    /// The names of the arguments for the pose, the branch, the turns, and the positions of groups that are kept.
    pub pose_argument: &'a str,
    pub branch: &'a str,
    pub turn: &'a str,
    pub memory: &'a str,
    /// The names of fields.
    pub(super) names: &'a RefCell<Names>,
    /// The functions of the type, and those of the driver.
    pub(super) own: &'a FunctionIds,
    pub(super) of_driver: &'a FunctionIds,
}
