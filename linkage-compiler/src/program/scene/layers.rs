//! The private functions that those of a scene call: M, the contribution of each body and effect to Q, and Q. They
//! check nothing; their callers check that results are finite.

use std::collections::BTreeSet;

use linkage_ir::Intrinsic;

use super::ScenePlan;
use super::reads::Read;
use super::signatures::layer;
use crate::graph::{NodeId, Number, SymbolId};
use crate::ids::{ColumnId, Id, InputId, Table};
use crate::program::doc::lines;
use crate::program::expression::{Expression, Pattern, Receiver, Statement, Type};
use crate::program::function::{Argument, Body, Function, Kernel, Output, Passed, Shape, Source, Value, results};
use crate::program::names::{Order, name_of};
use crate::program::plan::unnamed;

impl ScenePlan<'_, '_, '_> {
    /// M, column by column.
    pub(super) fn reduced_inertia(&mut self) {
        let Some(matrix) = self.scene.mass_matrix.clone() else { return };
        let names = self.signatures.inputs.clone();
        for (row, name) in names.enumerated() {
            let mut entries: Table<InputId, SymbolId> = self.layers.inertia.iter().map(|above| above[row]).collect();
            let right = names.iter().skip(row.number()).map(|other| format!("{name}_{other}_inertia"));
            let names = std::iter::once(format!("{name}_inertia")).chain(right);
            entries.extend(names.map(|name| self.plan.derivation.graph.symbol(name)));
            self.layers.inertia.push(entries);
        }
        let entries: Vec<NodeId> = matrix.into_iter().flatten().collect();
        let symbols: Vec<SymbolId> = self.layers.inertia.iter().flatten().copied().collect();
        self.name(&entries, &symbols);
        self.layers.inertia_reads = self.read_by_layer(&entries);
        let columns = Expression::List(Expression::nested(results(0..entries.len()), &[names.len()]));
        let column = Type::List(Box::new(Type::Scalar), names.len());
        let signature = self.layer("reduced_inertia", &entries, Type::List(Box::new(column), names.len()));
        self.add_layer(signature, "M, column by column.", entries, columns);
    }

    /// The contribution of each body and effect to Q, with its label in errors.
    pub(super) fn effects(&mut self) {
        let inputs = self.signatures.inputs.clone();
        let mut nodes = Vec::new();
        for (label, parts) in &self.scene.parts {
            for (&part, input) in parts.iter().zip(&inputs) {
                let graph = &mut self.plan.derivation.graph;
                if graph.constant_value(part).is_none() {
                    let symbol = graph.symbol(part_name(label, input, inputs.len()));
                    self.layers.parts.push((label.clone(), symbol));
                    nodes.push(part);
                }
            }
        }
        if nodes.is_empty() {
            return;
        }
        let symbols: Vec<SymbolId> = self.layers.parts.iter().map(|(_, symbol)| *symbol).collect();
        self.name(&nodes, &symbols);
        self.layers.parts_read = self.read_by_layer(&nodes);
        let labels = self.layers.parts.iter().map(|(label, _)| Expression::text(label));
        let parts = labels.zip(results(0..nodes.len())).map(|(label, part)| Expression::Tuple(vec![label, part]));
        let parts = Expression::List(parts.collect());
        let of = Type::List(Box::new(Type::Tuple(vec![Type::Text, Type::Scalar])), nodes.len());
        let signature = self.layer("effects", &nodes, of);
        self.add_layer(signature, "The contribution of each body and effect to Q, with its name.", nodes, parts);
    }

    /// Gives formulas the names of their symbols.
    fn name(&mut self, nodes: &[NodeId], symbols: &[SymbolId]) {
        let graph = &self.plan.derivation.graph;
        let names = symbols.iter().map(|&symbol| graph.symbol_name(symbol).to_owned());
        let named: Vec<(NodeId, String)> = nodes.iter().copied().zip(names).collect();
        self.plan.named.splice(0..0, named);
    }

    /// Q, the sum of the contributions of bodies and effects.
    pub(super) fn reduced_forces(&mut self) {
        let inputs = self.signatures.inputs.clone();
        let graph = &mut self.plan.derivation.graph;
        self.layers.forces = inputs.iter().map(|input| graph.symbol(format!("{input}_force"))).collect();
        let mut varying = self.layers.parts.iter().map(|(_, symbol)| *symbol);
        let mut sums = vec![Vec::new(); inputs.len()];
        for (_, parts) in &self.scene.parts {
            for (&part, sum) in parts.iter().zip(&mut sums) {
                let symbol = if graph.constant_value(part).is_none() { varying.next() } else { None };
                sum.push((Number::ONE, symbol.map_or(part, |symbol| graph.variable(symbol))));
            }
        }
        let sums: Vec<NodeId> = sums.iter().map(|terms| graph.sum(terms)).collect();
        let part = |(_, symbol): &(String, SymbolId)| Shape::Tuple(vec![Shape::Ignored, Shape::Symbol(*symbol)]);
        let shape = Shape::List(self.layers.parts.iter().map(part).collect());
        let is_varying = !self.layers.parts.is_empty();
        let mut sources = Vec::new();
        if is_varying {
            sources.push(Source { from: self.call_of("effects", |argument| Expression::name(&argument.name)), shape });
        }
        let kernel = Kernel { sources, results: unnamed(sums), ..Kernel::default() };
        let body = Body::of(kernel, Expression::List(results(0..inputs.len())));
        let of = Type::List(Box::new(Type::Scalar), inputs.len());
        let signature = layer("reduced_forces", self.arguments(&self.layers.parts_read), of);
        let is_method = self.find("effects").is_some_and(|effects| effects.is_method);
        self.add(
            Function { is_method, ..signature },
            lines(["Q, the sum of the contributions of bodies and effects."]),
            body,
        );
    }

    /// True if some effect depends on time.
    pub(super) fn effects_depend_on_time(&self) -> bool {
        self.layers.parts_read.contains(&Read::Time)
    }

    /// `check_effects`: an error that names the body or effect whose force is not finite.
    pub(super) fn check_effects(&mut self) {
        let body = self.moved(&self.layers.parts_read);
        let finite = [Expression::mechanism(), self.call_of("effects", |argument| self.passed(argument))];
        let body = Body { value: Value::Result(Expression::call(Intrinsic::FiniteEach, finite)), ..body };
        let doc = lines(["Returns an error with the name of a body or effect if its force is not finite."]);
        self.add(self.signatures.check_effects(self.effects_depend_on_time()), doc, body);
    }

    /// A body with coordinates and input rates that computes W, `q'`, `u''` at `v'' = 0`, M and Q as far as the results
    /// depend on them; `by_name` is a dependency of later statements.
    pub(super) fn on_motion(&self, results: Vec<Output>, by_name: Option<Read>) -> Body {
        let nodes: Vec<NodeId> = results.iter().map(|output| output.node).collect();
        let own = self.reads(&nodes);
        let mut all: BTreeSet<Read> = own.iter().copied().chain(by_name).collect();
        if own.contains(&Read::Inertia) {
            all.extend(&self.layers.inertia_reads);
        }
        if own.contains(&Read::Forces) {
            all.extend(&self.layers.parts_read);
        }
        let mut body = self.moved(&all);
        let mut sources: Vec<Source> = self.still().into_iter().chain(self.moving(&own)).collect();
        if own.contains(&Read::InputRates) && !own.contains(&Read::Rates) {
            let input_rates = Expression::name(&self.signatures.arguments.input_rates);
            sources.push(Source { from: input_rates, ..self.plan.inputs(Order::Rate) });
        }
        if own.contains(&Read::Inertia) {
            let inertia = &self.layers.inertia;
            let entry = |(row, column): (InputId, InputId)| match row <= column {
                true => Shape::Symbol(inertia[row][column]),
                false => Shape::Ignored,
            };
            let column = |row| Shape::List(inertia.ids().map(|column| entry((row, column))).collect());
            let shape = Shape::List(inertia.ids().map(column).collect());
            sources.push(Source { from: self.call_of("reduced_inertia", |argument| self.passed(argument)), shape });
        }
        if own.contains(&Read::Forces) {
            let shape = Shape::list(&self.layers.forces);
            sources.push(Source { from: self.call_of("reduced_forces", |argument| self.passed(argument)), shape });
        }
        body.kernel = Some(Kernel { sources, results, is_on_pose: true, ..Kernel::default() });
        body
    }

    /// A body that computes the pose, W, `q'` and `u''` at `v'' = 0` as far as they are read.
    fn moved(&self, reads: &BTreeSet<Read>) -> Body {
        let arguments = &self.signatures.arguments;
        let input_rates = Expression::name(&arguments.input_rates);
        let mut body = Body::default();
        let driver = Receiver::Type(Box::new(Type::Bare(self.signatures.types.driver.clone())));
        if self.plan.signatures.is_open {
            if reads.contains(&Read::Pose) {
                self.pose_at(&mut body);
            }
            if reads.contains(&Read::Rates) {
                let call = Expression::called_on(driver, "coordinate_rates", [input_rates]);
                body.before.push(Statement::Let(Pattern::bound(arguments.rates.clone()), call));
            }
            return body;
        }
        if reads.contains(&Read::Bias) {
            let found = [
                (Read::Pose, "pose", &arguments.pose),
                (Read::Ratios, "ratios", &arguments.ratios),
                (Read::Rates, "rates", &arguments.rates),
                (Read::Bias, "bias", &arguments.bias),
            ];
            let read = found.into_iter().filter(|(read, ..)| reads.contains(read));
            let fields = read.map(|(_, field, name)| (field.to_owned(), Pattern::bound(name.clone())));
            let fields: Vec<_> = fields.collect();
            let of = Type::Runtime("ReducedMotion", Vec::new());
            let pattern = Pattern::Struct { of, is_whole: fields.len() == found.len(), fields };
            let call = self.driver_call("reduced_motion", vec![Expression::name(&arguments.q), input_rates]);
            body.before.push(Statement::Let(pattern, call));
            return body;
        }
        self.pose_at(&mut body);
        let call = self.driver_call("ratio_columns", vec![Expression::name(&arguments.pose).borrowed()]);
        body.before.push(match reads.contains(&Read::Ratios) || reads.contains(&Read::Rates) {
            true => Statement::Let(Pattern::bound(arguments.ratios.clone()), call),
            false => Statement::Do(call),
        });
        if reads.contains(&Read::Rates) {
            let on = [Expression::name(&arguments.ratios).borrowed(), input_rates];
            let call = Expression::called_on(driver, "coordinate_rates", on);
            body.before.push(Statement::Let(Pattern::bound(arguments.rates.clone()), call));
        }
        body
    }

    /// Sources of W, `q'` and `u''` at `v'' = 0`, as far as they are read.
    fn moving(&self, reads: &BTreeSet<Read>) -> Vec<Source> {
        let (arguments, derivation) = (&self.signatures.arguments, &self.plan.derivation);
        let ratios: Vec<SymbolId> = derivation.ratios.iter().flatten().copied().collect();
        let rates = self.plan.coordinates(Order::Rate);
        let all = [
            (Read::Ratios, &arguments.ratios, Shape::columns(derivation.unknowns.len(), &ratios)),
            (Read::Rates, &arguments.rates, rates.shape),
            (Read::Bias, &arguments.bias, Shape::list(&self.scene.bias)),
        ];
        let read = all.into_iter().filter(|(read, ..)| reads.contains(read));
        read.map(|(_, name, shape)| Source { from: Expression::name(name), shape }).collect()
    }

    /// The dependencies of formulas, where a pose holds sines and cosines.
    pub(super) fn reads(&self, nodes: &[NodeId]) -> BTreeSet<Read> {
        let (derivation, given) = (&*self.plan.derivation, &self.plan.pose.given);
        let graph = &derivation.graph;
        let swept = graph.sweep(nodes, |_| false, |id| given.holds(graph, id));
        let mut reads = BTreeSet::new();
        reads.extend(swept.iter().any(|&id| given.holds(graph, id)).then_some(Read::Pose));
        let symbols: BTreeSet<SymbolId> = swept.into_iter().filter_map(|id| graph.as_symbol(id)).collect();
        let rates = |indices: &[ColumnId]| indices.iter().map(|&index| derivation.coordinates[index].rate).collect();
        let all: [(Read, Vec<SymbolId>); 8] = [
            (Read::Time, self.plan.mechanism.time.into_iter().collect()),
            (Read::Q, derivation.coordinates.iter().map(|coordinate| coordinate.value).collect()),
            (Read::Ratios, derivation.ratios.iter().flatten().copied().collect()),
            (Read::Rates, rates(&derivation.unknowns)),
            (Read::Bias, self.scene.bias.to_vec()),
            (Read::InputRates, rates(&derivation.inputs)),
            (Read::Inertia, self.layers.inertia.iter().flatten().copied().collect()),
            (Read::Forces, self.layers.forces.to_vec()),
        ];
        let read = all.into_iter().filter(|(_, of)| of.iter().any(|symbol| symbols.contains(symbol)));
        reads.extend(read.map(|(read, _)| read));
        reads
    }

    /// The dependencies of a layer, which takes q' instead of the input rates.
    fn read_by_layer(&self, nodes: &[NodeId]) -> BTreeSet<Read> {
        let reads = self.reads(nodes).into_iter();
        reads.map(|read| if read == Read::InputRates { Read::Rates } else { read }).collect()
    }

    /// The arguments of a layer.
    fn arguments(&self, reads: &BTreeSet<Read>) -> Vec<Argument> {
        reads.iter().filter_map(|&read| self.signatures.of_layer(read)).collect()
    }

    /// The signature of a layer with these formulas; without parameters it takes no `self`.
    fn layer(&self, name: &str, nodes: &[NodeId], of: Type) -> Function<Body> {
        let symbols = self.plan.derivation.graph.symbols_of(nodes);
        let mechanism = self.plan.mechanism;
        let mut parameters = mechanism.parameters.iter().chain(&mechanism.scene_parameters);
        let is_method = parameters.any(|parameter| symbols.contains(&parameter.symbol));
        Function { is_method, ..layer(name, self.arguments(&self.read_by_layer(nodes)), of) }
    }

    fn add_layer(&mut self, signature: Function<Body>, doc: &str, nodes: Vec<NodeId>, value: Expression) {
        let moving = self.moving(&self.read_by_layer(&nodes)).into_iter();
        // All but the parameters are references.
        let [parameters, coordinates, computed] = self.still();
        let others = std::iter::once(computed).chain(moving);
        let others = others.map(|source| Source { from: source.from.dereferenced(), ..source });
        let sources = [parameters, coordinates].into_iter().chain(others).collect();
        let kernel = Kernel { sources, results: unnamed(nodes), is_on_pose: true, ..Kernel::default() };
        self.add(signature, lines([doc]), Body::of(kernel, value));
    }

    fn find(&self, name: &str) -> Option<&Function<Body>> {
        self.functions.iter().find(|function| function.name == name)
    }

    /// An argument in a call from a body that holds it as a local value; q is a reference already.
    fn passed(&self, argument: &Argument) -> Expression {
        let value = Expression::name(&argument.name);
        let is_local = argument.name != self.signatures.arguments.q;
        if is_local && matches!(argument.passed, Passed::ByReference(_)) { value.borrowed() } else { value }
    }

    /// A call of a layer, each argument by `argument`.
    fn call_of(&self, name: &str, argument: impl Fn(&Argument) -> Expression) -> Expression {
        let called = self.find(name);
        let arguments = called.into_iter().flat_map(|layer| &layer.arguments).map(argument);
        match called.is_some_and(|layer| layer.is_method) {
            true => Expression::own_call(name, arguments),
            false => Expression::called_on(Receiver::ItsType, name, arguments),
        }
    }
}

/// `spring_on_opening`, or `body_arm_theta1` where there are several inputs.
fn part_name(label: &str, input: &str, inputs: usize) -> String {
    let label = label.to_lowercase();
    let name = if inputs == 1 || label.ends_with(&format!(" {input}")) { label } else { format!("{label} {input}") };
    name_of(&name).unwrap_or_else(|| "effect".to_owned())
}
