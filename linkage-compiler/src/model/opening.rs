//! Opened joints, for the forces in them.
//!
//! A joint is opened by a displacement of one link from the joint: from the pin, or across its guide and about the end
//! of it. Every vector is a path over links from the origin. Where it enters the link at the pin it is displaced, where
//! it leaves it there it is displaced back; a path that ends at the pin ends on the pin, and the centre of a body on its
//! link. The force in the joint is the generalised force of the displacement (see
//! `derivation::loads`).

use std::collections::BTreeMap;

use super::chain::{Link, in_order};
use super::links::{GROUND, Leg, LegOf, Links, moved};
use super::opened::Site;
use super::scope::Value;
use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::syntax::{Expression, ExpressionId, Expressions, Operator, Statement, StatementKind};

/// The opened joints, and the vectors in which they are displaced.
pub(super) struct Opening<'o> {
    pub(super) graph: &'o mut Graph,
    pub(super) expressions: &'o Expressions,
    pub(super) links: Links,
    pub(super) sites: Vec<(Site, [SymbolId; 2])>,
    /// The values of all expressions with closed joints.
    pub(super) plain: &'o [Value],
    /// The expressions that names stand for, and whether the name is that of a point.
    pub(super) definitions: BTreeMap<String, (ExpressionId, bool)>,
    /// The link of the body whose centre is displaced.
    owner: Option<usize>,
    /// The number of names that lead to the expression that is being displaced.
    names: usize,
}

/// The largest number of names that lead to an expression, each defined by the next; it bounds the recursion.
const LONGEST: usize = 256;

/// A path over links from the origin.
#[derive(Debug, Clone)]
struct Path {
    /// Its end; `None` after a vector that begins elsewhere.
    position: Option<[NodeId; 2]>,
    /// The link on which it ends; `None` for a pin.
    link: Option<usize>,
    shift: [NodeId; 2],
    /// True if it has not left the origin.
    is_fresh: bool,
}

impl<'o> Opening<'o> {
    pub(super) fn new(
        graph: &'o mut Graph,
        expressions: &'o Expressions,
        plain: &'o [Value],
        (links, sites): (Links, Vec<(Site, [SymbolId; 2])>),
        statements: &[Statement],
    ) -> Self {
        let mut definitions = BTreeMap::new();
        for statement in statements {
            let (name, value, is_point) = match &statement.kind {
                StatementKind::Let { name, value } | StatementKind::Output { name, value, .. } => (name, *value, false),
                StatementKind::Point { name, value } | StatementKind::Quantity { name, value } => (name, *value, true),
                _ => continue,
            };
            definitions.insert(name.to_string(), (value, is_point));
        }
        Self { graph, expressions, links, sites, plain, definitions, owner: None, names: 0 }
    }

    /// The displacement of a vector that begins at the origin and, for the centre of a body, ends on the link of the body;
    /// `None` if it is no path over links.
    pub(super) fn displacement(&mut self, id: ExpressionId, owner: Option<usize>) -> Option<[NodeId; 2]> {
        self.owner = owner;
        self.shift(id)
    }

    /// The displacement of the pin at the origin, at which a loop `… = 0` ends.
    pub(super) fn of_origin(&mut self) -> [NodeId; 2] {
        self.owner = None;
        let path = self.start();
        self.end(path).shift
    }

    /// The angle of a link, which turns with what slides on an opened guide.
    pub(super) fn turned(&mut self, link: usize, angle: NodeId) -> NodeId {
        let mut turned = angle;
        for (site, [_, turn]) in &self.sites {
            if matches!(site, Site::Guide { block, .. } if *block == link) {
                let turn = self.graph.variable(*turn);
                turned = self.graph.add(turned, turn);
            }
        }
        turned
    }

    /// The displacement of the end of a vector that begins at the origin.
    fn shift(&mut self, id: ExpressionId) -> Option<[NodeId; 2]> {
        match self.expressions.get(id) {
            Expression::Sum(operands) => self.shift_of_sum(operands, false),
            Expression::Negate(inner) => {
                let shift = self.shift(*inner)?;
                Some(shift.map(|part| self.graph.negate(part)))
            }
            Expression::Product(operands) => {
                let mut factors = Vec::new();
                let mut vector = None;
                for &(operator, operand) in operands {
                    match self.plain[operand.index()] {
                        Value::Scalar(node) => factors.push((node, if operator == Operator::Inverse { -1 } else { 1 })),
                        Value::Vector(..) => vector = Some(operand),
                        Value::Poison => return None,
                    }
                }
                let factor = self.graph.product(&factors);
                let shift = match self.expressions.get(vector?) {
                    // The mean of positions.
                    Expression::Sum(operands) => self.shift_of_sum(operands, true)?,
                    _ => self.shift(vector?)?,
                };
                Some(shift.map(|part| self.graph.multiply(factor, part)))
            }
            Expression::Name(name) => {
                let (definition, _) = *self.definitions.get(&name.to_string())?;
                self.behind(|opening| opening.shift(definition))
            }
            _ => {
                let path = self.start();
                match self.follow(id, false, path) {
                    Some(path) => Some(self.end(path).shift),
                    None => self.is_free(id).then(|| [self.graph.zero(); 2]),
                }
            }
        }
    }

    /// The displacement of a sum. An operand that does not continue the path is a position of its own.
    fn shift_of_sum(&mut self, operands: &[(Operator, ExpressionId)], is_mean: bool) -> Option<[NodeId; 2]> {
        let mut path = self.start();
        for &(operator, operand) in operands {
            let is_reversed = operator == Operator::Inverse;
            let is_position = is_mean && self.expressions.as_name(operand).is_some();
            let next = match is_position {
                true => None,
                false => self.follow(operand, is_reversed, path.clone()),
            };
            path = match next {
                Some(next) => next,
                None => {
                    let sign = if is_reversed { Number::MINUS_ONE } else { Number::ONE };
                    let own = self.shift(operand)?;
                    // The origin is not the end of a path that has not begun.
                    let ended = match path.is_fresh {
                        true => Path { position: None, link: None, is_fresh: false, ..path },
                        false => self.end(path),
                    };
                    let shift =
                        [0, 1].map(|axis| self.graph.sum(&[(Number::ONE, ended.shift[axis]), (sign, own[axis])]));
                    Path { shift, ..ended }
                }
            };
        }
        Some(self.end(path).shift)
    }

    /// Continues a path by a vector; `None` if it does not begin on a link there.
    fn follow(&mut self, id: ExpressionId, is_reversed: bool, mut path: Path) -> Option<Path> {
        match self.expressions.get(id) {
            Expression::Sum(operands) => {
                for (operator, operand) in in_order(operands, is_reversed) {
                    let is_reversed = is_reversed != (operator == Operator::Inverse);
                    path = self.follow(operand, is_reversed, path)?;
                }
                Some(path)
            }
            Expression::Negate(inner) => self.follow(*inner, !is_reversed, path),
            Expression::Name(name) => {
                let (definition, is_point) = *self.definitions.get(&name.to_string())?;
                if is_point && (is_reversed || !path.is_fresh) {
                    return None;
                }
                self.behind(|opening| opening.follow(definition, is_reversed, path))
            }
            _ => {
                let (plain, zero) = (self.plain, self.graph.zero());
                let link = Link::of(self.expressions, id, is_reversed, zero, &mut |id| plain[id.index()])?;
                if link.vector.iter().all(|&part| self.graph.is_zero(part)) {
                    return Some(path);
                }
                for leg in self.links.legs(self.graph, &link)? {
                    path = self.go(path, &leg)?;
                }
                Some(path)
            }
        }
    }

    /// Reads the definition of a name; `None` behind too many names, and once the budget is spent.
    fn behind<R>(&mut self, read: impl FnOnce(&mut Self) -> Option<R>) -> Option<R> {
        if self.names == LONGEST || self.graph.budget().check().is_err() {
            return None;
        }
        self.names += 1;
        let read = read(self);
        self.names -= 1;
        read
    }

    /// Continues a path by a leg.
    fn go(&mut self, mut path: Path, leg: &Leg) -> Option<Path> {
        let position = path.position?;
        let next = moved(self.graph, position, leg.vector);
        let [here, there] = [position, next].map(|position| self.links.joint(position));
        let at = |joint: Option<usize>, direction: usize| self.links.link_at(joint?, direction);
        let [on, ends_on] = match leg.of {
            LegOf::Rigid { direction } => {
                // Between the joints of a link its position is no joint.
                let own = path.link.filter(|&link| self.links.has_direction(link, direction));
                [at(here, direction).or(own)?; 2].map(Some)
            }
            LegOf::Guide { direction, .. } => [Some(at(here, direction)?), Some(at(there, direction)?)],
            LegOf::Free => {
                there?;
                [None; 2]
            }
        };
        if let Some(joint) = here {
            self.step(&mut path, joint, on);
        }
        path.link = ends_on;
        for (site, [first, turn]) in &self.sites {
            let Site::Guide { ends, block } = *site else { continue };
            let (first, turn) = (self.graph.variable(*first), self.graph.variable(*turn));
            let [x, y] = leg.vector;
            let displacement = match leg.of {
                LegOf::Rigid { .. } if on == Some(block) => {
                    let across = self.graph.multiply(turn, y);
                    [self.graph.negate(across), self.graph.multiply(turn, x)]
                }
                LegOf::Guide { normal, .. } if [here, there] == ends.map(Some) => {
                    normal.map(|part| self.graph.multiply(first, part))
                }
                LegOf::Guide { normal, .. } if [there, here] == ends.map(Some) => {
                    normal.map(|part| self.graph.multiply(first, part)).map(|part| self.graph.negate(part))
                }
                _ => continue,
            };
            path.shift = moved(self.graph, path.shift, displacement);
        }
        Some(Path { position: Some(next), is_fresh: false, ..path })
    }

    /// Ends a path on its owner, or else on the pin at its end.
    fn end(&mut self, mut path: Path) -> Path {
        if let Some(joint) = path.position.and_then(|position| self.links.joint(position)) {
            self.step(&mut path, joint, self.owner);
        }
        Path { position: None, link: None, is_fresh: false, ..path }
    }

    /// Changes the link of a path at a joint.
    fn step(&mut self, path: &mut Path, joint: usize, to: Option<usize>) {
        if path.link == to {
            return;
        }
        for (site, symbols) in &self.sites {
            let Site::Pin { joint: opened, link } = *site else { continue };
            let sign = match Some(link) {
                _ if opened != joint => continue,
                link if link == to => Number::ONE,
                link if link == path.link => Number::MINUS_ONE,
                _ => continue,
            };
            let symbols = symbols.map(|symbol| self.graph.variable(symbol));
            path.shift = [0, 1].map(|axis| self.graph.sum(&[(Number::ONE, path.shift[axis]), (sign, symbols[axis])]));
        }
        path.link = to;
    }

    fn start(&mut self) -> Path {
        let zero = [self.graph.zero(); 2];
        Path { position: Some(zero), link: Some(GROUND), shift: zero, is_fresh: true }
    }

    /// True for a vector that no displacement changes: it turns with no link that an opened guide turns.
    fn is_free(&mut self, id: ExpressionId) -> bool {
        let (plain, zero) = (self.plain, self.graph.zero());
        let link = Link::of(self.expressions, id, false, zero, &mut |id| plain[id.index()]);
        let Some(legs) = link.and_then(|link| self.links.legs(self.graph, &link)) else { return false };
        let turns = |leg: &Leg| {
            let LegOf::Rigid { direction } = leg.of else { return false };
            let mut sites = self.sites.iter();
            sites.any(
                |(site, _)| matches!(site, Site::Guide { block, .. } if self.links.has_direction(*block, direction)),
            )
        };
        !legs.iter().any(turns)
    }
}
