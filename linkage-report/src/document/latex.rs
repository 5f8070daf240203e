//! A derivation as LaTeX.

use core::fmt::{self, Write};

use super::outline::{GeneralEquation, Lines, Pen, words};
use crate::Notation;
use linkage_runtime::derivation::{Counts, Equation, Formula, FormulaMatrix, Group, Kernel, Root};

/// A matrix with more rows or columns than this is written as a list of its entries.
const LARGEST_MATRIX: usize = 6;

pub(super) struct Latex<'a> {
    out: &'a mut String,
}

impl<'a> Latex<'a> {
    pub(super) fn new(out: &'a mut String) -> Self {
        Self { out }
    }
}

/// Escapes identifiers in running text.
fn escape(name: &str) -> String {
    name.replace('_', "\\_")
}

impl Lines for Latex<'_> {
    fn heading(&mut self, heading: &str) -> fmt::Result {
        writeln!(self.out, "\n\\subsection*{{{heading}}}")
    }

    fn lead(&mut self, words: &str) -> fmt::Result {
        writeln!(self.out, "{}", escape(words))
    }

    fn general_equation(&mut self, general: &GeneralEquation) -> fmt::Result {
        writeln!(self.out, "\\[ {} \\]", general.latex)
    }

    fn display(&mut self, formula: &Formula<'_>) -> fmt::Result {
        writeln!(self.out, "\\[ {} \\]", formula.to_latex())
    }

    fn equation(&mut self, number: usize, equation: &Equation<'_>) -> fmt::Result {
        let Equation { left, right } = equation;
        writeln!(
            self.out,
            "\\begin{{equation*}} {} = {} \\tag{{{number}}} \\end{{equation*}}",
            left.to_latex(),
            right.to_latex()
        )
    }

    fn matrix(&mut self, matrix: &FormulaMatrix<'_>) -> fmt::Result {
        let name = matrix.name.to_latex();
        let factor = matrix.factor.map_or_else(String::new, |factor| format!("{} ", factor.to_latex()));
        if matrix.rows.max(matrix.columns) > LARGEST_MATRIX {
            for entry in matrix.entries {
                let (row, column) = (entry.row + 1, entry.column + 1);
                writeln!(
                    self.out,
                    "\\[ \\left({name}\\right)_{{{row},{column}}} = {factor}{} \\]",
                    entry.value.to_latex()
                )?;
            }
            return Ok(());
        }
        writeln!(self.out, "\\[ {name} = {factor}\\begin{{pmatrix}}")?;
        for row in 0..matrix.rows {
            let entries = (0..matrix.columns)
                .map(|column| matrix.entry(row, column).map_or_else(|| "0".to_owned(), |entry| entry.to_latex()));
            writeln!(self.out, "  {} \\\\", entries.collect::<Vec<_>>().join(" & "))?;
        }
        writeln!(self.out, "\\end{{pmatrix}} \\]")
    }
}

impl Pen for Latex<'_> {
    fn title(&mut self, mechanism: &str) -> fmt::Result {
        writeln!(self.out, "\\section*{{{}}}", escape(mechanism))
    }

    fn list(&mut self, role: &str, formulas: &mut dyn Iterator<Item = Formula<'_>>) -> fmt::Result {
        let formulas: Vec<_> = formulas.map(|formula| format!("${}$", formula.to_latex())).collect();
        writeln!(self.out, "{role}: {}\\par", formulas.join(", "))
    }

    fn counts(&mut self, counts: Counts) -> fmt::Result {
        let Counts { coordinates, equations } = counts;
        let freedom = counts.freedom();
        writeln!(self.out, "{}: $n = {coordinates}$, $p = {equations}$, $F = n - p = {freedom}$\\par", words::COUNTS)
    }

    fn group(&mut self, n: usize, group: &Group<'_>) -> fmt::Result {
        let equations: Vec<_> = group.equations.iter().map(|equation| format!("({})", equation + 1)).collect();
        let equations = equations.join(", ");
        writeln!(self.out, "\\paragraph{{Group {n}, {}}} Equations {equations}.\\par", group.kind)
    }

    fn branches(&mut self, Root { formula, branches: [positive, negative] }: &Root<'_>) -> fmt::Result {
        let root = formula.to_latex();
        writeln!(
            self.out,
            "${root}$ is positive on the branch \\texttt{{{positive}}}, negative on \\texttt{{{negative}}}.\\par"
        )
    }

    fn kernels(&mut self, kernels: &[Kernel<'_>]) -> fmt::Result {
        writeln!(self.out, "\\begin{{tabular}}{{lrrrr}}")?;
        writeln!(self.out, "Function & functions & divisions & multiplications & additions \\\\ \\hline")?;
        for Kernel { function, operations, .. } in kernels {
            writeln!(
                self.out,
                "\\texttt{{{}}} & {} & {} & {} & {} \\\\",
                escape(function),
                operations.functions,
                operations.divisions,
                operations.multiplications,
                operations.additions
            )?;
        }
        writeln!(self.out, "\\end{{tabular}}")
    }
}
