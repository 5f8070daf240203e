//! A kernel as statements and results.

use std::collections::BTreeSet;

use super::rounding::Bound;
use super::schedule::Schedule;
use crate::graph::ExternalId;
use crate::ids::BlockId;
use crate::program::{Expression, Statement, Taken};

/// A lowered kernel.
pub(super) struct Formulas<'a> {
    pub(super) statements: Vec<Statement>,
    pub(super) results: Vec<Expression>,
    /// For each result, true if it needs no check: it is finite if the checks before it pass, or need not be finite.
    pub(super) is_proven: Vec<bool>,
    pub(super) dyads: Vec<Option<BlockId>>,
    /// The names of the flags that are true if the triangle of a dyad is well conditioned.
    pub(super) well_conditioned: Vec<String>,
    /// The names of the factorisations that solve groups.
    pub(super) factors: Vec<String>,
    /// The checks of a kernel that only flags failed ones.
    pub(super) flags: Vec<Expression>,
    pub(super) is_branch_free: bool,
    pub(super) bound: Option<Bound>,
    pub(super) taken: Taken<'a>,
    pub(super) externals: BTreeSet<ExternalId>,
    /// The lines of the kernel, if there is one.
    pub(super) schedule: Option<Schedule>,
}

impl<'a> Formulas<'a> {
    /// No formulas, for a function without kernel.
    pub(super) fn none(reserved: &'a BTreeSet<String>) -> Self {
        Self {
            statements: Vec::new(),
            results: Vec::new(),
            is_proven: Vec::new(),
            dyads: Vec::new(),
            well_conditioned: Vec::new(),
            factors: Vec::new(),
            flags: Vec::new(),
            is_branch_free: true,
            bound: None,
            taken: Taken::new(reserved),
            externals: BTreeSet::new(),
            schedule: None,
        }
    }
}

/// True if a value is neither a name nor zero nor one.
pub(super) fn is_formula(value: &Expression) -> bool {
    match value {
        Expression::Name(_) => false,
        Expression::Number(number) => !number.is_zero() && !number.is_one(),
        _ => true,
    }
}
