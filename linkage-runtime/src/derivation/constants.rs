//! Lists of formulas in emitted constants.

use super::{Entry, Equation, Formula, FormulaNode, FormulaTable, Symbol};

/// All lists of formulas, one list of a kind after the other. The table and the lists are statics: rustc looks through
/// the whole of a constant wherever something refers to it, and the time grows as the square of its length.
///
/// A number without a node, or a list out of range, ends the compilation.
#[derive(Debug)]
pub struct FormulaLists<'a, const FORMULAS: usize, const SYMBOLS: usize, const EQUATIONS: usize, const ENTRIES: usize> {
    table: &'a FormulaTable<'a>,
    formulas: [Formula<'a>; FORMULAS],
    symbols: [Symbol<'a>; SYMBOLS],
    equations: [Equation<'a>; EQUATIONS],
    entries: [Entry<'a>; ENTRIES],
}

impl<'a, const FORMULAS: usize, const SYMBOLS: usize, const EQUATIONS: usize, const ENTRIES: usize>
    FormulaLists<'a, FORMULAS, SYMBOLS, EQUATIONS, ENTRIES>
{
    /// The lists with these numbers: of each formula, of each name, of the sides of each equation, and the row, the column
    /// and the formula of each entry.
    #[must_use]
    pub const fn new(table: &'a FormulaTable<'a>, numbers: &[u32]) -> Self {
        // All places of the lists are filled; a table without nodes has none.
        let first = Formula { table, number: 1 };
        let mut lists = Self {
            table,
            formulas: [first; FORMULAS],
            symbols: [Symbol { name: "", formula: first }; SYMBOLS],
            equations: [Equation { left: first, right: first }; EQUATIONS],
            entries: [Entry { row: 0, column: 0, value: first }; ENTRIES],
        };
        let (mut at, mut place) = (0, 0);
        while place < FORMULAS {
            lists.formulas[place] = formula(table, numbers[at]);
            (at, place) = (at + 1, place + 1);
        }
        place = 0;
        while place < SYMBOLS {
            let formula = formula(table, numbers[at]);
            let FormulaNode::Name(name) = table.nodes[numbers[at] as usize - 1] else { panic!("a symbol is a name") };
            lists.symbols[place] = Symbol { name: table.names[name as usize], formula };
            (at, place) = (at + 1, place + 1);
        }
        place = 0;
        while place < EQUATIONS {
            let [left, right] = [formula(table, numbers[at]), formula(table, numbers[at + 1])];
            lists.equations[place] = Equation { left, right };
            (at, place) = (at + 2, place + 1);
        }
        place = 0;
        while place < ENTRIES {
            let [row, column] = [numbers[at] as usize, numbers[at + 1] as usize];
            lists.entries[place] = Entry { row, column, value: formula(table, numbers[at + 2]) };
            (at, place) = (at + 3, place + 1);
        }
        assert!(at == numbers.len(), "each number belongs to a list");
        lists
    }

    /// The formula with this number.
    #[must_use]
    pub const fn formula(&self, number: u32) -> Formula<'a> {
        formula(self.table, number)
    }

    /// The equation of two formulas with these numbers.
    #[must_use]
    pub const fn equation(&self, left: u32, right: u32) -> Equation<'a> {
        Equation { left: self.formula(left), right: self.formula(right) }
    }

    /// A list of formulas by its first place and its length, and likewise the others.
    #[must_use]
    pub const fn formulas(&self, first: usize, count: usize) -> &[Formula<'a>] {
        part(&self.formulas, first, count)
    }

    /// A list of names.
    #[must_use]
    pub const fn symbols(&self, first: usize, count: usize) -> &[Symbol<'a>] {
        part(&self.symbols, first, count)
    }

    /// A list of equations.
    #[must_use]
    pub const fn equations(&self, first: usize, count: usize) -> &[Equation<'a>] {
        part(&self.equations, first, count)
    }

    /// The entries of a matrix.
    #[must_use]
    pub const fn entries(&self, first: usize, count: usize) -> &[Entry<'a>] {
        part(&self.entries, first, count)
    }
}

/// A table of formulas.
#[must_use]
pub const fn table<'a>(nodes: &'a [FormulaNode], names: &'a [&'a str], parts: &'a [i32]) -> FormulaTable<'a> {
    match FormulaTable::checked(nodes, names, parts) {
        Some(table) => table,
        None => panic!("a formula refers to a node that is not before it"),
    }
}

const fn formula<'a>(table: &'a FormulaTable<'a>, number: u32) -> Formula<'a> {
    match table.get(number) {
        Some(formula) => formula,
        None => panic!("no formula has this number"),
    }
}

const fn part<T>(all: &[T], first: usize, count: usize) -> &[T] {
    all.split_at(first).1.split_at(count).0
}
