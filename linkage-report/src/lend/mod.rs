//! Documents that the compiler keeps, lent as derivations: for programs that compile mechanisms while they run, and for those
//! that read what these wrote.
//!
//! A [`Lender`] owns what it lends: derivations live as long as it does, and all are freed with it.
//!
//! ```
//! use linkage_report::Document;
//! use linkage_report::lend::Lender;
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

mod arena;
mod error;

use linkage_ir::document::{self, Document, Documents, FormulaId, FormulaNodes, Item, Kept, Lent, Part, Store};
use linkage_runtime::derivation::{Derivation, Formula, FormulaTable, SceneDerivation, SheetDerivation};

use crate::sheet::Sheet;
use arena::Arena;
pub use error::Unsound;
use error::places;

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
    pub fn derivation(
        &self,
        document: &Document<document::Derivation<'static, Kept>>,
    ) -> Result<Derivation<'_>, Unsound> {
        let record = &document.record;
        for group in &record.groups {
            places("equations", &group.equations, record.residual.len())?;
            group.inverse.iter().try_for_each(entries)?;
        }
        [&record.jacobian_unknowns, &record.jacobian_inputs].into_iter().try_for_each(entries)?;
        record.sensitivity.iter().try_for_each(|sensitivity| entries(&sensitivity.jacobian))?;
        if let Some(chain) = &record.chain {
            chain.joints.iter().try_for_each(|joint| places("links", &joint.links, chain.links.len()))?;
        }
        self.lent(&document.nodes, record)
    }

    /// Lends the equations of motion of a document.
    ///
    /// # Errors
    /// [`Unsound`] if the document refers to what it does not have.
    pub fn scene(
        &self,
        document: &Document<document::SceneDerivation<'static, Kept>>,
    ) -> Result<SceneDerivation<'_>, Unsound> {
        self.lent(&document.nodes, &document.record)
    }

    /// Lends the analysis by hand of a document.
    ///
    /// # Errors
    /// [`Unsound`] if the document refers to what it does not have.
    pub fn sheet(
        &self,
        document: &Document<document::SheetDerivation<'static, Kept>>,
    ) -> Result<SheetDerivation<'_>, Unsound> {
        let record = &document.record;
        let of_time = record.jacobian_rates.iter().chain(&record.jacobians_of_rates);
        of_time.chain(&record.terms).chain(&record.gamma).try_for_each(entries)?;
        record.turning.iter().flat_map(|of| [&of.rate, &of.acceleration]).try_for_each(entries)?;
        let parts = |of: &document::ChainVector<'static, Kept>| {
            [&of.vector, &of.matrix, &of.rates, &of.velocity, &of.acceleration].into_iter().try_for_each(entries)
        };
        record.vectors.iter().try_for_each(parts)?;
        record.points.iter().try_for_each(|point| places("vectors", &point.vectors, record.vectors.len()))?;
        self.lent(&document.nodes, record)
    }

    /// Lends all documents of a driver as one sheet, with the default values of parameters; none without a derivation.
    ///
    /// # Errors
    /// [`Unsound`] if a document refers to what it does not have.
    pub fn whole(&self, documents: &Documents) -> Result<Option<Sheet<'_>>, Unsound> {
        let Some(driver) = &documents.driver else { return Ok(None) };
        let mut sheet = Sheet::new(&self.derivation(driver)?);
        for scene in &documents.scenes {
            sheet.scene(&self.scene(scene)?);
        }
        if let Some(by_hand) = &documents.by_hand {
            sheet.by_hand(&self.sheet(by_hand)?);
        }
        for paragraph in &documents.about {
            sheet.about(paragraph);
        }
        for (name, value) in &documents.defaults {
            sheet.given(name, *value);
        }
        Ok(Some(sheet))
    }

    /// Lends the documents of a driver that have functions: its derivation, then the scenes.
    ///
    /// # Errors
    /// [`Unsound`] if a document refers to what it does not have.
    pub fn with_functions(
        &self,
        documents: &Documents,
    ) -> Result<(Option<Derivation<'_>>, Vec<SceneDerivation<'_>>), Unsound> {
        let driver = documents.driver.as_ref().map(|driver| self.derivation(driver)).transpose()?;
        let scenes = documents.scenes.iter().map(|scene| self.scene(scene)).collect::<Result<_, _>>()?;
        Ok((driver, scenes))
    }

    /// Lends nodes as a table.
    ///
    /// # Errors
    /// [`Unsound`] if a node refers to what is not before it.
    pub fn table(&self, FormulaNodes { nodes, names, parts }: &FormulaNodes) -> Result<&FormulaTable<'_>, Unsound> {
        let names = self.arena.list(names.iter().map(|name| self.arena.text(name)).collect());
        let (nodes, parts) = (self.arena.list(nodes.clone()), self.arena.list(parts.clone()));
        let table = FormulaTable::checked(nodes, names, parts).ok_or(Unsound::Table)?;
        Ok(self.arena.one(table))
    }

    /// Lends a record with formulas of these nodes.
    fn lent<'l, P: Part>(&'l self, nodes: &FormulaNodes, record: &P) -> Result<P::In<'l, Lent<Formula<'l>>>, Unsound> {
        record.copied(&Formulas { arena: &self.arena, table: self.table(nodes)? })
    }
}

/// The formulas of a table, and where texts and lists go.
struct Formulas<'a> {
    arena: &'a Arena,
    table: &'a FormulaTable<'a>,
}

impl<'a> Store<'a, Lent<Formula<'a>>> for Formulas<'a> {
    type Error = Unsound;

    fn text(&self, text: &str) -> &'a str {
        self.arena.text(text)
    }

    fn list<T: Item + 'a>(&self, list: Vec<T>) -> &'a [T] {
        self.arena.list(list)
    }

    fn formula(&self, id: FormulaId) -> Result<Formula<'a>, Unsound> {
        self.table.get(id.get()).ok_or(Unsound::Formula(id.get()))
    }
}

/// An error for an entry outside of its matrix.
fn entries(matrix: &document::FormulaMatrix<'static, Kept>) -> Result<(), Unsound> {
    matrix.entries.iter().try_for_each(|entry| {
        places("rows", &[entry.row], matrix.rows)?;
        places("columns", &[entry.column], matrix.columns)
    })
}
