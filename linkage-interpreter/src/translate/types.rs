//! The forms of values, by the types of emitted code.

use linkage_compiler::program::Type as TypeOf;

use super::Context;
use crate::code::{Record, Shape};

impl Context<'_> {
    /// The form of the values of a type.
    pub(super) fn shape(&self, of: &TypeOf) -> Shape {
        let boxed = |of: &TypeOf| Box::new(self.shape(of));
        match of {
            TypeOf::Scalar | TypeOf::Lanes => Shape::Number,
            TypeOf::Text => Shape::Text,
            TypeOf::Flag => Shape::Flag,
            TypeOf::Count => Shape::Count,
            TypeOf::Itself => Shape::Record(Record::Branch),
            TypeOf::OfTrait(name) => self.of_trait(name),
            TypeOf::Own(name) | TypeOf::Wide(name) | TypeOf::Bare(name) => {
                self.record(name).map_or_else(|| Shape::Other(name.clone()), Shape::Record)
            }
            TypeOf::Each(name, of) => {
                let names = if *name == self.types.points { &self.points } else { &self.outputs };
                Shape::Each(names.clone(), boxed(of))
            }
            TypeOf::Column(of, count) => Shape::List(boxed(of), *count),
            TypeOf::Vector(count) => Shape::Vector(*count),
            TypeOf::Matrix(rows, columns) => Shape::Matrix(*rows, *columns),
            TypeOf::Sized("Matrix", sizes) => match sizes.as_slice() {
                &[rows, columns] => Shape::Matrix(rows, columns),
                _ => Shape::Other("Matrix".to_owned()),
            },
            TypeOf::Point => Shape::Point,
            TypeOf::Plane => Shape::Vector(2),
            TypeOf::Runtime(name, _) | TypeOf::Sized(name, _) => Shape::Other((*name).to_owned()),
            TypeOf::Around("Option", of) => Shape::Perhaps(boxed(of)),
            TypeOf::Around(name, _) => Shape::Other((*name).to_owned()),
            TypeOf::List(of, count) => Shape::List(boxed(of), *count),
            TypeOf::Tuple(all) => Shape::Tuple(all.iter().map(|of| self.shape(of)).collect()),
            TypeOf::ReducedMotion { .. } => Shape::Other("ReducedMotion".to_owned()),
            TypeOf::StateRates { .. } => Shape::Other("StateRates".to_owned()),
            TypeOf::Branches { .. } => Shape::Many(Box::new(Shape::Other("Assembled".to_owned()))),
            TypeOf::Iterator { item, .. } => Shape::Many(boxed(item)),
        }
    }

    fn of_trait(&self, name: &str) -> Shape {
        match name {
            "Pose" => Shape::Record(Record::Pose),
            "Branch" => Shape::Record(Record::Branch),
            "Inputs" => Shape::Record(Record::Inputs),
            "Coordinates" => Shape::Record(Record::Coordinates),
            "Rates" => Shape::Record(Record::Rates),
            "Accelerations" => Shape::Record(Record::Accelerations),
            other => Shape::Other(other.to_owned()),
        }
    }

    fn record(&self, name: &str) -> Option<Record> {
        let types = self.types;
        let all = [
            (&types.driver, Record::Mechanism),
            (&types.itself, Record::Scene),
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
