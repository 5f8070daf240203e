//! The names in errors, borrowed: the machine owns those of its errors.

use std::collections::BTreeSet;

use linkage_ir::code::Value;

use crate::program::Driver;

/// The names that functions of the runtime give themselves, of those that compiled code calls.
const OF_THE_RUNTIME: &[&str] = &[
    "the position",
    "the guess",
    "the guess of an angle",
    "the Jacobian",
    "the residual",
    "the determinant",
    "motion",
    "a length of the loops",
    "the direction of a guide",
    "the restitution",
    "the mass matrix",
    "the stiffness",
];

/// All texts of a mechanism.
#[derive(Debug)]
pub(crate) struct Texts<'d>(BTreeSet<&'d str>);

impl<'d> Texts<'d> {
    pub(crate) fn of(driver: &'d Driver) -> Self {
        let scenes = driver.scenes.iter();
        let of_scenes = scenes.clone().flat_map(|scene| &scene.functions);
        let of_traits = driver.traits.iter().chain(scenes.clone().filter_map(|scene| scene.implementation.as_ref()));
        let functions = driver.functions.iter().chain(of_traits.flat_map(|one| &one.functions)).chain(of_scenes);
        let texts =
            functions.flat_map(|function| &function.body).flat_map(|code| &code.values).filter_map(
                |value| match value {
                    Value::Text(text) => Some(&**text),
                    _ => None,
                },
            );
        let names = [&*driver.name].into_iter().chain(scenes.map(|scene| &*scene.name));
        let inputs = driver.input_texts.iter().map(|name| &**name);
        Self(texts.chain(names).chain(inputs).chain(OF_THE_RUNTIME.iter().copied()).collect())
    }

    /// The text of an error, borrowed.
    pub(crate) fn find(&self, name: &str) -> &'d str {
        self.0.get(name).copied().unwrap_or("a number")
    }
}
