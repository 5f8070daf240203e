//! Between values of the machine and the equations of a scene.

use linkage_dynamics::{
    Bearing, Contact, ContactCoordinate, ContactLaw, Equations, Prescribed, ReactionRow, Unreduced,
};
use linkage_ir::Name;
use linkage_runtime::{Build as _, Column, Dim};

use super::{ContactCount, SceneAtRunTime};
use crate::at_run_time::Count;
use crate::at_run_time::read::{field, matrix, number, numbers};
use crate::machine::Value;

/// The numbers of a field, as many as there are of a kind.
fn column<R: Dim>(value: &Value, name: Name, count: R) -> Column<f64, R> {
    let numbers = numbers(field(value, name));
    count.column(|place| numbers.get(place).copied().unwrap_or(f64::NAN))
}

/// The law of a contact, by the case that its value names.
fn law(case: &str, value: &Value) -> ContactLaw<f64> {
    let of = |name| number(field(value, name));
    match case {
        "ContactLaw::Friction" => ContactLaw::Friction { limit: of(Name::LIMIT) },
        "ContactLaw::Bearing" => ContactLaw::Bearing { factor: of(Name::FACTOR) },
        _ => ContactLaw::Stop { lower: of(Name::LOWER), upper: of(Name::UPPER), restitution: of(Name::RESTITUTION) },
    }
}

/// The prescribed motion of an input.
pub(super) fn prescribed(value: &Value) -> Option<Prescribed<f64>> {
    value.as_record().ok()?;
    let of = |name| number(field(value, name));
    Some(Prescribed { value: of(Name::VALUE), rate: of(Name::RATE), acceleration: of(Name::ACCELERATION) })
}

impl<'p, V: Dim> SceneAtRunTime<'p, V> {
    /// The numbers of unknowns, inputs and contacts.
    pub(super) fn counts(&self) -> (Count, V, ContactCount) {
        let (unknowns, _) = self.prepared.mechanism.counts();
        let contacts = ContactCount::new(self.prepared.scene.contacts).unwrap_or_else(Dim::least);
        (unknowns, self.mechanism.inputs, contacts)
    }

    pub(super) fn read_equations(&self, value: &Value) -> Equations<f64, Count, V> {
        let ((u, v, _), of) = (self.counts(), self.prepared.fields);
        Equations {
            mass: matrix(field(value, of.mass), v, v),
            forces: column(value, Name::FORCES, v),
            ratios: matrix(field(value, of.ratios), u, v),
            bias: column(value, Name::BIAS, u),
        }
    }

    pub(super) fn read_unreduced(&self, value: &Value) -> Unreduced<f64, Count, V> {
        let ((u, v, _), of) = (self.counts(), self.prepared.fields);
        Unreduced {
            unknowns: matrix(field(value, of.unknowns), u, u),
            mixed: matrix(field(value, of.mixed), u, v),
            inputs: matrix(field(value, of.inputs), v, v),
            unknown_forces: column(value, of.unknown_forces, u),
            input_forces: column(value, of.input_forces, v),
        }
    }

    pub(super) fn read_contact(&self, value: &Value) -> Contact<f64, Count, V, &'p str> {
        let ((u, v, _), of) = (self.counts(), self.prepared.fields);
        let mechanism = &self.prepared.mechanism;
        let along = field(value, Name::ALONG);
        let name = field(value, Name::NAME).as_text().map_or("", |name| mechanism.name_of(name));
        let case = field(value, Name::LAW).as_record().map_or("", |law| law.of);
        Contact {
            name,
            along: ContactCoordinate {
                value: number(field(along, Name::VALUE)),
                unknowns: column(along, of.unknowns, u),
                inputs: column(along, of.inputs, v),
                bias: number(field(along, Name::BIAS)),
            },
            law: law(case, field(value, Name::LAW)),
        }
    }

    /// The reaction that limits a friction, if one does.
    pub(super) fn read_bearing(&self, value: &Value) -> Option<Bearing<f64, Count, V, ContactCount>> {
        let rows = value.field(self.prepared.fields.components).ok()?.as_list().ok()?;
        let row =
            |place: usize| rows.get(place).map_or_else(|| ReactionRow::zero(self.counts()), |row| self.read_row(row));
        Some(Bearing { components: [row(0), row(1)] })
    }

    fn read_row(&self, value: &Value) -> ReactionRow<f64, Count, V, ContactCount> {
        let ((u, v, c), of) = (self.counts(), self.prepared.fields);
        ReactionRow {
            constant: number(field(value, of.constant)),
            unknowns: column(value, of.unknowns, u),
            inputs: column(value, of.inputs, v),
            rows: column(value, of.rows, u),
            contacts: column(value, of.contacts, c),
        }
    }
}
