//! The compiler's interpreter as the oracle of emitted code, and random poses to ask it about.

mod laws;

use std::collections::HashMap;

use linkage_compiler::derivation::{Derivation, Row};
use linkage_compiler::graph::{External, NodeId};
use linkage_compiler::ids::Id;
use linkage_compiler::model::{Kind, Mechanism};
use nalgebra::DMatrix;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// One driver of one mechanism, read from its file under `tests/mechanisms`.
pub struct Oracle {
    mechanism: Mechanism,
    pub derivation: Derivation,
}

/// A pose with rates and accelerations, none of them consistent: the formulas hold everywhere.
pub struct Sample {
    pub parameters: Vec<f64>,
    pub q: Vec<f64>,
    pub rate: Vec<f64>,
    pub acceleration: Vec<f64>,
    values: HashMap<String, f64>,
}

impl Oracle {
    pub fn read(file: &str, driver: usize) -> Self {
        let mut mechanisms = linkage_compiler::read(crate::source::tokens_of(file)).expect(file);
        let mechanism = mechanisms.remove(0);
        let derivation = linkage_compiler::derive(&mechanism).remove(driver);
        Self { mechanism, derivation }
    }

    /// Poses with parameters within a fifth of their defaults.
    pub fn samples(&self, count: usize) -> impl Iterator<Item = Sample> {
        let mut random = SmallRng::seed_from_u64(20_091_121);
        (0..count).map(move |_| {
            let mut values = HashMap::new();
            let mut parameters = Vec::new();
            for parameter in &self.mechanism.parameters {
                let default = parameter.default.and_then(|node| self.mechanism.graph.constant_value(node));
                let value = default.expect("mechanisms under test have defaults") * random.random_range(0.8..1.2);
                values.insert(parameter.name.field.clone(), value);
                parameters.push(value);
            }
            let (mut q, mut rate, mut acceleration) = (Vec::new(), Vec::new(), Vec::new());
            for coordinate in &self.derivation.coordinates {
                let declared = self.mechanism.coordinates.iter().find(|c| c.name.field == coordinate.name);
                let value = match declared.map(|c| c.kind) {
                    Some(Kind::Length) => random.random_range(0.5..3.0),
                    _ => random.random_range(-3.0..3.0),
                };
                q.push(value);
                rate.push(random.random_range(-2.0..2.0));
                acceleration.push(random.random_range(-5.0..5.0));
                values.insert(coordinate.name.clone(), value);
                values.insert(format!("{}_rate", coordinate.name), rate[rate.len() - 1]);
                values.insert(format!("{}_acceleration", coordinate.name), acceleration[acceleration.len() - 1]);
            }
            Sample { parameters, q, rate, acceleration, values }
        })
    }

    pub fn values(&self, sample: &Sample, nodes: &[NodeId]) -> Vec<f64> {
        let graph = &self.derivation.graph;
        let bind = |symbol| sample.values[graph.symbol_name(symbol)];
        graph.evaluate_with(nodes, bind, |external, arguments| self.external(external, arguments))
    }

    /// A derivative of one of the cam laws.
    fn external(&self, external: &External, arguments: &[f64]) -> f64 {
        laws::values(&self.mechanism, external, arguments)
            [external.order().expect("a derivative by the first argument")]
    }

    /// A matrix of `columns` columns.
    pub fn matrix<C: Id>(&self, sample: &Sample, rows: &[Row<C>], columns: usize) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(rows.len(), columns);
        for (index, row) in rows.iter().enumerate() {
            let nodes: Vec<NodeId> = row.values().copied().collect();
            for (&column, value) in row.keys().zip(self.values(sample, &nodes)) {
                matrix[(index, column.index())] = value;
            }
        }
        matrix
    }
}

/// Equal to `tolerance` of `scale`, the largest of the numbers that were added to make it.
#[track_caller]
pub fn close(what: &str, found: f64, expected: f64, scale: f64, tolerance: f64) {
    let error = (found - expected).abs();
    assert!(error <= tolerance * scale, "{what}: {found:e} is not {expected:e}, off by {error:e} of {scale:e}");
}

/// Equal to `tolerance` of the largest entry.
#[track_caller]
pub fn all_close(what: &str, found: &[f64], expected: &[f64], scale: f64, tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(scale, |scale, value| scale.max(value.abs()));
    for (index, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        close(&format!("{what}[{index}]"), found, expected, scale, tolerance);
    }
}
