//! Functions that solve linear systems in J: velocity ratios, velocities, accelerations and jerks.

use std::collections::BTreeMap;

use linkage_ir::Intrinsic;

use super::doc::{fenced, lines, without_result};
use super::expression::{Expression, Pattern, Receiver, Statement, Type};
use super::function::{Body, Function, Kernel, Shape, Source, results};
use super::names::{Arguments, Order};
use super::plan::{Plan, unnamed};
use crate::derivation::{Assembly, Form, Step};
use crate::graph::{NodeId, Number, SymbolId};
use crate::ids::{ColumnId, Table, UnknownId};

impl Plan<'_, '_> {
    pub(super) fn velocity(&mut self) {
        if !self.signatures.is_open {
            self.solve_jacobian();
            self.velocity_ratios();
        }
        let unknowns = self.rates(&self.derivation.unknowns);
        let side = self.derivation.velocity_side();
        let steps = self.derivation.solution(&[(side, unknowns)], Form::Factored);
        let all = self.all();
        let nodes = self.variables(&self.rates(&all));
        let kernel = self.on_pose(vec![self.inputs(Order::Rate)], steps, unnamed(nodes));
        let kernel = Kernel { conclusive: 0..all.len(), ..kernel };
        let body = Body::of(kernel, self.coordinates_of(Order::Rate, 0)).checked("velocity", self.checked(0));
        let doc = lines([
            "The rates `q'` of all coordinates at the input rates `v'`.",
            "",
            "# Errors",
            "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if a rate is not finite.",
        ]);
        self.add(self.signatures.velocity(), doc, body);
    }

    /// The ids of all coordinates.
    fn all(&self) -> Table<ColumnId, ColumnId> {
        self.derivation.coordinates.ids().collect()
    }

    fn solve_jacobian(&mut self) {
        let right = self.signatures.arguments.right.clone();
        let unknowns = self.derivation.unknowns.clone();
        let parts: Table<UnknownId, SymbolId> = unknowns
            .into_iter()
            .map(|index| {
                let name = format!("{}_part", self.derivation.coordinates[index].name);
                self.derivation.graph.symbol(name)
            })
            .collect();
        let u = parts.len();
        let sides: Vec<SymbolId> = (1..=u).map(|row| self.derivation.graph.symbol(format!("right_{row}"))).collect();
        let side = self.variables(&sides).into();
        let steps = self.derivation.solution(&[(side, parts.clone())], Form::Factored);
        let outputs = self.outputs(&parts);
        let list = Type::List(Box::new(Type::Scalar), u);
        let from = Expression::of_type(list, Intrinsic::From, [Expression::name(&right).dereferenced()]);
        let source = Source { from, shape: Shape::list(&sides) };
        let kernel = self.on_pose(vec![source], steps, outputs);
        let body = Body::of(kernel, Expression::sized_vector(results(0..u))).checked("the solution", results(0..u));
        self.add(self.signatures.solve_jacobian(), lines(["The solution x of J x = `right`."]), body);
    }

    fn velocity_ratios(&mut self) {
        let steps = self.ratio_steps(Form::Factored);
        let names: Vec<SymbolId> = self.derivation.ratios.iter().flatten().copied().collect();
        let count = names.len();
        let outputs = self.outputs(&names);
        let kernel = self.on_pose(Vec::new(), steps, outputs);
        let matrix = Expression::matrix(&results(0..count), self.signatures.unknowns.len());
        let body = Body::of(kernel, matrix).checked("velocity ratios", results(0..count));
        let mut doc = match self.signatures.inputs.len() {
            1 => lines([
                "The velocity ratios `W = -J^-1 A` with `u' = W v'`; for one input they are the transmission ratios.",
            ]),
            _ => lines([
                "The velocity ratios `W = -J^-1 A` with `u' = W v'`: the rate of each unknown for a unit rate of each input.",
            ]),
        };
        let laws = names.iter().zip(self.formulas.ratios.iter().flatten());
        doc.extend(fenced(
            laws.filter_map(|(&name, formula)| Some(self.law(self.derivation.graph.symbol_name(name), (*formula)?))),
        ));
        doc.extend(lines([
            "",
            "# Errors",
            "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if a ratio is not finite.",
        ]));
        self.add(self.signatures.velocity_ratios(), doc, body);
    }

    /// The private functions that scenes call: W, `q' = (W v', v')`, and `u''` at `v'' = 0`. They check determinants only;
    /// their callers check that results are finite.
    pub(super) fn layers(&mut self) {
        if self.signatures.is_open {
            self.coordinate_rates();
            return;
        }
        self.ratio_columns();
        self.coordinate_rates();
        self.reduced_motion();
    }

    fn ratio_columns(&mut self) {
        let error_name = self.signatures.arguments.error_name.clone();
        let (u, v) = (self.signatures.unknowns.len(), self.signatures.inputs.len());
        let steps = self.ratio_steps(Form::Entries);
        let names: Vec<SymbolId> = self.derivation.ratios.iter().flatten().copied().collect();
        let nodes = self.variables(&names);
        let kernel = self.on_pose(Vec::new(), steps, unnamed(nodes));
        let columns = Expression::List(Expression::nested(results(0..u * v), &[u]));
        let signature = self.layer(self.signatures.ratio_columns(), &kernel);
        let kernel = Kernel { error_name: signature.is_fallible.then_some(error_name), ..kernel };
        self.add(signature, lines(["W = -J^-1 A, column by column."]), Body::of(kernel, columns));
    }

    fn coordinate_rates(&mut self) {
        let Arguments { input_rates, ratios, .. } = self.signatures.arguments.clone();
        let names: Vec<SymbolId> = self.derivation.ratios.iter().flatten().copied().collect();
        let rates = self.rates(&self.derivation.inputs.clone());
        let rates = self.variables(&rates);
        let mut nodes = BTreeMap::new();
        for (index, &unknown) in self.derivation.unknowns.clone().enumerated() {
            let ratios: Vec<SymbolId> = self.derivation.ratios.iter().map(|of_input| of_input[index]).collect();
            let terms = self.variables(&ratios).into_iter().zip(&rates);
            let graph = &mut self.derivation.graph;
            let terms: Vec<_> = terms.map(|(ratio, &rate)| (Number::ONE, graph.multiply(ratio, rate))).collect();
            nodes.insert(unknown, graph.sum(&terms));
        }
        nodes.extend(self.derivation.inputs.iter().copied().zip(rates));
        let by_value = Source { from: Expression::name(&input_rates), ..self.inputs(Order::Rate) };
        let u = self.signatures.unknowns.len();
        let columns = (u > 0).then(|| Shape::columns(u, &names));
        let columns = columns.map(|shape| Source { from: Expression::name(&ratios).dereferenced(), shape });
        let sources = columns.into_iter().chain([by_value]).collect();
        let kernel = Kernel { sources, results: unnamed(nodes.into_values()), ..Kernel::default() };
        let body = Body::of(kernel, self.coordinates_of(Order::Rate, 0));
        let text = if u > 0 { "The rates `q' = (W v', v')`." } else { "The rates `q' = v'`." };
        self.add(self.signatures.coordinate_rates(), without_result(lines([text])), body);
    }

    /// `reduced_motion`: the pose, W, `q'` and `u''` at `v'' = 0`.
    fn reduced_motion(&mut self) {
        let Arguments { q, input_rates, pose, ratios, rates, error_name, .. } = self.signatures.arguments.clone();
        let names = self.derivation.scenes.first().map(|scene| scene.bias.clone()).unwrap_or_default();
        let side = self.derivation.bias_side();
        let mut steps = self.derivation.solution(&[(side, names.clone())], Form::Entries);
        // `ratio_columns` has checked the determinants.
        steps.retain(|step| !matches!(step, Step::Guard { .. }));
        let nodes = self.variables(&names);
        let name = |name: &String| Expression::name(name);
        let ratio_columns = self.functions.iter().find(|function| function.name == "ratio_columns");
        let (is_fallible, is_method) = ratio_columns.map_or((true, true), |layer| (layer.is_fallible, layer.is_method));
        let mut on = vec![name(&pose).borrowed()];
        on.extend(is_fallible.then(|| name(&error_name)));
        let ratios_at = match is_method {
            true => Expression::own_call("ratio_columns", on),
            false => Expression::called_on(Receiver::ItsType, "ratio_columns", on),
        };
        let ratios_at = if is_fallible { ratios_at.tried() } else { ratios_at };
        let moving = [name(&ratios).borrowed(), name(&input_rates)];
        let before = [
            (&pose, Expression::own_call("pose_at", [name(&q)])),
            (&ratios, ratios_at),
            (&rates, Expression::called_on(Receiver::ItsType, "coordinate_rates", moving)),
        ];
        let before = before.map(|(name, value)| Statement::Let(Pattern::bound(name.clone()), value));
        let moving = Source { from: name(&rates), ..self.coordinates(Order::Rate) };
        let at_pose = Source { from: name(&pose), ..self.pose_source() };
        let sources = vec![self.parameters(), at_pose, moving];
        let error_name = is_fallible.then_some(error_name);
        let kernel =
            Kernel { sources, steps, results: unnamed(nodes), error_name, is_on_pose: true, ..Kernel::default() };
        let bias = Expression::List(results(0..names.len()));
        let members = [("pose", name(&pose)), ("ratios", name(&ratios)), ("rates", name(&rates)), ("bias", bias)];
        let members = members.map(|(field, value)| (field.to_owned(), value));
        let value = Expression::structure(Type::Runtime("ReducedMotion", Vec::new()), members);
        let body = Body { before: before.to_vec(), ..Body::of(kernel, value) };
        let mut signature = self.signatures.reduced_motion();
        signature.is_fallible = is_fallible;
        if !is_fallible {
            signature.arguments.pop();
        }
        let doc = lines(["The pose, W, `q' = (W v', v')`, and `u''` at `v'' = 0`: `J u'' = -gamma`."]);
        self.add(signature, doc, body);
    }

    fn gamma(&mut self) {
        let gamma = self.derivation.gamma.clone();
        let mut doc = lines(["The quadratic velocity term gamma = `(Psi_q q')_q q'`."]);
        doc.extend(self.numbered("gamma", &gamma));
        let count = gamma.len();
        let kernel = self.on_pose(vec![self.coordinates(Order::Rate)], Vec::new(), unnamed(gamma));
        let body = Body::of(kernel, Expression::sized_vector(results(0..count)));
        self.add(self.signatures.gamma(), doc, body);
    }

    pub(super) fn acceleration(&mut self) {
        if !self.signatures.is_open {
            self.gamma();
        }
        let unknowns = self.accelerations(&self.derivation.unknowns);
        let side = self.derivation.acceleration_side();
        let steps = self.derivation.solution(&[(side, unknowns)], Form::Entries);
        let all = self.all();
        let nodes = self.variables(&self.accelerations(&all));
        let sources = vec![self.coordinates(Order::Rate), self.inputs(Order::Acceleration)];
        let kernel = Kernel { conclusive: 0..all.len(), ..self.on_pose(sources, steps, unnamed(nodes)) };
        let body = Body::of(kernel, self.coordinates_of(Order::Acceleration, 0));
        let body = body.checked("acceleration", self.checked(0));
        let text = match self.signatures.is_open {
            true => "The accelerations `q''` of all coordinates: the input accelerations `v''`.",
            false => {
                "The accelerations `q''` of all coordinates at the rates `q'` and the input accelerations `v''`: `J u'' = -(A v'' + gamma)`."
            }
        };
        let doc = lines([
            text,
            "",
            "# Errors",
            "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if an acceleration is not finite.",
        ]);
        self.add(self.signatures.acceleration(), doc, body);
    }

    pub(super) fn jerk(&mut self) {
        let mut doc = match self.signatures.is_open {
            true => lines(["The jerks `q'''` of all coordinates: the input jerks `v'''`."]),
            false => lines([
                "The jerks `q'''` of all coordinates at the rates `q'`, the accelerations `q''` and the input jerks `v'''`:",
                "`J u''' = -(A v''' + eta)` with eta = `3 (Psi_q q')_q q'' + ((Psi_q q')_q q')_q q'`.",
            ]),
        };
        let eta = self.derivation.eta.clone().unwrap_or_default();
        doc.extend(self.numbered("eta", &eta));
        doc.extend(lines([
            "",
            "# Errors",
            "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if a jerk is not finite.",
        ]));
        let jerks: Table<ColumnId, SymbolId> =
            self.derivation.coordinates.iter().map(|coordinate| coordinate.jerk).collect();
        let targets = self.derivation.unknowns.iter().map(|&index| jerks[index]).collect();
        let side = self.derivation.jerk_side();
        let steps = self.derivation.solution(&[(side, targets)], Form::Factored);
        let nodes = self.variables(&jerks);
        let [rates, accelerations] = [Order::Rate, Order::Acceleration].map(|order| self.coordinates(order));
        let sources = vec![rates, accelerations, self.inputs(Order::Jerk)];
        let kernel = self.on_pose(sources, steps, unnamed(nodes));
        let body = Body::of(kernel, self.coordinates_of(Order::Jerk, 0)).checked("jerk", self.checked(0));
        self.add(self.signatures.jerk(), doc, body);
    }

    /// `motion`: position, velocity and acceleration of everything in one kernel.
    pub(super) fn motion(&mut self) {
        let unknowns = self.derivation.unknowns.clone();
        let sides = [
            (self.derivation.velocity_side(), self.rates(&unknowns)),
            (self.derivation.acceleration_side(), self.accelerations(&unknowns)),
        ];
        let links = Assembly::default();
        // With several groups, the next one waits for the solution of a group.
        let is_long = self.derivation.groups.len() > 1;
        let form = if is_long { Form::Inverse(&links) } else { Form::Entries };
        let steps = self.derivation.solution(&sides, form);
        let steps = self.with_determinants(steps);
        let all = self.all();
        let mut nodes = self.variables(&self.rates(&all));
        nodes.extend(self.variables(&self.accelerations(&all)));
        let values: Vec<SymbolId> = self.derivation.coordinates.iter().map(|coordinate| coordinate.value).collect();
        nodes.extend(self.variables(&values));
        let count = all.len();
        let (quantities, of_quantities) = self.moving_quantities(3 * count);
        nodes.extend(quantities);
        let [rates, accelerations] = [Order::Rate, Order::Acceleration].map(|order| self.inputs(order));
        let sources = vec![self.coordinates(Order::Value), rates, accelerations];
        let kernel = Kernel { conclusive: count..2 * count, ..self.kernel(sources, steps, unnamed(nodes)) };
        let mut members = vec![
            ("position".to_owned(), Expression::name(&self.signatures.arguments.q).dereferenced()),
            ("rates".to_owned(), self.coordinates_of(Order::Rate, 0)),
            ("accelerations".to_owned(), self.coordinates_of(Order::Acceleration, count)),
        ];
        members.extend(of_quantities);
        let checked = [self.checked(0), self.checked(count)].concat();
        let motion = Type::Bare(self.signatures.types.motion.clone());
        let body = Body::of(kernel, Expression::structure(motion, members));
        // A coordinate that is not finite need not make a rate so. It is known before the accelerations.
        let body = body.checked("the position", results(2 * count..3 * count)).checked("motion", checked);
        let body = if is_long { body.stored_in("motion") } else { body };
        let doc = lines([
            "The rates `q'`, the accelerations `q''`, and the motion of points and outputs at the coordinates q of a position, input",
            "rates `v'` and input accelerations `v''`, with common subexpressions computed once.",
            "",
            "# Errors",
            "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if a coordinate or a result is not finite.",
        ]);
        self.add(self.signatures.motion(), doc, body);
    }
}

impl Plan<'_, '_> {
    /// The final signature of a private function: without checks it has no `Result` and no last argument, the name in
    /// errors; without parameters of the mechanism it takes no `self`.
    fn layer(&self, mut signature: Function<Body>, kernel: &Kernel) -> Function<Body> {
        let may_fail = |step: &Step| matches!(step, Step::Guard { .. } | Step::Factor { .. });
        let is_fallible = kernel.steps.iter().any(may_fail);
        if !is_fallible {
            signature.arguments.pop();
        }
        Function { is_fallible, is_method: self.reads_parameters(kernel), ..signature }
    }

    /// True if a kernel depends on a parameter of the mechanism.
    pub(super) fn reads_parameters(&self, kernel: &Kernel) -> bool {
        let nodes = kernel.steps.iter().flat_map(Step::nodes);
        let nodes: Vec<NodeId> = nodes.chain(kernel.results.iter().map(|output| output.node)).collect();
        let symbols = self.derivation.graph.symbols_of(&nodes);
        let parameters = &self.mechanism.parameters;
        parameters.iter().any(|parameter| symbols.contains(&parameter.symbol))
    }
}
