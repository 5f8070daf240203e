//! Statements of compiled code.

use alloc::boxed::Box;
use alloc::vec::Vec;

use super::types::Type;
use crate::{Intrinsic, Name, Slot, ValueId};

/// A statement.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Statement<V = Slot> {
    /// `let pattern = value;`
    Let(Pattern<V>, ValueId),
    /// `value;`
    Do(ValueId),
    /// `place = value;`
    Assign(ValueId, ValueId),
    /// `return value;`
    Return(ValueId),
    /// `let pattern = value else { return otherwise; };`
    LetElse(Pattern<V>, ValueId, ValueId),
    /// `if !(all conditions) { … }`
    Unless(Vec<ValueId>, Vec<Statement<V>>),
    /// Writes a member of the literal that the function returns, as soon as it is known. The literal at the end has it too: a
    /// reader that builds it there, with `Returned::literal`, leaves this out.
    Store(Box<Statement<V>>),
}

/// Statements and a value.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Block<V = Slot> {
    /// The statements.
    pub statements: Vec<Statement<V>>,
    /// The value.
    pub value: ValueId,
}

/// A pattern that binds variables; `F` are the names of fields.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Pattern<V = Slot, F = Name> {
    /// `variable`
    Bound(V),
    /// `mut variable`
    Mutable(V),
    /// `Some(pattern)` or `Ok(pattern)`
    Case(Intrinsic, Box<Pattern<V, F>>),
    /// `variable: Type`
    Typed(V, Type),
    /// `_`
    Ignored,
    /// `[pattern, …]`
    List(Vec<Pattern<V, F>>),
    /// `(pattern, …)`
    Tuple(Vec<Pattern<V, F>>),
    /// `Type { field: pattern, .. }`
    Struct {
        /// The type.
        of: Type,
        /// The fields with their patterns.
        fields: Vec<(F, Pattern<V, F>)>,
        /// True if these are all fields.
        is_whole: bool,
    },
}

impl<V, F> Pattern<V, F> {
    /// A pattern that binds one variable.
    pub fn bound(variable: impl Into<V>) -> Self {
        Self::Bound(variable.into())
    }

    /// `variable: Type`
    pub fn typed(variable: impl Into<V>, of: Type) -> Self {
        Self::Typed(variable.into(), of)
    }

    /// Visits every variable that the pattern binds.
    pub fn each<'p>(&'p self, visit: &mut dyn FnMut(&'p V)) {
        match self {
            Self::Bound(variable) | Self::Mutable(variable) | Self::Typed(variable, _) => visit(variable),
            Self::Case(_, inside) => inside.each(visit),
            Self::List(all) | Self::Tuple(all) => all.iter().for_each(|pattern| pattern.each(visit)),
            Self::Struct { fields, .. } => fields.iter().for_each(|(_, pattern)| pattern.each(visit)),
            Self::Ignored => {}
        }
    }

    /// The pattern with other variables and other names of fields.
    pub fn map<W, G>(self, to: &mut dyn FnMut(V) -> W, named: &mut dyn FnMut(F) -> G) -> Pattern<W, G> {
        match self {
            Self::Bound(variable) => Pattern::Bound(to(variable)),
            Self::Mutable(variable) => Pattern::Mutable(to(variable)),
            Self::Typed(variable, of) => Pattern::Typed(to(variable), of),
            Self::Case(case, inside) => Pattern::Case(case, Box::new(inside.map(to, named))),
            Self::List(all) => Pattern::List(all.into_iter().map(|pattern| pattern.map(to, named)).collect()),
            Self::Tuple(all) => Pattern::Tuple(all.into_iter().map(|pattern| pattern.map(to, named)).collect()),
            Self::Struct { of, fields, is_whole } => {
                let fields = fields.into_iter().map(|(field, pattern)| (named(field), pattern.map(to, named)));
                Pattern::Struct { of, fields: fields.collect(), is_whole }
            }
            Self::Ignored => Pattern::Ignored,
        }
    }
}

impl<V> Block<V> {
    /// Visits the values that its statements read or write, and its value.
    pub fn each_value(&self, visit: &mut dyn FnMut(ValueId)) {
        self.statements.iter().for_each(|statement| statement.each_value(visit));
        visit(self.value);
    }
}

impl<V> Statement<V> {
    /// Visits the values that it reads or writes, also within others.
    pub fn each_value(&self, visit: &mut dyn FnMut(ValueId)) {
        match self {
            Self::Let(_, value) | Self::Do(value) | Self::Return(value) => visit(*value),
            Self::Assign(one, other) | Self::LetElse(_, one, other) => {
                visit(*one);
                visit(*other);
            }
            Self::Store(inside) => inside.each_value(visit),
            Self::Unless(conditions, inside) => {
                conditions.iter().for_each(|condition| visit(*condition));
                inside.iter().for_each(|statement| statement.each_value(visit));
            }
        }
    }

    /// The pattern that the statement binds.
    pub fn pattern(&self) -> Option<&Pattern<V>> {
        match self {
            Self::Let(pattern, _) | Self::LetElse(pattern, ..) => Some(pattern),
            Self::Store(inside) => inside.pattern(),
            _ => None,
        }
    }
}
