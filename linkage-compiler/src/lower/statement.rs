//! Statements of lowered code.

use super::id::ValueId;
use crate::program;

/// A statement of lowered code.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Statement {
    /// `let pattern = value;`
    Let(Pattern, ValueId),
    /// `value;`
    Do(ValueId),
    /// `place = value;`
    Assign(ValueId, ValueId),
    /// `return value;`
    Return(ValueId),
    /// `let pattern = value else { return otherwise; };`
    LetElse(Pattern, ValueId, ValueId),
    /// `if !(all conditions) { … }`
    Unless(Vec<ValueId>, Vec<Statement>),
}

/// A pattern that binds values. One that binds the value of its own statement gives it a name.
pub type Pattern = program::Pattern<ValueId>;

/// Statements and a value.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Block {
    pub statements: Vec<Statement>,
    pub value: ValueId,
}

impl Statement {
    /// The pattern that the statement binds.
    pub(super) fn pattern(&self) -> Option<&Pattern> {
        match self {
            Self::Let(pattern, _) | Self::LetElse(pattern, ..) => Some(pattern),
            _ => None,
        }
    }

    /// The values that the statement binds.
    pub(super) fn bound(&self) -> Vec<ValueId> {
        let mut bound = Vec::new();
        if let Some(pattern) = self.pattern() {
            pattern.each(&mut |value| bound.push(*value));
        }
        bound
    }
}
