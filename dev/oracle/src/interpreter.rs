//! The compiler's interpreter as the oracle of emitted code, and random poses for both.

use std::collections::HashMap;

use linkage_compiler::derivation::{Derivation, Row};
use linkage_compiler::graph::{External, NodeId, SymbolId};
use linkage_compiler::ids::Id;
use linkage_compiler::model::{Kind, Mechanism};
use linkage_gallery::checks::at;
use linkage_gallery::listed::Named;
use linkage_gallery::source::tokens_of;
use nalgebra::DMatrix;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::precise::{Big, big};
use crate::tape::Tape;

/// One driver of one mechanism, read from its file of the gallery.
pub struct Oracle {
    mechanism: Mechanism,
    pub derivation: Derivation,
}

/// A pose with rates and accelerations, none of them consistent: the formulas hold everywhere.
pub struct Sample {
    pub parameters: Vec<f64>,
    pub q: Vec<f64>,
    pub rates: Vec<f64>,
    pub accelerations: Vec<f64>,
    values: HashMap<String, f64>,
}

impl Oracle {
    /// The oracle of a mechanism of the gallery.
    ///
    /// # Panics
    /// If its file has no such mechanism.
    #[must_use]
    pub fn of(named: &(impl Named + ?Sized)) -> Self {
        let (file, name) = (named.file(), named.name());
        let mechanism = linkage_compiler::read(tokens_of(file)).expect(file).remove(0);
        let driver = mechanism.drivers.iter().position(|driver| driver.name == name).expect(name);
        let derivation = linkage_compiler::derive(&mechanism).remove(driver);
        Self { mechanism, derivation }
    }

    /// The symbols of the parameters in declared order.
    pub fn parameters(&self) -> impl Iterator<Item = SymbolId> {
        self.mechanism.parameters.iter().map(|parameter| parameter.symbol)
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
            let (mut q, mut rates, mut accelerations) = (Vec::new(), Vec::new(), Vec::new());
            for coordinate in &self.derivation.coordinates {
                let declared = self.mechanism.coordinates.iter().find(|c| c.name.field == coordinate.name);
                let value = match declared.map(|c| c.kind) {
                    Some(Kind::Length) => random.random_range(0.5..3.0),
                    _ => random.random_range(-3.0..3.0),
                };
                q.push(value);
                rates.push(random.random_range(-2.0..2.0));
                accelerations.push(random.random_range(-5.0..5.0));
                values.insert(coordinate.name.clone(), value);
                values.insert(format!("{}_rate", coordinate.name), rates[rates.len() - 1]);
                values.insert(format!("{}_acceleration", coordinate.name), accelerations[accelerations.len() - 1]);
            }
            Sample { parameters, q, rates, accelerations, values }
        })
    }

    /// Runs a check at each of these samples, and returns what it returns. A failure names the sample.
    ///
    /// # Panics
    /// If the check does.
    pub fn at_samples<R>(&self, count: usize, mut check: impl FnMut(usize, &Sample) -> R) -> Vec<R> {
        let samples = self.samples(count).enumerate();
        samples.map(|(number, sample)| at(format_args!("pose {number}"), || check(number, &sample))).collect()
    }

    pub fn values(&self, sample: &Sample, nodes: &[NodeId]) -> Vec<f64> {
        let graph = &self.derivation.graph;
        let bind = |symbol| sample.values[graph.symbol_name(symbol)];
        graph.evaluate_with(nodes, bind, |external, arguments| self.external(external, arguments))
    }

    /// Expressions for repeated evaluation by [`precisely`](Self::precisely).
    #[must_use]
    pub fn tape(&self, nodes: &[NodeId]) -> Tape {
        Tape::new(&self.derivation.graph, nodes, &[])
    }

    /// The values of a tape in 48 digits.
    #[must_use]
    pub fn precisely(&self, tape: &Tape, sample: &Sample) -> Vec<Big> {
        let graph = &self.derivation.graph;
        let bind = |symbol| big(sample.values[graph.symbol_name(symbol)]);
        tape.evaluate(bind, |external, arguments| self.external(external, arguments))
    }

    /// The sums of the magnitudes of the terms of expressions.
    #[must_use]
    pub fn magnitudes(&self, sample: &Sample, nodes: &[NodeId]) -> Vec<f64> {
        let graph = &self.derivation.graph;
        let bind = |symbol| sample.values[graph.symbol_name(symbol)];
        self.tape(nodes).magnitudes(bind, |external, arguments| self.external(external, arguments))
    }

    /// Another sample, with its parameters changed by one function and its coordinates and rates by another.
    pub fn moved(
        &self,
        sample: &Sample,
        parameter: impl FnMut(f64) -> f64,
        mut coordinate: impl FnMut(f64) -> f64,
    ) -> Sample {
        let parameters: Vec<f64> = sample.parameters.iter().copied().map(parameter).collect();
        let mut all = |list: &[f64]| list.iter().map(|&value| coordinate(value)).collect::<Vec<f64>>();
        let (q, rates) = (all(&sample.q), all(&sample.rates));
        let accelerations = sample.accelerations.clone();
        let mut values = sample.values.clone();
        values.extend(self.mechanism.parameters.iter().map(|one| one.name.field.clone()).zip(parameters.clone()));
        for (coordinate, (&q, &rate)) in self.derivation.coordinates.iter().zip(q.iter().zip(&rates)) {
            values.insert(coordinate.name.clone(), q);
            values.insert(format!("{}_rate", coordinate.name), rate);
        }
        Sample { parameters, q, rates, accelerations, values }
    }

    /// A derivative of one of the cam laws.
    fn external(&self, external: &External, arguments: &[f64]) -> f64 {
        crate::laws::values(&self.mechanism, external, arguments)
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
