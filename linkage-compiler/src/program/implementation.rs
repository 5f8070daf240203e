//! Functions outside of the main `impl` block of a type: those of a trait of the runtime, by which generic algorithms
//! call the functions of a mechanism, and those of other types.

use std::collections::BTreeSet;

use super::expression::Type;
use super::function::{Access, Argument, Body, Function, Passed};
use super::signatures::{Coordinate, total};
use crate::derivation::{self, Derivation, Part};
use crate::ids::Id;

/// An implementation of a trait, or functions of a type.
pub struct Implementation<B> {
    pub of: Implemented,
    /// The type.
    pub on: String,
    /// True if the type has the scalar as an argument.
    pub is_generic: bool,
    /// The type of the errors of its functions.
    pub error: &'static str,
    pub types: Vec<(&'static str, Associated)>,
    pub constants: Vec<(&'static str, ConstantValue)>,
    pub functions: Vec<Function<B>>,
}

/// The traits of the runtime that mechanisms and scenes implement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Implemented {
    /// No trait: functions of the type itself.
    Itself,
    Mechanism,
    Kinematic,
    Assembly,
    Branches,
    Lanes,
    Skeleton,
    Scene,
}

impl Implemented {
    /// The name of the trait.
    pub fn name(self) -> Option<&'static str> {
        match self {
            Self::Itself => None,
            Self::Mechanism => Some("Mechanism"),
            Self::Kinematic => Some("Kinematic"),
            Self::Assembly => Some("Assembly"),
            Self::Branches => Some("Branches"),
            Self::Lanes => Some("Lanes"),
            Self::Skeleton => Some("Skeleton"),
            Self::Scene => Some("Scene"),
        }
    }
}

/// An associated type.
pub enum Associated {
    Type(Type),
    /// A text of the code.
    Text,
    /// A number as a type.
    Dimension(usize),
    /// A quantity `Q` for each point or output: the type with their names, or an empty list.
    PerQuantity(Option<String>),
}

/// The value of a constant.
pub enum ConstantValue {
    /// The constant of this name of the type itself.
    Own,
    Flag(bool),
    Count(usize),
    Text(String),
    Texts(Vec<String>),
    Flags(Vec<bool>),
    Groups(Vec<Group>),
    Kinks(Vec<Kink>),
    Parts(Vec<Part>),
}

/// A group of equations and the unknowns that it determines, by indices.
#[derive(Debug, Clone)]
pub struct Group {
    pub name: String,
    pub equations: Vec<usize>,
    pub unknowns: Vec<usize>,
}

/// A kink of the laws of a scene.
pub struct Kink {
    /// The name of the effect.
    pub effect: String,
    /// True if it depends on time.
    pub is_timed: bool,
}

impl Group {
    pub(super) fn of(group: &derivation::Group, derivation: &Derivation) -> Self {
        Self {
            name: group.title(derivation),
            equations: group.equations.iter().map(|equation| equation.index()).collect(),
            unknowns: group.unknowns.iter().map(|unknown| unknown.index()).collect(),
        }
    }
}

impl<B> Implementation<B> {
    /// Keeps one of several functions of the same name: the first one that can be had.
    #[must_use]
    pub fn without_choice(mut self, is_had: impl Fn(&Function<B>) -> bool) -> Self {
        let mut kept = BTreeSet::new();
        self.functions.retain(|function| is_had(function) && kept.insert(function.name.clone()));
        self
    }

    /// This implementation with other bodies.
    ///
    /// # Errors
    /// The first error of a body.
    pub fn try_map<C, E>(
        self,
        other: impl FnMut(Function<B>) -> Result<Function<C>, E>,
    ) -> Result<Implementation<C>, E> {
        let Self { of, on, is_generic, error, types, constants, functions } = self;
        let functions = functions.into_iter().map(other).collect::<Result<_, E>>()?;
        Ok(Implementation { of, on, is_generic, error, types, constants, functions })
    }

    /// This implementation without bodies.
    pub fn without_bodies<C>(self) -> Implementation<C> {
        let Self { of, on, is_generic, error, types, constants, functions } = self;
        let functions = functions.into_iter().map(Function::without_body).collect();
        Implementation { of, on, is_generic, error, types, constants, functions }
    }

    /// The trait and the type, for a text.
    pub fn title(&self) -> String {
        match self.of.name() {
            Some(name) => format!("{name} of {}", self.on),
            None => self.on.clone(),
        }
    }
}

/// A function of a trait.
pub(super) fn of_trait<const N: usize>(
    name: &str,
    arguments: [(&str, Passed); N],
    returns: Type,
    body: Body,
) -> Function<Body> {
    let arguments = arguments.map(|(name, passed)| Argument { name: name.to_owned(), passed });
    Function { access: Access::OfTrait, body: Some(body), ..total(name, arguments, returns) }
}

/// A function of a trait that can fail.
pub(super) fn fallible_of_trait<const N: usize>(
    name: &str,
    arguments: [(&str, Passed); N],
    returns: Type,
    body: Body,
) -> Function<Body> {
    Function { is_fallible: true, ..of_trait(name, arguments, returns, body) }
}

/// The constants with the names of some coordinates, and with true for each angle among them.
pub(super) fn named_coordinates(all: &[Coordinate]) -> [ConstantValue; 2] {
    let texts = all.iter().map(|coordinate| coordinate.name.text.clone()).collect();
    let are_angles = all.iter().map(|coordinate| coordinate.is_angle).collect();
    [ConstantValue::Texts(texts), ConstantValue::Flags(are_angles)]
}
