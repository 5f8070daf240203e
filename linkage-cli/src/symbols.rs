//! The symbols of the formulas of a mechanism, and where their values are.
//!
//! A name is written in one way and is a field in another, so that formulas are not evaluated by names.

use std::collections::BTreeMap;

use linkage_compiler::graph::{Graph, NodeId, SymbolId};
use linkage_compiler::model::{Driver, Mechanism};

use crate::failure::Failure;

/// The place of a value.
#[derive(Debug, Clone, Copy)]
enum Place {
    Parameter(usize),
    Input(usize),
    Unknown(usize),
}

/// The values of parameters, inputs and unknowns.
#[derive(Debug, Clone, Copy)]
pub struct Given<'v> {
    pub parameters: &'v [(String, f64)],
    pub inputs: &'v [f64],
    pub unknowns: &'v [f64],
}

/// The places of the values of all symbols that have one.
pub struct Symbols(BTreeMap<SymbolId, Place>);

impl Symbols {
    pub fn of(mechanism: &Mechanism, driver: &Driver) -> Self {
        let parameters = mechanism.parameters.iter().map(|of| of.symbol).zip((0..).map(Place::Parameter));
        let coordinate = |id| mechanism.coordinates[id].symbol;
        let inputs = driver.inputs.iter().map(|id| coordinate(*id)).zip((0..).map(Place::Input));
        let unknowns = driver.unknowns.iter().map(|id| coordinate(*id)).zip((0..).map(Place::Unknown));
        Self(parameters.chain(inputs).chain(unknowns).collect())
    }

    /// The values of formulas; a failure names a symbol that has none.
    pub fn evaluate(&self, graph: &Graph, nodes: &[NodeId], given: Given<'_>) -> Result<Vec<f64>, Failure> {
        let value = |symbol: &SymbolId| match *self.0.get(symbol)? {
            Place::Parameter(place) => given.parameters.get(place).map(|(_, value)| *value),
            Place::Input(place) => given.inputs.get(place).copied(),
            Place::Unknown(place) => given.unknowns.get(place).copied(),
        };
        let values = graph.symbols_of(nodes).into_iter().map(|symbol| {
            let missing = || Failure::Outside(format!("`{}` of a formula has no value", graph.symbol_name(symbol)));
            Ok((symbol, value(&symbol).ok_or_else(missing)?))
        });
        let values = values.collect::<Result<BTreeMap<SymbolId, f64>, Failure>>()?;
        Ok(graph.evaluate(nodes, |symbol| values.get(&symbol).copied().unwrap_or(f64::NAN)))
    }
}
