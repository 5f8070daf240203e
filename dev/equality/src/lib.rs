//! Equality of expressions that are rational in symbols, sines and cosines: a decision, not a guess.
//!
//! Every expression is brought into a normal form in which equal ones have difference zero:
//!
//! - e^(i t) for sines and cosines: sin t = (e^(i t) - e^(-i t)) / 2i, cos t = (e^(i t) + e^(-i t)) / 2,
//!   tan t = sin t / cos t; the addition theorems and sin^2 + cos^2 = 1 become laws of powers
//! - e^(i (p u + q v + r pi)) = (e^(i u))^p (e^(i v))^q zeta^k for rational p, q, r, where u and v are
//!   the power products of the angle multiplied out, and zeta is a root of unity
//! - powers of zeta in the basis that its cyclotomic polynomial leaves
//! - fractions over factored denominators, compared by multiplying with what differs
//!
//! Why a difference that is not zero in this form is not zero at all: by Ax's theorem (the
//! functional case of Schanuel's conjecture, 1971) symbols and the exponentials of power products
//! that are linearly independent over the rationals up to constants are algebraically independent.
//! Among constants the theorem of Lindemann and Weierstrass says the same of e^(i u) for algebraic u,
//! and pi is transcendental; where both meet, only a value that is clearly not zero counts.
//!
//! Any other function is a letter without a law: what is equal for every value of the letter is
//! equal, and of what is not nothing is said. "Equal" means wherever both sides are defined.

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

/// Work is limited to this many products of terms, so that every question is answered soon.
pub const MOST_TERMS: usize = 200_000;

/// Roots of unity of a higher order than this are not computed with: a quarter of a degree.
pub const HIGHEST_ORDER: u32 = 1440;

/// The answer to a question of equality.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// Equal wherever both are defined.
    Equal,
    /// Different somewhere, indeed almost everywhere.
    Different,
    /// Not known.
    Undecided(Reason),
}

/// Why equality was not decided.
#[derive(Debug, Clone, PartialEq)]
pub enum Reason {
    /// The difference holds a function that is not rational in sines and cosines.
    OutsideClass(&'static str),
    /// The difference holds this user function.
    External(String),
    /// The difference holds the sine or cosine of a quotient of sums.
    AngleIsQuotient,
    /// The difference holds a number that is no exact ratio.
    Inexact(Number),
    /// A denominator is zero whatever the symbols are.
    Undefined,
    /// The difference vanishes unless constants such as pi and sin(1) have a relation nobody knows of.
    Constants,
    /// A number left the range of exact ratios, or an angle is too small a part of a turn.
    TooLarge,
    /// More than [`MOST_TERMS`] products of terms.
    TooManyTerms,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cannot decide: ")?;
        match self {
            Self::OutsideClass(name) => write!(f, "`{name}` is not rational in sines and cosines"),
            Self::External(name) => write!(f, "nothing is known of the function `{name}`"),
            Self::AngleIsQuotient => write!(f, "an angle is a quotient of sums"),
            Self::Inexact(value) => write!(f, "the number {value} is not exact"),
            Self::Undefined => write!(f, "a denominator is identically zero"),
            Self::Constants => write!(f, "whether pi and sines of numbers are related is not known"),
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

/// The cause that ends a computation early.
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
    // An expression is equal to itself, however long; it only has to exist.
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

/// Compares a difference of normal forms with zero, with roots of unity of as high an order as it takes.
fn decide(graph: &Graph, roots: &[NodeId], difference: impl Fn(&NormalForms) -> Outcome<Fraction>) -> Answer {
    let mut order = 4;
    loop {
        let answer = NormalForms::new(graph, roots, order)
            .and_then(|forms| Ok(independence::answer(&forms, &difference(&forms)?)));
        match answer {
            Ok(answer) => return answer,
            Err(Halt::Undecided(reason)) => return Answer::Undecided(reason),
            // A proper multiple of the last order, so that this ends.
            Err(Halt::Order(higher)) => order = higher,
        }
    }
}
