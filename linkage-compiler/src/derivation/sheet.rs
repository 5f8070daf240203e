//! The formulas of an analysis by hand: time derivatives of J and A, the terms of `Psi''` by parts, the accelerations in two
//! ways, the vectors that lead to points, and the condition of singularity for every choice of inputs.
//!
//! `Psi' = J u' + A v'`, so that `Psi'' = J u'' + A v'' + J' u' + A' v'`. By the chain rule
//!
//! - J' = (J u')_u + (A v')_u, and A' = (J u')_v + (A v')_v;
//! - gamma = J' u' + A' v' = `gamma_u` + `gamma_uv` + `gamma_v`, where `gamma_u` = (J u')_u u' is quadratic in u', `gamma_v` =
//!   (A v')_v v' in v', and `gamma_uv` = (J u')_v v' + (A v')_u u' bilinear;
//! - `u'' = -J^-1 (H1 + H2 + H3)` with `H1 = A v''`, `H2 = J' (W v')`, `H3 = A' v'`, and `u'' = -J^-1 (A v'' + gamma)`. Their
//!   difference is J^-1 J' (u' - W v'), which is zero.

use std::collections::BTreeMap;

use super::data::Derivation;
use super::jacobian::jacobian;
use super::linear::Row;
use crate::algebra;
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};
use crate::ids::{ColumnId, Id, InputId, RowId, Table, UnknownId};
use crate::model::{Chain, Link, Mechanism};
use crate::structure;

/// The formulas of a driver with groups of at most two unknowns.
#[derive(Debug, Clone)]
pub struct Sheet {
    /// J' and A'.
    pub jacobian_rates: (Table<RowId, Row<UnknownId>>, Table<RowId, Row<InputId>>),
    /// (J u')_u and (A v')_v.
    pub jacobians_of_rates: (Table<RowId, Row<UnknownId>>, Table<RowId, Row<InputId>>),
    /// `gamma_u`, `gamma_v` and `gamma_uv`.
    pub gamma: [Table<RowId, NodeId>; 3],
    /// H1, H2, H3 and their sum H0.
    pub terms: [Table<RowId, NodeId>; 4],
    /// `u''` by both methods.
    pub accelerations: [Table<UnknownId, NodeId>; 2],
    /// The choices of inputs.
    pub choices: Vec<DriverChoice>,
    /// The angles that turn, each with its rate and acceleration.
    pub turning: Vec<Turning>,
    /// The vectors that lead to each point, from the origin; none if it is not written as a sum of vectors.
    pub points: Vec<Vec<PolarVector>>,
}

/// A choice of inputs and the determinant of J in the other coordinates.
#[derive(Debug, Clone)]
pub struct DriverChoice {
    pub inputs: Vec<ColumnId>,
    /// None if it has no formula; zero if these inputs do not determine a position.
    pub determinant: Option<NodeId>,
}

/// The rate and acceleration of a link that turns.
#[derive(Debug, Clone)]
pub struct Turning {
    /// The coordinates that turn it.
    pub with: Vec<ColumnId>,
    pub rate: NodeId,
    pub acceleration: NodeId,
}

/// A vector z@phi with its derivatives.
#[derive(Debug, Clone)]
pub struct PolarVector {
    pub vector: [NodeId; 2],
    /// [cos phi, -z sin phi; sin phi, z cos phi] by rows.
    pub matrix: [[NodeId; 2]; 2],
    /// z' and phi'.
    pub rates: [NodeId; 2],
    pub velocity: [NodeId; 2],
    pub acceleration: [NodeId; 2],
}

/// The most choices of inputs that are listed.
const MOST_CHOICES: usize = 64;

/// The coordinates of the derivatives, with their rates and accelerations.
struct Moving {
    unknowns: BTreeMap<SymbolId, NodeId>,
    inputs: BTreeMap<SymbolId, NodeId>,
    /// q to `q'`, and `q'` to `q''`.
    all: BTreeMap<SymbolId, NodeId>,
}

impl Sheet {
    /// Derives the formulas; they need the velocity ratios of all unknowns.
    #[must_use]
    pub fn of(derivation: &mut Derivation, mechanism: &Mechanism) -> Self {
        let moving = derivation.moving();
        let (in_unknowns, in_inputs) = (derivation.jacobian_unknowns(), derivation.jacobian_inputs());
        let [unknown_rates, input_rates] = [&*derivation.unknowns, &*derivation.inputs].map(|columns| {
            let rates = columns.iter().map(|&column| derivation.coordinates[column].rate);
            rates.collect::<Vec<SymbolId>>()
        });
        let graph = &mut derivation.graph;
        let rates: (Table<UnknownId, NodeId>, Table<InputId, NodeId>) = (
            unknown_rates.into_iter().map(|rate| graph.variable(rate)).collect(),
            input_rates.into_iter().map(|rate| graph.variable(rate)).collect(),
        );
        let jacobian_rates = (row_rates(graph, &in_unknowns, &moving.all), row_rates(graph, &in_inputs, &moving.all));
        // J u' and A v'.
        let by_unknowns: Vec<NodeId> = in_unknowns.iter().map(|row| dot(graph, row, &rates.0)).collect();
        let by_inputs: Vec<NodeId> = in_inputs.iter().map(|row| dot(graph, row, &rates.1)).collect();
        let value = |column: &ColumnId| derivation.coordinates[*column].value;
        let places: BTreeMap<SymbolId, UnknownId> =
            derivation.unknowns.enumerated().map(|(unknown, column)| (value(column), unknown)).collect();
        let input_places: BTreeMap<SymbolId, InputId> =
            derivation.inputs.enumerated().map(|(input, column)| (value(column), input)).collect();
        let jacobians_of_rates =
            (jacobian(graph, &by_unknowns, &places).into(), jacobian(graph, &by_inputs, &input_places).into());
        let gamma_unknowns = graph.differentiate(&by_unknowns, &moving.unknowns);
        let gamma_inputs = graph.differentiate(&by_inputs, &moving.inputs);
        let mixed =
            [graph.differentiate(&by_unknowns, &moving.inputs), graph.differentiate(&by_inputs, &moving.unknowns)];
        let mixed = mixed[0].iter().zip(&mixed[1]).map(|(&one, &other)| graph.add(one, other)).collect();
        let gamma = [gamma_unknowns.into(), gamma_inputs.into(), mixed];

        let ratios = derivation.ratio_formulas();
        let graph = &mut derivation.graph;
        let zero = graph.zero();
        // W v', with the formulas of W.
        let through_ratios: Table<UnknownId, NodeId> = derivation
            .unknowns
            .ids()
            .map(|unknown| {
                let terms: Vec<_> = ratios
                    .iter()
                    .zip(&rates.1)
                    .map(|(of_input, &rate)| (Number::ONE, graph.multiply(of_input[unknown].unwrap_or(zero), rate)))
                    .collect();
                graph.sum(&terms)
            })
            .collect();
        let input_accelerations: Table<InputId, NodeId> =
            derivation.inputs.iter().map(|&input| graph.variable(derivation.coordinates[input].acceleration)).collect();
        let driven: Table<RowId, NodeId> = in_inputs.iter().map(|row| dot(graph, row, &input_accelerations)).collect();
        let by_jacobian = jacobian_rates.0.iter().map(|row| dot(graph, row, &through_ratios)).collect();
        let by_input_jacobian = jacobian_rates.1.iter().map(|row| dot(graph, row, &rates.1)).collect();
        let parts: [Table<RowId, NodeId>; 3] = [driven, by_jacobian, by_input_jacobian];
        let sum: Table<RowId, NodeId> = derivation
            .residual
            .ids()
            .map(|row| graph.sum(&parts.each_ref().map(|part| (Number::ONE, part[row]))))
            .collect();
        let first = sum.iter().map(|&side| graph.negate(side)).collect();
        let gamma_of = derivation.gamma.clone();
        let second =
            derivation.residual.ids().map(|row| derivation.minus_inputs(row, |c| c.acceleration, Some(gamma_of[row])));
        let second: Table<RowId, NodeId> = second.collect();
        let accelerations = [first, second].map(|side| derivation.accelerations_of(side));
        let [driven, by_jacobian, by_input_jacobian] = parts;
        Self {
            jacobian_rates,
            jacobians_of_rates,
            gamma,
            terms: [driven, by_jacobian, by_input_jacobian, sum],
            accelerations,
            choices: derivation.choices(),
            turning: derivation.turning(mechanism, &moving),
            points: mechanism.points.iter().map(|point| derivation.vectors(mechanism, &point.chain, &moving)).collect(),
        }
    }
}

impl Derivation {
    fn moving(&mut self) -> Moving {
        let mut moving = Moving { unknowns: BTreeMap::new(), inputs: BTreeMap::new(), all: BTreeMap::new() };
        for (columns, part) in [(&*self.unknowns, &mut moving.unknowns), (&*self.inputs, &mut moving.inputs)] {
            for &column in columns {
                let coordinate = &self.coordinates[column];
                let rate = self.graph.variable(coordinate.rate);
                part.insert(coordinate.value, rate);
                moving.all.insert(coordinate.value, rate);
                moving.all.insert(coordinate.rate, self.graph.variable(coordinate.acceleration));
            }
        }
        moving
    }

    /// The solution of `J u'' = side`, by formulas of each group in terms of the accelerations of earlier ones.
    fn accelerations_of(&mut self, side: Table<RowId, NodeId>) -> Table<UnknownId, NodeId> {
        let names = self.unknowns.iter().map(|&unknown| self.coordinates[unknown].acceleration).collect();
        let (formulas, _) = self.solution_formulas(&(side, names));
        let zero = self.graph.zero();
        formulas.iter().map(|formula| without_minus(&mut self.graph, formula.unwrap_or(zero))).collect()
    }

    /// All choices of as many inputs, this one first; if there are many, those with one input exchanged for an unknown.
    fn choices(&mut self) -> Vec<DriverChoice> {
        let order: Vec<ColumnId> = self.unknowns.iter().chain(&self.inputs).copied().collect();
        let own: Vec<ColumnId> = self.inputs.iter().copied().collect();
        let exchanged = |inputs: &Vec<ColumnId>| inputs.iter().filter(|input| !own.contains(input)).count();
        let mut all = combinations(&order, own.len()).unwrap_or_else(|| {
            let exchanges = (0..own.len()).flat_map(|place| self.unknowns.iter().map(move |&unknown| (place, unknown)));
            let exchange = |(place, unknown)| {
                let mut inputs = own.clone();
                inputs[place] = unknown;
                inputs
            };
            std::iter::once(own.clone()).chain(exchanges.map(exchange)).collect()
        });
        all.sort_by_key(exchanged);
        let of_choice = |inputs: Vec<ColumnId>| {
            let rest: Vec<ColumnId> = order.iter().copied().filter(|column| !inputs.contains(column)).collect();
            DriverChoice { determinant: self.determinant_of(&rest), inputs }
        };
        all.into_iter().map(of_choice).collect()
    }

    /// The determinant of these columns of Psi_q, zero if it is zero at all positions; none if it has no formula.
    fn determinant_of(&mut self, columns: &[ColumnId]) -> Option<NodeId> {
        let incidence: Table<RowId, Vec<UnknownId>> = self
            .jacobian
            .iter()
            .map(|row| {
                let places = columns.iter().enumerate().filter(|(_, column)| row.contains_key(column));
                places.map(|(place, _)| UnknownId::new(place)).collect()
            })
            .collect();
        let zero = self.graph.zero();
        let Ok(groups) = structure::order(&incidence, columns.len()) else { return Some(zero) };
        let mut product = Vec::new();
        for group in &groups {
            let entry = |row: usize, column: usize| {
                let column = columns[group.unknowns[column].index()];
                self.jacobian[group.equations[row]].get(&column).copied().unwrap_or(zero)
            };
            product.push((
                match group.unknowns.len() {
                    1 => entry(0, 0),
                    2 => {
                        let matrix = [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]];
                        algebra::determinant(&mut self.graph, matrix)
                    }
                    _ => return None,
                },
                1,
            ));
        }
        let product = self.graph.product(&product);
        Some(if structure::is_odd(&groups) { self.graph.negate(product) } else { product })
    }

    /// The different rates of the angles of vectors.
    fn turning(&mut self, mechanism: &Mechanism, moving: &Moving) -> Vec<Turning> {
        let chains = mechanism.loops.iter().flatten().chain(mechanism.points.iter().map(|point| &point.chain));
        let angles = chains.flat_map(|chain| &chain.links).filter_map(|link| link.angle);
        let mut all: Vec<Turning> = Vec::new();
        for angle in angles {
            let rate = self.graph.differentiate(&[angle], &moving.all)[0];
            if self.graph.is_zero(rate) || all.iter().any(|other| other.rate == rate) {
                continue;
            }
            let symbols = self.graph.symbols_of(&[angle]);
            let with = self.coordinates.enumerated().filter(|(_, one)| symbols.contains(&one.value));
            let with = with.map(|(column, _)| column).collect();
            all.push(Turning { with, rate, acceleration: self.graph.differentiate(&[rate], &moving.all)[0] });
        }
        all
    }

    /// The vectors of a chain from the origin; none if one of them is written in another way.
    fn vectors(&mut self, mechanism: &Mechanism, chain: &Chain, moving: &Moving) -> Vec<PolarVector> {
        let mut links = chain.links.clone();
        let mut start = chain.start;
        // A point starts from one that is declared before it.
        for _ in 0..mechanism.points.len() {
            let Some([x, y]) = start else { break };
            let Some(from) = mechanism.points.iter().find(|point| (point.x, point.y) == (x, y)) else {
                return Vec::new();
            };
            links.splice(0..0, from.chain.links.iter().copied());
            start = from.chain.start;
        }
        let polar: Option<Vec<Vec<[NodeId; 2]>>> = links.iter().map(|link| polar(&mut self.graph, link)).collect();
        polar.into_iter().flatten().flatten().map(|polar| self.polar_vector(polar, moving)).collect()
    }

    fn polar_vector(&mut self, [length, angle]: [NodeId; 2], moving: &Moving) -> PolarVector {
        let graph = &mut self.graph;
        let (cosine, sine) = (graph.call(Function::Cos, &[angle]), graph.call(Function::Sin, &[angle]));
        let vector = [graph.multiply(length, cosine), graph.multiply(length, sine)];
        let matrix = [[cosine, graph.negate(vector[1])], [sine, vector[0]]];
        let [rates, velocity] = [[length, angle], vector].map(|of| graph.differentiate(&of, &moving.all));
        let acceleration = graph.differentiate(&velocity, &moving.all);
        let pair = |of: Vec<NodeId>| [of[0], of[1]];
        PolarVector { vector, matrix, rates: pair(rates), velocity: pair(velocity), acceleration: pair(acceleration) }
    }
}

/// A product with a minus and a sum of negative terms without either.
fn without_minus(graph: &mut Graph, node: NodeId) -> NodeId {
    let Node::Product { coefficient, mut factors } = graph.node(node).clone() else { return node };
    let is_negative = |(base, exponent): &(NodeId, i32)| match graph.node(*base) {
        Node::Sum { constant, terms } => {
            *exponent == 1 && constant.is_zero() && terms.iter().all(|(coefficient, _)| coefficient.is_negative())
        }
        _ => false,
    };
    let Some(place) = factors.iter().position(is_negative).filter(|_| coefficient.is_negative()) else { return node };
    factors[place].0 = graph.negate(factors[place].0);
    let product = graph.product(&factors);
    graph.scale(coefficient.negate(), product)
}

/// A vector as lengths at angles; none if it is not written as `r@angle`, `(x, y)@angle` or `(x, y)`.
fn polar(graph: &mut Graph, link: &Link) -> Option<Vec<[NodeId; 2]>> {
    let [along, across] = link.parts?;
    let angle = link.angle.unwrap_or_else(|| graph.zero());
    let half = Number::integer(2).power(-1);
    let pi = graph.pi();
    let quarter = graph.scale(half, pi);
    let normal = graph.add(angle, quarter);
    let parts = [[along, angle], [across, normal]].into_iter().filter(|[length, _]| !graph.is_zero(*length));
    let parts: Vec<[NodeId; 2]> = parts.collect();
    let signed = |[length, angle]: [NodeId; 2]| [if link.is_reversed { graph.negate(length) } else { length }, angle];
    Some(parts.into_iter().map(signed).collect())
}

/// The derivatives of the entries of a matrix.
fn row_rates<C: Id + Ord>(
    graph: &mut Graph,
    rows: &Table<RowId, Row<C>>,
    seeds: &BTreeMap<SymbolId, NodeId>,
) -> Table<RowId, Row<C>> {
    rows.iter()
        .map(|row| {
            let entries: Vec<NodeId> = row.values().copied().collect();
            let rates = graph.differentiate(&entries, seeds);
            let nonzero = row.keys().copied().zip(rates).filter(|(_, rate)| !graph.is_zero(*rate));
            nonzero.collect()
        })
        .collect()
}

/// A row times a column.
fn dot<C: Id + Ord>(graph: &mut Graph, row: &Row<C>, column: &Table<C, NodeId>) -> NodeId {
    let terms: Vec<_> =
        row.iter().map(|(&place, &entry)| (Number::ONE, graph.multiply(entry, column[place]))).collect();
    graph.sum(&terms)
}

/// The sets of so many of these columns, in order; none if they are more than [`MOST_CHOICES`].
fn combinations(of: &[ColumnId], count: usize) -> Option<Vec<Vec<ColumnId>>> {
    let mut sets: Vec<Vec<usize>> = vec![Vec::new()];
    for chosen in 0..count {
        // The last place of a set leaves room for those to come.
        let last = of.len() - (count - chosen);
        let longer = sets.iter().flat_map(|set| {
            let first = set.last().map_or(0, |last| last + 1);
            (first..=last).map(|next| [set.as_slice(), &[next]].concat())
        });
        sets = longer.take(MOST_CHOICES + 1).collect();
        if sets.len() > MOST_CHOICES {
            return None;
        }
    }
    Some(sets.into_iter().map(|set| set.into_iter().map(|place| of[place]).collect()).collect())
}
