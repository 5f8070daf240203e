//! Formulas for readers: the derivation of a driver or of a scene as plain data.
//!
//! `layout` converts nodes of the graph to terms, fractions and factors. They are nodes of one table (`table`), and the records
//! (`linkage_ir::document`, as `data` names them) refer to formulas by their numbers. The runtime and `linkage-report` print them.

mod about;
mod data;
mod driver;
mod layout;
mod name;
mod scene;
mod sheet;
mod table;

pub(crate) use about::paragraphs;
pub use data::{
    ChainJoint, ChainLink, ContactEffect, Derivation, DriverChoice, DriverDocument, Effect, Equation, Group,
    JointForce, Kernel, KernelCheck, KernelCode, KernelResult, KinematicChain, Matrix, PointVectors, Quantity, Root,
    SceneDerivation, SceneDocument, Sensitivity, SheetDerivation, SheetDocument, Symbol, Turning, Vector,
};
pub use driver::of_driver;
pub use layout::{LONGEST, Layout};
pub use linkage_ir::document::{Documents, FormulaId, FormulaNode, FormulaNodes, Part};
pub use name::Name;
pub use scene::of_scene;
pub use sheet::of_sheet;
pub use table::{Node, Table};
