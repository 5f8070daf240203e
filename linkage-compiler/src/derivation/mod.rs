//! What follows from the closures Psi(q) = 0: Jacobians, determinant, velocity ratios,
//! the quadratic velocity term, and the same for points and outputs.
//!
//! Rates and accelerations of the coordinates are names of their own and are never replaced
//! by formulas: substituting them is what makes symbolic tools swell.

mod linear;
mod magnitude;

use std::collections::BTreeMap;

use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::model::{Driver, Mechanism};
use crate::structure::{Block, Method};
pub use linear::solve_closed;

/// A coordinate with the names of its velocity and acceleration.
#[derive(Debug, Clone)]
pub struct Coordinate {
    pub name: String,
    pub value: SymbolId,
    pub rate: SymbolId,
    pub acceleration: SymbolId,
}

/// A point or an output with all that is derived from it.
#[derive(Debug, Clone)]
pub struct Quantity {
    /// x and y of a point, the one value of an output.
    pub value: Vec<NodeId>,
    /// d value / d q, one row a component, one column a coordinate.
    pub jacobian: Vec<Vec<NodeId>>,
    /// In terms of q and q'.
    pub rate: Vec<NodeId>,
    /// In terms of q, q' and q''.
    pub acceleration: Vec<NodeId>,
}

/// The determinant of a block in closed form.
#[derive(Debug, Clone, Copy)]
pub struct Determinant {
    pub value: NodeId,
    /// The name under which everything else refers to it.
    pub symbol: SymbolId,
    /// The largest value that its formula could take at these lengths: what "near zero" is measured by.
    pub size: NodeId,
}

/// Everything derived from one mechanism with one choice of independent coordinates.
#[derive(Debug, Clone)]
pub struct Derivation {
    pub graph: Graph,
    pub coordinates: Vec<Coordinate>,
    /// The columns of [`Derivation::jacobian`] that are u and v.
    pub unknowns: Vec<usize>,
    pub inputs: Vec<usize>,
    /// Psi.
    pub residual: Vec<NodeId>,
    /// The sum of the magnitudes of each closure's terms: what "small residual" is measured by.
    pub sizes: Vec<NodeId>,
    /// Psi_q.
    pub jacobian: Vec<Vec<NodeId>>,
    pub determinant: Option<Determinant>,
    /// (Psi_q q')_q q'.
    pub gamma: Vec<NodeId>,
    pub points: Vec<Quantity>,
    pub outputs: Vec<Quantity>,
}

/// Derives a mechanism whose closures the structure stage found solvable as `block`.
#[must_use]
pub fn derive(mechanism: &Mechanism, driver: &Driver, block: Block) -> Derivation {
    let mut graph = mechanism.graph.clone();
    let order = mechanism.coordinate_order(driver);
    let coordinates: Vec<Coordinate> = order
        .iter()
        .map(|&index| {
            let name = mechanism.coordinates[index].name.field.clone();
            Coordinate {
                value: mechanism.coordinates[index].symbol,
                rate: graph.symbol(format!("{name}_rate")),
                acceleration: graph.symbol(format!("{name}_acceleration")),
                name,
            }
        })
        .collect();
    let position = |index: &usize| order.iter().position(|other| other == index).unwrap_or(0);
    let unknowns: Vec<usize> = driver.unknowns.iter().map(position).collect();
    let inputs: Vec<usize> = driver.inputs.iter().map(position).collect();

    let residual: Vec<NodeId> = mechanism.closures.iter().flat_map(|closure| closure.rows.clone()).collect();
    let jacobian = jacobian(&mut graph, &residual, &coordinates);
    let sizes = residual.iter().map(|&row| magnitude::of(&mut graph, row)).collect();
    // gamma = (Psi_q q')_q q': the derivative along q' of Psi' with q' held.
    let rates = along_rates(&mut graph, &coordinates);
    let psi_rate = graph.differentiate(&residual, &rates);
    let gamma = graph.differentiate(&psi_rate, &rates);

    let determinant = (block.method == Method::ClosedForm).then(|| {
        let entry = |row: usize, column: usize| jacobian[row][unknowns[column]];
        let value = match block.size {
            1 => entry(0, 0),
            _ => crate::simplify::determinant(&mut graph, [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]),
        };
        let size = magnitude::of_determinant(&mut graph, value);
        Determinant { value, symbol: graph.symbol("determinant"), size }
    });
    let mut quantity = |value: Vec<NodeId>| quantity(&mut graph, value, &coordinates);
    let points = mechanism.points.iter().map(|point| quantity(vec![point.x, point.y])).collect();
    let outputs = mechanism.outputs.iter().map(|output| quantity(vec![output.value])).collect();
    Derivation { coordinates, unknowns, inputs, residual, sizes, jacobian, determinant, gamma, points, outputs, graph }
}

fn jacobian(graph: &mut Graph, rows: &[NodeId], coordinates: &[Coordinate]) -> Vec<Vec<NodeId>> {
    let columns: Vec<_> = coordinates.iter().map(|coordinate| graph.partial(rows, coordinate.value)).collect();
    (0..rows.len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect()
}

/// q -> q'.
fn along_rates(graph: &mut Graph, coordinates: &[Coordinate]) -> BTreeMap<SymbolId, NodeId> {
    coordinates.iter().map(|coordinate| (coordinate.value, graph.variable(coordinate.rate))).collect()
}

fn quantity(graph: &mut Graph, value: Vec<NodeId>, coordinates: &[Coordinate]) -> Quantity {
    let jacobian = jacobian(graph, &value, coordinates);
    let mut seeds = along_rates(graph, coordinates);
    let rate = graph.differentiate(&value, &seeds);
    for coordinate in coordinates {
        seeds.insert(coordinate.rate, graph.variable(coordinate.acceleration));
    }
    let acceleration = graph.differentiate(&rate, &seeds);
    Quantity { value, jacobian, rate, acceleration }
}

impl Derivation {
    /// J, the columns of the unknowns.
    #[must_use]
    pub fn jacobian_unknowns(&self) -> Vec<Vec<NodeId>> {
        self.columns(&self.unknowns)
    }

    /// A, the columns of the inputs.
    #[must_use]
    pub fn jacobian_inputs(&self) -> Vec<Vec<NodeId>> {
        self.columns(&self.inputs)
    }

    fn columns(&self, columns: &[usize]) -> Vec<Vec<NodeId>> {
        self.jacobian.iter().map(|row| columns.iter().map(|&column| row[column]).collect()).collect()
    }

    /// -A e_j: the right side of J W_j = -A e_j.
    pub fn ratio_side(&mut self, input: usize) -> Vec<NodeId> {
        let column = self.inputs[input];
        let entries: Vec<_> = self.jacobian.iter().map(|row| row[column]).collect();
        entries.into_iter().map(|entry| self.graph.negate(entry)).collect()
    }

    /// -A v': the right side of J u' = -A v'.
    pub fn velocity_side(&mut self) -> Vec<NodeId> {
        let rates = self.inputs.iter().map(|&input| self.coordinates[input].rate).collect::<Vec<_>>();
        (0..self.residual.len()).map(|row| self.minus_inputs(row, &rates, None)).collect()
    }

    /// -(A v'' + gamma): the right side of J u'' = -(A v'' + gamma).
    pub fn acceleration_side(&mut self) -> Vec<NodeId> {
        let rates = self.inputs.iter().map(|&input| self.coordinates[input].acceleration).collect::<Vec<_>>();
        (0..self.residual.len()).map(|row| self.minus_inputs(row, &rates, Some(self.gamma[row]))).collect()
    }

    fn minus_inputs(&mut self, row: usize, inputs: &[SymbolId], plus: Option<NodeId>) -> NodeId {
        let mut terms: Vec<_> = plus.map(|term| (Number::MINUS_ONE, term)).into_iter().collect();
        for (&column, &symbol) in self.inputs.iter().zip(inputs) {
            let rate = self.graph.variable(symbol);
            let term = self.graph.multiply(self.jacobian[row][column], rate);
            terms.push((Number::MINUS_ONE, term));
        }
        self.graph.sum(&terms)
    }
}
