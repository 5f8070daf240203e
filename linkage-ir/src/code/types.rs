//! Types of compiled code.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// The name of a type of the runtime, or of one of its traits.
pub type Known = &'static str;

/// A type.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Type {
    /// The scalar `T`.
    Scalar,
    /// `&'static str`
    Text,
    /// `bool`
    Flag,
    /// `usize`
    Count,
    /// One number for each of several lanes: `[T; W]`.
    Lanes,
    /// `Self`
    Itself,
    /// A type of a trait: `Self::Name`.
    OfTrait(#[cfg_attr(feature = "serde", serde(with = "of_runtime"))] Known),
    /// A type of the mechanism over the scalar: `Name<T>`.
    Own(String),
    /// A type of the mechanism over the scalar of twice the precision: `Name<Wide>`.
    Wide(String),
    /// A type of the mechanism without a scalar: `Name`.
    Bare(String),
    /// One quantity for each of the points or outputs: `Name<Item>`.
    Each(String, Box<Type>),
    /// A column with its length as a type: `Column<Item, D<2>>`.
    Column(Box<Type>, usize),
    /// A column of numbers.
    Vector(usize),
    /// A matrix of numbers: rows, columns.
    Matrix(usize, usize),
    /// `Point2<T>`
    Point,
    /// `Vector2<T>`
    Plane,
    /// A type of the runtime with const generics: `Name<T, 2>`.
    Runtime(#[cfg_attr(feature = "serde", serde(with = "of_runtime"))] Known, Vec<usize>),
    /// A type of the runtime with dimensions as types: `Name<T, D<2>>`.
    Sized(#[cfg_attr(feature = "serde", serde(with = "of_runtime"))] Known, Vec<usize>),
    /// A generic type of the runtime: `Name<Item>`.
    Around(#[cfg_attr(feature = "serde", serde(with = "of_runtime"))] Known, Box<Type>),
    /// An array.
    List(Box<Type>, usize),
    /// A tuple.
    Tuple(Vec<Type>),
    /// `ReducedMotion<Pose, Rates, T, U, V>`: the values that functions of scenes share.
    ReducedMotion {
        /// The type of the pose.
        pose: String,
        /// The type of the rates.
        rates: String,
        /// The number of unknowns.
        unknowns: usize,
        /// The number of inputs.
        inputs: usize,
    },
    /// `StateRates<Rates, Inputs>`: `q'` and `v''`.
    StateRates {
        /// The type of the rates.
        rates: String,
        /// The type of the inputs.
        inputs: String,
    },
    /// `impl Iterator<Item = Result<(Branch, Pose), PositionError>>`
    Branches {
        /// The type of the branch.
        branch: String,
        /// The type of the pose.
        pose: String,
    },
    /// `impl Iterator<Item>`, and `Clone`.
    Iterator {
        /// The type of the items.
        item: Box<Type>,
        /// True if it can be cloned.
        is_cloned: bool,
    },
}

/// The names of the types of one driver, or of one of its scenes.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TypeNames {
    /// The type that has the functions.
    pub itself: String,
    /// The driver, with the kinematics.
    pub driver: String,
    /// The inputs by name.
    pub inputs: String,
    /// A position.
    pub pose: String,
    /// All coordinates by name.
    pub coordinates: String,
    /// Their rates.
    pub rates: String,
    /// Their accelerations.
    pub accelerations: String,
    /// Their jerks.
    pub jerks: String,
    /// The points by name.
    pub points: String,
    /// The outputs by name.
    pub outputs: String,
    /// A position with rates and accelerations.
    pub motion: String,
    /// The result of `kinematics`.
    pub kinematics: String,
    /// The result of `full_kinematics`.
    pub full_kinematics: String,
    /// The columns of many positions.
    pub columns: String,
    /// The assembly mode.
    pub branch: String,
}

impl TypeNames {
    /// The name of a function of the driver in the call lists of scenes.
    #[must_use]
    pub fn function(&self, name: &str) -> String {
        format!("{}::{name}", self.driver)
    }
}

/// Names of types of the runtime and of its traits, which are known.
#[cfg(feature = "serde")]
mod of_runtime {
    use alloc::string::String;

    use serde::{Deserialize, Deserializer, Serializer, de, ser};

    /// Those of traits, then those of the runtime.
    const KNOWN: [&str; 39] = [
        "Accelerations",
        "Branch",
        "Coordinates",
        "Inputs",
        "Pose",
        "Rates",
        "Reactions",
        "AnyBranch",
        "Balance",
        "Bearing",
        "Column",
        "Contact",
        "ContactCoordinate",
        "ContactLaw::Bearing",
        "ContactLaw::Friction",
        "ContactLaw::Stop",
        "Energy",
        "Equations",
        "Factorization",
        "Limits",
        "Loops",
        "Matrix",
        "Memory",
        "NearestTurns",
        "Option",
        "Power",
        "Prescribed",
        "Ranged",
        "ReactionRow",
        "ReducedMotion",
        "SMatrix",
        "SVector",
        "Solution",
        "StateParts",
        "StateRates",
        "Triangle",
        "Unknown::Length",
        "Unreduced",
        "Vector",
    ];

    pub(super) fn serialize<S: Serializer>(name: &&'static str, serializer: S) -> Result<S::Ok, S::Error> {
        match KNOWN.contains(name) {
            true => serializer.serialize_str(name),
            false => Err(ser::Error::custom(format_args!("`{name}` is not among the known types"))),
        }
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static str, D::Error> {
        let text = String::deserialize(deserializer)?;
        let known = KNOWN.into_iter().find(|known| *known == text);
        known.ok_or_else(|| de::Error::custom(format_args!("there is no type `{text}`")))
    }
}
