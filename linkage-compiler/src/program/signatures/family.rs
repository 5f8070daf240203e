//! Functions of points and outputs.

use super::Name;
use super::Signatures;
use super::form::fallible;
use crate::model::Request;
use crate::program::expression::Type;
use crate::program::function::{Body, Function};
use crate::program::names::Order;

/// The points or the outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    Points,
    Outputs,
}

impl Family {
    pub fn word(self) -> &'static str {
        match self {
            Self::Points => "point",
            Self::Outputs => "output",
        }
    }

    /// The components of one: 2 of a point, 1 of an output.
    pub fn dimension(self) -> usize {
        self.axes().len()
    }

    /// The endings of the names of the components.
    pub fn axes(self) -> &'static [&'static str] {
        match self {
            Self::Points => &["_x", "_y"],
            Self::Outputs => &[""],
        }
    }

    /// The function of the values or of a derivative with respect to time: points have velocities, outputs rates.
    pub fn function(self, order: usize) -> String {
        let first = match self {
            Self::Points => "_velocities",
            Self::Outputs => "_rates",
        };
        format!("{}{}", self.word(), ["s", first, "_accelerations", "_jerks"][order])
    }

    /// The names of all points or outputs.
    fn of(self, signatures: &Signatures) -> &[Name] {
        match self {
            Self::Points => &signatures.points,
            Self::Outputs => &signatures.outputs,
        }
    }

    /// The names of all points or outputs as the user wrote them.
    pub fn names_as_written(self, signatures: &Signatures) -> Vec<String> {
        self.of(signatures).iter().map(|name| name.text.clone()).collect()
    }

    /// The field names of all points or outputs.
    pub fn names(self, signatures: &Signatures) -> Vec<String> {
        self.of(signatures).iter().map(|name| name.field.clone()).collect()
    }
}

impl Signatures {
    /// True if points, or outputs, are declared.
    pub fn has(&self, family: Family) -> bool {
        !family.of(self).is_empty()
    }

    /// True if points or outputs are declared.
    pub fn has_quantities(&self) -> bool {
        self.has(Family::Points) || self.has(Family::Outputs)
    }

    /// The number of functions of points and outputs: values, velocities, accelerations, with `derive jerk` jerks.
    pub fn orders(&self) -> usize {
        if self.requests.contains(&Request::Jerk) { 4 } else { 3 }
    }

    /// Values, rates, accelerations or jerks.
    pub fn quantities(&self, family: Family, order: usize) -> Function<Body> {
        let motion = Order::ALL.into_iter().skip(1).take(order).map(|order| self.coordinates(order));
        let arguments = std::iter::once(self.pose()).chain(motion);
        let item = match (family, order) {
            (Family::Points, 0) => Type::Point,
            (Family::Points, _) => Type::Plane,
            (Family::Outputs, _) => Type::Scalar,
        };
        fallible(family.function(order), arguments, self.each(family, item))
    }

    pub fn quantity_ratios(&self, family: Family) -> Function<Body> {
        let item = Type::Matrix(family.dimension(), self.inputs.len());
        fallible(format!("{}_ratios", family.word()), [self.pose()], self.each(family, item))
    }

    pub fn quantity_ratio_derivatives(&self, family: Family) -> Function<Body> {
        let matrix = Type::Matrix(self.inputs.len(), self.inputs.len());
        let item = if family == Family::Points { Type::List(Box::new(matrix), 2) } else { matrix };
        fallible(format!("{}_ratio_derivatives", family.word()), [self.pose()], self.each(family, item))
    }

    pub fn quantity_sensitivities(&self, family: Family) -> Function<Body> {
        let item = Type::Matrix(family.dimension(), self.parameters.len());
        fallible(format!("{}_sensitivities", family.word()), [self.pose()], self.each(family, item))
    }

    fn each(&self, family: Family, item: Type) -> Type {
        Type::Each(self.each_name(family).to_owned(), Box::new(item))
    }

    /// The type with one field for each point or output.
    pub fn each_name(&self, family: Family) -> &str {
        match family {
            Family::Points => &self.types.points,
            Family::Outputs => &self.types.outputs,
        }
    }
}
