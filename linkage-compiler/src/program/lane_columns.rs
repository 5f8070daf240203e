//! The columns of a batch of many positions: the given ones, and those to find with the numbers of a position that they
//! hold.

use std::collections::BTreeSet;

use super::Derived;
use super::branch::Position;
use super::expression::Expression;
use super::names::Taken;
use super::pose_fields::Held;
use super::signatures::{Coordinate, Name, Signatures};

/// Parts of the names of a point and of its derivatives, with the fields of its motion.
const VECTORS: [(&str, &str); 3] = [("", "position"), ("_velocity", "velocity"), ("_acceleration", "acceleration")];

/// Endings of the names of an output and of its derivatives, with their words.
const SCALARS: [(&str, &str); 3] = [("", "value"), ("_rate", "rate"), ("_acceleration", "acceleration")];

/// A column to find.
#[derive(Debug, Clone)]
pub struct Column {
    pub name: String,
    /// Its doc comment.
    pub doc: String,
}

/// The columns of a driver.
pub(super) struct Columns {
    pub(super) given: Vec<String>,
    /// The columns to find, in the order of a batch.
    pub(super) found: Vec<Column>,
    /// The numbers of the first ones: directions, lengths, rates and accelerations.
    pub(super) coordinates: Vec<Expression>,
    /// The fields of a pose that hold the next ones, the angles. The others are points and outputs.
    pub(super) angles: Vec<Held>,
}

impl Columns {
    pub(super) fn of(signatures: &Signatures, position: &Position, derived: Option<&Derived>) -> Self {
        let nothing = BTreeSet::new();
        let mut naming = Naming { taken: Taken::new(&nothing), columns: Vec::new() };
        let (coordinates, angles) = naming.coordinates(signatures, derived);
        naming.quantities(signatures);
        Self { given: given(signatures, position), found: naming.columns, coordinates, angles }
    }

    /// The number of points and outputs with their derivatives.
    pub(super) fn count_quantities(&self) -> usize {
        self.found.len() - self.coordinates.len() - self.angles.len()
    }
}

/// Parameters; inputs, or a guess; rates and accelerations of the inputs.
fn given(signatures: &Signatures, position: &Position) -> Vec<String> {
    let parameters = signatures.parameters.iter().map(|parameter| &parameter.name);
    let (start, inputs) = (start(signatures, position), inputs(signatures));
    let nothing = BTreeSet::new();
    let mut taken = Taken::new(&nothing);
    let mut names: Vec<String> = parameters.chain(start).map(|name| taken.unique(&name.text)).collect();
    for ending in ["_rate", "_acceleration"] {
        names.extend(inputs.iter().map(|name| taken.unique(&format!("{}{ending}", name.text))));
    }
    names
}

pub(super) fn inputs(signatures: &Signatures) -> Vec<&Name> {
    signatures.inputs.iter().map(|input| &input.name).collect()
}

/// The inputs, or all coordinates of a guess.
pub(super) fn start<'s>(signatures: &'s Signatures, position: &Position) -> Vec<&'s Name> {
    match position.is_closed {
        true => inputs(signatures),
        false => signatures.coordinates.iter().map(|coordinate| &coordinate.name).collect(),
    }
}

/// The columns so far, with their names.
struct Naming<'a> {
    taken: Taken<'a>,
    columns: Vec<Column>,
}

impl Naming<'_> {
    fn add(&mut self, name: &str, doc: String) {
        let column = self.column(name, doc);
        self.columns.push(column);
    }

    fn column(&mut self, name: &str, doc: String) -> Column {
        Column { name: self.taken.unique(name), doc }
    }

    /// Directions and lengths, then rates, then accelerations; and the angles.
    fn coordinates(&mut self, signatures: &Signatures, derived: Option<&Derived>) -> (Vec<Expression>, Vec<Held>) {
        let unknowns = &signatures.unknowns;
        let (mut values, mut angles) = (Vec::new(), Vec::new());
        let pose = Expression::name("pose");
        for coordinate in unknowns {
            let Name { text, field } = &coordinate.name;
            let held = held(derived, coordinate);
            match &held {
                Held::Number(_) => {
                    self.add(field, format!("`{text}`."));
                    values.push(held.value(&pose));
                }
                Held::Direction { field: direction, .. } => {
                    for (part, function) in [("re", "cos"), ("im", "sin")] {
                        self.add(&format!("{function}_{field}"), format!("`{function}({text})`."));
                        values.push(pose.clone().field(direction).field(part));
                    }
                    angles.push((self.column(field, format!("`{text}`.")), held));
                }
            }
        }
        for (ending, of, word) in [("_rate", "rates", "rate"), ("_acceleration", "accelerations", "acceleration")] {
            for Name { text, field } in unknowns.iter().map(|coordinate| &coordinate.name) {
                self.add(&format!("{field}{ending}"), format!("The {word} of `{text}`."));
                values.push(Expression::name(of).field(field));
            }
        }
        let (columns, angles): (Vec<Column>, _) = angles.into_iter().unzip();
        self.columns.extend(columns);
        (values, angles)
    }

    /// Points and outputs, each followed by its derivatives, as the function for one lane returns them.
    fn quantities(&mut self, signatures: &Signatures) {
        for Name { text, field } in &signatures.points {
            for (vector, member) in VECTORS {
                for axis in ["x", "y"] {
                    self.add(&format!("{field}{vector}_{axis}"), format!("{axis} of the {member} of `{text}`."));
                }
            }
        }
        for Name { text, field } in &signatures.outputs {
            for (ending, word) in SCALARS {
                let doc = match ending {
                    "" => format!("`{text}`."),
                    _ => format!("The {word} of `{text}`."),
                };
                self.add(&format!("{field}{ending}"), doc);
            }
        }
    }
}

/// The fields of a pose that hold a coordinate; a guess in a stub, which is never run.
fn held(derived: Option<&Derived>, coordinate: &Coordinate) -> Held {
    let name = &coordinate.name.field;
    let held = derived.into_iter().flat_map(|derived| &derived.held).find(|(other, _)| other == name);
    match (held, coordinate.is_angle) {
        (Some((_, held)), _) => held.clone(),
        (None, true) => Held::Direction { field: name.clone(), number: None },
        (None, false) => Held::Number(name.clone()),
    }
}
