//! Two types of one name in an invocation: each is one message, on the name that the user wrote.

use std::collections::{BTreeMap, BTreeSet};

use crate::diagnostics::Diagnostics;
use crate::model::{Mechanism, TypeName};
use crate::program::emitted_types;

/// Reports types of one name in different mechanisms; returns the places of those that are not emitted.
pub(crate) fn find<'a>(
    mechanisms: impl Iterator<Item = &'a Mechanism> + Clone,
    diagnostics: &mut Diagnostics,
) -> BTreeSet<usize> {
    // A mechanism that is configured out may have any name.
    let all: Vec<(usize, &Mechanism)> = mechanisms
        .enumerate()
        .filter(|(_, mechanism)| !mechanism.everywhere.iter().any(|attribute| attribute.path().is_ident("cfg")))
        .collect();
    // The mechanisms that emit a type of each name, in order.
    let mut emitting: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (own, (_, mechanism)) in all.iter().enumerate() {
        let names: BTreeSet<String> = emitted_types(mechanism).into_values().flatten().collect();
        names.into_iter().for_each(|name| emitting.entry(name).or_default().push(own));
    }
    let declared_by: Vec<BTreeSet<String>> =
        all.iter().map(|(_, mechanism)| declared(mechanism).into_iter().map(ToString::to_string).collect()).collect();
    let mut clashing = BTreeSet::new();
    for (own, (place, mechanism)) in all.iter().enumerate() {
        for name in declared(mechanism) {
            let text = name.to_string();
            let other = emitting.get(&text).into_iter().flatten().copied().find(|&other| {
                // Of two declarations, the later clashes.
                let is_declared = declared_by[other].contains(&text);
                other != own && !clashing.contains(&all[other].0) && (!is_declared || other < own)
            });
            if let Some(other) = other {
                report(name, &all[other].1.name, diagnostics);
                clashing.insert(*place);
                break;
            }
        }
    }
    clashing
}

/// The names of types that the user wrote.
fn declared(mechanism: &Mechanism) -> Vec<&TypeName> {
    let drivers = mechanism.drivers.iter().map(|driver| &driver.name);
    let scenes = mechanism.scenes.iter().map(|scene| &scene.name);
    std::iter::once(&mechanism.name).chain(drivers).chain(scenes).collect()
}

/// Reports drivers and scenes that have the name of another type of their mechanism, and removes them.
pub(crate) fn within(mechanism: &mut Mechanism, diagnostics: &mut Diagnostics) {
    let types = emitted_types(mechanism);
    let mut owners: BTreeMap<&str, usize> = BTreeMap::new();
    for names in types.values() {
        for name in names {
            *owners.entry(name).or_default() += 1;
        }
    }
    let clashing: BTreeSet<String> = declared(mechanism)
        .into_iter()
        .map(ToString::to_string)
        .filter(|name| owners.get(name.as_str()).is_some_and(|count| *count > 1))
        .collect();
    let own = mechanism.name.clone();
    let mut clashes = |name: &TypeName| {
        let clashes = clashing.contains(&name.to_string()) && *name != own;
        if clashes {
            report(name, &own, diagnostics);
        }
        clashes
    };
    let scenes = std::mem::take(&mut mechanism.scenes);
    mechanism.scenes = scenes.into_iter().filter(|scene| !clashes(&scene.name)).collect();
    let clashing: Vec<_> =
        mechanism.drivers.enumerated().filter(|(_, driver)| clashes(&driver.name)).map(|(id, _)| id).collect();
    for id in clashing.into_iter().rev() {
        mechanism.remove_driver(id);
    }
}

fn report(name: &TypeName, of: &TypeName, diagnostics: &mut Diagnostics) {
    let message = match name == of {
        true => format!("the type `{name}` is declared twice: choose another name"),
        false => format!("the type `{name}` is emitted for `{of}` as well: choose another name"),
    };
    diagnostics.error(name.span(), message);
}
