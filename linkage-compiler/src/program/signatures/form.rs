//! Functions by their result and their visibility.

use crate::program::expression::Type;
use crate::program::function::{Access, Argument, Body, Function};

/// A public function without `Result`.
pub fn total(name: impl Into<String>, arguments: impl IntoIterator<Item = Argument>, returns: Type) -> Function<Body> {
    Function {
        name: name.into(),
        doc: Vec::new(),
        access: Access::Public,
        is_method: true,
        arguments: arguments.into_iter().collect(),
        returns,
        is_fallible: false,
        body: None,
    }
}

/// A function of the trait `Mechanism`.
pub(super) fn of_mechanism(function: Function<Body>) -> Function<Body> {
    Function { access: Access::OfMechanism, ..function }
}

/// A private function that is inlined into functions of scenes.
pub(super) fn layer(function: Function<Body>) -> Function<Body> {
    Function { access: Access::Layer, ..function }
}

/// A public function marked `#[inline]`.
pub(super) fn public_inlined(function: Function<Body>) -> Function<Body> {
    Function { access: Access::PublicInlined, ..function }
}

/// A public function that the runtime calls, through a trait.
pub(super) fn hidden(function: Function<Body>) -> Function<Body> {
    Function { access: Access::Hidden, ..function }
}

/// A private function marked `#[inline]`.
pub(super) fn inlined(function: Function<Body>) -> Function<Body> {
    Function { access: Access::Inlined, ..function }
}

/// A public function that returns a `Result`.
pub fn fallible(
    name: impl Into<String>,
    arguments: impl IntoIterator<Item = Argument>,
    returns: Type,
) -> Function<Body> {
    Function { is_fallible: true, ..total(name, arguments, returns) }
}
