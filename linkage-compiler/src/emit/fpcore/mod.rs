//! The formulas of an emitted function, in the notation of FPCore, for programs that compute how large
//! rounding errors can be.
//!
//! A function becomes straight-line operations on numbers (`inline`), calls of other functions included: operations in
//! the order of the code (`operations`), which are formulas in the table of the document (`lines`). Newton's method, pivoting and user
//! functions have no formula: nor have the results that depend on them.

mod inline;
mod lines;
mod name;
mod operations;
mod value;

use linkage_ir::code::Code;

use crate::document::{KernelCode, Table};
use crate::model::Mechanism;
use crate::program::{Program, SceneProgram};
use inline::{Inlined, Owner};

/// The functions of a driver, or of a scene on a driver.
pub(super) struct Straight<'a> {
    owner: Owner<'a>,
}

impl<'a> Straight<'a> {
    pub(super) fn of_driver(mechanism: &'a Mechanism, program: &'a Program<Code>) -> Self {
        let signatures = &program.signatures;
        Self { owner: Owner::new(&program.functions, &signatures.arguments, (mechanism, program), None) }
    }

    /// The functions of a scene on this driver.
    pub(super) fn within(&'a self, scene: &'a SceneProgram<Code>) -> Self {
        let arguments = &scene.signatures.arguments;
        Self { owner: Owner::new(&scene.functions, arguments, self.owner.declared, Some(&self.owner)) }
    }

    /// The formulas of the function with this name; empty if it has none.
    pub(super) fn code(&self, name: &str, table: &mut Table) -> KernelCode {
        let Some(function) = self.owner.functions.named(name) else { return KernelCode::default() };
        let mut inlined = Inlined::default();
        let value = inlined.result(&self.owner, function);
        lines::code(self.owner.declared.0, &inlined.operations, &inlined.checks, &value, table)
    }
}
