//! Layout of formulas: sums, fractions, powers, signs and brackets.

use crate::graph::Number;
use crate::graph::arena::Graph;
use crate::graph::node::{External, Node, NodeId};

/// The precedence of the outermost operator of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Product,
    Power,
    Atom,
}

/// A printed subexpression.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    pub(super) body: String,
    pub(super) binding: Binding,
}

/// Printed subexpressions, by node index.
#[derive(Debug, Default)]
pub(super) struct Pieces(pub(super) Vec<Option<Piece>>);

impl Pieces {
    pub(super) fn get(&self, id: NodeId) -> Option<&Piece> {
        match self.0.as_slice().get(id.index()) {
            Some(Some(piece)) => Some(piece),
            _ => None,
        }
    }
}

/// Prints one node, whose children are printed already.
pub(super) struct Layout<'a> {
    pub(super) graph: &'a Graph,
    pub(super) pieces: &'a Pieces,
}

impl Layout<'_> {
    pub(super) fn write(&self, out: &mut String, id: NodeId) -> Binding {
        match self.graph.node(id) {
            Node::Pi => out.push_str("pi"),
            Node::Symbol(symbol) => out.push_str(self.graph.symbol_name(*symbol)),
            Node::Constant(value) => return self.product(out, *value, &[]),
            Node::Product { coefficient, factors } => return self.product(out, *coefficient, factors),
            Node::Sum { constant, terms } => {
                self.sum(out, *constant, terms);
                return Binding::Sum;
            }
            Node::Call(function, arguments) => {
                out.push_str(function.name());
                self.arguments(out, arguments);
            }
            Node::External(external, arguments) => {
                self.external(out, external);
                self.arguments(out, arguments);
            }
        }
        Binding::Atom
    }

    fn product(&self, out: &mut String, coefficient: Number, factors: &[(NodeId, i32)]) -> Binding {
        if !coefficient.is_negative() {
            return self.fraction(out, coefficient, factors);
        }
        out.push('-');
        self.fraction(out, coefficient, factors);
        Binding::Sum
    }

    fn sum(&self, out: &mut String, constant: Number, terms: &[(Number, NodeId)]) {
        // Positive terms come first, to avoid a leading minus.
        for negative in [false, true] {
            for &(coefficient, term) in terms {
                if coefficient.is_negative() == negative {
                    join(out, negative);
                    self.fraction(out, coefficient, &[(term, 1)]);
                }
            }
        }
        if !constant.is_zero() {
            join(out, constant.is_negative());
            self.fraction(out, constant, &[]);
        }
    }

    /// A user function, or a derivative of it.
    fn external(&self, out: &mut String, external: &External) {
        let names = self.graph.external_names(external.function);
        let name = external.order().and_then(|order| names.get(order));
        out.push_str(name.map_or("…", String::as_str));
    }

    fn arguments(&self, out: &mut String, arguments: &[NodeId]) {
        out.push('(');
        for (index, argument) in arguments.iter().enumerate() {
            if index > 0 {
                out.push_str(", ");
            }
            if let Some(piece) = self.pieces.get(*argument) {
                out.push_str(&piece.body);
            }
        }
        out.push(')');
    }

    /// Prints the magnitude of a product: numerator (1 if empty) and denominator.
    fn fraction(&self, out: &mut String, coefficient: Number, factors: &[(NodeId, i32)]) -> Binding {
        let (number, divisor) = split(coefficient.absolute());
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for &(base, exponent) in factors {
            if exponent > 0 { &mut above } else { &mut below }.push((base, exponent.unsigned_abs()));
        }
        let number = Some(number).filter(|number| !number.is_one());
        let count = above.len() + usize::from(number.is_some());
        if count == 0 {
            out.push('1');
        }
        self.factors(out, number, &above, Binding::Product);
        // Numeric divisors come first: 3*a/2/b.
        if let Some(divisor) = divisor {
            out.push('/');
            out.push_str(&divisor.to_string());
        }
        match below.len() {
            0 => {}
            1 => {
                out.push('/');
                self.factors(out, None, &below, Binding::Power);
            }
            _ => {
                out.push_str("/(");
                self.factors(out, None, &below, Binding::Product);
                out.push(')');
            }
        }
        match (count, number) {
            _ if divisor.is_some() || !below.is_empty() => Binding::Product,
            (0, _) | (1, Some(_)) => Binding::Atom,
            (1, None) => Binding::Power,
            _ => Binding::Product,
        }
    }

    /// Prints a number and powers, in brackets if their precedence is below `at_least`.
    fn factors(&self, out: &mut String, number: Option<Number>, powers: &[(NodeId, u32)], at_least: Binding) {
        if let Some(number) = number {
            out.push_str(&number.to_string());
        }
        for (index, &(base, exponent)) in powers.iter().enumerate() {
            if index > 0 || number.is_some() {
                out.push('*');
            }
            let Some(piece) = self.pieces.get(base) else { continue };
            let at_least = if exponent == 1 { at_least } else { Binding::Atom };
            if piece.binding < at_least {
                out.push('(');
                out.push_str(&piece.body);
                out.push(')');
            } else {
                out.push_str(&piece.body);
            }
            if exponent > 1 {
                out.push('^');
                out.push_str(&exponent.to_string());
            }
        }
    }
}

/// Splits a positive number into a numerator and a denominator other than 1.
fn split(value: Number) -> (Number, Option<Number>) {
    match value {
        Number::Ratio(n, d) if d != 1 => (Number::integer(n), Some(Number::integer(d))),
        _ => (value, None),
    }
}

/// Prints the sign before a term.
fn join(out: &mut String, negative: bool) {
    out.push_str(match (out.is_empty(), negative) {
        (true, false) => "",
        (true, true) => "-",
        (false, false) => " + ",
        (false, true) => " - ",
    });
}
