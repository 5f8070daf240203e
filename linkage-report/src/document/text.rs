//! A derivation as plain text.

use core::fmt::{self, Write};

use super::outline::{GeneralEquation, Lines, Pen, counts};
use crate::sheet::Values;
use crate::words::Words;
use linkage_runtime::derivation::{Counts, Equation, Formula, FormulaMatrix, Group, Kernel, Root};

pub(super) struct Text<'a> {
    out: &'a mut String,
    words: &'static Words,
    sections: usize,
    /// The numbers after formulas.
    values: Option<Values>,
}

impl<'a> Text<'a> {
    pub(super) fn new(out: &'a mut String, words: &'static Words) -> Self {
        Self { out, words, sections: 0, values: None }
    }

    /// With numbers after formulas.
    pub(super) fn at(self, values: &Values) -> Self {
        Self { values: Some(values.clone()), ..self }
    }

    /// The number of a formula, and the end of the line.
    fn number(&mut self, formula: Formula<'_>) -> fmt::Result {
        let value = self.values.as_ref().and_then(|values| values.of_unless_number(formula));
        self.about(value)
    }

    /// A number after a formula, if it has one, and the end of the line.
    fn about(&mut self, value: Option<f64>) -> fmt::Result {
        match value {
            Some(value) => writeln!(self.out, "  ≈ {}", self.words.number(value)),
            None => writeln!(self.out),
        }
    }

    fn numbered(&mut self, number: usize, equation: &Equation<'_>) -> fmt::Result {
        let width = if number < 10 { 3 } else { 2 };
        write!(self.out, "  ({number}){:width$}{equation}", "")
    }

    /// The width of the longest role and a space.
    fn roles(&self) -> usize {
        let Words { given, driven, unknown, counts, .. } = self.words;
        [given, driven, unknown, counts].map(|role| role.chars().count() + 1).into_iter().max().unwrap_or_default()
    }

    fn underline(&mut self, text: &str, line: &str) -> fmt::Result {
        writeln!(self.out, "{text}")?;
        for _ in text.chars() {
            self.out.write_str(line)?;
        }
        writeln!(self.out)
    }
}

impl Lines for Text<'_> {
    fn words(&self) -> &'static Words {
        self.words
    }

    fn heading(&mut self, heading: &str) -> fmt::Result {
        self.sections += 1;
        writeln!(self.out, "\n{}. {heading}\n", self.sections)
    }

    fn lead(&mut self, words: &str) -> fmt::Result {
        writeln!(self.out, "  {words}")
    }

    fn general_equation(&mut self, general: &GeneralEquation) -> fmt::Result {
        writeln!(self.out, "        {}", general.text)
    }

    fn display(&mut self, formula: &Formula<'_>) -> fmt::Result {
        writeln!(self.out, "        {}", self.words.formula(formula, formula.to_string()))
    }

    fn equation(&mut self, number: usize, equation: &Equation<'_>) -> fmt::Result {
        self.numbered(number, equation)?;
        let value = self.values.as_mut().and_then(|values| values.define(equation));
        self.about(value)
    }

    fn zero(&mut self, number: usize, equation: &Equation<'_>) -> fmt::Result {
        self.numbered(number, equation)?;
        writeln!(self.out)
    }

    fn matrix(&mut self, matrix: &FormulaMatrix<'_>) -> fmt::Result {
        if let Some(factor) = matrix.factor {
            writeln!(self.out, "        {} = {factor} {}", matrix.name, self.words.matrix)?;
        }
        if matrix.entries.is_empty() {
            writeln!(self.out, "        {} = 0", matrix.name)?;
        }
        for entry in matrix.entries {
            let (row, column) = (entry.row + 1, entry.column + 1);
            match matrix.factor {
                Some(_) => write!(self.out, "          [{row}, {column}] = {}", entry.value)?,
                None => write!(self.out, "        {}[{row}, {column}] = {}", matrix.name, entry.value)?,
            }
            self.number(entry.value)?;
        }
        Ok(())
    }

    fn sum(&mut self, number: usize, equation: &Equation<'_>, of: &[&FormulaMatrix<'_>]) -> fmt::Result {
        self.numbered(number, equation)?;
        match self.values.as_ref().and_then(|values| values.sum(of)) {
            Some([x, y]) => writeln!(self.out, "  ≈ ({}, {})", self.words.number(x), self.words.number(y)),
            None => writeln!(self.out),
        }
    }
}

impl Pen for Text<'_> {
    fn title(&mut self, mechanism: &str) -> fmt::Result {
        self.underline(mechanism, "═")
    }

    fn list(&mut self, role: &str, formulas: &mut dyn Iterator<Item = (Formula<'_>, Option<f64>)>) -> fmt::Result {
        write!(self.out, "  {role:<0$}", self.roles())?;
        for (index, (formula, value)) in formulas.enumerate() {
            write!(self.out, "{} {formula}", if index == 0 { "" } else { "," })?;
            value.map_or(Ok(()), |value| write!(self.out, " = {}", self.words.number(value)))?;
        }
        writeln!(self.out)
    }

    fn table(&mut self, caption: &str, rows: &[(String, f64)]) -> fmt::Result {
        let width = rows.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
        writeln!(self.out, "  {caption}")?;
        rows.iter().try_for_each(|(name, value)| writeln!(self.out, "    {name:width$}  {}", self.words.number(*value)))
    }

    fn counts(&mut self, counts: Counts) -> fmt::Result {
        writeln!(self.out, "  {:<1$} {counts}", self.words.counts, self.roles())
    }

    fn group(&mut self, n: usize, group: &Group<'_>) -> fmt::Result {
        write!(self.out, "  {} {n}, {}: {}", self.words.group, (self.words.kind)(group), self.words.equations)?;
        for (index, equation) in group.equations.iter().enumerate() {
            write!(self.out, "{} ({})", if index == 0 { "" } else { "," }, equation + 1)?;
        }
        writeln!(self.out)
    }

    fn branches(&mut self, Root { formula, branches }: &Root<'_>) -> fmt::Result {
        writeln!(self.out, "  {}", (self.words.branches)(&formula.to_string(), *branches))
    }

    fn kernels(&mut self, kernels: &[Kernel<'_>]) -> fmt::Result {
        let width = kernels.iter().map(|kernel| kernel.function.len()).max().unwrap_or(0);
        let columns = self.words.operation_counts();
        writeln!(self.out, "  {:width$}  {}", "", columns.join("  "))?;
        for Kernel { function, operations, .. } in kernels {
            write!(self.out, "  {function:width$}")?;
            for (column, count) in columns.iter().zip(counts(operations)) {
                write!(self.out, "  {count:>0$}", column.chars().count())?;
            }
            writeln!(self.out)?;
        }
        Ok(())
    }
}
