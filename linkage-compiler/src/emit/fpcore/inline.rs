//! A function as straight-line operations on numbers: calls of other functions are inlined, structs and lists taken apart.
//!
//! Branches are those of a regular position: checks pass, triangles are open. The conditions are kept.

use std::collections::HashMap;

use linkage_ir::code::{self, Code, Names, Pattern, Signed, Statement};
use linkage_ir::{Slot, ValueId};

use super::operations::{Check, Operations};
use super::value::{Given, Role, Value};
use crate::graph::Function as Elementary;
use crate::model::Mechanism;
use crate::program::{
    Arguments, CheckKind, Entry, Family, Function, Functions, Intrinsic, Meaning, Order, Passed, Program, Receiver,
    Signatures, Type,
};

/// The functions of a type.
pub(super) struct Owner<'a> {
    pub(super) functions: &'a Functions<Code>,
    /// The mechanism, and the program of its driver.
    pub(super) declared: (&'a Mechanism, &'a Program<Code>),
    arguments: &'a Arguments,
    /// Those of the mechanism of a scene.
    inner: Option<&'a Owner<'a>>,
}

impl<'a> Owner<'a> {
    pub(super) fn new(
        functions: &'a Functions<Code>,
        arguments: &'a Arguments,
        declared: (&'a Mechanism, &'a Program<Code>),
        inner: Option<&'a Owner<'a>>,
    ) -> Self {
        Self { functions, declared, arguments, inner }
    }

    /// The functions of the mechanism.
    fn innermost(&self) -> &Self {
        self.inner.unwrap_or(self)
    }

    fn role(&self, argument: &str) -> Role {
        let Arguments { guess, position, branch, .. } = self.arguments;
        let is_order =
            |order: &Order| [self.arguments.of(*order), self.arguments.of_inputs(*order)].contains(&argument);
        match Order::ALL.into_iter().find(is_order) {
            Some(order) => Role::Motion(order),
            None if argument == guess || argument == position => Role::Motion(Order::Value),
            None if argument == branch => Role::Branch,
            None => Role::Other(argument.to_owned()),
        }
    }
}

/// A function whose values become operations.
struct Scope<'a> {
    of: &'a Owner<'a>,
    code: &'a Code,
    bound: HashMap<Slot, Value>,
}

impl<'a> Scope<'a> {
    fn names(&self) -> &'a Names {
        &self.of.declared.1.names
    }
}

#[derive(Default)]
pub(super) struct Inlined {
    pub(super) operations: Operations,
    pub(super) checks: Vec<Check>,
}

impl Inlined {
    /// The value of a function of symbols; a pose is that of `pose_at`.
    pub(super) fn result(&mut self, of: &Owner<'_>, function: &Function<Code>) -> Value {
        let pose = &of.arguments.pose;
        let arguments = function.arguments.iter().map(|argument| match argument.passed {
            Passed::Turns => Value::Unknown,
            _ if argument.name == *pose => self.pose(of),
            _ => Value::given(of.role(&argument.name)),
        });
        let arguments = arguments.collect();
        self.call(of, function, arguments)
    }

    fn pose(&mut self, of: &Owner<'_>) -> Value {
        let mechanism = of.innermost();
        match mechanism.functions.named("pose_at") {
            Some(pose_at) => self.call(mechanism, pose_at, vec![Value::given(Role::Motion(Order::Value))]),
            None => Value::Unknown,
        }
    }

    fn call(&mut self, of: &Owner<'_>, function: &Function<Code>, arguments: Vec<Value>) -> Value {
        let Some(code) = &function.body else { return Value::Unknown };
        let arguments = arguments.into_iter().enumerate().map(|(place, value)| (Slot::of_argument(place), value));
        let bound = arguments.chain([(Slot::ITSELF, Value::given(Role::Parameters))]).collect();
        let mut scope = Scope { of, code, bound };
        match self.statements(&code.statements, &mut scope) {
            true => self.value(code.value.literal(), &mut scope),
            false => Value::Unknown,
        }
    }

    /// Adds statements; false if the function ends with a value of its own.
    fn statements(&mut self, statements: &[Statement], scope: &mut Scope<'_>) -> bool {
        statements.iter().all(|statement| self.statement(statement, scope))
    }

    fn statement(&mut self, statement: &Statement, scope: &mut Scope<'_>) -> bool {
        match statement {
            Statement::Let(pattern, value) | Statement::LetElse(pattern, value, _) => {
                let value = self.value(*value, scope);
                self.bind(pattern, value, scope);
            }
            Statement::Do(value) => {
                self.value(*value, scope);
            }
            Statement::Assign(place, _) => {
                // A variable has no formula.
                if let Some(root) = root(scope.code, *place) {
                    scope.bound.insert(root, Value::Unknown);
                }
            }
            Statement::Unless(conditions, _) => conditions.iter().for_each(|condition| {
                self.value(*condition, scope);
            }),
            Statement::Store(inside) => return self.statement(inside, scope),
            Statement::Return(_) => return false,
        }
        true
    }

    fn bind(&mut self, pattern: &Pattern, value: Value, scope: &mut Scope<'_>) {
        match pattern {
            Pattern::Bound(bound) | Pattern::Mutable(bound) | Pattern::Typed(bound, _) => {
                let name = scope.code.name(*bound);
                let value = match value {
                    // An entry of an argument has the name that the code gives it.
                    Value::Given(Given { role: role @ Role::Other(_), path }) if !path.is_empty() => {
                        Value::Number(self.operations.argument(role.key(&path), name))
                    }
                    value => value,
                };
                if let Value::Number(place) = value {
                    self.operations.name(place, name);
                }
                scope.bound.insert(*bound, value);
            }
            Pattern::Case(_, inside) => self.bind(inside, value, scope),
            Pattern::List(patterns) | Pattern::Tuple(patterns) => {
                for (place, pattern) in patterns.iter().enumerate() {
                    self.bind(pattern, value.index(place), scope);
                }
            }
            Pattern::Struct { fields, .. } => {
                for (field, pattern) in fields {
                    let field = scope.names().text(*field);
                    self.bind(pattern, value.field(field), scope);
                }
            }
            Pattern::Ignored => {}
        }
    }

    fn value(&mut self, id: ValueId, scope: &mut Scope<'_>) -> Value {
        use code::Value as V;
        let code = scope.code;
        match code.operation(id) {
            V::Given(slot) => scope.bound.get(slot).cloned().unwrap_or(Value::Unknown),
            V::Turn(number, count, parts) => self.made(V::Turn(*number, *count, *parts)),
            V::Constant(number) | V::Exact(number) => self.made(V::Constant(*number)),
            V::Sum(terms) => {
                let terms = terms.iter().map(|term| Some(Signed { value: self.number(term.value, scope)?, ..*term }));
                let terms: Option<Vec<_>> = terms.collect();
                self.result_of(terms.map(V::Sum))
            }
            V::Product(factors) => {
                let factors = self.numbers(factors, scope);
                self.result_of(factors.map(V::Product))
            }
            V::Quotient(above, below) => {
                let parts = [above, below].map(|part| self.number(*part, scope));
                let [Some(above), Some(below)] = parts else { return Value::Unknown };
                self.made(V::Quotient(above, below))
            }
            V::Square(base) => {
                let base = self.number(*base, scope);
                self.result_of(base.map(V::Square))
            }
            V::Negative(inside) => {
                let inside = self.number(*inside, scope);
                self.result_of(inside.map(V::Negative))
            }
            V::Call(function, arguments) => {
                let arguments: Option<Vec<Signed>> = arguments.iter().map(|one| self.signed(*one, scope)).collect();
                self.result_of(arguments.map(|arguments| V::Call(*function, arguments)))
            }
            V::Text(text) => Value::Text(text.to_string()),
            V::Field(of, name) => self.value(*of, scope).field(scope.names().text(*name)),
            V::Member(of, place) => self.value(*of, scope).field(&place.to_string()),
            V::Columns(of) => self.value(*of, scope).field("data").field("0"),
            V::Index(of, place) => self.value(*of, scope).index(*place),
            V::List(values) | V::Tuple(values) => Value::list(self.values(values, scope)),
            V::Struct(_, members, rest) => {
                let (names, rest) = (scope.names(), rest.map(|rest| self.value(rest, scope)));
                let mut members: Vec<(String, Value)> = members
                    .iter()
                    .map(|(name, value)| (names.text(*name).to_owned(), self.value(*value, scope)))
                    .collect();
                if let Some(Value::Members(others)) = rest {
                    let others = others.iter().filter(|(name, _)| members.iter().all(|(other, _)| other != name));
                    let others: Vec<_> = others.cloned().collect();
                    members.extend(others);
                }
                Value::members(members)
            }
            V::Intrinsic(of, of_type, arguments) => {
                let arguments = self.values(arguments, scope);
                self.intrinsic(&scope.of.declared.1.signatures, (*of, of_type.as_deref()), &arguments)
            }
            V::Own(receiver, function, arguments) => {
                let arguments = self.values(arguments, scope);
                let of = match receiver {
                    Receiver::Itself | Receiver::ItsType => scope.of,
                    // A mechanism in twice the precision is another one.
                    Receiver::Value(of) if !is_part_of_self(code, *of) => return Value::Unknown,
                    Receiver::Value(_) | Receiver::Type(_) => scope.of.innermost(),
                };
                self.call(of, &of.functions.by_id()[*function], arguments)
            }
            V::Try(value) | V::Borrowed(value) | V::MutablyBorrowed(value) | V::Dereferenced(value) => {
                self.value(*value, scope)
            }
            V::Block(block) => match self.statements(&block.statements, scope) {
                true => self.value(block.value, scope),
                false => Value::Unknown,
            },
            _ => Value::Unknown,
        }
    }

    fn values(&mut self, values: &[ValueId], scope: &mut Scope<'_>) -> Vec<Value> {
        values.iter().map(|value| self.value(*value, scope)).collect()
    }

    fn number(&mut self, id: ValueId, scope: &mut Scope<'_>) -> Option<ValueId> {
        let value = self.value(id, scope);
        self.place(&value)
    }

    fn numbers(&mut self, values: &[ValueId], scope: &mut Scope<'_>) -> Option<Vec<ValueId>> {
        values.iter().map(|value| self.number(*value, scope)).collect()
    }

    fn signed(&mut self, signed: Signed, scope: &mut Scope<'_>) -> Option<Signed> {
        let number = self.number(signed.value, scope)?;
        let is_negative = signed.negative;
        let number = if is_negative { self.operations.add(code::Value::Negative(number)) } else { number };
        Some(Signed::positive(number))
    }

    fn made(&mut self, operation: code::Value) -> Value {
        Value::Number(self.operations.add(operation))
    }

    fn result_of(&mut self, operation: Option<code::Value>) -> Value {
        operation.map_or(Value::Unknown, |operation| self.made(operation))
    }

    /// The number that a value is; a part of an argument that is read as a number is one.
    fn place(&mut self, value: &Value) -> Option<ValueId> {
        match value {
            Value::Number(place) => Some(*place),
            Value::Given(Given { role, path }) => {
                let name = match role {
                    Role::Other(argument) => argument.clone() + &path.concat(),
                    role => role.name(path.last()?),
                };
                Some(self.operations.argument(role.key(path), &name))
            }
            _ => None,
        }
    }

    fn places(&mut self, values: &[&Value]) -> Option<Vec<ValueId>> {
        values.iter().map(|value| self.place(value)).collect()
    }

    /// A function that the program does not define, by its meaning in the table.
    fn intrinsic(
        &mut self,
        signatures: &Signatures,
        (of, of_type): (Intrinsic, Option<&Type>),
        arguments: &[Value],
    ) -> Value {
        let argument = |place: usize| &arguments[place];
        match of.row().meaning {
            Meaning::None => Value::Unknown,
            Meaning::Argument(place) => argument(place).clone(),
            Meaning::Check(kind, places) => {
                self.check(kind, &places.iter().map(|place| argument(*place)).collect::<Vec<_>>());
                Value::Unknown
            }
            Meaning::Chord { factors, side } => self.chord(argument(factors), argument(side)),
            Meaning::ReachChord { factors, radius, scale, side } => {
                let scale = match argument(scale) {
                    Value::List(scales) => scales.first().cloned().unwrap_or(Value::Unknown),
                    scale => scale.clone(),
                };
                self.check(CheckKind::Apart, &[argument(radius), &scale]);
                self.chord(argument(factors), argument(side))
            }
            Meaning::Elbow { triangle, side, is_flagged } => {
                let chord = self.elbow_chord(argument(triangle), argument(side));
                if is_flagged { Value::list([chord, Value::Unknown]) } else { chord }
            }
            Meaning::Direction => Value::members([("re", argument(0).clone()), ("im", argument(1).clone())]),
            Meaning::SineCosine => self.sine_cosine(argument(0)),
            Meaning::SinesCosines => match argument(0) {
                Value::List(angles) => {
                    Value::list(angles.iter().map(|angle| self.sine_cosine(angle)).collect::<Vec<_>>())
                }
                _ => Value::Unknown,
            },
            Meaning::From => from(of_type, arguments),
            Meaning::NoTurns => Value::PrincipalTurns,
            Meaning::InTurn { turns, principal } => match argument(turns) {
                Value::PrincipalTurns => argument(principal).clone(),
                _ => Value::Unknown,
            },
            Meaning::Named(entry) => named(signatures, entry, arguments),
        }
    }

    fn sine_cosine(&mut self, angle: &Value) -> Value {
        let Some(angle) = self.place(angle) else { return Value::Unknown };
        let angle = vec![Signed::positive(angle)];
        let both = [Elementary::Sin, Elementary::Cos];
        Value::list(both.map(|function| self.made(code::Value::Call(function, angle.clone()))))
    }

    fn check(&mut self, kind: CheckKind, of: &[&Value]) {
        if let Some(of) = self.places(of) {
            self.checks.push(Check { kind, of });
        }
    }

    fn elbow_chord(&mut self, triangle: &Value, side: &Value) -> Value {
        let factors = triangle.field("factors");
        let [reach, distance] = ["reach_squared", "distance_squared"].map(|name| triangle.field(name));
        self.check(CheckKind::Open, &[&factors.index(0), &factors.index(1), &reach, &distance]);
        self.chord(&factors, side)
    }

    /// side sqrt(low high): a side is 1 or -1, and the product with it exact.
    fn chord(&mut self, factors: &Value, side: &Value) -> Value {
        let factors = self.places(&[&factors.index(0), &factors.index(1)]);
        let Some((factors, side)) = factors.zip(self.place(side)) else { return Value::Unknown };
        let radicand = self.operations.add(code::Value::Product(factors));
        self.check(CheckKind::Moderate, &[&Value::Number(radicand)]);
        let root = code::Value::Call(Elementary::Sqrt, vec![Signed::positive(radicand)]);
        let root = self.operations.add(root);
        self.made(code::Value::Product(vec![side, root]))
    }
}

/// The variable that a value is a part of.
fn root(code: &Code, place: ValueId) -> Option<Slot> {
    match code.operation(place) {
        code::Value::Given(slot) => Some(*slot),
        code::Value::Field(of, _) | code::Value::Index(of, _) | code::Value::Dereferenced(of) => root(code, *of),
        _ => None,
    }
}

/// True for the field of a scene that holds its mechanism.
fn is_part_of_self(code: &Code, id: ValueId) -> bool {
    match code.operation(id) {
        code::Value::Given(slot) => *slot == Slot::ITSELF,
        code::Value::Field(of, _) | code::Value::Borrowed(of) | code::Value::Dereferenced(of) => {
            is_part_of_self(code, *of)
        }
        _ => false,
    }
}

/// A value of a type from another value.
fn from(of: Option<&Type>, arguments: &[Value]) -> Value {
    match (of, arguments) {
        (Some(Type::Runtime("SVector" | "Column", _)), [Value::List(_)]) => Value::Columns(arguments.into()),
        (Some(Type::Runtime("SMatrix" | "Matrix", _)), [Value::List(columns)]) => Value::Columns(columns.clone()),
        (Some(Type::List(of, _)), [Value::Columns(columns)]) if matches!(**of, Type::List(..)) => {
            Value::List(columns.clone())
        }
        (Some(Type::Bare(_) | Type::Own(_) | Type::List(..)), [from]) => from.clone(),
        _ => Value::Unknown,
    }
}

/// The last argument by the names of points or outputs.
fn named(signatures: &Signatures, entry: Entry, arguments: &[Value]) -> Value {
    let Some(Value::List(values)) = arguments.last() else { return Value::Unknown };
    let is_of_points = |text: &Value| matches!(text, Value::Text(text) if text.starts_with("point"));
    let family = match entry {
        Entry::Point | Entry::PointMotion => Family::Points,
        Entry::Columns if arguments.iter().any(is_of_points) => Family::Points,
        Entry::Output | Entry::OutputMotion | Entry::Columns => Family::Outputs,
    };
    let change = |value: &Value| match (entry, value) {
        (Entry::Point, point) => components(point),
        (Entry::Output, output) => output.clone(),
        (Entry::Columns, Value::List(columns)) => Value::Columns(columns.clone()),
        (Entry::Columns, _) => Value::Unknown,
        (Entry::PointMotion, motion) => parts(["position", "velocity", "acceleration"], motion, &components),
        (Entry::OutputMotion, motion) => parts(["value", "rate", "acceleration"], motion, &Value::clone),
    };
    Value::members(family.names(signatures).into_iter().zip(values.iter().map(change)))
}

/// `(x, y)` of a point or a vector.
fn components(point: &Value) -> Value {
    Value::members([("x", point.index(0)), ("y", point.index(1))])
}

/// Members of an array by these names.
fn parts<const N: usize>(names: [&str; N], of: &Value, change: &dyn Fn(&Value) -> Value) -> Value {
    Value::members(names.into_iter().enumerate().map(|(place, name)| (name, change(&of.index(place)))))
}
