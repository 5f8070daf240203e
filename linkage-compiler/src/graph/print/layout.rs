//! How an expression is put on paper, before any notation spells it.

use crate::graph::{External, Function, Graph, Node, NodeId, Number, SymbolId};

use super::style::{Binding, Style, is_circular};
use super::{Name, Pieces, is_hidden};

/// A denominator above this is better read as decimals, where those are exact.
const LARGEST_DENOMINATOR: i64 = 100;

/// What a layout depends on besides the expression.
pub(super) struct Reading<'a, 'b> {
    pub(super) graph: &'a Graph,
    /// How symbols are shown; without it all is as in the language: factors in their stored order,
    /// the coefficients of a sum beside its terms.
    pub(super) names: Option<&'a dyn Fn(SymbolId) -> Name<'a>>,
    /// What was written first, which says what is hidden.
    pub(super) measured: &'b Pieces,
}

/// One expression; its parts are nodes.
pub(super) enum Layout {
    Pi,
    Symbol(SymbolId),
    /// Terms and whether each is negative, in the order in which they are written.
    Sum(Vec<(bool, Quotient)>),
    /// A number or product, and whether it is negative.
    Product(bool, Quotient),
    Call(Function, Vec<NodeId>),
    External(External, Vec<NodeId>),
}

/// The factors above and below a fraction's bar; 1 where there are none.
#[derive(Default)]
pub(super) struct Quotient {
    above: Vec<Factor>,
    below: Vec<Factor>,
}

#[derive(Clone, Copy)]
enum Factor {
    /// Not negative.
    Number(Number),
    Power(NodeId, u32),
}

impl Reading<'_, '_> {
    fn hides(&self, id: NodeId) -> bool {
        is_hidden(self.measured, id)
    }

    pub(super) fn layout(&self, id: NodeId) -> Layout {
        match self.graph.node(id) {
            Node::Pi => Layout::Pi,
            Node::Symbol(symbol) => Layout::Symbol(*symbol),
            Node::Constant(value) => Layout::Product(value.is_negative(), self.quotient(*value, &[])),
            Node::Product { coefficient, factors } => {
                Layout::Product(coefficient.is_negative(), self.quotient(*coefficient, factors))
            }
            Node::Sum { constant, terms } => {
                // A leading positive term reads better than a leading minus.
                let (plus, minus): (Vec<_>, Vec<_>) = terms.iter().partition(|(k, _)| !k.is_negative());
                let mut written: Vec<_> =
                    plus.into_iter().chain(minus).map(|&(k, term)| (k.is_negative(), self.term(k, term))).collect();
                if !constant.is_zero() {
                    written.push((constant.is_negative(), self.quotient(*constant, &[])));
                }
                Layout::Sum(written)
            }
            Node::Call(function, arguments) => Layout::Call(*function, arguments.clone()),
            Node::External(external, arguments) => Layout::External(external.clone(), arguments.clone()),
        }
    }

    /// A term of a sum; in mathematics its coefficient joins its fraction.
    fn term(&self, coefficient: Number, term: NodeId) -> Quotient {
        match self.graph.node(term) {
            Node::Product { factors, .. } if self.names.is_some() && !self.hides(term) => {
                self.quotient(coefficient, factors)
            }
            _ => self.quotient(coefficient, &[(term, 1)]),
        }
    }

    fn quotient(&self, coefficient: Number, factors: &[(NodeId, i32)]) -> Quotient {
        let mut quotient = Quotient::default();
        let (above, below) = self.split(coefficient.absolute());
        if !above.is_one() {
            quotient.above.push(Factor::Number(above));
        }
        quotient.below.extend(below.map(Factor::Number));
        let mut factors = factors.to_vec();
        if self.names.is_some() {
            factors.sort_by_key(|&(base, _)| self.place(base));
        }
        for (base, exponent) in factors {
            let side = if exponent < 0 { &mut quotient.below } else { &mut quotient.above };
            side.push(Factor::Power(base, exponent.unsigned_abs()));
        }
        quotient
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

    /// Where a factor stands among others: names, functions, sums in brackets, determinants.
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

    /// The function, if the factor is sine, cosine or tangent.
    fn circular(&self, factor: Factor) -> bool {
        match factor {
            Factor::Number(_) => false,
            Factor::Power(base, _) => {
                matches!(self.graph.node(base), Node::Call(function, _) if is_circular(*function)) && !self.hides(base)
            }
        }
    }

    /// Whether the argument of a function may go without brackets.
    fn bare(&self, function: Function, arguments: &[NodeId]) -> bool {
        is_circular(function)
            && arguments.iter().all(|&id| match (self.graph.node(id), self.names) {
                (Node::Pi, _) => true,
                (Node::Symbol(symbol), Some(names)) => matches!(names(*symbol), Name::Plain(_)),
                _ => false,
            })
    }
}

fn is_decimal(value: Number) -> bool {
    Number::parse(&value.to_f64().to_string()) == Some(value)
}

impl Layout {
    /// The expression in a style, its parts being written already.
    pub(super) fn spell(&self, reading: &Reading<'_, '_>, style: &dyn Style, parts: &Pieces) -> (String, Binding) {
        match self {
            Self::Pi => (style.pi().to_owned(), Binding::Atom),
            Self::Symbol(symbol) => match reading.names {
                Some(names) => style.name(names(*symbol)),
                None => style.name(Name::Plain(reading.graph.symbol_name(*symbol))),
            },
            Self::Sum(terms) => {
                let terms: Vec<_> =
                    terms.iter().map(|(negative, term)| (*negative, term.spell(reading, style, parts).0)).collect();
                (style.sum(&terms), Binding::Sum)
            }
            Self::Product(negative, quotient) => {
                let (body, binding) = quotient.spell(reading, style, parts);
                if *negative { (style.sum(&[(true, body)]), Binding::Sum) } else { (body, binding) }
            }
            Self::Call(function, arguments) => {
                let bare = reading.bare(*function, arguments);
                (style.call(*function, &bodies(arguments, parts), 1, bare), Binding::Atom)
            }
            Self::External(external, arguments) => {
                let names = reading.graph.external_names(external.function);
                let order = external.order().unwrap_or(names.len());
                (style.external(names, order, &bodies(arguments, parts)), Binding::Atom)
            }
        }
    }
}

fn bodies(arguments: &[NodeId], parts: &Pieces) -> Vec<String> {
    arguments.iter().map(|id| parts.get(id).map(|piece| piece.body.clone()).unwrap_or_default()).collect()
}

impl Quotient {
    fn spell(&self, reading: &Reading<'_, '_>, style: &dyn Style, parts: &Pieces) -> (String, Binding) {
        let whole = self.below.is_empty();
        let side = |factors: &[Factor]| -> Vec<String> {
            let lone = match (factors.len(), whole, style.has_bars()) {
                (1, true, _) => Binding::Slash,
                (1, false, true) => Binding::Sum,
                _ => Binding::Product,
            };
            let followers = factors.iter().skip(1).map(Some).chain([None]);
            let pairs = factors.iter().zip(followers);
            pairs.map(|(&factor, next)| factor.spell(reading, style, parts, next.copied(), lone)).collect()
        };
        let above = side(&self.above);
        let above = match above.as_slice() {
            [] => style.number(Number::ONE),
            [one] => one.clone(),
            many => style.product(many),
        };
        if !whole {
            return (style.quotient(&above, &side(&self.below)), Binding::Product);
        }
        let binding = match self.above.as_slice() {
            [] | [Factor::Number(_)] => Binding::Atom,
            [_] => Binding::Power,
            _ => Binding::Product,
        };
        (above, binding)
    }
}

impl Factor {
    fn spell(
        self,
        reading: &Reading<'_, '_>,
        style: &dyn Style,
        parts: &Pieces,
        next: Option<Self>,
        at_least: Binding,
    ) -> String {
        let (base, exponent) = match self {
            Self::Number(value) => return style.number(value),
            Self::Power(base, exponent) => (base, exponent),
        };
        // The power of a sine stands at its name; without brackets a function ends where the next begins.
        if let Node::Call(function, arguments) = reading.graph.node(base)
            && reading.circular(self)
        {
            let last = next.is_none_or(|next| reading.circular(next));
            let bare = last && reading.bare(*function, arguments);
            return style.call(*function, &bodies(arguments, parts), exponent, bare);
        }
        let Some(piece) = parts.get(&base) else { return String::new() };
        let at_least = if exponent == 1 { at_least } else { Binding::Atom };
        let body = if piece.binding < at_least { style.brackets(&piece.body) } else { piece.body.clone() };
        if exponent == 1 { body } else { style.power(&body, exponent) }
    }
}
