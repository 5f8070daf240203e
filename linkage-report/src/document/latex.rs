//! A derivation as LaTeX.

use core::fmt::{self, Write};

use super::outline::{GeneralEquation, Lines, Pen, counts};
use crate::Notation;
use crate::sheet::Values;
use crate::words::{Words, capitalised};
use linkage_runtime::derivation::{Counts, Equation, Formula, FormulaMatrix, Group, Kernel, Root};

/// A matrix with more rows or columns than this is written as a list of its entries.
const LARGEST_MATRIX: usize = 6;

pub(super) struct Latex<'a> {
    out: &'a mut String,
    words: &'static Words,
    /// The numbers after formulas.
    values: Option<Values>,
}

impl<'a> Latex<'a> {
    pub(super) fn new(out: &'a mut String, words: &'static Words) -> Self {
        Self { out, words, values: None }
    }

    /// With numbers after formulas.
    pub(super) fn at(self, values: Option<&Values>) -> Self {
        Self { values: values.cloned(), ..self }
    }

    fn numbered(&mut self, number: usize, Equation { left, right }: &Equation<'_>, about: &str) -> fmt::Result {
        let [left, right] = [left, right].map(Notation::to_latex);
        writeln!(self.out, "\\begin{{equation*}} {left} = {right}{about} \\tag{{{number}}} \\end{{equation*}}")
    }
}

/// Escapes running text.
fn escape(text: &str) -> String {
    let escaped = |sign: char| match sign {
        '_' | '&' | '%' | '$' | '#' | '{' | '}' => format!("\\{sign}"),
        '\\' => "\\textbackslash{}".to_owned(),
        '~' => "\\textasciitilde{}".to_owned(),
        '^' => "\\textasciicircum{}".to_owned(),
        _ => sign.to_string(),
    };
    text.chars().map(escaped).collect()
}

impl Lines for Latex<'_> {
    fn words(&self) -> &'static Words {
        self.words
    }

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
        writeln!(self.out, "\\[ {} \\]", self.words.formula(formula, formula.to_latex()))
    }

    fn equation(&mut self, number: usize, equation: &Equation<'_>) -> fmt::Result {
        let value = self.values.as_mut().and_then(|values| values.define(equation));
        let about = value.map_or_else(String::new, |value| format!(" \\approx {}", self.words.latex(value)));
        self.numbered(number, equation, &about)
    }

    fn zero(&mut self, number: usize, equation: &Equation<'_>) -> fmt::Result {
        self.numbered(number, equation, "")
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

    fn list(&mut self, role: &str, formulas: &mut dyn Iterator<Item = (Formula<'_>, Option<f64>)>) -> fmt::Result {
        let formulas = formulas.map(|(formula, value)| {
            let value = value.map_or_else(String::new, |value| format!(" = {}", self.words.latex(value)));
            format!("${}{value}$", formula.to_latex())
        });
        let formulas: Vec<_> = formulas.collect();
        writeln!(self.out, "{role}: {}\\par", formulas.join(", "))
    }

    fn table(&mut self, caption: &str, rows: &[(String, f64)]) -> fmt::Result {
        writeln!(self.out, "{}\\par\n\\begin{{tabular}}{{lr}}", escape(caption))?;
        for (name, value) in rows {
            writeln!(self.out, "\\texttt{{{}}} & ${}$ \\\\", escape(name), self.words.latex(*value))?;
        }
        writeln!(self.out, "\\end{{tabular}}\\par")
    }

    fn counts(&mut self, counts: Counts) -> fmt::Result {
        let Counts { coordinates, equations } = counts;
        let freedom = counts.freedom();
        let words = self.words.counts;
        writeln!(self.out, "{words}: $n = {coordinates}$, $p = {equations}$, $F = n - p = {freedom}$\\par")
    }

    fn group(&mut self, n: usize, group: &Group<'_>) -> fmt::Result {
        let equations: Vec<_> = group.equations.iter().map(|equation| format!("({})", equation + 1)).collect();
        let (words, equations) = (self.words, equations.join(", "));
        let (kind, several) = ((words.kind)(group), capitalised(words.equations));
        writeln!(self.out, "\\paragraph{{{} {n}, {kind}}} {several} {equations}.\\par", words.group)
    }

    fn branches(&mut self, Root { formula, branches }: &Root<'_>) -> fmt::Result {
        let [positive, negative] = branches.map(|branch| format!("\\texttt{{{branch}}}"));
        let root = format!("${}$", formula.to_latex());
        writeln!(self.out, "{}\\par", (self.words.branches)(&root, [&positive, &negative]))
    }

    fn kernels(&mut self, kernels: &[Kernel<'_>]) -> fmt::Result {
        writeln!(self.out, "\\begin{{tabular}}{{lrrrr}}")?;
        let columns = self.words.operation_counts().join(" & ");
        writeln!(self.out, "{} & {columns} \\\\ \\hline", self.words.function)?;
        for Kernel { function, operations, .. } in kernels {
            let counts = counts(operations).map(|count| count.to_string()).join(" & ");
            writeln!(self.out, "\\texttt{{{}}} & {counts} \\\\", escape(function))?;
        }
        writeln!(self.out, "\\end{{tabular}}")
    }
}
