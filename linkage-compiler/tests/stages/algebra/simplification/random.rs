//! Random expressions against their simplified forms, by interval-like evaluation with a bound of the rounding error:
//! both have the same value; if only the simplified form has a value, a recorded condition fails.

use std::collections::{BTreeMap, BTreeSet};

use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_compiler::algebra::simplify;
use linkage_compiler::graph::{Condition, Function, Graph, Node, NodeId, Number, SymbolId, operation};
use linkage_equality::{Answer, compare};

const CASES: usize = 1500;
const SYMBOLS: usize = 4;

/// An expression as written.
#[derive(Debug, Clone)]
enum Tree {
    Integer(i64),
    Symbol(usize),
    Sum(Box<Self>, Box<Self>),
    Difference(Box<Self>, Box<Self>),
    Product(Box<Self>, Box<Self>),
    Quotient(Box<Self>, Box<Self>),
    Power(Box<Self>, i32),
    Call(Function, Vec<Self>),
}

/// A value with a bound for its rounding error.
#[derive(Debug, Clone, Copy)]
struct Value {
    value: f64,
    error: f64,
}

impl Value {
    fn exact(value: f64) -> Self {
        Self { value, error: value.abs() * f64::EPSILON }
    }

    fn rounded(value: f64, error: f64) -> Self {
        Self { value, error: error + value.abs() * f64::EPSILON }
    }

    fn plus(self, other: Self) -> Self {
        Self::rounded(self.value + other.value, self.error + other.error)
    }

    fn times(self, other: Self) -> Self {
        let error = self.value.abs() * other.error + other.value.abs() * self.error + self.error * other.error;
        Self::rounded(self.value * other.value, error)
    }

    fn inverse(self) -> Self {
        let value = self.value.recip();
        // A divisor that may be zero within its error.
        let error = if self.value.abs() <= 4.0 * self.error { f64::INFINITY } else { 2.0 * self.error * value * value };
        Self::rounded(value, error)
    }

    fn power(self, exponent: i32) -> Self {
        let power = (0..exponent.unsigned_abs()).fold(Self::exact(1.0), |power, _| power.times(self));
        if exponent < 0 { power.inverse() } else { power }
    }

    /// A function; its error is from the values at both ends of the interval and from its rounding error.
    fn call(function: Function, arguments: &[Self]) -> Self {
        let at =
            |shift: fn(&Self) -> f64| (operation(function).value)(&arguments.iter().map(shift).collect::<Vec<_>>());
        let value = at(|x| x.value);
        let spread = [at(|x| x.value - x.error), at(|x| x.value + x.error)].map(|end| (end - value).abs());
        // A function at the edge of its domain counts as undefined.
        let spread =
            if spread.iter().any(|spread| spread.is_nan()) && value.is_finite() { [f64::INFINITY; 2] } else { spread };
        Self::rounded(value, 4.0 * (spread[0].max(spread[1]) + arguments.iter().map(|x| x.error).sum::<f64>()))
    }

    fn exists(self) -> bool {
        self.value.is_finite()
    }

    /// True if the error is small enough for a comparison.
    fn is_sure(self) -> bool {
        self.error.is_finite() && self.error <= 1e-6 * self.value.abs().max(1e-3)
    }
}

impl Tree {
    fn random(random: &mut SmallRng, depth: usize) -> Self {
        if depth == 0 || random.random_range(0..8) == 0 {
            return if random.random_range(0..4) == 0 {
                Self::Integer(random.random_range(-3..=3))
            } else {
                Self::Symbol(random.random_range(0..SYMBOLS))
            };
        }
        let mut part = || Box::new(Self::random(random, depth - 1));
        let (left, right) = (part(), part());
        match random.random_range(0..13) {
            0 | 1 => Self::Sum(left, right),
            2 | 3 => Self::Difference(left, right),
            4..=6 => Self::Product(left, right),
            7 => Self::Quotient(left, right),
            8 => Self::Power(left, [2, 3, 0, -1, -2][random.random_range(0..5)]),
            // Products that the trigonometric identities match.
            9 => {
                let circular = |function, tree: &Self| Self::Call(function, vec![tree.clone()]);
                let (sin_a, cos_a) = (circular(Function::Sin, &left), circular(Function::Cos, &left));
                let (sin_b, cos_b) = (circular(Function::Sin, &right), circular(Function::Cos, &right));
                let (first, second) =
                    (Self::Product(Box::new(sin_a), Box::new(cos_b)), Self::Product(Box::new(cos_a), Box::new(sin_b)));
                if random.random_range(0..2) == 0 {
                    Self::Sum(Box::new(first), Box::new(second))
                } else {
                    Self::Difference(Box::new(first), Box::new(second))
                }
            }
            10 => Self::Call(Function::Hypot, vec![*left, *right]),
            11 => Self::Call([Function::Sin, Function::Cos][random.random_range(0..2)], vec![*left]),
            _ => {
                let others =
                    [Function::Tan, Function::Sqrt, Function::Ln, Function::Abs, Function::Atan, Function::Exp];
                Self::Call(others[random.random_range(0..others.len())], vec![*left])
            }
        }
    }

    fn value(&self, at: &[f64; SYMBOLS]) -> Value {
        match self {
            Self::Integer(value) => Value { value: f64::from(i32::try_from(*value).unwrap()), error: 0.0 },
            Self::Symbol(index) => Value { value: at[*index], error: 0.0 },
            Self::Sum(a, b) => a.value(at).plus(b.value(at)),
            Self::Difference(a, b) => {
                let b = b.value(at);
                a.value(at).plus(Value { value: -b.value, ..b })
            }
            Self::Product(a, b) => a.value(at).times(b.value(at)),
            Self::Quotient(a, b) => a.value(at).times(b.value(at).inverse()),
            Self::Power(a, n) => {
                let base = a.value(at);
                // 1 = x^0 needs an x.
                if base.exists() { base.power(*n) } else { base }
            }
            Self::Call(function, arguments) => {
                let arguments: Vec<Value> = arguments.iter().map(|argument| argument.value(at)).collect();
                if let Some(missing) = arguments.iter().find(|argument| !argument.exists()) {
                    return Value { value: f64::NAN, ..*missing };
                }
                Value::call(*function, &arguments)
            }
        }
    }

    fn node(&self, graph: &mut Graph, symbols: &[SymbolId]) -> NodeId {
        match self {
            Self::Integer(value) => graph.number(Number::integer(*value)),
            Self::Symbol(index) => graph.variable(symbols[*index]),
            Self::Sum(a, b) | Self::Difference(a, b) | Self::Product(a, b) | Self::Quotient(a, b) => {
                let (a, b) = (a.node(graph, symbols), b.node(graph, symbols));
                match self {
                    Self::Sum(..) => graph.add(a, b),
                    Self::Difference(..) => graph.subtract(a, b),
                    Self::Product(..) => graph.multiply(a, b),
                    _ => graph.divide(a, b),
                }
            }
            Self::Power(a, n) => {
                let base = a.node(graph, symbols);
                graph.power(base, *n)
            }
            Self::Call(function, arguments) => {
                let arguments: Vec<NodeId> = arguments.iter().map(|argument| argument.node(graph, symbols)).collect();
                graph.call(*function, &arguments)
            }
        }
    }
}

/// The value of a node with its rounding error.
fn value_of(graph: &Graph, root: NodeId, at: &[f64; SYMBOLS], symbols: &[SymbolId]) -> Value {
    let mut values: BTreeMap<NodeId, Value> = BTreeMap::new();
    for id in graph.reachable(&[root]) {
        let value: Value = match graph.node(id) {
            Node::Constant(number) => Value::exact(number.to_f64()),
            Node::Pi => Value::exact(std::f64::consts::PI),
            Node::Symbol(symbol) => {
                let index = symbols.iter().position(|other| other == symbol).unwrap();
                Value { value: at[index], error: 0.0 }
            }
            Node::Sum { constant, terms } => {
                let term = |&(factor, term): &(Number, NodeId)| Value::exact(factor.to_f64()).times(values[&term]);
                terms.iter().map(term).fold(Value::exact(constant.to_f64()), Value::plus)
            }
            Node::Product { coefficient, factors } => {
                let power = |&(base, n): &(NodeId, i32)| values[&base].power(n);
                factors.iter().map(power).fold(Value::exact(coefficient.to_f64()), Value::times)
            }
            Node::Call(function, arguments) => {
                let arguments: Vec<Value> = arguments.iter().map(|argument| values[argument]).collect();
                Value::call(*function, &arguments)
            }
            Node::External(..) => unreachable!("no expression here has a user function"),
        };
        values.insert(id, value);
    }
    values[&root]
}

/// True if one of the conditions fails at a point.
fn fails(graph: &Graph, conditions: &BTreeSet<Condition>, at: &[f64; SYMBOLS], symbols: &[SymbolId]) -> bool {
    conditions.iter().any(|condition| match *condition {
        Condition::NonZero(id) => {
            let value = value_of(graph, id, at, symbols);
            !value.exists() || value.value.abs() <= 4.0 * value.error
        }
        Condition::Defined(id) => {
            let value = value_of(graph, id, at, symbols);
            !value.exists() || !value.is_sure()
        }
    })
}

#[test]
fn simplest_forms_mean_what_was_written() {
    let mut random = SmallRng::seed_from_u64(20_261_121);
    let (mut compared, mut undefined, mut shorter, mut proved) = (0, 0, 0, 0);
    for case in 0..CASES {
        let tree = Tree::random(&mut random, 4);
        let mut graph = Graph::default();
        let symbols: Vec<SymbolId> = ["x", "y", "a", "b"].map(|name| graph.symbol(name)).to_vec();
        let written = tree.node(&mut graph, &symbols);
        if graph.take_fault().is_some() {
            continue;
        }
        let given: BTreeSet<NodeId> = if case % 2 == 0 {
            BTreeSet::new()
        } else {
            symbols.iter().map(|&symbol| graph.variable(symbol)).collect()
        };
        let simplest = simplify(&mut graph, &[written], &given)[0];
        if graph.take_fault().is_some() {
            continue;
        }
        let conditions = graph.take_conditions();
        shorter += usize::from(simplest != written);
        match compare(&graph, written, simplest) {
            Answer::Equal => proved += usize::from(simplest != written),
            Answer::Different => panic!("{} became {}", graph.text(written), graph.text(simplest)),
            Answer::Undecided(_) => {}
        }
        for _ in 0..8 {
            // Small integers often cause zero divisors.
            let at: [f64; SYMBOLS] = std::array::from_fn(|_| {
                if random.random_range(0..2) == 0 {
                    f64::from(random.random_range(-2..=2))
                } else {
                    random.random_range(-2.0..2.0)
                }
            });
            let expected = tree.value(&at);
            let found = value_of(&graph, simplest, &at, &symbols);
            match (expected.exists(), found.exists()) {
                (true, true) => {
                    if expected.is_sure() && found.is_sure() {
                        compared += 1;
                        let error = (expected.value - found.value).abs();
                        let bound = 4.0 * (expected.error + found.error);
                        assert!(error <= bound, "{tree:?} at {at:?}: {expected:?}, {} {found:?}", graph.text(simplest));
                    }
                }
                (false, true) => {
                    undefined += 1;
                    assert!(
                        fails(&graph, &conditions, &at, &symbols) || !found.is_sure(),
                        "{tree:?} has no value at {at:?}, {} has, and nothing is on record: {conditions:?}",
                        graph.text(simplest)
                    );
                }
                (true, false) => {
                    assert!(!expected.is_sure(), "{tree:?} is {expected:?} at {at:?}, {} is not", graph.text(simplest));
                }
                (false, false) => {}
            }
        }
    }
    println!(
        "{compared} values compared, {undefined} of forms that had none; {shorter} rewritten, {proved} of them proved"
    );
    assert!(compared > 2 * CASES && undefined > 50 && shorter > CASES / 10 && proved > shorter / 3);
}
