//! Compiled mechanisms as data: their names, their types and their functions.

use std::sync::Arc;

use linkage_ir::Name;
use linkage_ir::code::{Function, Names, TypeNames};
use linkage_runtime::InputValues;
use serde::{Deserialize, Serialize};

use crate::formulas::Formulas;

/// One mechanism, or one choice of inputs of a mechanism with several.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Driver {
    /// The mechanism that it is a driver of.
    pub(crate) mechanism: String,
    /// The name in errors.
    pub(crate) name: Arc<str>,
    pub(crate) names: Names,
    pub(crate) types: TypeNames,
    pub(crate) parameters: Vec<Name>,
    pub(crate) about_parameters: Vec<Parameter>,
    /// All coordinates, in the order of their fields; the dependent ones; the inputs.
    pub(crate) coordinates: Vec<Name>,
    pub(crate) unknowns: Vec<Name>,
    pub(crate) inputs: Vec<Name>,
    /// The names of the inputs as written, and true for each angle.
    pub(crate) input_texts: Arc<[Arc<str>]>,
    pub(crate) input_angles: Vec<bool>,
    /// The names of all coordinates as written, and true for each angle.
    pub(crate) about_coordinates: Vec<Coordinate>,
    pub(crate) points: Vec<Name>,
    pub(crate) outputs: Vec<Name>,
    pub(crate) sides: Vec<Side>,
    /// The groups whose positions are listed by number: the field, and the most positions.
    pub(crate) modes: Vec<(Name, usize)>,
    pub(crate) turns: Vec<Name>,
    /// The user functions, each with the names of its value and its derivatives, and the number of arguments.
    pub(crate) users: Vec<UserFunction>,
    pub(crate) functions: Vec<Function>,
    pub(crate) of_pose: Vec<Function>,
    pub(crate) of_branch: Vec<Function>,
    /// The functions of the traits of the runtime.
    pub(crate) traits: Vec<Implementation>,
    pub(crate) scenes: Vec<Scene>,
    pub(crate) lanes: Lanes,
    pub(crate) written: Written,
    /// The formulas over numbers of any kind, with `derive intervals`.
    pub(crate) formulas: Option<Formulas>,
}

/// The names as written, and the groups: the constants of the traits of the runtime.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) struct Written {
    pub(crate) unknowns: Vec<String>,
    pub(crate) unknown_angles: Vec<bool>,
    pub(crate) groups: Vec<Group>,
    pub(crate) ranges: Vec<String>,
    pub(crate) points: Vec<String>,
    pub(crate) outputs: Vec<String>,
    /// None without `derive drawing`.
    pub(crate) drawing: Option<Drawing>,
}

/// The joints of a drawing by name, and its parts.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) struct Drawing {
    pub(crate) joints: Vec<String>,
    pub(crate) parts: Vec<Part>,
}

/// A part of a drawing, by places of joints, as `linkage_runtime::skeleton::Part`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Part {
    Ground(usize),
    Bar { joints: Vec<usize>, is_driven: bool },
    Slider(usize),
    Sleeve { pin: usize, on: usize, towards: Option<usize> },
    Trace(usize),
}

impl Part {
    /// The places of its joints.
    pub(crate) fn joints(&self) -> Vec<usize> {
        match self {
            Self::Ground(joint) | Self::Slider(joint) | Self::Trace(joint) => vec![*joint],
            Self::Bar { joints, .. } => joints.clone(),
            Self::Sleeve { pin, on, towards } => [*pin, *on].into_iter().chain(*towards).collect(),
        }
    }
}

/// Unknowns that are solved together, by indices, and the equations that determine them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Group {
    pub(crate) name: String,
    pub(crate) equations: Vec<usize>,
    pub(crate) unknowns: Vec<usize>,
}

/// The columns of many positions.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) struct Lanes {
    /// The names of the given columns: parameters, inputs or a guess, rates, accelerations.
    pub(crate) given: Vec<String>,
    /// The number of inputs, or of coordinates of a guess.
    pub(crate) start: usize,
    /// The names of the found columns, and the number of those before angles, points and outputs.
    pub(crate) found: Vec<String>,
    pub(crate) coordinates: usize,
}

impl Driver {
    /// The inputs at which something failed.
    pub(crate) fn input_values(&self, values: &[f64]) -> InputValues<Arc<str>> {
        let mut first = [0.0; 3];
        first.iter_mut().zip(values).for_each(|(to, value)| *to = *value);
        InputValues::new(Arc::clone(&self.input_texts), &self.input_angles, first)
    }
}

/// A scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Scene {
    /// The name in errors.
    pub(crate) name: Arc<str>,
    /// The field that holds the mechanism.
    pub(crate) field: Name,
    pub(crate) parameters: Vec<Name>,
    pub(crate) about_parameters: Vec<Parameter>,
    pub(crate) functions: Vec<Function>,
    pub(crate) implementation: Option<Implementation>,
    pub(crate) contacts: usize,
    pub(crate) has_bearings: bool,
    pub(crate) kinks: Vec<Kink>,
    pub(crate) joints: Vec<Joint>,
    /// The fields of the forces in its joints: a number, or a list of this length.
    pub(crate) forces: Vec<(Name, Option<usize>)>,
}

/// A kink or a jump of a law.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Kink {
    pub(crate) effect: String,
    pub(crate) is_timed: bool,
}

/// A joint whose force a scene shows, as `linkage_runtime::Joint`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Joint {
    pub(crate) name: String,
    /// The point at a pin; none of a guide.
    pub(crate) at: Option<String>,
    /// The link on which the force acts.
    pub(crate) on: String,
    /// Its place among the forces in joints of the mechanism.
    pub(crate) place: usize,
}

/// The functions of a trait of the runtime.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Implementation {
    pub(crate) of: String,
    pub(crate) functions: Vec<Function>,
}

/// A parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Parameter {
    /// The name as written.
    pub(crate) text: String,
    pub(crate) default: Option<f64>,
}

/// A coordinate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Coordinate {
    /// The name as written.
    pub(crate) text: String,
    pub(crate) is_angle: bool,
}

/// The choice between the two solutions of a group.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Side {
    pub(crate) field: Name,
    /// The solution of the positive root, and that of the negative one.
    pub(crate) solutions: [Arc<str>; 2],
    pub(crate) meaning: String,
}

/// A user function.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct UserFunction {
    /// The names of its value and its derivatives.
    pub(crate) names: Vec<String>,
    pub(crate) arguments: usize,
}
