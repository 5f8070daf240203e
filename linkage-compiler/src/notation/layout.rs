//! Layout of a formula: terms, fractions and factors in the usual order of mathematics.

use std::rc::Rc;

use super::formula::Formula;
use super::name::Name;
use super::spelled::Spelled;
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};

/// The largest denominator of a ratio that is printed as a fraction; others are printed as decimals if these are exact.
const LARGEST_DENOMINATOR: i64 = 100;

/// Terms with their signs.
#[derive(Debug)]
pub(super) struct Sum<'a> {
    terms: Vec<Term<'a>>,
    length: usize,
    is_tall: bool,
}

#[derive(Debug)]
pub(super) struct Term<'a> {
    pub(super) is_negative: bool,
    pub(super) fraction: Fraction<'a>,
}

/// The factors of a numerator and of a denominator, which may be empty.
#[derive(Debug)]
pub(super) struct Fraction<'a> {
    pub(super) above: Vec<Factor<'a>>,
    pub(super) below: Vec<Factor<'a>>,
}

/// A power with an exponent of at least 1.
#[derive(Debug, Clone)]
pub(super) struct Factor<'a> {
    pub(super) base: Base<'a>,
    pub(super) exponent: u32,
}

#[derive(Debug, Clone)]
pub(super) enum Base<'a> {
    Group(Rc<Sum<'a>>),
    Call(Function, Arguments<'a>),
    /// A user function, differentiated `order` times.
    External {
        name: &'a str,
        order: usize,
        arguments: Arguments<'a>,
    },
    /// A number that is not negative.
    Number(Number),
    Name(Rc<Spelled<'a>>),
    Pi,
    /// Replaces a part that is too long.
    Ellipsis,
}

/// The arguments of a call.
#[derive(Debug, Clone)]
pub(super) struct Arguments<'a>(Rc<[Rc<Sum<'a>>]>);

impl<'a> Sum<'a> {
    fn new(terms: Vec<Term<'a>>) -> Self {
        let length = terms.iter().map(Term::length).sum::<usize>() + 3 * terms.len().saturating_sub(1);
        let leading_minus = terms.first().is_some_and(|term| term.is_negative);
        let is_tall = terms.iter().any(|term| term.fraction.is_tall());
        Self { terms, length: length + usize::from(leading_minus), is_tall }
    }

    fn base(base: Base<'a>) -> Self {
        let fraction = Fraction { above: vec![Factor { base, exponent: 1 }], below: Vec::new() };
        Self::new(vec![Term { is_negative: false, fraction }])
    }

    pub(super) fn name(name: Name<'a>) -> Self {
        Self::base(Base::Name(Rc::new(Spelled { name, formula: Formula::of_name(name) })))
    }

    pub(super) fn ellipsis() -> Self {
        Self::base(Base::Ellipsis)
    }

    pub(super) fn terms(&self) -> &[Term<'a>] {
        &self.terms
    }

    /// The length in bytes with the names of the `linkage!` language: `-l3*sin(theta3 - theta4)` is 24.
    pub(super) fn length(&self) -> usize {
        self.length
    }

    /// True if its brackets must be taller than a line.
    pub(super) fn is_tall(&self) -> bool {
        self.is_tall
    }

    /// The term, if there is only one and it is positive.
    pub(super) fn single(&self) -> Option<&Fraction<'a>> {
        match self.terms.as_slice() {
            [Term { is_negative: false, fraction }] => Some(fraction),
            _ => None,
        }
    }

    /// The factors, if it is only a product.
    fn product(&self) -> Option<&[Factor<'a>]> {
        self.single().filter(|only| only.below.is_empty()).map(|only| only.above.as_slice())
    }
}

impl Term<'_> {
    fn length(&self) -> usize {
        let Fraction { above, below } = &self.fraction;
        let factors = |factors: &[Factor<'_>]| {
            factors.iter().map(Factor::length).sum::<usize>() + factors.len().saturating_sub(1)
        };
        factors(above)
            + match below.as_slice() {
                [] => 0,
                [only] => "/".len() + only.length(),
                many => "/()".len() + factors(many),
            }
    }
}

impl Fraction<'_> {
    fn is_tall(&self) -> bool {
        !self.below.is_empty() || self.above.iter().any(|factor| factor.base.is_tall())
    }

    /// True if it is only a coordinate, a parameter or pi.
    pub(super) fn is_plain(&self) -> bool {
        match self.above.as_slice() {
            [Factor { base, exponent: 1 }] if self.below.is_empty() => match base {
                Base::Name(spelled) => matches!(spelled.name, Name::Plain(_)),
                base => matches!(base, Base::Pi),
            },
            _ => false,
        }
    }
}

impl Factor<'_> {
    pub(super) fn is_power(&self) -> bool {
        self.exponent != 1
    }

    fn length(&self) -> usize {
        self.base.length() + if self.is_power() { "^".len() + self.exponent.to_string().len() } else { 0 }
    }
}

impl Base<'_> {
    fn is_tall(&self) -> bool {
        match self {
            Self::Group(sum) => sum.is_tall,
            Self::Call(function, arguments) => {
                matches!(function, Function::Sqrt | Function::Abs) || arguments.is_tall()
            }
            Self::External { arguments, .. } => arguments.is_tall(),
            Self::Name(spelled) => spelled.name.is_derivative(),
            Self::Number(_) | Self::Pi | Self::Ellipsis => false,
        }
    }

    fn length(&self) -> usize {
        match self {
            Self::Group(sum) => sum.length + "()".len(),
            Self::Call(function, arguments) => function.operation().name.len() + arguments.length(),
            Self::External { name, order, arguments } => name.len() + order + arguments.length(),
            Self::Number(number) => number.to_string().len(),
            Self::Name(spelled) => spelled.name.length(),
            Self::Pi => "pi".len(),
            Self::Ellipsis => "…".len(),
        }
    }
}

impl<'a> Arguments<'a> {
    pub(super) fn iter(&self) -> impl Iterator<Item = &Sum<'a>> {
        self.0.iter().map(Rc::as_ref)
    }

    /// The argument, if it is the only one.
    pub(super) fn only(&self) -> Option<&Sum<'a>> {
        match &*self.0 {
            [only] => Some(only),
            _ => None,
        }
    }

    pub(super) fn is_tall(&self) -> bool {
        self.iter().any(Sum::is_tall)
    }

    fn length(&self) -> usize {
        self.iter().map(Sum::length).sum::<usize>() + "()".len() + ", ".len() * self.0.len().saturating_sub(1)
    }
}

/// Lays out one node, whose children are laid out already.
pub(super) struct Layout<'a, 'b> {
    pub(super) graph: &'a Graph,
    pub(super) names: &'a dyn Fn(SymbolId) -> Name<'a>,
    pub(super) parts: &'b [Option<Rc<Sum<'a>>>],
}

impl<'a> Layout<'a, '_> {
    pub(super) fn sum(&self, id: NodeId) -> Sum<'a> {
        match self.graph.node(id) {
            Node::Pi => Sum::base(Base::Pi),
            Node::Symbol(symbol) => Sum::name((self.names)(*symbol)),
            Node::Constant(value) => Sum::new(vec![self.term(*value, &[])]),
            Node::Product { coefficient, factors } => Sum::new(vec![self.term(*coefficient, factors)]),
            Node::Sum { constant, terms } => self.terms(*constant, terms),
            Node::Call(function, arguments) => Sum::base(Base::Call(*function, self.arguments(arguments))),
            Node::External(external, arguments) => {
                // A derivative is printed as the name of the value with primes.
                let names = self.graph.external_names(external.function);
                let name = names.first().map_or("", String::as_str);
                let order = external.order().unwrap_or(names.len());
                Sum::base(Base::External { name, order, arguments: self.arguments(arguments) })
            }
        }
    }

    /// The terms of a sum, positive ones first, to avoid a leading minus.
    fn terms(&self, constant: Number, terms: &[(Number, NodeId)]) -> Sum<'a> {
        let (negative, positive): (Vec<_>, Vec<_>) =
            terms.iter().partition(|(coefficient, _)| coefficient.is_negative());
        let mut all: Vec<Term> = positive
            .into_iter()
            .chain(negative)
            .map(|(coefficient, term)| match self.graph.node(term) {
                // The coefficient is merged into the fraction of its term.
                Node::Product { factors, .. } if !self.is_hidden(term) => self.term(coefficient, factors),
                _ => self.term(coefficient, &[(term, 1)]),
            })
            .collect();
        if !constant.is_zero() {
            all.push(self.term(constant, &[]));
        }
        Sum::new(all)
    }

    fn part(&self, id: NodeId) -> Rc<Sum<'a>> {
        self.parts[id.index()].clone().unwrap_or_else(|| Rc::new(Sum::ellipsis()))
    }

    fn is_hidden(&self, id: NodeId) -> bool {
        matches!(self.part(id).product(), Some([Factor { base: Base::Ellipsis, .. }]))
    }

    fn arguments(&self, arguments: &[NodeId]) -> Arguments<'a> {
        Arguments(arguments.iter().map(|&argument| self.part(argument)).collect())
    }

    /// A product as a term: sign, numerator (1 if empty) and denominator.
    fn term(&self, coefficient: Number, factors: &[(NodeId, i32)]) -> Term<'a> {
        let (number, divisor) = split(coefficient.absolute());
        let number = (!number.is_one()).then_some(number);
        let (above, below): (Vec<_>, Vec<_>) = factors.iter().partition(|(_, exponent)| *exponent > 0);
        let mut above = self.factors(number, above);
        if above.is_empty() {
            above.push(Factor { base: Base::Number(Number::integer(1)), exponent: 1 });
        }
        let fraction = Fraction { above, below: self.factors(divisor, below) };
        Term { is_negative: coefficient.is_negative(), fraction }
    }

    /// A number and powers, in the usual order of mathematics.
    fn factors(&self, number: Option<Number>, mut powers: Vec<(NodeId, i32)>) -> Vec<Factor<'a>> {
        powers.sort_by_key(|&(base, _)| self.place(base));
        let number = number.map(|number| Factor { base: Base::Number(number), exponent: 1 });
        let mut factors: Vec<Factor> = number.into_iter().collect();
        for (base, exponent) in powers {
            let part = self.part(base);
            match (part.product(), exponent.unsigned_abs()) {
                (Some(product), 1) => factors.extend_from_slice(product),
                (Some([Factor { base, exponent: 1 }]), exponent) => {
                    factors.push(Factor { base: base.clone(), exponent });
                }
                (_, exponent) => factors.push(Factor { base: Base::Group(part), exponent }),
            }
        }
        factors
    }

    /// The sort key of a factor: names, functions, sums in brackets, determinants.
    fn place(&self, id: NodeId) -> u8 {
        match self.graph.node(id) {
            Node::Pi | Node::Constant(_) => 0,
            Node::Symbol(symbol) => match (self.names)(*symbol) {
                Name::Plain(_) => 1,
                Name::Rate(_) | Name::Acceleration(_) => 2,
                Name::Ratio { .. } | Name::RatioDerivative { .. } => 3,
                Name::Determinant(_) | Name::Inverse(_) => 6,
            },
            Node::Product { .. } => 1,
            Node::Call(..) | Node::External(..) => 4,
            Node::Sum { .. } => 5,
        }
    }
}

/// Splits a positive number into a numerator and a denominator.
fn split(value: Number) -> (Number, Option<Number>) {
    match value {
        Number::Ratio(_, d) if d > LARGEST_DENOMINATOR && is_decimal(value) => (Number::Float(value.to_f64()), None),
        Number::Ratio(n, d) if d != 1 => (Number::integer(n), Some(Number::integer(d))),
        _ => (value, None),
    }
}

fn is_decimal(value: Number) -> bool {
    Number::parse(&value.to_f64().to_string()) == Some(value)
}
