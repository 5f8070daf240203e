//! The forms of arguments and results, by the types of emitted code.

use linkage_ir::code::{self, Passed, Type};
use serde::{Deserialize, Serialize};

use crate::program::Driver;

/// An argument.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Argument {
    /// Its name.
    pub name: String,
    /// The form of its values.
    pub shape: Shape,
}

/// The form of a value: its numbers by name and by place.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shape {
    Number,
    Flag,
    Count,
    Text,
    /// A value with fields: one of the mechanism's types.
    Record(Record),
    /// One quantity for each of the points or outputs.
    Each(Vec<String>, Box<Shape>),
    /// x and y.
    Point,
    Vector(usize),
    /// Rows and columns; its value is the list of its columns.
    Matrix(usize, usize),
    List(Box<Shape>, usize),
    /// Any number of them.
    Many(Box<Shape>),
    Tuple(Vec<Shape>),
    Perhaps(Box<Shape>),
    /// A value of the runtime.
    Other(String),
}

/// The types of a mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Record {
    Mechanism,
    Scene,
    Inputs,
    Pose,
    Branch,
    Coordinates,
    Rates,
    Accelerations,
    Jerks,
    Motion,
    Kinematics,
    FullKinematics,
}

impl Driver {
    /// The arguments of a function of the type with this name.
    pub(crate) fn arguments(&self, of: &code::Function, itself: &str) -> Vec<Argument> {
        let argument = |of: &code::Argument| Argument {
            name: of.name.clone(),
            shape: match passed(&of.passed) {
                Some(of) => self.shape(of, itself),
                None => Shape::Other("turns".to_owned()),
            },
        };
        of.arguments.iter().map(argument).collect()
    }

    /// The form of the values of a type.
    fn shape(&self, of: &Type, itself: &str) -> Shape {
        if let Some(record) = self.record(of, itself) {
            return Shape::Record(record);
        }
        let boxed = |of: &Type| Box::new(self.shape(of, itself));
        match of {
            Type::Scalar | Type::Lanes => Shape::Number,
            Type::Text => Shape::Text,
            Type::Flag => Shape::Flag,
            Type::Count => Shape::Count,
            Type::Itself => Shape::Other(itself.to_owned()),
            Type::Own(name) | Type::Wide(name) | Type::Bare(name) => Shape::Other(name.clone()),
            Type::Each(name, of) => {
                let names = if *name == self.types.points { &self.points } else { &self.outputs };
                Shape::Each(names.iter().map(|name| self.names.text(*name).to_owned()).collect(), boxed(of))
            }
            Type::Column(of, count) => Shape::List(boxed(of), *count),
            Type::Vector(count) => Shape::Vector(*count),
            Type::Matrix(rows, columns) => Shape::Matrix(*rows, *columns),
            Type::Sized("Matrix", sizes) => match sizes.as_slice() {
                &[rows, columns] => Shape::Matrix(rows, columns),
                _ => Shape::Other("Matrix".to_owned()),
            },
            Type::Point => Shape::Point,
            Type::Plane => Shape::Vector(2),
            Type::OfTrait(name) | Type::Runtime(name, _) | Type::Sized(name, _) => Shape::Other((*name).to_owned()),
            Type::Around("Option", of) => Shape::Perhaps(boxed(of)),
            Type::Around(name, _) => Shape::Other((*name).to_owned()),
            Type::List(of, count) => Shape::List(boxed(of), *count),
            Type::Tuple(all) => Shape::Tuple(all.iter().map(|of| self.shape(of, itself)).collect()),
            Type::ReducedMotion { .. } => Shape::Other("ReducedMotion".to_owned()),
            Type::StateRates { .. } => Shape::Other("StateRates".to_owned()),
            Type::Branches { .. } => Shape::Many(Box::new(Shape::Other("Assembled".to_owned()))),
            Type::Iterator { item, .. } => Shape::Many(boxed(item)),
        }
    }

    /// The type of the mechanism that a type is, in a function of the type with this name.
    pub(crate) fn record(&self, of: &Type, itself: &str) -> Option<Record> {
        let name = match of {
            // Of the types with functions of other types only a branch has values of its own type.
            Type::Itself => return Some(Record::Branch),
            Type::OfTrait(name) => {
                return match *name {
                    "Pose" => Some(Record::Pose),
                    "Branch" => Some(Record::Branch),
                    "Inputs" => Some(Record::Inputs),
                    "Coordinates" => Some(Record::Coordinates),
                    "Rates" => Some(Record::Rates),
                    "Accelerations" => Some(Record::Accelerations),
                    _ => None,
                };
            }
            Type::Own(name) | Type::Wide(name) | Type::Bare(name) => name.as_str(),
            _ => return None,
        };
        let types = &self.types;
        let all = [
            (types.driver.as_str(), Record::Mechanism),
            (itself, Record::Scene),
            (&types.inputs, Record::Inputs),
            (&types.pose, Record::Pose),
            (&types.branch, Record::Branch),
            (&types.coordinates, Record::Coordinates),
            (&types.rates, Record::Rates),
            (&types.accelerations, Record::Accelerations),
            (&types.jerks, Record::Jerks),
            (&types.motion, Record::Motion),
            (&types.kinematics, Record::Kinematics),
            (&types.full_kinematics, Record::FullKinematics),
        ];
        all.into_iter().find(|(other, _)| *other == name).map(|(_, record)| record)
    }
}

/// The type of an argument, which turns have not.
pub(crate) fn passed(of: &Passed) -> Option<&Type> {
    match of {
        Passed::ByValue(of) | Passed::ByReference(of) | Passed::ByMutableReference(of) | Passed::Converted(of) => {
            Some(of)
        }
        Passed::Turns => None,
    }
}
