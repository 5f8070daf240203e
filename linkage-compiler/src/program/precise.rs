//! The functions that solve groups by factorisation in twice the precision, where a group is nearly singular: the emitted
//! function itself over a scalar of twice the precision, from the angles of the pose as numbers.

use linkage_ir::Intrinsic;

use super::doc::lines;
use super::expression::{Expression, Pattern, Receiver, Statement, Type};
use super::function::{Access, Argument, Body, Failure, Function, Kernel, Passed, Source, Value};
use super::names::{Arguments, Order};
use super::plan::{Plan, unnamed};
use super::signatures::{Family, Signatures, total};
use crate::derivation::Step;
use crate::graph::{Function as Elementary, Node, NodeId, SymbolId};

/// The function that widens the mechanism.
const WIDENED: &str = "widened";
/// The function that widens a pose.
const WIDENED_POSE: &str = "widened_pose";
/// The function that computes directions from the numbers of a pose.
const AT_NUMBERS: &str = "at_numbers";
/// The wide mechanism.
const MECHANISM: &str = "mechanism";
/// The wide motion.
const MOTION: &str = "motion";
/// The result in the scalar of the caller, whose bound a scalar may carry.
pub const ROUGH: &str = "rough";

impl Kernel {
    /// True if a group is solved by factorisation.
    pub(super) fn is_factorised(&self) -> bool {
        self.steps.iter().any(|step| matches!(step, Step::Solve { .. }))
    }
}

impl Plan<'_, '_> {
    /// Refines the result of a function if a group is solved by factorisation.
    pub(super) fn refined(&mut self, signature: &Function<Body>, mut body: Body) -> Body {
        let Some(kernel) = &mut body.kernel else { return body };
        let Value::Plain(rough) = &body.value else { return body };
        let is_rough = kernel.is_factorised() && matches!(kernel.failure, Failure::Error);
        if !is_rough || !signature.access.is_public() {
            return body;
        }
        for argument in &signature.arguments {
            let Some(Statement::Let(pattern, into)) = converted(argument) else { continue };
            for source in kernel.sources.iter_mut().filter(|source| source.from == into) {
                source.from = Expression::name(&argument.name);
            }
            body.before.push(Statement::Let(pattern, into));
        }
        let (rough, precise) = (rough.clone(), format!("precise_{}", signature.name));
        let arguments = signature.arguments.iter().map(|argument| Expression::name(&argument.name));
        let call = Expression::own_call(&precise, arguments.chain([Expression::name(ROUGH)]));
        let value = body.local("refined");
        body.after.push(Statement::Refine(Pattern::bound(body.locals.len() - 1), rough, call));
        body.value = Value::Plain(value);
        self.precise(precise, signature);
        body
    }

    /// The function in twice the precision.
    fn precise(&mut self, name: String, of: &Function<Body>) {
        let mut before = vec![self.let_widened()];
        before.extend(of.arguments.iter().map(|argument| self.let_widened_argument(argument)));
        let arguments = of.arguments.iter().map(|Argument { name, passed }| match passed {
            Passed::ByReference(_) => Expression::name(name).borrowed(),
            _ => Expression::name(name),
        });
        let wide = Expression::name(MECHANISM).driver_call(&of.name, arguments);
        let wide = Expression::call(Intrinsic::ValueOf, [wide]).tried();
        let value = match &of.returns {
            Type::Own(motion) if *motion == self.signatures.types.motion => {
                before.push(Statement::Let(Pattern::bound(MOTION.to_owned()), wide));
                self.rounded_motion(&Expression::name(MOTION))
            }
            returns => Expression::call(rounding(returns), [wide, Expression::name(ROUGH)]),
        };
        let body = Body { before, ..Body::plain(value) };
        let arguments = of.arguments.iter().cloned().map(by_value).chain([rough(of.returns.clone())]);
        let returns = Type::Around("Option", Box::new(of.returns.clone()));
        let signature = Function { access: Access::Cold, ..total(name, arguments, returns) };
        let doc = format!("`{}` in twice the precision, rounded once; `None` if a number is not finite.", of.name);
        self.add(signature, vec![doc], body);
    }

    /// The result of `motion` rounded, in `Some`.
    fn rounded_motion(&self, wide: &Expression) -> Expression {
        let of_coordinates =
            ["position", "rates", "accelerations"].map(|field| (field.to_owned(), Intrinsic::RoundedByName));
        let of_quantities =
            [Family::Points, Family::Outputs].map(|family| (format!("{}s", family.word()), Intrinsic::RoundedEach));
        let members = of_coordinates.into_iter().chain(of_quantities);
        let members = members.map(|(field, rounded)| {
            let parts = [wide, &Expression::name(ROUGH)].map(|whole| whole.clone().field(&field));
            let value = Expression::call(rounded, parts).tried();
            (field, value)
        });
        let motion = Type::Bare(self.signatures.types.motion.clone());
        Expression::call(Intrinsic::Some, [Expression::structure(motion, members)])
    }

    /// The rates and accelerations at a pose in twice the precision.
    pub(super) fn precise_kinematics(&mut self) {
        let signature = self.signatures.precise_kinematics();
        let Arguments { pose, input_rates, input_accelerations, rates, accelerations, .. } =
            self.signatures.arguments.clone();
        let mut before = vec![self.let_widened()];
        let widened = signature.arguments.iter().filter(|argument| argument.name != ROUGH);
        before.extend(widened.map(|argument| self.let_widened_argument(argument)));
        let borrowed = |name: &String| Expression::name(name).borrowed();
        let of_velocity = vec![borrowed(&pose), Expression::name(&input_rates)];
        let of_acceleration = vec![borrowed(&pose), borrowed(&rates), Expression::name(&input_accelerations)];
        for (name, function, arguments) in
            [(&rates, "velocity", of_velocity), (&accelerations, "acceleration", of_acceleration)]
        {
            let wide = Expression::name(MECHANISM).driver_call(function, arguments);
            let wide = Expression::call(Intrinsic::ValueOf, [wide]).tried();
            before.push(Statement::Let(Pattern::bound(name.clone()), wide));
        }
        let parts = [&rates, &accelerations].map(|name| format!("{ROUGH}_{name}"));
        let pattern = Pattern::Tuple(parts.iter().cloned().map(Pattern::bound).collect());
        before.push(Statement::Let(pattern, Expression::name(ROUGH)));
        let rounded = |(name, part)| {
            let pair = [Expression::name(name), Expression::name(part)];
            Expression::call(Intrinsic::RoundedByName, pair).tried()
        };
        let both = Expression::Tuple([&rates, &accelerations].into_iter().zip(&parts).map(rounded).collect());
        let body = Body { before, ..Body::plain(Expression::call(Intrinsic::Some, [both])) };
        let doc = lines([
            "The rates `q'` and the accelerations `q''` in twice the precision, rounded once; `None` if a number is not finite.",
        ]);
        self.add(signature, doc, body);
    }

    /// `let mechanism = self.widened();`
    fn let_widened(&self) -> Statement {
        Statement::Let(Pattern::bound(MECHANISM.to_owned()), Expression::own_call(WIDENED, []))
    }

    /// The statement that widens an argument.
    fn let_widened_argument(&self, Argument { name, passed }: &Argument) -> Statement {
        let value = Expression::name(name);
        let value = match passed {
            _ if *name == self.signatures.arguments.pose => {
                let wide = Expression::called_on(Receiver::ItsType, WIDENED_POSE, [value]);
                match self.at_numbers_is_method() {
                    true => Expression::name(MECHANISM).driver_call(AT_NUMBERS, [wide]),
                    false => Expression::called_on(
                        Receiver::Type(Box::new(Type::Bare(self.signatures.types.driver.clone()))),
                        AT_NUMBERS,
                        [wide],
                    ),
                }
            }
            Passed::ByReference(Type::Own(_)) => Expression::call(Intrinsic::WidenedByName, [value.dereferenced()]),
            Passed::ByReference(_) => Expression::call(Intrinsic::WidenedColumn, [value]),
            _ => Expression::call(Intrinsic::WidenedByName, [value]),
        };
        let pattern = match passed {
            Passed::ByReference(Type::Own(of)) | Passed::ByValue(Type::Own(of)) | Passed::Converted(Type::Own(of)) => {
                Pattern::typed(name.clone(), Type::Wide(of.clone()))
            }
            _ => Pattern::bound(name.clone()),
        };
        Statement::Let(pattern, value)
    }

    /// The functions that widen the mechanism and its poses, if a group is solved by factorisation.
    pub(super) fn widening(&mut self) {
        if self.derivation.groups.iter().all(|group| group.determinant.is_some()) {
            return;
        }
        self.widened();
        self.widened_pose();
        self.at_numbers();
    }

    fn widened(&mut self) {
        let parameters = &self.mechanism.parameters;
        let parameters = parameters.iter().map(|parameter| Expression::own().field(&parameter.name.field)).collect();
        let widened = Expression::Function(Intrinsic::Widened, None);
        let parameters = Expression::call(Intrinsic::Map, [Expression::List(parameters), widened]);
        let driver = self.signatures.types.driver.clone();
        let value = Expression::of_type(Type::Bare(driver.clone()), Intrinsic::From, [parameters]);
        let signature = Function { access: Access::Cold, ..total(WIDENED, [], Type::Wide(driver)) };
        self.add(signature, lines(["This mechanism in twice the precision."]), Body::plain(value));
    }

    fn widened_pose(&mut self) {
        let pose = &self.signatures.arguments.pose;
        let of_pose = |field: &String| Expression::name(pose).field(field);
        let widened = |function| move |field: &String| (field.clone(), Expression::call(function, [of_pose(field)]));
        let directions = self.pose.directions.values().map(widened(Intrinsic::WidenedDirection));
        let numbers = self.pose.values.iter().map(|(_, field, _)| field);
        let numbers = numbers.chain(self.pose.determinants.iter().map(|(_, field, _)| field));
        let numbers =
            numbers.chain(self.pose.externals.iter().map(|(_, field, _)| field)).map(widened(Intrinsic::Widened));
        let of = self.signatures.types.pose.clone();
        let value = Expression::structure(Type::Bare(of.clone()), directions.chain(numbers));
        let signature = total(WIDENED_POSE, [self.signatures.pose()], Type::Wide(of));
        let signature = Function { access: Access::Cold, is_method: false, ..signature };
        self.add(signature, lines(["A pose in twice the precision."]), Body::plain(value));
    }

    /// The angles of the directions of a pose that follow from its numbers.
    fn angles_of_numbers(&self) -> Vec<NodeId> {
        let parameters = self.mechanism.parameters.iter().map(|parameter| parameter.symbol);
        let known: Vec<SymbolId> = self.pose.values.iter().map(|(.., symbol)| *symbol).chain(parameters).collect();
        let graph = &self.derivation.graph;
        let is_known = |angle: &NodeId| {
            let mut parts = graph.sweep(&[*angle], |_| false, |_| false).into_iter();
            !parts.any(|id| matches!(graph.node(id), Node::External(..)))
                && graph.symbols_of(&[*angle]).iter().all(|symbol| known.contains(symbol))
        };
        self.pose.angles().filter(is_known).collect()
    }

    /// True if the directions of a pose depend on parameters, such as an offset between two angles of a link.
    fn at_numbers_is_method(&self) -> bool {
        let symbols = self.derivation.graph.symbols_of(&self.angles_of_numbers());
        self.mechanism.parameters.iter().any(|parameter| symbols.contains(&parameter.symbol))
    }

    /// The pose with directions computed from its numbers: those of a widened pose are rounded.
    fn at_numbers(&mut self) {
        let (angles, is_method) = (self.angles_of_numbers(), self.at_numbers_is_method());
        let graph = &mut self.derivation.graph;
        let mut parts = Vec::new();
        for &angle in &angles {
            parts.extend([Elementary::Cos, Elementary::Sin].map(|function| graph.call(function, &[angle])));
        }
        let members = angles.iter().enumerate().map(|(index, &angle)| {
            let parts = [2 * index, 2 * index + 1].map(Expression::Result);
            (self.pose.direction(angle).to_owned(), Expression::call(Intrinsic::Unit, parts))
        });
        let pose = self.signatures.arguments.pose.clone();
        let rest = Some(Box::new(Expression::name(&pose)));
        let value = Expression::Struct(self.signatures.pose_type(), members.collect(), rest);
        let numbers = Source { from: Expression::name(&pose), ..self.pose_source() };
        let kernel = self.kernel(vec![numbers], Vec::new(), unnamed(parts));
        let pose = Argument { name: pose, passed: Passed::ByValue(self.signatures.pose_type()) };
        let signature = total(AT_NUMBERS, [pose], self.signatures.pose_type());
        let signature = Function { access: Access::Cold, is_method, ..signature };
        let doc = lines(["The pose with the directions of the angles that it holds as numbers computed anew."]);
        self.add(signature, doc, Body::of(kernel, value));
    }
}

impl Signatures {
    /// The rates and accelerations at a pose in twice the precision.
    fn precise_kinematics(&self) -> Function<Body> {
        let inputs = |name: &String| Argument {
            name: name.clone(),
            passed: Passed::ByValue(Type::Own(self.types.inputs.clone())),
        };
        let Arguments { input_rates, input_accelerations, .. } = &self.arguments;
        let both = [Order::Rate, Order::Acceleration].map(|order| self.coordinates_type(order));
        let both = Type::Tuple(both.to_vec());
        let arguments = [self.pose(), inputs(input_rates), inputs(input_accelerations), rough(both.clone())];
        let returns = Type::Around("Option", Box::new(both));
        Function { access: Access::Cold, ..total("precise_kinematics", arguments, returns) }
    }
}

/// The argument of a result of this type in the scalar of the caller.
fn rough(of: Type) -> Argument {
    Argument { name: ROUGH.to_owned(), passed: Passed::ByValue(of) }
}

/// The function of the runtime that rounds a result of this type.
fn rounding(of: &Type) -> Intrinsic {
    match of {
        Type::Own(_) => Intrinsic::RoundedByName,
        Type::Each(..) => Intrinsic::RoundedEach,
        _ => Intrinsic::Rounded,
    }
}

/// `let argument: Type = argument.into();` for an argument that is `impl Into<Type>`.
fn converted(Argument { name, passed }: &Argument) -> Option<Statement> {
    let Passed::Converted(of) = passed else { return None };
    Some(Statement::Let(Pattern::typed(name.clone(), of.clone()), Expression::name(name).converted()))
}

/// The argument after its conversion.
fn by_value(argument: Argument) -> Argument {
    match argument.passed {
        Passed::Converted(of) => Argument { passed: Passed::ByValue(of), ..argument },
        _ => argument,
    }
}
