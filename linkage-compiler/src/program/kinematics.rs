//! Position, velocity and acceleration in one kernel: the links that the position is solved for are those of the
//! velocity and the acceleration, so that nothing is computed twice.

use std::collections::BTreeSet;

use linkage_ir::Intrinsic;

use super::doc::lines;
use super::expression::{Expression, Pattern, Statement, Type};
use super::function::{Body, Failure, Kernel, Source, Value, results};
use super::names::Order;
use super::plan::{Plan, unnamed};
use super::position::OF_A_BRANCH;
use super::precise::ROUGH;
use super::signatures::Family;
use crate::derivation::{ChordGeometry, Form, Quantity, Step, merged, needed_names};
use crate::graph::NodeId;
use crate::ids::{ColumnId, GroupId, Table};

const ERRORS: [&str; 3] =
    ["", "# Errors", "The error that the separate calls for position, velocity and acceleration return first."];

impl Plan<'_, '_> {
    /// `kinematics`, or `kinematics_near` from a guess, and the same with points and outputs.
    pub(super) fn kinematics(&mut self) {
        let (assemble, from) = match self.position.is_closed {
            true => ("assemble", self.signatures.arguments.inputs.clone()),
            false => ("assemble_near", self.signatures.arguments.guess.clone()),
        };
        let arguments = [&from, &self.signatures.arguments.branch].map(Expression::name);
        let body = self.by_parts(Expression::own_call(assemble, arguments));
        let doc = lines(["The same by separate calls, which say what is wrong."]);
        let by_parts = self.signatures.kinematics_by_parts(&self.position);
        let otherwise = by_parts.name.clone();
        self.add(by_parts, doc, body);
        let body = self.kinematics_body(&otherwise);
        if body.kernel.as_ref().is_some_and(Kernel::is_factorised) {
            self.precise_kinematics();
        }
        let doc = lines([
            "The position, the rates `q'` and the accelerations `q''` of all coordinates in one computation, from the inputs, their",
            "rates `v'` and their accelerations `v''`.",
        ]);
        let promise = if self.signatures.is_open { Vec::new() } else { lines([OF_A_BRANCH]) };
        let doc = doc.into_iter().chain(promise).chain(lines(ERRORS)).collect();
        self.add(self.signatures.kinematics(&self.position), doc, body);
        if self.signatures.has_quantities() {
            self.full_kinematics();
        }
    }

    /// The body of `kinematics`, which calls another function where its kernel fails.
    pub(super) fn kinematics_body(&mut self, otherwise: &str) -> Body {
        let names = &self.signatures.arguments;
        let from = if self.position.is_closed { &names.inputs } else { &names.guess };
        let arguments = [from, &names.branch, &names.input_rates, &names.input_accelerations];
        let call = Expression::own_call(otherwise, arguments.map(Expression::name));
        let (kernel, conditions) = self.kinematics_kernel(Failure::Return(call.clone()));
        let is_factorised = kernel.is_factorised();
        let is_chord = |step: &&Step| matches!(step, Step::Chord { .. });
        let is_long = kernel.steps.iter().filter(is_chord).count() > 1;
        let value = self.kinematics_of_results(&kernel);
        let mut body = Body::of(kernel, value);
        body.before = self.before_kinematics();
        if is_long {
            body = body.stored_in("kinematics");
        }
        body.after.push(Statement::CheckKinematics { conditions, otherwise: call });
        if is_factorised {
            self.refine_kinematics(&mut body);
        }
        body
    }

    /// Refines the rates and accelerations of `kinematics`.
    fn refine_kinematics(&self, body: &mut Body) {
        let names = &self.signatures.arguments;
        let Value::Plain(Expression::Struct(of, members, _)) = &body.value else { return };
        let [(_, pose), (_, rates), (_, accelerations)] = members.as_slice() else { return };
        let name = |name: &String| Expression::name(name);
        let precise = [name(&names.pose).borrowed(), name(&names.input_rates), name(&names.input_accelerations)];
        let precise = precise.into_iter().chain([Expression::name(ROUGH)]);
        let precise = Expression::own_call("precise_kinematics", precise);
        let both = [&names.rates, &names.accelerations].map(|name| Pattern::bound(name.clone()));
        let rough = Expression::Tuple(vec![rates.clone(), accelerations.clone()]);
        body.after.push(Statement::Let(Pattern::bound(names.pose.clone()), pose.clone()));
        body.after.push(Statement::Refine(Pattern::Tuple(both.to_vec()), rough, precise));
        let of_names = [("pose", &names.pose), ("rates", &names.rates), ("accelerations", &names.accelerations)];
        let of_names = of_names.map(|(field, value)| (field.to_owned(), name(value)));
        body.value = Value::Plain(Expression::structure(of.clone(), of_names));
    }

    /// The pose, the rates and the accelerations from the results of the kernel.
    pub(super) fn kinematics_of_results(&self, kernel: &Kernel) -> Expression {
        let [rates, accelerations] = [kernel.conclusive.start - kernel.conclusive.len(), kernel.conclusive.start];
        let members = [
            ("pose", self.pose_of_results()),
            ("rates", self.coordinates_of(Order::Rate, rates)),
            ("accelerations", self.coordinates_of(Order::Acceleration, accelerations)),
        ];
        let of = Type::Bare(self.signatures.types.kinematics.clone());
        Expression::structure(of, members.map(|(field, value)| (field.to_owned(), value)))
    }

    /// The kernel, whose results are the pose, the rates and the accelerations; and the conditions to check: that
    /// determinants are not zero relative to their scales, and that implied loops close.
    pub(super) fn kinematics_kernel(&mut self, failure: Failure) -> (Kernel, Vec<Expression>) {
        let (determinants, steps) = self.kinematics_steps();
        let (_, mut outputs) = self.position_steps();
        let of_pose = outputs.len();
        let columns: Table<ColumnId, ColumnId> = self.derivation.coordinates.ids().collect();
        for symbols in [self.rates(&columns), self.accelerations(&columns)] {
            outputs.extend(unnamed(self.variables(&symbols)));
        }
        let of_motion = outputs.len();
        let implied = self.implied_pairs();
        let implied = self.assembly.solved(&mut self.derivation.graph, &implied.concat());
        outputs.extend(unnamed(determinants.iter().flatten().chain(&implied).copied()));
        let nodes: Vec<NodeId> = outputs.iter().map(|output| output.node).collect();
        let steps = needed_names(&self.derivation.graph, steps, &nodes);
        let names = self.signatures.arguments.clone();
        let by_value = |source: Source, name: &str| Source { from: Expression::name(name), ..source };
        let sources = vec![
            if self.position.is_closed { by_value(self.inputs(Order::Value), &names.inputs) } else { self.guess() },
            by_value(self.inputs(Order::Rate), &names.input_rates),
            by_value(self.inputs(Order::Acceleration), &names.input_accelerations),
        ];
        let turns = self.position.turns.iter().enumerate();
        let mut dyads = self.dyads();
        dyads.resize(of_motion, None);
        let kernel = Kernel {
            turns: turns.map(|(index, turn)| (turn.symbol, index)).collect(),
            dyads,
            failure,
            conclusive: of_pose + columns.len()..of_motion,
            ..self.kernel(sources, steps, outputs)
        };
        let all = results(of_motion..of_motion + 2 * determinants.len() + implied.len());
        let (determinants, implied) = all.split_at(2 * determinants.len());
        let conditions = [(Intrinsic::IsNonzero, determinants), (Intrinsic::Closes, implied)]
            .into_iter()
            .flat_map(|(check, pairs)| pairs.chunks_exact(2).map(move |pair| Expression::call(check, pair.to_vec())));
        (kernel, conditions.collect())
    }

    /// The steps of the position, velocity and acceleration; and the determinants to check, each with its scale: those
    /// of dyads are not zero if their chords are regular.
    fn kinematics_steps(&mut self) -> (Vec<[NodeId; 2]>, Vec<Step>) {
        let unknowns = self.derivation.unknowns.clone();
        let sides = [
            (self.derivation.velocity_side(), self.rates(&unknowns)),
            (self.derivation.acceleration_side(), self.accelerations(&unknowns)),
        ];
        let moving = self.derivation.solution(&sides, Form::Inverse(&self.assembly));
        let moving = self.assembly.solved_steps(&mut self.derivation.graph, moving);
        let mut determinants = Vec::new();
        let mut solving = Vec::new();
        let dyads: BTreeSet<GroupId> = self.assembly.of_dyads.values().copied().collect();
        for step in moving {
            match step {
                Step::Guard { group, .. } if dyads.contains(&group) => {}
                Step::Guard { determinant, scale, .. } => determinants.push([determinant, scale]),
                step => solving.push(step),
            }
        }
        let assembling = self.assembly.steps.iter().cloned().map(regular).collect();
        (determinants, merged(&self.derivation.graph, assembling, solving))
    }

    /// Statements that convert the arguments that are `impl Into`, and bind the turns of angles.
    fn before_kinematics(&self) -> Vec<Statement> {
        let names = &self.signatures.arguments;
        let value = self.position.is_closed.then_some(&names.inputs);
        let all = value.into_iter().chain([&names.input_rates, &names.input_accelerations]);
        let of = Type::Own(self.signatures.types.inputs.clone());
        let converted = all
            .map(|name| Statement::Let(Pattern::typed(name.clone(), of.clone()), Expression::name(name).converted()));
        let mut statements: Vec<Statement> = converted.collect();
        if self.position.is_closed {
            statements.extend(self.turns_of_branch());
        } else if !self.position.turns.is_empty() {
            statements.extend(self.nearest_turns(&names.guess, &names.turn));
        }
        statements
    }

    /// The statement that binds the turns of a branch, if it has any.
    pub(super) fn turns_of_branch(&self) -> Vec<Statement> {
        if self.position.turns.is_empty() {
            return Vec::new();
        }
        let names = &self.signatures.arguments;
        let branch = Expression::name(&names.branch);
        let fields = self.position.turns.iter().map(|turn| branch.clone().field(&turn.field));
        let turns = Expression::call(Intrinsic::Turns, [Expression::List(fields.collect())]);
        vec![Statement::Let(Pattern::bound(names.turn.clone()), turns)]
    }

    /// The position by this call, then the rates and the accelerations, each by a call that finds its error.
    pub(super) fn by_parts(&self, pose: Expression) -> Body {
        let names = &self.signatures.arguments;
        let name = |name: &String| Expression::name(name);
        let [at_pose, at_rates] = [&names.pose, &names.rates].map(|argument| name(argument).borrowed());
        let rates = Expression::own_call("velocity", [at_pose.clone(), name(&names.input_rates)]);
        let accelerations = Expression::own_call("acceleration", [at_pose, at_rates, name(&names.input_accelerations)]);
        let before = [(&names.pose, pose), (&names.rates, rates), (&names.accelerations, accelerations)];
        let before = before.map(|(name, call)| Statement::Let(Pattern::bound(name.clone()), call.tried()));
        let members = [("pose", &names.pose), ("rates", &names.rates), ("accelerations", &names.accelerations)];
        let members = members.map(|(field, value)| (field.to_owned(), name(value)));
        let of = Type::Bare(self.signatures.types.kinematics.clone());
        Body { before: before.to_vec(), ..Body::plain(Expression::structure(of, members)) }
    }

    /// `full_kinematics`: with points and outputs.
    fn full_kinematics(&mut self) {
        let names = self.signatures.arguments.clone();
        let own = self.signatures.kinematics(&self.position);
        let arguments = own.arguments.iter().map(|argument| Expression::name(&argument.name));
        let call = Expression::own_call(&own.name, arguments).tried();
        let parts = [("pose", &names.pose), ("rates", &names.rates), ("accelerations", &names.accelerations)];
        let fields = parts.map(|(field, name)| (field.to_owned(), Pattern::bound(name.clone())));
        let of = Type::Bare(self.signatures.types.kinematics.clone());
        let pattern = Pattern::Struct { of, fields: fields.to_vec(), is_whole: true };
        let kernel = self.quantities_kernel(Failure::Error);
        let (_, quantities) = self.moving_quantities(0);
        let members = parts.map(|(field, name)| (field.to_owned(), Expression::name(name)));
        let of = Type::Bare(self.signatures.types.full_kinematics.clone());
        let value = Expression::structure(of, members.into_iter().chain(quantities));
        let before = vec![Statement::Let(pattern, call)];
        let body = Body { before, ..Body::of(kernel, value) };
        let doc = lines([
            "The position, the rates `q'` and the accelerations `q''` of all coordinates, and the motion of points and outputs, from the",
            "inputs, their rates `v'` and their accelerations `v''`.",
        ]);
        let promise = if self.signatures.is_open { Vec::new() } else { lines([OF_A_BRANCH]) };
        let doc = doc.into_iter().chain(promise).chain(lines(ERRORS)).collect();
        self.add(self.signatures.full_kinematics(&self.position), doc, body);
    }

    /// The formulas of points and outputs with their derivatives on a pose.
    pub(super) fn quantities_kernel(&mut self, failure: Failure) -> Kernel {
        let names = &self.signatures.arguments;
        let by_value = |source: Source, name: &str| Source { from: Expression::name(name), ..source };
        let sources = vec![
            self.parameters(),
            by_value(self.pose_source(), &names.pose),
            by_value(self.coordinates(Order::Rate), &names.rates),
            by_value(self.coordinates(Order::Acceleration), &names.accelerations),
        ];
        let (nodes, _) = self.moving_quantities(0);
        Kernel { sources, results: unnamed(nodes), is_on_pose: true, failure, ..Kernel::default() }
    }

    /// The formulas of points and outputs with their derivatives, and the fields made of them as results from a place
    /// on.
    pub(super) fn moving_quantities(&self, from: usize) -> (Vec<NodeId>, Vec<(String, Expression)>) {
        let quantities = self.derivation.points.iter().chain(&self.derivation.outputs);
        let of_each = |quantity: &Quantity| -> Vec<NodeId> {
            [&quantity.value, &quantity.rate, &quantity.acceleration].into_iter().flatten().copied().collect()
        };
        let nodes: Vec<NodeId> = quantities.flat_map(of_each).collect();
        let points = from + 6 * self.derivation.points.len();
        let mut members = Vec::new();
        for (family, function, values, sizes) in [
            (Family::Points, Intrinsic::PointMotions, results(from..points), &[3, 2][..]),
            (Family::Outputs, Intrinsic::OutputMotions, results(points..from + nodes.len()), &[3][..]),
        ] {
            let motions = match self.signatures.has(family) {
                true => {
                    let values = Expression::List(Expression::nested(values, sizes));
                    Expression::call(function, [Expression::mechanism(), values]).tried()
                }
                false => Expression::List(Vec::new()),
            };
            members.push((format!("{}s", family.word()), motions));
        }
        (nodes, members)
    }
}

/// A half chord that is zero or has no size is left to the separate calls.
fn regular(step: Step) -> Step {
    match step {
        Step::Chord { group, symbol, factors, size, of: ChordGeometry::Circle { scales: [scale, _], may_cancel } } => {
            let of = ChordGeometry::RegularCircle { scale: may_cancel.then_some(scale) };
            Step::Chord { group, symbol, factors, size, of }
        }
        other => other,
    }
}
