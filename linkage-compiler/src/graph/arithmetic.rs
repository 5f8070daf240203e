//! Normal form of sums and products: like terms collected, constants folded, signs inside sums.

use super::arena::Graph;
use super::node::{Condition, Fault, LARGEST_EXPONENT, Node, NodeId};
use super::{Function, Number};

/// Sums of more terms than this are not flattened into other sums. Otherwise n sums that each add to the previous one
/// would have O(n^2) terms.
const LONGEST_MERGED: usize = 64;

/// The largest number of factors of a product; longer ones are products of products. The derivative of n factors has n
/// terms of n factors each.
const LONGEST_PRODUCT: usize = 16;

impl Graph {
    pub fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.sum(&[(Number::ONE, a), (Number::ONE, b)])
    }

    pub fn subtract(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.sum(&[(Number::ONE, a), (Number::MINUS_ONE, b)])
    }

    pub fn negate(&mut self, a: NodeId) -> NodeId {
        self.scale(Number::MINUS_ONE, a)
    }

    pub fn scale(&mut self, factor: Number, a: NodeId) -> NodeId {
        if factor.is_one() {
            return a;
        }
        let factor = self.number(factor);
        self.multiply(factor, a)
    }

    pub fn multiply(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.product(&[(a, 1), (b, 1)])
    }

    pub fn divide(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.product(&[(a, 1), (b, -1)])
    }

    pub fn power(&mut self, base: NodeId, exponent: i32) -> NodeId {
        self.product(&[(base, exponent)])
    }

    /// The terms of a sum, of which the last is its constant.
    pub fn terms(&mut self, sum: NodeId) -> Vec<(Number, NodeId)> {
        match self.node(sum).clone() {
            Node::Sum { constant, terms } if constant.is_zero() => terms,
            Node::Sum { constant, mut terms } => {
                terms.push((constant, self.one()));
                terms
            }
            _ => vec![(Number::ONE, sum)],
        }
    }

    /// The sum of coefficient * item, like terms collected.
    pub fn sum(&mut self, items: &[(Number, NodeId)]) -> NodeId {
        if let Some(any) = self.unaffordable(items.len()) {
            return any;
        }
        let mut constant = Number::ZERO;
        let mut terms: Vec<(NodeId, Number)> = Vec::new();
        let mut collect = |coefficient: Number, term: NodeId| {
            let entry = entry(&mut terms, term, Number::ZERO);
            *entry = entry.plus(coefficient);
        };
        for &(coefficient, item) in items {
            match self.node(item) {
                Node::Constant(value) => constant = constant.plus(coefficient.multiply(*value)),
                Node::Sum { constant: inner, terms } if terms.len() <= LONGEST_MERGED => {
                    constant = constant.plus(coefficient.multiply(*inner));
                    for (factor, term) in terms {
                        collect(coefficient.multiply(*factor), *term);
                    }
                }
                Node::Product { coefficient: inner, factors } if !inner.is_one() => {
                    let total = coefficient.multiply(*inner);
                    let monic = self.monic(factors.clone());
                    // 2 * (a + b) is a product with a coefficient whose monic part is a sum.
                    match self.node(monic) {
                        Node::Sum { constant: k, terms } if terms.len() <= LONGEST_MERGED => {
                            constant = constant.plus(total.multiply(*k));
                            for (factor, term) in terms {
                                collect(total.multiply(*factor), *term);
                            }
                        }
                        _ => collect(total, monic),
                    }
                }
                _ => collect(coefficient, item),
            }
        }
        let collected = terms;
        self.budget.count(collected.len());
        let mut terms = Vec::new();
        for &(term, coefficient) in &collected {
            if coefficient.is_zero() {
                self.drop_term(term);
            } else {
                terms.push((coefficient, term));
            }
        }
        match terms.as_slice() {
            [] => self.number(constant),
            &[(coefficient, term)] if constant.is_zero() => self.scale(coefficient, term),
            _ => self.intern(Node::Sum { constant, terms }),
        }
    }

    /// Groups factors into products of at most [`LONGEST_PRODUCT`]; the same factors give the same tree.
    fn grouped(&mut self, mut factors: Vec<(NodeId, i32)>) -> Vec<(NodeId, i32)> {
        while factors.len() > LONGEST_PRODUCT {
            let mut groups: Vec<(NodeId, i32)> =
                factors.chunks(LONGEST_PRODUCT).map(|group| (self.monic(group.to_vec()), 1)).collect();
            groups.sort_unstable();
            factors = groups;
        }
        factors
    }

    /// |x|^2 = x^2, and x^2 / |x| = |x|: factors with fewer magnitudes, if there are any.
    fn without_magnitudes(&self, factors: &[(NodeId, i32)]) -> Option<Vec<(NodeId, i32)>> {
        factors.iter().enumerate().find_map(|(index, &(modulus, exponent))| {
            let &Node::Call(Function::Abs, ref arguments) = self.node(modulus) else { return None };
            let &[x] = arguments.as_slice() else { return None };
            let square = factors.iter().position(|&(base, power)| base == x && power >= 2);
            let mut items = factors.to_vec();
            match square {
                _ if exponent.unsigned_abs() >= 2 => {
                    items[index].1 = exponent % 2;
                    items.push((x, exponent - exponent % 2));
                }
                Some(square) if exponent == -1 => {
                    items[index].1 = 1;
                    items[square].1 -= 2;
                }
                _ => return None,
            }
            Some(items)
        })
    }

    fn monic(&mut self, factors: Vec<(NodeId, i32)>) -> NodeId {
        match factors.as_slice() {
            [] => self.one(),
            &[(base, 1)] => base,
            _ => self.intern(Node::Product { coefficient: Number::ONE, factors }),
        }
    }

    /// The product of item^exponent, equal bases collected.
    pub fn product(&mut self, items: &[(NodeId, i32)]) -> NodeId {
        if let Some(any) = self.unaffordable(items.len()) {
            return any;
        }
        let mut coefficient = Number::ONE;
        let mut factors: Vec<(NodeId, i32)> = Vec::new();
        let mut overflow = false;
        let mut divisors: Vec<NodeId> = Vec::new();
        let mut collect = |base: NodeId, exponent: Option<i32>| {
            let entry = entry(&mut factors, base, 0);
            let total = exponent.and_then(|exponent| entry.checked_add(exponent));
            match total.filter(|total| total.unsigned_abs() <= LARGEST_EXPONENT.unsigned_abs()) {
                Some(total) => *entry = total,
                None => overflow = true,
            }
        };
        for &(item, exponent) in items {
            match self.node(item) {
                Node::Constant(value) => {
                    let value = *value;
                    if value.is_zero() && exponent <= 0 {
                        let fault = if exponent == 0 { Fault::ZeroToZero } else { Fault::DivisionByZero };
                        self.fault.get_or_insert(fault);
                    }
                    coefficient = coefficient.multiply(value.power(exponent));
                }
                Node::Product { coefficient: inner, factors } => {
                    coefficient = coefficient.multiply(inner.power(exponent));
                    for &(base, inner) in factors {
                        collect(base, inner.checked_mul(exponent));
                        // 1/(1/x) = x assumes x != 0.
                        if inner < 0 || exponent < 0 {
                            divisors.push(base);
                        }
                    }
                }
                _ => {
                    collect(item, Some(exponent));
                    if exponent < 0 {
                        divisors.push(item);
                    }
                }
            }
        }
        if overflow {
            self.fault.get_or_insert(Fault::ExponentOverflow);
        }
        for divisor in divisors {
            let cancelled = *entry(&mut factors, divisor, 0) >= 0 || coefficient.is_zero();
            if cancelled && self.values[divisor.index()].is_none() {
                self.conditions.insert(Condition::NonZero(divisor));
            }
        }
        for &(base, exponent) in &factors {
            if exponent == 0 || coefficient.is_zero() {
                self.drop_term(base);
            }
        }
        factors.retain(|(_, exponent)| *exponent != 0);
        if let Some(items) = self.without_magnitudes(&factors) {
            let rest = self.product(&items);
            return self.scale(coefficient, rest);
        }
        let factors = self.grouped(factors);
        if coefficient.is_zero() || factors.is_empty() {
            return self.number(coefficient);
        }
        if coefficient.is_one() {
            return self.monic(factors);
        }
        // Signs are moved into sums, so that -(a - b) and b - a are one node.
        if let (true, &[(base, 1)]) = (coefficient == Number::MINUS_ONE, factors.as_slice())
            && let Node::Sum { constant, terms } = self.node(base).clone()
        {
            let terms = terms.into_iter().map(|(factor, term)| (factor.negate(), term)).collect();
            return self.intern(Node::Sum { constant: constant.negate(), terms });
        }
        self.intern(Node::Product { coefficient, factors })
    }
}

/// The entry of a key in a sorted list; inserts it if it is missing.
fn entry<V>(list: &mut Vec<(NodeId, V)>, key: NodeId, empty: V) -> &mut V {
    let index = list.binary_search_by_key(&key, |(key, _)| *key).unwrap_or_else(|index| {
        list.insert(index, (key, empty));
        index
    });
    &mut list[index].1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Squares of magnitudes are smooth, and their derivatives have no quotient.
    #[test]
    fn squares_of_magnitudes() {
        let mut g = Graph::default();
        let symbols = [g.symbol("x"), g.symbol("y")];
        let [x, y] = symbols.map(|symbol| g.variable(symbol));
        let (zero, modulus) = (g.zero(), g.call(Function::Abs, &[x]));
        assert_eq!(g.call(Function::Hypot, &[zero, x]), modulus);
        let [square, fifth, inverse] = [2, 5, -3].map(|exponent| g.power(modulus, exponent));
        assert_eq!(square, g.power(x, 2));
        assert_eq!(fifth, g.product(&[(x, 4), (modulus, 1)]));
        assert_eq!(inverse, g.product(&[(x, -2), (modulus, -1)]));
        assert_eq!(g.product(&[(x, 3), (modulus, -1)]), g.multiply(x, modulus));
        let negative = g.scale(Number::integer(-2), x);
        let twice = g.call(Function::Abs, &[negative]);
        let (square, expected) = (g.power(twice, 2), g.power(x, 2));
        assert_eq!(square, g.scale(Number::integer(4), expected));
        // d (x^2 + y^2) = 2 x dx, and d r^3 = 3 r x dx.
        let r = g.call(Function::Hypot, &[x, y]);
        let powers = [g.power(r, 2), g.power(r, 3)];
        let [of_square, of_cube] = g.partial(&powers, symbols[0])[..] else { unreachable!() };
        assert_eq!(of_square, g.scale(Number::integer(2), x));
        let expected = g.multiply(r, x);
        assert_eq!(of_cube, g.scale(Number::integer(3), expected));
    }
}
