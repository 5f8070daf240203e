//! From the tree to the model: names first, then expressions, then the checks on the whole.

use proc_macro2::{Ident, Span};

use super::kind::{Kind, bare_symbols};
use super::name::Name;
use super::scope::{Scope, Value};
use super::{Closure, Coordinate, Driver, Mechanism, Output, Parameter, Point};
use crate::diagnostics::{Diagnostics, Region, suggestion};
use crate::graph::{Fault, Function, Graph, NodeId, Number, SymbolId};
use crate::syntax::{self, Expression, ExpressionId, Expressions, Operator, StatementKind};

/// What the language calls besides the op table.
const VECTOR_FUNCTIONS: [(&str, usize); 7] =
    [("x", 1), ("y", 1), ("norm", 1), ("angle", 1), ("dot", 2), ("cross", 2), ("powi", 2)];

struct Lowering<'a> {
    graph: Graph,
    scope: Scope,
    /// The value of each expression, by id; expressions are lowered in ascending order.
    values: Vec<Value>,
    expressions: &'a Expressions,
    kinds: Vec<(SymbolId, Kind)>,
    /// Names that are lengths if nothing else is known.
    supposed: Vec<SymbolId>,
    diagnostics: &'a mut Diagnostics,
}

pub(super) fn mechanism(tree: syntax::Mechanism, diagnostics: &mut Diagnostics) -> Mechanism {
    let syntax::Mechanism { attributes, visibility, name, statements, expressions } = tree;
    let mut lowering = Lowering {
        graph: Graph::default(),
        scope: Scope::default(),
        values: Vec::new(),
        expressions: &expressions,
        kinds: Vec::new(),
        supposed: Vec::new(),
        diagnostics,
    };
    let complete = lowering.diagnostics.is_empty();
    let mut result = Mechanism {
        attributes,
        visibility,
        name,
        graph: Graph::default(),
        parameters: Vec::new(),
        coordinates: Vec::new(),
        closures: Vec::new(),
        drivers: Vec::new(),
        points: Vec::new(),
        outputs: Vec::new(),
        named: Vec::new(),
    };
    let mut roles = Roles::default();
    lowering.declare(&statements, &mut result, &mut roles);
    lowering.define(&statements, &mut result);
    let choice = lowering.drivers(&statements, &mut result, roles);
    let Lowering { graph, scope, kinds, supposed, diagnostics, .. } = lowering;
    result.graph = graph;
    let kind_of = |symbol| match kinds.iter().find(|(other, _)| *other == symbol) {
        Some((_, kind)) => *kind,
        None if supposed.contains(&symbol) => Kind::Length,
        None => Kind::Number,
    };
    for parameter in &mut result.parameters {
        parameter.kind = kind_of(parameter.symbol);
    }
    for coordinate in &mut result.coordinates {
        coordinate.kind = kind_of(coordinate.symbol);
    }
    // What was not understood above would be missed below.
    if complete && diagnostics.is_empty() {
        check_use(&result, &scope, diagnostics);
        check_fields(&result, diagnostics);
        check_closures(&result, choice, diagnostics);
    }
    result
}

/// Which coordinates were declared `input`, `unknown` and `coordinate`.
#[derive(Default)]
struct Roles {
    inputs: Vec<usize>,
    unknowns: Vec<usize>,
    open: Vec<usize>,
}

impl Lowering<'_> {
    /// Every name of the mechanism, so that statements may stand in any order that reads well.
    fn declare(&mut self, statements: &[syntax::Statement], result: &mut Mechanism, roles: &mut Roles) {
        // Coordinates come first in the canonical order of a sum: phi2 - delta, not -(delta - phi2).
        for statement in statements {
            let (names, role) = match &statement.kind {
                StatementKind::Inputs(names) => (names, &mut roles.inputs),
                StatementKind::Unknowns(names) => (names, &mut roles.unknowns),
                StatementKind::Coordinates(names) => (names, &mut roles.open),
                _ => continue,
            };
            for name in names {
                if let Some((name, symbol)) = self.new_symbol(name) {
                    role.push(result.coordinates.len());
                    let attributes = statement.attributes.clone();
                    result.coordinates.push(Coordinate { name, attributes, symbol, kind: Kind::Number });
                }
            }
        }
        for statement in statements {
            match &statement.kind {
                StatementKind::Parameters(parameters) => {
                    for (name, _) in parameters {
                        if let Some((name, symbol)) = self.new_symbol(name) {
                            let attributes = statement.attributes.clone();
                            result.parameters.push(Parameter {
                                name,
                                attributes,
                                symbol,
                                default: None,
                                kind: Kind::Number,
                            });
                        }
                    }
                }
                StatementKind::Let { name, .. }
                | StatementKind::Point { name, .. }
                | StatementKind::Output { name, .. } => {
                    self.scope.claim(name, self.diagnostics);
                }
                _ => {}
            }
        }
    }

    fn new_symbol(&mut self, ident: &Ident) -> Option<(Name, SymbolId)> {
        if !self.scope.claim(ident, self.diagnostics) {
            return None;
        }
        let name = Name::new(ident);
        let symbol = self.graph.symbol(name.field.clone());
        let node = self.graph.variable(symbol);
        self.scope.define_symbol(ident, symbol, node);
        Some((name, symbol))
    }

    fn define(&mut self, statements: &[syntax::Statement], result: &mut Mechanism) {
        for statement in statements {
            let attributes = statement.attributes.clone();
            match &statement.kind {
                StatementKind::Parameters(parameters) => {
                    for (name, default) in parameters {
                        let Some(default) = default else { continue };
                        let node = self.constant(*default);
                        let text = name.to_string();
                        if let Some(parameter) = result.parameters.iter_mut().find(|p| p.name.text == text) {
                            parameter.default = node;
                        }
                    }
                }
                StatementKind::Loop { left, right } => self.close_loop(*left, *right, result),
                StatementKind::Equation { left, right } => {
                    let (a, b) = (self.scalar(*left), self.scalar(*right));
                    if let (Some(a), Some(b)) = (a, b) {
                        let row = self.graph.subtract(a, b);
                        self.close(*left, *right, vec![row], result);
                    }
                }
                StatementKind::Let { name, value } => {
                    let value = self.value(*value);
                    let text = Name::new(name).field;
                    match value {
                        Value::Scalar(node) => result.named.push((node, text)),
                        Value::Vector(x, y) => {
                            result.named.push((x, format!("{text}_x")));
                            result.named.push((y, format!("{text}_y")));
                        }
                        Value::Poison => {}
                    }
                    self.scope.define(name, value);
                }
                StatementKind::Point { name, value } => {
                    let vector = self.vector(*value);
                    let (x, y) = vector.unwrap_or_else(|| (self.graph.zero(), self.graph.zero()));
                    self.scope.define(name, vector.map_or(Value::Poison, |(x, y)| Value::Vector(x, y)));
                    result.points.push(Point { name: Name::new(name), attributes, x, y });
                }
                StatementKind::Output { name, value } => {
                    let scalar = self.scalar(*value);
                    self.scope.define(name, scalar.map_or(Value::Poison, Value::Scalar));
                    let value = scalar.unwrap_or_else(|| self.graph.zero());
                    result.outputs.push(Output { name: Name::new(name), attributes, value });
                }
                StatementKind::Inputs(_)
                | StatementKind::Unknowns(_)
                | StatementKind::Coordinates(_)
                | StatementKind::Drive { .. } => {}
            }
        }
    }

    fn close_loop(&mut self, left: ExpressionId, right: ExpressionId, result: &mut Mechanism) {
        let (a, b) = (self.value(left), self.value(right));
        let region = self.expressions.region(left).to(self.expressions.region(right));
        match (a, b) {
            (Value::Vector(ax, ay), Value::Vector(bx, by)) => {
                let rows = vec![self.graph.subtract(ax, bx), self.graph.subtract(ay, by)];
                self.close(left, right, rows, result);
            }
            // `loop … = 0`: the zero vector.
            (Value::Vector(x, y), Value::Scalar(zero)) if self.graph.is_zero(zero) => {
                self.close(left, right, vec![x, y], result);
            }
            (Value::Scalar(_), Value::Scalar(_)) => {
                self.diagnostics
                    .error(region, "both sides are scalars: a `loop` closes vectors; write `equation` instead");
            }
            (Value::Scalar(_), Value::Vector(..)) => self.expect_vector(left),
            (Value::Vector(..), Value::Scalar(_)) => self.expect_vector(right),
            (Value::Poison, _) | (_, Value::Poison) => {}
        }
    }

    fn close(&mut self, left: ExpressionId, right: ExpressionId, rows: Vec<NodeId>, result: &mut Mechanism) {
        let region = self.expressions.region(left).to(self.expressions.region(right));
        if rows.iter().all(|&row| self.graph.is_zero(row)) {
            self.diagnostics.error(region, "both sides are the same: this closes nothing");
            return;
        }
        result.closures.push(Closure { span: region.first, rows });
    }

    fn drivers(&mut self, statements: &[syntax::Statement], result: &mut Mechanism, roles: Roles) -> Choice {
        let Roles { inputs, unknowns, open } = roles;
        let mut choice = Choice::Fixed;
        for statement in statements {
            let StatementKind::Drive { name, by } = &statement.kind else { continue };
            choice = Choice::Open;
            let mut driven = inputs.clone();
            for coordinate in by {
                let text = coordinate.to_string();
                match open.iter().find(|&&index| result.coordinates[index].name.text == text) {
                    Some(index) if driven.contains(index) => {
                        self.diagnostics.error(coordinate.span(), format_args!("`{text}` already drives `{name}`"));
                    }
                    Some(index) => driven.push(*index),
                    None => {
                        let names = open.iter().map(|&index| result.coordinates[index].name.text.as_str());
                        let hint = suggestion(&text, names);
                        self.diagnostics
                            .error(coordinate.span(), format_args!("no `coordinate` is called `{text}`{hint}"));
                    }
                }
            }
            if result.drivers.iter().any(|driver| driver.name == *name) || result.name == *name {
                self.diagnostics.error(name.span(), format_args!("the type `{name}` is declared twice"));
                continue;
            }
            let unknowns =
                unknowns.iter().chain(open.iter().filter(|index| !driven.contains(index))).copied().collect();
            result.drivers.push(Driver {
                name: name.clone(),
                attributes: statement.attributes.clone(),
                inputs: driven,
                unknowns,
            });
        }
        if choice == Choice::Fixed {
            if let Some(&first) = open.first() {
                let name = &result.coordinates[first].name;
                self.diagnostics.error(
                    name.span,
                    format_args!("nothing drives `{}`: add `drive NAME by {};`", name.text, name.text),
                );
            }
            let name = result.name.clone();
            let unknowns = unknowns.into_iter().chain(open).collect();
            result.drivers.push(Driver { name, attributes: Vec::new(), inputs, unknowns });
        }
        choice
    }

    // Expressions.

    /// The value of an expression and of all that it is made of.
    fn value(&mut self, id: ExpressionId) -> Value {
        let expressions = self.expressions;
        let missing = (id.index() + 1).saturating_sub(self.values.len());
        for (expression, region) in expressions.iter().skip(self.values.len()).take(missing) {
            let value = self.lower(expression, region);
            let value = match self.graph.take_fault() {
                Some(fault) => {
                    self.diagnostics.error(
                        region,
                        match fault {
                            Fault::DivisionByZero => "this divides by zero",
                            Fault::NotFinite => "this constant is not a finite number",
                            Fault::ExponentOverflow => "this exponent is too large",
                        },
                    );
                    Value::Poison
                }
                None => value,
            };
            self.values.push(value);
        }
        self.values[id.index()]
    }

    fn scalar(&mut self, id: ExpressionId) -> Option<NodeId> {
        match self.value(id) {
            Value::Scalar(node) => Some(node),
            Value::Vector(..) => {
                self.expect_scalar(self.expressions.region(id));
                None
            }
            Value::Poison => None,
        }
    }

    fn vector(&mut self, id: ExpressionId) -> Option<(NodeId, NodeId)> {
        match self.value(id) {
            Value::Vector(x, y) => Some((x, y)),
            Value::Scalar(_) => {
                self.expect_vector(id);
                None
            }
            Value::Poison => None,
        }
    }

    fn expect_vector(&mut self, id: ExpressionId) {
        let region = self.expressions.region(id);
        self.diagnostics.error(region, "this is a scalar; a vector belongs here: `r@phi` or `(x, y)`");
    }

    fn expect_scalar(&mut self, region: Region) {
        self.diagnostics
            .error(region, "this is a vector; a scalar belongs here: take `x(…)`, `y(…)`, `norm(…)` or `angle(…)`");
    }

    /// A number known now: the default of a parameter.
    fn constant(&mut self, id: ExpressionId) -> Option<NodeId> {
        let node = self.scalar(id)?;
        if self.graph.constant_value(node).is_some() {
            return Some(node);
        }
        self.diagnostics.error(self.expressions.region(id), "a default is a number: it cannot depend on other names");
        None
    }

    fn lower(&mut self, expression: &Expression, region: Region) -> Value {
        match expression {
            Expression::Number { digits, degrees } => match Number::parse(digits) {
                Some(number) if *degrees => {
                    let pi = self.graph.pi();
                    Value::Scalar(self.graph.scale(number.multiply(Number::ratio(1, 180)), pi))
                }
                Some(number) => Value::Scalar(self.graph.number(number)),
                None => {
                    self.diagnostics.error(region, "this is not a number");
                    Value::Poison
                }
            },
            Expression::Name(name) if name == "pi" => Value::Scalar(self.graph.pi()),
            Expression::Name(name) => self.scope.look_up(name, self.diagnostics),
            &Expression::Vector(x, y) => match (self.scalar(x), self.scalar(y)) {
                (Some(x), Some(y)) => {
                    self.suppose_lengths([x, y]);
                    Value::Vector(x, y)
                }
                _ => Value::Poison,
            },
            &Expression::At(magnitude, angle) => self.at(magnitude, angle),
            Expression::Sum(operands) => self.sum(operands),
            Expression::Product(operands) => self.product(operands),
            &Expression::Negate(inner) => match self.value(inner) {
                Value::Scalar(node) => Value::Scalar(self.graph.negate(node)),
                Value::Vector(x, y) => Value::Vector(self.graph.negate(x), self.graph.negate(y)),
                Value::Poison => Value::Poison,
            },
            &Expression::Power(base, exponent) => self.power(base, exponent),
            Expression::Call(name, arguments) => self.call(name, arguments, region),
        }
    }

    /// r@phi = (r cos phi, r sin phi); (x, y)@phi = (x cos phi - y sin phi, x sin phi + y cos phi).
    fn at(&mut self, magnitude: ExpressionId, angle: ExpressionId) -> Value {
        let region = self.expressions.region(magnitude);
        let angle_region = self.expressions.region(angle);
        let (value, Some(angle)) = (self.value(magnitude), self.scalar(angle)) else { return Value::Poison };
        self.mark(angle, Kind::Angle, angle_region);
        let g = &mut self.graph;
        let (cosine, sine) = (g.call(Function::Cos, &[angle]), g.call(Function::Sin, &[angle]));
        match value {
            Value::Scalar(r) => {
                self.mark(r, Kind::Length, region);
                Value::Vector(self.graph.multiply(r, cosine), self.graph.multiply(r, sine))
            }
            Value::Vector(x, y) => {
                let (xc, ys) = (g.multiply(x, cosine), g.multiply(y, sine));
                let (xs, yc) = (g.multiply(x, sine), g.multiply(y, cosine));
                Value::Vector(g.subtract(xc, ys), g.add(xs, yc))
            }
            Value::Poison => Value::Poison,
        }
    }

    fn sum(&mut self, operands: &[(Operator, ExpressionId)]) -> Value {
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        let mut poisoned = false;
        let mut first_is_vector = None;
        for &(operator, id) in operands {
            let sign = if operator == Operator::Direct { Number::ONE } else { Number::MINUS_ONE };
            let value = self.value(id);
            let is_vector = match value {
                Value::Scalar(node) => {
                    xs.push((sign, node));
                    false
                }
                Value::Vector(x, y) => {
                    xs.push((sign, x));
                    ys.push((sign, y));
                    true
                }
                Value::Poison => {
                    poisoned = true;
                    continue;
                }
            };
            let expected = *first_is_vector.get_or_insert(is_vector);
            if expected != is_vector {
                if expected {
                    self.diagnostics.error(
                        self.expressions.region(id),
                        "a scalar cannot be added to a vector: did you mean `r@phi`?",
                    );
                } else {
                    self.diagnostics.error(self.expressions.region(id), "a vector cannot be added to a scalar");
                }
                return Value::Poison;
            }
        }
        match (poisoned, first_is_vector) {
            (false, Some(true)) => Value::Vector(self.graph.sum(&xs), self.graph.sum(&ys)),
            (false, Some(false)) => Value::Scalar(self.graph.sum(&xs)),
            _ => Value::Poison,
        }
    }

    fn product(&mut self, operands: &[(Operator, ExpressionId)]) -> Value {
        let mut factors = Vec::new();
        let mut vector = None;
        let mut poisoned = false;
        for &(operator, id) in operands {
            match (self.value(id), operator) {
                (Value::Scalar(node), Operator::Direct) => factors.push((node, 1)),
                (Value::Scalar(node), Operator::Inverse) => {
                    if self.graph.is_zero(node) {
                        self.diagnostics.error(self.expressions.region(id), "this divides by zero");
                        return Value::Poison;
                    }
                    factors.push((node, -1));
                }
                (Value::Vector(x, y), Operator::Direct) if vector.is_none() => vector = Some((x, y)),
                (Value::Vector(..), Operator::Direct) => {
                    self.diagnostics.error(
                        self.expressions.region(id),
                        "two vectors have no plain product: use `dot(…)` or `cross(…)`",
                    );
                    return Value::Poison;
                }
                (Value::Vector(..), Operator::Inverse) => {
                    self.diagnostics.error(self.expressions.region(id), "a vector cannot be divided by");
                    return Value::Poison;
                }
                (Value::Poison, _) => poisoned = true,
            }
        }
        if poisoned {
            return Value::Poison;
        }
        let scalar = self.graph.product(&factors);
        match vector {
            None => Value::Scalar(scalar),
            Some((x, y)) => Value::Vector(self.graph.multiply(scalar, x), self.graph.multiply(scalar, y)),
        }
    }

    fn power(&mut self, base: ExpressionId, exponent: ExpressionId) -> Value {
        let (Some(base), Some(node)) = (self.scalar(base), self.scalar(exponent)) else { return Value::Poison };
        let integer = self.graph.as_number(node).and_then(Number::as_integer).and_then(|n| i32::try_from(n).ok());
        let Some(integer) = integer else {
            let message = "an exponent is a whole number; write roots with `sqrt(…)`";
            self.diagnostics.error(self.expressions.region(exponent), message);
            return Value::Poison;
        };
        Value::Scalar(self.graph.power(base, integer))
    }

    fn call(&mut self, name: &Ident, arguments: &[ExpressionId], region: Region) -> Value {
        let text = name.to_string();
        let function = Function::named(&text);
        let arity = function
            .map(|function| function.operation().arity)
            .or_else(|| VECTOR_FUNCTIONS.iter().find(|(other, _)| *other == text).map(|(_, arity)| *arity));
        let Some(arity) = arity else {
            if text == "rate" {
                self.diagnostics.error(region, "`rate(…)` has a meaning only in the forces of a scene");
            } else {
                let known = crate::graph::OPERATIONS.iter().map(|row| row.name);
                let hint = suggestion(&text, known.chain(VECTOR_FUNCTIONS.iter().map(|(name, _)| *name)));
                self.diagnostics.error(name.span(), format_args!("no function is called `{text}`{hint}"));
            }
            return Value::Poison;
        };
        if arguments.len() != arity {
            let plural = if arity == 1 { "argument" } else { "arguments" };
            self.diagnostics
                .error(region, format_args!("`{text}` takes {arity} {plural}, here are {}", arguments.len()));
            return Value::Poison;
        }
        if let Some(function) = function {
            let nodes: Option<Vec<NodeId>> = arguments.iter().map(|&argument| self.scalar(argument)).collect();
            let Some(nodes) = nodes else { return Value::Poison };
            if matches!(function, Function::Sin | Function::Cos | Function::Tan) {
                self.mark(nodes[0], Kind::Angle, self.expressions.region(arguments[0]));
            }
            return Value::Scalar(self.graph.call(function, &nodes));
        }
        if text == "powi" {
            return self.power(arguments[0], arguments[1]);
        }
        let vectors: Option<Vec<(NodeId, NodeId)>> = arguments.iter().map(|&argument| self.vector(argument)).collect();
        let Some(vectors) = vectors else { return Value::Poison };
        let (x, y) = vectors[0];
        let g = &mut self.graph;
        Value::Scalar(match (text.as_str(), vectors.get(1)) {
            ("x", _) => x,
            ("y", _) => y,
            ("norm", _) => g.call(Function::Hypot, &[x, y]),
            ("angle", _) => g.call(Function::Atan2, &[y, x]),
            // dot = ax bx + ay by, cross = ax by - ay bx.
            ("dot", Some(&(u, v))) => {
                let (left, right) = (g.multiply(x, u), g.multiply(y, v));
                g.add(left, right)
            }
            (_, Some(&(u, v))) => {
                let (left, right) = (g.multiply(x, v), g.multiply(y, u));
                g.subtract(left, right)
            }
            _ => return Value::Poison,
        })
    }

    /// A component is a length unless it is known to be something else: an angle may be plotted.
    fn suppose_lengths(&mut self, components: [NodeId; 2]) {
        for symbol in components.into_iter().flat_map(|node| bare_symbols(&self.graph, node)) {
            if !self.kinds.iter().any(|(other, _)| *other == symbol) {
                self.supposed.push(symbol);
            }
        }
    }

    /// Records that the names standing alone in an expression measure this kind of thing.
    fn mark(&mut self, node: NodeId, kind: Kind, region: Region) {
        for symbol in bare_symbols(&self.graph, node) {
            match self.kinds.iter().find(|(other, _)| *other == symbol) {
                None => self.kinds.push((symbol, kind)),
                Some((_, before)) if *before == kind => {}
                Some((_, before)) => {
                    let name = self.graph.symbol_name(symbol);
                    let message = format!("`{name}` is a {kind} here, but a {before} before");
                    self.diagnostics.error(region, message.replace("a angle", "an angle"));
                }
            }
        }
    }
}

/// Whether `drive` statements choose the inputs.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Choice {
    Fixed,
    Open,
}

fn check_use(mechanism: &Mechanism, scope: &Scope, diagnostics: &mut Diagnostics) {
    let parameters = mechanism.parameters.iter().map(|p| ("parameter", &p.name, p.symbol));
    let coordinates = mechanism.coordinates.iter().map(|c| ("coordinate", &c.name, c.symbol));
    for (what, name, symbol) in parameters.chain(coordinates) {
        if !scope.is_used(symbol) && !name.text.starts_with('_') {
            let text = &name.text;
            diagnostics
                .error(name.span, format_args!("the {what} `{text}` is never used; remove it, or call it `_{text}`"));
        }
    }
}

/// Two names may differ only in case, their fields may not.
fn check_fields(mechanism: &Mechanism, diagnostics: &mut Diagnostics) {
    let parameters: Vec<_> = mechanism.parameters.iter().map(|p| &p.name).collect();
    let coordinates: Vec<_> = mechanism.coordinates.iter().map(|c| &c.name).collect();
    let symbols: Vec<_> = parameters.into_iter().chain(coordinates).collect();
    let points: Vec<_> = mechanism.points.iter().map(|p| &p.name).collect();
    let outputs: Vec<_> = mechanism.outputs.iter().map(|o| &o.name).collect();
    for names in [symbols, points, outputs] {
        for (index, name) in names.iter().enumerate() {
            if let Some(first) = names[..index].iter().find(|other| other.field == name.field) {
                diagnostics.error(
                    name.span,
                    format_args!("`{}` and `{}` both become the field `{}`", first.text, name.text, name.field),
                );
            }
        }
    }
}

fn check_closures(mechanism: &Mechanism, choice: Choice, diagnostics: &mut Diagnostics) {
    let rows: usize = mechanism.closures.iter().map(|closure| closure.rows.len()).sum();
    let at = |driver: &Driver| -> Span { driver.name.span() };
    for driver in &mechanism.drivers {
        let unknowns = driver.unknowns.len();
        if rows != unknowns {
            let loops = mechanism.closures.iter().filter(|closure| closure.rows.len() == 2).count();
            let equations = mechanism.closures.len() - loops;
            let last = driver.unknowns.last().map(|&index| mechanism.coordinates[index].name.span);
            let span = if choice == Choice::Open { at(driver) } else { last.unwrap_or_else(|| at(driver)) };
            let advice = if rows < unknowns {
                "close another loop, or make unknowns inputs"
            } else {
                "a closure is too many, or an unknown is missing"
            };
            diagnostics.error(
                span,
                format_args!(
                    "{unknowns} unknowns, but {rows} closure rows (2 for each of {loops} `loop`, 1 for each of {equations} `equation`): {advice}"
                ),
            );
            continue;
        }
        if driver.inputs.is_empty() {
            diagnostics.error(at(driver), "nothing drives this mechanism: declare an `input`");
        }
        if rows == 0 {
            diagnostics.error(at(driver), "a mechanism needs at least one `loop` or `equation`");
        }
        let symbols: Vec<SymbolId> = driver.unknowns.iter().map(|&index| mechanism.coordinates[index].symbol).collect();
        let before = diagnostics.is_empty();
        for closure in &mechanism.closures {
            let found = mechanism.graph.symbols_of(&closure.rows);
            if !symbols.iter().any(|symbol| found.contains(symbol)) {
                diagnostics
                    .error(closure.span, format_args!("nothing unknown appears in this closure of `{}`", driver.name));
            }
        }
        let incidence = mechanism.incidence(driver);
        if before
            && diagnostics.is_empty()
            && let Err(singular) = crate::structure::order(&incidence, symbols.len())
        {
            let names: Vec<_> = singular
                .unknowns
                .iter()
                .map(|&unknown| format!("`{}`", mechanism.coordinates[driver.unknowns[unknown]].name.text))
                .collect();
            let span = singular
                .unknowns
                .first()
                .map_or_else(|| at(driver), |&unknown| mechanism.coordinates[driver.unknowns[unknown]].name.span);
            diagnostics.error(
                span,
                format_args!(
                    "`{}` cannot be solved at any position: {} appear in {} closure row{} together",
                    driver.name,
                    names.join(", "),
                    singular.equations.len(),
                    if singular.equations.len() == 1 { "" } else { "s" },
                ),
            );
        }
    }
}
