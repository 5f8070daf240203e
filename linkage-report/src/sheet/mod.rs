//! A mechanism's derivation as one HTML file: formulas in MathML, numbers, a picture.
//!
//! The file stands alone: it loads nothing, runs no script, follows light and dark, and prints.
//!
//! ```
//! use linkage_runtime::derivation::Derivation;
//! use linkage_report::sheet::Sheet;
//!
//! fn sheet(derivation: &Derivation) -> String {
//!     let mut sheet = Sheet::new(derivation);
//!     sheet.title("A four-bar linkage").numbers("Parameters, mm", [("l1", 80.0), ("l2", 20.0)]);
//!     sheet.to_html()
//! }
//! ```

mod html;
mod lines;
mod numbers;
mod page;

use linkage_runtime::derivation::{Derivation, SceneDerivation};

#[derive(Debug, Clone, PartialEq)]
struct Table {
    caption: String,
    rows: Vec<(String, f64)>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Picture {
    svg: String,
    caption: String,
}

/// A sheet in the making.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet<'a> {
    derivation: &'a Derivation,
    title: Option<String>,
    scenes: Vec<&'a SceneDerivation>,
    tables: Vec<Table>,
    pictures: Vec<Picture>,
}

impl<'a> Sheet<'a> {
    /// The sheet of a derivation, without numbers or pictures.
    #[must_use]
    pub fn new(derivation: &'a Derivation) -> Self {
        Self { derivation, title: None, scenes: Vec::new(), tables: Vec::new(), pictures: Vec::new() }
    }

    /// The heading; without it the name of the mechanism.
    pub fn title(&mut self, title: impl Into<String>) -> &mut Self {
        self.title = Some(title.into());
        self
    }

    /// The equations of motion of a scene of this mechanism, behind the kinematics.
    pub fn scene(&mut self, scene: &'a SceneDerivation) -> &mut Self {
        self.scenes.push(scene);
        self
    }

    /// A row of the table "Parameters", whatever the unit.
    pub fn parameter(&mut self, name: impl Into<String>, value: f64) -> &mut Self {
        const CAPTION: &str = "Parameters";
        let row = (name.into(), value);
        match self.tables.iter_mut().find(|table| table.caption == CAPTION) {
            Some(table) => table.rows.push(row),
            None => self.tables.push(Table { caption: CAPTION.to_owned(), rows: vec![row] }),
        }
        self
    }

    /// A table of numbers, such as the coordinates of a pose; units belong into the caption.
    ///
    /// A name is shown as a formula if it is that of a parameter or coordinate (`theta3`), of its rate
    /// or acceleration (`theta3_rate`, `theta3_acceleration`), of a velocity ratio (`theta3/theta2`), or
    /// the text of what an equation of the derivation gives (`det J`).
    pub fn numbers<N: Into<String>>(
        &mut self,
        caption: impl Into<String>,
        rows: impl IntoIterator<Item = (N, f64)>,
    ) -> &mut Self {
        let rows = rows.into_iter().map(|(name, value)| (name.into(), value)).collect();
        self.tables.push(Table { caption: caption.into(), rows });
        self
    }

    /// A picture, such as that of a `Drawing`, and what it shows. It is
    /// embedded as an image, so that neither its style nor any script in it reaches the sheet.
    pub fn picture(&mut self, svg: impl Into<String>, caption: impl Into<String>) -> &mut Self {
        self.pictures.push(Picture { svg: svg.into(), caption: caption.into() });
        self
    }

    /// The HTML file.
    #[must_use]
    pub fn to_html(&self) -> String {
        page::html(self)
    }
}
