//! A mechanism's derivation as one HTML file: formulas in MathML, numbers and pictures; also as text and LaTeX.
//!
//! The file is self-contained: it loads nothing, runs no script, supports light and dark mode, and can be printed.
//!
//! ```
//! use linkage_runtime::derivation::Derivation;
//! use linkage_report::sheet::Sheet;
//!
//! fn sheet(derivation: &Derivation<'_>) -> String {
//!     let mut sheet = Sheet::new(derivation);
//!     sheet.title("A four-bar linkage").numbers("Parameters, mm", [("l1", 80.0), ("l2", 20.0)]);
//!     sheet.to_html()
//! }
//! ```

mod at;
mod digits;
mod html;
mod lines;
mod motion;
mod numbers;
mod page;
mod properties;
mod scene;
mod values;

use std::collections::BTreeSet;

use linkage_runtime::derivation::{Derivation, Formula, SceneDerivation, SheetDerivation, Symbol};

use crate::words::Words;

pub use crate::document::text_at;
pub use crate::words::Language;
pub(crate) use digits::{latex, number};
pub(crate) use html::{escape, svg_address};
pub use motion::{MotionNumbers, MovingCoordinate};
pub(crate) use page::document;
pub use properties::{RatioNumber, RatioProperty, ratio_properties};
pub use values::Values;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Table {
    pub(crate) caption: Caption,
    pub(crate) rows: Vec<(String, f64)>,
}

/// The caption of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Caption {
    Parameters,
    Position,
    Degrees,
    Velocities,
    Accelerations,
    Given(String),
}

impl Caption {
    pub(crate) fn text<'c>(&'c self, words: &Words) -> &'c str {
        match self {
            Self::Parameters => words.parameters,
            Self::Position => words.position,
            Self::Degrees => words.degrees,
            Self::Velocities => words.velocities,
            Self::Accelerations => words.accelerations,
            Self::Given(text) => text,
        }
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Picture {
    svg: String,
    caption: String,
}

/// Symbols, with the values that are known.
type Symbols<'a> = Vec<(Formula<'a>, Option<f64>)>;

/// A builder for a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet<'a> {
    pub(crate) derivation: Derivation<'a>,
    pub(crate) language: Language,
    pub(crate) title: Option<String>,
    pub(crate) scenes: Vec<SceneDerivation<'a>>,
    pub(crate) by_hand: Option<SheetDerivation<'a>>,
    pub(crate) values: Option<Values>,
    pub(crate) about: Vec<String>,
    given: Vec<(String, f64)>,
    properties: Vec<RatioProperty>,
    pub(crate) tables: Vec<Table>,
    pictures: Vec<Picture>,
}

impl<'a> Sheet<'a> {
    /// Creates the sheet of a derivation, without numbers or pictures.
    #[must_use]
    pub fn new(derivation: &Derivation<'a>) -> Self {
        Self {
            derivation: *derivation,
            language: Language::default(),
            title: None,
            scenes: Vec::new(),
            by_hand: None,
            values: None,
            about: Vec::new(),
            given: Vec::new(),
            properties: Vec::new(),
            tables: Vec::new(),
            pictures: Vec::new(),
        }
    }

    /// Sets the heading; the default is the name of the mechanism.
    pub fn title(&mut self, title: impl Into<String>) -> &mut Self {
        self.title = Some(title.into());
        self
    }

    /// Sets the language; the default is English.
    pub fn language(&mut self, language: Language) -> &mut Self {
        self.language = language;
        self
    }

    /// Adds the equations of motion of a scene of this mechanism, after the kinematics.
    pub fn scene(&mut self, scene: &SceneDerivation<'a>) -> &mut Self {
        self.scenes.push(*scene);
        self
    }

    /// Adds the analysis by hand of this mechanism, line by line: `SHEET` of a mechanism with `derive sheet`.
    pub fn by_hand(&mut self, by_hand: &SheetDerivation<'a>) -> &mut Self {
        self.by_hand = Some(*by_hand);
        self
    }

    /// Adds the number of each formula at a position, except those of the constraint equations, which are zero.
    pub fn at(&mut self, values: Values) -> &mut Self {
        self.values = Some(values);
        self
    }

    /// Adds the numbers of a motion at one position: that of each formula, as [`at`](Self::at) does with those of parameters that
    /// were [`given`](Self::given) before, and tables of the coordinates and, if it has rates, of velocities and accelerations.
    pub fn motion(&mut self, motion: &MotionNumbers) -> &mut Self {
        self.values = Some(motion.values(&self.given));
        self.tables.extend(motion.tables());
        self
    }

    /// Adds the properties of the velocity ratios with their numbers, as [`ratio_properties`] finds them.
    pub fn properties(&mut self, properties: impl IntoIterator<Item = RatioProperty>) -> &mut Self {
        self.properties.extend(properties);
        self
    }

    /// Adds a paragraph in plain words below the heading.
    pub fn about(&mut self, paragraph: impl Into<String>) -> &mut Self {
        self.about.push(paragraph.into());
        self
    }

    /// Sets the value of a parameter in the list of what is given.
    pub fn given(&mut self, name: impl Into<String>, value: f64) -> &mut Self {
        self.given.push((name.into(), value));
        self
    }

    /// Adds a row to the table "Parameters", which has its name in the language of the sheet.
    pub fn parameter(&mut self, name: impl Into<String>, value: f64) -> &mut Self {
        let row = (name.into(), value);
        match self.tables.iter_mut().find(|table| table.caption == Caption::Parameters) {
            Some(table) => table.rows.push(row),
            None => self.tables.push(Table { caption: Caption::Parameters, rows: vec![row] }),
        }
        self
    }

    /// Adds a table of numbers, such as the coordinates of a pose; write units in the caption.
    ///
    /// A name is shown as a formula if it is a parameter or coordinate (`theta3`), its rate or acceleration
    /// (`theta3_rate`, `theta3_acceleration`), a velocity ratio (`theta3/theta2`), or the left side of an equation of
    /// the derivation (`det J`).
    pub fn numbers<N: Into<String>>(
        &mut self,
        caption: impl Into<String>,
        rows: impl IntoIterator<Item = (N, f64)>,
    ) -> &mut Self {
        let rows = rows.into_iter().map(|(name, value)| (name.into(), value)).collect();
        self.tables.push(Table { caption: Caption::Given(caption.into()), rows });
        self
    }

    /// Adds a picture, such as a `Drawing`, with a caption. It is embedded as an image, so that its styles and scripts
    /// do not affect the sheet.
    pub fn picture(&mut self, svg: impl Into<String>, caption: impl Into<String>) -> &mut Self {
        self.pictures.push(Picture { svg: svg.into(), caption: caption.into() });
        self
    }

    /// Writes it as plain text, without properties and pictures.
    #[must_use]
    pub fn to_text(&self) -> String {
        crate::document::text_of(self)
    }

    /// Writes it as LaTeX, for inclusion in a file that uses `amsmath`, without properties and pictures.
    #[must_use]
    pub fn to_latex(&self) -> String {
        crate::document::latex_of(self)
    }

    /// The parameters with their values, the inputs and the unknowns, each kind with its heading.
    pub(crate) fn roles(&self) -> Vec<(&'static str, Symbols<'a>)> {
        let (words, Derivation { parameters, inputs, unknowns, .. }) = (self.language.words(), self.derivation);
        let value = |name: &str| self.given.iter().rfind(|(other, _)| other == name).map(|(_, value)| *value);
        let roles = [(words.given, parameters), (words.driven, inputs), (words.unknown, unknowns)];
        let listed = roles.into_iter().filter(|(_, symbols)| !symbols.is_empty());
        let valued = |symbols: &[Symbol<'a>]| symbols.iter().map(|of| (of.formula, value(of.name))).collect();
        listed.map(|(role, symbols)| (role, valued(symbols))).collect()
    }

    /// The conditions of all formulas, each once.
    pub(crate) fn conditions(&self) -> Vec<&'a Formula<'a>> {
        let by_hand = self.by_hand.map_or(&[][..], |by_hand| by_hand.conditions);
        let mut texts = BTreeSet::new();
        let all = self.derivation.conditions.iter().chain(by_hand);
        all.filter(|condition| texts.insert(condition.to_string())).collect()
    }

    /// Writes the HTML file.
    #[must_use]
    pub fn to_html(&self) -> String {
        page::html(self)
    }

    /// Writes the sections of the HTML file alone, to be part of another page.
    #[must_use]
    pub fn to_html_fragment(&self) -> String {
        page::body(self)
    }
}
