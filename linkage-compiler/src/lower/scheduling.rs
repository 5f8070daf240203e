//! Scheduling: from the steps and formulas of a kernel to straight-line code.

use std::collections::BTreeSet;

use linkage_ir::ValueId;

use super::order::Ordering;
use super::schedule::{Line, Schedule};
use super::translate::Builder;
use super::value::Signed;
use super::{factors, joined, sharing, terms};
use crate::derivation::Step;
use crate::graph::{Graph, NodeId, SymbolId};
use crate::program::Given;

/// Makes the schedule of the steps of a kernel and the formulas of its results.
#[must_use]
pub fn schedule(
    graph: &Graph,
    steps: &[Step],
    results: &[NodeId],
    given: &Given,
    named: &[(NodeId, String)],
    is_inlined: bool,
) -> Schedule {
    let mut nodes: Vec<NodeId> = steps.iter().flat_map(Step::nodes).collect();
    nodes.extend(results);
    let introduced: BTreeSet<SymbolId> = steps.iter().flat_map(Step::introduced).collect();
    let (mut values, translated) = Builder::translate_all(graph, given, &nodes);
    let roots: Vec<Signed> = nodes.iter().map(|node| translated[node]).collect();
    graph.budget().count(nodes.len() + values.len());
    sharing::share(&mut values, &roots, graph.budget(), is_inlined);
    joined::join(&mut values, &roots, is_inlined);
    factors::order(&mut values);
    let known = terms::order(&mut values, steps);
    let mut names: Vec<(ValueId, bool, String)> = Vec::new();
    for (node, name) in named {
        if let Some(Signed { negative, value }) = translated.get(node).copied() {
            names.push((value, negative, name.clone()));
        }
    }
    // Names of a value come after those of its negative, so that they are preferred.
    names.sort_by_key(|(value, negative, _)| (*value, !negative));
    let mut ordering = Ordering::new(graph, values, &roots);
    ordering.gather_sines(&introduced);
    let signed = |nodes: &[NodeId]| -> Vec<Signed> { nodes.iter().map(|node| translated[node]).collect() };
    for step in steps {
        for node in step.nodes() {
            let Signed { negative, value } = translated[&node];
            // The name of a negative does not serve other uses of the value.
            let is_named =
                matches!(step, Step::Let { .. } | Step::Turn { .. }) && !(negative && ordering.is_shared(value));
            ordering.require(value, is_named);
        }
        ordering.lines.push(match step {
            Step::Let { symbol, node } => Line::Name { symbol: *symbol, value: translated[node] },
            Step::Turn { symbol, principal, range } => Line::Turn {
                symbol: *symbol,
                principal: translated[principal],
                range: range.map(|range| range.map(|end| translated[&end])),
            },
            Step::Guard { group, determinant, scale } => {
                Line::Guard { group: *group, determinant: translated[determinant], scale: translated[scale] }
            }
            Step::Factor { group, matrix, row_scales } => {
                let matrix = matrix.iter().map(|row| signed(row)).collect();
                Line::Factor { group: *group, matrix, row_scales: signed(row_scales) }
            }
            Step::Solve { group, targets, right } => {
                Line::Solve { group: *group, targets: targets.clone(), right: signed(right) }
            }
            Step::Chord { group, symbol, factors, size, of } => Line::Chord {
                group: *group,
                symbol: *symbol,
                factors: factors.map(|node| translated[&node]),
                size: translated[size],
                of: of.map(|node| translated[&node]),
            },
            Step::Reach { group, length } => Line::Reach { group: *group, length: translated[length] },
            Step::Solvable { group, determinant, numerators, scales } => Line::Solvable {
                group: *group,
                determinant: translated[determinant],
                numerators: signed(numerators),
                scales: signed(scales),
            },
            Step::Pivots { symbol, matrix } => {
                Line::Pivots { symbol: *symbol, matrix: matrix.iter().map(|row| signed(row)).collect() }
            }
            Step::Newton { group, targets, start, system, .. } => {
                let system = Box::new(schedule(graph, &[], system, given, &[], false));
                let (targets, start) = (targets.clone(), signed(start));
                Line::Newton { group: *group, targets, start, system }
            }
            Step::Modes { group, targets, loops, system, .. } => {
                let part = |part: &[NodeId; 2]| part.map(|node| translated[&node]);
                Line::Modes {
                    group: *group,
                    targets: targets.clone(),
                    constants: loops.constants.iter().map(part).collect(),
                    factors: loops.factors.iter().map(|factors| factors.iter().map(part).collect()).collect(),
                    unknowns: loops.unknowns.clone(),
                    guides: loops
                        .guides
                        .iter()
                        .map(|guide| guide.map(|guide| guide.map(|node| translated[&node])))
                        .collect(),
                    system: Box::new(schedule(graph, &[], system, given, &[], false)),
                }
            }
        });
    }
    let results = signed(results);
    for result in &results {
        ordering.require(result.value, false);
    }
    let used = ordering.used();
    let Ordering { values, lines, .. } = ordering;
    Schedule { values, known, lines, results, names, used }
}
