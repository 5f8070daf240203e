//! Rust that could have been written by hand: the user's names, the formula in the doc comment.

mod document;
mod expression;
mod items;
mod kernel;
mod methods;
mod names;
mod pose;
mod scene;
mod tokens;
mod types;

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::derivation::Derivation;
use crate::lower::Operations;
use crate::model::{Driver, Mechanism};

/// The names of the types of one driver of a mechanism.
struct Types {
    /// The type that the functions belong to.
    driver: Ident,
    inputs: Ident,
    unknowns: Ident,
    pose: Ident,
    coordinates: Ident,
    points: Ident,
    outputs: Ident,
    motion: Ident,
    branch: Ident,
    /// The traits of plain data, as an attribute.
    derives: TokenStream,
}

impl Types {
    fn new(mechanism: &Mechanism, driver: &Driver, derives: &TokenStream) -> Self {
        // Types keep their place in the user's source but resolve where the macro is called.
        let named = |stem: &Ident, suffix: &str| {
            let mut ident = format_ident!("{stem}{suffix}");
            ident.set_span(Span::call_site());
            ident
        };
        let (own, shared) = (&driver.name, &mechanism.name);
        Self {
            driver: own.clone(),
            inputs: named(own, "Inputs"),
            unknowns: named(own, "Unknowns"),
            pose: named(own, "Pose"),
            coordinates: named(shared, "Coordinates"),
            points: named(shared, "Points"),
            outputs: named(shared, "Outputs"),
            motion: named(own, "Motion"),
            branch: named(own, "Branch"),
            derives: derives.clone(),
        }
    }
}

/// What is emitted, and how much work its functions are, each called once.
#[derive(Debug, Clone, Default)]
pub struct Emitted {
    pub tokens: TokenStream,
    pub operations: Operations,
}

/// A mechanism for which only the right names and types are emitted.
#[must_use]
pub fn stub(mechanism: &Mechanism, root: &TokenStream) -> TokenStream {
    let drivers = mechanism.drivers.iter().map(|driver| self::driver(mechanism, driver, None, root).tokens);
    let tokens = std::iter::once(shared(mechanism, root)).chain(drivers);
    items::bearing(tokens.collect(), &mechanism.everywhere)
}

/// The items that all drivers of a mechanism share, and `drivers`, which are emitted already.
#[must_use]
pub fn mechanism(mechanism: &Mechanism, drivers: Emitted, root: &TokenStream) -> Emitted {
    let mut tokens = shared(mechanism, root);
    tokens.extend(drivers.tokens);
    Emitted { tokens: items::bearing(tokens, &mechanism.everywhere), ..drivers }
}

fn shared(mechanism: &Mechanism, root: &TokenStream) -> TokenStream {
    types::shared(mechanism, &types::derives(), &quote!(#root::__private))
}

/// Everything emitted for one driver of a mechanism and its scenes; without a derivation a stub that only has the
/// right names and types. `root` is the path of the `linkage` crate.
#[must_use]
pub fn driver(
    mechanism: &Mechanism,
    driver: &Driver,
    mut derivation: Option<&mut Derivation>,
    root: &TokenStream,
) -> Emitted {
    let private = quote!(#root::__private);
    let derives = types::derives();
    let names = Types::new(mechanism, driver, &derives);
    let plan = derivation
        .as_deref_mut()
        .map(|derivation| pose::PosePlan::new(derivation, methods::argument(mechanism, "pose")));
    let mut tokens = types::of_driver(mechanism, driver, &names, plan.as_ref(), derivation.as_deref(), &private);
    let emitted = methods::of_driver(mechanism, driver, &names, plan.as_ref(), derivation.as_deref_mut(), &private);
    tokens.extend(emitted.tokens);
    let mut operations = emitted.operations;
    let scenes = mechanism.scenes.iter().filter(|scene| mechanism.drivers[scene.driver].name == driver.name);
    for (number, scene) in scenes.enumerate() {
        if mechanism.graph.budget().is_spent() && derivation.is_some() {
            break;
        }
        let names = Types { driver: scene.name.clone(), ..Types::new(mechanism, driver, &derives) };
        tokens.extend(scene::types(mechanism, driver, scene, &private));
        let emitted = methods::of_scene(
            mechanism,
            (driver, scene, number),
            &names,
            plan.as_ref().zip(derivation.as_deref_mut()),
            &private,
        );
        tokens.extend(emitted.tokens);
        operations = operations.plus(emitted.operations);
    }
    Emitted { tokens, operations }
}
