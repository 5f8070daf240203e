//! Rational identities.
//!
//! - common factors: a b + a c = a (b + c), of all terms or of those with the same product of given symbols
//! - products of sums: (a + b) (c + d) = a c + a d + b c + b d
//! - quotients of sums: (a c + b c) / (a + b) = c, if a + b is not zero
//!
//! The graph itself collects like terms and equal factors.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{Condition, Graph, Node, NodeId, Number};

/// A product of base^exponent, by base; no exponent is zero.
pub(super) type Monomial = BTreeMap<NodeId, i32>;

/// A sum of coefficient * monomial.
pub(super) type Polynomial = Vec<(Number, Monomial)>;

/// The largest number of terms of an expanded product.
pub(super) const MOST_TERMS: usize = 64;

/// Factors out the common factors of a sum; returns any other node unchanged.
pub fn factor(graph: &mut Graph, id: NodeId) -> NodeId {
    let Node::Sum { constant, .. } = graph.node(id) else { return id };
    if !constant.is_zero() {
        return id;
    }
    let polynomial = terms(graph, id);
    let mut common: Option<Monomial> = None;
    for (_, monomial) in &polynomial {
        common = Some(match common {
            None => monomial.clone(),
            // Only powers of one sign are common: x + 1/x has no common factor.
            Some(common) => common
                .into_iter()
                .filter_map(|(base, n)| {
                    let m = *monomial.get(&base)?;
                    (n.signum() == m.signum()).then(|| (base, if n > 0 { n.min(m) } else { n.max(m) }))
                })
                .collect(),
        });
    }
    let common = common.unwrap_or_default();
    if common.is_empty() {
        return id;
    }
    let inverse: Monomial = common.iter().map(|(&base, n)| (base, -n)).collect();
    let rest: Polynomial =
        polynomial.into_iter().map(|(coefficient, monomial)| (coefficient, times(monomial, &inverse))).collect();
    let rest = collect(graph, &rest);
    let mut product: Vec<(NodeId, i32)> = common.into_iter().collect();
    product.push((rest, 1));
    graph.product(&product)
}

/// Groups the terms of a sum by their product of `symbols` and factors that out; returns any other node unchanged.
pub fn gather(graph: &mut Graph, id: NodeId, symbols: &BTreeSet<NodeId>) -> NodeId {
    if !matches!(graph.node(id), Node::Sum { .. }) {
        return id;
    }
    let mut groups: BTreeMap<Monomial, Polynomial> = BTreeMap::new();
    for (coefficient, monomial) in terms(graph, id) {
        let product = monomial.iter().filter(|(base, _)| symbols.contains(base)).map(|(&base, &n)| (base, n)).collect();
        groups.entry(product).or_default().push((coefficient, monomial));
    }
    if groups.iter().all(|(product, terms)| product.is_empty() || terms.len() == 1) {
        return id;
    }
    let mut gathered = Vec::new();
    for (product, mut terms) in groups {
        if product.is_empty() || terms.len() == 1 {
            gathered.push((Number::ONE, collect(graph, &terms)));
            continue;
        }
        for (_, monomial) in &mut terms {
            monomial.retain(|base, _| !product.contains_key(base));
        }
        let mut factors: Vec<(NodeId, i32)> = product.into_iter().collect();
        factors.push((collect(graph, &terms), 1));
        gathered.push((Number::ONE, graph.product(&factors)));
    }
    graph.sum(&gathered)
}

/// The terms of a node, without expansion.
pub(super) fn terms(graph: &Graph, id: NodeId) -> Polynomial {
    match graph.node(id) {
        Node::Sum { constant, terms } => {
            let mut polynomial: Polynomial =
                terms.iter().map(|&(coefficient, term)| (coefficient, monomial(graph, term))).collect();
            if !constant.is_zero() {
                polynomial.push((*constant, Monomial::new()));
            }
            polynomial
        }
        Node::Constant(value) if value.is_zero() => Vec::new(),
        Node::Constant(value) => vec![(*value, Monomial::new())],
        Node::Product { coefficient, factors } => vec![(*coefficient, factors.iter().copied().collect())],
        _ => vec![(Number::ONE, Monomial::from([(id, 1)]))],
    }
}

/// The factors of a term without coefficient.
fn monomial(graph: &Graph, term: NodeId) -> Monomial {
    match graph.node(term) {
        Node::Product { factors, .. } => factors.iter().copied().collect(),
        _ => Monomial::from([(term, 1)]),
    }
}

/// The terms of a node with all products of sums expanded; `None` if there are too many.
pub(super) fn expanded(graph: &mut Graph, id: NodeId) -> Option<Polynomial> {
    let mut all = Polynomial::new();
    for (coefficient, monomial) in terms(graph, id) {
        let mut product: Polynomial = vec![(coefficient, Monomial::new())];
        for (base, exponent) in monomial {
            let is_sum = matches!(graph.node(base), Node::Sum { .. });
            let repeat = if is_sum && exponent > 0 { exponent } else { 1 };
            let factor = if is_sum && exponent > 0 {
                terms(graph, base)
            } else {
                vec![(Number::ONE, Monomial::from([(base, exponent)]))]
            };
            for _ in 0..repeat {
                product = multiply(graph, &product, &factor)?;
            }
        }
        all.extend(product);
        if all.len() > MOST_TERMS {
            return None;
        }
    }
    Some(all)
}

/// The product of two polynomials; `None` if it has too many terms. Assumes that cancelled factors are not zero.
pub(super) fn multiply(graph: &mut Graph, left: &Polynomial, right: &Polynomial) -> Option<Polynomial> {
    let count = left.len() * right.len();
    if count > MOST_TERMS {
        return None;
    }
    graph.budget().spend(count).ok()?;
    for (_, x) in left {
        for (_, y) in right {
            let opposed = x.iter().filter(|(base, n)| y.get(base).is_some_and(|m| m.signum() == -n.signum()));
            graph.assume(opposed.map(|(&base, _)| Condition::NonZero(base)).collect());
        }
    }
    let term = |(k, x): &(Number, Monomial), (m, y): &(Number, Monomial)| (k.multiply(*m), times(x.clone(), y));
    Some(left.iter().flat_map(|a| right.iter().map(move |b| term(a, b))).collect())
}

fn times(mut left: Monomial, right: &Monomial) -> Monomial {
    for (&base, &exponent) in right {
        let total = left.entry(base).or_insert(0);
        // On overflow the graph has recorded a fault.
        *total = total.saturating_add(exponent);
    }
    left.retain(|_, exponent| *exponent != 0);
    left
}

pub(super) fn collect(graph: &mut Graph, polynomial: &Polynomial) -> NodeId {
    let mut sum = Vec::new();
    for (coefficient, monomial) in polynomial {
        let factors: Vec<_> = monomial.iter().map(|(&base, &exponent)| (base, exponent)).collect();
        sum.push((*coefficient, graph.product(&factors)));
    }
    graph.sum(&sum)
}

/// The quotient of two sums if the remainder is zero, by polynomial division. The caller must assume that the divisor
/// is not zero.
pub(super) fn quotient(graph: &mut Graph, dividend: NodeId, divisor: NodeId) -> Option<NodeId> {
    let by = terms(graph, divisor);
    let (lead, lead_monomial) = by.iter().max_by(|a, b| order(&a.1, &b.1))?.clone();
    if !lead.is_finite() || lead.is_zero() {
        return None;
    }
    let mut rest: BTreeMap<Vec<(NodeId, i32)>, Number> = BTreeMap::new();
    let dividend = expanded(graph, dividend)?;
    add(&mut rest, &dividend, Number::ONE, &Monomial::new());
    let mut quotient = Polynomial::new();
    while !rest.is_empty() && graph.budget().spend(by.len() + rest.len()).is_ok() {
        let (top, coefficient) = rest.iter().max_by(|a, b| order_of(a.0, b.0)).map(|(m, k)| (m.clone(), *k))?;
        let mut monomial: Monomial = top.into_iter().collect();
        for (base, exponent) in &lead_monomial {
            let left = monomial.get(base).copied().unwrap_or(0) - exponent;
            // The leading term does not divide: there is a remainder.
            if left < 0 || *exponent < 0 {
                return None;
            }
            monomial.insert(*base, left);
        }
        monomial.retain(|_, exponent| *exponent != 0);
        let factor = coefficient.multiply(lead.power(-1));
        add(&mut rest, &by, factor.negate(), &monomial);
        quotient.push((factor, monomial));
        if quotient.len() > MOST_TERMS {
            return None;
        }
    }
    Some(collect(graph, &quotient))
}

fn add(sum: &mut BTreeMap<Vec<(NodeId, i32)>, Number>, terms: &Polynomial, factor: Number, by: &Monomial) {
    for (coefficient, monomial) in terms {
        let key: Vec<_> = times(monomial.clone(), by).into_iter().collect();
        let entry = sum.entry(key).or_insert(Number::ZERO);
        *entry = entry.plus(coefficient.multiply(factor));
    }
    sum.retain(|_, coefficient| !coefficient.is_zero());
}

/// The lexicographic monomial order, by exponents of the oldest base first.
fn order(a: &Monomial, b: &Monomial) -> std::cmp::Ordering {
    let (a, b): (Vec<_>, Vec<_>) =
        (a.iter().map(|(&x, &n)| (x, n)).collect(), b.iter().map(|(&x, &n)| (x, n)).collect());
    order_of(&a, &b)
}

fn order_of(a: &[(NodeId, i32)], b: &[(NodeId, i32)]) -> std::cmp::Ordering {
    let (mut left, mut right) = (a.iter().peekable(), b.iter().peekable());
    loop {
        let (exponents, step) = match (left.peek(), right.peek()) {
            (None, None) => return std::cmp::Ordering::Equal,
            (Some(x), Some(y)) if x.0 == y.0 => ((x.1, y.1), (true, true)),
            (Some(x), Some(y)) if x.0 < y.0 => ((x.1, 0), (true, false)),
            (Some(x), None) => ((x.1, 0), (true, false)),
            (_, Some(y)) => ((0, y.1), (false, true)),
        };
        if exponents.0 != exponents.1 {
            return exponents.0.cmp(&exponents.1);
        }
        if step.0 {
            left.next();
        }
        if step.1 {
            right.next();
        }
    }
}
