//! The compiler behind `linkage!`: tokens in, tokens out.
//!
//! [`expand`] runs all stages. Each depends only on stages before it: syntax (parser), graph (expressions), algebra
//! (simplification), structure (order of solution), model (name resolution and checks), derivation (mathematics), program
//! (the functions to emit), lower (common subexpressions, order, names), document (formulas for readers), emit
//! (printers).

pub mod algebra;
pub mod budget;
mod clash;
pub mod derivation;
pub mod diagnostics;
pub mod document;
pub mod emit;
pub mod graph;
pub mod ids;
pub mod lower;
pub mod model;
pub mod program;
pub mod structure;
pub mod syntax;

use std::collections::BTreeMap;

use proc_macro2::TokenStream;
use quote::quote;

use budget::Budget;
use derivation::Derivation;
use diagnostics::Diagnostics;
use document::{Document, SceneDocument};
use model::{Mechanism, Request};
use program::Operations;

/// Expands the body of one `linkage!` invocation; `root` is the path of the `linkage` crate.
///
/// Mistakes become `compile_error!`s on their tokens. Stubs with the intended names and types come with them, so that
/// uses of the mechanism cause no further errors.
#[must_use]
pub fn expand(input: TokenStream, root: &TokenStream) -> TokenStream {
    expand_within(input, &Facade::complete(root), &Budget::default())
}

/// The `linkage` crate that emitted code calls.
#[derive(Debug, Clone)]
pub struct Facade {
    /// Its path.
    pub path: TokenStream,
    /// True if its feature `dynamics` is on: scenes need it.
    pub has_dynamics: bool,
    /// True if its feature `serde` is on: `derive serde` needs it.
    pub has_serde: bool,
    /// True if its feature `interval` is on: `derive intervals` needs it.
    pub has_intervals: bool,
}

impl Facade {
    /// The crate at this path with all features on.
    #[must_use]
    pub fn complete(path: &TokenStream) -> Self {
        Self { path: path.clone(), has_dynamics: true, has_serde: true, has_intervals: true }
    }
}

/// Expands one `linkage!` invocation within a budget of work.
#[must_use]
pub fn expand_within(input: TokenStream, facade: &Facade, budget: &Budget) -> TokenStream {
    let root = &facade.path;
    let mut outside = Diagnostics::default();
    let mut resolved = Vec::new();
    for tree in syntax::parse(input, &mut outside) {
        let was_spent = budget.is_spent();
        let (mut mechanism, mut diagnostics) = model::resolve(tree, budget);
        if !facade.has_dynamics {
            report_scenes(&mut mechanism, &mut diagnostics);
        }
        report_requests(&mut mechanism, facade, &mut diagnostics);
        clash::within(&mut mechanism, &mut diagnostics);
        if budget.is_spent() {
            diagnostics = Diagnostics::default();
            if !was_spent {
                too_much(&mechanism, &mut diagnostics);
            }
        }
        resolved.push((mechanism, diagnostics));
    }
    let clashes = clash::find(resolved.iter().map(|(mechanism, _)| mechanism), &mut outside);
    let (mut errors, mut items) = (outside.to_tokens(), TokenStream::new());
    for (place, (mechanism, diagnostics)) in resolved.iter_mut().enumerate() {
        if clashes.contains(&place) {
            errors.extend(diagnostics.to_tokens());
            continue;
        }
        let is_spent = budget.is_spent();
        let complete = (!is_spent && diagnostics.is_empty()).then(|| printed(mechanism, budget, root, diagnostics));
        errors.extend(diagnostics.to_tokens());
        match complete.filter(|_| diagnostics.is_empty()) {
            Some(complete) => items.extend(complete),
            None if mechanism.is_well_named() => items.extend(emit::stub(mechanism, root)),
            None => {}
        }
    }
    quote! { #errors #items }
}

/// Reports and removes all scenes: without the feature `dynamics` the types that their stubs name do not exist.
fn report_scenes(mechanism: &mut Mechanism, diagnostics: &mut Diagnostics) {
    for scene in std::mem::take(&mut mechanism.scenes).iter() {
        diagnostics
            .error(scene.name.span(), "a scene needs the feature `dynamics` of `linkage`: enable it in Cargo.toml");
    }
}

/// Reports and removes the requests whose features are off.
fn report_requests(mechanism: &mut Mechanism, facade: &Facade, diagnostics: &mut Diagnostics) {
    let needed = [
        (Request::Serde, facade.has_serde, "`derive serde` needs the feature `serde`"),
        (Request::Intervals, facade.has_intervals, "`derive intervals` needs the feature `interval`"),
    ];
    for (request, is_on, message) in needed {
        if !is_on && let Some(span) = mechanism.requests_at.remove(&request) {
            mechanism.requests.remove(&request);
            diagnostics.error(span, format_args!("{message} of `linkage`: enable it in Cargo.toml"));
        }
    }
}

/// Derives a mechanism, checks its derivatives, and prints its program, one driver after the other to limit memory.
fn printed(mechanism: &Mechanism, budget: &Budget, root: &TokenStream, diagnostics: &mut Diagnostics) -> TokenStream {
    let mut drivers = Vec::new();
    for driver in &mechanism.drivers {
        let before = diagnostics.len();
        if budget.spend(derivation::matrices(mechanism, driver)) {
            let mut derivation = derivation::derive(mechanism, driver);
            if !budget.is_spent() && derivation::check(mechanism, driver, &mut derivation, diagnostics) {
                let planned = program::plan(mechanism, driver, &mut derivation);
                let lowered = lower::program(planned, &derivation);
                drivers.push(emit::driver(&lowered, Some(&derivation), root));
                derivation::check_numbers(mechanism, driver, &mut derivation.graph, diagnostics);
            }
        }
        if budget.is_spent() {
            diagnostics.truncate(before);
            too_much(mechanism, diagnostics);
            break;
        }
    }
    emit::mechanism(mechanism, drivers, root)
}

/// Reports that the budget of an invocation is spent in a mechanism.
fn too_much(mechanism: &Mechanism, diagnostics: &mut Diagnostics) {
    let name = &mechanism.name;
    diagnostics.error(
        name.span(),
        format_args!(
            "this invocation exceeds the compiler's budget of work in `{name}`: split it into several invocations"
        ),
    );
}

/// The emitted code of a checked mechanism, and its size.
#[derive(Debug, Clone)]
pub struct Expansion {
    pub tokens: TokenStream,
    /// The number of nodes of the expression graphs.
    pub nodes: usize,
    /// The operations of all emitted functions, each called once.
    pub operations: Operations,
}

/// Derives and emits a checked mechanism; `root` is the path of the `linkage` crate.
#[must_use]
pub fn compile(mechanism: &Mechanism, root: &TokenStream) -> Expansion {
    let (mut nodes, mut operations, mut drivers) = (0, Operations::default(), Vec::new());
    for (driver, mut derivation) in mechanism.drivers.iter().zip(derive(mechanism)) {
        let lowered = lower::program(program::plan(mechanism, driver, &mut derivation), &derivation);
        nodes += derivation.graph.len();
        operations = operations.plus(emit::operations(&lowered));
        drivers.push(emit::driver(&lowered, Some(&derivation), root));
    }
    Expansion { tokens: emit::mechanism(mechanism, drivers, root), nodes, operations }
}

/// Returns the derivations of a checked mechanism, one for each driver.
#[must_use]
pub fn derive(mechanism: &Mechanism) -> Vec<Derivation> {
    mechanism.drivers.iter().map(|driver| derivation::derive(mechanism, driver)).collect()
}

/// Returns the lowered programs of a checked mechanism as text, one for each driver.
#[must_use]
pub fn programs(mechanism: &Mechanism) -> Vec<String> {
    let drivers = mechanism.drivers.iter().map(|driver| {
        let mut derivation = derivation::derive(mechanism, driver);
        emit::text(&lower::program(program::plan(mechanism, driver, &mut derivation), &derivation))
    });
    drivers.collect()
}

/// Returns the documents of a checked mechanism, one for each driver, and those of its scenes, with the formulas of
/// functions as `derive fpcore` adds them.
#[must_use]
pub fn documents(mechanism: &Mechanism) -> (Vec<Document>, Vec<SceneDocument>) {
    let (mut documents, mut scenes) = (Vec::new(), Vec::new());
    for driver in &mechanism.drivers {
        let mut derivation = derivation::derive(mechanism, driver);
        let lowered = lower::program(program::plan(mechanism, driver, &mut derivation), &derivation);
        let (of_driver, of_scenes) = emit::documents(&lowered, &derivation);
        documents.extend(of_driver);
        scenes.extend(of_scenes);
    }
    (documents, scenes)
}

/// The largest rounding errors that the functions of one driver can have.
#[derive(Debug, Clone)]
pub struct Bounds {
    pub driver: String,
    /// The names of the parameters in the bounds.
    pub parameters: Vec<String>,
    /// The names of the coordinates in the bounds, of their rates and accelerations.
    pub coordinates: Vec<[String; 3]>,
    pub functions: BTreeMap<String, lower::Bound>,
}

/// Returns the largest rounding errors that the functions of a checked mechanism can have, for each driver.
#[must_use]
pub fn bounds(mechanism: &Mechanism) -> Vec<Bounds> {
    let drivers = mechanism.drivers.iter().map(|driver| {
        let mut derivation = derivation::derive(mechanism, driver);
        let lowered = lower::program(program::plan(mechanism, driver, &mut derivation), &derivation);
        let name = |symbol| derivation.graph.symbol_name(symbol).to_owned();
        let parameters = mechanism.parameters.iter().map(|parameter| name(parameter.symbol)).collect();
        let coordinates = derivation.coordinates.iter().map(|one| [one.value, one.rate, one.acceleration].map(name));
        let bounds = lowered.functions.iter().filter_map(|function| {
            let bound = function.body.as_ref()?.bound.clone()?;
            Some((function.name.clone(), bound))
        });
        let (functions, coordinates) = (bounds.collect(), coordinates.collect());
        Bounds { driver: driver.name.to_string(), parameters, coordinates, functions }
    });
    drivers.collect()
}

/// Parses and checks mechanisms without expanding them, for tests and tools.
///
/// # Errors
/// The messages of all mistakes.
pub fn read(input: TokenStream) -> Result<Vec<Mechanism>, Vec<String>> {
    let mut diagnostics = Diagnostics::default();
    let budget = Budget::default();
    let trees = syntax::parse(input, &mut diagnostics);
    let mechanisms = trees.into_iter().map(|tree| {
        let (mechanism, own) = model::resolve(tree, &budget);
        diagnostics.append(own);
        mechanism
    });
    let mechanisms = mechanisms.collect();
    if diagnostics.is_empty() { Ok(mechanisms) } else { Err(diagnostics.messages()) }
}
