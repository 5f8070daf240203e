//! Theorems that the compiler relies on, proved for linkages with one input and two unknowns.

use std::collections::BTreeMap;

use linkage_compiler::algebra::determinant;
use linkage_compiler::graph::{NodeId, Number, SymbolId};
use linkage_equality::{Answer, compare, is_zero};

use crate::algebra::formula::Formulas;

/// Two scalar equations, the input and the unknowns.
struct Linkage {
    rows: [&'static str; 2],
    input: &'static str,
    unknowns: [&'static str; 2],
}

const FOUR_BAR: Linkage = Linkage {
    rows: ["l2*cos(t2) + l3*cos(t3) + l4*cos(t4) - l1", "l2*sin(t2) + l3*sin(t3) + l4*sin(t4)"],
    input: "t2",
    unknowns: ["t3", "t4"],
};

const SLIDER_CRANK: Linkage =
    Linkage { rows: ["r*cos(t2) + l*cos(t3) - s", "r*sin(t2) + l*sin(t3) - e"], input: "t2", unknowns: ["t3", "s"] };

/// The slider runs on a line that turns, at a distance e from its pivot.
const INVERTED: Linkage = Linkage {
    rows: ["r*cos(t2) - s*cos(t4) + e*sin(t4) - d", "r*sin(t2) - s*sin(t4) - e*cos(t4)"],
    input: "t2",
    unknowns: ["t4", "s"],
};

const LINKAGES: [Linkage; 3] = [FOUR_BAR, SLIDER_CRANK, INVERTED];

/// A linkage with its first derivatives.
struct Derived {
    formulas: Formulas,
    rows: Vec<NodeId>,
    /// Input and unknowns.
    coordinates: [SymbolId; 3],
    /// The derivatives of the rows by the unknowns, and by the input in the next field.
    jacobian: [[NodeId; 2]; 2],
    input: [NodeId; 2],
    determinant: NodeId,
    /// W: the rates of the unknowns for an input rate of 1.
    ratios: [NodeId; 2],
}

impl Derived {
    fn new(linkage: &Linkage) -> Self {
        let mut formulas = Formulas::default();
        let rows: Vec<NodeId> = linkage.rows.iter().map(|row| formulas.node(row)).collect();
        let coordinates = [linkage.input, linkage.unknowns[0], linkage.unknowns[1]].map(|name| formulas.symbol(name));
        let graph = &mut formulas.graph;
        let columns: Vec<Vec<NodeId>> = coordinates.iter().map(|&symbol| graph.partial(&rows, symbol)).collect();
        let jacobian = [[columns[1][0], columns[2][0]], [columns[1][1], columns[2][1]]];
        let input = [columns[0][0], columns[0][1]];
        let determinant = determinant(graph, jacobian);
        let mut derived = Self { formulas, rows, coordinates, jacobian, input, determinant, ratios: input };
        let right = input.map(|entry| derived.formulas.graph.negate(entry));
        derived.ratios = derived.solve(right);
        derived
    }

    /// Cramer's rule.
    fn solve(&mut self, [p, q]: [NodeId; 2]) -> [NodeId; 2] {
        let [[a, b], [c, d]] = self.jacobian;
        let graph = &mut self.formulas.graph;
        [[[p, b], [q, d]], [[a, p], [c, q]]].map(|matrix| {
            let numerator = determinant(graph, matrix);
            graph.divide(numerator, self.determinant)
        })
    }

    /// The rates of the coordinates at this input rate.
    fn seeds(&mut self, rate: NodeId) -> BTreeMap<SymbolId, NodeId> {
        let one = self.formulas.graph.one();
        let rates = [one, self.ratios[0], self.ratios[1]];
        let rates = rates.map(|ratio| self.formulas.graph.multiply(ratio, rate));
        self.coordinates.into_iter().zip(rates).collect()
    }

    fn scalar(&mut self, name: &str) -> NodeId {
        self.formulas.node(name)
    }
}

#[test]
fn the_combined_determinant_is_the_determinant() {
    for linkage in &LINKAGES {
        let Derived { mut formulas, jacobian: [[a, b], [c, d]], determinant, .. } = Derived::new(linkage);
        let graph = &mut formulas.graph;
        let (main, other) = (graph.multiply(a, d), graph.multiply(b, c));
        let plain = graph.subtract(main, other);
        assert_eq!(compare(graph, determinant, plain), Answer::Equal);
        let wrong = graph.add(main, other);
        assert_eq!(compare(graph, determinant, wrong), Answer::Different);
    }
}

#[test]
fn velocity_ratios_solve_the_derived_closure() {
    for linkage in &LINKAGES {
        let Derived { mut formulas, jacobian, input, ratios: [first, second], .. } = Derived::new(linkage);
        let graph = &mut formulas.graph;
        for ([a, b], input) in jacobian.into_iter().zip(input) {
            // J W + A = 0, row by row.
            let (a, b) = (graph.multiply(a, first), graph.multiply(b, second));
            let rest = graph.sum(&[(Number::ONE, a), (Number::ONE, b), (Number::ONE, input)]);
            assert_eq!(is_zero(graph, rest), Answer::Equal);
            let wrong = graph.sum(&[(Number::ONE, a), (Number::ONE, b), (Number::MINUS_ONE, input)]);
            assert_eq!(is_zero(graph, wrong), Answer::Different);
        }
    }
}

#[test]
fn both_methods_for_accelerations_agree() {
    for linkage in &LINKAGES {
        let mut derived = Derived::new(linkage);
        let (omega, alpha) = (derived.scalar("omega"), derived.scalar("alpha"));
        // Method 1: u'' is the time derivative of u' = W omega.
        let mut seeds = derived.seeds(omega);
        seeds.insert(derived.formulas.symbol("omega"), alpha);
        let rates = derived.ratios.map(|ratio| derived.formulas.graph.multiply(ratio, omega));
        let first = derived.formulas.graph.differentiate(&rates, &seeds);
        // Method 2: u'' = W alpha - J^-1 gamma, gamma = sum of second derivatives times two rates.
        let mut gamma = derived.input;
        for (entry, &row) in gamma.iter_mut().zip(&derived.rows) {
            let graph = &mut derived.formulas.graph;
            let mut terms = Vec::new();
            for (one, our_rate) in &seeds {
                let partial = graph.partial(&[row], *one)[0];
                for (other, their_rate) in &seeds {
                    let second = graph.partial(&[partial], *other)[0];
                    terms.push((Number::ONE, graph.product(&[(second, 1), (*our_rate, 1), (*their_rate, 1)])));
                }
            }
            *entry = graph.sum(&terms);
        }
        let corrections = derived.solve(gamma);
        let graph = &mut derived.formulas.graph;
        for ((ratio, correction), first) in derived.ratios.into_iter().zip(corrections).zip(first) {
            let driven = graph.multiply(ratio, alpha);
            let second = graph.subtract(driven, correction);
            assert_ne!(first, second);
            assert_eq!(compare(graph, first, second), Answer::Equal);
            let wrong = graph.add(driven, correction);
            assert_eq!(compare(graph, first, wrong), Answer::Different);
        }
    }
}

#[test]
fn residuals_are_constant_along_the_motion() {
    for linkage in &LINKAGES {
        let mut derived = Derived::new(linkage);
        let one = derived.formulas.graph.one();
        let mut seeds = derived.seeds(one);
        let graph = &mut derived.formulas.graph;
        for rate in graph.differentiate(&derived.rows, &seeds) {
            assert_eq!(is_zero(graph, rate), Answer::Equal);
        }
        // Without one of the ratios the rates are not zero.
        seeds.remove(&derived.coordinates[1]);
        let rates = graph.differentiate(&derived.rows, &seeds);
        assert!(rates.iter().any(|&rate| is_zero(graph, rate) == Answer::Different));
    }
}
