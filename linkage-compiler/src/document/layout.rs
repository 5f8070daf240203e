//! Layout of a formula: terms, fractions and factors in the usual order of mathematics.

use super::name::Name;
use linkage_ir::document::FormulaId;

use super::table::{Node, Table};
use crate::graph::{self, Condition, Function, Graph, NodeId, SymbolId};

/// The largest length of a formula, in bytes with the names of the `linkage!` language (`theta3` is 6); an ellipsis
/// replaces a longer part. The formula of a graph with shared nodes can be exponentially long. The printed length is
/// about two thirds of this, 400 characters. With half of it, formulas of one or two lines are cut; with twice of it, a
/// long formula takes twice the space on the page and in the expansion.
pub const LONGEST: usize = 600;

/// The largest denominator of a ratio that is printed as a fraction; others are printed as decimals if these are exact.
const LARGEST_DENOMINATOR: i64 = 100;

/// Lays out formulas of one graph in a table; shared subexpressions once.
pub struct Layout<'a> {
    /// The nodes so far.
    pub table: Table,
    graph: &'a Graph,
    names: &'a dyn Fn(SymbolId) -> Name<'a>,
    longest: usize,
    /// The laid out subexpressions, by node index.
    parts: Vec<Option<FormulaId>>,
}

impl<'a> Layout<'a> {
    /// `names` returns the name of each symbol.
    #[must_use]
    pub fn new(graph: &'a Graph, names: &'a dyn Fn(SymbolId) -> Name<'a>) -> Self {
        Self { table: Table::default(), graph, names, longest: LONGEST, parts: Vec::new() }
    }

    /// This layout with another largest length.
    #[must_use]
    pub fn longest(self, bytes: usize) -> Self {
        Self { longest: bytes, ..self }
    }

    /// The formula of a condition such as l₄ ≠ 0.
    pub fn condition(&mut self, condition: Condition) -> FormulaId {
        let node = match condition {
            Condition::NonZero(node) => Node::NonZero(self.formula(node)),
            Condition::Defined(node) => Node::Exists(self.formula(node)),
        };
        self.table.add(node)
    }

    /// The formula of a node; all its subexpressions are laid out.
    pub fn formula(&mut self, root: NodeId) -> FormulaId {
        // Children have smaller ids than their parents.
        if self.parts.len() <= root.index() {
            self.parts.resize_with(root.index() + 1, || None);
        }
        let missing = self.graph.sweep(&[root], |id| self.parts[id.index()].is_some(), |_| false);
        for id in missing {
            // A reader takes the limit of v where v is 0 / 0.
            if let graph::Node::Call(Function::IfNonzero, arguments) = self.graph.node(id) {
                self.parts[id.index()] = self.parts[arguments[1].index()];
                continue;
            }
            let laid_out = self.laid_out(id);
            let fits = self.table.length(laid_out) <= self.longest;
            self.parts[id.index()] = Some(if fits { laid_out } else { self.table.add(Node::Ellipsis) });
        }
        self.part(root)
    }

    /// Lays out one node, whose children are laid out already.
    fn laid_out(&mut self, id: NodeId) -> FormulaId {
        let graph = self.graph;
        match graph.node(id) {
            graph::Node::Pi => self.table.add(Node::Pi),
            graph::Node::Symbol(symbol) => self.table.name((self.names)(*symbol)),
            graph::Node::Constant(value) => {
                let term = self.term(*value, &[]);
                self.table.sum(vec![term])
            }
            graph::Node::Product { coefficient, factors } => {
                let term = self.term(*coefficient, factors);
                self.table.sum(vec![term])
            }
            graph::Node::Sum { constant, terms } => self.terms(*constant, terms),
            graph::Node::Call(function, arguments) => {
                let arguments = self.arguments(arguments);
                self.table.add(Node::Call(*function, arguments))
            }
            graph::Node::External(external, arguments) => {
                // A derivative is printed as the name of the value with primes.
                let names = graph.external_names(external.function);
                let name = names.first().cloned().unwrap_or_default();
                let order = external.order().unwrap_or(names.len());
                let arguments = self.arguments(arguments);
                self.table.add(Node::External(name, order, arguments))
            }
        }
    }

    /// The terms of a sum, positive ones first, to avoid a leading minus.
    fn terms(&mut self, constant: graph::Number, terms: &[(graph::Number, NodeId)]) -> FormulaId {
        let (negative, positive): (Vec<_>, Vec<_>) =
            terms.iter().partition(|(coefficient, _)| coefficient.is_negative());
        let mut all = Vec::new();
        for (coefficient, term) in positive.into_iter().chain(negative) {
            all.push(match self.graph.node(term) {
                // The coefficient is merged into the fraction of its term.
                graph::Node::Product { factors, .. } if !self.is_hidden(term) => self.term(coefficient, factors),
                _ => self.term(coefficient, &[(term, 1)]),
            });
        }
        if !constant.is_zero() {
            all.push(self.term(constant, &[]));
        }
        self.table.sum(all)
    }

    fn part(&mut self, id: NodeId) -> FormulaId {
        self.parts[id.index()].unwrap_or_else(|| self.table.add(Node::Ellipsis))
    }

    fn is_hidden(&mut self, id: NodeId) -> bool {
        let part = self.part(id);
        matches!(self.table.node(part), Node::Ellipsis)
    }

    fn arguments(&mut self, arguments: &[NodeId]) -> Vec<FormulaId> {
        arguments.iter().map(|&argument| self.part(argument)).collect()
    }

    /// A product as a term: true if it is negative, and its fraction or factors.
    fn term(&mut self, coefficient: graph::Number, factors: &[(NodeId, i32)]) -> (bool, FormulaId) {
        let (number, divisor) = split(coefficient.absolute());
        let number = (!number.is_one()).then_some(number);
        let (above, below): (Vec<_>, Vec<_>) = factors.iter().partition(|(_, exponent)| *exponent > 0);
        let mut above = self.factors(number, above);
        if above.is_empty() {
            above.push(self.table.add(Node::Integer(1)));
        }
        let (above, below) = (self.table.product(above), self.factors(divisor, below));
        let fraction = if below.is_empty() {
            above
        } else {
            let below = self.table.product(below);
            self.table.add(Node::Quotient(above, below))
        };
        (coefficient.is_negative(), fraction)
    }

    /// A number and powers, in the usual order of mathematics.
    fn factors(&mut self, number: Option<graph::Number>, mut powers: Vec<(NodeId, i32)>) -> Vec<FormulaId> {
        powers.sort_by_key(|&(base, _)| self.place(base));
        let mut factors: Vec<FormulaId> = number.map(|number| self.number(number)).into_iter().collect();
        for (base, exponent) in powers {
            let part = self.part(base);
            match (self.table.node(part), exponent.unsigned_abs()) {
                (Node::Product(product), 1) => factors.extend_from_slice(product),
                (_, 1) => factors.push(part),
                (_, exponent) => factors.push(self.table.add(Node::Power(part, exponent))),
            }
        }
        factors
    }

    /// A number that is not negative.
    fn number(&mut self, number: graph::Number) -> FormulaId {
        match number.as_integer().and_then(|integer| u64::try_from(integer).ok()) {
            Some(integer) => self.table.add(Node::Integer(integer)),
            None => self.table.decimal(number.to_f64()),
        }
    }

    /// The sort key of a factor: names, functions, sums in brackets, determinants.
    fn place(&self, id: NodeId) -> u8 {
        match self.graph.node(id) {
            graph::Node::Pi | graph::Node::Constant(_) => 0,
            graph::Node::Symbol(symbol) => match (self.names)(*symbol) {
                Name::Plain(_) => 1,
                Name::Rate(_) | Name::Acceleration(_) => 2,
                Name::Ratio { .. } | Name::RatioDerivative { .. } => 3,
                Name::Determinant(_) | Name::Inverse(_) => 6,
            },
            graph::Node::Product { .. } => 1,
            graph::Node::Call(..) | graph::Node::External(..) => 4,
            graph::Node::Sum { .. } => 5,
        }
    }
}

/// Splits a positive number into a numerator and a denominator.
fn split(value: graph::Number) -> (graph::Number, Option<graph::Number>) {
    use graph::Number;
    match value {
        Number::Ratio(_, d) if d > LARGEST_DENOMINATOR && is_decimal(value) => (Number::Float(value.to_f64()), None),
        Number::Ratio(n, d) if d != 1 => (Number::integer(n), Some(Number::integer(d))),
        _ => (value, None),
    }
}

fn is_decimal(value: graph::Number) -> bool {
    graph::Number::parse(&value.to_f64().to_string()) == Some(value)
}
