//! Checks of a mechanism as a whole.

use std::collections::BTreeSet;

use proc_macro2::Span;

use super::mechanism::{Driver, Mechanism, misnamed};
use super::name::Name;
use super::scope::Scope;
use crate::diagnostics::Diagnostics;
use crate::graph::SymbolId;
use crate::ids::{RowId, Table, UnknownId};
use crate::structure::StructurallySingular;

/// Reports declarations that are not used.
pub(super) fn usage(mechanism: &Mechanism, scope: &Scope, diagnostics: &mut Diagnostics) {
    let all = mechanism.parameters.iter().chain(&mechanism.scene_parameters);
    let parameters = all.map(|p| ("parameter", &p.name, p.symbol));
    let coordinates = mechanism.coordinates.iter().map(|c| ("coordinate", &c.name, c.symbol));
    for (what, name, symbol) in parameters.chain(coordinates) {
        if is_idle(scope, name, symbol) {
            let text = &name.text;
            diagnostics
                .error(name.span, format_args!("the {what} `{text}` is never used; remove it, or call it `_{text}`"));
        }
    }
    externals(mechanism, diagnostics);
}

/// True if a name is not used and does not begin with `_`.
fn is_idle(scope: &Scope, name: &Name, symbol: SymbolId) -> bool {
    !scope.is_used(symbol) && !name.text.starts_with('_')
}

/// Reports user functions that are not called.
fn externals(mechanism: &Mechanism, diagnostics: &mut Diagnostics) {
    for external in mechanism.externals.iter().filter(|external| external.calls.is_empty()) {
        if let Some(name) = external.names.first() {
            diagnostics.error(name.span, format_args!("the function `{}` is never used; remove it", name.text));
        }
    }
}

pub(super) fn types(mechanism: &Mechanism, diagnostics: &mut Diagnostics) {
    for name in misnamed(mechanism) {
        diagnostics
            .error(name.span(), "`T` is the type parameter of emitted code: choose another name, such as `TLinkage`");
    }
}

/// Reports names that become the same field, since they differ only in case.
pub(super) fn fields(mechanism: &Mechanism, diagnostics: &mut Diagnostics) {
    let parameters = mechanism.parameters.iter().chain(&mechanism.scene_parameters);
    let parameters: Vec<_> = parameters.map(|p| &p.name).collect();
    let coordinates: Vec<_> = mechanism.coordinates.iter().map(|c| &c.name).collect();
    let symbols: Vec<_> = parameters.into_iter().chain(coordinates).collect();
    let functions: Vec<_> = mechanism.externals.iter().flat_map(|external| &external.names).collect();
    let points: Vec<_> = mechanism.points.iter().map(|p| &p.name).collect();
    let outputs: Vec<_> = mechanism.outputs.iter().map(|o| &o.name).collect();
    for names in [symbols, functions, points, outputs] {
        for (index, name) in names.iter().enumerate() {
            if let Some(first) = names[..index].iter().find(|other| other.field == name.field) {
                diagnostics.error(
                    name.span,
                    format_args!(
                        "`{}` and `{}` both become the field `{}`: rename one",
                        first.text, name.text, name.field
                    ),
                );
            }
        }
    }
}

/// Checks that each implied loop or equation contains an unknown of every driver.
fn implied(mechanism: &Mechanism, diagnostics: &mut Diagnostics) {
    for implied in &mechanism.implied {
        let found = mechanism.graph.symbols_of(&implied.rows);
        let is_free = |driver: &Driver| {
            let mut unknowns = driver.unknowns.iter().map(|&index| mechanism.coordinates[index].symbol);
            !unknowns.any(|symbol| found.contains(&symbol))
        };
        if let Some(driver) = mechanism.drivers.iter().find(|driver| is_free(driver)) {
            let message = format_args!(
                "this implied equation contains no unknown of `{}`: it cannot follow from the others",
                driver.name
            );
            diagnostics.error(implied.span, message);
        }
    }
}

/// Checks that there are as many scalar equations as unknowns and that all unknowns can be solved for; sets the order
/// of solution of each driver.
pub(super) fn constraints(mechanism: &mut Mechanism, scope: &Scope, diagnostics: &mut Diagnostics) {
    implied(mechanism, diagnostics);
    let rows: usize = mechanism.constraints.iter().map(|constraint| constraint.rows.len()).sum();
    let at = |driver: &Driver| -> Span { driver.name.span() };
    for id in mechanism.drivers.ids() {
        let driver = &mechanism.drivers[id];
        let unknowns = driver.unknowns.len();
        let coordinates = driver.unknowns.iter().map(|&index| &mechanism.coordinates[index]);
        let idle = coordinates.filter(|unknown| is_idle(scope, &unknown.name, unknown.symbol)).count();
        if idle > 0 && rows > 0 && rows + idle == unknowns {
            // The unused unknowns are reported, which explains the difference.
            continue;
        }
        if rows != unknowns {
            let loops = mechanism.constraints.iter().filter(|constraint| constraint.rows.len() == 2).count();
            let equations = mechanism.constraints.len() - loops;
            let last = driver.unknowns.last().map(|&index| mechanism.coordinates[index].name.span);
            let span = if mechanism.is_driven_by_choice() { at(driver) } else { last.unwrap_or_else(|| at(driver)) };
            let advice = if rows < unknowns {
                "close another loop, or make unknowns inputs"
            } else {
                "write `implied` before those that follow from others, or declare another unknown"
            };
            diagnostics.error(
                span,
                format_args!(
                    "{unknowns} unknowns, but {rows} scalar equations (2 for each of {loops} `loop`, 1 for each of {equations} `equation`): {advice}"
                ),
            );
            continue;
        }
        if driver.inputs.is_empty() {
            diagnostics.error(at(driver), "this mechanism has no input: declare one with `input`");
        }
        if rows == 0 {
            diagnostics.error(at(driver), "a mechanism needs at least one `loop` or `equation`");
        }
        let symbols: BTreeSet<SymbolId> =
            driver.unknowns.iter().map(|&index| mechanism.coordinates[index].symbol).collect();
        let before = diagnostics.is_empty();
        for constraint in &mechanism.constraints {
            let found = mechanism.graph.symbols_of(&constraint.rows);
            if !found.iter().any(|symbol| symbols.contains(symbol)) {
                diagnostics.error(
                    constraint.span,
                    format_args!(
                        "this equation contains no unknown of `{}`: remove it, or use an unknown in it",
                        driver.name
                    ),
                );
            }
        }
        if before && diagnostics.is_empty() {
            match mechanism.ordered(id) {
                Ok(system) => mechanism.drivers[id].system = system,
                Err(singular) => singularity(mechanism, &mechanism.drivers[id], &singular, diagnostics),
            }
        }
    }
}

/// Reports unknowns that too few equations determine, and equations that contain too few unknowns.
fn singularity(mechanism: &Mechanism, driver: &Driver, singular: &StructurallySingular, diagnostics: &mut Diagnostics) {
    let name = |unknown: UnknownId| &mechanism.coordinates[driver.unknowns[unknown]].name;
    let list = |unknowns: &[UnknownId]| {
        let names = unknowns.iter().map(|&unknown| format!("`{}`", name(unknown).text));
        names.collect::<Vec<_>>().join(", ")
    };
    let rows = |count: usize| format!("{count} scalar equation{}", if count == 1 { "" } else { "s" });
    let StructurallySingular { undetermined, too_few, competing, contested } = singular;
    if let Some(&first) = undetermined.first() {
        let what = match (undetermined.as_slice(), too_few.len()) {
            (_, 0) => format!("{} appears in no equation", list(undetermined)),
            (_, count) => format!("{} appear in only {}", list(undetermined), rows(count)),
        };
        let advice = format_args!("`{}` cannot be solved at any position: {what}", driver.name);
        diagnostics.error(name(first).span, advice);
    }
    let constraints =
        mechanism.constraints.iter().flat_map(|constraint| constraint.rows.iter().map(|_| constraint.span));
    let spans: Table<RowId, Span> = constraints.collect();
    if let Some(&last) = competing.last() {
        let advice = format_args!(
            "{}, up to this one, contain only {}: use another unknown in one of them",
            rows(competing.len()),
            list(contested),
        );
        diagnostics.error(spans[last], advice);
    }
}
