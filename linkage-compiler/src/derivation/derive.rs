//! The derivation of a mechanism with one driver.

use std::collections::BTreeMap;

use super::angles::angles;
use super::data::{Coordinate, Derivation, Determinant, Group, Implied, Quantity};
use super::jacobian::{along_rates, jacobian, places_of};
use super::joints::Joints;
use super::linear::Row;
use super::skeleton::Skeleton;
use super::{ratios, scale};
use crate::algebra::{self, simplify};
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::{ColumnId, CoordinateId, GroupId, Id, InputId, RowId, Table, UnknownId};
use crate::model::{Driver, Mechanism, Request};
use crate::structure::{self, Class, GroupKind, Method};

/// Derives a checked mechanism, which can be solved in the order of the groups of its driver.
#[must_use]
pub fn derive(mechanism: &Mechanism, driver: &Driver) -> Derivation {
    let groups = driver.system.groups.clone();
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

    let residual = driver.system.rows.clone();
    let place_of = places_of(&coordinates, |c| c.value);
    let jacobian = Table::from(jacobian(&mut graph, &residual, &place_of));
    let residual_scales = residual.iter().map(|&row| scale::of(&mut graph, row)).collect();
    let implied = implied(&mut graph, mechanism);
    // gamma = (Psi_q q')_q q': the derivative along q' of Psi' with q' held.
    let rates = along_rates(&mut graph, &coordinates);
    let psi_rate = graph.differentiate(&residual, &rates);
    let gamma = graph.differentiate(&psi_rate, &rates).into();

    let is_odd = structure::is_odd(&groups);
    let mut parts = Table::default();
    for group in groups {
        let symbols: Vec<SymbolId> = group.unknowns.iter().map(|&index| coordinates[unknowns[index]].value).collect();
        let class = Class::of(&mut graph, &residual.at(&group.equations), &symbols);
        let determinant = determinant(&mut graph, &jacobian, &unknowns, &group);
        parts.push((group, class, determinant));
    }
    let groups = with_names(&mut graph, parts);
    let ratios = ratios::names(&mut graph, &coordinates, &unknowns, &inputs);
    // A pose holds the sines and cosines of the loop equations.
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
        residual_scales,
        implied,
        jacobian,
        groups,
        is_odd,
        ratios,
        gamma,
        points,
        outputs,
        eta: None,
        ratio_derivatives: None,
        sensitivity: None,
        skeleton: None,
        scenes: Vec::new(),
        ranges_of_turns: mechanism.ranges_of_turns(driver),
        counted_by_ranges: mechanism.counted_by_ranges(),
        graph,
    };
    for request in &mechanism.requests {
        match request {
            // Limits are derived from the assembly when they are emitted; lanes have the formulas of `kinematics`, and
            // intervals those of Psi and its derivatives; `serde` changes types only. A sheet is derived apart from all
            // else, for its document.
            Request::Limits
            | Request::Lanes
            | Request::Serde
            | Request::Fpcore
            | Request::Intervals
            | Request::Sheet => {}
            Request::Drawing => {
                derivation.skeleton = Some(Skeleton::of(mechanism, driver, &mut derivation.graph));
            }
            Request::Jerk => derivation.derive_jerk(),
            Request::VelocityRatioDerivatives => derivation.derive_ratio_derivatives(),
            Request::Sensitivity => derivation.derive_sensitivity(mechanism),
        }
    }
    derivation.derive_scenes(mechanism, driver);
    derivation.find_joints(mechanism);
    derivation
}

impl Derivation {
    /// Finds the joints of the dyads of two links.
    fn find_joints(&mut self, mechanism: &Mechanism) {
        let (unknowns, coordinates) = (&self.unknowns, &self.coordinates);
        for group in self.groups.iter_mut().filter(|group| group.kind == GroupKind::Rrr) {
            if let &[first, second] = group.unknowns.as_slice() {
                let angles = [first, second].map(|unknown| coordinates[unknowns[unknown]].value);
                group.joints = Joints::of(mechanism, &mut self.graph, angles);
            }
        }
    }
}

/// The rows of implied loops and equations, named by their number and by the first line of their doc comment.
fn implied(graph: &mut Graph, mechanism: &Mechanism) -> Vec<Implied> {
    let mut all = Vec::new();
    for (index, constraint) in mechanism.implied.iter().enumerate() {
        let kind = if constraint.rows.len() == 2 { "loop" } else { "equation" };
        let mut name = format!("implied {kind} {}", index + 1);
        if let Some(text) = constraint.description().get(1) {
            name = format!("{name} ({})", text.trim_end_matches('.'));
        }
        all.extend(constraint.rows.iter().map(|&residual| {
            let scale = scale::of(graph, residual);
            Implied { name: name.clone(), residual, scale }
        }));
    }
    all
}

/// The determinant of a group in closed form, and its scale.
fn determinant(
    graph: &mut Graph,
    jacobian: &Table<RowId, Row<ColumnId>>,
    unknowns: &Table<UnknownId, ColumnId>,
    group: &structure::Group,
) -> Option<(NodeId, NodeId)> {
    let zero = graph.zero();
    let entry = |row: usize, column: usize| {
        jacobian[group.equations[row]].get(&unknowns[group.unknowns[column]]).copied().unwrap_or(zero)
    };
    (group.method() == Method::ClosedForm).then(|| {
        let value = match group.unknowns.len() {
            1 => entry(0, 0),
            _ => algebra::determinant(graph, [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]),
        };
        (value, scale::of_determinant(graph, value))
    })
}

/// A group with the value and the scale of its determinant, which has no name yet.
type Unnamed = (structure::Group, Class, Option<(NodeId, NodeId)>);

/// Names the determinants of groups: `determinant` if only one varies, else with the numbers of their groups.
fn with_names(graph: &mut Graph, parts: Table<GroupId, Unnamed>) -> Table<GroupId, Group> {
    let is_variable = |graph: &Graph, value: NodeId| graph.constant_value(value).is_none();
    let values = parts.iter().filter_map(|(_, _, determinant)| Some(determinant.as_ref()?.0));
    let is_single = values.filter(|&value| is_variable(graph, value)).count() == 1;
    let named = parts.ids().zip(parts).map(|(id, (group, class, determinant))| {
        let structure::Group { equations, unknowns, slide } = group;
        let determinant = determinant.map(|(value, scale)| {
            let is_only = is_single && is_variable(graph, value);
            let name = if is_only { "determinant".to_owned() } else { format!("determinant_{}", id.number()) };
            Determinant { value, symbol: graph.symbol(name), scale }
        });
        let Class { kind, mirrored } = class;
        Group { equations, unknowns, kind, mirrored, slide, joints: None, determinant }
    });
    named.collect()
}

/// Points or outputs with their derivatives, from the values of their components.
fn quantities(
    graph: &mut Graph,
    values: Vec<Vec<NodeId>>,
    coordinates: &Table<ColumnId, Coordinate>,
    indices: &BTreeMap<SymbolId, ColumnId>,
) -> Vec<Quantity> {
    let rows: Vec<NodeId> = values.concat();
    let mut jacobian = jacobian(graph, &rows, indices).into_iter();
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
