//! The names and values of a mechanism, for the page.

use linkage_report::Table;
use linkage_report::table::TableError;
use serde::{Deserialize, Serialize};

/// A coordinate or an output by name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Quantity {
    pub name: String,
    pub is_angle: bool,
}

/// A parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    pub name: String,
    pub is_angle: bool,
    /// The unit of its value, if it is the rate of an angle.
    pub unit: Option<String>,
    /// Its default, or 1.
    pub value: f64,
    /// The default as written.
    pub text: Option<String>,
}

/// A scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    pub name: String,
    pub parameters: Vec<Parameter>,
    /// True with `inertia`.
    pub simulates: bool,
}

/// A mechanism, or one choice of inputs of a mechanism with several.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct About {
    pub name: String,
    /// The doc comment, paragraph by paragraph.
    pub paragraphs: Vec<String>,
    pub parameters: Vec<Parameter>,
    pub inputs: Vec<Quantity>,
    pub unknowns: Vec<Quantity>,
    pub points: Vec<String>,
    pub outputs: Vec<Quantity>,
    /// The jump of each output that is an angle, where an `atan2` in its formula goes from pi to -pi.
    pub jumps: Vec<Option<f64>>,
    pub scenes: Vec<Scene>,
    /// The reason why it cannot be moved.
    pub refusal: Option<String>,
}

impl About {
    /// True for the name of a coordinate or an output that is an angle.
    pub(crate) fn is_angle(&self, name: &str) -> bool {
        let all = self.inputs.iter().chain(&self.unknowns).chain(&self.outputs);
        all.filter(|one| one.is_angle).any(|one| one.name == name)
    }

    /// A table whose outputs go on where their formulas jump, and which says what is an angle.
    pub(crate) fn with_angles(&self, table: Table) -> Result<Table, TableError> {
        let jumps = self.outputs.iter().zip(&self.jumps);
        let mut jumps = jumps.filter_map(|(output, jump)| Some((&output.name, (*jump)?)));
        let table = jumps.try_fold(table, |table, (name, jump)| table.on_turns(name, jump));
        let angles = self.outputs.iter().filter(|one| one.is_angle).map(|one| &one.name);
        table.and_then(|table| table.angles_of(angles))
    }
}
