//! The fields of a pose as its type declares them, and those that hold the coordinates.

use super::expression::Expression;
use super::pose::PosePlan;
use crate::derivation::Derivation;
use crate::graph::{Function, Texts};

/// A field of a pose: a number, or a direction.
#[derive(Debug, Clone)]
pub struct PoseField {
    pub name: String,
    /// Its doc comment.
    pub doc: String,
    pub is_direction: bool,
}

/// The fields of a pose that hold a coordinate.
#[derive(Debug, Clone)]
pub enum Held {
    Number(String),
    Direction {
        field: String,
        /// The field with the angle as a number, if there is one.
        number: Option<String>,
    },
}

impl Held {
    /// The number that a pose holds, or the angle of its direction.
    pub fn value(&self, pose: &Expression) -> Expression {
        match (self, self.computed_from(pose)) {
            (_, Some(parts)) => Expression::Elementary(Function::Atan2, parts.to_vec()),
            (
                Self::Direction { number: Some(field), .. } | Self::Number(field) | Self::Direction { field, .. },
                None,
            ) => pose.clone().field(field),
        }
    }

    /// The sine and the cosine of an angle that a pose has as a direction only.
    pub fn computed_from(&self, pose: &Expression) -> Option<[Expression; 2]> {
        match self {
            Self::Direction { field, number: None } => {
                Some(["im", "re"].map(|part| pose.clone().field(field).field(part)))
            }
            _ => None,
        }
    }
}

impl PosePlan {
    /// The fields, in the order of their declaration.
    pub fn fields(&self, derivation: &Derivation) -> Vec<PoseField> {
        let (graph, mut texts) = (&derivation.graph, Texts::default());
        let mut fields = Vec::new();
        let mut add = |name: &String, doc: String, is_direction| {
            fields.push(PoseField { name: name.clone(), doc, is_direction });
        };
        for (angle, name) in &self.directions {
            add(name, format!("The direction of `{}`.", texts.of(graph, *angle)), true);
        }
        for (column, name, _) in &self.values {
            add(name, format!("The coordinate `{}`.", derivation.coordinates[*column].name), false);
        }
        for (node, name, _) in &self.externals {
            add(name, format!("`{}`.", texts.of(graph, *node)), false);
        }
        for (group, name, _) in &self.determinants {
            let group = &derivation.groups[*group];
            let Some(determinant) = group.determinant else { continue };
            let of = match derivation.groups.len() {
                1 => "det J".to_owned(),
                _ => format!("The determinant of the group of `{}`,", group.names(derivation).replace(", ", "`, `")),
            };
            add(name, format!("{of} = `{}`.", texts.of(graph, determinant.value)), false);
        }
        fields
    }

    /// Each coordinate with the fields that hold it, in the order of the coordinates.
    pub fn held(&self, derivation: &Derivation) -> Vec<(String, Held)> {
        let directions: Vec<_> = self
            .directions
            .iter()
            .filter_map(|(angle, field)| Some((derivation.graph.as_symbol(*angle)?, field)))
            .collect();
        let coordinates = derivation.coordinates.enumerated().map(|(column, coordinate)| {
            let number = self.values.iter().find(|(other, ..)| *other == column).map(|(_, field, _)| field.clone());
            let held = match directions.iter().find(|(symbol, _)| *symbol == coordinate.value) {
                Some((_, field)) => Held::Direction { field: (*field).clone(), number },
                None => Held::Number(number.unwrap_or_else(|| coordinate.name.clone())),
            };
            (coordinate.name.clone(), held)
        });
        coordinates.collect()
    }
}
