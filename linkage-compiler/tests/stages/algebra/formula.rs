//! A parser of formulas into a graph.

use std::collections::BTreeMap;
use std::iter::Peekable;
use std::str::Chars;

use linkage_compiler::graph::{Function, Graph, NodeId, Number, SymbolId};
use linkage_equality::{Answer, compare};

/// A graph with names.
#[derive(Default)]
pub struct Formulas {
    pub graph: Graph,
    symbols: BTreeMap<String, SymbolId>,
}

impl Formulas {
    pub fn symbol(&mut self, name: &str) -> SymbolId {
        *self.symbols.entry(name.to_owned()).or_insert_with(|| self.graph.symbol(name))
    }

    pub fn node(&mut self, text: &str) -> NodeId {
        let spaceless: String = text.split_whitespace().collect();
        let mut rest = spaceless.chars().peekable();
        let node = self.sum(&mut rest);
        assert_eq!(rest.next(), None, "{text}");
        node
    }

    pub fn compare(&mut self, left: &str, right: &str) -> Answer {
        let (left, right) = (self.node(left), self.node(right));
        compare(&self.graph, left, right)
    }

    fn sum(&mut self, rest: &mut Peekable<Chars>) -> NodeId {
        let mut sign = if rest.next_if_eq(&'-').is_some() { Number::MINUS_ONE } else { Number::ONE };
        let mut terms = Vec::new();
        loop {
            terms.push((sign, self.product(rest)));
            sign = match rest.next_if(|c| "+-".contains(*c)) {
                Some('+') => Number::ONE,
                Some(_) => Number::MINUS_ONE,
                None => return self.graph.sum(&terms),
            };
        }
    }

    fn product(&mut self, rest: &mut Peekable<Chars>) -> NodeId {
        let mut product = self.power(rest);
        while let Some(operator) = rest.next_if(|c| "*/".contains(*c)) {
            let factor = self.power(rest);
            product =
                if operator == '*' { self.graph.multiply(product, factor) } else { self.graph.divide(product, factor) };
        }
        product
    }

    fn power(&mut self, rest: &mut Peekable<Chars>) -> NodeId {
        let base = self.atom(rest);
        if rest.next_if_eq(&'^').is_none() {
            return base;
        }
        let sign = if rest.next_if_eq(&'-').is_some() { -1 } else { 1 };
        let Ok(exponent) = word(rest).parse::<i32>() else { panic!("an exponent is an integer") };
        self.graph.power(base, sign * exponent)
    }

    fn atom(&mut self, rest: &mut Peekable<Chars>) -> NodeId {
        if rest.next_if_eq(&'(').is_some() {
            let inner = self.sum(rest);
            assert_eq!(rest.next(), Some(')'));
            return inner;
        }
        let word = word(rest);
        if let Ok(integer) = word.parse::<i64>() {
            return self.graph.number(Number::integer(integer));
        }
        if word == "pi" {
            return self.graph.pi();
        }
        let Some(function) = Function::named(&word) else {
            let symbol = self.symbol(&word);
            return self.graph.variable(symbol);
        };
        let mut arguments = Vec::new();
        while rest.next_if(|c| "(,".contains(*c)).is_some() {
            arguments.push(self.sum(rest));
        }
        assert_eq!(rest.next(), Some(')'));
        self.graph.call(function, &arguments)
    }
}

fn word(rest: &mut Peekable<Chars>) -> String {
    std::iter::from_fn(|| rest.next_if(|c| c.is_alphanumeric())).collect()
}
