//! The formulas of an emitted function, in the notation of FPCore, for programs that compute how large
//! rounding errors can be.
//!
//! A function is executed with symbols for numbers (`run`), calls of other functions included. That gives operations in
//! the order of the code (`operations`), which are formulas in the table of the document (`lines`). Newton's method, pivoting and user
//! functions have no formula: nor have the results that depend on them.

mod lines;
mod name;
mod operations;
mod run;
mod value;

use crate::document::{KernelCode, Table};
use crate::lower::Code;
use crate::program::{Program, SceneProgram, SceneSignatures};
use run::{Owner, Run};

/// The functions of a driver, or of a scene on a driver.
pub(super) struct Straight<'a> {
    owner: Owner<'a>,
}

impl<'a> Straight<'a> {
    pub(super) fn of_driver(program: &'a Program<Code>) -> Self {
        let signatures = &program.signatures;
        Self { owner: Owner::new(&program.functions, &signatures.arguments, signatures.mechanism, None) }
    }

    /// The functions of a scene on this driver.
    pub(super) fn within(&'a self, scene: &'a SceneProgram<Code>) -> Self {
        let SceneSignatures { arguments, field, .. } = &scene.signatures;
        Self { owner: Owner::new(&scene.functions, arguments, self.owner.mechanism, Some((field, &self.owner))) }
    }

    /// The formulas of the function with this name; empty if it has none.
    pub(super) fn code(&self, name: &str, table: &mut Table) -> KernelCode {
        let Some(function) = self.owner.functions.get(name) else { return KernelCode::default() };
        let mut run = Run::default();
        let value = run.result(&self.owner, function);
        lines::code(self.owner.mechanism, &run.operations, &run.checks, &value, table)
    }
}
