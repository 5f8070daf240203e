//! A mechanism's derivation as data.
//!
//! Its formulas are numbers of nodes in one [`FormulaTable`], with terms and fractions as they are printed: nothing is
//! parsed or laid out at run time.

pub(crate) mod constants;
#[doc(hidden)]
mod display;
mod kinematic_chain;
pub mod notation;
mod scene;
mod sheet;
mod table;
mod value;

use core::fmt;

pub use linkage_ir::ElementaryFunction;

pub use kinematic_chain::{ChainJoint, ChainLink, KinematicChain};
pub use scene::{ContactEffect, Effect, JointForce, SceneDerivation};
pub use sheet::{ChainVector, DriverChoice, PointVectors, SheetDerivation, Turning};
pub use table::{Formula, FormulaList, FormulaNode, FormulaTable, FormulaView, Terms};
pub use value::{number_of, value_of};

/// A parameter or coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Symbol<'a> {
    /// The name in the `linkage!` language: `theta3`.
    pub name: &'a str,
    /// The displayed name: θ₃.
    pub formula: Formula<'a>,
}

/// `left` = `right`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Equation<'a> {
    /// The left side.
    pub left: Formula<'a>,
    /// The right side.
    pub right: Formula<'a>,
}

/// An entry of a [`FormulaMatrix`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Entry<'a> {
    /// The row, counted from 0.
    pub row: usize,
    /// The column, counted from 0.
    pub column: usize,
    /// The entry itself.
    pub value: Formula<'a>,
}

/// A matrix of formulas.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FormulaMatrix<'a> {
    /// The name.
    pub name: Formula<'a>,
    /// A factor of every entry, written before the brackets.
    pub factor: Option<Formula<'a>>,
    /// The number of rows.
    pub rows: usize,
    /// The number of columns.
    pub columns: usize,
    /// The entries that are not zero.
    pub entries: &'a [Entry<'a>],
}

/// The method that solves the linear system of a [`Group`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum GroupMethod {
    /// The inverse by formula: the adjugate divided by the determinant.
    ClosedForm,
    /// LU factorisation with partial pivoting.
    Factorization,
}

/// The form of the equations of a [`Group`]: the Assur group, with R for a joint that turns and P for one that slides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum GroupForm {
    /// RRR: the angles of two links between three joints that turn.
    TwoAngles,
    /// RRR: the coordinates of a point at two distances.
    TwoDistances,
    /// RRR: the angle of a link whose end is at a distance from a point.
    AngleAndDistance,
    /// RRP: the angle of a link, and a length along a line that does not turn with it.
    AngleAndLength,
    /// RRP: a length along a line, to a distance from a point.
    LengthAndDistance,
    /// RPR: an angle, and a length along a line that turns with it.
    AngleAndTurningLength,
    /// PRP or RPP: two lengths along given lines.
    TwoLengths,
    /// One angle phi in a cos(phi) + b sin(phi) + c = 0: with the slider that follows from it, RRP.
    OneAngle,
    /// One unknown that enters linearly: a gear, a belt, or a slider whose link is known.
    OneLinear,
    /// The angles and lengths of the links of two loops, whose positions are listed by number.
    TwoLoops,
    /// Those of three loops.
    ThreeLoops,
    /// Any other.
    Other,
}

/// The root that tells the two solutions of a [`Group`] apart by its sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Root<'a> {
    /// The root.
    pub formula: Formula<'a>,
    /// The names of the branches on which it is positive and negative.
    pub branches: [&'a str; 2],
}

/// Unknowns that are solved for together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Group<'a> {
    /// The unknowns.
    pub unknowns: &'a [Formula<'a>],
    /// The constraint equations that determine them: indices of [`Derivation::residual`].
    pub equations: &'a [usize],
    /// The kind of group: the Assur group, or a description of any other.
    pub kind: &'a str,
    /// The kind as data, with one case for all whose positions Newton's method finds.
    pub form: GroupForm,
    /// The position in closed form, each equation in terms of those before it; empty if Newton's method finds it.
    pub position: &'a [Equation<'a>],
    /// The root that tells two solutions apart.
    pub root: Option<Root<'a>>,
    /// The method that solves the linear system.
    pub method: GroupMethod,
    /// The determinant of the block of J, if it has a formula.
    pub determinant: Option<Equation<'a>>,
    /// The inverse of the block of J, if it has a formula.
    pub inverse: Option<FormulaMatrix<'a>>,
}

/// A point or output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Quantity<'a> {
    /// The name in the `linkage!` language.
    pub name: &'a str,
    /// The components.
    pub value: &'a [Equation<'a>],
    /// The derivatives of the components with respect to the inputs.
    pub ratios: &'a [Equation<'a>],
    /// The second derivatives of the components with respect to the inputs; empty unless the mechanism requests them.
    pub ratio_derivatives: &'a [Equation<'a>],
    /// The derivatives of the components with respect to the parameters, without those that are zero; empty unless the
    /// mechanism requests them.
    pub sensitivities: &'a [Equation<'a>],
}

/// The derivatives of the unknowns with respect to the parameters while the inputs are held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Sensitivity<'a> {
    /// ∂Ψ/∂p, the columns in the order of the parameters.
    pub jacobian: FormulaMatrix<'a>,
    /// ∂u/∂p if it has a formula, without the derivatives that are zero.
    pub formulas: &'a [Equation<'a>],
}

/// The operation counts of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Operations {
    /// Calls of elementary functions such as sine.
    pub functions: usize,
    /// Divisions.
    pub divisions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Additions and subtractions.
    pub additions: usize,
}

/// An emitted function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Kernel<'a> {
    /// The name of the function.
    pub function: &'a str,
    /// The operations of one call. What the function has in common with others that are inlined in it counts once.
    pub operations: Operations,
    /// Its code as formulas; empty without `derive fpcore`.
    pub code: KernelCode<'a>,
}

/// The numbers that an emitted function computes, by formulas in the order of its operations. It is empty for a function
/// without formulas, such as one that iterates. `Document::fpcore` of the crate `linkage` writes it for other programs.
///
/// Names are those of FPCore: each is an argument, or the left side of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct KernelCode<'a> {
    /// The intermediate results.
    pub steps: &'a [Equation<'a>],
    /// The conditions under which it computes these results.
    pub checks: &'a [KernelCheck<'a>],
    /// The numbers that it returns.
    pub results: &'a [KernelResult<'a>],
}

/// A condition in the code of a function, for the results that depend on the first of its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum KernelCheck<'a> {
    /// A determinant is not zero within rounding errors: the determinant, its scale.
    Regular([Formula<'a>; 2]),
    /// A number is not zero.
    Nonzero([Formula<'a>; 1]),
    /// A length is not negative.
    Positive([Formula<'a>; 1]),
    /// Two points do not coincide within rounding errors: their distance, its scale.
    Apart([Formula<'a>; 2]),
    /// A product neither underflows nor overflows.
    Moderate([Formula<'a>; 1]),
    /// A triangle has an area: the factors of its squared half chord, the squared sum of its sides, the squared distance
    /// of their ends.
    Open([Formula<'a>; 4]),
}

/// A number that a function returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct KernelResult<'a> {
    /// Its place in the result: `.points.c.x`.
    pub place: &'a str,
    /// Its value.
    pub value: Formula<'a>,
}

/// The kinematics of a mechanism, derived from its constraint equations Ψ(u, v) = 0, where u are the unknowns and v the
/// inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Derivation<'a> {
    /// The mechanism, or the driver of one.
    pub mechanism: &'a str,
    /// The parameters.
    pub parameters: &'a [Symbol<'a>],
    /// The inputs v.
    pub inputs: &'a [Symbol<'a>],
    /// The unknowns u.
    pub unknowns: &'a [Symbol<'a>],
    /// Ψ, the residuals of the constraint equations.
    pub residual: &'a [Equation<'a>],
    /// The residuals of loops and equations that are declared as implied by the others.
    pub implied: &'a [Equation<'a>],
    /// J = ∂Ψ/∂u.
    pub jacobian_unknowns: FormulaMatrix<'a>,
    /// A = ∂Ψ/∂v.
    pub jacobian_inputs: FormulaMatrix<'a>,
    /// The groups, in the order in which they are solved.
    pub groups: &'a [Group<'a>],
    /// det J, the product of the determinants of the groups; none if a group has no formula.
    pub determinant: Option<Equation<'a>>,
    /// The velocity ratios ∂u/∂v.
    pub ratios: &'a [Equation<'a>],
    /// ∂²u/∂v∂v, if it has a formula and the mechanism requests it.
    pub ratio_derivatives: Option<&'a [Equation<'a>]>,
    /// γ, the quadratic velocity terms: the second time derivative of Ψ without the terms of accelerations.
    pub gamma: &'a [Equation<'a>],
    /// η: the third time derivative of Ψ without the terms of jerks; none unless the mechanism requests the jerk.
    pub jerk: Option<&'a [Equation<'a>]>,
    /// The sensitivities to the parameters; none unless the mechanism requests them.
    pub sensitivity: Option<Sensitivity<'a>>,
    /// The points and their derivatives.
    pub points: &'a [Quantity<'a>],
    /// The outputs and their derivatives.
    pub outputs: &'a [Quantity<'a>],
    /// The conditions under which the simplified formulas hold, such as l₄ ≠ 0.
    pub conditions: &'a [Formula<'a>],
    /// The links and joints; none if the vectors of loops do not show them.
    pub chain: Option<KinematicChain<'a>>,
    /// The emitted functions.
    pub kernels: &'a [Kernel<'a>],
}

/// The numbers of coordinates and equations of a mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Counts {
    /// n, the coordinates q.
    pub coordinates: usize,
    /// p, the constraint equations Ψ, without those that are declared as implied by others.
    pub equations: usize,
}

impl Counts {
    /// F = n − p, the degrees of freedom: the number of inputs.
    #[must_use]
    pub fn freedom(self) -> usize {
        self.coordinates.saturating_sub(self.equations)
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { coordinates, equations } = self;
        write!(f, "n = {coordinates}, p = {equations}, F = n − p = {}", self.freedom())
    }
}

impl Derivation<'_> {
    /// The numbers n of coordinates and p of constraint equations.
    #[must_use]
    pub fn counts(&self) -> Counts {
        Counts { coordinates: self.inputs.len() + self.unknowns.len(), equations: self.residual.len() }
    }
}

impl<'a> FormulaMatrix<'a> {
    /// Returns an entry, or none if it is zero; both indices count from 0.
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> Option<Formula<'a>> {
        self.entries.iter().find(|entry| (entry.row, entry.column) == (row, column)).map(|entry| entry.value)
    }
}

impl GroupMethod {
    /// Describes the method, to follow the word "solved".
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::ClosedForm => "in closed form",
            Self::Factorization => "by factorisation with partial pivoting",
        }
    }
}

impl fmt::Display for Equation<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.left, self.right)
    }
}

impl<'a> Kernel<'a> {
    /// A function without code, with the counts of functions, divisions, multiplications and additions.
    #[doc(hidden)]
    #[must_use]
    pub const fn new(function: &'a str, operations: [usize; 4]) -> Self {
        Self { function, operations: Operations::new(operations), code: KernelCode::NONE }
    }
}

impl KernelCode<'_> {
    /// No code.
    pub const NONE: Self = Self { steps: &[], checks: &[], results: &[] };
}

impl Operations {
    /// The counts of functions, divisions, multiplications and additions.
    #[doc(hidden)]
    #[must_use]
    pub const fn new([functions, divisions, multiplications, additions]: [usize; 4]) -> Self {
        Self { functions, divisions, multiplications, additions }
    }
}

impl<'a> KernelCheck<'a> {
    /// Its numbers.
    #[must_use]
    pub fn of(&self) -> &[Formula<'a>] {
        match self {
            Self::Nonzero(of) | Self::Positive(of) | Self::Moderate(of) => of,
            Self::Regular(of) | Self::Apart(of) => of,
            Self::Open(of) => of,
        }
    }
}
