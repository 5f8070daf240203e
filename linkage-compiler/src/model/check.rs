//! Checks of a mechanism as a whole.

use std::collections::BTreeSet;

use proc_macro2::Span;

use super::mechanism::{Driver, Mechanism, misnamed};
use super::name::Name;
use super::request::Request;
use super::scope::Scope;
use crate::diagnostics::Diagnostics;
use crate::graph::SymbolId;
use crate::ids::{RowId, Table, UnknownId};
use crate::structure::{Method, StructurallySingular};

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
            if name.becomes_keyword() {
                let Name { text, field, .. } = name;
                diagnostics.error(
                    name.span,
                    format_args!("`{text}` becomes the field `{field}`, a Rust keyword: choose another name"),
                );
            }
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
            let advice = match (rows < unknowns, driver.inputs.is_empty()) {
                (true, _) if rows == 0 => "add a `loop` or an `equation`, or declare all as `input`".to_owned(),
                (true, true) => format!("there is no `input`; declare {} of the unknowns as `input`", unknowns - rows),
                (true, false) => "add a `loop` or an `equation`, or declare unknowns as `input`".to_owned(),
                (false, _) => {
                    "write `implied` before those that follow from others, or declare another unknown".to_owned()
                }
            };
            let message =
                format!("{}, but {}: {advice}", counted(unknowns, "unknown"), sources(rows, loops, equations));
            diagnostics.error(span, message);
            continue;
        }
        if driver.inputs.is_empty() {
            diagnostics.error(at(driver), "this mechanism has no input: declare one with `input`");
        } else if mechanism.is_empty() {
            let message = format_args!(
                "nothing depends on the inputs of `{}`: add a `loop`, an `equation`, a `point`, an `output` or a `scene`",
                driver.name
            );
            diagnostics.error(at(driver), message);
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

/// Reports requests that an open chain cannot answer.
pub(super) fn open_chain(mechanism: &Mechanism, diagnostics: &mut Diagnostics) {
    if !mechanism.is_open() {
        return;
    }
    let has_quantities = !mechanism.points.is_empty() || !mechanism.outputs.is_empty();
    for (request, &span) in &mechanism.requests_at {
        let message = match request {
            Request::Limits => "an open chain has no limits: remove `limits`, or add a `loop`",
            Request::Sensitivity | Request::VelocityRatioDerivatives | Request::Lanes if !has_quantities => {
                "an open chain has no unknowns to compute: add a `point` or an `output`"
            }
            _ => continue,
        };
        diagnostics.error(span, message);
    }
}

/// Reports a sheet of unknowns that are solved together without formulas: the first group of them.
pub(super) fn sheet(mechanism: &Mechanism, diagnostics: &mut Diagnostics) {
    let Some(&span) = mechanism.requests_at.get(&Request::Sheet) else { return };
    let mut groups =
        mechanism.drivers.iter().flat_map(|driver| driver.system.groups.iter().map(move |group| (driver, group)));
    let without = groups.find(|(_, group)| group.method() == Method::Factorization);
    if let Some((driver, group)) = without {
        let name = |unknown: &UnknownId| format!("`{}`", mechanism.coordinates[driver.unknowns[*unknown]].name.text);
        let names: Vec<String> = group.unknowns.iter().map(name).collect();
        let message = format!(
            "`sheet` writes formulas, but {} of `{}` are solved together, and {} unknowns have no closed form\n\
             remove `sheet`: `Analysis` of the module `analysis` has the same quantities as numbers",
            names.join(", "),
            driver.name,
            names.len(),
        );
        diagnostics.error(span, message);
    }
}

/// A number with its noun, in the plural unless it is 1.
fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// The number of scalar equations, and the statements they come from.
fn sources(rows: usize, loops: usize, equations: usize) -> String {
    let from_loops = (loops > 0).then(|| format!("{} from {}", 2 * loops, counted(loops, "`loop`")));
    let from_equations = (equations > 0).then(|| format!("{equations} from {}", counted(equations, "`equation`")));
    let sources: Vec<String> = from_loops.into_iter().chain(from_equations).collect();
    match sources.as_slice() {
        [] => "no scalar equation".to_owned(),
        sources => format!("{} ({})", counted(rows, "scalar equation"), sources.join(", ")),
    }
}

/// Reports unknowns that too few equations determine, and equations that contain too few unknowns.
fn singularity(mechanism: &Mechanism, driver: &Driver, singular: &StructurallySingular, diagnostics: &mut Diagnostics) {
    let name = |unknown: UnknownId| &mechanism.coordinates[driver.unknowns[unknown]].name;
    let list = |unknowns: &[UnknownId]| {
        let names = unknowns.iter().map(|&unknown| format!("`{}`", name(unknown).text));
        names.collect::<Vec<_>>().join(", ")
    };
    let rows = |count: usize| counted(count, "scalar equation");
    let StructurallySingular { undetermined, too_few, competing, contested } = singular;
    let constraints =
        mechanism.constraints.iter().flat_map(|constraint| constraint.rows.iter().map(|_| constraint.span));
    let spans: Table<RowId, Span> = constraints.collect();
    let contest = format!("{} contain only {}", rows(competing.len()), list(contested));
    if let Some(&first) = undetermined.first() {
        let verb = if undetermined.len() == 1 { "appears" } else { "appear" };
        let what = match too_few.len() {
            0 => format!("{} {verb} in no equation", list(undetermined)),
            count => format!("{} {verb} in only {}", list(undetermined), rows(count)),
        };
        let contest = if competing.is_empty() { String::new() } else { format!(", while {contest}") };
        let message = format!("`{}` cannot be solved at any position: {what}{contest}", driver.name);
        diagnostics.error(name(first).span, message);
    } else if let Some(&last) = competing.last() {
        diagnostics.error(spans[last], format_args!("{contest}, up to this one: use another unknown in one of them"));
    }
}
