//! Lowering of all functions of a planned program.

use std::collections::BTreeSet;

use super::function::{Code, Context, function};
use super::rounding::Roundings;
use super::works::Works;
use crate::derivation::Derivation;
use crate::program::{Access, Body, Derived, Function, Program, SceneProgram};

/// Lowers all functions of a driver and of its scenes.
#[must_use]
pub fn program<'a>(planned: Program<'a, Body>, derivation: &Derivation) -> Program<'a, Code> {
    let Program { signatures, position, functions, implementations, columns, scenes, any_number, derived } = planned;
    let Some(derived) = derived else {
        let functions = functions.into_iter().map(Function::without_body).collect();
        let any_number = any_number.map(|any_number| any_number.map(Function::without_body));
        let implementations = implementations.into_iter().map(|of| of.map(Function::without_body)).collect();
        let scenes = Vec::new();
        return Program {
            signatures,
            position,
            functions,
            implementations,
            columns,
            scenes,
            any_number,
            derived: None,
        };
    };
    let reserved = signatures.arguments.reserved();
    let mut context = context(derivation, &derived, &reserved, &signatures.arguments, Works::default());
    let functions: Vec<_> = functions.into_iter().map(|planned| function(planned, &mut context)).collect();
    let functions = without_branches(functions);
    let functions = ordered(functions, &signatures.all(&position));
    let works = context.works.renamed(|name| signatures.types.function(name));
    let is_left = |name: &str| functions.iter().any(|function| function.name == name);
    let implementations = implementations.into_iter().map(|of| of.without_choice(is_left));
    let implementations = implementations.map(|of| of.map(|planned| function(planned, &mut context))).collect();
    let any_number = any_number.map(|any_number| any_number.map(|planned| function(planned, &mut context)));
    let scenes = scenes.into_iter().map(|scene| {
        let SceneProgram { signatures, functions, implementation } = scene;
        let mut reserved = signatures.arguments.reserved();
        reserved.insert(signatures.field.clone());
        let mut context = self::context(derivation, &derived, &reserved, &signatures.arguments, works.clone());
        let functions = functions.into_iter().map(|planned| function(planned, &mut context)).collect();
        let functions = ordered(functions, &signatures.all());
        let implementation = implementation.map(|of| of.map(|planned| function(planned, &mut context)));
        SceneProgram { signatures, functions, implementation }
    });
    let scenes = scenes.collect();
    Program { signatures, position, functions, implementations, columns, scenes, any_number, derived: Some(derived) }
}

/// Removes the functions for a lane that have branches, and those after them: lanes are then computed one by one.
fn without_branches(functions: Vec<Function<Code>>) -> Vec<Function<Code>> {
    let has_branches = |function: &Function<Code>| {
        function.access == Access::Lane && function.body.as_ref().is_some_and(|code| !code.is_branch_free)
    };
    let end = functions.iter().position(has_branches).unwrap_or(functions.len());
    let is_kept = |(place, function): &(usize, Function<Code>)| *place < end || function.access != Access::Lane;
    functions.into_iter().enumerate().filter(is_kept).map(|(_, function)| function).collect()
}

/// Sorts functions from the order of planning (callees first) to the order of their signatures; private ones come last.
fn ordered(mut functions: Vec<Function<Code>>, order: &[Function<Body>]) -> Vec<Function<Code>> {
    let place = |function: &Function<Code>| order.iter().position(|other| other.name == function.name);
    functions.sort_by_key(|function| place(function).unwrap_or(order.len()));
    functions
}

fn context<'c>(
    derivation: &'c Derivation,
    derived: &'c Derived,
    reserved: &'c BTreeSet<String>,
    arguments: &'c crate::program::Arguments,
    works: Works,
) -> Context<'c> {
    Context {
        derivation,
        pose: &derived.pose,
        named: &derived.named,
        reserved,
        pose_argument: &arguments.pose,
        branch: &arguments.branch,
        turn: &arguments.turn,
        memory: &arguments.memory,
        works,
        roundings: Roundings::new(&derived.pose),
    }
}
