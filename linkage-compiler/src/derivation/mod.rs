//! What follows from the closures Psi(q) = 0: Jacobians, determinant, velocity ratios,
//! the quadratic velocity term, and the same for points and outputs.
//!
//! Rates and accelerations of the coordinates are names of their own and are never replaced
//! by formulas: substituting them is what makes symbolic tools swell.

mod assembly;
mod check;
mod contacts;
mod equilibrium;
mod formulas;
mod iteration;
mod jerk;
mod limits;
mod linear;
mod magnitude;
mod ratio_derivatives;
mod ratios;
mod reactions;
mod scene;
mod sensitivity;
mod solution;
mod step;
mod unreduced;

use std::collections::{BTreeMap, BTreeSet};

use crate::algebra::{self, simplify};
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};
use crate::ids::{BlockId, ColumnId, CoordinateId, Id, InputId, PairId, ParameterId, RowId, Table, UnknownId};
use crate::model::{Driver, Mechanism, Request};
use crate::structure::{self, Group, Method};
pub use assembly::{Assembly, Choice, Chord};
pub use check::{LARGEST, check, check_numbers, matrices};
pub use contacts::{Contact, ContactFormula};
pub use equilibrium::Equilibrium;
pub use formulas::{Formulas, Inverse, QuantityFormulas};
pub use limits::Bound;
pub use linear::{Form, solve_closed};
pub use ratio_derivatives::RatioDerivatives;
pub use reactions::Reactions;
pub use scene::{Prescribed, Scene};
pub use sensitivity::Sensitivity;
pub use step::{ChordOf, Step, needed, needed_names};

/// The derivatives of one scalar by coordinates or parameters; those not named are zero.
pub type Row<Column> = BTreeMap<Column, NodeId>;

/// The solutions x of several systems J x = r.
pub type Solutions<I, X> = Table<I, Table<UnknownId, X>>;

/// J x = r: r, and the names of x.
pub type System = (Table<RowId, NodeId>, Table<UnknownId, SymbolId>);

/// A coordinate with the names of its velocity, acceleration and jerk.
#[derive(Debug, Clone)]
pub struct Coordinate {
    pub name: String,
    pub value: SymbolId,
    pub rate: SymbolId,
    pub acceleration: SymbolId,
    pub jerk: SymbolId,
}

/// A point or an output with all that is derived from it.
#[derive(Debug, Clone)]
pub struct Quantity {
    /// x and y of a point, the one value of an output.
    pub value: Vec<NodeId>,
    /// d value / d q, one row a component.
    pub jacobian: Vec<Row<ColumnId>>,
    /// In terms of q and q'.
    pub rate: Vec<NodeId>,
    /// In terms of q, q' and q''.
    pub acceleration: Vec<NodeId>,
    /// In terms of q to q'''; like the rest, empty unless asked for.
    pub jerk: Vec<NodeId>,
    /// (l_q w_j)_q w_k, by pair of inputs and component, in terms of q and W.
    pub along_inputs: Table<PairId, Vec<NodeId>>,
    /// l_p, one row a component.
    pub by_parameters: Vec<Row<ParameterId>>,
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

/// Unknowns that are solved together, once all blocks before are solved.
#[derive(Debug, Clone)]
pub struct Block {
    pub equations: Vec<RowId>,
    pub unknowns: Vec<UnknownId>,
    pub group: Group,
    /// Of a block in closed form.
    pub determinant: Option<Determinant>,
}

/// Everything derived from one mechanism with one choice of independent coordinates.
#[derive(Debug, Clone)]
pub struct Derivation {
    pub graph: Graph,
    pub coordinates: Table<ColumnId, Coordinate>,
    /// The columns of [`Derivation::jacobian`] that are u and v.
    pub unknowns: Table<UnknownId, ColumnId>,
    pub inputs: Table<InputId, ColumnId>,
    /// Psi.
    pub residual: Table<RowId, NodeId>,
    /// The sum of the magnitudes of each closure's terms: what "small residual" is measured by.
    pub sizes: Table<RowId, NodeId>,
    /// Psi_q.
    pub jacobian: Table<RowId, Row<ColumnId>>,
    pub blocks: Table<BlockId, Block>,
    /// Whether det J is the negative of the product of the determinants of the blocks.
    pub is_odd: bool,
    /// The names of W.
    pub ratios: Solutions<InputId, SymbolId>,
    /// (Psi_q q')_q q'.
    pub gamma: Table<RowId, NodeId>,
    pub points: Vec<Quantity>,
    pub outputs: Vec<Quantity>,
    /// What is left of Psi''' where no coordinate jerks; like what follows only if it is asked for.
    pub eta: Option<Table<RowId, NodeId>>,
    pub ratio_derivatives: Option<RatioDerivatives>,
    pub sensitivity: Option<Sensitivity>,
    /// Those of this driver.
    pub scenes: Vec<Scene>,
}

/// Derives a checked mechanism, whose closures can be solved in the order of the blocks of its driver.
#[must_use]
pub fn derive(mechanism: &Mechanism, driver: &Driver) -> Derivation {
    let blocks = driver.blocks.clone();
    let mut graph = mechanism.graph.clone();
    let order = mechanism.coordinate_order(driver);
    let columns: BTreeMap<CoordinateId, ColumnId> = order.enumerated().map(|(column, &id)| (id, column)).collect();
    let coordinates: Table<ColumnId, Coordinate> = order.map(|id| {
        let declared = &mechanism.coordinates[id];
        let name = declared.name.field.clone();
        Coordinate {
            value: declared.symbol,
            rate: declared.rate.unwrap_or_else(|| graph.symbol(format!("{name}_rate"))),
            acceleration: graph.symbol(format!("{name}_acceleration")),
            jerk: graph.symbol(format!("{name}_jerk")),
            name,
        }
    });
    let unknowns: Table<UnknownId, ColumnId> = driver.unknowns.iter().map(|id| columns[id]).collect();
    let inputs: Table<InputId, ColumnId> = driver.inputs.iter().map(|id| columns[id]).collect();

    let residual = mechanism.rows();
    let place_of = places_of(&coordinates, |c| c.value);
    let jacobian = Table::from(jacobian(&mut graph, &residual, &place_of));
    let sizes = residual.iter().map(|&row| magnitude::of(&mut graph, row)).collect();
    // gamma = (Psi_q q')_q q': the derivative along q' of Psi' with q' held.
    let rates = along_rates(&mut graph, &coordinates);
    let psi_rate = graph.differentiate(&residual, &rates);
    let gamma = graph.differentiate(&psi_rate, &rates).into();

    let is_odd = structure::is_odd(&blocks);
    let mut parts = Table::default();
    for block in blocks {
        let symbols: Vec<SymbolId> = block.unknowns.iter().map(|&place| coordinates[unknowns[place]].value).collect();
        let group = Group::of(&mut graph, &residual.at(&block.equations), &symbols);
        let determinant = determinant(&mut graph, &jacobian, &unknowns, &block);
        parts.push((block, group, determinant));
    }
    let blocks = with_names(&mut graph, parts);
    let ratios = ratios::names(&mut graph, &coordinates, &unknowns, &inputs);
    // A pose has the directions of the closures at hand.
    let given = angles(&graph, &residual);
    let outputs: Vec<NodeId> = mechanism.outputs.iter().map(|output| output.value).collect();
    let outputs: Vec<NodeId> = outputs.into_iter().map(|output| simplify(&mut graph, &[output], &given)[0]).collect();
    let mut values: Vec<Vec<NodeId>> = mechanism.points.iter().map(|point| vec![point.x, point.y]).collect();
    values.extend(outputs.into_iter().map(|output| vec![output]));
    let mut points = quantities(&mut graph, values, &coordinates, &place_of);
    let outputs = points.split_off(mechanism.points.len());
    let mut derivation = Derivation {
        coordinates,
        unknowns,
        inputs,
        residual,
        sizes,
        jacobian,
        blocks,
        is_odd,
        ratios,
        gamma,
        points,
        outputs,
        eta: None,
        ratio_derivatives: None,
        sensitivity: None,
        scenes: Vec::new(),
        graph,
    };
    for request in &mechanism.requests {
        match request {
            // These follow from the position, when it is emitted.
            Request::Limits => {}
            Request::Jerk => derivation.derive_jerk(),
            Request::VelocityRatioDerivatives => derivation.derive_ratio_derivatives(),
            Request::Sensitivity => derivation.derive_sensitivity(mechanism),
        }
    }
    derivation.derive_scenes(mechanism, driver);
    derivation
}

/// The angles whose sines and cosines some expressions take.
fn angles(graph: &Graph, roots: &[NodeId]) -> BTreeSet<NodeId> {
    let angle = |id: NodeId| match graph.node(id) {
        Node::Call(Function::Sin | Function::Cos, angle) => Some(angle[0]),
        _ => None,
    };
    graph.reachable(roots).into_iter().filter_map(angle).collect()
}

/// The place of each symbol in a table.
fn places_of<I: Id, T>(table: &Table<I, T>, symbol: fn(&T) -> SymbolId) -> BTreeMap<SymbolId, I> {
    table.enumerated().map(|(place, entry)| (symbol(entry), place)).collect()
}

/// The determinant of a block in closed form and its size.
fn determinant(
    graph: &mut Graph,
    jacobian: &Table<RowId, Row<ColumnId>>,
    unknowns: &Table<UnknownId, ColumnId>,
    block: &structure::Block,
) -> Option<(NodeId, NodeId)> {
    let zero = graph.zero();
    let entry = |row: usize, column: usize| {
        jacobian[block.equations[row]].get(&unknowns[block.unknowns[column]]).copied().unwrap_or(zero)
    };
    (block.method() == Method::ClosedForm).then(|| {
        let value = match block.unknowns.len() {
            1 => entry(0, 0),
            _ => algebra::determinant(graph, [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]),
        };
        (value, magnitude::of_determinant(graph, value))
    })
}

/// A block with the value and the size of its determinant, which has no name yet.
type Unnamed = (structure::Block, Group, Option<(NodeId, NodeId)>);

/// Blocks with their determinants named: a mechanism with one determinant calls it so; of several each has the
/// number of its block.
fn with_names(graph: &mut Graph, parts: Table<BlockId, Unnamed>) -> Table<BlockId, Block> {
    let is_variable = |graph: &Graph, value: NodeId| graph.constant_value(value).is_none();
    let values = parts.iter().filter_map(|(_, _, determinant)| Some(determinant.as_ref()?.0));
    let is_single = values.filter(|&value| is_variable(graph, value)).count() == 1;
    let named = parts.ids().zip(parts).map(|(id, (block, group, determinant))| {
        let structure::Block { equations, unknowns } = block;
        let determinant = determinant.map(|(value, size)| {
            let is_only = is_single && is_variable(graph, value);
            let name = if is_only { "determinant".to_owned() } else { format!("determinant_{}", id.number()) };
            Determinant { value, symbol: graph.symbol(name), size }
        });
        Block { equations, unknowns, group, determinant }
    });
    named.collect()
}

/// The derivatives of some scalars by what has these places.
fn jacobian<C: Id + Ord>(graph: &mut Graph, rows: &[NodeId], places: &BTreeMap<SymbolId, C>) -> Vec<Row<C>> {
    // What rows have in common is derived once.
    let mut holders: BTreeMap<(SymbolId, C), Vec<usize>> = BTreeMap::new();
    for (index, &row) in rows.iter().enumerate() {
        for symbol in graph.symbols_of(&[row]) {
            if let Some(&place) = places.get(&symbol) {
                holders.entry((symbol, place)).or_default().push(index);
            }
        }
    }
    let mut jacobian = vec![Row::new(); rows.len()];
    for ((symbol, place), of) in holders {
        let held: Vec<NodeId> = of.iter().map(|&index| rows[index]).collect();
        for (index, entry) in of.into_iter().zip(graph.partial(&held, symbol)) {
            if !graph.is_zero(entry) {
                jacobian[index].insert(place, entry);
            }
        }
    }
    jacobian
}

/// The largest magnitudes that the entries of some rows could have.
fn sizes<C: Ord>(graph: &mut Graph, rows: Table<RowId, Row<C>>) -> Table<RowId, Row<C>> {
    rows.map(|row| row.into_iter().map(|(column, entry)| (column, magnitude::of(graph, entry))).collect())
}

/// A column with the opposite sign, as the right side of a system.
fn minus_column<C: Ord>(graph: &mut Graph, rows: &Table<RowId, Row<C>>, column: C) -> Table<RowId, NodeId> {
    let zero = graph.zero();
    rows.iter().map(|row| graph.negate(row.get(&column).copied().unwrap_or(zero))).collect()
}

/// q -> q'.
fn along_rates(graph: &mut Graph, coordinates: &Table<ColumnId, Coordinate>) -> BTreeMap<SymbolId, NodeId> {
    coordinates.iter().map(|coordinate| (coordinate.value, graph.variable(coordinate.rate))).collect()
}

/// Quantities by the values of their components.
fn quantities(
    graph: &mut Graph,
    values: Vec<Vec<NodeId>>,
    coordinates: &Table<ColumnId, Coordinate>,
    places: &BTreeMap<SymbolId, ColumnId>,
) -> Vec<Quantity> {
    let rows: Vec<NodeId> = values.concat();
    let mut jacobian = jacobian(graph, &rows, places).into_iter();
    let mut seeds = along_rates(graph, coordinates);
    let rates = graph.differentiate(&rows, &seeds);
    for coordinate in coordinates {
        seeds.insert(coordinate.rate, graph.variable(coordinate.acceleration));
    }
    let mut accelerations = graph.differentiate(&rates, &seeds).into_iter();
    let mut rates = rates.into_iter();
    let quantity = |value: Vec<NodeId>| Quantity {
        jacobian: jacobian.by_ref().take(value.len()).collect(),
        rate: rates.by_ref().take(value.len()).collect(),
        acceleration: accelerations.by_ref().take(value.len()).collect(),
        value,
        jerk: Vec::new(),
        along_inputs: Table::default(),
        by_parameters: Vec::new(),
    };
    values.into_iter().map(quantity).collect()
}

impl Block {
    /// The name of its branch: those of its unknowns.
    #[must_use]
    pub fn branch(&self, derivation: &Derivation) -> String {
        self.names(derivation).replace(", ", "_")
    }

    /// The names of the unknowns, by which errors name the block.
    #[must_use]
    pub fn names(&self, derivation: &Derivation) -> String {
        let name = |&place: &UnknownId| derivation.coordinates[derivation.unknowns[place]].name.as_str();
        self.unknowns.iter().map(name).collect::<Vec<_>>().join(", ")
    }
}

impl Quantity {
    /// direct + l_u x of a component with these derivatives.
    fn through_unknowns(
        graph: &mut Graph,
        direct: NodeId,
        row: &Row<ColumnId>,
        unknowns: &Table<UnknownId, ColumnId>,
        x: &Table<UnknownId, NodeId>,
    ) -> NodeId {
        let mut terms = vec![(Number::ONE, direct)];
        for (unknown, &x) in unknowns.iter().zip(x) {
            if let Some(&entry) = row.get(unknown) {
                terms.push((Number::ONE, graph.multiply(entry, x)));
            }
        }
        graph.sum(&terms)
    }
}

impl Derivation {
    /// J, the columns of the unknowns.
    #[must_use]
    pub fn jacobian_unknowns(&self) -> Table<RowId, Row<UnknownId>> {
        self.columns(&self.unknowns)
    }

    /// A, the columns of the inputs.
    #[must_use]
    pub fn jacobian_inputs(&self) -> Table<RowId, Row<InputId>> {
        self.columns(&self.inputs)
    }

    /// The largest magnitudes that the entries of J and of A could have.
    pub fn jacobian_sizes(&mut self) -> (Table<RowId, Row<UnknownId>>, Table<RowId, Row<InputId>>) {
        let (unknowns, inputs) = (self.jacobian_unknowns(), self.jacobian_inputs());
        (sizes(&mut self.graph, unknowns), sizes(&mut self.graph, inputs))
    }

    fn columns<C: Id + Ord>(&self, columns: &Table<C, ColumnId>) -> Table<RowId, Row<C>> {
        let new: BTreeMap<ColumnId, C> = columns.enumerated().map(|(new, &old)| (old, new)).collect();
        let row = |row: &Row<ColumnId>| row.iter().filter_map(|(old, &entry)| Some((*new.get(old)?, entry))).collect();
        self.jacobian.iter().map(row).collect()
    }

    /// -A e_j: the right side of J W_j = -A e_j.
    pub fn ratio_side(&mut self, input: InputId) -> Table<RowId, NodeId> {
        minus_column(&mut self.graph, &self.jacobian, self.inputs[input])
    }

    /// The systems J W_j = -A e_j.
    pub fn ratio_systems(&mut self) -> Table<InputId, System> {
        let ratios = self.ratios.clone();
        ratios.ids().zip(ratios).map(|(input, names)| (self.ratio_side(input), names)).collect()
    }

    /// -A v': the right side of J u' = -A v'.
    pub fn velocity_side(&mut self) -> Table<RowId, NodeId> {
        self.residual.ids().map(|row| self.minus_inputs(row, |c| c.rate, None)).collect()
    }

    /// -(A v'' + gamma): the right side of J u'' = -(A v'' + gamma).
    pub fn acceleration_side(&mut self) -> Table<RowId, NodeId> {
        self.residual.ids().map(|row| self.minus_inputs(row, |c| c.acceleration, Some(self.gamma[row]))).collect()
    }

    fn minus_inputs(&mut self, row: RowId, symbol: fn(&Coordinate) -> SymbolId, plus: Option<NodeId>) -> NodeId {
        let mut terms: Vec<_> = plus.map(|term| (Number::MINUS_ONE, term)).into_iter().collect();
        for &column in &self.inputs {
            if let Some(&entry) = self.jacobian[row].get(&column) {
                let rate = self.graph.variable(symbol(&self.coordinates[column]));
                terms.push((Number::MINUS_ONE, self.graph.multiply(entry, rate)));
            }
        }
        self.graph.sum(&terms)
    }

    /// What stays on the right of a block once the unknowns before it are known:
    /// r - J x, where `solved` holds x by the place of the unknown in q.
    pub fn remainder(&mut self, equation: RowId, right: NodeId, solved: &Row<ColumnId>) -> NodeId {
        let mut terms = vec![(Number::ONE, right)];
        for (column, entry) in &self.jacobian[equation] {
            if let Some(&x) = solved.get(column) {
                terms.push((Number::MINUS_ONE, self.graph.multiply(*entry, x)));
            }
        }
        self.graph.sum(&terms)
    }

    /// det J as the product of the determinants of the blocks, each by its formula; none if a block
    /// is not solved in closed form.
    pub fn determinant(&mut self) -> Option<NodeId> {
        let values: Option<Vec<NodeId>> =
            self.blocks.iter().map(|block| block.determinant.map(|determinant| determinant.value)).collect();
        let product: Vec<_> = values?.into_iter().map(|value| (value, 1)).collect();
        let product = self.graph.product(&product);
        Some(if self.is_odd { self.graph.negate(product) } else { product })
    }
}
