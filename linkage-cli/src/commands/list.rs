//! The forms of a list: text for readers, or JSON.

use std::path::Path;

use serde::Serialize;

use crate::arguments::{ListForm, ListFormat};
use crate::failure::Failure;
use crate::machine::Machine;
use crate::output::{self, Form, form};

const FORMS: [Form; 2] = [("text", &["txt"]), ("JSON", &["json"])];

impl ListForm {
    /// The form that is asked for, by its name or by the ending of the file.
    pub fn format(&self, what: &str) -> Result<ListFormat, Failure> {
        let of_place = [ListFormat::Text, ListFormat::Json];
        let of_ending = form(&self.output, what, &FORMS)?.and_then(|place| of_place.get(place).copied());
        Ok(self.format.or(of_ending).unwrap_or(ListFormat::Text))
    }

    /// Writes a list in a form.
    pub fn write<L: Serialize>(
        &self,
        format: ListFormat,
        list: &L,
        to_text: impl FnOnce(&L) -> String,
        source: &Path,
    ) -> Result<(), Failure> {
        let text = match format {
            ListFormat::Text => to_text(list),
            ListFormat::Json => to_json(list)?,
        };
        output::write(&self.output, text.as_bytes(), source)
    }
}

/// A list as JSON.
pub fn to_json<L: Serialize>(list: &L) -> Result<String, Failure> {
    Ok(serde_json::to_string_pretty(list).map_err(|error| Failure::Outside(error.to_string()))? + "\n")
}

/// The place of the input that moves: the one that is asked for, or the first.
pub fn moving(machine: &Machine, along: Option<&str>) -> Result<usize, Failure> {
    match (along, machine.about.inputs.is_empty()) {
        (Some(name), _) => machine.input(name),
        (None, false) => Ok(0),
        (None, true) => Err(Failure::Argument(format!("`{}` has no input", machine.about.name))),
    }
}
