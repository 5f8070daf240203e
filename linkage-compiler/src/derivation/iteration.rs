//! Groups without closed form: Newton's method on the equations of the group, with subexpressions that do not depend on
//! its unknowns computed before the iteration.

use rustc_hash::{FxHashMap, FxHashSet};

use super::assembly::Assembly;
use super::data::{Derivation, Group};
use super::step::Step;
use crate::graph::{Node, NodeId, Number, SymbolId};
use crate::ids::{ColumnId, GroupId};

impl Derivation {
    /// Adds steps that name the invariant subexpressions, and the step of Newton's method.
    pub(super) fn iterate(&mut self, id: GroupId, group: &Group, assembly: &mut Assembly) {
        let columns = self.unknowns.at(&group.unknowns);
        let targets: Vec<SymbolId> = columns.iter().map(|&column| self.coordinates[column].value).collect();
        let mut system = self.residual.at(&group.equations);
        system.extend(self.residual_scales.at(&group.equations));
        system.extend(self.block_matrix(group).into_iter().flatten());
        let system = assembly.solved(&mut self.graph, &system);
        let mut split = Split::new(self, &targets, &system);
        let system = split.changing(&system);
        assembly.steps.append(&mut split.steps);
        let known = self.graph.symbols_of(&system).into_iter().filter(|symbol| !targets.contains(symbol));
        let known: Vec<SymbolId> = known.collect();
        let known = known.into_iter().map(|symbol| self.graph.variable(symbol)).collect();
        let guesses = columns.iter().map(|&column| {
            let name = format!("{}_guess", self.coordinates[column].name);
            (column, self.graph.symbol(name))
        });
        let guesses: Vec<(ColumnId, SymbolId)> = guesses.collect();
        let start = guesses.iter().map(|&(_, symbol)| self.graph.variable(symbol)).collect();
        assembly.guesses.extend(guesses);
        assembly.steps.push(Step::Newton { group: id, targets, start, known, system });
    }
}

/// Hoists subexpressions that do not depend on some symbols out of expressions.
struct Split<'a> {
    derivation: &'a mut Derivation,
    /// The nodes that depend on one of the symbols.
    holding: FxHashSet<NodeId>,
    /// The names of hoisted subexpressions.
    names: FxHashMap<NodeId, NodeId>,
    steps: Vec<Step>,
}

impl<'a> Split<'a> {
    fn new(derivation: &'a mut Derivation, symbols: &[SymbolId], roots: &[NodeId]) -> Self {
        let graph = &derivation.graph;
        let mut holding = FxHashSet::default();
        for id in graph.reachable(roots) {
            let itself = graph.as_symbol(id).is_some_and(|symbol| symbols.contains(&symbol));
            if itself || graph.children(id).iter().any(|child| holding.contains(child)) {
                holding.insert(id);
            }
        }
        Self { derivation, holding, names: FxHashMap::default(), steps: Vec::new() }
    }

    /// Returns the expressions with names in place of invariant subexpressions.
    fn changing(&mut self, roots: &[NodeId]) -> Vec<NodeId> {
        let mut new: FxHashMap<NodeId, NodeId> = FxHashMap::default();
        for id in self.derivation.graph.reachable(roots) {
            if self.holding.contains(&id) {
                let rebuilt = self.rebuilt(id, &new);
                new.insert(id, rebuilt);
            }
        }
        roots.iter().map(|root| new.get(root).copied().unwrap_or_else(|| self.named(*root))).collect()
    }

    /// Rebuilds a node that depends on a symbol; its invariant terms or factors become one name.
    fn rebuilt(&mut self, id: NodeId, new: &FxHashMap<NodeId, NodeId>) -> NodeId {
        match self.derivation.graph.node(id).clone() {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => id,
            Node::Sum { constant, terms } => {
                let (changing, still): (Vec<_>, Vec<_>) =
                    terms.into_iter().partition(|(_, term)| self.holding.contains(term));
                let one = self.derivation.graph.one();
                let mut still = still;
                still.push((constant, one));
                let still = self.derivation.graph.sum(&still);
                let mut sum: Vec<_> = changing.into_iter().map(|(factor, term)| (factor, new[&term])).collect();
                sum.push((Number::ONE, self.named(still)));
                self.derivation.graph.sum(&sum)
            }
            Node::Product { coefficient, factors } => {
                let (changing, still): (Vec<_>, Vec<_>) =
                    factors.into_iter().partition(|(base, _)| self.holding.contains(base));
                let mut still = still;
                still.push((self.derivation.graph.number(coefficient), 1));
                let still = self.derivation.graph.product(&still);
                let mut product: Vec<_> = changing.into_iter().map(|(base, power)| (new[&base], power)).collect();
                product.push((self.named(still), 1));
                self.derivation.graph.product(&product)
            }
            Node::Call(function, arguments) => {
                let arguments = self.parts(&arguments, new);
                self.derivation.graph.call(function, &arguments)
            }
            Node::External(external, arguments) => {
                let arguments = self.parts(&arguments, new);
                self.derivation.graph.apply(external, arguments)
            }
        }
    }

    fn parts(&mut self, arguments: &[NodeId], new: &FxHashMap<NodeId, NodeId>) -> Vec<NodeId> {
        let part = |argument: &NodeId| new.get(argument).copied().unwrap_or_else(|| self.named(*argument));
        arguments.iter().map(part).collect()
    }

    /// Names an invariant subexpression; numbers, symbols and negated symbols stay as they are.
    fn named(&mut self, id: NodeId) -> NodeId {
        let graph = &mut self.derivation.graph;
        if graph.symbols_of(&[id]).is_empty() || graph.as_symbol(id).is_some() {
            return id;
        }
        let negative = graph.negate(id);
        if graph.as_symbol(negative).is_some() {
            return id;
        }
        if let Some(&name) = self.names.get(&id) {
            return name;
        }
        let symbol = graph.symbol(format!("known_{}", self.names.len() + 1));
        let name = graph.variable(symbol);
        self.steps.push(Step::Let { symbol, node: id });
        self.names.insert(id, name);
        name
    }
}
