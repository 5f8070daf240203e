//! All numbers of the formulas of a mechanism in one list, over any kind of number and as nodes of its derivation.

use linkage::{Certifiable, Column, Dim, Formulas, Number};
use linkage_compiler::derivation::{Derivation, Row};
use linkage_compiler::graph::{Node, NodeId};
use linkage_compiler::ids::Id;
use linkage_gallery::Fixture;
use linkage_oracle::{Oracle, Sample};

/// The numbers that formulas are functions of.
pub struct At<T> {
    pub parameters: Vec<T>,
    pub unknowns: Vec<T>,
    pub inputs: Vec<T>,
    pub unknown_rates: Vec<T>,
    pub input_rates: Vec<T>,
}

impl<T: Copy> At<T> {
    pub fn map<S>(&self, mut f: impl FnMut(T) -> S) -> At<S> {
        let mut all = |list: &[T]| list.iter().map(|&value| f(value)).collect();
        At {
            parameters: all(&self.parameters),
            unknowns: all(&self.unknowns),
            inputs: all(&self.inputs),
            unknown_rates: all(&self.unknown_rates),
            input_rates: all(&self.input_rates),
        }
    }
}

impl At<f64> {
    pub fn of(sample: &Sample, derivation: &Derivation) -> Self {
        let pick = |from: &[f64], columns: &mut dyn Iterator<Item = usize>| columns.map(|place| from[place]).collect();
        let unknowns = || derivation.unknowns.iter().map(|column| column.index());
        let inputs = || derivation.inputs.iter().map(|column| column.index());
        Self {
            parameters: sample.parameters.clone(),
            unknowns: pick(&sample.q, &mut unknowns()),
            inputs: pick(&sample.q, &mut inputs()),
            unknown_rates: pick(&sample.rates, &mut unknowns()),
            input_rates: pick(&sample.rates, &mut inputs()),
        }
    }
}

/// Psi, the columns of J, the columns of A, gamma, the quantities.
pub fn values<M: Certifiable, T: Number>(at: &At<T>) -> Vec<T> {
    let over = <M::Over<T> as Formulas>::with_parameters(column(&at.parameters));
    let (unknowns, inputs) = (column(&at.unknowns), column(&at.inputs));
    let mut all: Vec<T> = over.residual(&unknowns, &inputs).into_iter().collect();
    all.extend(over.jacobian_unknowns(&unknowns, &inputs).iter().flatten());
    all.extend(over.jacobian_inputs(&unknowns, &inputs).iter().flatten());
    all.extend(over.gamma(&unknowns, &inputs, &column(&at.unknown_rates), &column(&at.input_rates)));
    all.extend(over.quantities(&unknowns, &inputs));
    all
}

/// A column of these numbers.
pub fn column<T: Number, R: Dim>(entries: &[T]) -> Column<T, R> {
    assert_eq!(entries.len(), R::COUNT);
    Column::from_fn(|place| entries[place])
}

/// The nodes of the derivation in the order of `values`.
pub fn nodes(oracle: &mut Oracle) -> Vec<NodeId> {
    let derivation = &mut oracle.derivation;
    let zero = derivation.graph.zero();
    let mut all = derivation.residual.to_vec();
    let (j, a) = (derivation.jacobian_unknowns(), derivation.jacobian_inputs());
    all.extend(derivation.unknowns.ids().flat_map(|id| entries(&j, id, zero)));
    all.extend(derivation.inputs.ids().flat_map(|id| entries(&a, id, zero)));
    all.extend(&derivation.gamma);
    all.extend(derivation.points.iter().chain(&derivation.outputs).flat_map(|quantity| &quantity.value));
    all
}

fn entries<C: Id + Ord>(rows: &[Row<C>], column: C, zero: NodeId) -> Vec<NodeId> {
    rows.iter().map(|row| row.get(&column).copied().unwrap_or(zero)).collect()
}

/// The title of a mechanism in messages.
pub fn title<F: Fixture>() -> String {
    format!("{} of {}", F::NAME, F::FILE)
}

/// For each node, true if it depends on no user function, of which nothing is known.
pub fn is_known(oracle: &Oracle, nodes: &[NodeId]) -> Vec<bool> {
    let graph = &oracle.derivation.graph;
    let is_user = |id: NodeId| matches!(graph.node(id), Node::External(..));
    nodes.iter().map(|&node| !graph.reachable(&[node]).into_iter().any(is_user)).collect()
}
