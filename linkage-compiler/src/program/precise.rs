//! The functions that solve groups by factorisation in twice the precision, where a group is nearly singular: the emitted
//! function itself over a scalar of twice the precision, from the angles of the pose as numbers.

use super::doc::lines;
use super::expression::{Expression, Pattern, Statement, Type};
use super::function::{Access, Argument, Body, Failure, Function, Kernel, Passed, Source, Value};
use super::plan::{Plan, unnamed};
use super::signatures::total;
use crate::derivation::Step;
use crate::graph::{Function as Elementary, Node, NodeId, SymbolId};

/// The function that widens the mechanism and a pose.
const WIDENED: &str = "widened";
/// The function that computes directions from the numbers of a pose.
const AT_NUMBERS: &str = "at_numbers";
/// The wide mechanism.
const MECHANISM: &str = "mechanism";

impl Kernel {
    /// True if a group is solved by factorisation.
    pub(super) fn is_factorised(&self) -> bool {
        self.steps.iter().any(|step| matches!(step, Step::Solve { .. }))
    }
}

impl Plan<'_, '_> {
    /// Refines the result of a function on a pose if a group is solved by factorisation.
    pub(super) fn refined(&mut self, signature: &Function<Body>, mut body: Body) -> Body {
        let Some(kernel) = &mut body.kernel else { return body };
        let is_rough = kernel.is_factorised() && kernel.is_on_pose && matches!(kernel.failure, Failure::Error);
        let (Some(rounded), Value::Plain(value)) = (rounding(&signature.returns), &body.value) else { return body };
        if !is_rough || !signature.access.is_public() {
            return body;
        }
        for Argument { name, passed } in &signature.arguments {
            if let Passed::Converted(_) = passed {
                let name = Expression::name(name);
                let converted = name.clone().method("into", []);
                for source in kernel.sources.iter_mut().filter(|source| source.from == converted) {
                    source.from = name.clone();
                }
            }
        }
        let (rough, precise) = (value.clone(), format!("precise_{}", signature.name));
        body.before.extend(signature.arguments.iter().filter_map(converted));
        let arguments = signature.arguments.iter().map(|argument| Expression::name(&argument.name));
        let call = Expression::call(&precise, arguments);
        let value = body.local("refined");
        body.after.push(Statement::Refine(Pattern::Local(body.locals.len() - 1), rough, call));
        body.value = Value::Plain(value);
        body.calls.push(precise.clone());
        self.precise(precise, signature, rounded);
        body
    }

    /// The function in twice the precision.
    fn precise(&mut self, name: String, of: &Function<Body>, rounded: &'static str) {
        let others = of.arguments.iter().skip(1);
        let mut before = vec![self.widened_at_pose()];
        before.extend(others.clone().map(|argument| self.widened_argument(argument)));
        let others = others.map(|Argument { name, passed }| match passed {
            Passed::ByReference(_) => Expression::name(name).borrowed(),
            _ => Expression::name(name),
        });
        let pose = Expression::name(&self.signatures.arguments.pose).borrowed();
        let call = Expression::name(MECHANISM).method(&of.name, [pose].into_iter().chain(others));
        let body = Body { before, calls: vec![WIDENED.to_owned()], ..Body::plain(Expression::runtime(rounded, [call.method("ok", []).tried()])) };
        let arguments = of.arguments.iter().cloned().map(by_value);
        let returns = Type::Around("Option", Box::new(of.returns.clone()));
        let signature = Function { access: Access::Cold, ..total(name, arguments, returns) };
        let doc = [format!("`{}` in twice the precision, rounded once; `None` if that overflows.", of.name)];
        self.add(signature, doc.to_vec(), body);
    }

    /// The rates and accelerations at a pose in twice the precision.
    pub(super) fn precise_kinematics(&mut self) {
        let names = self.signatures.arguments.clone();
        let inputs = &self.signatures.types.inputs;
        let widened = |name: &String| widened_by_name(name, inputs, Expression::name(name));
        let before = vec![self.widened_at_pose(), widened(&names.input_rates), widened(&names.input_accelerations)];
        let call = |function: &str, arguments: Vec<Expression>| {
            Expression::name(MECHANISM).method(function, arguments).method("ok", []).tried()
        };
        let [pose, rates] = [&names.pose, &names.rates].map(|name| Expression::name(name).borrowed());
        let velocity = call("velocity", vec![pose.clone(), Expression::name(&names.input_rates)]);
        let acceleration = call("acceleration", vec![pose, rates, Expression::name(&names.input_accelerations)]);
        let of_each = [(&names.rates, velocity), (&names.accelerations, acceleration)];
        let of_each = of_each.map(|(name, value)| Statement::Let(Pattern::Name(name.clone()), value));
        let before = before.into_iter().chain(of_each).collect();
        let rounded = |name| Expression::runtime("rounded_by_name", [Expression::name(name)]).tried();
        let both = Expression::Tuple([&names.rates, &names.accelerations].map(rounded).to_vec());
        let value = Expression::runtime("Some", [both]);
        let body = Body { before, calls: vec![WIDENED.to_owned()], ..Body::plain(value) };
        let doc = lines(["The rates q' and accelerations q'' in twice the precision, rounded once; `None` if that overflows."]);
        self.add(self.signatures.precise_kinematics(), doc, body);
    }

    /// `let (mechanism, pose) = self.widened(pose);`
    pub(super) fn widened_at_pose(&self) -> Statement {
        let pose = &self.signatures.arguments.pose;
        let names = [MECHANISM, pose].map(|name| Pattern::Name(name.to_owned()));
        Statement::Let(Pattern::Tuple(names.to_vec()), Expression::call(WIDENED, [Expression::name(pose)]))
    }

    /// The statement that widens an argument other than the pose.
    fn widened_argument(&self, Argument { name, passed }: &Argument) -> Statement {
        let value = Expression::name(name);
        match passed {
            Passed::ByReference(Type::Own(of)) => widened_by_name(name, of, value.dereferenced()),
            Passed::ByValue(Type::Own(of)) | Passed::Converted(Type::Own(of)) => widened_by_name(name, of, value),
            _ => Statement::Let(Pattern::Name(name.clone()), Expression::runtime("widened_matrix", [value])),
        }
    }

    /// `widened`, and the function of directions that it calls.
    pub(super) fn widening(&mut self) {
        if self.derivation.blocks.iter().all(|block| block.determinant.is_some()) {
            return;
        }
        self.at_numbers();
        let pose = self.signatures.arguments.pose.clone();
        let parameters = &self.signatures.mechanism.parameters;
        let parameters = parameters.iter().map(|parameter| Expression::own().field(&parameter.name.field)).collect();
        let each = |function| Expression::Constant(function);
        let parameters = Expression::List(parameters).method("map", [each("widened")]);
        let driver = Type::Bare(self.signatures.types.driver.clone());
        let mechanism = Expression::associated(driver, "from", [parameters]);
        let of_pose = |field: &String| Expression::name(&pose).field(field);
        let directions = self.pose.directions.values();
        let directions = directions.map(|field| (field, Expression::runtime("widened_direction", [of_pose(field)])));
        let numbers = self.pose.values.iter().map(|(_, field, _)| field);
        let numbers = numbers.chain(self.pose.determinants.iter().map(|(_, field, _)| field));
        let numbers = numbers.chain(self.pose.externals.iter().map(|(_, field, _)| field));
        let numbers = numbers.map(|field| (field, Expression::runtime("widened", [of_pose(field)])));
        let members = directions.chain(numbers).map(|(field, value)| (field.clone(), value));
        let wide = Expression::structure(Type::Bare(self.signatures.types.pose.clone()), members);
        let let_name = |name: &str, value| Statement::Let(Pattern::Name(name.to_owned()), value);
        let wide = Expression::name(MECHANISM).method(AT_NUMBERS, [wide]);
        let before = vec![let_name(MECHANISM, mechanism), let_name(&pose, wide)];
        let value = Expression::Tuple(vec![Expression::name(MECHANISM), Expression::name(&pose)]);
        let body = Body { before, calls: vec![AT_NUMBERS.to_owned()], ..Body::plain(value) };
        let returns = [&self.signatures.types.driver, &self.signatures.types.pose];
        let returns = Type::Tuple(returns.map(|name| Type::Wide(name.clone())).to_vec());
        let signature = Function { access: Access::Cold, ..total(WIDENED, [self.signatures.pose()], returns) };
        let doc = lines(["This mechanism and a pose of it in twice the precision."]);
        self.add(signature, doc, body);
    }

    /// The pose with directions computed from its numbers: those of a pose in twice the precision are rounded.
    fn at_numbers(&mut self) {
        let known: Vec<SymbolId> = self.pose.values.iter().map(|(.., symbol)| *symbol).collect();
        let parameters = self.signatures.mechanism.parameters.iter().map(|parameter| parameter.symbol);
        let known: Vec<SymbolId> = known.into_iter().chain(parameters).collect();
        let graph = &mut self.derivation.graph;
        let is_known = |angle: NodeId| {
            let is_external = |&id: &NodeId| matches!(graph.node(id), Node::External(..));
            let mut parts = graph.sweep(&[angle], |_| false, |_| false).into_iter();
            !parts.any(|id| is_external(&id)) && graph.symbols_of(&[angle]).iter().all(|symbol| known.contains(symbol))
        };
        let angles: Vec<NodeId> = self.pose.angles().filter(|&angle| is_known(angle)).collect();
        let both = [Elementary::Cos, Elementary::Sin];
        let nodes: Vec<NodeId> =
            angles.iter().flat_map(|&angle| both.map(|function| (angle, function))).map(|(angle, function)| graph.call(function, &[angle])).collect();
        let pose = self.signatures.arguments.pose.clone();
        let members = angles.iter().enumerate().map(|(place, &angle)| {
            let parts = [2 * place, 2 * place + 1].map(Expression::Result);
            (self.pose.direction(angle).to_owned(), Expression::runtime("unit", parts))
        });
        let value = Expression::Struct(
            self.signatures.pose_type(),
            members.collect(),
            Some(Box::new(Expression::name(&pose))),
        );
        let numbers = Source { from: Expression::name(&pose), ..self.pose_source() };
        let kernel = self.kernel(vec![numbers], Vec::new(), unnamed(nodes));
        let pose = Argument { name: pose, passed: Passed::ByValue(self.signatures.pose_type()) };
        let signature = total(AT_NUMBERS, [pose], self.signatures.pose_type());
        let signature = Function { access: Access::Cold, ..signature };
        let doc = lines(["The pose with the directions of the angles that it holds as numbers computed anew."]);
        self.add(signature, doc, Body::of(kernel, value));
    }
}

/// `let name: Name<Wide> = widened_by_name(value);`
pub(super) fn widened_by_name(name: &str, of: &str, value: Expression) -> Statement {
    let pattern = Pattern::Typed(name.to_owned(), Type::Wide(of.to_owned()));
    Statement::Let(pattern, Expression::runtime("widened_by_name", [value]))
}

/// The function of the runtime that rounds a result, if there is one for its type.
fn rounding(of: &Type) -> Option<&'static str> {
    match of {
        Type::Own(_) => Some("rounded_by_name"),
        Type::Vector(_) | Type::Matrix(..) => Some("rounded_matrix"),
        Type::List(item, _) if matches!(**item, Type::Matrix(..)) => Some("rounded_matrices"),
        _ => None,
    }
}

/// `let argument: Type = argument.into();` for an argument that is `impl Into<Type>`.
fn converted(Argument { name, passed }: &Argument) -> Option<Statement> {
    let Passed::Converted(of) = passed else { return None };
    Some(Statement::Let(Pattern::Typed(name.clone(), of.clone()), Expression::name(name).method("into", [])))
}

/// The argument after its conversion.
fn by_value(argument: Argument) -> Argument {
    match argument.passed {
        Passed::Converted(of) => Argument { passed: Passed::ByValue(of), ..argument },
        _ => argument,
    }
}
