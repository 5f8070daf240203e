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

mod cyclotomic;
mod fraction;
mod independence;
mod normal_form;
mod polynomial;
mod ratio;

use std::fmt;

use linkage_compiler::graph::{Graph, NodeId, Number};

use fraction::Fraction;
use normal_form::NormalForms;

/// The limit of work, in products of terms, so that every comparison ends soon.
pub const MOST_TERMS: usize = 200_000;

/// The highest order of roots of unity: a quarter of a degree.
pub const HIGHEST_ORDER: u32 = 1440;

/// The result of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// Equal wherever both are defined.
    Equal,
    /// Different somewhere, indeed almost everywhere.
    Different,
    /// Not known.
    Undecided(Reason),
}

/// The reason why equality was not decided.
#[derive(Debug, Clone, PartialEq)]
pub enum Reason {
    /// The difference contains a function that is not rational in sines and cosines.
    OutsideClass(&'static str),
    /// The difference contains this user function.
    External(String),
    /// The difference contains the sine or cosine of a quotient of sums.
    AngleIsQuotient,
    /// The difference contains a number that is no exact ratio.
    Inexact(Number),
    /// A denominator is identically zero.
    Undefined,
    /// The difference is zero only if constants such as pi and sin(1) have an unknown relation.
    Constants,
    /// A number is beyond the range of exact ratios, or an angle is too small a part of a turn.
    TooLarge,
    /// More than [`MOST_TERMS`] products of terms.
    TooManyTerms,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cannot decide: ")?;
        match self {
            Self::OutsideClass(name) => write!(f, "`{name}` is not rational in sines and cosines"),
            Self::External(name) => write!(f, "the properties of the function `{name}` are not known"),
            Self::AngleIsQuotient => write!(f, "an angle is a quotient of sums"),
            Self::Inexact(value) => write!(f, "the number {value} is not exact"),
            Self::Undefined => write!(f, "a denominator is identically zero"),
            Self::Constants => write!(f, "constants such as pi and sin(1) may be related"),
            Self::TooLarge => write!(f, "the numbers are too large"),
            Self::TooManyTerms => write!(f, "more than {MOST_TERMS} products of terms"),
        }
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Equal => write!(f, "equal"),
            Self::Different => write!(f, "different"),
            Self::Undecided(reason) => reason.fmt(f),
        }
    }
}

/// The reason why a computation ends early.
#[derive(Debug)]
enum Halt {
    Undecided(Reason),
    /// Roots of unity of this order are needed.
    Order(u32),
}

impl From<Reason> for Halt {
    fn from(reason: Reason) -> Self {
        Self::Undecided(reason)
    }
}

/// A computation that may end early.
type Outcome<T> = Result<T, Halt>;

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
