//! The same graph in 160 bits: 48 digits, with the trigonometry of dashu.

use std::cell::RefCell;
use std::collections::{HashMap, VecDeque};

use dashu_float::FBig;
use dashu_float::ops::Abs;
use dashu_float::round::mode::HalfEven;
use linkage_compiler::graph::{External, Function, Graph, Node, NodeId, Number, SymbolId};

pub type Big = FBig<HalfEven, 2>;

/// Bits of every operation.
pub const PRECISION: usize = 160;

/// A double, exactly.
pub fn big(value: f64) -> Big {
    Big::try_from(value).expect("a finite number").with_precision(PRECISION).value()
}

pub fn pi() -> Big {
    big(0.0).atan2(&big(-1.0))
}

thread_local! {
    static LAST: RefCell<VecDeque<(Big, (Big, Big))>> = const { RefCell::new(VecDeque::new()) };
}

/// Sine and cosine, which take nearly all of the time, of one angle once.
fn sine_cosine(x: &Big) -> (Big, Big) {
    LAST.with_borrow_mut(|last| {
        if let Some((_, value)) = last.iter().find(|(angle, _)| angle == x) {
            return value.clone();
        }
        let value = x.sin_cos();
        last.push_front((x.clone(), value.clone()));
        last.truncate(64);
        value
    })
}

/// What a tape is evaluated in.
pub trait Scalar: Clone {
    fn number(value: Number) -> Self;
    fn of(value: f64) -> Self;
    fn pi() -> Self;
    fn add(&self, other: &Self) -> Self;
    fn multiply(&self, other: &Self) -> Self;
    fn power(&self, exponent: i32) -> Self;
    fn call(function: Function, arguments: &[Self]) -> Self;
    fn double(&self) -> f64;
}

impl Scalar for f64 {
    fn number(value: Number) -> Self {
        value.to_f64()
    }
    fn of(value: f64) -> Self {
        value
    }
    fn pi() -> Self {
        std::f64::consts::PI
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn multiply(&self, other: &Self) -> Self {
        self * other
    }
    fn power(&self, exponent: i32) -> Self {
        self.powi(exponent)
    }
    fn call(function: Function, arguments: &[Self]) -> Self {
        (function.operation().value)(arguments)
    }
    fn double(&self) -> f64 {
        *self
    }
}

impl Scalar for Big {
    fn number(value: Number) -> Self {
        let integer = |value: i64| Self::from(value).with_precision(PRECISION).value();
        match value {
            Number::Ratio(numerator, 1) => integer(numerator),
            Number::Ratio(numerator, denominator) => integer(numerator) / integer(denominator),
            Number::Float(value) => big(value),
        }
    }
    fn of(value: f64) -> Self {
        big(value)
    }
    fn pi() -> Self {
        pi()
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn multiply(&self, other: &Self) -> Self {
        self * other
    }
    fn power(&self, exponent: i32) -> Self {
        let power = (1..exponent.abs()).fold(self.clone(), |power, _| &power * self);
        if exponent < 0 { big(1.0) / power } else { power }
    }
    fn call(function: Function, arguments: &[Self]) -> Self {
        let x = &arguments[0];
        match function {
            Function::Sin => sine_cosine(x).0,
            Function::Cos => sine_cosine(x).1,
            Function::Tan => x.tan(),
            Function::Asin => x.asin(),
            Function::Acos => x.acos(),
            Function::Atan => x.atan(),
            Function::Atan2 => x.atan2(&arguments[1]),
            Function::Sqrt => x.sqrt(),
            Function::Abs => x.clone().abs(),
            Function::Exp => x.exp(),
            Function::Ln => x.ln(),
            Function::Hypot => (x * x + &arguments[1] * &arguments[1]).sqrt(),
        }
    }
    fn double(&self) -> f64 {
        self.to_f64().value()
    }
}

/// Expressions in the order in which they can be evaluated.
pub struct Tape {
    nodes: Vec<Node>,
    places: HashMap<NodeId, usize>,
    roots: Vec<usize>,
}

impl Tape {
    pub fn new(graph: &Graph, roots: &[NodeId]) -> Self {
        let order = graph.reachable(roots);
        let places: HashMap<NodeId, usize> = order.iter().enumerate().map(|(place, &id)| (id, place)).collect();
        let nodes = order.iter().map(|&id| graph.node(id).clone()).collect();
        Self { nodes, roots: roots.iter().map(|root| places[root]).collect(), places }
    }

    /// The values of the roots. `external` has the values of the user's functions in doubles, which are taken for
    /// exact: they are data.
    pub fn evaluate<S: Scalar>(
        &self,
        bind: impl Fn(SymbolId) -> S,
        external: impl Fn(&External, &[f64]) -> f64,
    ) -> Vec<S> {
        let values = self.values(bind, external);
        self.roots.iter().map(|&root| values[root].clone()).collect()
    }

    /// The sum of the magnitudes of the terms of each root, multiplied out.
    pub fn magnitudes(&self, bind: impl Fn(SymbolId) -> f64, external: impl Fn(&External, &[f64]) -> f64) -> Vec<f64> {
        let values = self.values(bind, external);
        let mut sizes: Vec<f64> = Vec::with_capacity(values.len());
        for (place, node) in self.nodes.iter().enumerate() {
            let size = |id: &NodeId| sizes[self.places[id]];
            sizes.push(match node {
                Node::Sum { constant, terms } => {
                    let terms = terms.iter().map(|(factor, term)| factor.to_f64().abs() * size(term));
                    constant.to_f64().abs() + terms.sum::<f64>()
                }
                Node::Product { coefficient, factors } => {
                    let power = |(base, exponent): &(NodeId, i32)| match exponent {
                        1.. => size(base).powi(*exponent),
                        _ => values[self.places[base]].abs().powi(*exponent),
                    };
                    coefficient.to_f64().abs() * factors.iter().map(power).product::<f64>()
                }
                _ => values[place].abs(),
            });
        }
        self.roots.iter().map(|&root| sizes[root]).collect()
    }

    fn values<S: Scalar>(&self, bind: impl Fn(SymbolId) -> S, external: impl Fn(&External, &[f64]) -> f64) -> Vec<S> {
        let mut values: Vec<S> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let child = |id: &NodeId| &values[self.places[id]];
            let value = match node {
                Node::Constant(number) => S::number(*number),
                Node::Pi => S::pi(),
                Node::Symbol(symbol) => bind(*symbol),
                Node::Sum { constant, terms } => {
                    let mut sum = (!constant.is_zero()).then(|| S::number(*constant));
                    for (factor, term) in terms {
                        let term = if factor.is_one() {
                            child(term).clone()
                        } else {
                            S::number(*factor).multiply(child(term))
                        };
                        sum = Some(sum.map_or(term.clone(), |sum| sum.add(&term)));
                    }
                    sum.unwrap_or_else(|| S::of(0.0))
                }
                Node::Product { coefficient, factors } => {
                    let mut product = (!coefficient.is_one()).then(|| S::number(*coefficient));
                    for (base, exponent) in factors {
                        let power = child(base).power(*exponent);
                        product = Some(product.map_or(power.clone(), |product| product.multiply(&power)));
                    }
                    product.unwrap_or_else(|| S::of(1.0))
                }
                Node::Call(function, arguments) => {
                    let arguments: Vec<S> = arguments.iter().map(|id| child(id).clone()).collect();
                    S::call(*function, &arguments)
                }
                Node::External(function, arguments) => {
                    let arguments: Vec<f64> = arguments.iter().map(|id| child(id).double()).collect();
                    S::of(external(function, &arguments))
                }
            };
            values.push(value);
        }
        values
    }
}

/// The x of A x = b, A by rows: elimination with partial pivoting.
pub fn solve(mut a: Vec<Vec<Big>>, mut b: Vec<Big>) -> Vec<Big> {
    let n = b.len();
    for column in 0..n {
        let pivot =
            (column..n).max_by(|&i, &k| a[i][column].clone().abs().cmp(&a[k][column].clone().abs())).expect("a row");
        a.swap(column, pivot);
        b.swap(column, pivot);
        let pivot_row = a[column].clone();
        for row in column + 1..n {
            let factor = &a[row][column] / &pivot_row[column];
            for (entry, above) in a[row].iter_mut().zip(&pivot_row) {
                *entry -= &factor * above;
            }
            let part = &factor * &b[column];
            b[row] -= part;
        }
    }
    for row in (0..n).rev() {
        for other in row + 1..n {
            let part = &a[row][other] * &b[other];
            b[row] -= part;
        }
        b[row] = &b[row] / &a[row][row];
    }
    b
}
