//! The documents of a driver: its derivation, the analysis by hand where formulas for it exist, and its scenes.

use linkage_compiler::document::{self, Document, SceneDocument, SheetDocument};
use linkage_compiler::emit::Declared;
use linkage_compiler::{Lowered, emit};
use linkage_report::sheet::Sheet;
use linkage_runtime::derivation::Derivation;

use crate::plain::paragraphs;
use crate::{Lender, Unsound};

/// The documents of a driver, as plain data: its derivation, the analysis by hand where formulas for it exist, and its scenes,
/// with the default values of its parameters and its doc comment. With the feature `serde` they can be written, and read by a
/// program that compiles nothing.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Documents {
    driver: Option<Document>,
    by_hand: Option<SheetDocument>,
    scenes: Vec<SceneDocument>,
    /// The parameters with default values.
    defaults: Vec<(String, f64)>,
    /// The doc comment of the mechanism, in plain words.
    about: Vec<String>,
}

impl Documents {
    /// The documents of a driver.
    #[must_use]
    pub fn of(of: &Lowered<'_>) -> Self {
        let (driver, scenes) = emit::documents(of.declared, &of.program, &of.derivation);
        let Declared { mechanism, driver: declared } = of.declared;
        let has_formulas = of.derivation.groups.iter().all(|group| group.determinant.is_some());
        let by_hand = has_formulas.then(|| document::of_sheet(mechanism, declared, &of.derivation));
        let parameters = of.program.signatures.parameters.iter();
        let defaults = parameters.filter_map(|parameter| Some((parameter.name.text.clone(), parameter.default?)));
        let about = paragraphs(&mechanism.documentation());
        Self { driver, by_hand, scenes, defaults: defaults.collect(), about }
    }

    /// Applies a function to all of them as one sheet, with the default values of parameters; none without a derivation.
    ///
    /// # Errors
    /// [`Unsound`] if a document refers to what it does not have.
    pub fn sheet<R>(&self, write: impl FnOnce(&mut Sheet<'_>) -> R) -> Result<Option<R>, Unsound> {
        let lender = Lender::default();
        let derivation = self.derivation(&lender)?;
        let scenes = self.scenes.iter().map(|scene| lender.scene(scene)).collect::<Result<Vec<_>, _>>()?;
        let by_hand = self.by_hand.as_ref().map(|sheet| lender.sheet(sheet)).transpose()?;
        let Some(mut sheet) = derivation.as_ref().map(Sheet::new) else { return Ok(None) };
        for scene in &scenes {
            sheet.scene(scene);
        }
        if let Some(by_hand) = &by_hand {
            sheet.by_hand(by_hand);
        }
        for paragraph in &self.about {
            sheet.about(paragraph);
        }
        for (name, value) in &self.defaults {
            sheet.given(name, *value);
        }
        Ok(Some(write(&mut sheet)))
    }

    /// The doc comment of the mechanism in plain words, paragraph by paragraph.
    #[must_use]
    pub fn about(&self) -> &[String] {
        &self.about
    }

    /// Lends the derivation of the driver; none if its mechanism has none.
    ///
    /// # Errors
    /// [`Unsound`] if the document refers to what it does not have.
    pub fn derivation<'l>(&self, lender: &'l Lender) -> Result<Option<Derivation<'l>>, Unsound> {
        self.driver.as_ref().map(|driver| lender.derivation(driver)).transpose()
    }

    /// Visits those that have functions one after the other: the derivation, then the scenes.
    ///
    /// # Errors
    /// [`Unsound`] if a document refers to what it does not have.
    pub fn each(&self, mut visit: impl FnMut(&dyn linkage_report::Document)) -> Result<(), Unsound> {
        let lender = Lender::default();
        if let Some(driver) = &self.driver {
            visit(&lender.derivation(driver)?);
        }
        for scene in &self.scenes {
            visit(&lender.scene(scene)?);
        }
        Ok(())
    }
}
