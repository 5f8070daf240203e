//! Functions of numbers: those whose values are rational, or multiples of pi, are evaluated; those without a value are
//! faults.

use super::arena::Graph;
use super::node::{Fault, NodeId};
use super::{Function, Number};

impl Graph {
    /// The value of a function of numbers if it is rational or a multiple of pi.
    ///
    /// The functions are transcendental: exp has a rational value of a rational number at 0 only, and ln at 1; of the
    /// multiples of pi, tan has those of [`tangent`]; the inverse functions have multiples of pi where these do.
    pub(super) fn exact(&mut self, function: Function, arguments: &[NodeId]) -> Option<NodeId> {
        if let (Function::Tan, &[angle]) = (function, arguments) {
            return self.exact_tangent(angle);
        }
        let numbers: Option<Vec<Number>> = arguments.iter().map(|&argument| self.as_number(argument)).collect();
        let numbers = numbers?;
        // A float is rounded already: no function of it is exact.
        if numbers.iter().any(|number| matches!(number, Number::Float(_))) {
            return None;
        }
        let turn = |graph: &mut Self, turn: Number| {
            let pi = graph.pi();
            graph.scale(turn, pi)
        };
        let half = Number::ratio(1, 2);
        match (function, numbers.as_slice()) {
            (Function::Sqrt, &[x]) => square_root(x).map(|root| self.number(root)),
            (Function::Hypot, &[x, y]) if !(x.is_zero() && y.is_zero()) => {
                let square = x.multiply(x).plus(y.multiply(y));
                square_root(square).map(|root| self.number(root))
            }
            (Function::Exp, &[x]) if x.is_zero() => Some(self.one()),
            (Function::Ln, &[x]) if x.is_one() => Some(self.zero()),
            (Function::Asin, &[x]) => inverse_sine(x).map(|angle| turn(self, angle)),
            // acos x = pi/2 - asin x
            (Function::Acos, &[x]) => inverse_sine(x).map(|angle| turn(self, half.plus(angle.negate()))),
            (Function::Atan, &[x]) => eighth_turns(x).map(|angle| turn(self, angle)),
            (Function::Atan2, &[y, x]) => direction(y, x).map(|angle| turn(self, angle)),
            _ => None,
        }
    }

    /// tan(n pi / 4); a pole is a fault.
    fn exact_tangent(&mut self, angle: NodeId) -> Option<NodeId> {
        self.constant_value(angle)?;
        let (turn, rest) = self.split_pi(angle);
        let quarters = turn.multiply(Number::integer(4)).as_integer().filter(|_| self.is_zero(rest))?;
        match quarters.rem_euclid(4) {
            0 => Some(self.zero()),
            1 => Some(self.one()),
            2 => {
                self.fault.get_or_insert(Fault::Undefined(Function::Tan));
                None
            }
            _ => Some(self.number(Number::MINUS_ONE)),
        }
    }
}

/// asin x / pi where it is rational: at 0, 1/2 and 1 (Niven's theorem).
fn inverse_sine(x: Number) -> Option<Number> {
    let sign = if x.is_negative() { Number::MINUS_ONE } else { Number::ONE };
    let turn = match x.absolute() {
        Number::Ratio(0, 1) => Number::ZERO,
        Number::Ratio(1, 2) => Number::ratio(1, 6),
        Number::Ratio(1, 1) => Number::ratio(1, 2),
        _ => return None,
    };
    Some(sign.multiply(turn))
}

/// atan x / pi where it is rational: at 0 and 1.
fn eighth_turns(x: Number) -> Option<Number> {
    match x {
        Number::Ratio(0, 1) => Some(Number::ZERO),
        Number::Ratio(1, 1) => Some(Number::ratio(1, 4)),
        Number::Ratio(-1, 1) => Some(Number::ratio(-1, 4)),
        _ => None,
    }
}

/// atan2(y, x) / pi where it is rational: along the axes and between them. The origin has no direction.
fn direction(y: Number, x: Number) -> Option<Number> {
    let sign = if y.is_negative() { Number::MINUS_ONE } else { Number::ONE };
    let turn = match (y.is_zero(), x.is_zero()) {
        (true, true) => return None,
        (true, false) if x.is_negative() => Number::ONE,
        (true, false) => Number::ZERO,
        (false, true) => Number::ratio(1, 2),
        (false, false) if y.absolute() != x.absolute() => return None,
        (false, false) if x.is_negative() => Number::ratio(3, 4),
        (false, false) => Number::ratio(1, 4),
    };
    Some(sign.multiply(turn))
}

/// The exact square root of a ratio of squares.
fn square_root(value: Number) -> Option<Number> {
    let root = |n: i64| u64::try_from(n).ok().map(u64::isqrt).filter(|r| r * r == n.unsigned_abs());
    match value {
        Number::Ratio(n, d) => Some(Number::ratio(i128::from(root(n)?), i128::from(root(d)?))),
        Number::Float(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exact value of each function agrees with the value that `f64` computes.
    #[test]
    fn exact_values_are_those_of_the_functions() {
        let mut g = Graph::default();
        let numbers = [(0, 1), (1, 2), (-1, 2), (1, 1), (-1, 1), (3, 1), (-3, 1), (4, 1), (9, 4), (1, 3), (-1, 3)];
        let numbers = numbers.map(|(n, d)| g.number(Number::ratio(n, d)));
        let functions = [
            Function::Asin,
            Function::Acos,
            Function::Atan,
            Function::Sqrt,
            Function::Exp,
            Function::Ln,
            Function::Abs,
        ];
        let mut exact = 0;
        for function in functions {
            for argument in numbers {
                let expected = (super::super::operation(function).value)(&[g.constant_value(argument).unwrap()]);
                let found = g.call(function, &[argument]);
                let fault = g.take_fault();
                assert_eq!(fault.is_some(), !expected.is_finite(), "{}", g.text(found));
                exact += usize::from(!matches!(g.node(found), super::super::Node::Call(..)));
                if expected.is_finite() {
                    let error = (g.constant_value(found).unwrap() - expected).abs();
                    assert!(error <= 4.0 * f64::EPSILON * expected.abs(), "{}", g.text(found));
                }
            }
        }
        // 5 of asin and of acos, 3 of atan, 4 of sqrt, 1 of exp, 1 of ln, 11 of abs.
        assert_eq!(exact, 30);
        for y in numbers {
            for x in numbers {
                for function in [Function::Atan2, Function::Hypot] {
                    let values = [y, x].map(|number| g.constant_value(number).unwrap());
                    let expected = (super::super::operation(function).value)(&values);
                    let found = g.call(function, &[y, x]);
                    let error = (g.constant_value(found).unwrap() - expected).abs();
                    assert!(error <= 4.0 * f64::EPSILON * expected.abs(), "{}", g.text(found));
                }
            }
        }
        let [three, four] = [3, 4].map(|n| g.number(Number::integer(n)));
        let five = g.number(Number::integer(5));
        assert_eq!(g.call(Function::Hypot, &[three, four]), five);
        for eighths in -8..=8 {
            let pi = g.pi();
            let angle = g.scale(Number::ratio(eighths, 8), pi);
            let found = g.call(Function::Tan, &[angle]);
            let is_pole = eighths.rem_euclid(8) == 4;
            assert_eq!(g.take_fault(), is_pole.then_some(Fault::Undefined(Function::Tan)), "{eighths}");
            if eighths % 2 == 0 && !is_pole {
                assert!(g.as_number(found).is_some(), "{eighths}");
            }
        }
    }
}
