//! Inlining after sharing: a sum used once within a sum, a product used once within a product, and an inverse used once
//! in a product, which becomes a quotient.

use linkage_ir::ValueId;

use super::value::{Leaf, Signed, Value, is_circular};

/// Inlines operands used once into the sums and products that the roots depend on. A kernel that is inlined into other
/// functions keeps its inverses and the components of its links, since these may use the same ones.
pub(super) fn join(values: &mut Vec<Value>, roots: &[Signed], is_inlined: bool) {
    let (mut uses, mut stack) = (vec![0; values.len()], Vec::new());
    let mut reached = Vec::new();
    stack.extend(roots.iter().map(|root| root.value));
    while let Some(id) = stack.pop() {
        uses[id.index()] += 1;
        if uses[id.index()] == 1 {
            reached.push(id);
            values[id.index()].each_part(|part| stack.push(part));
        }
    }
    for id in reached {
        let once = |value: ValueId| uses.get(value.index()) == Some(&1);
        match &values[id.index()] {
            Value::Sum(terms) => {
                let mut joined = Vec::new();
                let mut stack: Vec<Signed> = terms.iter().rev().copied().collect();
                while let Some(term) = stack.pop() {
                    match &values[term.value.index()] {
                        Value::Sum(inner) if once(term.value) => {
                            let signed = |part: &Signed| Signed { negative: part.negative != term.negative, ..*part };
                            stack.extend(inner.iter().rev().map(signed));
                        }
                        _ => joined.push(term),
                    }
                }
                joined.sort_by_key(|term| term.negative);
                values[id.index()] = Value::Sum(joined);
            }
            Value::Product(factors) => {
                let (mut joined, mut divisor) = (Vec::new(), None);
                let mut stack: Vec<ValueId> = factors.iter().rev().copied().collect();
                while let Some(factor) = stack.pop() {
                    match &values[factor.index()] {
                        // Products with a number stay apart, so that a product has at most one number.
                        Value::Product(inner)
                            if once(factor)
                                && !inner.iter().any(|&part| is_number(values, part))
                                && !(is_inlined && is_component(values, inner)) =>
                        {
                            stack.extend(inner.iter().rev());
                        }
                        Value::Quotient(one, below)
                            if once(factor) && !is_inlined && divisor.is_none() && is_one(values, *one) =>
                        {
                            divisor = Some(*below);
                        }
                        _ => joined.push(factor),
                    }
                }
                values[id.index()] = match (divisor, joined.as_slice()) {
                    (None, _) => Value::Product(joined),
                    (Some(below), &[above]) => Value::Quotient(above, below),
                    (Some(below), _) => {
                        values.push(Value::Product(joined));
                        Value::Quotient(ValueId::new(values.len() - 1), below)
                    }
                };
            }
            _ => {}
        }
    }
}

/// True for the product of a symbol, such as a length, and a sine or cosine.
fn is_component(values: &[Value], factors: &[ValueId]) -> bool {
    let &[one, other] = factors else { return false };
    let is = |symbol: ValueId, circular: ValueId| {
        matches!(values[symbol.index()], Value::Given(Leaf::Symbol(_)))
            && is_circular(&values[circular.index()], values)
    };
    is(one, other) || is(other, one)
}

fn is_number(values: &[Value], id: ValueId) -> bool {
    matches!(values[id.index()], Value::Constant(_))
}

fn is_one(values: &[Value], id: ValueId) -> bool {
    matches!(values[id.index()], Value::Constant(number) if number.is_one())
}
