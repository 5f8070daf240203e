//! M, Q and the accelerations of a scene.

use linkage_ir::Intrinsic;
use linkage_ir::Operations;

use super::reads::Read;
use super::{ERRORS, ScenePlan};
use crate::derivation::Prescribed;
use crate::graph::{NodeId, Number, SymbolId};
use crate::ids::InputId;
use crate::program::doc::{fenced, lines};
use crate::program::expression::{Expression, Pattern, Statement, Type};
use crate::program::function::{Body, Output, Value, results};
use crate::program::plan::unnamed;

impl ScenePlan<'_, '_, '_> {
    pub(super) fn mass_matrix(&mut self) {
        let v = self.signatures.inputs.len();
        let entries: Vec<NodeId> = self.scene.mass_matrix.iter().flatten().flatten().copied().collect();
        let mut doc =
            lines(["The mass matrix reduced to the inputs, `M = sum m W_G' W_G + j w' w`: `M v'' = forces`."]);
        let upper = entries.iter().enumerate().filter(|(index, _)| index / v <= index % v);
        doc.extend(fenced(upper.map(|(index, &node)| match v {
            1 => self.plan.law("M", node),
            _ => self.plan.law(format_args!("M_{}{}", index / v + 1, index % v + 1), node),
        })));
        doc.extend(lines([
            "",
            "# Errors",
            "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if an entry is not finite.",
        ]));
        let symbols: Vec<SymbolId> = self.layers.inertia.iter().flatten().copied().collect();
        let outputs = unnamed(self.plan.variables(&symbols));
        let entries = results(0..symbols.len());
        let body = self.on_motion(outputs, None).checked("the mass matrix", entries.clone());
        let body = Body { value: Value::Plain(Expression::matrix(&entries, v)), ..body };
        self.add(self.signatures.mass_matrix(), doc, body);
    }

    pub(super) fn forces(&mut self) {
        let quadratic = match self.signatures.has_inertia {
            true => ", including the quadratic velocity terms: `M v'' = Q`.",
            false => ".",
        };
        let mut doc = vec![format!("The generalised forces Q of the inputs{quadratic}")];
        let laws = self.signatures.inputs.iter().zip(&self.scene.forces);
        doc.extend(fenced(laws.map(|(input, &force)| self.plan.law(format_args!("Q_{input}"), force))));
        doc.extend(lines(ERRORS));
        let count = self.scene.forces.len();
        let outputs = unnamed(self.plan.variables(&self.layers.forces));
        let body = self.on_motion(outputs, None);
        let body = self.checked_with_effects(body, "the forces", results(0..count));
        let body = Body { value: Value::Plain(Expression::vector(results(0..count))), ..self.with_rates(body) };
        self.add(self.signatures.forces(), doc, body);
    }

    /// The entries of M in some rows and columns.
    pub(super) fn minor(&mut self, rows: &[InputId], columns: &[InputId]) -> Vec<NodeId> {
        let entry = |row: InputId, column: InputId| self.layers.inertia[row][column];
        let entries = rows.iter().flat_map(|&row| columns.iter().map(move |&column| entry(row, column)));
        self.plan.variables(&entries.collect::<Vec<SymbolId>>())
    }

    /// `Q - M_d a_d` in some rows; `a_d` are the accelerations of the driven inputs.
    pub(super) fn right_sides(&mut self, rows: &[InputId]) -> Vec<NodeId> {
        let graph = &mut self.plan.derivation.graph;
        let mut sides = Vec::new();
        for &row in rows {
            let mut terms = vec![(Number::ONE, graph.variable(self.layers.forces[row]))];
            for (column, Prescribed { acceleration, .. }) in &self.scene.drives {
                if !self.layers.inertia.is_empty() {
                    let entry = graph.variable(self.layers.inertia[row][*column]);
                    terms.push((Number::MINUS_ONE, graph.multiply(entry, *acceleration)));
                }
            }
            sides.push(graph.sum(&terms));
        }
        sides
    }

    /// Adds the solution of M a = side for the accelerations of the free inputs; returns these as local values.
    pub(super) fn solve_free(
        &self,
        body: &mut Body,
        entries: Vec<Expression>,
        sides: Vec<Expression>,
    ) -> Vec<Expression> {
        let free = self.signatures.free.iter().map(|&at| self.signatures.inputs[at].as_str());
        let free: Vec<&str> = free.collect();
        let names: Vec<Expression> = free.iter().map(|input| body.local(format!("{input}_acceleration"))).collect();
        if names.is_empty() {
            return names;
        }
        let count = names.len();
        let texts = Expression::List(free.into_iter().map(Expression::text).collect());
        let columns = Expression::List(Expression::nested(entries, &[count]));
        let arguments = [Expression::mechanism(), texts, columns, Expression::List(sides)];
        let pattern = names.iter().filter_map(|name| match name {
            Expression::Local(index) => Some(Pattern::bound(*index)),
            _ => None,
        });
        let pattern = Pattern::List(pattern.collect());
        body.after.push(Statement::Let(pattern, Expression::call(Intrinsic::Reduced, arguments).tried()));
        // The operations of a Cholesky factorisation and of two triangular systems.
        let pairs = count * (count - 1) / 2;
        let inner: usize = (0..count).map(|left| left * (left + 1) / 2 * 2).sum();
        body.operations += Operations {
            divisions: count * (count + 1) / 2,
            multiplications: inner / 2 * 2 + 2 * pairs,
            additions: inner / 2 * 2 + 2 * pairs,
            functions: 0,
        };
        names
    }

    /// `rates` returns `q'` and `v''`, `acceleration` `v''` by calling it.
    pub(super) fn rates(&mut self) {
        let free = self.signatures.free.clone();
        let mut outputs = unnamed(self.minor(&free, &free));
        outputs.extend(unnamed(self.right_sides(&free)));
        let laws = self.scene.drives.values().zip(&self.signatures.driven);
        outputs.extend(
            laws.map(|(law, &at)| {
                Output::named(law.acceleration, format!("{}_acceleration", self.signatures.inputs[at]))
            }),
        );
        let entries = 0..free.len().pow(2);
        let sides = entries.end..entries.end + free.len();
        let laws = sides.end..outputs.len();
        let mut body = self.on_motion(outputs, Some(Read::Rates));
        let accelerations = self.solve_free(&mut body, results(entries), results(sides));
        let mut accelerations: Vec<(InputId, Expression)> = free.into_iter().zip(accelerations).collect();
        accelerations.extend(self.signatures.driven.iter().copied().zip(results(laws)));
        accelerations.sort_by_key(|(at, _)| *at);
        let accelerations: Vec<Expression> = accelerations.into_iter().map(|(_, value)| value).collect();
        let rates = Expression::name(&self.signatures.arguments.rates);
        let unchecked = self.plan.to_check().into_iter();
        let unchecked = unchecked.map(|column| rates.clone().field(&self.plan.derivation.coordinates[column].name));
        let checked = accelerations.iter().cloned().chain(unchecked).collect();
        let body = self.checked_with_effects(body, "the acceleration", checked);
        let body = self.with_rates(body);
        let inputs = self.signatures.inputs.iter().cloned().zip(accelerations);
        let inputs = Expression::structure(Type::Bare(self.signatures.types.inputs.clone()), inputs);
        let members = [("rates", rates), ("input_accelerations", inputs)].map(|(name, value)| (name.to_owned(), value));
        let rates = Expression::structure(Type::Runtime("StateRates", Vec::new()), members);
        let body = Body { value: Value::Plain(rates), ..body };
        let mut errors = lines(ERRORS);
        if !self.signatures.free.is_empty() {
            errors.push(
                "`MotionError::NoInertia` if M is singular: some inputs could accelerate without a force.".to_owned(),
            );
        }
        let rates = if self.plan.signatures.is_open { "v'" } else { "(W v', v')" };
        let mut doc = vec![format!(
            "The rates `q' = {rates}` and the input accelerations `v''` from `M v'' = Q`: the right-hand side for an integrator."
        )];
        doc.extend(errors.clone());
        self.add(self.signatures.rates(), doc, body);

        let mut doc =
            lines(["The accelerations `v''` of the inputs: from `M v'' = Q`, or from the law of a driven input."]);
        doc.extend(errors);
        let arguments = &self.signatures.arguments;
        let state = [&arguments.time, &arguments.q, &arguments.input_rates];
        let rates = Expression::own_call("rates", state.map(Expression::name)).tried();
        let body = Body::plain(rates.field("input_accelerations"));
        self.add(self.signatures.acceleration(), doc, body);
    }
}
