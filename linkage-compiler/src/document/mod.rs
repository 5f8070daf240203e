//! Formulas for readers: the derivation of a driver or of a scene as plain data.
//!
//! `layout` converts nodes of the graph to terms, fractions and factors. They are nodes of one flat table (`table`), and
//! a document (`data`) refers to formulas by their numbers. The runtime and `linkage-report` print them.

mod data;
mod driver;
mod layout;
mod name;
#[cfg(feature = "serde")]
mod read;
mod scene;
mod sheet;
mod table;

pub use data::{
    Chain, ContactEffect, Document, DriverChoice, Effect, Equation, Group, JointForce, Kernel, KernelCode, Matrix,
    Method, PointVectors, Quantity, Root, SceneDocument, Sensitivity, SheetDocument, Symbol, Turning, Vector,
};
pub use driver::of_driver;
pub use layout::{LONGEST, Layout};
pub use name::Name;
pub use scene::of_scene;
pub use sheet::of_sheet;
pub use table::{Node, Number, Table};

use table::Numbers;

impl Document {
    /// The numbers of its formulas, as often as they are shown, without those of functions.
    #[must_use]
    pub fn formulas(&self) -> Vec<Number> {
        let mut numbers = Vec::new();
        Self { kernels: Vec::new(), ..self.clone() }.each(&mut |number| numbers.push(*number));
        numbers
    }

    /// This document with the nodes that it needs of a table.
    fn with(mut self, table: Table) -> Self {
        let table = table.reduced(&mut self);
        Self { table, ..self }
    }
}

impl SceneDocument {
    /// The numbers of its formulas, as often as they are shown, without those of functions.
    #[must_use]
    pub fn formulas(&self) -> Vec<Number> {
        let mut numbers = Vec::new();
        Self { kernels: Vec::new(), ..self.clone() }.each(&mut |number| numbers.push(*number));
        numbers
    }

    /// This document with the nodes that it needs of a table.
    fn with(mut self, table: Table) -> Self {
        let table = table.reduced(&mut self);
        Self { table, ..self }
    }
}

impl SheetDocument {
    /// This document with the nodes that it needs of a table.
    fn with(mut self, table: Table) -> Self {
        let table = table.reduced(&mut self);
        Self { table, ..self }
    }
}
