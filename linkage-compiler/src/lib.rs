//! The compiler behind `linkage!`: tokens in, tokens out.
//!
//! [`expand_within`] runs all stages. Each depends only on stages before it: syntax (parser), graph (expressions), algebra
//! (simplification), structure (order of solution), model (name resolution and checks), derivation (mathematics), program
//! (the functions to emit), lower (common subexpressions, order, names), document (formulas for readers), emit
//! (printers). `ARCHITECTURE.md`, at the root of the repository, follows one four-bar through them; the example `stage` prints
//! any stage of any file.

pub mod algebra;
pub mod budget;
mod clash;
pub mod derivation;
pub mod diagnostics;
pub mod document;
pub mod emit;
mod facade;
pub mod graph;
pub mod ids;
pub mod lower;
pub mod model;
pub mod program;
pub mod structure;
pub mod syntax;
#[cfg(feature = "text")]
pub mod text;

use linkage_ir::code::Code;
use proc_macro2::TokenStream;
use quote::quote;

use budget::{Budget, Spent};
use derivation::Derivation;
use diagnostics::Diagnostics;
use document::{Documents, DriverDocument, SceneDocument, SheetDocument};
use emit::Declared;
use model::{Driver, Mechanism};
use program::{Operations, Program};

pub use facade::Facade;

/// Expands the body of one `linkage!` invocation; `root` is the path of the `linkage` crate.
///
/// Mistakes become `compile_error!`s on their tokens. Stubs with the intended names and types come with them, so that
/// uses of the mechanism cause no further errors.
#[must_use]
pub fn expand(input: TokenStream, root: &TokenStream) -> TokenStream {
    expand_within(input, &Facade::complete(root), &Budget::default())
}

/// Expands one `linkage!` invocation within a budget of work.
#[must_use]
pub fn expand_within(input: TokenStream, facade: &Facade, budget: &Budget) -> TokenStream {
    let Invocation { outside, mechanisms } = Invocation::read(input, facade, budget);
    let (mut errors, mut items) = (outside.to_tokens(), TokenStream::new());
    for mut checked in mechanisms {
        if !checked.is_clashing {
            items.extend(emitted(&mut checked, &facade.path));
        }
        errors.extend(checked.diagnostics.to_tokens());
    }
    quote! { #errors #items }
}

/// The mechanisms of one invocation after the checks that need no derivatives.
struct Invocation {
    /// The mistakes outside of all mechanisms.
    outside: Diagnostics,
    mechanisms: Vec<Checked>,
}

/// A mechanism with its mistakes.
struct Checked {
    mechanism: Mechanism,
    diagnostics: Diagnostics,
    /// True if another mechanism has a type of its names.
    is_clashing: bool,
}

impl Invocation {
    fn read(input: TokenStream, facade: &Facade, budget: &Budget) -> Self {
        let mut outside = Diagnostics::default();
        let trees = syntax::parse(input, &mut outside);
        let mut mechanisms: Vec<_> = trees.into_iter().map(|tree| resolved(tree, facade, budget)).collect();
        let clashing = clash::find(mechanisms.iter().map(|checked| &checked.mechanism), &mut outside);
        for index in clashing {
            mechanisms[index].is_clashing = true;
        }
        Self { outside, mechanisms }
    }
}

/// Resolves a mechanism, and makes the checks that need no derivatives.
fn resolved(tree: syntax::Mechanism, facade: &Facade, budget: &Budget) -> Checked {
    let before = budget.check();
    let (mut mechanism, mut diagnostics) = model::resolve(tree, budget);
    facade.check(&mut mechanism, &mut diagnostics);
    clash::within(&mut mechanism, &mut diagnostics);
    if budget.check().is_err() {
        diagnostics = Diagnostics::default();
        // Only the mechanism that exceeds the budget is reported.
        if before.is_ok() {
            too_much(&mechanism, &mut diagnostics);
        }
    }
    Checked { mechanism, diagnostics, is_clashing: false }
}

impl Checked {
    /// Applies a function to each driver; `None` after a mistake, and if the budget is spent.
    fn drivers<R>(&mut self, f: impl FnMut(Lowered) -> R) -> Option<Vec<R>> {
        let is_right = self.diagnostics.is_empty() && self.mechanism.graph.budget().check().is_ok();
        if is_right { of_drivers(&self.mechanism, &mut self.diagnostics, f) } else { None }
    }
}

/// The items of a mechanism: complete, or after mistakes those of a stub.
fn emitted(checked: &mut Checked, root: &TokenStream) -> TokenStream {
    let drivers = checked.drivers(|of| emit::driver(of.declared, &of.program, Some(&of.derivation), root));
    let mechanism = &checked.mechanism;
    match drivers {
        Some(drivers) => emit::mechanism(mechanism, drivers, root),
        None if mechanism.is_well_named() => emit::stub(mechanism, root),
        None => TokenStream::new(),
    }
}

/// A driver with its mathematics and its functions: what all stages but the printers make of it.
pub struct Lowered<'m> {
    pub declared: Declared<'m>,
    pub derivation: Derivation,
    /// Its functions as operations.
    pub program: Program<Code>,
    /// The largest rounding errors that its functions can have.
    pub bounds: lower::Bounds,
}

impl Lowered<'_> {
    /// Its documents: of the driver, of the analysis by hand where formulas for it exist, and of the scenes, with the formulas of
    /// functions as `derive fpcore` adds them.
    #[must_use]
    pub fn documents(&self) -> Documents {
        let Declared { mechanism, driver: declared } = self.declared;
        let (driver, scenes) = emit::documents(self.declared, &self.program, &self.derivation);
        let has_formulas = self.derivation.groups.iter().all(|group| group.determinant.is_some());
        let by_hand = has_formulas.then(|| document::of_sheet(mechanism, declared, &self.derivation));
        let parameters = self.program.signatures.parameters.iter();
        let defaults = parameters.filter_map(|parameter| Some((parameter.name.text.clone(), parameter.default?)));
        let about = document::paragraphs(&mechanism.documentation());
        Documents { driver, by_hand, scenes, defaults: defaults.collect(), about }
    }
}

/// Derives, checks, plans and lowers one driver; `None` after a mistake.
fn lowered<'m>(
    mechanism: &'m Mechanism,
    driver: &'m Driver,
    diagnostics: &mut Diagnostics,
) -> Result<Option<Lowered<'m>>, Spent> {
    let budget = mechanism.graph.budget();
    budget.spend(derivation::matrices(mechanism, driver))?;
    let mut derivation = derivation::derive(mechanism, driver);
    budget.check()?;
    if !derivation::check(mechanism, driver, &mut derivation, diagnostics) {
        return Ok(None);
    }
    let planned = program::plan(mechanism, driver, &mut derivation)?;
    let (program, bounds) = match lower::program(planned, &derivation) {
        Ok(lowered) => lowered,
        Err(dangling) => {
            // Formulas that a spent budget cut off refer to what was left out.
            budget.check()?;
            diagnostics.error(driver.name.span(), dangling);
            return Ok(None);
        }
    };
    derivation::check_numbers(mechanism, driver, &mut derivation.graph, diagnostics);
    Ok(Some(Lowered { declared: Declared { mechanism, driver }, derivation, program, bounds }))
}

/// Applies a function to each driver, one after the other to limit memory; `None` after a mistake.
fn of_drivers<R>(
    mechanism: &Mechanism,
    diagnostics: &mut Diagnostics,
    mut f: impl FnMut(Lowered) -> R,
) -> Option<Vec<R>> {
    let mut results = Vec::new();
    for driver in &mechanism.drivers {
        let mut own = Diagnostics::default();
        let result = lowered(mechanism, driver, &mut own).and_then(|lowered| {
            let result = lowered.map(&mut f);
            mechanism.graph.budget().check().map(|()| result)
        });
        let Ok(result) = result else {
            too_much(mechanism, diagnostics);
            break;
        };
        results.extend(result);
        diagnostics.append(own);
    }
    diagnostics.is_empty().then_some(results)
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

/// Applies a function to each driver of a mechanism that [`read`] returns, one after the other to limit memory.
///
/// # Errors
/// As [`compile`].
pub fn each_driver<R>(mechanism: &Mechanism, f: impl FnMut(Lowered) -> R) -> Result<Vec<R>, Vec<String>> {
    let mut diagnostics = Diagnostics::default();
    of_drivers(mechanism, &mut diagnostics, f).ok_or_else(|| diagnostics.messages())
}

/// The emitted code of a mechanism, and its size.
#[derive(Debug, Clone)]
pub struct Expansion {
    pub tokens: TokenStream,
    /// The number of nodes of the expression graphs.
    pub nodes: usize,
    /// The operations of all emitted functions, each called once.
    pub operations: Operations,
}

/// Derives and emits a mechanism; `root` is the path of the `linkage` crate.
///
/// # Errors
/// The messages of mistakes that appear in derivatives, or that of a spent budget.
pub fn compile(mechanism: &Mechanism, root: &TokenStream) -> Result<Expansion, Vec<String>> {
    let (mut nodes, mut operations) = (0, Operations::default());
    let drivers = each_driver(mechanism, |Lowered { declared, derivation, program, .. }| {
        nodes += derivation.graph.len();
        operations = operations.plus(emit::operations(&program));
        emit::driver(declared, &program, Some(&derivation), root)
    })?;
    Ok(Expansion { tokens: emit::mechanism(mechanism, drivers, root), nodes, operations })
}

/// Returns the derivations of a mechanism, one for each driver.
#[must_use]
pub fn derive(mechanism: &Mechanism) -> Vec<Derivation> {
    mechanism.drivers.iter().map(|driver| derivation::derive(mechanism, driver)).collect()
}

/// Returns the lowered programs of a mechanism as text, one for each driver.
///
/// # Errors
/// As [`compile`].
pub fn programs(mechanism: &Mechanism) -> Result<Vec<String>, Vec<String>> {
    each_driver(mechanism, |of| emit::text(&of.program))
}

/// Returns the documents of a mechanism, one for each driver, and those of its scenes, with the formulas of functions as
/// `derive fpcore` adds them.
///
/// # Errors
/// As [`compile`].
pub fn documents(mechanism: &Mechanism) -> Result<(Vec<DriverDocument>, Vec<SceneDocument>), Vec<String>> {
    let (documents, scenes): (Vec<_>, Vec<_>) =
        each_driver(mechanism, |of| emit::documents(of.declared, &of.program, &of.derivation))?.into_iter().unzip();
    Ok((documents.into_iter().flatten().collect(), scenes.into_iter().flatten().collect()))
}

/// Returns the documents of the sheets of a mechanism, one for each driver, as `derive sheet` adds them.
///
/// # Errors
/// As [`compile`], and the names of unknowns that are solved together without formulas.
pub fn sheets(mechanism: &Mechanism) -> Result<Vec<SheetDocument>, Vec<String>> {
    let of_driver = |Lowered { declared, derivation, .. }: Lowered<'_>| {
        let without = derivation.groups.iter().find(|group| group.determinant.is_none());
        match without {
            Some(group) => Err(vec![group.names(&derivation)]),
            None => Ok(document::of_sheet(mechanism, declared.driver, &derivation)),
        }
    };
    each_driver(mechanism, of_driver)?.into_iter().collect()
}

/// The largest rounding errors that the functions of one driver can have.
#[derive(Debug, Clone)]
pub struct Bounds {
    pub driver: String,
    /// The names of the parameters in the bounds.
    pub parameters: Vec<String>,
    /// The names of the coordinates in the bounds, of their rates and accelerations.
    pub coordinates: Vec<[String; 3]>,
    pub functions: lower::Bounds,
}

/// Returns the largest rounding errors that the functions of a mechanism can have, for each driver.
///
/// # Errors
/// As [`compile`].
pub fn bounds(mechanism: &Mechanism) -> Result<Vec<Bounds>, Vec<String>> {
    each_driver(mechanism, |Lowered { derivation, program, bounds, .. }| {
        let name = |symbol| derivation.graph.symbol_name(symbol).to_owned();
        Bounds {
            driver: program.signatures.driver.clone(),
            parameters: mechanism.parameters.iter().map(|parameter| name(parameter.symbol)).collect(),
            coordinates: derivation
                .coordinates
                .iter()
                .map(|one| [one.value, one.rate, one.acceleration].map(name))
                .collect(),
            functions: bounds,
        }
    })
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
