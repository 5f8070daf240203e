//! The records of documents, as the compiler keeps them.

use linkage_ir::document::{self, Document, FormulaId, Kept, Part};

use super::table::Table;

pub type Symbol = document::Symbol<'static, Kept>;
pub type Equation = document::Equation<FormulaId>;
pub type Matrix = document::FormulaMatrix<'static, Kept>;
pub type Root = document::Root<'static, Kept>;
pub type Group = document::Group<'static, Kept>;
pub type Quantity = document::Quantity<'static, Kept>;
pub type Sensitivity = document::Sensitivity<'static, Kept>;
pub type Kernel = document::Kernel<'static, Kept>;
pub type KernelCode = document::KernelCode<'static, Kept>;
pub type KernelCheck = document::KernelCheck<FormulaId>;
pub type KernelResult = document::KernelResult<'static, Kept>;
pub type KinematicChain = document::KinematicChain<'static, Kept>;
pub type ChainLink = document::ChainLink<'static, Kept>;
pub type ChainJoint = document::ChainJoint<'static, Kept>;
pub type Derivation = document::Derivation<'static, Kept>;
pub type DriverChoice = document::DriverChoice<'static, Kept>;
pub type Turning = document::Turning<'static, Kept>;
pub type PointVectors = document::PointVectors<'static, Kept>;
pub type Vector = document::ChainVector<'static, Kept>;
pub type SheetDerivation = document::SheetDerivation<'static, Kept>;
pub type Effect = document::Effect<'static, Kept>;
pub type ContactEffect = document::ContactEffect<'static, Kept>;
pub type JointForce = document::JointForce<'static, Kept>;
pub type SceneDerivation = document::SceneDerivation<'static, Kept>;

pub type DriverDocument = Document<Derivation>;
pub type SheetDocument = Document<SheetDerivation>;
pub type SceneDocument = Document<SceneDerivation>;

/// A record with the nodes that it needs of a table.
pub(super) fn with<D: Part>(mut record: D, table: Table) -> Document<D> {
    let nodes = table.reduced(&mut record);
    Document { nodes, record }
}
