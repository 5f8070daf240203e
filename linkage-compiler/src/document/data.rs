//! Documents as plain data: the types of `DERIVATION` with numbers for formulas.

use super::table::{Number, Numbers, Table};
use crate::program::{CheckKind, Operations};
use crate::structure::{Choice, GroupKind};

/// A parameter, a coordinate, or a force that has a name.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Symbol {
    pub name: String,
    pub formula: Number,
}

/// A left and a right side.
pub type Equation = [Number; 2];

/// A matrix; its entries are those that are not zero, by row and column.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Matrix {
    pub name: Number,
    pub factor: Option<Number>,
    pub rows: usize,
    pub columns: usize,
    pub entries: Vec<([usize; 2], Number)>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Method {
    ClosedForm,
    Factorization,
}

/// A root, whose sign makes a choice.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Root {
    pub formula: Number,
    pub choice: Choice,
}

/// Unknowns that are solved for together.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Group {
    pub unknowns: Vec<Number>,
    pub equations: Vec<usize>,
    pub kind: GroupKind,
    pub position: Vec<Equation>,
    pub root: Option<Root>,
    pub method: Method,
    pub determinant: Option<Equation>,
    pub inverse: Option<Matrix>,
}

/// A point or an output.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quantity {
    pub name: String,
    pub value: Vec<Equation>,
    pub ratios: Vec<Equation>,
    pub ratio_derivatives: Vec<Equation>,
    pub sensitivities: Vec<Equation>,
}

#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sensitivity {
    pub jacobian: Matrix,
    pub formulas: Vec<Equation>,
}

/// A public function, its operations and its code.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Kernel {
    pub function: String,
    pub operations: Operations,
    pub code: KernelCode,
}

/// The formulas of a function: the steps are names and values, the results places and values.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct KernelCode {
    pub steps: Vec<Equation>,
    pub checks: Vec<(CheckKind, Vec<Number>)>,
    pub results: Vec<(String, Number)>,
}

/// The links and joints of a mechanism.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Chain {
    /// The name of each link and the coordinates in its angle; the ground comes first.
    pub links: Vec<(String, Vec<String>)>,
    /// The two links of each joint, and the coordinate along which it slides.
    pub joints: Vec<([usize; 2], Option<String>)>,
    /// The number of conditions between coordinates.
    pub conditions: usize,
}

/// The document of a driver.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Document {
    pub table: Table,
    pub mechanism: String,
    pub parameters: Vec<Symbol>,
    pub inputs: Vec<Symbol>,
    pub unknowns: Vec<Symbol>,
    pub residual: Vec<Equation>,
    pub implied: Vec<Equation>,
    pub jacobian_unknowns: Matrix,
    pub jacobian_inputs: Matrix,
    pub groups: Vec<Group>,
    pub determinant: Option<Equation>,
    pub ratios: Vec<Equation>,
    pub ratio_derivatives: Option<Vec<Equation>>,
    pub gamma: Vec<Equation>,
    pub jerk: Option<Vec<Equation>>,
    pub sensitivity: Option<Sensitivity>,
    pub points: Vec<Quantity>,
    pub outputs: Vec<Quantity>,
    pub conditions: Vec<Number>,
    pub chain: Option<Chain>,
    pub kernels: Vec<Kernel>,
}

/// The document of a scene.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SceneDocument {
    pub table: Table,
    pub scene: String,
    pub mechanism: String,
    pub parameters: Vec<Symbol>,
    pub mass_matrix: Vec<Equation>,
    pub forces: Vec<Effect>,
    pub frictions_and_stops: Vec<ContactEffect>,
    pub drives: Vec<Equation>,
    pub potential: Option<Equation>,
    pub joints: Vec<JointForce>,
    pub multipliers: Vec<Number>,
    pub contacts: Vec<Symbol>,
    pub kernels: Vec<Kernel>,
}

/// The document of an analysis by hand, line by line.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SheetDocument {
    pub table: Table,
    pub mechanism: String,
    /// J' and A'.
    pub jacobian_rates: [Matrix; 2],
    /// (J u')_u and (A v')_v.
    pub jacobians_of_rates: [Matrix; 2],
    /// H1, H2, H3 and H0.
    pub terms: [Matrix; 4],
    /// The parts of gamma by u', by v', and by both.
    pub gamma: [Matrix; 3],
    /// `u''` by both methods.
    pub accelerations: [Vec<Equation>; 2],
    pub choices: Vec<DriverChoice>,
    pub turning: Vec<Turning>,
    /// The vectors of points, each once.
    pub vectors: Vec<Vector>,
    pub points: Vec<PointVectors>,
    pub conditions: Vec<Number>,
}

/// A choice of inputs, and the determinant of J in the other coordinates if it has a formula.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DriverChoice {
    pub inputs: Vec<Number>,
    pub determinant: Option<Equation>,
}

/// The skew matrices of the rate and acceleration of a link, which turns with these coordinates.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Turning {
    pub with: Vec<String>,
    pub rate: Matrix,
    pub acceleration: Matrix,
}

/// The vectors that lead to a point, by their places in the list of all; its position, velocity and acceleration as sums.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointVectors {
    pub name: String,
    pub vectors: Vec<usize>,
    pub sums: [Equation; 3],
}

/// A vector, the matrix and the rates whose product is its velocity, its velocity and its acceleration.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vector {
    pub vector: Matrix,
    pub matrix: Matrix,
    pub rates: Matrix,
    pub velocity: Matrix,
    pub acceleration: Matrix,
}

/// The contribution of a body or an effect to the generalised forces.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Effect {
    pub name: String,
    pub forces: Vec<Equation>,
}

/// A friction or a stop.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactEffect {
    pub name: String,
    pub force: Number,
    pub along: Equation,
    pub bound: Number,
    pub bearing: Option<Symbol>,
    pub rebound: Option<Number>,
    pub forces: Vec<Equation>,
}

/// The force of a joint on a link.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointForce {
    pub name: String,
    pub components: [Equation; 2],
}

impl Numbers for Number {
    fn each(&mut self, visit: &mut dyn FnMut(&mut Number)) {
        visit(self);
    }
}

impl<T: Numbers, const N: usize> Numbers for [T; N] {
    fn each(&mut self, visit: &mut dyn FnMut(&mut Number)) {
        self.iter_mut().for_each(|one| one.each(visit));
    }
}

impl<T: Numbers> Numbers for Vec<T> {
    fn each(&mut self, visit: &mut dyn FnMut(&mut Number)) {
        self.iter_mut().for_each(|one| one.each(visit));
    }
}

impl<T: Numbers> Numbers for Option<T> {
    fn each(&mut self, visit: &mut dyn FnMut(&mut Number)) {
        self.iter_mut().for_each(|one| one.each(visit));
    }
}

/// A second part with numbers.
impl<K, T: Numbers> Numbers for (K, T) {
    fn each(&mut self, visit: &mut dyn FnMut(&mut Number)) {
        self.1.each(visit);
    }
}

macro_rules! numbers {
    ($($Type:ident: $($field:ident)+;)+) => {$(
        impl Numbers for $Type {
            fn each(&mut self, visit: &mut dyn FnMut(&mut Number)) {
                $(self.$field.each(visit);)+
            }
        }
    )+};
}

numbers! {
    Symbol: formula;
    Matrix: name factor entries;
    Root: formula;
    Group: unknowns position root determinant inverse;
    Quantity: value ratios ratio_derivatives sensitivities;
    Sensitivity: jacobian formulas;
    Kernel: code;
    KernelCode: steps checks results;
    Document: parameters inputs unknowns residual implied jacobian_unknowns jacobian_inputs groups determinant ratios
        ratio_derivatives gamma jerk sensitivity points outputs conditions kernels;
    DriverChoice: inputs determinant;
    Turning: rate acceleration;
    PointVectors: sums;
    Vector: vector matrix rates velocity acceleration;
    SheetDocument: jacobian_rates jacobians_of_rates terms gamma accelerations choices turning vectors points
        conditions;
    Effect: forces;
    ContactEffect: force along bound bearing rebound forces;
    JointForce: components;
    SceneDocument: parameters mass_matrix forces frictions_and_stops drives potential joints multipliers contacts kernels;
}
