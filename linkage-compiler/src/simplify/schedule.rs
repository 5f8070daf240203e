//! From shared nodes to straight-line steps: every subexpression once, every product of two
//! factors that several products share once, one sine-cosine pair an angle.

mod products;

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};

/// What a kernel does, in order.
#[derive(Debug, Clone)]
pub enum Stage {
    /// Gives a value a name that later stages refer to by its symbol.
    Let { symbol: SymbolId, node: NodeId },
    /// Refuses a determinant that is zero beside `size`.
    Guard { block: usize, determinant: NodeId, size: NodeId },
    /// Factorises the matrix of a block given by rows, whose rows are of these sizes.
    Factor { block: usize, matrix: Vec<Vec<NodeId>>, sizes: Vec<NodeId> },
    /// Solves the factorised system of a block and names the solution.
    Solve { block: usize, targets: Vec<SymbolId>, right: Vec<NodeId> },
    /// Names the product of the pivots of a matrix given by rows.
    Pivots { symbol: SymbolId, matrix: Vec<Vec<NodeId>> },
    /// The values that the kernel returns.
    Return(Vec<NodeId>),
}

impl Stage {
    /// The expressions of a stage.
    #[must_use]
    pub fn nodes(&self) -> Vec<NodeId> {
        match self {
            Self::Let { node, .. } => vec![*node],
            Self::Guard { determinant, size, .. } => vec![*determinant, *size],
            Self::Factor { matrix, sizes, .. } => matrix.iter().flatten().chain(sizes).copied().collect(),
            Self::Pivots { matrix, .. } => matrix.iter().flatten().copied().collect(),
            Self::Solve { right, .. } => right.clone(),
            Self::Return(nodes) => nodes.clone(),
    }
    }
}

/// A value of a [`Schedule`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ValueId(usize);

/// A value or its negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Signed {
    pub negative: bool,
    pub value: ValueId,
}

/// How a value is computed; signs have been moved to the sums and results that use it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Value {
    Symbol(SymbolId),
    /// The sine or cosine of an angle whose direction is given.
    Direction(Function, NodeId),
    Constant(Number),
    Sum(Vec<Signed>),
    Product(Vec<ValueId>),
    Quotient(ValueId, ValueId),
    Power(ValueId, u32),
    Call(Function, Vec<Signed>),
}

/// One line of straight-line code.
#[derive(Debug, Clone)]
pub enum Line {
    Let(ValueId),
    SineCosine { sine: ValueId, cosine: ValueId, angle: Signed },
    Name { symbol: SymbolId, value: Signed },
    Guard { block: usize, determinant: Signed, size: Signed },
    Factor { block: usize, matrix: Vec<Vec<Signed>>, sizes: Vec<Signed> },
    Solve { block: usize, targets: Vec<SymbolId>, right: Vec<Signed> },
    Pivots { symbol: SymbolId, matrix: Vec<Vec<Signed>> },
    Return(Vec<Signed>),
}

/// A kernel as straight-line code.
#[derive(Debug, Clone)]
pub struct Schedule {
    values: Vec<Value>,
    pub lines: Vec<Line>,
    /// The expressions that the user named, where they are computed.
    names: HashMap<ValueId, String>,
}

/// An inline expression nested deeper than this is hard to read; it gets a line of its own.
const DEEPEST_INLINE: usize = 5;

/// Orders the stages of a kernel. `directions` are the angles whose sine and cosine are given.
#[must_use]
pub fn schedule(
    graph: &Graph,
    stages: &[Stage],
    directions: &BTreeSet<NodeId>,
    named: &[(NodeId, String)],
) -> Schedule {
    let roots: Vec<NodeId> = stages.iter().flat_map(Stage::nodes).collect();
    let mut builder = Builder { graph, directions, values: Vec::new(), ids: HashMap::new(), of: BTreeMap::new() };
    builder.build(&roots);
    let of = builder.of;
    let mut values = builder.values;
    products::share(&mut values, &roots.iter().map(|root| of[root].value).collect::<Vec<_>>());
    let names = named
        .iter()
        .filter_map(|(node, name)| {
            of.get(node).filter(|signed| !signed.negative).map(|signed| (signed.value, name.clone()))
        })
        .collect();
    let mut ordering = Ordering::new(values, &roots.iter().map(|root| of[root]).collect::<Vec<_>>());
    let signed = |nodes: &[NodeId]| -> Vec<Signed> { nodes.iter().map(|node| of[node]).collect() };
    for stage in stages {
        for node in stage.nodes() {
            ordering.require(of[&node].value, matches!(stage, Stage::Let { .. }));
        }
        ordering.lines.push(match stage {
            Stage::Let { symbol, node } => Line::Name { symbol: *symbol, value: of[node] },
            Stage::Guard { block, determinant, size } => {
                Line::Guard { block: *block, determinant: of[determinant], size: of[size] }
            }
            Stage::Factor { block, matrix, sizes } => {
                let matrix = matrix.iter().map(|row| signed(row)).collect();
                Line::Factor { block: *block, matrix, sizes: signed(sizes) }
            }
            Stage::Solve { block, targets, right } => {
                Line::Solve { block: *block, targets: targets.clone(), right: signed(right) }
            }
            Stage::Pivots { symbol, matrix } => {
                Line::Pivots { symbol: *symbol, matrix: matrix.iter().map(|row| signed(row)).collect() }
            }
            Stage::Return(nodes) => Line::Return(signed(nodes)),
        });
    }
    Schedule { values: ordering.values, lines: ordering.lines, names }
}

/// Translates nodes to values.
struct Builder<'a> {
    graph: &'a Graph,
    directions: &'a BTreeSet<NodeId>,
    values: Vec<Value>,
    ids: HashMap<Value, ValueId>,
    of: BTreeMap<NodeId, Signed>,
}

impl Builder<'_> {
    fn build(&mut self, roots: &[NodeId]) {
        let mut wanted: BTreeSet<NodeId> = roots.iter().copied().collect();
        let mut ordered = Vec::new();
        while let Some(id) = wanted.pop_last() {
            ordered.push(id);
            if !self.is_leaf(id) {
                wanted.extend(self.graph.children(id));
            }
        }
        ordered.reverse();
        let shared = self.shared_divisors(&ordered);
        for id in ordered {
            let signed = match self.leaf(id) {
                Some(signed) => signed,
                None => self.translate(id, &shared),
            };
            self.of.insert(id, signed);
        }
    }

    fn is_leaf(&self, id: NodeId) -> bool {
        let given = match self.graph.node(id) {
            Node::Call(Function::Sin | Function::Cos, angle) => self.directions.contains(&angle[0]),
            _ => false,
        };
        given || self.graph.constant_value(id).is_some()
    }

    /// Constants, symbols and given directions need nothing else.
    fn leaf(&mut self, id: NodeId) -> Option<Signed> {
        let value = match self.graph.node(id) {
            Node::Constant(number) => return Some(self.constant(*number)),
            Node::Symbol(symbol) => Value::Symbol(*symbol),
            Node::Call(function @ (Function::Sin | Function::Cos), angle) if self.directions.contains(&angle[0]) => {
                Value::Direction(*function, angle[0])
            }
            _ => return self.graph.constant_value(id).map(|value| self.constant(Number::Float(value))),
        };
        Some(self.positive(value))
    }

    /// The divisors that more than one quotient has: these are inverted once.
    fn shared_divisors(&self, nodes: &[NodeId]) -> BTreeSet<Vec<(NodeId, i32)>> {
        let mut count: BTreeMap<Vec<(NodeId, i32)>, usize> = BTreeMap::new();
        for &id in nodes {
            if let Node::Product { factors, .. } = self.graph.node(id) {
                *count.entry(divisor(factors)).or_default() += 1;
            }
        }
        count
            .into_iter()
            .filter(|(divisor, uses)| *uses > 1 && !divisor.is_empty())
            .map(|(divisor, _)| divisor)
            .collect()
    }

    fn intern(&mut self, value: Value) -> ValueId {
        *self.ids.entry(value).or_insert_with_key(|value| {
            self.values.push(value.clone());
            ValueId(self.values.len() - 1)
        })
    }

    fn positive(&mut self, value: Value) -> Signed {
        Signed { negative: false, value: self.intern(value) }
    }

    fn constant(&mut self, number: Number) -> Signed {
        Signed { negative: number.is_negative(), value: self.intern(Value::Constant(number.absolute())) }
    }

    fn translate(&mut self, id: NodeId, shared: &BTreeSet<Vec<(NodeId, i32)>>) -> Signed {
        match self.graph.node(id) {
            Node::Sum { constant, terms } => {
                let mut signed = Vec::new();
                for &(coefficient, term) in terms {
                    let term = self.of[&term];
                    let value = self.scaled(coefficient.absolute(), term.value);
                    signed.push(Signed { negative: term.negative != coefficient.is_negative(), value });
                }
                if !constant.is_zero() {
                    signed.push(self.constant(*constant));
                }
                self.sum(signed)
            }
            Node::Product { coefficient, factors } => self.product(*coefficient, factors, shared),
            Node::Call(function, arguments) => {
                let arguments = arguments.iter().map(|argument| self.of[argument]).collect();
                self.positive(Value::Call(*function, arguments))
            }
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => self.constant(Number::ZERO),
        }
    }

    /// Signs are moved out so that a - b and b - a are one value and most terms are added.
    fn sum(&mut self, mut terms: Vec<Signed>) -> Signed {
        let negatives = terms.iter().filter(|term| term.negative).count();
        let flip = 2 * negatives > terms.len() || (2 * negatives == terms.len() && terms[0].negative);
        for term in &mut terms {
            term.negative ^= flip;
        }
        // What is added stands before what is taken away, so that nothing starts with a minus.
        terms.sort_by_key(|term| term.negative);
        Signed { negative: flip, value: self.intern(Value::Sum(terms)) }
    }

    fn product(
        &mut self,
        coefficient: Number,
        factors: &[(NodeId, i32)],
        shared: &BTreeSet<Vec<(NodeId, i32)>>,
    ) -> Signed {
        let mut constant = coefficient;
        let mut negative = false;
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for &(base, exponent) in factors {
            if let Some(value) = self.graph.constant_value(base) {
                constant = constant.multiply(Number::Float(value.powi(exponent)));
                continue;
            }
            let signed = self.of[&base];
            negative ^= signed.negative && exponent % 2 != 0;
            let value = match exponent.unsigned_abs() {
                1 => signed.value,
                n => self.intern(Value::Power(signed.value, n)),
            };
            if exponent > 0 { &mut above } else { &mut below }.push(value);
        }
        negative ^= constant.is_negative();
        let constant = constant.absolute();
        if below.is_empty() {
            let value = self.multiply(constant, above);
            return Signed { negative, value };
        }
        let divisor_value = self.multiply(Number::ONE, below);
        let value = if shared.contains(&divisor(factors)) {
            let one = self.constant(Number::ONE).value;
            let inverse = self.intern(Value::Quotient(one, divisor_value));
            above.push(inverse);
            self.multiply(constant, above)
        } else {
            let above = self.multiply(constant, above);
            self.intern(Value::Quotient(above, divisor_value))
        };
        Signed { negative, value }
    }

    fn multiply(&mut self, constant: Number, mut factors: Vec<ValueId>) -> ValueId {
        if !constant.is_one() || factors.is_empty() {
            factors.insert(0, self.constant(constant).value);
        }
        match factors.as_slice() {
            &[only] => only,
            _ => {
                factors.sort_unstable_by_key(|&id| (self.values[id.0].rank(), id));
                self.intern(Value::Product(factors))
            }
        }
    }

    fn scaled(&mut self, factor: Number, value: ValueId) -> ValueId {
        if factor.is_one() {
            return value;
        }
        match self.values[value.0].clone() {
            Value::Constant(number) => self.constant(number.multiply(factor)).value,
            Value::Product(factors) => self.multiply(factor, factors),
            Value::Quotient(above, below) => {
                let above = self.scaled(factor, above);
                self.intern(Value::Quotient(above, below))
            }
            _ => self.multiply(factor, vec![value]),
        }
    }
}

fn divisor(factors: &[(NodeId, i32)]) -> Vec<(NodeId, i32)> {
    factors.iter().filter(|(_, exponent)| *exponent < 0).copied().collect()
}

impl Value {
    fn parts(&self) -> Vec<ValueId> {
        match self {
            Self::Symbol(_) | Self::Direction(..) | Self::Constant(_) => Vec::new(),
            Self::Sum(terms) => terms.iter().map(|term| term.value).collect(),
            Self::Product(factors) => factors.clone(),
            Self::Quotient(above, below) => vec![*above, *below],
            Self::Power(base, _) => vec![*base],
            Self::Call(_, arguments) => arguments.iter().map(|argument| argument.value).collect(),
        }
    }

    /// Numbers stand before names, and names before what is made of them.
    fn rank(&self) -> usize {
        match self {
            Self::Constant(_) => 0,
            Self::Symbol(_) => 1,
            _ => 2,
        }
    }

    fn is_leaf(&self) -> bool {
        matches!(self, Self::Symbol(_) | Self::Direction(..) | Self::Constant(_))
    }
}

/// Decides which values get a line, and in what order.
struct Ordering {
    values: Vec<Value>,
    uses: Vec<usize>,
    /// The nesting of a value written inline; zero once it has a name.
    height: Vec<Option<usize>>,
    lines: Vec<Line>,
}

impl Ordering {
    fn new(values: Vec<Value>, roots: &[Signed]) -> Self {
        let mut uses = vec![0; values.len()];
        let mut stack: Vec<ValueId> = roots.iter().map(|root| root.value).collect();
        while let Some(id) = stack.pop() {
            uses[id.0] += 1;
            if uses[id.0] == 1 {
                stack.extend(values[id.0].parts());
            }
        }
        Self { height: vec![None; values.len()], values, uses, lines: Vec::new() }
    }

    /// Emits the lines that `root` stands on; `named` if its own line is about to follow.
    fn require(&mut self, root: ValueId, named: bool) {
        let mut stack = vec![(root, false)];
        while let Some((id, expanded)) = stack.pop() {
            if self.height[id.0].is_some() {
                continue;
            }
            if !expanded {
                stack.push((id, true));
                stack.extend(self.values[id.0].parts().into_iter().rev().map(|part| (part, false)));
                continue;
            }
            if named && id == root {
                self.height[id.0] = Some(0);
                continue;
            }
            let inside = self.values[id.0].parts().iter().filter_map(|part| self.height[part.0]).max();
            let height = inside.map_or(0, |inside| inside + 1);
            let deserves = self.uses[id.0] > 1 || height > DEEPEST_INLINE;
            self.height[id.0] = Some(if self.values[id.0].is_leaf() || self.pair(id) {
                0
            } else if deserves {
                self.lines.push(Line::Let(id));
                0
            } else {
                height
            });
        }
    }

    /// Writes sine and cosine of one angle as one line, if both are used.
    fn pair(&mut self, id: ValueId) -> bool {
        let Value::Call(function @ (Function::Sin | Function::Cos), arguments) = &self.values[id.0] else {
            return false;
        };
        let other = if *function == Function::Sin { Function::Cos } else { Function::Sin };
        let partner = Value::Call(other, arguments.clone());
        let partner = self.values.iter().position(|value| *value == partner).filter(|&index| self.uses[index] > 0);
        let Some(partner) = partner.map(ValueId) else { return false };
        let angle = arguments[0];
        let (sine, cosine) = if *function == Function::Sin { (id, partner) } else { (partner, id) };
        self.height[partner.0] = Some(0);
        self.lines.push(Line::SineCosine { sine, cosine, angle });
        true
    }
}

/// How much work a kernel is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Operations {
    pub multiplications: usize,
    pub additions: usize,
    pub divisions: usize,
    /// Sine and cosine of one angle count as one.
    pub functions: usize,
}

impl Schedule {
    #[must_use]
    pub fn value(&self, id: ValueId) -> &Value {
        &self.values[id.0]
    }

    /// The name that the user gave to a value.
    #[must_use]
    pub fn name(&self, id: ValueId) -> Option<&str> {
        self.names.get(&id).map(String::as_str)
    }

    /// Every value that the lines stand on.
    #[must_use]
    pub fn used(&self) -> Vec<ValueId> {
        let mut seen = BTreeSet::new();
        let mut stack: Vec<ValueId> = self.lines.iter().flat_map(line_values).collect();
        while let Some(id) = stack.pop() {
            if seen.insert(id) {
                stack.extend(self.values[id.0].parts());
            }
        }
        seen.into_iter().collect()
    }

    /// The operations of all lines, but for the factorisations.
    #[must_use]
    pub fn operations(&self) -> Operations {
        let mut total = Operations::default();
        for id in self.used() {
            match &self.values[id.0] {
                Value::Sum(terms) => total.additions += terms.len() - 1,
                Value::Product(factors) => total.multiplications += factors.len() - 1,
                Value::Quotient(..) => total.divisions += 1,
                Value::Power(_, exponent) => {
                    total.multiplications += (exponent.ilog2() + exponent.count_ones() - 1) as usize;
                }
                Value::Call(Function::Abs, _) => {}
                Value::Call(..) => total.functions += 1,
                Value::Symbol(_) | Value::Direction(..) | Value::Constant(_) => {}
            }
        }
        total.functions -= self.lines.iter().filter(|line| matches!(line, Line::SineCosine { .. })).count();
        total
    }
}

fn line_values(line: &Line) -> Vec<ValueId> {
    let of = |signed: &[Signed]| signed.iter().map(|signed| signed.value).collect::<Vec<_>>();
    match line {
        Line::Let(id) => vec![*id],
        Line::SineCosine { sine, cosine, .. } => vec![*sine, *cosine],
        Line::Name { value, .. } => vec![value.value],
        Line::Guard { determinant, size, .. } => vec![determinant.value, size.value],
        Line::Factor { matrix, sizes, .. } => matrix.iter().flatten().chain(sizes).map(|signed| signed.value).collect(),
        Line::Pivots { matrix, .. } => matrix.iter().flatten().map(|signed| signed.value).collect(),
        Line::Solve { right, .. } | Line::Return(right) => of(right),
    }
}
