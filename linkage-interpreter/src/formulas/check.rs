//! The checks of formulas that are read: every register is written before it is read, and there are as many results as names.

use linkage_ir::ElementaryFunction;

use super::{Formula, Formulas, Instruction, Range, Register};

/// The numbers of a mechanism.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Counts {
    pub parameters: usize,
    pub unknowns: usize,
    pub inputs: usize,
    pub groups: usize,
    /// Two components of each point, and the outputs.
    pub quantities: usize,
    pub ranges: usize,
}

impl Formulas {
    /// Checks that the formulas are those of a mechanism with these numbers.
    pub(crate) fn check(&self, counts: Counts) -> Result<(), &'static str> {
        let Counts { parameters, unknowns, inputs, groups, quantities, ranges } = counts;
        let values = parameters + unknowns + inputs;
        let all = [
            (&self.residual, values, unknowns),
            (&self.jacobian_unknowns, values, unknowns * unknowns),
            (&self.jacobian_inputs, values, unknowns * inputs),
            (&self.gamma, values + unknowns + inputs, unknowns),
            (&self.quantities, values, quantities),
        ];
        for (formula, given, results) in all {
            formula.check(given, formula.results.iter().copied())?;
            if formula.results.len() != results {
                return Err("a formula has another number of results");
            }
        }
        let registers = |range: &Range| [Some(range.value), range.least, range.most].into_iter().flatten();
        self.ranges.check(values, self.ranges.results.iter().flat_map(registers))?;
        if self.ranges.results.len() != ranges || self.names.len() != quantities || self.user_functions.len() != groups
        {
            return Err("names of formulas are missing");
        }
        Ok(())
    }
}

impl<R> Formula<R> {
    fn check(&self, given: usize, results: impl IntoIterator<Item = Register>) -> Result<(), &'static str> {
        let mut written = given;
        let is_written = |Register(place): Register, written: usize| (place as usize) < written;
        for instruction in &self.instructions {
            if !instruction.reads().all(|register| is_written(register, written)) {
                return Err("a formula refers to a later number");
            }
            if let Instruction::Of(function, _) | Instruction::OfTwo(function, ..) = instruction
                && (function.arity() != instruction.reads().count() || *function == ElementaryFunction::IfNonzero)
            {
                return Err("a formula calls a function with other arguments");
            }
            written += instruction.writes() as usize;
        }
        match results.into_iter().all(|register| is_written(register, written)) {
            true => Ok(()),
            false => Err("a result of a formula does not exist"),
        }
    }
}
