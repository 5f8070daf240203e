//! The second reading of a mechanism, with displaced joints.

use std::collections::BTreeMap;

use super::links::Links;
use super::mechanism::Mechanism;
use super::opened::{Load, Opened, OpenedBody, Site};
use super::opening::Opening;
use super::resolver::{Mode, Resolver};
use super::scene::Body;
use super::scope::Value;
use crate::graph::{NodeId, SymbolId};
use crate::ids::BodyId;
use crate::syntax::{self, Expression, ExpressionId, StatementKind};

impl Resolver<'_> {
    /// Reads all statements again with displaced joints.
    pub(super) fn open(
        &mut self,
        statements: &[syntax::Statement],
        links: Links,
        joints: &[(Site, Load)],
        mut again: Mechanism,
        opened: &mut Opened,
    ) {
        let mut definitions = BTreeMap::new();
        for statement in statements {
            let (name, value, is_point) = match &statement.kind {
                StatementKind::Let { name, value } => (name, *value, false),
                StatementKind::Point { name, value } | StatementKind::Quantity { name, value } => (name, *value, true),
                _ => continue,
            };
            definitions.insert(name.to_string(), (value, is_point));
        }
        let sites = joints.iter().map(|(site, load)| (*site, load.displacement)).collect();
        let plain = std::mem::take(&mut self.values);
        self.opening = Some(Opening { links, sites, plain, definitions, owner: None, unclear: BTreeMap::new() });
        self.scope.forget_values();
        let messages = self.diagnostics.len();
        let calls: Vec<usize> = self.externals.iter().map(|external| external.calls.len()).collect();
        let reading = self.define(statements, &mut again);
        self.diagnostics.truncate(messages);
        self.externals.iter_mut().zip(calls).for_each(|(external, calls)| external.calls.truncate(calls));
        if let Some(region) = self.opening.take().and_then(Opening::unclear) {
            let message = "the forces in joints need this vector as a sum of vectors `r@phi`, `(x, y)@phi` and points";
            self.diagnostics.error(region, message);
        }
        [opened.rows, opened.implied] = [again.constraints, again.implied]
            .map(|constraints| constraints.into_iter().flat_map(|constraint| constraint.rows).collect());
        opened.bodies = again.bodies.iter().map(opened_body).collect();
        opened.scenes = reading.paths();
    }

    /// The value of an expression with displaced joints; a law is a force, not a path.
    pub(super) fn displaced(&mut self, index: usize, value: Value) -> Value {
        if self.mode == Mode::Law {
            return value;
        }
        let Some(mut opening) = self.opening.take() else { return value };
        let id = self.expressions.id(index);
        let displaced = match opening.plain.get(index) {
            Some(&Value::Vector(x, y)) => {
                let shift = opening.shift(&mut self.graph, self.expressions, id);
                // An operand of a sum is no position by itself.
                for operand in vectors_of(self.expressions.get(id)) {
                    opening.unclear.remove(&operand.index());
                }
                let shift = shift.unwrap_or_else(|| {
                    opening.unclear.insert(index, self.expressions.region(id));
                    [self.graph.zero(); 2]
                });
                Value::Vector(self.graph.add(x, shift[0]), self.graph.add(y, shift[1]))
            }
            _ => value,
        };
        self.opening = Some(opening);
        displaced
    }

    /// The pin at the origin, at which a loop `… = 0` ends.
    pub(super) fn displaced_origin(&mut self) -> [NodeId; 2] {
        let zero = [self.graph.zero(); 2];
        let Some(opening) = &self.opening else { return zero };
        let path = opening.start(&mut self.graph);
        opening.end(&mut self.graph, path).shift
    }

    /// Reads the centre of a body, which is on the link of this body.
    pub(super) fn center(&mut self, body: BodyId, value: ExpressionId) -> Option<(NodeId, NodeId)> {
        if let Some(opening) = &mut self.opening {
            opening.owner = opening.links.bodies.ids().find(|&id| id == body).map(|id| opening.links.bodies[id]);
        }
        let center = self.vector(value);
        if let Some(opening) = &mut self.opening {
            opening.owner = None;
        }
        center
    }

    /// The angle of a body, which turns with what slides on an opened guide.
    pub(super) fn turned(&mut self, body: BodyId, angle: NodeId) -> NodeId {
        let Some(opening) = &self.opening else { return angle };
        let Some(link) = opening.links.bodies.ids().find(|&id| id == body).map(|id| opening.links.bodies[id]) else {
            return angle;
        };
        let turns =
            opening.sites.iter().filter(|(site, _)| matches!(site, Site::Guide { block, .. } if *block == link));
        let turns: Vec<SymbolId> = turns.map(|(_, [_, turn])| *turn).collect();
        turns.into_iter().fold(angle, |angle, turn| {
            let turn = self.graph.variable(turn);
            self.graph.add(angle, turn)
        })
    }
}

fn opened_body(body: &Body) -> OpenedBody {
    OpenedBody { center: body.mass.map(|(_, center)| center), angle: body.inertia.map(|(_, angle)| angle) }
}

/// The operands of a vector expression that may be vectors.
fn vectors_of(expression: &Expression) -> Vec<ExpressionId> {
    match expression {
        Expression::Sum(operands) | Expression::Product(operands) => operands.iter().map(|(_, id)| *id).collect(),
        Expression::Negate(inner) | Expression::At(inner, _) => vec![*inner],
        _ => Vec::new(),
    }
}
