//! Decides the equality of expressions that are rational in symbols, sines and cosines.
//!
//! Every expression is brought into a normal form in which the difference of equal ones is zero:
//!
//! - e^(i t) for sines and cosines: sin t = (e^(i t) - e^(-i t)) / 2i, cos t = (e^(i t) + e^(-i t)) / 2,
//!   tan t = sin t / cos t; the addition theorems and sin^2 + cos^2 = 1 become laws of powers
//! - e^(i (p u + q v + r pi)) = (e^(i u))^p (e^(i v))^q zeta^k for rational p, q, r, where u and v are
//!   the power products of the angle multiplied out, and zeta is a root of unity
//! - powers of zeta in the basis given by its cyclotomic polynomial
//! - fractions over factored denominators, compared by multiplying with the factors that differ
//!
//! A difference that is not zero in this form is not zero at all: by Ax's theorem (the functional case of Schanuel's
//! conjecture, 1971) symbols and the exponentials of power products that are linearly independent over the rationals up
//! to constants are algebraically independent. Among constants the theorem of Lindemann and Weierstrass says the same
//! of e^(i u) for algebraic u, and pi is transcendental; where a constant contains both, the difference must be far
//! from zero numerically.
//!
//! Any other function is treated as a free variable: expressions that are equal for every value of it are equal, the
//! others are undecided. "Equal" means wherever both sides are defined.

mod answer;
mod constants;
mod cyclotomic;
mod fraction;
mod independence;
mod normal_form;
mod polynomial;
mod ratio;

pub use answer::{Answer, HIGHEST_ORDER, MOST_TERMS, Reason};

use linkage_compiler::graph::{Graph, NodeId};

use answer::{Halt, Outcome};
use fraction::Fraction;
use normal_form::NormalForms;

/// Compares two expressions wherever both are defined.
#[must_use]
pub fn compare(graph: &Graph, a: NodeId, b: NodeId) -> Answer {
    let answer = decide(graph, &[a, b], |forms| forms.of(a).minus(&forms.ring, &forms.of(b)));
    // An expression is equal to itself, even if it is too long to compare; it only has to be defined.
    match answer {
        Answer::Undecided(Reason::Undefined) | Answer::Equal => answer,
        _ if a == b => Answer::Equal,
        _ => answer,
    }
}

/// Compares an expression with zero wherever it is defined.
#[must_use]
pub fn is_zero(graph: &Graph, id: NodeId) -> Answer {
    decide(graph, &[id], |forms| Ok(forms.of(id)))
}

/// Compares a difference of normal forms with zero, with roots of unity of the order that it needs.
fn decide(graph: &Graph, roots: &[NodeId], difference: impl Fn(&NormalForms) -> Outcome<Fraction>) -> Answer {
    let mut order = 4;
    loop {
        let answer = NormalForms::new(graph, roots, order)
            .and_then(|forms| Ok(independence::answer(&forms, &difference(&forms)?)));
        match answer {
            Ok(answer) => return answer,
            Err(Halt::Undecided(reason)) => return Answer::Undecided(reason),
            // A proper multiple of the last order, so the loop ends.
            Err(Halt::Order(higher)) => order = higher,
        }
    }
}
