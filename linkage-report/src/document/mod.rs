//! Derivations as plain text and LaTeX, with numbered equations.

mod latex;
pub(crate) mod outline;
pub(crate) mod sheet;
mod text;
mod whole;

use crate::FpCore;
use crate::sheet::{Sheet, Values};
use crate::words::{Language, Words};
use linkage_runtime::derivation::{Derivation, SceneDerivation, SheetDerivation};

/// The words of documents; a [`Sheet`] has a language.
const ENGLISH: &Words = Language::English.words();

/// A derivation that can be written as a document, in English.
///
/// ```
/// use linkage::Document;
/// use linkage::linkage;
///
/// linkage! {
///     mechanism Crank {
///         param r;
///         input phi;
///         unknown x, y;
///         loop r@phi = x@0 + y@(pi/2);
///     }
/// }
/// assert!(Crank::<f64>::DERIVATION.to_text().contains("J = ∂Ψ/∂u"));
/// ```
pub trait Document {
    /// Writes the document as plain text.
    fn to_text(&self) -> String;
    /// Writes the document as LaTeX, for inclusion in a file that uses `amsmath`.
    fn to_latex(&self) -> String;
    /// The formulas of the emitted functions as FPCore, one for each number that a function returns, of a mechanism
    /// with `derive fpcore`. It has none that depends on an iteration, on pivoting or on a user function.
    fn fpcore(&self) -> Vec<FpCore<'_>>;
}

impl Document for Derivation<'_> {
    fn to_text(&self) -> String {
        written(|text| whole::write_whole(&Sheet::new(self), &mut text::Text::new(text, ENGLISH)))
    }

    fn to_latex(&self) -> String {
        written(|text| whole::write_whole(&Sheet::new(self), &mut latex::Latex::new(text, ENGLISH)))
    }

    fn fpcore(&self) -> Vec<FpCore<'_>> {
        FpCore::of(self.mechanism, self.kernels)
    }
}

impl Document for SceneDerivation<'_> {
    fn to_text(&self) -> String {
        written(|text| outline::write_scene(self, &mut text::Text::new(text, ENGLISH), &mut 0))
    }

    fn to_latex(&self) -> String {
        written(|text| outline::write_scene(self, &mut latex::Latex::new(text, ENGLISH), &mut 0))
    }

    fn fpcore(&self) -> Vec<FpCore<'_>> {
        FpCore::of(self.scene, self.kernels)
    }
}

/// The analysis by hand of a mechanism; it has no functions.
impl Document for SheetDerivation<'_> {
    fn to_text(&self) -> String {
        written(|text| write_sheet(self, &mut text::Text::new(text, ENGLISH)))
    }

    fn to_latex(&self) -> String {
        written(|text| write_sheet(self, &mut latex::Latex::new(text, ENGLISH)))
    }

    fn fpcore(&self) -> Vec<FpCore<'_>> {
        Vec::new()
    }
}

/// Writes an analysis by hand as plain text, with the number of each formula at a position.
#[must_use]
pub fn text_at(sheet: &SheetDerivation<'_>, values: &Values) -> String {
    written(|text| write_sheet(sheet, &mut text::Text::new(text, ENGLISH).at(values)))
}

fn write_sheet<P: outline::Pen>(sheet: &SheetDerivation<'_>, pen: &mut P) -> core::fmt::Result {
    pen.title(sheet.mechanism)?;
    sheet::write(sheet, pen, &mut 0)?;
    outline::conditions(pen, sheet.conditions.iter())
}

/// Writes a sheet as plain text.
pub(crate) fn text_of(sheet: &Sheet<'_>) -> String {
    written(|text| {
        let pen = text::Text::new(text, sheet.language.words());
        match &sheet.values {
            Some(values) => whole::write_whole(sheet, &mut pen.at(values)),
            None => whole::write_whole(sheet, &mut { pen }),
        }
    })
}

/// Writes a sheet as LaTeX.
pub(crate) fn latex_of(sheet: &Sheet<'_>) -> String {
    written(|text| {
        let pen = latex::Latex::new(text, sheet.language.words());
        whole::write_whole(sheet, &mut pen.at(sheet.values.as_ref()))
    })
}

fn written(write: impl FnOnce(&mut String) -> core::fmt::Result) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text);
    text
}
