//! The document of an analysis by hand, line by line.

use linkage_ir::document::Entry;

use super::data::{
    DriverChoice, Equation, Matrix, PointVectors, SheetDerivation, SheetDocument, Turning, Vector, with,
};
use super::driver::Writer;
use super::layout::{LONGEST, Layout};
use super::name::{Name, names, texts};
use super::table::Node;
use crate::derivation::{self, Derivation, PolarVector, Row, Sheet};
use crate::graph::{NodeId, SymbolId};
use crate::ids::{ColumnId, Id, UnknownId};
use crate::model::{Driver, Mechanism};

/// A sheet is asked for its formulas: one of them may be as long as several lines of a document that all get.
const LONGEST_OF_SHEET: usize = 4 * LONGEST;

/// The document of the sheet of a driver. It is derived in a copy, so that all else is what it is without it.
#[must_use]
pub fn of_sheet(mechanism: &Mechanism, driver: &Driver, derivation: &Derivation) -> SheetDocument {
    let mut derivation = derivation.clone();
    derivation.graph.take_conditions();
    let sheet = Sheet::of(&mut derivation, mechanism);
    let conditions = derivation.graph.take_conditions();
    let derivation = &derivation;
    let (inputs, unknowns) = (texts(mechanism, &driver.inputs), texts(mechanism, &driver.unknowns));
    let names = names(mechanism, derivation, &inputs, &unknowns);
    let graph = &derivation.graph;
    let shown = |symbol: SymbolId| names.get(&symbol).copied().unwrap_or(Name::Plain(graph.symbol_name(symbol)));
    let mut writer = Writer {
        layout: Layout::new(graph, &shown).longest(LONGEST_OF_SHEET),
        derivation,
        parameters: &[],
        inputs: &inputs,
        unknowns: &unknowns,
    };
    let name_of = |column: ColumnId| match shown(derivation.coordinates[column].value) {
        Name::Plain(name) => name.to_owned(),
        _ => String::new(),
    };
    let (rows, inputs_count) = (unknowns.len(), inputs.len());
    let [gamma_u, gamma_v, gamma_uv] = &sheet.gamma;
    let [h1, h2, h3, h0] = &sheet.terms;
    let (vectors, of_points) = each_once(&sheet.points);
    let record = SheetDerivation {
        mechanism: driver.name.to_string(),
        jacobian_rates: [
            writer.matrix(Name::Rate("J"), None, &sheet.jacobian_rates.0, rows),
            writer.matrix(Name::Rate("A"), None, &sheet.jacobian_rates.1, inputs_count),
        ],
        jacobians_of_rates: [
            writer.matrix(Name::Plain("Hu_u"), None, &sheet.jacobians_of_rates.0, rows),
            writer.matrix(Name::Plain("Hv_v"), None, &sheet.jacobians_of_rates.1, inputs_count),
        ],
        terms: [("H1", h1), ("H2", h2), ("H3", h3), ("H0", h0)].map(|(name, of)| writer.column(name, of)),
        gamma: [("gamma_u", gamma_u), ("gamma_v", gamma_v), ("gamma_uv", gamma_uv)]
            .map(|(name, of)| writer.column(name, of)),
        accelerations: sheet.accelerations.each_ref().map(|all| {
            let equation =
                |(unknown, &node): (UnknownId, &NodeId)| writer.equation(Name::Acceleration(unknowns[unknown]), node);
            all.enumerated().map(equation).collect()
        }),
        choices: sheet
            .choices
            .iter()
            .map(|derivation::DriverChoice { inputs, determinant }| {
                let names: Vec<String> = inputs.iter().map(|&input| name_of(input)).collect();
                DriverChoice {
                    determinant: determinant.map(|node| {
                        let matrix = writer.plain(&format!("J_{}", names.join("_")));
                        Equation {
                            left: writer.layout.table.add(Node::Determinant(matrix)),
                            right: writer.formula(node),
                        }
                    }),
                    inputs: names.iter().map(|name| writer.plain(name)).collect(),
                }
            })
            .collect(),
        turning: sheet.turning.iter().map(|of| writer.turning(of, &name_of)).collect(),
        vectors: (1..).zip(&vectors).map(|(number, vector)| writer.vector(number, vector)).collect(),
        points: mechanism
            .points
            .iter()
            .zip(of_points)
            .filter(|(_, places)| !places.is_empty())
            .map(|(point, vectors)| writer.point(&point.name.text, vectors))
            .collect(),
        conditions: conditions.into_iter().map(|condition| writer.layout.condition(condition)).collect(),
    };
    with(record, writer.layout.table)
}

impl Writer<'_> {
    /// A matrix of one column.
    fn column(&mut self, name: &str, nodes: &[NodeId]) -> Matrix {
        self.dense(name, &nodes.iter().map(|&node| [node]).collect::<Vec<_>>())
    }

    /// A matrix by its rows, with the entries that are not zero.
    fn dense<const N: usize>(&mut self, name: &str, rows: &[[NodeId; N]]) -> Matrix {
        let rows: Vec<Row<ColumnId>> = rows
            .iter()
            .map(|row| {
                let entries = row.iter().enumerate().filter(|(_, node)| !self.derivation.graph.is_zero(**node));
                entries.map(|(column, &node)| (ColumnId::new(column), node)).collect()
            })
            .collect();
        self.matrix(Name::Plain(name), None, &rows, N)
    }

    /// The skew matrices of the rate and acceleration of a link.
    fn turning(&mut self, of: &derivation::Turning, name_of: &dyn Fn(ColumnId) -> String) -> Turning {
        let with: Vec<String> = of.with.iter().map(|&column| name_of(column)).collect();
        let ending = with.join("_");
        let mut skew = |name: &str, node: NodeId| {
            let number = self.formula(node);
            let minus = self.layout.table.add(Node::Sum(vec![(true, number)]));
            Matrix {
                name: self.plain(&format!("{name}_{ending}")),
                factor: None,
                rows: 2,
                columns: 2,
                entries: vec![Entry { row: 0, column: 1, value: minus }, Entry { row: 1, column: 0, value: number }],
            }
        };
        Turning { rate: skew("Omega", of.rate), acceleration: skew("alpha", of.acceleration), with }
    }

    fn vector(&mut self, number: usize, of: &PolarVector) -> Vector {
        Vector {
            vector: self.column(&format!("r{number}"), &of.vector),
            matrix: self.dense(&format!("M{number}"), &of.matrix),
            rates: self.column(&format!("w{number}"), &of.rates),
            velocity: self.column(&format!("v{number}"), &of.velocity),
            acceleration: self.column(&format!("a{number}"), &of.acceleration),
        }
    }

    /// A point as a sum of vectors, its velocity as a sum of matrices times rates, and its acceleration.
    fn point(&mut self, name: &str, vectors: Vec<usize>) -> PointVectors {
        let table = &mut self.layout.table;
        let mut named = |letter: &str, place: usize| table.plain(&format!("{letter}{}", place + 1));
        let [positions, accelerations] = ["r", "a"].map(|letter| {
            let terms = vectors.iter().map(|&place| (false, named(letter, place)));
            terms.collect::<Vec<_>>()
        });
        let factors: Vec<_> = vectors.iter().map(|&place| ["M", "w"].map(|letter| named(letter, place))).collect();
        let velocities = factors.into_iter().map(|pair| (false, table.product(pair.to_vec()))).collect();
        let sums =
            [(Name::Plain(name), positions), (Name::Rate(name), velocities), (Name::Acceleration(name), accelerations)];
        let sums = sums.map(|(left, terms)| Equation { left: table.name(left), right: table.sum(terms) });
        PointVectors { name: name.to_owned(), vectors, sums }
    }
}

/// The different vectors of all points, and their places for each point.
fn each_once(points: &[Vec<PolarVector>]) -> (Vec<PolarVector>, Vec<Vec<usize>>) {
    let mut all: Vec<PolarVector> = Vec::new();
    let places = points.iter().map(|vectors| {
        let place = |vector: &PolarVector| {
            all.iter().position(|other| (other.vector, other.matrix) == (vector.vector, vector.matrix)).unwrap_or_else(
                || {
                    all.push(vector.clone());
                    all.len() - 1
                },
            )
        };
        vectors.iter().map(place).collect()
    });
    let places = places.collect();
    (all, places)
}
