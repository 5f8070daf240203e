//! Checks of a mechanism that need its derivatives.

use std::collections::BTreeSet;

use super::data::Derivation;
use crate::diagnostics::Diagnostics;
use crate::graph::{External, Fault, Graph, SymbolId};
use crate::model::{Call, Driver, ExternalFunction, Mechanism, Request, Scene, SceneRequest};

/// The largest number of expressions of a derivation; it bounds the time of emission.
pub const LARGEST: usize = 40_000;

/// The budget steps of an entry of a matrix: it is emitted in several functions, with at least five tokens each of
/// about 80 bytes.
const STEPS_OF_AN_ENTRY: usize = 100;

/// The budget steps of the matrices of a driver, including zeros: J, W, those of points and outputs, M, and those of
/// `derive` statements.
#[must_use]
pub fn matrices(mechanism: &Mechanism, driver: &Driver) -> usize {
    let (unknowns, inputs) = (driver.unknowns.len(), driver.inputs.len());
    let components = 2 * mechanism.points.len() + mechanism.outputs.len();
    let square = inputs.saturating_mul(inputs);
    let of_driver = |scene: &&Scene| mechanism.drivers[scene.driver].name == driver.name;
    let scenes = || mechanism.scenes.iter().filter(of_driver);
    let balanced = scenes().filter(|scene| scene.requests.contains(&SceneRequest::Equilibrium)).count();
    let inert = scenes().filter(|scene| scene.inertia.is_some()).count();
    let is_wanted = |request| usize::from(mechanism.requests.contains(&request));
    let (second, first) = (is_wanted(Request::VelocityRatioDerivatives), is_wanted(Request::Sensitivity));
    let derived = inputs + second * square + first * mechanism.parameters.len();
    let of_unknowns = unknowns.saturating_mul(unknowns + derived + balanced * square);
    let of_quantities = components.saturating_mul(derived);
    let entries = of_unknowns.saturating_add(of_quantities).saturating_add((inert + balanced).saturating_mul(square));
    STEPS_OF_AN_ENTRY.saturating_mul(entries)
}

/// Reports mechanisms that are wrong for all values of the parameters; returns true if there are no mistakes.
pub fn check(
    mechanism: &Mechanism,
    driver: &Driver,
    derivation: &mut Derivation,
    diagnostics: &mut Diagnostics,
) -> bool {
    let before = diagnostics.len();
    // du/dp is dense, and its formulas are made only at emission.
    let entries = derivation.sensitivity.iter().map(|first| first.names.len() * derivation.unknowns.len());
    let size = derivation.graph.len() + entries.sum::<usize>();
    if size > LARGEST {
        diagnostics.error(
            driver.name.span(),
            format_args!(
                "the derivatives of `{}` take {size} expressions, more than {LARGEST}; split the mechanism",
                driver.name,
            ),
        );
    }
    if !given(mechanism, derivation, diagnostics) {
        return false;
    }
    for group in &derivation.groups {
        if group.determinant.is_some_and(|determinant| derivation.graph.is_zero(determinant.value)) {
            let names: Vec<String> = group
                .unknowns
                .iter()
                .map(|&unknown| format!("`{}`", mechanism.coordinates[driver.unknowns[unknown]].name.text))
                .collect();
            diagnostics.error(
                driver.name.span(),
                format_args!(
                    "`{}` is singular at every position: the equations for {} are dependent",
                    driver.name,
                    names.join(" and ")
                ),
            );
        }
    }
    without_inertia(mechanism, driver, derivation, diagnostics);
    without_force(mechanism, derivation, diagnostics);
    if diagnostics.len() == before {
        check_numbers(mechanism, driver, &mut derivation.graph, diagnostics);
    }
    diagnostics.len() == before
}

/// Reports a constant in the derivatives that is outside the range of `f64`.
pub fn check_numbers(mechanism: &Mechanism, driver: &Driver, graph: &mut Graph, diagnostics: &mut Diagnostics) {
    let Some(fault) = graph.take_fault() else { return };
    let message = format!("in the derivatives of `{}`: {fault}", driver.name);
    match (fault, mechanism.extreme) {
        (Fault::OutOfRange, extreme) => {
            let message = format!("{message}\nchoose units in which the numbers are nearer to 1");
            diagnostics.error(extreme.map_or(driver.name.span().into(), |extreme| extreme.region), message);
        }
        _ => diagnostics.error(driver.name.span(), message),
    }
}

/// Reports inputs without reduced inertia at all positions, and equilibria without free inputs.
fn without_inertia(mechanism: &Mechanism, driver: &Driver, derivation: &Derivation, diagnostics: &mut Diagnostics) {
    for derived in &derivation.scenes {
        let scene = &mechanism.scenes[derived.id];
        if derived.equilibrium.is_some() && derived.drives.len() == driver.inputs.len() {
            let message = format!("all inputs of `{}` are driven: remove `equilibrium;`", scene.name);
            diagnostics.error(scene.name.span(), message);
        }
        let Some(mass_matrix) = &derived.mass_matrix else { continue };
        for (id, row) in mass_matrix.enumerated() {
            if !derived.drives.contains_key(&id) && derivation.graph.is_zero(row[id]) {
                let input = &mechanism.coordinates[driver.inputs[id]].name.text;
                diagnostics.error(
                    scene.name.span(),
                    format_args!(
                        "the reduced inertia of `{input}` in `{}` is zero: add a body that moves with it",
                        scene.name
                    ),
                );
            }
        }
    }
}

/// Reports frictions by a force in a joint that is zero in every motion.
fn without_force(mechanism: &Mechanism, derivation: &Derivation, diagnostics: &mut Diagnostics) {
    for derived in &derivation.scenes {
        let scene = &mechanism.scenes[derived.id];
        let bearings = derived.reactions.iter().flat_map(|reactions| &reactions.bearings).enumerate();
        for (contact, bearing) in bearings {
            let is_zero = bearing.as_ref().is_some_and(|rows| rows.iter().all(|row| row.is_zero(&derivation.graph)));
            let load = scene.contacts[contact].bearing.map(|load| &mechanism.opened.loads[load]);
            let (Some(load), Some(region)) = (load.filter(|_| is_zero), scene.friction_at(contact)) else { continue };
            let reason = match load.left_out.is_empty() {
                true => "nothing presses its parts together",
                false => "the forces of an `equation` do not reach it",
            };
            let message = format!(
                "{} is zero in every motion, and so is this friction: {reason}\nwrite its limit as an expression \
                 instead of `reaction`",
                load.description()
            );
            diagnostics.error(region, message);
        }
    }
}

/// Returns true if the user functions have all derivatives that are needed; reports those that are missing.
fn given(mechanism: &Mechanism, derivation: &Derivation, diagnostics: &mut Diagnostics) -> bool {
    let mut complete = true;
    for external in &mechanism.externals {
        let ExternalFunction { path, names, arguments, .. } = external;
        let Some(name) = names.first() else { continue };
        let derived = || derivation.graph.applied().filter(|applied| applied.function == external.id);
        let other = derived().find_map(|applied| applied.by.iter().skip(1).position(|&times| times > 0));
        let needed = derived().filter_map(External::order).max().unwrap_or(0);
        let (argument, message) = if let Some(other) = other {
            let (first, moving) = (&arguments[0], &arguments[other + 1]);
            let message = format!("`{moving}` must be constant: `{}` has derivatives by `{first}` only", name.text);
            (other + 1, message)
        } else if needed >= names.len() {
            let path: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
            let list: Vec<&str> = names.iter().map(|name| name.text.as_str()).collect();
            let message = format!(
                "motion needs the {} derivative of `{}`, but `{}` returns only {}\nlet it return more: `-> ({}{})`",
                ordinal(needed),
                name.text,
                path.join("::"),
                names.len() - 1,
                list.join(", "),
                ", …".repeat(needed + 1 - names.len()),
            );
            (0, message)
        } else {
            continue;
        };
        complete = false;
        let call = moving(mechanism, derivation, &external.calls, argument);
        diagnostics.error(call.map_or_else(|| name.span.into(), |call| call.region), message);
    }
    complete
}

fn ordinal(number: usize) -> String {
    let ending = match number {
        1 => "st",
        2 => "nd",
        3 => "rd",
        _ => "th",
    };
    format!("{number}{ending}")
}

/// The call of the highest order whose argument depends on a coordinate.
fn moving<'a>(mechanism: &Mechanism, derivation: &Derivation, calls: &'a [Call], argument: usize) -> Option<&'a Call> {
    let coordinates: BTreeSet<SymbolId> = mechanism.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let moves = |call: &&Call| {
        let symbols = derivation.graph.symbols_of(&call.arguments[argument..=argument]);
        symbols.iter().any(|symbol| coordinates.contains(symbol))
    };
    // `max_by_key` returns the last maximum: reversed, the first.
    calls.iter().rev().filter(moves).max_by_key(|call| call.order)
}
