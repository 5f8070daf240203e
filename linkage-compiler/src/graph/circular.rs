//! Normal form of sines and cosines: signs, quarter turns and angles with rational values are evaluated.

use super::arena::Graph;
use super::node::{Node, NodeId};
use super::{Function, Number};

impl Graph {
    /// sin(-x) = -sin x, cos(-x) = cos x, sin(x + pi/2) = cos x, cos(x + pi/2) = -sin x.
    pub(super) fn circular(&mut self, function: Function, angle: NodeId) -> NodeId {
        let (turn, rest) = self.split_pi(angle);
        let quarters = turn.multiply(Number::integer(2)).as_integer();
        let (quarters, rest) = match quarters {
            Some(quarters) => (quarters.rem_euclid(4), rest),
            None => (0, angle),
        };
        let flip = self.leads_negative(rest);
        let rest = if flip { self.negate(rest) } else { rest };
        // cos x = sin(x + pi/2): treat both as a sine plus a number of quarter turns.
        let ahead = quarters + i64::from(function == Function::Cos);
        let (even, sign) = (ahead % 2 == 1, if ahead % 4 >= 2 { -1 } else { 1 });
        let sign = if flip && !even { -sign } else { sign };
        let base = if even { Function::Cos } else { Function::Sin };
        let (turn, pure) = if self.constant_value(rest).is_some() {
            let (turn, remainder) = self.split_pi(rest);
            (turn, self.is_zero(remainder))
        } else {
            (Number::ZERO, false)
        };
        let value = match exact_circular(base, turn, pure) {
            Some(value) => self.number(value),
            None => self.intern(Node::Call(base, vec![rest])),
        };
        self.scale(Number::integer(sign), value)
    }

    /// angle = turn * pi + rest, where `rest` has no term in pi.
    pub(super) fn split_pi(&mut self, angle: NodeId) -> (Number, NodeId) {
        let pi = self.pi();
        let turn = match self.node(angle) {
            Node::Pi => Number::ONE,
            Node::Product { coefficient, factors } if factors.as_slice() == [(pi, 1)] => *coefficient,
            Node::Sum { terms, .. } => {
                terms.iter().find(|(_, term)| *term == pi).map_or(Number::ZERO, |(factor, _)| *factor)
            }
            _ => Number::ZERO,
        };
        if turn.is_zero() {
            return (turn, angle);
        }
        (turn, self.sum(&[(Number::ONE, angle), (turn.negate(), pi)]))
    }
}

/// The rational values of sine and cosine at `turn * pi`, without quarter turns: 0, 1/2 and 1 (Niven's theorem).
fn exact_circular(function: Function, turn: Number, pure: bool) -> Option<Number> {
    if !pure {
        return None;
    }
    let half = Number::ratio(1, 2);
    let table: &[(Number, Number)] = match function {
        Function::Sin => &[
            (Number::ZERO, Number::ZERO),
            (Number::ratio(1, 6), half),
            (Number::ratio(5, 6), half),
            (Number::ratio(7, 6), half.negate()),
            (Number::ratio(11, 6), half.negate()),
        ],
        _ => &[
            (Number::ZERO, Number::ONE),
            (Number::ratio(1, 3), half),
            (Number::ratio(2, 3), half.negate()),
            (Number::ratio(4, 3), half.negate()),
            (Number::ratio(5, 3), half),
        ],
    };
    table.iter().find(|(angle, _)| *angle == turn).map(|(_, value)| *value)
}
