//! Lowering: from shared nodes to straight-line code, every subexpression once, every sum or product of two
//! parts that several have in common once, one sine-cosine pair an angle.

mod factors;
mod function;
mod joined;
mod lines;
mod names;
mod operations;
mod order;
mod program;
mod proven;
mod sharing;
mod stretches;
mod translate;

use std::collections::BTreeSet;

use crate::derivation::{ChordOf, Step};
use crate::graph::{External, ExternalId, Function, Graph, NodeId, Number, SymbolId};
use crate::ids::BlockId;
use crate::program::Given;
pub use function::Code;
use order::Ordering;
pub use program::program;
use translate::Builder;

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
    Square(ValueId),
    Call(Function, Vec<Signed>),
    /// A user function or a derivative of it.
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
    /// One call of a user function, for its value and its derivatives: those that are used.
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
        block: BlockId,
        determinant: Signed,
        size: Signed,
    },
    Factor {
        block: BlockId,
        matrix: Vec<Vec<Signed>>,
        sizes: Vec<Signed>,
    },
    Solve {
        block: BlockId,
        targets: Vec<SymbolId>,
        right: Vec<Signed>,
    },
    Pivots {
        symbol: SymbolId,
        matrix: Vec<Vec<Signed>>,
    },
    Chord {
        block: BlockId,
        symbol: SymbolId,
        factors: [Signed; 2],
        size: Signed,
        of: ChordOf<Signed>,
    },
    Solvable {
        block: BlockId,
        determinant: Signed,
        numerators: Vec<Signed>,
        scales: Vec<Signed>,
    },
    Newton {
        block: BlockId,
        targets: Vec<SymbolId>,
        start: Vec<Signed>,
        known: Vec<Signed>,
        /// One evaluation of the block.
        system: Box<Schedule>,
    },
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
    /// What the lines are for.
    pub results: Vec<Signed>,
    /// The expressions that have names, where they or their negatives are computed.
    names: Vec<(ValueId, bool, String)>,
    used: Vec<ValueId>,
}

/// Orders the steps of a kernel and the formulas of its results.
#[must_use]
pub fn schedule(
    graph: &Graph,
    steps: &[Step],
    results: &[NodeId],
    given: &Given,
    named: &[(NodeId, String)],
    keeps_inverses: bool,
) -> Schedule {
    let mut nodes: Vec<NodeId> = steps.iter().flat_map(Step::nodes).collect();
    nodes.extend(results);
    let introduced: BTreeSet<SymbolId> = steps.iter().flat_map(Step::introduced).collect();
    let (mut values, translated) = Builder::translate_all(graph, given, &nodes);
    let roots: Vec<Signed> = nodes.iter().map(|node| translated[node]).collect();
    graph.budget().spend(nodes.len() + values.len());
    sharing::share(&mut values, &roots, graph.budget());
    joined::join(&mut values, &roots, keeps_inverses);
    factors::order(&mut values);
    let mut names: Vec<(ValueId, bool, String)> = Vec::new();
    for (node, name) in named {
        if let Some(Signed { negative, value }) = translated.get(node).copied() {
            names.push((value, negative, name.clone()));
        }
    }
    // A name of the value itself comes after those of its negative.
    names.sort_by_key(|(value, negative, _)| (*value, !negative));
    let mut ordering = Ordering::new(graph, values, &roots);
    ordering.gather_sines(&introduced);
    let signed = |nodes: &[NodeId]| -> Vec<Signed> { nodes.iter().map(|node| translated[node]).collect() };
    for step in steps {
        for node in step.nodes() {
            ordering.require(translated[&node].value, matches!(step, Step::Let { .. } | Step::Turn { .. }));
        }
        ordering.lines.push(match step {
            Step::Let { symbol, node } => Line::Name { symbol: *symbol, value: translated[node] },
            Step::Turn { symbol, principal } => Line::Turn { symbol: *symbol, principal: translated[principal] },
            Step::Guard { block, determinant, size } => {
                Line::Guard { block: *block, determinant: translated[determinant], size: translated[size] }
            }
            Step::Factor { block, matrix, sizes } => {
                let matrix = matrix.iter().map(|row| signed(row)).collect();
                Line::Factor { block: *block, matrix, sizes: signed(sizes) }
            }
            Step::Solve { block, targets, right } => {
                Line::Solve { block: *block, targets: targets.clone(), right: signed(right) }
            }
            Step::Chord { block, symbol, factors, size, of } => Line::Chord {
                block: *block,
                symbol: *symbol,
                factors: factors.map(|node| translated[&node]),
                size: translated[size],
                of: of.map(|node| translated[&node]),
            },
            Step::Solvable { block, determinant, numerators, scales } => Line::Solvable {
                block: *block,
                determinant: translated[determinant],
                numerators: signed(numerators),
                scales: signed(scales),
            },
            Step::Pivots { symbol, matrix } => {
                Line::Pivots { symbol: *symbol, matrix: matrix.iter().map(|row| signed(row)).collect() }
            }
            Step::Newton { block, targets, start, known, system } => {
                let system = Box::new(schedule(graph, &[], system, given, &[], false));
                let (targets, start, known) = (targets.clone(), signed(start), signed(known));
                Line::Newton { block: *block, targets, start, known, system }
            }
        });
    }
    let results = signed(results);
    for result in &results {
        ordering.require(result.value, false);
    }
    let used = ordering.used();
    let Ordering { values, lines, .. } = ordering;
    Schedule { values, lines, results, names, used }
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
}

impl Schedule {
    #[must_use]
    pub fn value(&self, id: ValueId) -> &Value {
        &self.values[id.0]
    }

    /// The name of a value, and whether it is that of its negative.
    #[must_use]
    pub fn name(&self, id: ValueId) -> Option<(&str, bool)> {
        // Of several names the last.
        let after = self.names.partition_point(|(value, ..)| *value <= id);
        let (value, negative, name) = self.names.get(after.checked_sub(1)?)?;
        (*value == id).then_some((name, *negative))
    }

    /// Every value that the lines depend on, ascending.
    #[must_use]
    pub fn used(&self) -> &[ValueId] {
        &self.used
    }
}
