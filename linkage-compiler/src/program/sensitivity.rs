//! Functions for the sensitivities of unknowns, points and outputs to the parameters.

use linkage_ir::Intrinsic;

use super::doc::{fenced, lines};
use super::equations::as_results;
use super::expression::{Expression, Statement};
use super::function::{Body, Value};
use super::plan::{Plan, unnamed};
use super::signatures::Family;
use crate::algebra::simplify;
use crate::derivation::{Form, Solutions, Step, System, needed};
use crate::graph::{NodeId, SymbolId};
use crate::ids::{Id, ParameterId, Table, UnknownId};

const ERRORS: [&str; 3] = [
    "",
    "# Errors",
    "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if a result is not finite.",
];

impl Plan<'_, '_> {
    pub(super) fn sensitivity(&mut self) {
        let systems = self.derivation.sensitivity_systems();
        let (steps, solved) = self.derivation.solve(&systems, Form::Factored);
        let solved = Table::from(solved);
        if !self.signatures.is_open {
            self.unknown_sensitivity(&systems, steps, &solved);
        }
        for family in [Family::Points, Family::Outputs] {
            if self.signatures.has(family) {
                self.quantity_sensitivities(family, &solved);
            }
        }
    }

    fn unknown_sensitivity(
        &mut self,
        systems: &Table<ParameterId, System>,
        mut steps: Vec<Step>,
        solved: &Solutions<ParameterId, NodeId>,
    ) {
        let (u, p) = (self.signatures.unknowns.len(), self.mechanism.parameters.len());
        let columns = self.mechanism.parameters.iter();
        let columns: Vec<String> = columns.map(|parameter| format!("`{}`", parameter.name.text)).collect();
        let mut doc = lines([
            "The sensitivity du/dp = -J^-1 `Psi_p` of the unknowns to the parameters, at fixed inputs; its columns",
            &format!("are {}.", columns.join(", ")),
        ]);
        let names = systems.iter().flat_map(|(_, names)| names);
        let laws = names.zip(self.formulas.sensitivities.iter().flatten());
        let laws = laws.filter_map(|(&name, formula)| Some((name, (*formula)?)));
        let laws = laws.filter(|(_, formula)| !self.derivation.graph.is_zero(*formula));
        doc.extend(fenced(laws.map(|(name, formula)| self.law(self.derivation.graph.symbol_name(name), formula))));
        doc.extend(lines(ERRORS));
        // The derivative by a link length is a unit vector along a column of J, so that cos^2 + sin^2 = 1 shortens it.
        let given = self.pose.angles().collect();
        for step in &mut steps {
            if let Step::Let { node, .. } = step {
                *node = simplify(&mut self.derivation.graph, &[*node], &given)[0];
            }
        }
        // du/dp: names, or zero.
        let column = |(p, solved): (ParameterId, &Table<UnknownId, NodeId>)| {
            solved.enumerated().map(move |(u, &node)| (u.index(), p.index(), node)).collect::<Vec<_>>()
        };
        let entries = solved.enumerated().flat_map(column);
        let entries: Vec<_> = entries.filter(|(_, _, node)| !self.derivation.graph.is_zero(*node)).collect();
        let nodes: Vec<NodeId> = entries.iter().map(|(_, _, node)| *node).collect();
        let steps = needed(&self.derivation.graph, steps, &nodes);
        let kernel = self.on_pose(Vec::new(), steps, unnamed(nodes));
        let mut body = Body { kernel: Some(kernel), ..Body::default() };
        let matrix = body.matrix("SMatrix", &as_results(&entries, 0), u, p);
        let value = body.finite_matrix("sensitivity", "sensitivity", matrix);
        let body = Body { value: Value::Plain(value), ..body };
        self.add(self.signatures.sensitivity(), doc, body);
    }

    fn quantity_sensitivities(&mut self, family: Family, solved: &Solutions<ParameterId, NodeId>) {
        let (word, dimension) = (family.word(), family.dimension());
        let names = family.names(&self.signatures);
        let open = self.signatures.is_open;
        let mut doc = vec![
            format!("The total derivatives of the {word}s with respect to the parameters, at fixed inputs:"),
            if open { "`dl/dp = l_p`." } else { "`dl/dp = l_p + l_u du/dp`." }.to_owned(),
        ];
        let mut laws = Vec::new();
        for (name, formulas) in names.iter().zip(self.formulas_of(family)) {
            for (parameter, nodes) in self.mechanism.parameters.iter().zip(&formulas.sensitivities) {
                if nodes.iter().any(|&node| !self.derivation.graph.is_zero(node)) {
                    laws.extend(self.laws(family, name, &format!("by_{}", parameter.name.field), nodes));
                }
            }
        }
        doc.extend(fenced(laws.into_iter()));
        doc.extend(lines(ERRORS));
        let mut nodes = Vec::new();
        for quantity in self.quantities_of(family).to_vec() {
            nodes.extend(self.derivation.quantity_sensitivities(&quantity, solved).into_iter().flatten());
        }
        let first = self.derivation.sensitivity.iter();
        let symbols: Vec<SymbolId> = first.flat_map(|first| first.names.iter().flatten()).copied().collect();
        // The count includes the operations of `sensitivity`, which it calls.
        let called = if open { None } else { Some("sensitivity") };
        let sources = called.iter().map(|function| self.columns(function, &symbols)).collect();
        let kernel = self.on_pose(sources, Vec::new(), unnamed(nodes.iter().copied()));
        let mut body = Body { kernel: Some(kernel), ..Body::default() };
        let columns = nodes.len() / (names.len() * dimension);
        let entries: Vec<_> = nodes.iter().enumerate().collect();
        let mut members = Vec::new();
        for (name, entries) in names.iter().zip(entries.chunks(columns * dimension)) {
            let entries = entries.iter().enumerate().filter(|(_, (_, node))| !self.derivation.graph.is_zero(**node));
            let entries =
                entries.map(|(index, (place, _))| (index % dimension, index / dimension, Expression::Result(*place)));
            let matrix = body.matrix("SMatrix", &entries.collect::<Vec<_>>(), dimension, columns);
            let value = body.finite_matrix(&format!("{name}_sensitivity"), word, matrix);
            members.push((name.clone(), value));
        }
        let group = super::Type::Bare(self.signatures.each_name(family).to_owned());
        let body = Body { value: Value::Plain(Expression::structure(group, members)), ..body };
        self.add(self.signatures.quantity_sensitivities(family), doc, body);
    }
}

impl Body {
    /// Names a matrix and adds a check that it is finite.
    fn finite_matrix(&mut self, preferred: &str, what: &str, matrix: Expression) -> Expression {
        let name = self.bound(preferred, matrix);
        let check = [Expression::mechanism(), Expression::text(what), name.clone().borrowed()];
        self.after.push(Statement::Do(Expression::call(Intrinsic::FiniteMatrix, check).tried()));
        name
    }
}
