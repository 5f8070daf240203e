//! The vectors of a loop or of a point, one after the other as the user wrote them: the joints of a linkage lie between
//! them.

use super::scope::Value;
use crate::graph::NodeId;
use crate::syntax::{Expression, ExpressionId, Expressions, Operator};

/// One vector of a chain.
#[derive(Debug, Clone, Copy)]
pub struct Link {
    pub vector: [NodeId; 2],
    /// True if the vector is subtracted.
    pub is_reversed: bool,
    /// The angle of `r@angle`.
    pub angle: Option<NodeId>,
    /// The length of `r@angle`.
    pub length: Option<NodeId>,
    /// The parts of the vector along its angle and across, if it is written as `r@angle`, `(x, y)@angle` or `(x, y)`.
    pub parts: Option<[NodeId; 2]>,
}

impl Link {
    /// The vector that an expression writes; `None` if it is a scalar.
    pub(super) fn of(
        expressions: &Expressions,
        id: ExpressionId,
        is_reversed: bool,
        zero: NodeId,
        value: &mut dyn FnMut(ExpressionId) -> Value,
    ) -> Option<Self> {
        let Value::Vector(x, y) = value(id) else { return None };
        let mut link = Self { vector: [x, y], is_reversed, angle: None, length: None, parts: None };
        match *expressions.get(id) {
            Expression::At(length, angle) => {
                link.angle = value(angle).scalar();
                let length = value(length);
                link.length = length.scalar();
                link.parts = match length {
                    Value::Scalar(length) => Some([length, zero]),
                    Value::Vector(x, y) => Some([x, y]),
                    Value::Poison => None,
                };
            }
            Expression::Vector(..) => link.parts = Some(link.vector),
            _ => {}
        }
        Some(link)
    }
}

/// Vectors in a row, from a point or from the origin.
#[derive(Debug, Clone, Default)]
pub struct Chain {
    /// The position of the point that it starts from.
    pub start: Option<[NodeId; 2]>,
    pub links: Vec<Link>,
}

/// A position as a mean of points, and a vector from it.
#[derive(Debug, Clone)]
pub(super) struct Mean {
    pub(super) points: Vec<[NodeId; 2]>,
    pub(super) offset: [NodeId; 2],
}

/// The chains of all loops, points and centres of bodies in the order of declaration; empty where an expression is no sum of vectors.
#[derive(Debug, Default)]
pub(super) struct Chains {
    pub(super) loops: Vec<[Chain; 2]>,
    /// The sides of loops that are zero.
    pub(super) zeros: Vec<[bool; 2]>,
    pub(super) points: Vec<Chain>,
    pub(super) centers: Vec<Chain>,
    /// The centres that are means of points, by body.
    pub(super) means: Vec<Option<Mean>>,
}

/// The operands of a sum in the order in which a chain follows them: from the last one if the sum is subtracted.
pub(super) fn in_order(operands: &[(Operator, ExpressionId)], is_reversed: bool) -> Vec<(Operator, ExpressionId)> {
    let mut operands = operands.to_vec();
    if is_reversed {
        operands.reverse();
    }
    operands
}
