//! The names of a mechanism with mistakes: undeclared coordinates, and declarations that a slip renames.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Ident;

use crate::diagnostics::nearest;
use crate::ids::{CoordinateId, Id, InputId, Table};
use crate::model::kind::Kind;
use crate::model::mechanism::{Coordinate, Driver, Mechanism};
use crate::model::name::Name;
use crate::model::resolver::Assumed;
use crate::model::scope::{Scope, Undeclared};
use crate::syntax::{Statement, StatementKind, can_be_name, is_keyword};

/// Completes a mechanism with mistakes: undeclared coordinates, the order of solution if it is known, and unique field
/// names.
pub(in crate::model) fn complete(
    mechanism: &mut Mechanism,
    statements: &[Statement],
    scope: &Scope,
    assumed: &Assumed,
) {
    rename(mechanism, scope);
    let zero = mechanism.graph.zero();
    for parameter in mechanism.parameters.iter_mut().chain(mechanism.scene_parameters.iter_mut()) {
        parameter.default.get_or_insert(zero);
    }
    let rows = statements.iter().map(|statement| match statement.kind {
        StatementKind::Loop { is_implied: false, .. } => 2,
        StatementKind::Equation { is_implied: false, .. } => 1,
        _ => 0,
    });
    let rows: usize = rows.sum();
    let mut missing = missing(mechanism, statements, scope);
    let declare = |mechanism: &mut Mechanism, name: Ident| {
        let kind = assumed.kinds.iter().find(|(other, _)| name == other).map_or(Kind::Number, |(_, kind)| *kind);
        let known = assumed.symbols.get(&name.to_string()).copied();
        let name = Name::new(&name);
        let symbol = known.unwrap_or_else(|| mechanism.graph.symbol(name.field.clone()));
        mechanism.coordinates.push(Coordinate { kind, ..Coordinate::new(name, Vec::new(), symbol) })
    };
    if mechanism.is_driven_by_choice() {
        let driven = |statement: &Statement| match &statement.kind {
            StatementKind::Drive { by, .. } => by.len(),
            _ => 0,
        };
        let inputs = statements.iter().map(driven).find(|count| *count > 0).unwrap_or(1);
        missing.truncate((rows + inputs).saturating_sub(mechanism.coordinates.len()));
        for name in missing {
            let is_driven = |driver: &Driver| {
                statements.iter().any(|statement| match &statement.kind {
                    StatementKind::Drive { name: of, by } => driver.name == *of && by.contains(&name),
                    _ => false,
                })
            };
            let driven: Vec<bool> = mechanism.drivers.iter().map(is_driven).collect();
            let id = declare(mechanism, name);
            for (driver, is_driven) in mechanism.drivers.iter_mut().zip(driven) {
                match is_driven {
                    true => drop(driver.inputs.push(id)),
                    false => drop(driver.unknowns.push(id)),
                }
            }
        }
    } else {
        let known = mechanism.drivers.first().map_or(0, |driver| driver.unknowns.len());
        let nothing_drives = mechanism.drivers.iter().all(|driver| driver.inputs.is_empty());
        // Inputs are declared before unknowns.
        let first = match nothing_drives && known == 0 {
            true => missing.len().saturating_sub(rows).min(missing.len()),
            false => 0,
        };
        let count = rows.saturating_sub(known).min(missing.len() - first);
        let unknowns: Vec<Ident> = missing.drain(first..first + count).collect();
        // With all unknowns declared, the first other name is the input.
        let inputs = if known == 0 { first } else { usize::from(nothing_drives) };
        let inputs: Vec<Ident> = missing.into_iter().take(inputs).collect();
        for name in inputs {
            let id = declare(mechanism, name);
            for driver in mechanism.drivers.iter_mut() {
                driver.inputs.push(id);
            }
        }
        for name in unknowns {
            let id = declare(mechanism, name);
            for driver in mechanism.drivers.iter_mut() {
                driver.unknowns.push(id);
            }
        }
    }
    let nothing_drives = mechanism.drivers.iter().all(|driver| driver.inputs.is_empty());
    if nothing_drives && let [only] = &*mechanism.drivers {
        let surplus = only.unknowns.len().saturating_sub(rows);
        let inputs: Table<InputId, CoordinateId> = match rows {
            0 => Table::default(),
            _ => only.unknowns.iter().copied().take(surplus).collect(),
        };
        for driver in mechanism.drivers.iter_mut() {
            driver.unknowns = driver.unknowns.iter().copied().filter(|id| !inputs.contains(id)).collect();
            driver.inputs.clone_from(&inputs);
        }
    }
    order(mechanism, rows);
    distinguish(mechanism);
}

/// Removes the coordinates that are reported as unused.
pub(in crate::model) fn without_idle(mechanism: &mut Mechanism, scope: &Scope) {
    let is_idle = |coordinate: &Coordinate| !scope.is_used(coordinate.symbol) && !coordinate.name.text.starts_with('_');
    let idle: BTreeSet<CoordinateId> =
        mechanism.coordinates.enumerated().filter(|(_, coordinate)| is_idle(coordinate)).map(|(id, _)| id).collect();
    let moved = |id: CoordinateId| {
        let before = idle.iter().filter(|other| **other < id).count();
        (!idle.contains(&id)).then(|| CoordinateId::new(id.index() - before))
    };
    for driver in mechanism.drivers.iter_mut() {
        driver.inputs = std::mem::take(&mut driver.inputs).into_iter().filter_map(moved).collect();
        driver.unknowns = std::mem::take(&mut driver.unknowns).into_iter().filter_map(moved).collect();
    }
    let coordinates = std::mem::take(&mut mechanism.coordinates);
    mechanism.coordinates = coordinates.into_iter().filter(|coordinate| !is_idle(coordinate)).collect();
}

/// Renames a declaration that is not used to a similar name that is used more than once but not declared.
fn rename(mechanism: &mut Mechanism, scope: &Scope) {
    for Undeclared { name, .. } in scope.undeclared().iter().filter(|undeclared| undeclared.uses > 1) {
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
        StatementKind::Unread { names, is_list: true, .. } => names.as_slice(),
        _ => &[],
    });
    let undeclared = scope.undeclared().iter().map(|undeclared| &undeclared.name);
    let parameters = mechanism.parameters.iter().map(|parameter| &parameter.name);
    let names = parameters.chain(mechanism.coordinates.iter().map(|coordinate| &coordinate.name));
    let mut taken: BTreeSet<String> = names.map(|name| name.text.clone()).collect();
    let may_be_declared = |name: &&Ident| can_be_name(&name.to_string());
    listed.chain(undeclared).filter(may_be_declared).filter(|name| taken.insert(name.to_string())).cloned().collect()
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

/// Adds an underscore to a field name that is taken or a keyword, and a number if that is taken too.
fn distinguish(mechanism: &mut Mechanism) {
    let Mechanism { parameters, scene_parameters, coordinates, points, outputs, .. } = mechanism;
    let parameters = parameters.iter_mut().chain(scene_parameters.iter_mut()).map(|parameter| &mut parameter.name);
    let symbols = parameters.chain(coordinates.iter_mut().map(|coordinate| &mut coordinate.name));
    let points = points.iter_mut().map(|point| &mut point.name);
    let outputs = outputs.iter_mut().map(|output| &mut output.name);
    for names in [symbols.collect::<Vec<_>>(), points.collect(), outputs.collect()] {
        let (mut taken, mut repeated) = (BTreeSet::new(), BTreeMap::<String, usize>::new());
        for name in names {
            if is_keyword(&name.field) {
                name.field.push('_');
            }
            let written = name.field.clone();
            while !taken.insert(name.field.clone()) {
                let count = repeated.entry(written.clone()).or_default();
                *count += 1;
                name.field = if *count == 1 { format!("{written}_") } else { format!("{written}_{count}") };
            }
        }
    }
}
