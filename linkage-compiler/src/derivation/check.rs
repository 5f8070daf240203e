//! What can be told of a mechanism only once it is derived.

use std::collections::BTreeSet;

use super::data::Derivation;
use crate::diagnostics::Diagnostics;
use crate::graph::{External, Graph, SymbolId};
use crate::model::{Call, Driver, ExternalFunction, Mechanism, Request, Scene, Wish};

/// A derivation of more expressions than this is refused: emitting it takes longer than anybody waits.
pub const LARGEST: usize = 40_000;

/// The steps that an entry of a matrix counts as: it is written in several functions, as five tokens or more each, of
/// some 80 bytes.
const STEPS_OF_AN_ENTRY: usize = 100;

/// The work that the matrices of a driver are, zeros included: J, W and what is asked for beyond.
#[must_use]
pub fn matrices(mechanism: &Mechanism, driver: &Driver) -> usize {
    let (unknowns, inputs) = (driver.unknowns.len(), driver.inputs.len());
    let of_driver = |scene: &&Scene| mechanism.drivers[scene.driver].name == driver.name;
    let balanced = mechanism.scenes.iter().filter(of_driver).filter(|scene| scene.wishes.contains(&Wish::Equilibrium));
    let is_wanted = |request| usize::from(mechanism.requests.contains(&request));
    let second = is_wanted(Request::VelocityRatioDerivatives) + balanced.count();
    let columns = unknowns + inputs + second * inputs.saturating_mul(inputs);
    let columns = columns + is_wanted(Request::Sensitivity) * mechanism.parameters.len();
    STEPS_OF_AN_ENTRY.saturating_mul(unknowns).saturating_mul(columns)
}

/// Reports what no choice of numbers can make a mechanism; gives whether nothing is wrong.
pub fn check(
    mechanism: &Mechanism,
    driver: &Driver,
    derivation: &mut Derivation,
    diagnostics: &mut Diagnostics,
) -> bool {
    let before = diagnostics.len();
    // du/dp is full, and solved for only when it is emitted.
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
    for block in &derivation.blocks {
        if block.determinant.is_some_and(|determinant| derivation.graph.is_zero(determinant.value)) {
            let names: Vec<String> = block
                .unknowns
                .iter()
                .map(|&place| format!("`{}`", mechanism.coordinates[driver.unknowns[place]].name.text))
                .collect();
            diagnostics.error(
                driver.name.span(),
                format_args!(
                    "`{}` is singular at every position: the closures for {} say the same of both",
                    driver.name,
                    names.join(" and ")
                ),
            );
        }
    }
    without_inertia(mechanism, driver, derivation, diagnostics);
    if diagnostics.len() == before {
        check_numbers(mechanism, driver, &mut derivation.graph, diagnostics);
    }
    diagnostics.len() == before
}

/// Reports a constant that came of the derivatives and that no `f64` holds.
pub fn check_numbers(mechanism: &Mechanism, driver: &Driver, graph: &mut Graph, diagnostics: &mut Diagnostics) {
    let Some(fault) = graph.take_fault() else { return };
    let message =
        format!("in the derivatives of `{}`: {fault}\nchoose units in which the numbers are nearer to 1", driver.name);
    match mechanism.extreme {
        Some(extreme) => diagnostics.error(extreme.region, message),
        None => diagnostics.error(driver.name.span(), message),
    }
}

/// Inputs that nothing with inertia moves with, whatever the position.
fn without_inertia(mechanism: &Mechanism, driver: &Driver, derivation: &Derivation, diagnostics: &mut Diagnostics) {
    for derived in &derivation.scenes {
        let scene = &mechanism.scenes[derived.place];
        if derived.equilibrium.is_some() && derived.drives.len() == driver.inputs.len() {
            let message = format!("all inputs of `{}` are driven: there is no equilibrium to find", scene.name);
            diagnostics.error(scene.name.span(), message);
        }
        let Some(mass_matrix) = &derived.mass_matrix else { continue };
        for (place, row) in mass_matrix.enumerated() {
            if !derived.drives.contains_key(&place) && derivation.graph.is_zero(row[place]) {
                let input = &mechanism.coordinates[driver.inputs[place]].name.text;
                diagnostics.error(
                    scene.name.span(),
                    format_args!(
                        "nothing that has inertia in `{}` moves with `{input}`: its reduced inertia is zero",
                        scene.name
                    ),
                );
            }
        }
    }
}

/// Whether every derivative of the user's functions that is needed is given.
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
            let message =
                format!("the derivatives of `{}` are by `{first}` alone: `{moving}` must not vary", name.text);
            (other + 1, message)
        } else if needed >= names.len() {
            let path: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
            let list: Vec<&str> = names.iter().map(|name| name.text.as_str()).collect();
            let message = format!(
                "motion takes the {} derivative of `{}`, and `{}` gives {}\nlet it give more: `-> ({}{})`",
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

/// The call of the highest order in which this argument holds a coordinate.
fn moving<'a>(mechanism: &Mechanism, derivation: &Derivation, calls: &'a [Call], argument: usize) -> Option<&'a Call> {
    let coordinates: BTreeSet<SymbolId> = mechanism.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let moves = |call: &&Call| {
        let symbols = derivation.graph.symbols_of(&call.arguments[argument..=argument]);
        symbols.iter().any(|symbol| coordinates.contains(symbol))
    };
    // Of several the first.
    calls.iter().rev().filter(moves).max_by_key(|call| call.order)
}
