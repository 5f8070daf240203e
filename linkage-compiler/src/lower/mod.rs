//! Lowering: from shared nodes to straight-line code, every subexpression once, every sum or product of two
//! parts that several have in common once, one sine-cosine pair an angle.

mod needed;
mod operations;
mod order;
mod proven;
mod sharing;
mod translate;

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use crate::graph::{External, ExternalId, Function, Graph, NodeId, Number, SymbolId};
pub use needed::needed;
pub use operations::Operations;
use order::Ordering;
use translate::Builder;

/// What a kernel does, in order.
#[derive(Debug, Clone)]
pub enum Stage {
    /// Gives a value a name that later stages refer to by its symbol.
    Let { symbol: SymbolId, node: NodeId },
    /// Names the number of an angle: its principal value and so many turns as the kernel is given.
    Turn { symbol: SymbolId, principal: NodeId },
    /// Refuses a determinant that is zero beside `size`.
    Guard { block: usize, determinant: NodeId, size: NodeId },
    /// Factorises the matrix of a block given by rows, whose rows are of these sizes.
    Factor { block: usize, matrix: Vec<Vec<NodeId>>, sizes: Vec<NodeId> },
    /// Solves the factorised system of a block and names the solution.
    Solve { block: usize, targets: Vec<SymbolId>, right: Vec<NodeId> },
    /// Names the root of a product of two factors, with the sign of the branch of a block; refuses a
    /// factor that is less than zero relative to its terms.
    Chord { block: usize, symbol: SymbolId, factors: [NodeId; 2], size: NodeId, of: ChordOf<NodeId> },
    /// Refuses a determinant of linear unknowns that is zero; `numerators` are what is divided by it, `scales` the sums of
    /// the magnitudes of their terms.
    Solvable { block: usize, determinant: NodeId, numerators: Vec<NodeId>, scales: Vec<NodeId> },
    /// Names the unknowns of a block, found by Newton's method from `start`: its residual, the sizes of its
    /// closures and its matrix row by row are `system`, made of the unknowns and of what is `known`.
    Newton { block: usize, targets: Vec<SymbolId>, start: Vec<NodeId>, known: Vec<NodeId>, system: Vec<NodeId> },
    /// Names the product of the pivots of a matrix given by rows.
    Pivots { symbol: SymbolId, matrix: Vec<Vec<NodeId>> },
    /// The values that the kernel returns.
    Return(Vec<NodeId>),
}

/// The geometry of a half chord.
#[derive(Debug, Clone, Copy)]
pub enum ChordOf<V> {
    /// Two links between joints: their lengths, the line between the joints, its square, and the sum of the
    /// magnitudes of its terms.
    Triangle { links: [V; 2], line: [V; 2], distance: V, scale: V },
    /// A reach and an offset, with the sums of the magnitudes of their terms, and whether the reach may vanish by
    /// cancellation.
    Reach { scales: [V; 2], may_cancel: bool },
}

impl<V: Copy> ChordOf<V> {
    fn values(&self) -> Vec<V> {
        match *self {
            Self::Triangle { links: [p, q], line: [x, y], distance, scale } => vec![p, q, x, y, distance, scale],
            Self::Reach { scales, .. } => scales.to_vec(),
        }
    }

    pub(crate) fn map<W>(self, mut f: impl FnMut(V) -> W) -> ChordOf<W> {
        match self {
            Self::Triangle { links, line, distance, scale } => ChordOf::Triangle {
                links: links.map(&mut f),
                line: line.map(&mut f),
                distance: f(distance),
                scale: f(scale),
            },
            Self::Reach { scales, may_cancel } => ChordOf::Reach { scales: scales.map(f), may_cancel },
        }
    }
}

impl Stage {
    /// The symbols that a stage gives a value to.
    #[must_use]
    pub fn introduced(&self) -> Vec<SymbolId> {
        match self {
            Self::Let { symbol, .. }
            | Self::Turn { symbol, .. }
            | Self::Pivots { symbol, .. }
            | Self::Chord { symbol, .. } => vec![*symbol],
            Self::Solve { targets, .. } | Self::Newton { targets, .. } => targets.clone(),
            _ => Vec::new(),
        }
    }

    /// The expressions of a stage.
    #[must_use]
    pub fn nodes(&self) -> Vec<NodeId> {
        match self {
            Self::Let { node, .. } => vec![*node],
            Self::Turn { principal, .. } => vec![*principal],
            Self::Guard { determinant, size, .. } => vec![*determinant, *size],
            Self::Chord { factors: [low, high], size, of, .. } => {
                [*low, *high, *size].into_iter().chain(of.values()).collect()
            }
            Self::Solvable { determinant, numerators, scales, .. } => {
                std::iter::once(determinant).chain(numerators).chain(scales).copied().collect()
            }
            Self::Factor { matrix, sizes, .. } => matrix.iter().flatten().chain(sizes).copied().collect(),
            Self::Pivots { matrix, .. } => matrix.iter().flatten().copied().collect(),
            Self::Solve { right, .. } => right.clone(),
            Self::Newton { start, known, .. } => start.iter().chain(known).copied().collect(),
            Self::Return(nodes) => nodes.clone(),
        }
    }
}

/// A value of a [`Schedule`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ValueId(usize);

impl ValueId {
    pub(crate) fn index(self) -> usize {
        self.0
    }
}

/// A value or its negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Signed {
    pub negative: bool,
    pub value: ValueId,
}

/// How a value is computed; signs have been moved to the sums and results that use it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Value {
    Symbol(SymbolId),
    /// The sine or cosine of an angle whose direction is given.
    Direction(Function, NodeId),
    Constant(Number),
    Sum(Vec<Signed>),
    Product(Vec<ValueId>),
    Quotient(ValueId, ValueId),
    Square(ValueId),
    Call(Function, Vec<Signed>),
    /// A function of the user's or a derivative of it.
    External(External, Vec<Signed>),
}

/// One line of straight-line code.
#[derive(Debug, Clone)]
pub enum Line {
    Let(ValueId),
    SineCosine {
        sine: ValueId,
        cosine: ValueId,
        angle: Signed,
    },
    /// The sines and cosines of several angles at once, those that are used.
    SinesCosines(Vec<Circular>),
    /// One call of a function of the user's, for its value and its derivatives: those that are used.
    External {
        function: ExternalId,
        arguments: Vec<Signed>,
        values: Vec<Option<ValueId>>,
    },
    Name {
        symbol: SymbolId,
        value: Signed,
    },
    Turn {
        symbol: SymbolId,
        principal: Signed,
    },
    Guard {
        block: usize,
        determinant: Signed,
        size: Signed,
    },
    Factor {
        block: usize,
        matrix: Vec<Vec<Signed>>,
        sizes: Vec<Signed>,
    },
    Solve {
        block: usize,
        targets: Vec<SymbolId>,
        right: Vec<Signed>,
    },
    Pivots {
        symbol: SymbolId,
        matrix: Vec<Vec<Signed>>,
    },
    Chord {
        block: usize,
        symbol: SymbolId,
        factors: [Signed; 2],
        size: Signed,
        of: ChordOf<Signed>,
    },
    Solvable {
        block: usize,
        determinant: Signed,
        numerators: Vec<Signed>,
        scales: Vec<Signed>,
    },
    Newton {
        block: usize,
        targets: Vec<SymbolId>,
        start: Vec<Signed>,
        known: Vec<Signed>,
        /// One evaluation of the block.
        system: Box<Schedule>,
    },
    Return(Vec<Signed>),
}

/// An angle with its sine and cosine.
#[derive(Debug, Clone, Copy)]
pub struct Circular {
    pub angle: Signed,
    pub sine: Option<ValueId>,
    pub cosine: Option<ValueId>,
}

/// A kernel as straight-line code.
#[derive(Debug, Clone)]
pub struct Schedule {
    values: Vec<Value>,
    pub lines: Vec<Line>,
    /// The expressions that the user named, where they are computed.
    names: Vec<(ValueId, String)>,
    used: Vec<ValueId>,
}

/// What a kernel need not compute.
#[derive(Debug, Clone, Default)]
pub struct Given {
    /// The angles whose sine and cosine are given.
    pub directions: BTreeSet<NodeId>,
    /// Expressions that are given by a name.
    pub values: FxHashMap<NodeId, SymbolId>,
}

/// Orders the stages of a kernel.
#[must_use]
pub fn schedule(graph: &Graph, stages: &[Stage], given: &Given, named: &[(NodeId, String)]) -> Schedule {
    let (mut nodes, mut introduced) = (Vec::new(), BTreeSet::new());
    for stage in stages {
        nodes.append(&mut stage.nodes());
        introduced.extend(stage.introduced());
    }
    let (mut values, translated) = Builder::translate_all(graph, given, &nodes);
    let mut roots = Vec::with_capacity(nodes.len());
    for &node in &nodes {
        roots.push(translated.of(node));
    }
    graph.budget().spend(nodes.len() + values.len());
    sharing::share(&mut values, &roots, graph.budget());
    let mut names: Vec<(ValueId, String)> = Vec::new();
    for (node, name) in named {
        if let Some(Signed { negative: false, value }) = translated.get(*node) {
            names.push((value, name.clone()));
        }
    }
    names.sort_by_key(|(value, _)| *value);
    let mut ordering = Ordering::new(graph, values, &roots);
    ordering.gather_sines(&introduced);
    let signed = |nodes: &[NodeId]| -> Vec<Signed> { nodes.iter().map(|node| translated.of(*node)).collect() };
    for stage in stages {
        for node in stage.nodes() {
            ordering.require(translated.of(node).value, matches!(stage, Stage::Let { .. } | Stage::Turn { .. }));
        }
        ordering.lines.push(match stage {
            Stage::Let { symbol, node } => Line::Name { symbol: *symbol, value: translated.of(*node) },
            Stage::Turn { symbol, principal } => Line::Turn { symbol: *symbol, principal: translated.of(*principal) },
            Stage::Guard { block, determinant, size } => {
                Line::Guard { block: *block, determinant: translated.of(*determinant), size: translated.of(*size) }
            }
            Stage::Factor { block, matrix, sizes } => {
                let matrix = matrix.iter().map(|row| signed(row)).collect();
                Line::Factor { block: *block, matrix, sizes: signed(sizes) }
            }
            Stage::Solve { block, targets, right } => {
                Line::Solve { block: *block, targets: targets.clone(), right: signed(right) }
            }
            Stage::Chord { block, symbol, factors, size, of } => Line::Chord {
                block: *block,
                symbol: *symbol,
                factors: factors.map(|node| translated.of(node)),
                size: translated.of(*size),
                of: of.map(|node| translated.of(node)),
            },
            Stage::Solvable { block, determinant, numerators, scales } => Line::Solvable {
                block: *block,
                determinant: translated.of(*determinant),
                numerators: signed(numerators),
                scales: signed(scales),
            },
            Stage::Pivots { symbol, matrix } => {
                Line::Pivots { symbol: *symbol, matrix: matrix.iter().map(|row| signed(row)).collect() }
            }
            Stage::Newton { block, targets, start, known, system } => {
                let system = Box::new(schedule(graph, &[Stage::Return(system.clone())], given, &[]));
                let (targets, start, known) = (targets.clone(), signed(start), signed(known));
                Line::Newton { block: *block, targets, start, known, system }
            }
            Stage::Return(nodes) => Line::Return(signed(nodes)),
        });
    }
    let used = ordering.used();
    let Ordering { values, lines, .. } = ordering;
    Schedule { values, lines, names, used }
}

impl Value {
    fn each_part(&self, mut visit: impl FnMut(ValueId)) {
        match self {
            Self::Symbol(_) | Self::Direction(..) | Self::Constant(_) => {}
            Self::Sum(parts) | Self::Call(_, parts) | Self::External(_, parts) => {
                for part in parts {
                    visit(part.value);
                }
            }
            Self::Product(factors) => {
                for factor in factors {
                    visit(*factor);
                }
            }
            Self::Quotient(above, below) => {
                visit(*above);
                visit(*below);
            }
            Self::Square(base) => visit(*base),
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
}

impl Schedule {
    #[must_use]
    pub fn value(&self, id: ValueId) -> &Value {
        &self.values.as_slice()[id.0]
    }

    /// The name that the user gave to a value.
    #[must_use]
    pub fn name(&self, id: ValueId) -> Option<&str> {
        // Of several names the last.
        let after = self.names.partition_point(|(value, _)| *value <= id);
        let (value, name) = self.names.get(after.checked_sub(1)?)?;
        (*value == id).then_some(name)
    }

    /// Every value that the lines stand on, ascending.
    #[must_use]
    pub fn used(&self) -> &[ValueId] {
        &self.used
    }
}
