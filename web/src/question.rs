//! The questions of the page.

use linkage_report::sheet::Language as OfSheet;
use serde::{Deserialize, Serialize};

/// A position: the inputs and the unknowns, in the order of their declaration; angles count turns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// The inputs.
    pub inputs: Vec<f64>,
    /// The unknowns.
    pub unknowns: Vec<f64>,
}

/// A mechanism by its place in the text, with values of its parameters, at a position.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct At {
    /// The place of the mechanism.
    pub mechanism: usize,
    /// The values of its parameters.
    pub parameters: Vec<f64>,
    /// The position.
    pub place: Place,
}

/// The contents of pictures.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(default)]
pub struct Show {
    /// The paths of points, of the motion that was followed last.
    pub traces: bool,
    /// The velocities of points.
    pub velocities: bool,
    /// The accelerations of points.
    pub accelerations: bool,
    /// The place of the input that moves.
    pub along: usize,
    /// Its rate.
    pub rate: f64,
    /// The language of the legend.
    pub language: Language,
}

impl Default for Show {
    fn default() -> Self {
        Self {
            traces: false,
            velocities: false,
            accelerations: false,
            along: 0,
            rate: 1.0,
            language: Language::English,
        }
    }
}

/// The aim of a motion.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Aim {
    /// The values of parameters.
    pub parameters: Vec<f64>,
    /// The inputs.
    pub inputs: Vec<f64>,
}

/// The form of a sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// A page.
    Html,
    /// For inclusion in a file that uses `amsmath`.
    Latex,
    /// Plain text.
    Text,
}

/// The language of a sheet or a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum Language {
    /// English.
    #[serde(rename = "en")]
    English,
    /// Italian.
    #[serde(rename = "it")]
    Italian,
}

impl Language {
    /// This language, as the library names it.
    pub fn of_sheet(self) -> OfSheet {
        match self {
            Self::English => OfSheet::English,
            Self::Italian => OfSheet::Italian,
        }
    }
}

/// A question of the page.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Question {
    /// Compile a text.
    Compile {
        /// The text.
        text: String,
    },
    /// Take mechanisms that were compiled before: the answer is that of a text.
    Load {
        /// They, as [`compiled`](crate::compiled) wrote them.
        written: String,
    },
    /// The words of the language.
    Words,
    /// A first position.
    Begin {
        /// The place of the mechanism.
        mechanism: usize,
        /// The values of its parameters.
        parameters: Vec<f64>,
        /// A position of the text before, to which it is near if there is one.
        #[serde(default)]
        near: Option<Place>,
        /// The contents of the picture.
        #[serde(default)]
        show: Show,
    },
    /// All positions at these inputs.
    Positions {
        /// The place of the mechanism.
        mechanism: usize,
        /// The values of its parameters.
        parameters: Vec<f64>,
        /// The inputs.
        inputs: Vec<f64>,
    },
    /// The picture of a position.
    Picture {
        /// The position.
        #[serde(flatten)]
        at: At,
        /// The contents of the picture.
        #[serde(default)]
        show: Show,
    },
    /// Follow the motion to other inputs, and to other values of parameters.
    Follow {
        /// The position at its start.
        #[serde(flatten)]
        at: At,
        /// The aim.
        to: Aim,
        /// The contents of the picture.
        #[serde(default)]
        show: Show,
    },
    /// Move the input so that a joint comes near a place.
    Drag {
        /// The position at the start.
        #[serde(flatten)]
        at: At,
        /// The joint by its name.
        joint: String,
        /// The place in the plane of the mechanism.
        to: [f64; 2],
        /// The contents of the picture.
        #[serde(default)]
        show: Show,
    },
    /// Follow the whole motion.
    Motion {
        /// A position of it.
        #[serde(flatten)]
        at: At,
        /// The place of the input that moves.
        along: usize,
        /// Its rate.
        rate: f64,
        /// The number of equal steps.
        steps: u32,
    },
    /// A chart over the motion that was followed last.
    Chart {
        /// The columns.
        columns: Vec<String>,
    },
    /// The table of the motion that was followed last.
    Csv,
    /// The sheet with the numbers of a position.
    Sheet {
        /// The position.
        #[serde(flatten)]
        at: At,
        /// The rate of the first input; none for a sheet of a position at rest.
        rate: Option<f64>,
        /// The language.
        language: Language,
        /// The form.
        form: Form,
    },
    /// The circuits.
    Circuits {
        /// The place of the mechanism.
        mechanism: usize,
        /// The values of its parameters.
        parameters: Vec<f64>,
        /// The inputs.
        inputs: Vec<f64>,
        /// The place of the input that moves.
        along: usize,
    },
    /// The report.
    Report {
        /// The position.
        #[serde(flatten)]
        at: At,
    },
    /// The code that the macro emits.
    Rust {
        /// The place of the mechanism.
        mechanism: usize,
    },
    /// The motion of a scene in time.
    Simulate(Simulate),
}

/// A simulation.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Simulate {
    /// The position at the start.
    #[serde(flatten)]
    pub at: At,
    /// The place of the scene.
    pub scene: usize,
    /// The values of its parameters.
    pub values: Vec<f64>,
    /// The rates of the inputs at the start.
    pub rates: Vec<f64>,
    /// The time at the end, from 0.
    pub to: f64,
    /// The relative tolerance.
    pub tolerance: f64,
    /// The number of equal steps of the table.
    pub steps: u32,
}
