//! Lists of formulas in emitted constants.

use super::{Entry, Equation, Formula, FormulaNode, FormulaTable, Symbol};

/// The numbers of all lists of formulas, one after the other: a list is the place of its first number. rustc checks one
/// slice of numbers at once, where lists of lists would each be a value of their own.
///
/// A number without a node ends the compilation.
#[doc(hidden)]
#[derive(Debug, Clone, Copy)]
pub struct FormulaLists<'a> {
    table: FormulaTable<'a>,
    numbers: &'a [u32],
}

impl<'a> FormulaLists<'a> {
    #[must_use]
    pub const fn new(nodes: &'a [FormulaNode], names: &'a [&'a str], parts: &'a [i32], numbers: &'a [u32]) -> Self {
        match FormulaTable::checked(nodes, names, parts) {
            Some(table) => Self { table, numbers },
            None => panic!("a formula refers to a node that is not before it"),
        }
    }

    #[must_use]
    pub const fn formula(self, number: u32) -> Formula<'a> {
        match self.table.get(number) {
            Some(formula) => formula,
            None => panic!("no formula has this number"),
        }
    }

    const fn at(self, place: usize) -> Formula<'a> {
        self.formula(self.numbers[place])
    }

    #[must_use]
    pub const fn equation(self, left: u32, right: u32) -> Equation<'a> {
        Equation { left: self.formula(left), right: self.formula(right) }
    }

    #[must_use]
    pub const fn formulas<const N: usize>(self, first: usize) -> [Formula<'a>; N] {
        let mut all = [self.at(first); N];
        let mut place = 1;
        while place < N {
            all[place] = self.at(first + place);
            place += 1;
        }
        all
    }

    /// Equations, each by its left and its right side.
    #[must_use]
    pub const fn equations<const N: usize>(self, first: usize) -> [Equation<'a>; N] {
        let mut all = [Equation { left: self.at(first), right: self.at(first + 1) }; N];
        let mut place = 1;
        while place < N {
            all[place] = Equation { left: self.at(first + 2 * place), right: self.at(first + 2 * place + 1) };
            place += 1;
        }
        all
    }

    /// Entries of a matrix, each by its row, its column and its formula.
    #[must_use]
    pub const fn entries<const N: usize>(self, first: usize) -> [Entry<'a>; N] {
        let mut all = [Entry { row: 0, column: 0, value: self.at(first + 2) }; N];
        let mut place = 0;
        while place < N {
            let at = first + 3 * place;
            let [row, column] = [self.numbers[at] as usize, self.numbers[at + 1] as usize];
            all[place] = Entry { row, column, value: self.at(at + 2) };
            place += 1;
        }
        all
    }

    /// Names as symbols.
    #[must_use]
    pub const fn symbols<const N: usize>(self, first: usize) -> [Symbol<'a>; N] {
        let mut all = [Symbol { name: "", formula: self.at(first) }; N];
        let mut place = 0;
        while place < N {
            let number = self.numbers[first + place] as usize;
            all[place].name = match self.table.nodes[number - 1] {
                FormulaNode::Name(name) => self.table.names[name as usize],
                _ => panic!("a symbol is a name"),
            };
            all[place].formula = self.at(first + place);
            place += 1;
        }
        all
    }
}
