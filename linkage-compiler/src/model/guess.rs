//! Completion of a mechanism with mistakes, so that its stub has the names that the rest of the program uses.

use std::collections::BTreeSet;

use proc_macro2::Ident;

use super::kind::Kind;
use super::mechanism::{Coordinate, Mechanism};
use super::name::Name;
use super::scope::Scope;
use crate::diagnostics::nearest;
use crate::ids::{CoordinateId, InputId, Table};
use crate::syntax::{Statement, StatementKind};

/// Completes a mechanism with mistakes: undeclared coordinates, the order of solution if it is known, and unique field
/// names.
pub(super) fn complete(
    mechanism: &mut Mechanism,
    statements: &[Statement],
    scope: &Scope,
    undeclared_kinds: &[(String, Kind)],
) {
    rename(mechanism, scope);
    let rows = statements.iter().map(|statement| match statement.kind {
        StatementKind::Loop { is_implied: false, .. } => 2,
        StatementKind::Equation { is_implied: false, .. } => 1,
        _ => 0,
    });
    let rows: usize = rows.sum();
    let mut missing = missing(mechanism, statements, scope).into_iter();
    let declare = |mechanism: &mut Mechanism, name: Ident| {
        let kind = undeclared_kinds.iter().find(|(other, _)| name == other).map_or(Kind::Number, |(_, kind)| *kind);
        let name = Name::new(&name);
        let symbol = mechanism.graph.symbol(name.field.clone());
        mechanism.coordinates.push(Coordinate { name, attributes: Vec::new(), symbol, rate: None, kind })
    };
    let known = mechanism.drivers.first().map_or(0, |driver| driver.unknowns.len());
    for name in missing.by_ref().take(rows.saturating_sub(known)) {
        let index = declare(mechanism, name);
        for driver in mechanism.drivers.iter_mut() {
            driver.unknowns.push(index);
        }
    }
    let nothing_drives = mechanism.drivers.iter().all(|driver| driver.inputs.is_empty());
    if nothing_drives && let [only] = &*mechanism.drivers {
        // Inputs are declared before unknowns.
        let surplus = only.unknowns.len().saturating_sub(rows);
        let inputs: Table<InputId, CoordinateId> = match rows {
            0 => Table::default(),
            _ if surplus > 0 => only.unknowns.iter().copied().take(surplus).collect(),
            _ => missing.next().map(|name| declare(mechanism, name)).into_iter().collect(),
        };
        for driver in mechanism.drivers.iter_mut() {
            driver.unknowns = driver.unknowns.iter().copied().filter(|id| !inputs.contains(id)).collect();
            driver.inputs.clone_from(&inputs);
        }
    }
    order(mechanism, rows);
    distinguish(mechanism);
}

/// Renames a declaration that is not used to a similar name that is used more than once but not declared.
fn rename(mechanism: &mut Mechanism, scope: &Scope) {
    for (name, _) in scope.undeclared().iter().filter(|(_, uses)| *uses > 1) {
        let parameters = mechanism.parameters.iter_mut().map(|parameter| (&mut parameter.name, parameter.symbol));
        let coordinates = mechanism.coordinates.iter_mut().map(|coordinate| (&mut coordinate.name, coordinate.symbol));
        let unused = parameters.chain(coordinates).filter(|(_, symbol)| !scope.is_used(*symbol));
        let mut unused: Vec<&mut Name> = unused.map(|(name, _)| name).collect();
        let like = nearest(&name.to_string(), unused.iter().map(|name| name.text.as_str())).map(str::to_owned);
        if let Some(meant) = like.and_then(|like| unused.iter_mut().find(|name| name.text == like)) {
            **meant = Name::new(name);
        }
    }
}

/// The names that may be coordinates: those of lists with an unknown keyword, then other undeclared ones.
fn missing(mechanism: &Mechanism, statements: &[Statement], scope: &Scope) -> Vec<Ident> {
    let listed = statements.iter().flat_map(|statement| match &statement.kind {
        StatementKind::Unread { names, is_list: true } => names.as_slice(),
        _ => &[],
    });
    let undeclared = scope.undeclared().iter().map(|(name, _)| name);
    let parameters = mechanism.parameters.iter().map(|parameter| &parameter.name);
    let names = parameters.chain(mechanism.coordinates.iter().map(|coordinate| &coordinate.name));
    let mut taken: BTreeSet<String> = names.map(|name| name.text.clone()).collect();
    listed.chain(undeclared).filter(|name| taken.insert(name.to_string())).cloned().collect()
}

/// Finds the order of solution if all equations could be read.
fn order(mechanism: &mut Mechanism, rows: usize) {
    let read: usize = mechanism.constraints.iter().map(|constraint| constraint.rows.len()).sum();
    for id in mechanism.drivers.ids() {
        let is_known = read == rows && rows == mechanism.drivers[id].unknowns.len();
        let system = is_known.then(|| mechanism.ordered(id).ok());
        mechanism.drivers[id].system = system.flatten().unwrap_or_default();
    }
}

/// Adds underscores to field names until they are unique.
fn distinguish(mechanism: &mut Mechanism) {
    let Mechanism { parameters, scene_parameters, coordinates, points, outputs, .. } = mechanism;
    let parameters = parameters.iter_mut().chain(scene_parameters.iter_mut()).map(|parameter| &mut parameter.name);
    let symbols = parameters.chain(coordinates.iter_mut().map(|coordinate| &mut coordinate.name));
    let points = points.iter_mut().map(|point| &mut point.name);
    let outputs = outputs.iter_mut().map(|output| &mut output.name);
    for names in [symbols.collect::<Vec<_>>(), points.collect(), outputs.collect()] {
        let mut taken = BTreeSet::new();
        for name in names {
            while !taken.insert(name.field.clone()) {
                name.field.push('_');
            }
        }
    }
}
