//! Derivations as plain text and LaTeX, with numbered equations.

mod latex;
pub(crate) mod outline;
mod text;

use crate::FpCore;
use linkage_runtime::derivation::{Derivation, SceneDerivation};

/// A derivation that can be written as a document.
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
        written(|text| outline::write(self, &mut text::Text::new(text)))
    }

    fn to_latex(&self) -> String {
        written(|text| outline::write(self, &mut latex::Latex::new(text)))
    }

    fn fpcore(&self) -> Vec<FpCore<'_>> {
        FpCore::of(self.mechanism, self.kernels)
    }
}

impl Document for SceneDerivation<'_> {
    fn to_text(&self) -> String {
        written(|text| outline::write_scene(self, &mut text::Text::new(text)))
    }

    fn to_latex(&self) -> String {
        written(|text| outline::write_scene(self, &mut latex::Latex::new(text)))
    }

    fn fpcore(&self) -> Vec<FpCore<'_>> {
        FpCore::of(self.scene, self.kernels)
    }
}

fn written(write: impl FnOnce(&mut String) -> core::fmt::Result) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text);
    text
}
