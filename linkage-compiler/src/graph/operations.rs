//! The operation table: value, derivatives and exceptional places of each elementary function.

use std::f64::consts::FRAC_PI_2;

use linkage_ir::ElementaryFunction as Function;

use super::Number;
use super::arena::Graph;
use super::node::{Node, NodeId};

/// The partial derivatives of `f` at `arguments`, one for each; `value` is `f(arguments)`.
type Partials = fn(graph: &mut Graph, arguments: &[NodeId], value: NodeId) -> Vec<NodeId>;

/// The expressions of the arguments at whose zeros the function has a kink or a jump, while they change their sign.
type Kinks = fn(graph: &Graph, arguments: &[NodeId]) -> Vec<NodeId>;

/// The behaviour of a function at a place where it is not smooth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exception {
    /// It jumps.
    Cut,
    /// It has no bounds.
    Pole,
    /// It is continuous, and its derivative jumps.
    Kink,
    /// Its domain ends: beyond it the function is undefined.
    Edge,
}

/// A point of the arguments where a function is not smooth, and a direction across it, out of the domain at its edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    pub exception: Exception,
    pub at: &'static [f64],
    pub across: &'static [f64],
}

/// A place of a function of one argument.
const fn place(exception: Exception, at: &'static [f64; 1], across: &'static [f64; 1]) -> Place {
    Place { exception, at, across }
}

/// The edges of the domain from -1 to 1.
const SINES: &[Place] = &[place(Exception::Edge, &[1.0], &[1.0]), place(Exception::Edge, &[-1.0], &[-1.0])];

/// One row of the operation table.
pub struct Operation {
    pub function: Function,
    /// The value at as many numbers as it has arguments, with the same bits on every host: constants of emitted code are such values.
    pub value: fn(&[f64]) -> f64,
    pub partials: Partials,
    /// The cuts, poles, kinks and edges of the domain, a place of each kind; of those that repeat, one. A function
    /// without a place is smooth at all finite arguments.
    pub places: &'static [Place],
    pub kinks: Kinks,
}

/// The table, in the order of [`Function`].
pub const OPERATIONS: [Operation; 13] = [
    Operation {
        function: Function::Sin,
        value: |x| libm::sin(x[0]),
        // d sin x = cos x
        partials: |g, x, _| vec![g.call(Function::Cos, &[x[0]])],
        places: &[],
        kinks: none,
    },
    Operation {
        function: Function::Cos,
        value: |x| libm::cos(x[0]),
        // d cos x = -sin x
        partials: |g, x, _| {
            let sine = g.call(Function::Sin, &[x[0]]);
            vec![g.negate(sine)]
        },
        places: &[],
        kinks: none,
    },
    Operation {
        function: Function::Tan,
        value: |x| libm::tan(x[0]),
        // d tan x = 1 + tan^2 x
        partials: |g, _, tan| {
            let square = g.power(tan, 2);
            let one = g.one();
            vec![g.add(one, square)]
        },
        places: &[place(Exception::Pole, &[FRAC_PI_2], &[1.0])],
        kinks: none,
    },
    Operation {
        function: Function::Asin,
        value: |x| libm::asin(x[0]),
        // d asin x = 1 / sqrt((1 - x)(1 + x))
        partials: |g, x, _| vec![inverse_half_chord(g, x[0])],
        places: SINES,
        kinks: none,
    },
    Operation {
        function: Function::Acos,
        value: |x| libm::acos(x[0]),
        // d acos x = -1 / sqrt((1 - x)(1 + x))
        partials: |g, x, _| {
            let inverse = inverse_half_chord(g, x[0]);
            vec![g.negate(inverse)]
        },
        places: SINES,
        kinks: none,
    },
    Operation {
        function: Function::Atan,
        value: |x| libm::atan(x[0]),
        // d atan x = 1 / (1 + x^2)
        partials: |g, x, _| {
            let square = g.power(x[0], 2);
            let one = g.one();
            let sum = g.add(one, square);
            vec![g.power(sum, -1)]
        },
        places: &[],
        kinks: none,
    },
    Operation {
        function: Function::Atan2,
        value: |x| libm::atan2(x[0], x[1]),
        // d atan2(y, x) = (x dy - y dx) / (x^2 + y^2)
        partials: |g, yx, _| {
            let (y2, x2) = (g.power(yx[0], 2), g.power(yx[1], 2));
            let square = g.add(y2, x2);
            let by_y = g.divide(yx[1], square);
            let by_x = g.divide(yx[0], square);
            vec![by_y, g.negate(by_x)]
        },
        places: &[
            Place { exception: Exception::Cut, at: &[0.0, -1.0], across: &[1.0, 0.0] },
            Place { exception: Exception::Cut, at: &[0.0, 0.0], across: &[1.0, 0.5] },
        ],
        // A jump by 2 pi at y = 0, x < 0.
        kinks: |_, yx| vec![yx[0]],
    },
    Operation {
        function: Function::Sqrt,
        value: |x| x[0].sqrt(),
        // d sqrt x = 1 / (2 sqrt x)
        partials: |g, _, root| {
            let inverse = g.power(root, -1);
            vec![g.scale(Number::ratio(1, 2), inverse)]
        },
        places: &[place(Exception::Edge, &[0.0], &[-1.0])],
        kinks: |g, x| squared(g, x[0]),
    },
    Operation {
        function: Function::Abs,
        value: |x| x[0].abs(),
        // d |x| = x / |x|, undefined at 0
        partials: |g, x, modulus| vec![g.divide(x[0], modulus)],
        places: &[place(Exception::Kink, &[0.0], &[1.0])],
        kinks: |_, x| vec![x[0]],
    },
    Operation {
        function: Function::Exp,
        value: |x| libm::exp(x[0]),
        // d e^x = e^x
        partials: |_, _, value| vec![value],
        places: &[],
        kinks: none,
    },
    Operation {
        function: Function::Ln,
        value: |x| libm::log(x[0]),
        // d ln x = 1 / x
        partials: |g, x, _| vec![g.power(x[0], -1)],
        places: &[place(Exception::Pole, &[0.0], &[-1.0]), place(Exception::Edge, &[0.0], &[-1.0])],
        kinks: none,
    },
    Operation {
        function: Function::Hypot,
        value: |x| libm::hypot(x[0], x[1]),
        // d hypot(x, y) = (x dx + y dy) / hypot(x, y)
        partials: |g, xy, modulus| vec![g.divide(xy[0], modulus), g.divide(xy[1], modulus)],
        places: &[Place { exception: Exception::Kink, at: &[0.0, 0.0], across: &[1.0, 2.0] }],
        // With one argument it is the modulus of the other. Elsewhere a motion passes x = y = 0 by chance only.
        kinks: |g, xy| match xy.iter().filter(|&&x| !g.is_zero(x)).collect::<Vec<_>>().as_slice() {
            &[&x] => vec![x],
            _ => Vec::new(),
        },
    },
    Operation {
        function: Function::IfNonzero,
        value: |x| if x[0] == 0.0 { x[2] } else { x[1] },
        // d if_nonzero(a, v, w) = dv if a moves; `differentiate` has the other case.
        partials: |g, _, _| vec![g.zero(), g.one(), g.zero()],
        places: &[],
        kinks: none,
    },
];

/// The rows of the functions of the language.
pub fn written() -> impl Iterator<Item = &'static Operation> {
    OPERATIONS.iter().filter(|row| row.function != Function::IfNonzero)
}

impl Operation {
    /// True if it is undefined at some finite arguments.
    #[must_use]
    pub fn may_be_undefined(&self) -> bool {
        self.places.iter().any(|place| matches!(place.exception, Exception::Pole | Exception::Edge))
    }
}

/// The row of a function.
#[must_use]
pub fn operation(of: Function) -> &'static Operation {
    &OPERATIONS[of as usize]
}

/// The function has no kink inside its domain.
fn none(_: &Graph, _: &[NodeId]) -> Vec<NodeId> {
    Vec::new()
}

/// The bases b of the factors b^2, b^6, ...: sqrt(b^2) = |b|.
fn squared(g: &Graph, x: NodeId) -> Vec<NodeId> {
    match g.node(x) {
        Node::Product { factors, .. } => {
            factors.iter().filter(|(_, exponent)| exponent.rem_euclid(4) == 2).map(|(base, _)| *base).collect()
        }
        _ => Vec::new(),
    }
}

/// 1 / sqrt((1 - x)(1 + x)); the factored form avoids cancellation near |x| = 1.
fn inverse_half_chord(g: &mut Graph, x: NodeId) -> NodeId {
    let one = g.one();
    let below = g.subtract(one, x);
    let above = g.add(one, x);
    let product = g.multiply(below, above);
    let chord = g.call(Function::Sqrt, &[product]);
    g.power(chord, -1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stand_in_the_order_of_the_enum() {
        assert!(OPERATIONS.iter().map(|row| row.function).eq(Function::ALL.iter().copied()));
    }
}
