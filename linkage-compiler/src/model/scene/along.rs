//! The scalars that effects act along, from the values of the expressions that write them.

use crate::graph::{Function, Graph, Node, NodeId};
use crate::model::resolver::Resolver;
use crate::model::scope::Value;
use crate::syntax::{Attachment, ExpressionId};

/// The scalars of one effect, as written: with displaced joints they have other formulas.
#[derive(Debug, Clone, Copy)]
pub(in crate::model) enum Along {
    /// Half the square of a length or another magnitude, or another scalar.
    Spring(Attachment),
    /// Half the square of a length or another magnitude, x of |x|, or another scalar.
    Damper(Attachment),
    /// The two coordinates of a point.
    Point(ExpressionId),
    /// The terms of a potential energy.
    Potential(ExpressionId),
    /// A scalar; x of |x| if it is signed.
    Contact { on: ExpressionId, is_signed: bool },
}

/// The scalars of the laws and of the contacts of a scene, in order.
#[derive(Debug, Default)]
pub(in crate::model) struct Written {
    pub(in crate::model) laws: Vec<Along>,
    pub(in crate::model) contacts: Vec<Along>,
}

impl Resolver<'_> {
    /// The formulas of the scalars of an effect with these values of expressions; none if one has no value.
    pub(in crate::model) fn along(&mut self, along: &Along, values: &[Value]) -> Vec<NodeId> {
        let value = |id: ExpressionId| values.get(id.index()).copied().unwrap_or(Value::Poison);
        let scalar = match *along {
            Along::Spring(attachment) => {
                length(&mut self.graph, attachment, &value).map(|scalar| self.half_square_or_self(scalar))
            }
            Along::Damper(attachment) => length(&mut self.graph, attachment, &value).map(|scalar| {
                let scalar = self.signed(scalar);
                self.half_square_or_self(scalar)
            }),
            Along::Point(at) => return value(at).vector().into_iter().flatten().collect(),
            Along::Potential(energy) => {
                let laws = value(energy).scalar().map(|energy| self.potential(energy));
                return laws.into_iter().flatten().map(|(_, along, _)| along).collect();
            }
            Along::Contact { on, is_signed } => {
                value(on).scalar().map(|scalar| if is_signed { self.signed(scalar) } else { scalar })
            }
        };
        scalar.into_iter().collect()
    }

    fn half_square_or_self(&mut self, scalar: NodeId) -> NodeId {
        self.half_square(scalar).unwrap_or(scalar)
    }

    /// x of |x|: a force against |x|' along |x| is one against x' along x.
    pub(super) fn signed(&self, scalar: NodeId) -> NodeId {
        match self.graph.node(scalar) {
            Node::Call(Function::Abs, x) => x[0],
            _ => scalar,
        }
    }
}

/// The scalar of a place: an expression, or the distance of two points.
pub(super) fn length(
    graph: &mut Graph,
    attachment: Attachment,
    value: &dyn Fn(ExpressionId) -> Value,
) -> Option<NodeId> {
    match attachment {
        Attachment::On(on) => value(on).scalar(),
        Attachment::Between(from, to) => {
            let [[ax, ay], [bx, by]] = [value(from).vector()?, value(to).vector()?];
            let (x, y) = (graph.subtract(bx, ax), graph.subtract(by, ay));
            Some(graph.call(Function::Hypot, &[x, y]))
        }
    }
}
