//! Printers of a lowered program: as Rust with the user's names and with formulas in doc comments, and as text.
//!
//! A body that computes or decides is planned in [`program`] and printed here. Written by hand are types,
//! signatures, and the conversions and forwards that `tests/bodies_by_hand.rs` lists. Only the constants `DERIVATION`
//! and `SHEET` are made of the derivation; all else is in the program.

mod any_number;
mod conversions;
mod document;
mod drives;

mod external;
mod fpcore;
mod functions;
mod implementations;
mod items;
mod kernels;
mod lanes;
mod names;
mod numbers;
mod printer;
mod reactions;
mod rust;
mod scene;
mod spans;
mod text;
mod types;

use linkage_ir::code::{Code, Names};
use proc_macro2::{Span, TokenStream};
use quote::{quote, quote_spanned};

use crate::derivation::Derivation;
use crate::document::{DriverDocument, SceneDocument, Table};
use crate::model::{Driver, Mechanism, Request, TypeName};
use crate::program::{self, Access, Function, Functions, Implemented, Operations, Program};
use fpcore::Straight;
use kernels::kernels;
use names::string;

pub use rust::tokens as type_tokens;
pub use text::{function_as_text, text};
pub use types::MOST_ARGUMENTS;

/// The declarations of a driver, with the tokens that they are written in: attributes, visibility, paths and places. Printers
/// read them besides its program.
#[derive(Clone, Copy)]
pub struct Declared<'m> {
    pub mechanism: &'m Mechanism,
    pub driver: &'m Driver,
}

/// Emits the items of a mechanism, those of its drivers last; `root` is the path of the `linkage` crate.
#[must_use]
pub fn mechanism(
    mechanism: &Mechanism,
    drivers: impl IntoIterator<Item = TokenStream>,
    root: &TokenStream,
) -> TokenStream {
    let mut tokens = spans::located(types::shared(mechanism, root), spans::of(mechanism.name.span()), 1);
    tokens.extend(drivers);
    items::bearing(tokens, &mechanism.everywhere)
}

/// Emits a stub for a mechanism with mistakes: its types and functions without bodies.
#[must_use]
pub fn stub(mechanism: &Mechanism, root: &TokenStream) -> TokenStream {
    let drivers = mechanism.drivers.iter();
    let drivers = drivers.map(|driver| {
        let program = program::stub(mechanism, driver);
        self::driver(Declared { mechanism, driver }, &program, None, root)
    });
    self::mechanism(mechanism, drivers, root)
}

/// Emits the items of one driver and of its scenes; without a derivation, which only `DERIVATION` and `SHEET` show, a stub.
#[must_use]
pub fn driver(
    of: Declared<'_>,
    program: &Program<Code>,
    derivation: Option<&Derivation>,
    root: &TokenStream,
) -> TokenStream {
    let Declared { mechanism, driver } = of;
    let span = spans::of(driver.name.span());
    let mut tokens = spans::located(types::of_driver(of, program, root), span, 1);
    let mut implemented = TokenStream::new();
    if mechanism.requests.contains(&Request::Lanes) {
        tokens.extend(lanes::columns(of, program));
    }
    for implementation in &program.implementations {
        let first = match implementation.of {
            Implemented::Mechanism => {
                let conversions = conversions::of_driver(of, &program.signatures);
                let error = names::ident("PositionError");
                let functions = program.functions.iter().filter(|function| function.access == Access::OfMechanism);
                let functions =
                    functions.map(|function| functions::function(function, &program.names, &error, None, span));
                Some(quote!(#conversions #(#functions)*))
            }
            Implemented::Lanes => {
                implemented.extend(lanes::batch(of, program));
                Some(lanes::design(of, implementation))
            }
            _ => None,
        };
        implemented.extend(implementations::implementation(implementation, &program.names, &driver.name, first, span));
    }
    implemented.extend(any_number::of_driver(of, program, span));
    let text = "The name of the mechanism in errors.";
    let kinematics = (text, "PositionError");
    let implemented = spans::located(implemented, span, 1);
    let span_of = |function: &Function<Code>| spans::of(mechanism.span_of(driver, &function.name));
    tokens.extend(block(
        (&driver.name, kinematics),
        (&program.functions, &program.names),
        &span_of,
        root,
        &implemented,
    ));
    tokens.extend(external::calls(mechanism, &program.functions, &driver.name, root));
    let straight = mechanism.requests.contains(&Request::Fpcore).then(|| Straight::of_driver(mechanism, program));
    if let Some((derived, derivation)) = program.derived.as_ref().zip(derivation) {
        let kernels = |table: &mut Table| kernels(&program.functions, straight.as_ref(), table);
        let document = crate::document::of_driver(mechanism, driver, derivation, derived, &kernels);
        tokens.extend(document::of_driver(&driver.name, &document, root));
        if mechanism.requests.contains(&Request::Sheet) {
            let sheet = crate::document::of_sheet(mechanism, driver, derivation);
            tokens.extend(document::of_sheet(&driver.name, &sheet, root));
        }
    }
    for (number, scene) in program.scenes.iter().enumerate() {
        let declared = &mechanism.scenes[scene.signatures.id];
        let name = &declared.name;
        let span = spans::of(name.span());
        tokens.extend(spans::located(scene::types(mechanism, &scene.signatures, root), span, 1));
        tokens.extend(drives::types(of, &scene.signatures, root).map(|types| spans::located(types, span, 1)));
        tokens.extend(reactions::types(mechanism, &scene.signatures, root).map(|types| spans::located(types, span, 1)));
        let implemented = scene.implementation.as_ref().map(|implementation| {
            let conversions = conversions::of_scene(of, &scene.signatures);
            implementations::implementation(implementation, &program.names, name, Some(conversions), span)
        });
        let text = "The name of the scene in errors.";
        let implemented = spans::located(implemented.unwrap_or_default(), span, 1);
        tokens.extend(block(
            (name, (text, "MotionError")),
            (&scene.functions, &program.names),
            &|_| span,
            root,
            &implemented,
        ));
        tokens.extend(external::calls(mechanism, &scene.functions, name, root));
        if let Some(derivation) = derivation {
            let derived = (derivation, &derivation.scenes[number]);
            let straight = straight.as_ref().map(|straight| straight.within(scene));
            let kernels = |table: &mut Table| kernels(&scene.functions, straight.as_ref(), table);
            let document = crate::document::of_scene(mechanism, (driver, declared), derived, &kernels);
            tokens.extend(document::of_scene(name, &document, root));
        }
    }
    tokens
}

/// The `impl` block of a type with its functions, and trait implementations that call them, in an anonymous constant.
/// `text` documents `NAME`; `error` is the error type.
fn block(
    (of, (text, error)): (&TypeName, (&str, &str)),
    (functions, names): (&Functions<Code>, &Names),
    span_of: &dyn Fn(&Function<Code>) -> Span,
    root: &TokenStream,
    implemented: &TokenStream,
) -> TokenStream {
    let (error, name) = (names::ident(error), string(&of.to_string()));
    let own = functions.iter().filter(|function| function.access != Access::OfMechanism);
    let functions = own.map(|function| functions::function(function, names, &error, None, span_of(function)));
    let text = names::comment(&format!(" {text}"));
    quote_spanned! {spans::of(of.span())=>
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

/// The documents of a driver and of its scenes, with the formulas of their functions as `derive fpcore` adds them.
#[must_use]
pub fn documents(
    Declared { mechanism, driver }: Declared<'_>,
    program: &Program<Code>,
    derivation: &Derivation,
) -> (Option<DriverDocument>, Vec<SceneDocument>) {
    let straight = Straight::of_driver(mechanism, program);
    let of_driver = program.derived.as_ref().map(|derived| {
        let kernels = |table: &mut Table| kernels(&program.functions, Some(&straight), table);
        crate::document::of_driver(mechanism, driver, derivation, derived, &kernels)
    });
    let scenes = program.scenes.iter().zip(&derivation.scenes).map(|(scene, derived)| {
        let straight = straight.within(scene);
        let kernels = |table: &mut Table| kernels(&scene.functions, Some(&straight), table);
        let of = (driver, &mechanism.scenes[scene.signatures.id]);
        crate::document::of_scene(mechanism, of, (derivation, derived), &kernels)
    });
    (of_driver, scenes.collect())
}

/// The operations of all functions of a driver and of its scenes, each called once.
#[must_use]
pub fn operations(program: &Program<Code>) -> Operations {
    let scenes = program.scenes.iter().flat_map(|scene| scene.functions.iter());
    let bodies = program.functions.iter().chain(scenes).filter_map(|function| function.body.as_ref());
    bodies.fold(Operations::default(), |sum, body| sum.plus(body.readable.operations))
}
