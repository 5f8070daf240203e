//! Printers of a lowered program: as Rust with the user's names and with formulas in doc comments, and as text.
//!
//! A body that computes or decides is planned in [`program`](crate::program) and printed here. Written by hand are types,
//! signatures, and the conversions and forwards that `tests/bodies_by_hand.rs` lists. Only the constant `DERIVATION` is
//! made of the derivation; all else is in the program.

mod any_number;
mod conversions;
mod document;
mod drives;
mod expression;
mod external;
mod fpcore;
mod functions;
mod implementations;
mod items;
mod lanes;
mod names;
mod places;
mod reactions;
mod scene;
mod scene_document;
mod text;
mod types;
mod work;

use proc_macro2::{Span, TokenStream};
use quote::quote_spanned;

use crate::derivation::Derivation;
use crate::lower::Code;
use crate::model::{Mechanism, Request, TypeName};
use crate::program::{self, Function, Implemented, Operations, Program};
use fpcore::Straight;
use names::string;
pub use text::text;
use work::{Work, works};

/// Emits the items of a mechanism, those of its drivers last; `root` is the path of the `linkage` crate.
#[must_use]
pub fn mechanism(
    mechanism: &Mechanism,
    drivers: impl IntoIterator<Item = TokenStream>,
    root: &TokenStream,
) -> TokenStream {
    let mut tokens = places::located(types::shared(mechanism, root), places::of(mechanism.name.span()), 1);
    tokens.extend(drivers);
    items::bearing(tokens, &mechanism.everywhere)
}

/// Emits a stub for a mechanism with mistakes: its types and functions without bodies.
#[must_use]
pub fn stub(mechanism: &Mechanism, root: &TokenStream) -> TokenStream {
    let drivers = mechanism.drivers.iter();
    let drivers = drivers.map(|driver| self::driver(&program::stub(mechanism, driver), None, root));
    self::mechanism(mechanism, drivers, root)
}

/// Emits the items of one driver and of its scenes; without a derivation, which only `DERIVATION` shows, a stub.
#[must_use]
pub fn driver(program: &Program<Code>, derivation: Option<&Derivation>, root: &TokenStream) -> TokenStream {
    let (mechanism, driver) = (program.signatures.mechanism, program.signatures.driver);
    let place = places::of(driver.name.span());
    let mut tokens = places::located(types::of_driver(program, root), place, 1);
    let mut implemented = TokenStream::new();
    if mechanism.requests.contains(&Request::Lanes) {
        tokens.extend(lanes::columns(program));
    }
    for implementation in &program.implementations {
        let conversions = match implementation.of {
            Implemented::Mechanism => Some(conversions::of_driver(&program.signatures)),
            Implemented::Lanes => {
                implemented.extend(lanes::batch(program));
                Some(lanes::design(program, implementation))
            }
            _ => None,
        };
        implemented.extend(implementations::implementation(implementation, &driver.name, conversions, place));
    }
    implemented.extend(any_number::of_driver(program, place));
    let text = "The name of the mechanism in errors.";
    let kinematics = (text, "PositionError");
    let implemented = places::located(implemented, place, 1);
    let place_of = |function: &Function<Code>| places::of(mechanism.place_of(driver, &function.name));
    tokens.extend(block(&driver.name, kinematics, &program.functions, &place_of, root, &implemented));
    tokens.extend(external::calls(mechanism, &program.functions, &driver.name, root));
    let straight = mechanism.requests.contains(&Request::Fpcore).then(|| Straight::of_driver(program));
    if let Some((derived, derivation)) = program.derived.as_ref().zip(derivation) {
        let works = works(&program.functions, straight.as_ref());
        tokens.extend(document::constant(mechanism, driver, derivation, derived, &works, root));
    }
    for (number, scene) in program.scenes.iter().enumerate() {
        let name = &scene.signatures.scene.name;
        let place = places::of(name.span());
        tokens.extend(places::located(scene::types(&scene.signatures, root), place, 1));
        tokens.extend(drives::types(&scene.signatures, driver, root).map(|types| places::located(types, place, 1)));
        tokens.extend(reactions::types(&scene.signatures, root).map(|types| places::located(types, place, 1)));
        let implemented = scene.implementation.as_ref().map(|implementation| {
            let conversions = conversions::of_scene(&scene.signatures, driver);
            implementations::implementation(implementation, name, Some(conversions), place)
        });
        let text = "The name of the scene in errors.";
        let implemented = places::located(implemented.unwrap_or_default(), place, 1);
        tokens.extend(block(name, (text, "MotionError"), &scene.functions, &|_| place, root, &implemented));
        tokens.extend(external::calls(mechanism, &scene.functions, name, root));
        if let Some(derivation) = derivation {
            let derived = (derivation, &derivation.scenes[number]);
            let straight = straight.as_ref().map(|straight| straight.within(scene));
            let works = works(&scene.functions, straight.as_ref());
            tokens.extend(scene_document::of_scene(mechanism, (driver, scene.signatures.scene), derived, &works, root));
        }
    }
    tokens
}

/// The `impl` block of a type with its functions, and trait implementations that call them, in an anonymous constant.
/// `text` documents `NAME`; `error` is the error type.
fn block(
    of: &TypeName,
    (text, error): (&str, &str),
    functions: &[Function<Code>],
    place_of: &dyn Fn(&Function<Code>) -> Span,
    root: &TokenStream,
    implemented: &TokenStream,
) -> TokenStream {
    let (error, name) = (names::ident(error), string(&of.to_string()));
    let functions = functions.iter().map(|function| functions::function(function, &error, None, place_of(function)));
    let text = names::comment(&format!(" {text}"));
    quote_spanned! {places::of(of.span())=>
        const _: () = {
            use #root::__rt::{self, prelude::*};
            impl<T: __rt::Real> #of<T> {
                #[doc = #text]
                pub const NAME: &'static str = #name;
                #(#functions)*
            }
            #implemented
        };
    }
}

/// The functions of a driver and of its scenes that have formulas: the type, the function and its lines.
#[must_use]
pub fn formulas(program: &Program<Code>) -> Vec<[String; 3]> {
    let straight = Straight::of_driver(program);
    let of_driver = (program.signatures.driver.name.to_string(), works(&program.functions, Some(&straight)));
    let of_scenes = program.scenes.iter().map(|scene| {
        let works = works(&scene.functions, Some(&straight.within(scene)));
        (scene.signatures.scene.name.to_string(), works)
    });
    let all = std::iter::once(of_driver).chain(of_scenes);
    let formulas = all.flat_map(|(of, works)| {
        works.into_iter().map(move |Work { function, lines, .. }| [of.clone(), function, lines])
    });
    formulas.filter(|[.., lines]| !lines.is_empty()).collect()
}

/// The operations of all functions of a driver and of its scenes, each called once.
#[must_use]
pub fn operations(program: &Program<Code>) -> Operations {
    let scenes = program.scenes.iter().flat_map(|scene| &scene.functions);
    let bodies = program.functions.iter().chain(scenes).filter_map(|function| function.body.as_ref());
    bodies.fold(Operations::default(), |sum, body| sum.plus(body.operations))
}
