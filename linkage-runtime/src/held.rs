//! The mechanism or the scene that a motion borrows, owns or shares.

use core::ops::Deref;
#[cfg(feature = "std")]
use std::sync::Arc;

use crate::Mechanism;

/// A mechanism or a scene that is borrowed, owned or shared.
///
/// A path, a motion or a simulation holds what it follows in this way. Its lifetime is that of the reference; if nothing is
/// borrowed, it may be `'static`.
#[derive(Debug, Clone)]
pub enum Held<'a, M> {
    /// A reference to it.
    Borrowed(&'a M),
    /// Itself.
    Owned(M),
    /// One that others hold too.
    #[cfg(feature = "std")]
    Shared(Arc<M>),
}

impl<M> Deref for Held<'_, M> {
    type Target = M;

    #[inline]
    fn deref(&self) -> &M {
        match self {
            Self::Borrowed(held) => held,
            Self::Owned(held) => held,
            #[cfg(feature = "std")]
            Self::Shared(held) => held,
        }
    }
}

/// The mechanism that a path or a motion is to hold: `&m`, `m`, or an `Arc` of it.
///
/// `By` distinguishes them and is always inferred.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a mechanism",
    note = "pass `&m`, `m` or an `Arc` of a mechanism; a scene has its mechanism in the field `mechanism`"
)]
pub trait IntoHeld<'a, By> {
    /// The mechanism.
    type Of;

    /// Holds it.
    fn into_held(self) -> Held<'a, Self::Of>;
}

/// A value, which is held itself.
#[derive(Debug)]
pub enum ByValue {}

/// A reference or an `Arc`.
#[derive(Debug)]
pub enum ByPointer {}

impl<'a, M: Mechanism> IntoHeld<'a, ByValue> for M {
    type Of = M;

    #[inline]
    fn into_held(self) -> Held<'a, M> {
        Held::Owned(self)
    }
}

impl<'a, M> IntoHeld<'a, ByPointer> for &'a M {
    type Of = M;

    #[inline]
    fn into_held(self) -> Held<'a, M> {
        Held::Borrowed(self)
    }
}

#[cfg(feature = "std")]
impl<'a, M> IntoHeld<'a, ByPointer> for Arc<M> {
    type Of = M;

    #[inline]
    fn into_held(self) -> Held<'a, M> {
        Held::Shared(self)
    }
}
