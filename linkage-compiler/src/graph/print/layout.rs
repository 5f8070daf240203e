//! Layout of formulas: sums, fractions and powers, the signs that are written and the brackets that are needed.

use crate::graph::{External, Graph, Node, NodeId, Number, SymbolId};

use super::{Name, Pieces};

/// A denominator above this is better read as decimals, where those are exact.
const LARGEST_DENOMINATOR: i64 = 100;

/// How firmly a text holds together, from what any neighbour tears apart to what none does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Fraction,
    Product,
    Power,
    Atom,
}

/// Writes one expression, its parts being written already.
pub(super) struct Layout<'a, 'b> {
    pub(super) graph: &'b Graph,
    /// How symbols are shown; without it all is as the graph holds it: factors in their stored order,
    /// the coefficients of a sum beside its terms.
    pub(super) names: Option<&'b dyn Fn(SymbolId) -> Name<'a>>,
    pub(super) pieces: &'b Pieces,
}

impl Layout<'_, '_> {
    pub(super) fn write(&self, out: &mut String, id: NodeId) -> Binding {
        match self.graph.node(id) {
            Node::Pi => out.push_str("pi"),
            Node::Symbol(symbol) => match self.names {
                Some(names) => names(*symbol).write(out),
                None => out.push_str(self.graph.symbol_name(*symbol)),
            },
            Node::Constant(value) => return self.product(out, *value, &[]),
            Node::Product { coefficient, factors } => return self.product(out, *coefficient, factors),
            Node::Sum { constant, terms } => {
                self.sum(out, *constant, terms);
                return Binding::Sum;
            }
            Node::Call(function, arguments) => {
                out.push_str(function.operation().name);
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
        // A leading positive term reads better than a leading minus.
        for negative in [false, true] {
            for &(coefficient, term) in terms {
                if coefficient.is_negative() == negative {
                    join(out, negative);
                    self.term(out, coefficient, term);
                }
            }
        }
        if !constant.is_zero() {
            join(out, constant.is_negative());
            self.fraction(out, constant, &[]);
        }
    }

    /// A term of a sum; in mathematics its coefficient joins its fraction.
    fn term(&self, out: &mut String, coefficient: Number, term: NodeId) {
        match self.graph.node(term) {
            Node::Product { factors, .. } if self.names.is_some() && !self.hides(term) => {
                self.fraction(out, coefficient, factors);
            }
            _ => {
                self.fraction(out, coefficient, &[(term, 1)]);
            }
        }
    }

    fn hides(&self, id: NodeId) -> bool {
        self.pieces.get(id).is_some_and(|piece| piece.hidden)
    }

    /// A user function, or a derivative of it: in mathematics by the name of its value with primes.
    fn external(&self, out: &mut String, external: &External) {
        let names = self.graph.external_names(external.function);
        let order = external.order().unwrap_or(names.len());
        if self.names.is_none() {
            out.push_str(names.get(order).map_or("…", String::as_str));
        } else {
            out.push_str(names.first().map_or("", String::as_str));
            out.extend(std::iter::repeat_n('\'', order));
        }
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

    /// The magnitude of a product: the factors above and below the bar, 1 where there are none.
    fn fraction(&self, out: &mut String, coefficient: Number, factors: &[(NodeId, i32)]) -> Binding {
        let (number, divisor) = self.split(coefficient.absolute());
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for &(base, exponent) in factors {
            if exponent > 0 { &mut above } else { &mut below }.push((base, exponent.unsigned_abs()));
        }
        if self.names.is_some() {
            for side in [&mut above, &mut below] {
                if side.len() > 1 {
                    side.sort_by_key(|&(base, _)| self.place(base));
                }
            }
        }
        let number = Some(number).filter(|number| !number.is_one());
        let count = above.len() + usize::from(number.is_some());
        let whole = below.is_empty() && divisor.is_none();
        let alone = if whole { Binding::Fraction } else { Binding::Product };
        if count == 0 {
            out.push('1');
        }
        self.factors(out, number, &above, if count == 1 { alone } else { Binding::Product });
        if whole {
            return match (count, number) {
                (0, _) | (1, Some(_)) => Binding::Atom,
                (1, None) => Binding::Power,
                _ => Binding::Product,
            };
        }
        // As the graph holds it a number divides first: 3*a/2/b.
        let divisor = match divisor {
            Some(divisor) if self.names.is_none() => {
                out.push('/');
                out.push_str(&divisor.to_string());
                None
            }
            divisor => divisor,
        };
        match below.len() + usize::from(divisor.is_some()) {
            0 => {}
            1 => {
                out.push('/');
                self.factors(out, divisor, &below, Binding::Power);
            }
            _ => {
                out.push_str("/(");
                self.factors(out, divisor, &below, Binding::Product);
                out.push(')');
            }
        }
        // Without names 3*a/b is 3 times the term a/b.
        if self.names.is_some() { Binding::Fraction } else { Binding::Product }
    }

    /// A number and powers, in brackets where they are less firm than `at_least`.
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

    fn split(&self, value: Number) -> (Number, Option<Number>) {
        match value {
            Number::Ratio(_, d) if self.names.is_some() && d > LARGEST_DENOMINATOR && is_decimal(value) => {
                (Number::Float(value.to_f64()), None)
            }
            Number::Ratio(n, d) if d != 1 => (Number::integer(n), Some(Number::integer(d))),
            _ => (value, None),
        }
    }

    /// The place of a factor among others: names, functions, sums in brackets, determinants.
    fn place(&self, id: NodeId) -> u8 {
        match (self.graph.node(id), self.names) {
            (Node::Pi | Node::Constant(_), _) => 0,
            (Node::Symbol(symbol), Some(names)) => match names(*symbol) {
                Name::Plain(_) => 1,
                Name::Rate(_) | Name::Acceleration(_) => 2,
                Name::Ratio { .. } | Name::RatioDerivative { .. } => 3,
                Name::Determinant(_) | Name::Inverse(_) => 6,
            },
            (Node::Symbol(_) | Node::Product { .. }, _) => 1,
            (Node::Call(..) | Node::External(..), _) => 4,
            (Node::Sum { .. }, _) => 5,
        }
    }
}

fn is_decimal(value: Number) -> bool {
    Number::parse(&value.to_f64().to_string()) == Some(value)
}

/// The sign between two terms, or of the first.
fn join(out: &mut String, negative: bool) {
    out.push_str(match (out.is_empty(), negative) {
        (true, false) => "",
        (true, true) => "-",
        (false, false) => " + ",
        (false, true) => " - ",
    });
}
