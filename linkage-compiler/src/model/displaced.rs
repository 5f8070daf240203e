//! The formulas of a mechanism with displaced joints. Each expression has a second value: a vector is displaced by its
//! path over links (see `opening`), and a scalar is made of the second values of its operands.

use std::collections::BTreeMap;

use super::links::Links;
use super::mechanism::Mechanism;
use super::opened::{Load, OpenedBody, Paths, Site};
use super::opening::Opening;
use super::resolver::Resolver;
use super::scene::Body;
use super::scope::{Scope, Value};
use super::{equation, functions};
use crate::diagnostics::Region;
use crate::graph::{External, Function, NodeId, Number};
use crate::ids::{BodyId, Id};
use crate::syntax::{self, Expression, ExpressionId, Operator, StatementKind};

impl Resolver<'_> {
    /// Finds the formulas of a mechanism without mistakes with displaced joints.
    pub(super) fn displace(
        &mut self,
        statements: &[syntax::Statement],
        links: Links,
        joints: &[(Site, Load)],
        result: &mut Mechanism,
    ) {
        let sites = joints.iter().map(|(site, load)| (*site, load.displacement)).collect();
        let opening = Opening::new(&mut self.graph, self.expressions, &self.values, (links, sites), statements);
        let mut displaced = Displaced { opening, scope: &self.scope, values: Vec::new(), unclear: BTreeMap::new() };
        let owners = displaced.owners(statements);
        for index in 0..self.values.len() {
            let id = self.expressions.id(index);
            let value = match self.motion.laws.contains(&index) {
                // A law is a force, not a path.
                true => self.values[index],
                false => displaced.value(id, owners.get(&index).copied()),
            };
            displaced.values.push(value);
            if let Some(fault) = displaced.opening.graph.take_fault() {
                self.diagnostics.error(self.expressions.region(id), fault);
            }
        }
        let origin = displaced.opening.of_origin();
        let opened = &mut result.opened;
        let mut bodies = result.bodies.enumerated();
        for statement in statements {
            match &statement.kind {
                StatementKind::Loop { left, right, is_implied }
                | StatementKind::Equation { left, right, is_implied } => {
                    let [left, right] = [left, right].map(|side| displaced.values[side.index()]);
                    let rows = equation::residual(displaced.opening.graph, left, right, origin).unwrap_or_default();
                    if *is_implied { &mut opened.implied } else { &mut opened.rows }.extend(rows);
                }
                StatementKind::Body(tree) => {
                    let Some((id, body)) = bodies.next() else { continue };
                    opened.bodies.push(displaced.body(id, body, tree));
                }
                _ => {}
            }
        }
        let unclear = displaced.first_unclear();
        let values = displaced.values;
        if let Some(region) = unclear {
            let message = "the forces in joints need this vector as a sum of vectors `r@phi`, `(x, y)@phi` and points";
            self.diagnostics.error(region, message);
        }
        for scene in result.scenes.iter() {
            let laws = scene.written.laws.iter().flat_map(|along| self.along(along, &values)).collect();
            let contacts = scene.written.contacts.iter().flat_map(|along| self.along(along, &values)).collect();
            result.opened.scenes.push(Paths { laws, contacts });
        }
    }
}

/// The values of expressions with displaced joints.
struct Displaced<'o> {
    opening: Opening<'o>,
    scope: &'o Scope,
    /// By expression, as far as they are known; operands have smaller ids.
    values: Vec<Value>,
    /// The vectors that are no paths over links, by expression.
    unclear: BTreeMap<usize, Region>,
}

impl Displaced<'_> {
    /// The links of bodies by the expressions of their centres.
    fn owners(&self, statements: &[syntax::Statement]) -> BTreeMap<usize, usize> {
        let bodies = statements.iter().filter_map(|statement| match &statement.kind {
            StatementKind::Body(body) => Some(body),
            _ => None,
        });
        let centers = bodies.zip(&self.opening.links.bodies);
        centers.filter_map(|(body, &link)| Some((body.property("center")?.index(), link))).collect()
    }

    fn value(&mut self, id: ExpressionId, owner: Option<usize>) -> Value {
        match self.opening.plain[id.index()] {
            Value::Vector(x, y) => {
                let shift = self.opening.displacement(id, owner);
                // An operand of a sum is no position by itself.
                for operand in vectors_of(self.opening.expressions.get(id)) {
                    self.unclear.remove(&operand.index());
                }
                if shift.is_none() {
                    self.unclear.insert(id.index(), self.opening.expressions.region(id));
                }
                let graph = &mut *self.opening.graph;
                shift.map_or(Value::Vector(x, y), |[dx, dy]| Value::Vector(graph.add(x, dx), graph.add(y, dy)))
            }
            Value::Scalar(plain) => self.scalar(id).unwrap_or(Value::Scalar(plain)),
            Value::Poison => Value::Poison,
        }
    }

    /// The value of a scalar that depends on displaced vectors; `None` of another one.
    fn scalar(&mut self, id: ExpressionId) -> Option<Value> {
        let (expressions, values) = (self.opening.expressions, &self.values);
        let expression = expressions.get(id);
        if let Expression::Name(name) = expression {
            let (definition, _) = self.opening.definitions.get(&name.to_string())?;
            return values.get(definition.index()).copied();
        }
        let operands = expression.operands();
        if operands.iter().all(|operand| values[operand.index()] == self.opening.plain[operand.index()]) {
            return None;
        }
        let graph = &mut *self.opening.graph;
        let node = |id: &ExpressionId| values[id.index()].scalar();
        let node = match expression {
            Expression::Sum(operands) => {
                let terms = operands.iter().map(|(operator, operand)| {
                    let sign = if *operator == Operator::Inverse { Number::MINUS_ONE } else { Number::ONE };
                    Some((sign, node(operand)?))
                });
                graph.sum(&terms.collect::<Option<Vec<_>>>()?)
            }
            Expression::Product(operands) => {
                let factors = operands.iter().map(|(operator, operand)| {
                    let exponent = if *operator == Operator::Inverse { -1 } else { 1 };
                    Some((node(operand)?, exponent))
                });
                graph.product(&factors.collect::<Option<Vec<_>>>()?)
            }
            Expression::Negate(inner) => graph.negate(node(inner)?),
            Expression::Power(base, exponent) => functions::power(graph, node(base)?, node(exponent)?)?,
            Expression::Call(name, arguments) => {
                let name = name.to_string();
                let vectors = arguments.iter().map(|argument| values[argument.index()].vector());
                if let Some(vectors) = vectors.collect::<Option<Vec<_>>>() {
                    functions::of_vectors(graph, &name, &vectors)?
                } else {
                    let nodes: Vec<NodeId> = arguments.iter().map(node).collect::<Option<_>>()?;
                    match (self.scope.function(&name), Function::named(&name), nodes.as_slice()) {
                        (Some((function, order)), ..) => {
                            graph.apply(External::new(function, nodes.len(), order), nodes)
                        }
                        (None, Some(function), _) => graph.call(function, &nodes),
                        (None, None, &[base, exponent]) => functions::power(graph, base, exponent)?,
                        _ => return None,
                    }
                }
            }
            _ => return None,
        };
        Some(Value::Scalar(node))
    }

    /// The centre and the angle of a body.
    fn body(&mut self, id: BodyId, body: &Body, tree: &syntax::Body) -> OpenedBody {
        let value = |word: &str| tree.property(word).map(|value| self.values[value.index()]);
        let center = value("center").and_then(Value::vector).filter(|_| body.mass.is_some());
        let angle = value("angle").and_then(Value::scalar).filter(|_| body.inertia.is_some());
        let link = self.opening.links.bodies.get(id.index()).copied();
        let angle = angle.map(|angle| link.map_or(angle, |link| self.opening.turned(link, angle)));
        OpenedBody { center, angle }
    }

    /// The first vector that is no path over links; a `let` may be a part of one.
    fn first_unclear(&mut self) -> Option<Region> {
        for (part, _) in self.opening.definitions.values().filter(|(_, is_point)| !is_point) {
            self.unclear.remove(&part.index());
        }
        self.unclear.values().next().copied()
    }
}

/// The operands of a vector expression that may be vectors.
fn vectors_of(expression: &Expression) -> Vec<ExpressionId> {
    match expression {
        Expression::Sum(operands) | Expression::Product(operands) => operands.iter().map(|(_, id)| *id).collect(),
        Expression::Negate(inner) | Expression::At(inner, _) => vec![*inner],
        _ => Vec::new(),
    }
}
