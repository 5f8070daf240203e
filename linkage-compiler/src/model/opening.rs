//! Opened joints, for the forces in them.
//!
//! A joint is opened by a displacement of one link from the joint: from the pin, or across its guide and about the end
//! of it. Every vector is then read again as a path over links from the origin. Where it enters the link at the pin it
//! is displaced, where it leaves it there it is displaced back; a path that ends at the pin ends on the pin, and the
//! centre of a body on its link. The force in the joint is the generalised force of the displacement (see
//! `derivation::loads`).

use std::collections::BTreeMap;

use super::chain::{Link, in_order};
use super::links::{GROUND, Leg, LegOf, Links, moved};
use super::opened::Site;
use super::scope::Value;
use crate::diagnostics::Region;
use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::syntax::{Expression, ExpressionId, Expressions, Operator};

/// The second reading of all vectors, with displaced joints.
pub(super) struct Opening {
    pub(super) links: Links,
    pub(super) sites: Vec<(Site, [SymbolId; 2])>,
    /// The values of the first reading.
    pub(super) plain: Vec<Value>,
    /// The vectors that names stand for, and whether the name is that of a point.
    pub(super) definitions: BTreeMap<String, (ExpressionId, bool)>,
    /// The link of the body whose centre is read.
    pub(super) owner: Option<usize>,
    /// The vectors that are no paths over links, by expression.
    pub(super) unclear: BTreeMap<usize, Region>,
}

/// A path over links from the origin.
#[derive(Debug, Clone)]
pub(super) struct Path {
    /// Its end; `None` after a vector that begins elsewhere.
    position: Option<[NodeId; 2]>,
    /// The link on which it ends; `None` for a pin.
    link: Option<usize>,
    pub(super) shift: [NodeId; 2],
    /// True if it has not left the origin.
    is_fresh: bool,
}

impl Opening {
    /// The first vector that is no path over links; a `let` may be a part of one.
    pub(super) fn unclear(mut self) -> Option<Region> {
        for (part, _) in self.definitions.values().filter(|(_, is_point)| !is_point) {
            self.unclear.remove(&part.index());
        }
        self.unclear.into_values().next()
    }

    /// The displacement of the end of a vector that begins at the origin.
    pub(super) fn shift(
        &mut self,
        graph: &mut Graph,
        expressions: &Expressions,
        id: ExpressionId,
    ) -> Option<[NodeId; 2]> {
        match expressions.get(id) {
            Expression::Sum(operands) => self.shift_of_sum(graph, expressions, operands, false),
            Expression::Negate(inner) => {
                let shift = self.shift(graph, expressions, *inner)?;
                Some(shift.map(|part| graph.negate(part)))
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
                let factor = graph.product(&factors);
                let shift = match expressions.get(vector?) {
                    // The mean of positions.
                    Expression::Sum(operands) => self.shift_of_sum(graph, expressions, operands, true)?,
                    _ => self.shift(graph, expressions, vector?)?,
                };
                Some(shift.map(|part| graph.multiply(factor, part)))
            }
            Expression::Name(name) => {
                let (definition, _) = *self.definitions.get(&name.to_string())?;
                self.shift(graph, expressions, definition)
            }
            _ => {
                let path = self.start(graph);
                match self.follow(graph, expressions, id, false, path) {
                    Some(path) => Some(self.end(graph, path).shift),
                    None => self.is_free(graph, expressions, id).then(|| [graph.zero(); 2]),
                }
            }
        }
    }

    /// The displacement of a sum. An operand that does not continue the path is a position of its own.
    fn shift_of_sum(
        &mut self,
        graph: &mut Graph,
        expressions: &Expressions,
        operands: &[(Operator, ExpressionId)],
        is_mean: bool,
    ) -> Option<[NodeId; 2]> {
        let mut path = self.start(graph);
        for &(operator, operand) in operands {
            let is_reversed = operator == Operator::Inverse;
            let is_position = is_mean && expressions.as_name(operand).is_some();
            let next = match is_position {
                true => None,
                false => self.follow(graph, expressions, operand, is_reversed, path.clone()),
            };
            path = match next {
                Some(next) => next,
                None => {
                    let sign = if is_reversed { Number::MINUS_ONE } else { Number::ONE };
                    let own = self.shift(graph, expressions, operand)?;
                    // The origin is not the end of a path that has not begun.
                    let ended = match path.is_fresh {
                        true => Path { position: None, link: None, is_fresh: false, ..path },
                        false => self.end(graph, path),
                    };
                    let shift = [0, 1].map(|axis| graph.sum(&[(Number::ONE, ended.shift[axis]), (sign, own[axis])]));
                    Path { shift, ..ended }
                }
            };
        }
        Some(self.end(graph, path).shift)
    }

    /// Continues a path by a vector; `None` if it does not begin on a link there.
    fn follow(
        &mut self,
        graph: &mut Graph,
        expressions: &Expressions,
        id: ExpressionId,
        is_reversed: bool,
        mut path: Path,
    ) -> Option<Path> {
        match expressions.get(id) {
            Expression::Sum(operands) => {
                for (operator, operand) in in_order(operands, is_reversed) {
                    let is_reversed = is_reversed != (operator == Operator::Inverse);
                    path = self.follow(graph, expressions, operand, is_reversed, path)?;
                }
                Some(path)
            }
            Expression::Negate(inner) => self.follow(graph, expressions, *inner, !is_reversed, path),
            Expression::Name(name) => {
                let (definition, is_point) = *self.definitions.get(&name.to_string())?;
                if is_point && (is_reversed || !path.is_fresh) {
                    return None;
                }
                self.follow(graph, expressions, definition, is_reversed, path)
            }
            _ => {
                let (plain, zero) = (&self.plain, graph.zero());
                let link = Link::of(expressions, id, is_reversed, zero, &mut |id| plain[id.index()])?;
                if link.vector.iter().all(|&part| graph.is_zero(part)) {
                    return Some(path);
                }
                for leg in self.links.legs(graph, &link)? {
                    path = self.go(graph, path, &leg)?;
                }
                Some(path)
            }
        }
    }

    /// Continues a path by a leg.
    fn go(&self, graph: &mut Graph, mut path: Path, leg: &Leg) -> Option<Path> {
        let position = path.position?;
        let next = moved(graph, position, leg.vector);
        let [here, there] = [position, next].map(|position| self.links.place(position));
        let at = |place: Option<usize>, direction: usize| self.links.link_at(place?, direction);
        let [on, ends_on] = match leg.of {
            LegOf::Rigid { direction } => {
                // Between the joints of a link its position is no place.
                let own = path.link.filter(|&link| self.links.has_direction(link, direction));
                [at(here, direction).or(own)?; 2].map(Some)
            }
            LegOf::Guide { direction, .. } => [Some(at(here, direction)?), Some(at(there, direction)?)],
            LegOf::Free => {
                there?;
                [None; 2]
            }
        };
        if let Some(place) = here {
            self.step(graph, &mut path, place, on);
        }
        path.link = ends_on;
        for (site, [first, turn]) in &self.sites {
            let Site::Guide { ends, block } = *site else { continue };
            let (first, turn) = (graph.variable(*first), graph.variable(*turn));
            let [x, y] = leg.vector;
            let displacement = match leg.of {
                LegOf::Rigid { .. } if on == Some(block) => {
                    let across = graph.multiply(turn, y);
                    [graph.negate(across), graph.multiply(turn, x)]
                }
                LegOf::Guide { normal, .. } if [here, there] == ends.map(Some) => {
                    normal.map(|part| graph.multiply(first, part))
                }
                LegOf::Guide { normal, .. } if [there, here] == ends.map(Some) => {
                    normal.map(|part| graph.multiply(first, part)).map(|part| graph.negate(part))
                }
                _ => continue,
            };
            path.shift = moved(graph, path.shift, displacement);
        }
        Some(Path { position: Some(next), is_fresh: false, ..path })
    }

    /// Ends a path on its owner, or else on the pin at its end.
    pub(super) fn end(&self, graph: &mut Graph, mut path: Path) -> Path {
        if let Some(place) = path.position.and_then(|position| self.links.place(position)) {
            self.step(graph, &mut path, place, self.owner);
        }
        Path { position: None, link: None, is_fresh: false, ..path }
    }

    /// Changes the link of a path at a place.
    fn step(&self, graph: &mut Graph, path: &mut Path, place: usize, to: Option<usize>) {
        if path.link == to {
            return;
        }
        for (site, symbols) in &self.sites {
            let Site::Pin { place: opened, link } = *site else { continue };
            let sign = match Some(link) {
                _ if opened != place => continue,
                link if link == to => Number::ONE,
                link if link == path.link => Number::MINUS_ONE,
                _ => continue,
            };
            let symbols = symbols.map(|symbol| graph.variable(symbol));
            path.shift = [0, 1].map(|axis| graph.sum(&[(Number::ONE, path.shift[axis]), (sign, symbols[axis])]));
        }
        path.link = to;
    }

    pub(super) fn start(&self, graph: &mut Graph) -> Path {
        let zero = [graph.zero(); 2];
        Path { position: Some(zero), link: Some(GROUND), shift: zero, is_fresh: true }
    }

    /// True for a vector that no displacement changes: it turns with no link that an opened guide turns.
    fn is_free(&mut self, graph: &mut Graph, expressions: &Expressions, id: ExpressionId) -> bool {
        let (plain, zero) = (&self.plain, graph.zero());
        let link = Link::of(expressions, id, false, zero, &mut |id| plain[id.index()]);
        let Some(legs) = link.and_then(|link| self.links.legs(graph, &link)) else { return false };
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
