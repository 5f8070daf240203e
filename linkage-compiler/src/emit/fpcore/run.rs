//! Execution of a lowered function with symbols for numbers.
//!
//! Branches are those of a regular position: checks pass, triangles are open. The conditions are kept.

use std::collections::BTreeMap;

use super::operations::{Check, Operation, Operations, Place};
use super::value::{Given, Role, Value};
use crate::graph::Function as Elementary;
use crate::lower::Code;
use crate::model::Mechanism;
use crate::program::{Arguments, Expression, Family, Function, Order, Passed, Pattern, Statement, Type};

/// The functions of a type.
pub(super) struct Owner<'a> {
    pub(super) functions: BTreeMap<&'a str, &'a Function<Code>>,
    pub(super) mechanism: &'a Mechanism,
    arguments: &'a Arguments,
    /// The field of a scene that holds the mechanism, and its functions.
    inner: Option<(&'a str, &'a Owner<'a>)>,
}

impl<'a> Owner<'a> {
    pub(super) fn new(
        functions: &'a [Function<Code>],
        arguments: &'a Arguments,
        mechanism: &'a Mechanism,
        inner: Option<(&'a str, &'a Owner<'a>)>,
    ) -> Self {
        let functions = functions.iter().map(|function| (function.name.as_str(), function)).collect();
        Self { functions, mechanism, arguments, inner }
    }

    /// The functions of the mechanism.
    fn innermost(&self) -> &Self {
        self.inner.map_or(self, |(_, inner)| inner)
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

/// The names and values of a function that is executed.
type Scope = BTreeMap<String, Value>;

/// An execution.
#[derive(Default)]
pub(super) struct Run {
    pub(super) operations: Operations,
    pub(super) checks: Vec<Check>,
}

impl Run {
    /// The value of a function of symbols; a pose is that of `pose_at`.
    pub(super) fn result(&mut self, of: &Owner<'_>, function: &Function<Code>) -> Value {
        let pose = &of.arguments.pose;
        let arguments: Vec<Value> = function
            .arguments
            .iter()
            .map(|argument| match argument.passed {
                Passed::Turns => Value::Unknown,
                _ if argument.name == *pose => self.pose(of),
                _ => Value::given(of.role(&argument.name)),
            })
            .collect();
        self.call(of, function, arguments)
    }

    fn pose(&mut self, of: &Owner<'_>) -> Value {
        let mechanism = of.innermost();
        match mechanism.functions.get("pose_at") {
            Some(pose_at) => self.call(mechanism, pose_at, vec![Value::given(Role::Motion(Order::Value))]),
            None => Value::Unknown,
        }
    }

    fn call(&mut self, of: &Owner<'_>, function: &Function<Code>, arguments: Vec<Value>) -> Value {
        let Some(code) = &function.body else { return Value::Unknown };
        let names = function.arguments.iter().map(|argument| argument.name.clone());
        let mut scope: Scope = names.zip(arguments).collect();
        scope.insert("self".to_owned(), Value::given(Role::Parameters));
        if !self.statements(of, &code.statements, &mut scope) {
            return Value::Unknown;
        }
        self.value(of, code.value.literal(), &mut scope)
    }

    /// Executes statements; false if the function ends with a value of its own.
    fn statements(&mut self, of: &Owner<'_>, statements: &[Statement], scope: &mut Scope) -> bool {
        statements.iter().all(|statement| self.statement(of, statement, scope))
    }

    fn statement(&mut self, of: &Owner<'_>, statement: &Statement, scope: &mut Scope) -> bool {
        match statement {
            Statement::Let(pattern, value) | Statement::LetElse(pattern, value, _) => {
                let value = self.value(of, value, scope);
                self.bind(pattern, value, scope);
            }
            Statement::Do(value) => {
                self.value(of, value, scope);
            }
            Statement::Assign(place, _) => {
                // A variable has no formula.
                if let Some(name) = root(place) {
                    scope.insert(name.to_owned(), Value::Unknown);
                }
            }
            Statement::Unless(conditions, _) => {
                for condition in conditions {
                    self.value(of, condition, scope);
                }
            }
            Statement::Return(_) => return false,
            // Lowering has replaced these.
            Statement::Check { .. }
            | Statement::CheckPosition
            | Statement::CheckKinematics { .. }
            | Statement::LetAccepted(..)
            | Statement::LetPassed(_)
            | Statement::Refine(..) => {}
        }
        true
    }

    fn bind(&mut self, pattern: &Pattern, value: Value, scope: &mut Scope) {
        match pattern {
            Pattern::Name(name) | Pattern::Typed(name, _) => {
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
                scope.insert(name.clone(), value);
            }
            Pattern::Mutable(inside) | Pattern::Case(_, inside) => self.bind(inside, value, scope),
            Pattern::List(patterns) | Pattern::Tuple(patterns) => {
                for (place, pattern) in patterns.iter().enumerate() {
                    self.bind(pattern, value.index(place), scope);
                }
            }
            Pattern::Struct { fields, .. } => {
                for (field, pattern) in fields {
                    self.bind(pattern, value.field(field), scope);
                }
            }
            Pattern::Ignored | Pattern::Local(_) => {}
        }
    }

    fn value(&mut self, of: &Owner<'_>, expression: &Expression, scope: &mut Scope) -> Value {
        use Expression as E;
        match expression {
            E::Name(name) => scope.get(name).cloned().unwrap_or(Value::Unknown),
            E::Number(number) | E::Exact(number) => self.made(Operation::Number(*number)),
            E::Sum(terms) => {
                let terms = terms.iter().map(|(sign, term)| Some((*sign, self.number(of, term, scope)?)));
                let terms: Option<Vec<_>> = terms.collect();
                self.result_of(terms.map(Operation::Sum))
            }
            E::Product(factors) => {
                let factors = self.numbers(of, factors, scope);
                self.result_of(factors.map(Operation::Product))
            }
            E::Quotient(parts) => {
                let parts = self.numbers(of, parts.as_slice(), scope);
                self.result_of(parts.and_then(|parts| Some(Operation::Quotient(parts.try_into().ok()?))))
            }
            E::Square(base) => {
                let base = self.number(of, base, scope);
                self.result_of(base.map(Operation::Square))
            }
            E::Negative(inside) => {
                let inside = self.number(of, inside, scope);
                self.result_of(inside.map(Operation::Negative))
            }
            E::Elementary(function, arguments) => {
                let arguments = self.numbers(of, arguments, scope);
                self.result_of(arguments.map(|arguments| Operation::Call(name_of(*function), arguments)))
            }
            E::Field(value, name) => self.value(of, value, scope).field(name),
            E::Index(value, place) => self.value(of, value, scope).index(*place),
            E::Text(text) => Value::Text(text.clone()),
            E::List(values) | E::Tuple(values) => Value::list(self.values(of, values, scope)),
            E::Struct(_, members, rest) => {
                let rest = rest.as_ref().map(|rest| self.value(of, rest, scope));
                let mut members: Vec<(String, Value)> =
                    members.iter().map(|(name, value)| (name.clone(), self.value(of, value, scope))).collect();
                if let Some(Value::Members(others)) = rest {
                    let others = others.iter().filter(|(name, _)| members.iter().all(|(other, _)| other != name));
                    let others: Vec<_> = others.cloned().collect();
                    members.extend(others);
                }
                Value::members(members)
            }
            E::Runtime(name, arguments) => {
                let arguments = self.values(of, arguments, scope);
                self.of_runtime(of.mechanism, name, &arguments)
            }
            E::Associated(of_type, name, arguments) => {
                let arguments = self.values(of, arguments, scope);
                self.associated(of, of_type, name, arguments)
            }
            E::Method(receiver, name, arguments) => self.method(of, receiver, (name, arguments), scope),
            E::Try(value) | E::Borrowed(value) | E::MutablyBorrowed(value) | E::Dereferenced(value) => {
                self.value(of, value, scope)
            }
            E::Block(statements, value) => match self.statements(of, statements, scope) {
                true => self.value(of, value, scope),
                false => Value::Unknown,
            },
            E::At(_)
            | E::Repeated(..)
            | E::Closure { .. }
            | E::All(_)
            | E::Count(_)
            | E::Constant(_)
            | E::Function(..)
            | E::Result(_)
            | E::Local(_) => Value::Unknown,
        }
    }

    fn values(&mut self, of: &Owner<'_>, expressions: &[Expression], scope: &mut Scope) -> Vec<Value> {
        expressions.iter().map(|expression| self.value(of, expression, scope)).collect()
    }

    fn number(&mut self, of: &Owner<'_>, expression: &Expression, scope: &mut Scope) -> Option<Place> {
        let value = self.value(of, expression, scope);
        self.place(&value)
    }

    fn numbers(&mut self, of: &Owner<'_>, expressions: &[Expression], scope: &mut Scope) -> Option<Vec<Place>> {
        expressions.iter().map(|expression| self.number(of, expression, scope)).collect()
    }

    fn made(&mut self, operation: Operation) -> Value {
        Value::Number(self.operations.add(operation))
    }

    fn result_of(&mut self, operation: Option<Operation>) -> Value {
        operation.map_or(Value::Unknown, |operation| self.made(operation))
    }

    /// The number that a value is; a part of an argument that is read as a number is one.
    fn place(&mut self, value: &Value) -> Option<Place> {
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

    fn places(&mut self, values: &[&Value]) -> Option<Vec<Place>> {
        values.iter().map(|value| self.place(value)).collect()
    }

    /// A method of a number, of a type of the runtime, or of the mechanism.
    fn method(
        &mut self,
        of: &Owner<'_>,
        receiver: &Expression,
        (name, arguments): (&str, &[Expression]),
        scope: &mut Scope,
    ) -> Value {
        let owner = match receiver {
            receiver if is_self(receiver) => Some(of),
            Expression::Field(inner, field) if is_self(inner) => {
                of.inner.filter(|(name, _)| name == field).map(|(_, inner)| inner)
            }
            _ => None,
        };
        if let Some(owner) = owner {
            let arguments = self.values(of, arguments, scope);
            return self.own(owner, name, arguments);
        }
        let receiver = self.value(of, receiver, scope);
        match name {
            "into" | "or_else" => receiver,
            "sine_cosine" => self.sine_cosine(&receiver),
            // Without turns, the number of an angle is its principal value.
            "number" if matches!(receiver, Value::PrincipalTurns) => match arguments {
                [_, principal] => self.value(of, principal, scope),
                _ => Value::Unknown,
            },
            _ => Value::Unknown,
        }
    }

    /// A function of the mechanism or scene.
    fn own(&mut self, of: &Owner<'_>, name: &str, arguments: Vec<Value>) -> Value {
        of.functions.get(name).map_or(Value::Unknown, |function| self.call(of, function, arguments))
    }

    fn associated(&mut self, of: &Owner<'_>, of_type: &Type, name: &str, arguments: Vec<Value>) -> Value {
        match (of_type, name, arguments.as_slice()) {
            (Type::Scalar, "sines_cosines", [Value::List(angles)]) => {
                Value::list(angles.iter().map(|angle| self.sine_cosine(angle)).collect::<Vec<_>>())
            }
            (Type::Runtime("SVector" | "Column", _), "from", [Value::List(_)]) => Value::Columns(arguments.into()),
            (Type::Runtime("SMatrix" | "Matrix", _), "from", [Value::List(columns)]) => Value::Columns(columns.clone()),
            (Type::Bare(_) | Type::Own(_), "from", [from]) => from.clone(),
            (Type::Itself, ..) => self.own(of, name, arguments),
            (Type::Bare(_), ..) => self.own(of.innermost(), name, arguments),
            _ => Value::Unknown,
        }
    }

    fn sine_cosine(&mut self, angle: &Value) -> Value {
        let Some(angle) = self.place(angle) else { return Value::Unknown };
        let both = ["sin", "cos"].map(|name| self.made(Operation::Call(name, vec![angle])));
        Value::list(both)
    }

    /// A function of the runtime.
    fn of_runtime(&mut self, mechanism: &Mechanism, name: &str, arguments: &[Value]) -> Value {
        match (name, arguments) {
            ("unit", [cosine, sine]) => Value::members([("re", cosine.clone()), ("im", sine.clone())]),
            ("Turns", _) => Value::PrincipalTurns,
            ("regular", [.., determinant, scale]) | ("is_nonzero", [determinant, scale]) => {
                self.check("regular", &[determinant, scale]);
                Value::Unknown
            }
            ("solvable", [_, _, determinant, ..]) => {
                self.check("nonzero", &[determinant]);
                Value::Unknown
            }
            ("reachable", [.., length]) => {
                self.check("positive", &[length]);
                Value::Unknown
            }
            ("elbow_chord", [.., triangle, side]) => Value::list([self.elbow_chord(triangle, side), Value::Unknown]),
            ("regular_elbow_chord", [triangle, side]) => self.elbow_chord(triangle, side),
            ("chord", [_, _, factors, _, _, side]) | ("regular_chord", [factors, _, side]) => {
                self.chord(factors, side).unwrap_or(Value::Unknown)
            }
            ("reach_chord", [_, _, factors, radius, scales, side]) => {
                self.check("apart", &[radius, &scales.index(0)]);
                self.chord(factors, side).unwrap_or(Value::Unknown)
            }
            ("regular_reach_chord", [factors, radius, scale, side]) => {
                self.check("apart", &[radius, scale]);
                self.chord(factors, side).unwrap_or(Value::Unknown)
            }
            ("finite_points" | "finite_vectors", [.., points]) => {
                by_name(Family::Points.names(mechanism), points, &components)
            }
            ("finite_outputs", [.., outputs]) => by_name(Family::Outputs.names(mechanism), outputs, &Value::clone),
            ("finite_matrices", [_, Value::Text(text), matrices]) => {
                let family = if text.starts_with("point") { Family::Points } else { Family::Outputs };
                by_name(family.names(mechanism), matrices, &matrix)
            }
            ("point_motions", [.., points]) => by_name(Family::Points.names(mechanism), points, &|motion| {
                parts(["position", "velocity", "acceleration"], motion, &components)
            }),
            ("output_motions", [.., outputs]) => by_name(Family::Outputs.names(mechanism), outputs, &|motion| {
                parts(["value", "velocity", "acceleration"], motion, &Value::clone)
            }),
            _ => Value::Unknown,
        }
    }

    fn check(&mut self, word: &'static str, of: &[&Value]) {
        if let Some(of) = self.places(of) {
            self.checks.push(Check { word, of });
        }
    }

    fn elbow_chord(&mut self, triangle: &Value, side: &Value) -> Value {
        let factors = triangle.field("factors");
        let [reach, distance] = ["reach_squared", "distance_squared"].map(|name| triangle.field(name));
        self.check("open", &[&factors.index(0), &factors.index(1), &reach, &distance]);
        self.chord(&factors, side).unwrap_or(Value::Unknown)
    }

    /// side sqrt(low high): a side is 1 or -1, and the product with it exact.
    fn chord(&mut self, factors: &Value, side: &Value) -> Option<Value> {
        let factors = self.places(&[&factors.index(0), &factors.index(1)])?;
        let side = self.place(side)?;
        let radicand = self.operations.add(Operation::Product(factors));
        self.check("moderate", &[&Value::Number(radicand)]);
        let root = self.operations.add(Operation::Call("sqrt", vec![radicand]));
        Some(self.made(Operation::Product(vec![side, root])))
    }
}

fn is_self(value: &Expression) -> bool {
    match value {
        Expression::Name(name) => name == "self",
        Expression::Borrowed(inside) | Expression::Dereferenced(inside) => is_self(inside),
        _ => false,
    }
}

/// The name of the variable that an expression is a part of.
fn root(place: &Expression) -> Option<&str> {
    match place {
        Expression::Name(name) => Some(name),
        Expression::Field(of, _) | Expression::Index(of, _) | Expression::Dereferenced(of) => root(of),
        _ => None,
    }
}

/// A list with the names of the points or outputs that it is of.
fn by_name(names: Vec<String>, list: &Value, change: &dyn Fn(&Value) -> Value) -> Value {
    match list {
        Value::List(values) => Value::members(names.into_iter().zip(values.iter().map(change))),
        _ => Value::Unknown,
    }
}

/// `(x, y)` of a point or a vector.
fn components(point: &Value) -> Value {
    Value::members([("x", point.index(0)), ("y", point.index(1))])
}

/// Members of an array by these names.
fn parts<const N: usize>(names: [&str; N], of: &Value, change: &dyn Fn(&Value) -> Value) -> Value {
    Value::members(names.into_iter().enumerate().map(|(place, name)| (name, change(&of.index(place)))))
}

/// A matrix of a list of its columns.
fn matrix(columns: &Value) -> Value {
    match columns {
        Value::List(columns) => Value::Columns(columns.clone()),
        _ => Value::Unknown,
    }
}

/// The name of a function in FPCore.
fn name_of(function: Elementary) -> &'static str {
    match function {
        Elementary::Abs => "fabs",
        Elementary::Ln => "log",
        other => other.operation().name,
    }
}
