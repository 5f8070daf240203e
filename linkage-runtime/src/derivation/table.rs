//! Formulas as numbers of nodes in a table.

use core::fmt;

use linkage_ir::ElementaryFunction;
use linkage_ir::document::FormulaNode;

use super::notation::Name;

/// The nodes of the formulas of one derivation. Each refers to nodes before it only, so that a formula ends.
#[derive(Clone, Copy, PartialEq)]
pub struct FormulaTable<'a> {
    pub(super) nodes: &'a [FormulaNode],
    /// The names of quantities and of user functions.
    pub(super) names: &'a [&'a str],
    /// The numbers of terms, factors and arguments.
    parts: &'a [i32],
}

/// A formula: a node of a table. Its [`Display`](fmt::Display) is one line of Unicode, such as `−l₃·l₄·sin(θ₃ − θ₄)`;
/// the crate `linkage` has a trait `Notation` with LaTeX and MathML.
#[derive(Clone, Copy)]
pub struct Formula<'a> {
    pub(super) table: &'a FormulaTable<'a>,
    /// From 1 to the length of the table.
    pub(super) number: u32,
}

/// A node with the formulas that it refers to.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub enum FormulaView<'a> {
    /// A name, or a derivative of one.
    Name(Name<'a>),
    /// A whole number.
    Integer(u64),
    /// A number.
    Decimal(f64),
    /// π.
    Pi,
    /// The place of a part that is too long to be printed.
    Ellipsis,
    /// Terms from left to right.
    Sum(Terms<'a>),
    /// Factors from left to right.
    Product(FormulaList<'a>),
    /// A numerator and a denominator.
    Quotient(Formula<'a>, Formula<'a>),
    /// A base and an exponent.
    Power(Formula<'a>, u32),
    /// An elementary function and its arguments.
    Call(ElementaryFunction, FormulaList<'a>),
    /// A user function, the order of its derivative, and its arguments.
    External(&'a str, u32, FormulaList<'a>),
    /// A product of two with a sign between them in every notation.
    Multiple(Formula<'a>, Formula<'a>),
    /// a ≤ b ≤ ….
    AtMost(FormulaList<'a>),
    /// a ≠ 0.
    NonZero(Formula<'a>),
    /// The statement that a formula has a value.
    Exists(Formula<'a>),
}

/// Factors or arguments.
#[derive(Debug, Clone, Copy)]
pub struct FormulaList<'a> {
    table: &'a FormulaTable<'a>,
    numbers: &'a [i32],
}

/// The terms of a sum.
#[derive(Debug, Clone, Copy)]
pub struct Terms<'a> {
    table: &'a FormulaTable<'a>,
    numbers: &'a [i32],
}

impl<'a> FormulaTable<'a> {
    /// The table of these nodes, names and parts; none if one refers to a node that does not come before it, takes the derivative,
    /// determinant or inverse of a node that is not a name, or has no parts.
    #[must_use]
    pub const fn checked(nodes: &'a [FormulaNode], names: &'a [&'a str], parts: &'a [i32]) -> Option<Self> {
        let table = Self { nodes, names, parts };
        let mut place = 0;
        while place < nodes.len() {
            if !table.is_sound(place) {
                return None;
            }
            place += 1;
        }
        Some(table)
    }

    /// The formula with this number; none if there is none.
    #[must_use]
    pub const fn get(&'a self, number: u32) -> Option<Formula<'a>> {
        if is_before(number, self.nodes.len()) { Some(Formula { table: self, number }) } else { None }
    }

    /// The number of nodes.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.nodes.len()
    }

    /// True for a table without nodes.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}

/// True if this is the number of a node before a place.
const fn is_before(number: u32, place: usize) -> bool {
    number != 0 && number as usize <= place
}

impl<'a> FormulaTable<'a> {
    /// The name at a place; checked tables have those of their nodes.
    fn name(&self, place: u32) -> &'a str {
        self.names.get(place as usize).copied().unwrap_or_default()
    }

    /// True if the node at a place refers to nodes before it, by their meaning.
    const fn is_sound(&self, place: usize) -> bool {
        match self.nodes[place] {
            FormulaNode::Rate(name)
            | FormulaNode::Acceleration(name)
            | FormulaNode::Determinant(name)
            | FormulaNode::Inverse(name) => self.is_name(name, place),
            FormulaNode::Ratio(of, by) => self.is_name(of, place) && self.is_name(by, place),
            FormulaNode::RatioDerivative(of, first, second) => {
                self.is_name(of, place) && self.is_name(first, place) && self.is_name(second, place)
            }
            FormulaNode::Name(name) => self.has_name(name),
            FormulaNode::Integer(_) | FormulaNode::Decimal(_) | FormulaNode::Pi | FormulaNode::Ellipsis => true,
            FormulaNode::Quotient(one, other) | FormulaNode::Multiple(one, other) => {
                is_before(one, place) && is_before(other, place)
            }
            FormulaNode::Power(inside, _) | FormulaNode::NonZero(inside) | FormulaNode::Exists(inside) => {
                is_before(inside, place)
            }
            FormulaNode::Product(first, count)
            | FormulaNode::Call(_, first, count)
            | FormulaNode::AtMost(first, count) => self.has_parts(first, count, place, false),
            FormulaNode::External(name, _, first, count) => {
                self.has_name(name) && self.has_parts(first, count, place, false)
            }
            FormulaNode::Sum(first, count) => self.has_parts(first, count, place, true),
        }
    }

    const fn has_name(&self, name: u32) -> bool {
        (name as usize) < self.names.len()
    }

    const fn is_name(&self, number: u32, place: usize) -> bool {
        is_before(number, place) && matches!(self.nodes[number as usize - 1], FormulaNode::Name(_))
    }

    /// True if there are these parts, and if they are nodes before a place; only terms have signs.
    const fn has_parts(&self, first: u32, count: u32, place: usize, are_terms: bool) -> bool {
        let (first, count) = (first as usize, count as usize);
        if count == 0 || first > self.parts.len() || count > self.parts.len() - first {
            return false;
        }
        let mut at = first;
        while at < first + count {
            let number = self.parts[at];
            if !is_before(number.unsigned_abs(), place) || (number < 0 && !are_terms) {
                return false;
            }
            at += 1;
        }
        true
    }
}

impl<'a> Formula<'a> {
    /// Its number in its table.
    #[must_use]
    pub fn number(self) -> u32 {
        self.number
    }

    /// Its outermost node.
    #[must_use]
    pub fn view(self) -> FormulaView<'a> {
        let Self { table, .. } = self;
        let at = |number| Self { table, number };
        // Checked tables have these parts.
        let parts = |first: u32, count: u32| {
            table.parts.get(first as usize..).and_then(|from| from.get(..count as usize)).unwrap_or_default()
        };
        let all = |first, count| FormulaList { table, numbers: parts(first, count) };
        match self.node() {
            FormulaNode::Name(_)
            | FormulaNode::Rate(_)
            | FormulaNode::Acceleration(_)
            | FormulaNode::Ratio(..)
            | FormulaNode::RatioDerivative(..)
            | FormulaNode::Determinant(_)
            | FormulaNode::Inverse(_) => FormulaView::Name(self.name()),
            FormulaNode::Integer(number) => FormulaView::Integer(number),
            FormulaNode::Decimal(number) => FormulaView::Decimal(number),
            FormulaNode::Pi => FormulaView::Pi,
            FormulaNode::Ellipsis => FormulaView::Ellipsis,
            FormulaNode::Sum(first, count) => FormulaView::Sum(Terms { table, numbers: parts(first, count) }),
            FormulaNode::Product(first, count) => FormulaView::Product(all(first, count)),
            FormulaNode::Quotient(above, below) => FormulaView::Quotient(at(above), at(below)),
            FormulaNode::Power(base, exponent) => FormulaView::Power(at(base), exponent),
            FormulaNode::Call(function, first, count) => FormulaView::Call(function, all(first, count)),
            FormulaNode::External(name, order, first, count) => {
                FormulaView::External(table.name(name), order, all(first, count))
            }
            FormulaNode::Multiple(one, other) => FormulaView::Multiple(at(one), at(other)),
            FormulaNode::AtMost(first, count) => FormulaView::AtMost(all(first, count)),
            FormulaNode::NonZero(inside) => FormulaView::NonZero(at(inside)),
            FormulaNode::Exists(inside) => FormulaView::Exists(at(inside)),
        }
    }

    fn node(self) -> FormulaNode {
        self.table.nodes[self.number as usize - 1]
    }

    /// The name that it is; checked tables have names where derivatives are taken.
    fn name(self) -> Name<'a> {
        let text = |number| match (Self { number, ..self }).node() {
            FormulaNode::Name(name) => self.table.name(name),
            _ => "",
        };
        match self.node() {
            FormulaNode::Rate(name) => Name::Rate(text(name)),
            FormulaNode::Acceleration(name) => Name::Acceleration(text(name)),
            FormulaNode::Ratio(of, by) => Name::Ratio { of: text(of), by: text(by) },
            FormulaNode::RatioDerivative(of, first, second) => {
                Name::RatioDerivative { of: text(of), by: [text(first), text(second)] }
            }
            FormulaNode::Determinant(matrix) => Name::Determinant(text(matrix)),
            FormulaNode::Inverse(matrix) => Name::Inverse(text(matrix)),
            _ => Name::Plain(text(self.number)),
        }
    }
}

impl<'a> FormulaList<'a> {
    /// The formulas in order.
    pub fn iter(self) -> impl DoubleEndedIterator<Item = Formula<'a>> + ExactSizeIterator + Clone {
        let Self { table, numbers } = self;
        numbers.iter().map(move |number| Formula { table, number: number.unsigned_abs() })
    }

    /// The formula, if it is the only one.
    #[must_use]
    pub fn only(self) -> Option<Formula<'a>> {
        match *self.numbers {
            [number] => Some(Formula { table: self.table, number: number.unsigned_abs() }),
            _ => None,
        }
    }
}

impl<'a> Terms<'a> {
    /// The terms in order, each with true if it is subtracted.
    pub fn iter(self) -> impl DoubleEndedIterator<Item = (bool, Formula<'a>)> + ExactSizeIterator + Clone {
        let Self { table, numbers } = self;
        numbers.iter().map(move |&number| (number < 0, Formula { table, number: number.unsigned_abs() }))
    }
}

/// Formulas are equal if they have the same nodes, also in different tables.
impl PartialEq for Formula<'_> {
    fn eq(&self, other: &Self) -> bool {
        use FormulaView as V;
        let is_same = |one: FormulaList<'_>, other: FormulaList<'_>| one.iter().eq(other.iter());
        match (self.view(), other.view()) {
            (V::Name(one), V::Name(other)) => one == other,
            (V::Integer(one), V::Integer(other)) => one == other,
            (V::Decimal(one), V::Decimal(other)) => one.to_bits() == other.to_bits(),
            (V::Pi, V::Pi) | (V::Ellipsis, V::Ellipsis) => true,
            (V::Sum(one), V::Sum(other)) => one.iter().eq(other.iter()),
            (V::Product(one), V::Product(other)) | (V::AtMost(one), V::AtMost(other)) => is_same(one, other),
            (V::Quotient(a, b), V::Quotient(c, d)) | (V::Multiple(a, b), V::Multiple(c, d)) => a == c && b == d,
            (V::Power(one, m), V::Power(other, n)) => m == n && one == other,
            (V::Call(f, one), V::Call(g, other)) => f == g && is_same(one, other),
            (V::External(f, m, one), V::External(g, n, other)) => f == g && m == n && is_same(one, other),
            (V::NonZero(one), V::NonZero(other)) | (V::Exists(one), V::Exists(other)) => one == other,
            _ => false,
        }
    }
}

impl Eq for Formula<'_> {}

impl fmt::Debug for FormulaTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "FormulaTable({})", self.nodes.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use FormulaNode::{AtMost, Call, Determinant, Name, NonZero, Power, Product, Quotient, Rate, Sum};

    /// A table with a reference to a node that is not before it, or that is not what it must be, cannot be made.
    #[test]
    fn references_lead_to_nodes() {
        let parts = [1, -2, 3, 0, i32::MIN, 1];
        let sound = [Name(0), Rate(1), Sum(0, 2), Power(3, 2), Quotient(2, 4)];
        assert!(FormulaTable::checked(&sound, &["x"], &parts).is_some());
        for wrong in [
            Sum(0, 2),
            Sum(3, 1),
            Sum(4, 1),
            Sum(0, 0),
            Sum(5, 2),
            Sum(7, 1),
            Sum(u32::MAX, u32::MAX),
            Product(2, 1),
            Product(0, 0),
            Quotient(1, 3),
            Power(0, 2),
            Call(ElementaryFunction::Sin, 0, 2),
            AtMost(2, 1),
            NonZero(2),
            Rate(2),
            Name(1),
        ] {
            assert!(FormulaTable::checked(&[Name(0), wrong], &["x"], &parts).is_none(), "{wrong:?}");
        }
        // Factors have no signs.
        assert!(FormulaTable::checked(&[Name(0), Name(0), Product(0, 2)], &["x"], &parts).is_none());
        // The rate of a sum, and the determinant of a number.
        assert!(FormulaTable::checked(&[Name(0), Sum(0, 1), Rate(2)], &["x"], &parts).is_none());
        assert!(FormulaTable::checked(&[FormulaNode::Pi, Determinant(1)], &[], &parts).is_none());
        let table = FormulaTable::checked(&[Name(0)], &["x"], &[]).unwrap();
        assert!(table.get(1).is_some() && table.get(0).is_none() && table.get(2).is_none());
    }

    #[test]
    fn formulas_of_two_tables_are_equal_by_their_nodes() {
        let one = FormulaTable::checked(&[Name(0), Power(1, 2), Sum(0, 2)], &["x"], &[2, -1]).unwrap();
        let nodes = [Name(0), Name(1), Power(2, 2), Sum(0, 2), Sum(2, 2)];
        let other = FormulaTable::checked(&nodes, &["y", "x"], &[3, -2, 3, 2]).unwrap();
        assert_eq!(one.get(3).unwrap(), other.get(4).unwrap());
        assert_ne!(one.get(3).unwrap(), other.get(5).unwrap());
        assert_eq!(std::format!("{:?} {}", one.get(3).unwrap(), one.get(1).unwrap()), "\"x² − x\" x");
    }
}
