//! Resolution of expressions from syntax tree to graph, with a check of scalars and vectors.

use proc_macro2::Ident;

use super::functions::VECTOR_FUNCTIONS;
use super::kind::{Kind, bare_symbols};
use super::mechanism::{Call, Extreme};
use super::resolver::{Mode, Resolver};
use super::scope::Value;
use super::{advice, functions};
use crate::diagnostics::{Region, suggestion};
use crate::graph::{External, ExternalId, Function, NodeId, Number};
use crate::syntax::{Expression, ExpressionId, Operator, Unread};

impl Resolver<'_> {
    /// Reads an expression and its operands; returns its value.
    pub(super) fn value(&mut self, id: ExpressionId) -> Value {
        let expressions = self.expressions;
        let missing = (id.index() + 1).saturating_sub(self.values.len());
        for (expression, region) in expressions.from(self.values.len()).take(missing) {
            let value = self.read(expression, region);
            if self.mode == Mode::Law {
                self.motion.laws.insert(self.values.len());
            }
            let is_at_fault = self.report_fault(region);
            self.values.push(if is_at_fault { Value::Poison } else { value });
        }
        self.values[id.index()]
    }

    /// Reports a fault of the graph, if there was one; returns true then.
    pub(super) fn report_fault(&mut self, region: impl Into<Region>) -> bool {
        let fault = self.graph.take_fault();
        if let Some(fault) = fault {
            self.diagnostics.error(region, fault);
        }
        fault.is_some()
    }

    pub(super) fn scalar(&mut self, id: ExpressionId) -> Option<NodeId> {
        match self.value(id) {
            Value::Scalar(node) => Some(node),
            Value::Vector(..) => {
                self.expect_scalar(self.expressions.region(id));
                None
            }
            Value::Poison => None,
        }
    }

    pub(super) fn vector(&mut self, id: ExpressionId) -> Option<(NodeId, NodeId)> {
        match self.value(id) {
            Value::Vector(x, y) => Some((x, y)),
            Value::Scalar(_) => {
                self.expect_vector(id);
                None
            }
            Value::Poison => None,
        }
    }

    pub(super) fn expect_vector(&mut self, id: ExpressionId) {
        let (region, advice) = (self.expressions.region(id), self.as_vector(id));
        self.diagnostics.error(region, format_args!("expected a vector, found a scalar: {advice}"));
    }

    fn expect_scalar(&mut self, region: Region) {
        self.diagnostics
            .error(region, "expected a scalar, found a vector: use `x(…)`, `y(…)`, `norm(…)` or `angle(…)`");
    }

    /// The default of a parameter: the value of an expression without symbols.
    pub(super) fn default_of(&mut self, name: &Ident, id: ExpressionId) -> Option<NodeId> {
        let node = match self.within(Mode::Default, |resolver| resolver.value(id)) {
            Value::Scalar(node) => node,
            Value::Vector(..) => {
                let message = format!(
                    "a parameter is a number: write `let {name} = (x, y);`, perhaps with a parameter for each part"
                );
                self.diagnostics.error(self.expressions.region(id), message);
                self.scope.spoil(name);
                return None;
            }
            Value::Poison => return None,
        };
        if self.graph.constant_value(node).is_some() {
            return Some(node);
        }
        self.diagnostics.error(self.expressions.region(id), "a default must be a number: it cannot depend on names");
        None
    }

    fn read(&mut self, expression: &Expression, region: Region) -> Value {
        // The expression has the next index.
        if let (Expression::Number { digits, .. }, Some(suffix)) =
            (expression, self.expressions.suffix(self.values.len()))
        {
            return self.suffixed(digits, &suffix.word, suffix.is_hexadecimal, region);
        }
        match expression {
            Expression::Number { digits, unit } => match self.number(digits, region) {
                Some(number) => Value::Scalar(match unit.share_of_pi() {
                    Some(share) => {
                        let pi = self.graph.pi();
                        self.graph.scale(number.multiply(Number::ratio(1, share)), pi)
                    }
                    None => self.graph.number(number),
                }),
                None => {
                    self.diagnostics.error(region, "this is not a number");
                    Value::Poison
                }
            },
            Expression::Name(name) if name == "pi" => Value::Scalar(self.graph.pi()),
            Expression::Name(name) if self.mode == Mode::Law && name == "t" => {
                self.motion.time.map_or(Value::Poison, Value::Scalar)
            }
            Expression::Name(name) if self.mode == Mode::Default && !self.scope.is_declared(name) => {
                self.diagnostics.error(region, "a default must be a number: it cannot depend on names");
                Value::Poison
            }
            // `x` and `y` are names of coordinates more often than of functions.
            Expression::Name(name)
                if name != "x"
                    && name != "y"
                    && self.is_function(&name.to_string())
                    && !self.scope.is_declared(name) =>
            {
                self.diagnostics.error(region, format_args!("`{name}` is a function: write `{name}(…)`"));
                Value::Poison
            }
            Expression::Name(name) => self.scope.look_up(name, self.diagnostics),
            &Expression::Adjacent(ref name, operand) => self.adjacent(name, operand, region),
            Expression::Broken => Value::Poison,
            &Expression::Vector(x, y) => {
                match [x, y].map(|part| self.scalar(part).or_else(|| self.undeclared(part))).into() {
                    (Some(x), Some(y)) => {
                        self.suppose_lengths([x, y]);
                        Value::Vector(x, y)
                    }
                    _ => Value::Poison,
                }
            }
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
            Expression::Unread(names) => {
                for Unread { name, is_angle, is_length } in names {
                    let Some(symbol) = self.scope.symbol(name) else { continue };
                    self.scope.mention(symbol);
                    let kind = if *is_angle { Kind::Angle } else { Kind::Length };
                    if *is_angle || *is_length {
                        self.kinds.known.entry(symbol).or_insert(kind);
                    }
                }
                Value::Poison
            }
        }
    }

    pub(super) fn number(&mut self, digits: &str, region: Region) -> Option<Number> {
        let number = Number::parse(digits)?;
        let powers = libm::log2(number.to_f64().abs()).abs();
        if powers.is_finite() && self.extreme.is_none_or(|extreme| powers > extreme.powers) {
            self.extreme = Some(Extreme { region, powers });
        }
        Some(number)
    }

    /// r@phi = (r cos phi, r sin phi); (x, y)@phi = (x cos phi - y sin phi, x sin phi + y cos phi).
    fn at(&mut self, magnitude: ExpressionId, angle: ExpressionId) -> Value {
        let region = self.expressions.region(magnitude);
        let angle_region = self.expressions.region(angle);
        for (id, kind) in [(magnitude, Kind::Length), (angle, Kind::Angle)] {
            if let Some(name) = self.expressions.as_name(id).filter(|name| self.scope.symbol(name).is_none()) {
                self.assumed.kinds.push((name.to_string(), kind));
            }
        }
        let angle_id = angle;
        let value = match self.value(magnitude) {
            Value::Poison => self.undeclared(magnitude).map_or(Value::Poison, Value::Scalar),
            value => value,
        };
        let Some(angle) = self.scalar(angle).or_else(|| self.undeclared(angle)) else { return Value::Poison };
        if self.has_unit(magnitude, "a length") || self.degrees_without_unit(angle_id) {
            return Value::Poison;
        }
        if let Value::Scalar(length) = value
            && self.conflicts(length, Kind::Length)
            && self.conflicts(angle, Kind::Angle)
            && let (Some(length), Some(angle)) =
                (self.expressions.as_name(magnitude), self.expressions.as_name(angle_id))
        {
            let message = format!("the length comes before `@`, the angle after it: write `{angle}@{length}`");
            self.diagnostics.error(region.to(angle_region), message);
            return Value::Poison;
        }
        if !self.mark(angle, Kind::Angle, angle_region) {
            return Value::Poison;
        }
        let g = &mut self.graph;
        let (cosine, sine) = (g.call(Function::Cos, &[angle]), g.call(Function::Sin, &[angle]));
        match value {
            Value::Scalar(r) => {
                if !self.mark(r, Kind::Length, region) {
                    return Value::Poison;
                }
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
        let (mut scalars, mut vectors) = (Vec::new(), Vec::new());
        for &(operator, id) in operands {
            let sign = if operator == Operator::Direct { Number::ONE } else { Number::MINUS_ONE };
            match self.value(id) {
                Value::Scalar(node) => {
                    xs.push((sign, node));
                    scalars.push(id);
                }
                Value::Vector(x, y) => {
                    xs.push((sign, x));
                    ys.push((sign, y));
                    vectors.push(id);
                }
                Value::Poison => {}
            }
        }
        let poisoned = scalars.len() + vectors.len() < operands.len();
        if let ([scalar, ..], [vector, ..]) = (scalars.as_slice(), vectors.as_slice()) {
            let few_vectors = vectors.len() < scalars.len();
            let (at, message) = match few_vectors {
                true => (*vector, "a vector cannot be added to a scalar: use `x(…)`, `y(…)` or `norm(…)`".to_owned()),
                false => (*scalar, format!("a scalar cannot be added to a vector: {}", self.as_vector(*scalar))),
            };
            // A name with a wrong value is one mistake.
            if self.values_in(at).into_iter().all(|name| self.reported.scalars.insert(name)) {
                self.diagnostics.error(self.expressions.region(at), message);
            }
            return Value::Poison;
        }
        let first_is_vector = (!(scalars.is_empty() && vectors.is_empty())).then_some(scalars.is_empty());
        match (poisoned, first_is_vector) {
            (false, Some(true)) => Value::Vector(self.graph.sum(&xs), self.graph.sum(&ys)),
            (false, Some(false)) => {
                self.kinds.sums.push(scalars);
                Value::Scalar(self.graph.sum(&xs))
            }
            _ => Value::Poison,
        }
    }

    fn product(&mut self, operands: &[(Operator, ExpressionId)]) -> Value {
        let mut factors = Vec::new();
        let mut vector = None;
        let mut poisoned = false;
        for &(operator, id) in operands {
            match (self.value(id), operator) {
                (Value::Scalar(node), Operator::Direct | Operator::Missing) => factors.push((node, 1)),
                (Value::Scalar(node), Operator::Inverse) => {
                    if self.graph.is_zero(node) {
                        self.diagnostics.error(self.expressions.region(id), "division by zero");
                        return Value::Poison;
                    }
                    factors.push((node, -1));
                }
                (Value::Vector(x, y), Operator::Direct | Operator::Missing) if vector.is_none() => {
                    vector = Some((x, y))
                }
                (Value::Vector(..), Operator::Direct | Operator::Missing) => {
                    self.diagnostics
                        .error(self.expressions.region(id), "product of two vectors: use `dot(…)` or `cross(…)`");
                    return Value::Poison;
                }
                (Value::Vector(..), Operator::Inverse) => {
                    self.diagnostics.error(self.expressions.region(id), "division by a vector: use its `norm(…)`");
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

    fn call(&mut self, name: &Ident, arguments: &[ExpressionId], region: Region) -> Value {
        let text = name.to_string();
        if let Some((function, order)) = self.scope.function(&text) {
            return self.external(name, function, order, arguments, region);
        }
        if self.mode == Mode::Law && text == "rate" {
            let argument = self.takes(&text, 1, arguments, region).then(|| self.scalar(arguments[0])).flatten();
            return argument.map_or(Value::Poison, |argument| Value::Scalar(self.rate_of(argument)));
        }
        let function = Function::named(&text);
        let arity = function
            .map(|function| function.arity())
            .or_else(|| VECTOR_FUNCTIONS.iter().find(|(other, _)| *other == text).map(|(_, arity)| *arity));
        let Some(arity) = arity else {
            if text == "rate" {
                self.scope.report_motion("`rate(…)`", region, self.diagnostics);
            } else {
                let known = Function::written().map(|function| function.name());
                let known = known.chain(VECTOR_FUNCTIONS.iter().map(|(name, _)| *name)).chain(self.scope.functions());
                let hint = match (self.value_of(&text), advice::for_function(&text)) {
                    (Some(hint), _) => hint,
                    (None, Some(advice)) => format!(": {advice}"),
                    _ if self.scope.is_declared(name) => format!(": write `{name}*(…)` for a product"),
                    _ => suggestion(&text, known),
                };
                if !self.scope.is_excused(&text) && !self.scope.has_unread_functions {
                    let message = format!("unknown function `{text}`{hint}");
                    self.diagnostics.error(name.span(), message);
                }
            }
            return Value::Poison;
        };
        if !self.takes(&text, arity, arguments, region) {
            return Value::Poison;
        }
        if let Some(function) = function {
            let nodes: Option<Vec<NodeId>> = arguments.iter().map(|&argument| self.scalar(argument)).collect();
            let Some(nodes) = nodes else { return Value::Poison };
            if matches!(function, Function::Sin | Function::Cos | Function::Tan)
                && (self.degrees_without_unit(arguments[0])
                    || !self.mark(nodes[0], Kind::Angle, self.expressions.region(arguments[0])))
            {
                return Value::Poison;
            }
            return Value::Scalar(self.graph.call(function, &nodes));
        }
        if text == "powi" {
            return self.power(arguments[0], arguments[1]);
        }
        let vectors: Option<Vec<[NodeId; 2]>> =
            arguments.iter().map(|&argument| self.vector(argument).map(|(x, y)| [x, y])).collect();
        let Some(vectors) = vectors else { return Value::Poison };
        functions::of_vectors(&mut self.graph, &text, &vectors).map_or(Value::Poison, Value::Scalar)
    }

    /// Advice for a call of a user function by its path instead of by the name of its value.
    fn value_of(&self, function: &str) -> Option<String> {
        let mut named = self
            .externals
            .iter()
            .filter(|external| external.path.segments.last().is_some_and(|segment| segment.ident == function));
        Some(format!(": write `{}(…)` for its value", named.next()?.names.first()?.text))
    }

    fn takes(&mut self, name: &str, arity: usize, arguments: &[ExpressionId], region: Region) -> bool {
        if arguments.len() != arity {
            let plural = if arity == 1 { "argument" } else { "arguments" };
            self.diagnostics.error(region, format_args!("`{name}` takes {arity} {plural}, found {}", arguments.len()));
        }
        arguments.len() == arity
    }

    /// A call of a user function or of a derivative of it.
    fn external(
        &mut self,
        name: &Ident,
        function: ExternalId,
        order: usize,
        arguments: &[ExpressionId],
        region: Region,
    ) -> Value {
        let arity = self.externals[function.index()].arguments.len();
        if !self.takes(&name.to_string(), arity, arguments, region) {
            return Value::Poison;
        }
        let nodes: Option<Vec<NodeId>> = arguments.iter().map(|&argument| self.scalar(argument)).collect();
        let Some(nodes) = nodes else { return Value::Poison };
        self.externals[function.index()].calls.push(Call { region, order, arguments: nodes.clone() });
        Value::Scalar(self.graph.apply(External::new(function, arity, order), nodes))
    }

    /// Assumes that the components of a vector are lengths, unless another use says otherwise: an angle may be plotted.
    fn suppose_lengths(&mut self, components: [NodeId; 2]) {
        for symbol in components.into_iter().flat_map(|node| bare_symbols(&self.graph, node)) {
            if self.mode == Mode::Loop {
                self.kinds.lengths_of_loops.insert(symbol);
            }
            if !self.kinds.known.contains_key(&symbol) {
                self.kinds.supposed.insert(symbol);
            }
            if !self.mode.is_of_loads() {
                self.kinds.of_places.insert(symbol);
            }
        }
    }

    /// True if a name of an expression has another kind.
    fn conflicts(&self, node: NodeId, kind: Kind) -> bool {
        let symbols = bare_symbols(&self.graph, node);
        symbols.iter().any(|symbol| self.kinds.known.get(symbol).is_some_and(|known| *known != kind))
    }

    /// Records the kind of the symbols that have the kind of an expression; returns false if one has another kind.
    fn mark(&mut self, node: NodeId, kind: Kind, region: Region) -> bool {
        let mut agrees = true;
        for symbol in bare_symbols(&self.graph, node) {
            if kind == Kind::Length && !self.mode.is_of_loads() {
                self.kinds.of_places.insert(symbol);
            }
            match *self.kinds.known.entry(symbol).or_insert(kind) {
                before if before == kind => {}
                before => {
                    let name = self.graph.symbol_name(symbol);
                    let message = format!("`{name}` is used as a {kind} here, but as a {before} before");
                    self.diagnostics.error(region, message.replace("a angle", "an angle"));
                    agrees = false;
                }
            }
        }
        agrees
    }
}
