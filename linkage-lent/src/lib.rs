//! The compiler's documents as derivations of the runtime, for programs that compile mechanisms while they run.
//!
//! A [`Lender`] owns what it lends: derivations live as long as it does, and all are freed with it.
//!
//! ```
//! use linkage_lent::Lender;
//! use linkage_report::Document;
//!
//! let text = "mechanism Crank { param r; input phi; unknown x, y; loop r@phi = (x, y); }";
//! let mechanisms = linkage_compiler::read(text.parse()?).map_err(|messages| messages.concat())?;
//! let (documents, _) = linkage_compiler::documents(&mechanisms[0]).map_err(|messages| messages.concat())?;
//!
//! let lender = Lender::default();
//! let derivation = lender.derivation(&documents[0])?;
//! assert_eq!(derivation.unknowns[0].name, "x");
//! assert!(derivation.to_text().contains("J = ∂Ψ/∂u"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![warn(missing_docs)]

mod arena;
mod derivation;
mod documents;
mod error;
mod formulas;
mod nodes;
mod plain;
mod scene;
mod sheet;

use linkage_compiler::document::{Document, SceneDocument, SheetDocument, Table};
use linkage_runtime::derivation::{Derivation, FormulaTable, SceneDerivation, SheetDerivation};

use arena::Arena;
pub use documents::Documents;
pub use error::Unsound;

/// The owner of derivations: it lends them, and frees all of them at its end.
#[derive(Debug, Default)]
pub struct Lender {
    arena: Arena,
}

impl Lender {
    /// Lends the derivation of a document.
    ///
    /// # Errors
    /// [`Unsound`] if the document refers to what it does not have.
    pub fn derivation(&self, document: &Document) -> Result<Derivation<'_>, Unsound> {
        derivation::lent(&self.arena, document)
    }

    /// Lends the equations of motion of a document.
    ///
    /// # Errors
    /// [`Unsound`] if the document refers to what it does not have.
    pub fn scene(&self, document: &SceneDocument) -> Result<SceneDerivation<'_>, Unsound> {
        scene::lent(&self.arena, document)
    }

    /// Lends the analysis by hand of a document.
    ///
    /// # Errors
    /// [`Unsound`] if the document refers to what it does not have.
    pub fn sheet(&self, document: &SheetDocument) -> Result<SheetDerivation<'_>, Unsound> {
        sheet::lent(&self.arena, document)
    }

    /// Lends the nodes of a table.
    ///
    /// # Errors
    /// [`Unsound`] if a node refers to what is not before it.
    pub fn table(&self, table: &Table) -> Result<&FormulaTable<'_>, Unsound> {
        nodes::lent(&self.arena, table)
    }
}
