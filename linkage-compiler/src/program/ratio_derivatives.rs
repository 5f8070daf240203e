//! Functions for the derivatives of the velocity ratios of unknowns, points and outputs.

use super::doc::{fenced, lines};
use super::expression::Expression;
use super::function::{Body, Output, results};
use super::plan::Plan;
use super::signatures::Family;
use crate::derivation::{Form, Solutions, Step, needed};
use crate::graph::{NodeId, SymbolId};
use crate::ids::{PairId, Table};

const ERRORS: [&str; 3] = [
    "",
    "# Errors",
    "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if a result is not finite.",
];

impl Plan<'_, '_> {
    /// The steps that compute W and L, and the values of L.
    fn ratio_derivative_steps(&mut self) -> (Vec<Step>, Solutions<PairId, NodeId>) {
        let systems = self.derivation.ratio_derivative_systems();
        let (steps, mut solved) = self.derivation.solve(&systems, Form::Entries);
        let derivatives = solved.split_off(self.derivation.inputs.len());
        (steps, derivatives.into())
    }

    /// A symmetric matrix from its entries for j <= k.
    fn symmetric(&self, entries: &Table<PairId, Expression>) -> Expression {
        let Some(derivatives) = &self.derivation.ratio_derivatives else { return Expression::zero() };
        let columns: Vec<Expression> =
            derivatives.indices.iter().flatten().map(|&pair| entries[pair].clone()).collect();
        Expression::matrix(&columns, derivatives.indices.len())
    }

    pub(super) fn ratio_derivatives(&mut self) {
        if !self.signatures.is_open {
            self.unknown_ratio_derivatives();
        }
        for family in [Family::Points, Family::Outputs] {
            if self.signatures.has(family) {
                self.quantity_ratio_derivatives(family);
            }
        }
    }

    fn unknown_ratio_derivatives(&mut self) {
        let mut doc = lines([
            "The derivatives of the velocity ratios, d2u/dv dv: for each unknown a symmetric matrix `L` with",
            "`u'' = W v'' + v' . L v'`; from `J L_jk = -(Psi_q w_j)_q w_k`, where `w_j = (W_j, e_j)`.",
        ]);
        let second = self.derivation.ratio_derivatives.iter();
        let names: Vec<SymbolId> = second.flat_map(|second| second.names.iter().flatten()).copied().collect();
        let laws = names.iter().zip(self.formulas.ratio_derivatives.iter().flatten());
        doc.extend(fenced(
            laws.filter_map(|(&name, formula)| Some(self.law(self.derivation.graph.symbol_name(name), (*formula)?))),
        ));
        doc.extend(lines(ERRORS));
        let (steps, solved) = self.ratio_derivative_steps();
        let solved: Vec<NodeId> = solved.into_iter().flatten().collect();
        let steps = needed(&self.derivation.graph, steps, &solved);
        let name = |name: &SymbolId| self.derivation.graph.symbol_name(*name);
        let outputs = solved.into_iter().zip(&names).map(|(node, symbol)| Output::named(node, name(symbol)));
        let kernel = self.on_pose(Vec::new(), steps, outputs.collect());
        let (u, all) = (self.signatures.unknowns.len(), results(0..names.len()));
        let matrices = (0..u).map(|unknown| self.symmetric(&all.iter().skip(unknown).step_by(u).cloned().collect()));
        let body = Body::of(kernel, Expression::List(matrices.collect()));
        let body = body.checked("velocity ratio derivatives", all);
        self.add(self.signatures.ratio_derivatives(), doc, body);
    }

    fn quantity_ratio_derivatives(&mut self, family: Family) {
        let mut doc = lines([match family {
            Family::Points => "The second derivatives of the points by the inputs: symmetric matrices for x and for y.",
            Family::Outputs => "The second derivatives of the outputs by the inputs: a symmetric matrix for each.",
        }]);
        let second = self.derivation.ratio_derivatives.as_ref();
        let endings = second.map(|second| second.endings.clone()).unwrap_or_default();
        let names = family.names(&self.signatures);
        let mut laws = Vec::new();
        for (name, formulas) in names.iter().zip(self.formulas_of(family)) {
            for (ending, nodes) in endings.iter().zip(&formulas.ratio_derivatives) {
                laws.extend(self.laws(family, name, ending, nodes));
            }
        }
        doc.extend(fenced(laws.into_iter()));
        doc.extend(lines(ERRORS));
        let (steps, solved) = self.ratio_derivative_steps();
        let mut outputs = Vec::new();
        for (name, quantity) in names.iter().zip(self.quantities_of(family).to_vec()) {
            let derivatives = self.derivation.quantity_ratio_derivatives(&quantity, &solved);
            for (ending, components) in endings.iter().zip(derivatives) {
                let axes = family.axes().iter().zip(components);
                outputs.extend(axes.map(|(axis, node)| Output::named(node, format!("{name}{axis}_{ending}"))));
            }
        }
        let nodes: Vec<NodeId> = outputs.iter().map(|output| output.node).collect();
        let steps = needed(&self.derivation.graph, steps, &nodes);
        let kernel = self.on_pose(Vec::new(), steps, outputs);
        let dimension = family.dimension();
        let all = results(0..nodes.len());
        let of_each = all.chunks(endings.len() * dimension).map(|entries| {
            let component =
                |axis: usize| self.symmetric(&entries.iter().skip(axis).step_by(dimension).cloned().collect());
            match dimension {
                1 => component(0),
                _ => Expression::List((0..dimension).map(component).collect()),
            }
        });
        let group = super::Type::Bare(self.signatures.each_name(family).to_owned());
        let value = Expression::structure(group, names.into_iter().zip(of_each));
        let body = Body::of(kernel, value).checked(&format!("{} ratio derivatives", family.word()), all);
        self.add(self.signatures.quantity_ratio_derivatives(family), doc, body);
    }
}
