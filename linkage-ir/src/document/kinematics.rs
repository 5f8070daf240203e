//! The kinematics of a mechanism.

use core::fmt;

use super::{Formula, Item, KinematicChain, Lent, List, Storage, Text};
use crate::{CheckKind, Operations};

/// `left` = `right`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Equation<F> {
    /// The left side.
    pub left: F,
    /// The right side.
    pub right: F,
}

/// An entry of a [`FormulaMatrix`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Entry<F> {
    /// The row, counted from 0.
    pub row: usize,
    /// The column, counted from 0.
    pub column: usize,
    /// The entry itself.
    pub value: F,
}

/// A condition in the code of a function, for the results that depend on the first of its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum KernelCheck<F> {
    /// A determinant is not zero within rounding errors: the determinant, its scale.
    Regular([F; 2]),
    /// A number is not zero.
    Nonzero([F; 1]),
    /// A length is not negative.
    Positive([F; 1]),
    /// Two points do not coincide within rounding errors: their distance, its scale.
    Apart([F; 2]),
    /// A product neither underflows nor overflows.
    Moderate([F; 1]),
    /// A triangle has an area: the factors of its squared half chord, the squared sum of its sides, the squared distance
    /// of their ends.
    Open([F; 4]),
}

records! {
    /// A parameter or coordinate.
    Symbol {
        /// The name in the `linkage!` language: `theta3`.
        name: Text<'a, S>,
        /// The displayed name: θ₃.
        formula: Formula<'a, S>,
    }

    /// A matrix of formulas.
    FormulaMatrix {
        /// The name.
        name: Formula<'a, S>,
        /// A factor of every entry, written before the brackets.
        factor: Option<Formula<'a, S>>,
        /// The number of rows.
        rows: usize,
        /// The number of columns.
        columns: usize,
        /// The entries that are not zero.
        entries: List<'a, S, Entry<Formula<'a, S>>>,
    }

    /// The root that tells the two solutions of a [`Group`] apart by its sign.
    Root {
        /// The root.
        formula: Formula<'a, S>,
        /// The names of the branches on which it is positive and negative.
        branches: [Text<'a, S>; 2],
    }

    /// Unknowns that are solved for together.
    Group {
        /// The unknowns.
        unknowns: List<'a, S, Formula<'a, S>>,
        /// The constraint equations that determine them: indices of [`Derivation::residual`].
        equations: List<'a, S, usize>,
        /// The kind of group: the Assur group, or a description of any other.
        kind: Text<'a, S>,
        /// The kind as data, with one case for all whose positions Newton's method finds.
        form: GroupForm,
        /// The position in closed form, each equation in terms of those before it; empty if Newton's method finds it.
        position: List<'a, S, Equation<Formula<'a, S>>>,
        /// The root that tells two solutions apart.
        root: Option<Root<'a, S>>,
        /// The method that solves the linear system.
        method: GroupMethod,
        /// The determinant of the block of J, if it has a formula.
        determinant: Option<Equation<Formula<'a, S>>>,
        /// The inverse of the block of J, if it has a formula.
        inverse: Option<FormulaMatrix<'a, S>>,
    }

    /// A point or output.
    Quantity {
        /// The name in the `linkage!` language.
        name: Text<'a, S>,
        /// The components.
        value: List<'a, S, Equation<Formula<'a, S>>>,
        /// The derivatives of the components with respect to the inputs.
        ratios: List<'a, S, Equation<Formula<'a, S>>>,
        /// The second derivatives of the components with respect to the inputs; empty unless the mechanism requests them.
        ratio_derivatives: List<'a, S, Equation<Formula<'a, S>>>,
        /// The derivatives of the components with respect to the parameters, without those that are zero; empty unless the
        /// mechanism requests them.
        sensitivities: List<'a, S, Equation<Formula<'a, S>>>,
    }

    /// The derivatives of the unknowns with respect to the parameters while the inputs are held.
    Sensitivity {
        /// ∂Ψ/∂p, the columns in the order of the parameters.
        jacobian: FormulaMatrix<'a, S>,
        /// ∂u/∂p if it has a formula, without the derivatives that are zero.
        formulas: List<'a, S, Equation<Formula<'a, S>>>,
    }

    /// An emitted function.
    Kernel {
        /// The name of the function.
        function: Text<'a, S>,
        /// The operations of one call. What the function has in common with others that are inlined in it counts once.
        operations: Operations,
        /// Its code as formulas; empty without `derive fpcore`.
        code: KernelCode<'a, S>,
    }

    /// The numbers that an emitted function computes, by formulas in the order of its operations. It is empty for a function
    /// without formulas, such as one that iterates. `Document::fpcore` of the crate `linkage` writes it for other programs.
    ///
    /// Names are those of FPCore: each is an argument, or the left side of a step.
    KernelCode {
        /// The intermediate results.
        steps: List<'a, S, Equation<Formula<'a, S>>>,
        /// The conditions under which it computes these results.
        checks: List<'a, S, KernelCheck<Formula<'a, S>>>,
        /// The numbers that it returns.
        results: List<'a, S, KernelResult<'a, S>>,
    }

    /// A number that a function returns.
    KernelResult {
        /// Its place in the result: `.points.c.x`.
        place: Text<'a, S>,
        /// Its value.
        value: Formula<'a, S>,
    }

    /// The kinematics of a mechanism, derived from its constraint equations Ψ(u, v) = 0, where u are the unknowns and v the
    /// inputs.
    Derivation {
        /// The mechanism, or the driver of one.
        mechanism: Text<'a, S>,
        /// The parameters.
        parameters: List<'a, S, Symbol<'a, S>>,
        /// The inputs v.
        inputs: List<'a, S, Symbol<'a, S>>,
        /// The unknowns u.
        unknowns: List<'a, S, Symbol<'a, S>>,
        /// Ψ, the residuals of the constraint equations.
        residual: List<'a, S, Equation<Formula<'a, S>>>,
        /// The residuals of loops and equations that are declared as implied by the others.
        implied: List<'a, S, Equation<Formula<'a, S>>>,
        /// J = ∂Ψ/∂u.
        jacobian_unknowns: FormulaMatrix<'a, S>,
        /// A = ∂Ψ/∂v.
        jacobian_inputs: FormulaMatrix<'a, S>,
        /// The groups, in the order in which they are solved.
        groups: List<'a, S, Group<'a, S>>,
        /// det J, the product of the determinants of the groups; none if a group has no formula.
        determinant: Option<Equation<Formula<'a, S>>>,
        /// The velocity ratios ∂u/∂v.
        ratios: List<'a, S, Equation<Formula<'a, S>>>,
        /// ∂²u/∂v∂v, if it has a formula and the mechanism requests it.
        ratio_derivatives: Option<List<'a, S, Equation<Formula<'a, S>>>>,
        /// γ, the quadratic velocity terms: the second time derivative of Ψ without the terms of accelerations.
        gamma: List<'a, S, Equation<Formula<'a, S>>>,
        /// η: the third time derivative of Ψ without the terms of jerks; none unless the mechanism requests the jerk.
        jerk: Option<List<'a, S, Equation<Formula<'a, S>>>>,
        /// The sensitivities to the parameters; none unless the mechanism requests them.
        sensitivity: Option<Sensitivity<'a, S>>,
        /// The points and their derivatives.
        points: List<'a, S, Quantity<'a, S>>,
        /// The outputs and their derivatives.
        outputs: List<'a, S, Quantity<'a, S>>,
        /// The conditions under which the simplified formulas hold, such as l₄ ≠ 0.
        conditions: List<'a, S, Formula<'a, S>>,
        /// The links and joints; none if the vectors of loops do not show them.
        chain: Option<KinematicChain<'a, S>>,
        /// The emitted functions.
        kernels: List<'a, S, Kernel<'a, S>>,
    }
}

/// The method that solves the linear system of a [`Group`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum GroupMethod {
    /// The inverse by formula: the adjugate divided by the determinant.
    ClosedForm,
    /// LU factorisation with partial pivoting.
    Factorization,
}

/// The form of the equations of a [`Group`]: the Assur group, with R for a joint that turns and P for one that slides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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

impl<'a, S: Storage<'a>> Derivation<'a, S> {
    /// The numbers n of coordinates and p of constraint equations.
    #[must_use]
    pub fn counts(&self) -> Counts {
        Counts { coordinates: self.inputs.len() + self.unknowns.len(), equations: self.residual.len() }
    }
}

impl<'a, S: Storage<'a>> FormulaMatrix<'a, S> {
    /// Returns an entry, or none if it is zero; both indices count from 0.
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> Option<Formula<'a, S>> {
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

impl<F: fmt::Display> fmt::Display for Equation<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.left, self.right)
    }
}

impl<'a, F: Item + Copy + 'a> Kernel<'a, Lent<F>> {
    /// A function without code, with the counts of functions, divisions, multiplications and additions.
    #[doc(hidden)]
    #[must_use]
    pub const fn new(function: &'a str, operations: [usize; 4]) -> Self {
        Self { function, operations: Operations::new(operations), code: KernelCode::NONE }
    }
}

impl<'a, F: Item + Copy + 'a> KernelCode<'a, Lent<F>> {
    /// No code.
    pub const NONE: Self = Self { steps: &[], checks: &[], results: &[] };
}

impl<F: Copy> KernelCheck<F> {
    /// The check of this kind; none for another number of formulas than it has.
    #[must_use]
    pub fn new(kind: CheckKind, of: &[F]) -> Option<Self> {
        match (kind, of) {
            (CheckKind::Regular, &[determinant, scale]) => Some(Self::Regular([determinant, scale])),
            (CheckKind::Nonzero, &[number]) => Some(Self::Nonzero([number])),
            (CheckKind::Positive, &[length]) => Some(Self::Positive([length])),
            (CheckKind::Apart, &[distance, scale]) => Some(Self::Apart([distance, scale])),
            (CheckKind::Moderate, &[product]) => Some(Self::Moderate([product])),
            (CheckKind::Open, &[low, high, reach, distance]) => Some(Self::Open([low, high, reach, distance])),
            _ => None,
        }
    }

    /// Its numbers.
    #[must_use]
    pub fn of(&self) -> &[F] {
        match self {
            Self::Nonzero(of) | Self::Positive(of) | Self::Moderate(of) => of,
            Self::Regular(of) | Self::Apart(of) => of,
            Self::Open(of) => of,
        }
    }
}
