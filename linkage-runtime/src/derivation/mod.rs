//! A mechanism's derivation as data.
//!
//! Its formulas are numbers of nodes in one [`FormulaTable`], with terms and fractions as they are printed: nothing is
//! parsed or laid out at run time. The records are those of [`linkage_ir::document`], lent by constants or by an arena.

pub(crate) mod constants;
#[doc(hidden)]
mod display;
pub mod notation;
mod table;
mod value;

use linkage_ir::document::{self, Lent};

pub use linkage_ir::document::{Counts, FormulaNode, GroupForm, GroupMethod};
pub use linkage_ir::{ElementaryFunction, Operations};

pub use table::{Formula, FormulaList, FormulaTable, FormulaView, Terms};
pub use value::{number_of, value_of};

macro_rules! lent {
    ($($(#[$doc:meta])* $Record:ident)+) => {$(
        $(#[$doc])*
        pub type $Record<'a> = document::$Record<'a, Lent<Formula<'a>>>;
    )+};
}

lent! {
    /// A parameter or coordinate: [`document::Symbol`].
    Symbol
    /// A matrix of formulas: [`document::FormulaMatrix`].
    FormulaMatrix
    /// The root that tells the two solutions of a [`Group`] apart by its sign: [`document::Root`].
    Root
    /// Unknowns that are solved for together: [`document::Group`].
    Group
    /// A point or output: [`document::Quantity`].
    Quantity
    /// The derivatives of the unknowns with respect to the parameters while the inputs are held: [`document::Sensitivity`].
    Sensitivity
    /// An emitted function: [`document::Kernel`].
    Kernel
    /// The numbers that an emitted function computes: [`document::KernelCode`].
    KernelCode
    /// A number that a function returns: [`document::KernelResult`].
    KernelResult
    /// The kinematics of a mechanism: [`document::Derivation`].
    Derivation
    /// The links and joints of a mechanism: [`document::KinematicChain`].
    KinematicChain
    /// A rigid link: [`document::ChainLink`].
    ChainLink
    /// A joint between two links: [`document::ChainJoint`].
    ChainJoint
    /// The equations of motion of a scene: [`document::SceneDerivation`].
    SceneDerivation
    /// The contribution of a body or an effect to the generalised forces: [`document::Effect`].
    Effect
    /// A friction or a stop: [`document::ContactEffect`].
    ContactEffect
    /// The force of a joint on a link: [`document::JointForce`].
    JointForce
    /// The formulas of an analysis by hand, line by line: [`document::SheetDerivation`].
    SheetDerivation
    /// A choice of inputs: [`document::DriverChoice`].
    DriverChoice
    /// The skew matrices of a link that turns: [`document::Turning`].
    Turning
    /// A point as a sum of vectors from the origin: [`document::PointVectors`].
    PointVectors
    /// A vector of length z at an angle φ: [`document::ChainVector`].
    ChainVector
}

/// `left` = `right`: [`document::Equation`].
pub type Equation<'a> = document::Equation<Formula<'a>>;
/// An entry of a [`FormulaMatrix`]: [`document::Entry`].
pub type Entry<'a> = document::Entry<Formula<'a>>;
/// A condition in the code of a function: [`document::KernelCheck`].
pub type KernelCheck<'a> = document::KernelCheck<Formula<'a>>;
