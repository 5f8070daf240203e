//! Both forms of u'' in the sheet of every mechanism of the gallery whose groups have one or two unknowns, and the
//! identities that join them.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use linkage_compiler::derivation::{Derivation, Row, Sheet};
use linkage_compiler::graph::{Graph, NodeId, Number};
use linkage_compiler::ids::{Id, RowId, Table, UnknownId};
use linkage_equality::{Answer, Reason, compare};
use rustc_hash::FxHashMap;

/// The derivation of a driver with the formulas of its sheet, and W v'.
struct Derived {
    name: String,
    derivation: Derivation,
    sheet: Sheet,
    through_ratios: Table<UnknownId, NodeId>,
}

impl Derived {
    fn rate(&mut self, unknown: UnknownId) -> NodeId {
        let column = self.derivation.unknowns[unknown];
        self.derivation.graph.variable(self.derivation.coordinates[column].rate)
    }

    /// Panics unless two expressions are equal, which are sums of a quadratic form of rates and a linear one of
    /// accelerations. Long ones are compared by their parts: with one acceleration, and with two rates at a time.
    fn equal(&mut self, one: NodeId, other: NodeId, what: &str) {
        let name = self.name.clone();
        let graph = &mut self.derivation.graph;
        let answer = compare(graph, one, other);
        if answer != Answer::Undecided(Reason::TooManyTerms) {
            assert_eq!(answer, Answer::Equal, "{what} of {name}");
            return;
        }
        let coordinates = &self.derivation.coordinates;
        let rates: Vec<NodeId> = coordinates.iter().map(|coordinate| graph.variable(coordinate.rate)).collect();
        let bent: Vec<NodeId> = coordinates.iter().map(|coordinate| graph.variable(coordinate.acceleration)).collect();
        let pairs = (0..rates.len()).flat_map(|first| (first..rates.len()).map(move |second| (first, second)));
        let pairs = pairs.map(|(first, second)| vec![rates[first], rates[second]]);
        let parts: Vec<Vec<NodeId>> = bent.iter().map(|&one| vec![one]).chain(pairs).collect();
        let zero = graph.zero();
        for kept in parts {
            let others = rates.iter().chain(&bent).filter(|node| !kept.contains(node));
            let by: FxHashMap<NodeId, NodeId> = others.map(|&node| (node, zero)).collect();
            let part = graph.replace(&[one, other], &by);
            assert_eq!(compare(graph, part[0], part[1]), Answer::Equal, "a part of {what} of {name}");
        }
    }
}

/// The drivers of the gallery with groups of one or two unknowns, and the number of all others.
fn gallery() -> (Vec<Derived>, usize) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dev/gallery/src/mechanisms");
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let (mut all, mut others) = (Vec::new(), 0);
    for path in paths {
        let file = syn::parse_file(&fs::read_to_string(&path).unwrap()).unwrap();
        let bodies = file.items.into_iter().filter_map(|item| match item {
            syn::Item::Macro(item) if item.mac.path.is_ident("linkage") => Some(item.mac.tokens),
            _ => None,
        });
        for mechanism in bodies.flat_map(|body| linkage_compiler::read(body).unwrap()) {
            for (driver, mut derivation) in mechanism.drivers.iter().zip(linkage_compiler::derive(&mechanism)) {
                if derivation.groups.iter().any(|group| group.determinant.is_none()) {
                    others += 1;
                    continue;
                }
                let sheet = Sheet::of(&mut derivation, &mechanism);
                let ratios = derivation.ratio_formulas();
                let inputs: Vec<_> =
                    derivation.inputs.iter().map(|&input| derivation.coordinates[input].rate).collect();
                let graph = &mut derivation.graph;
                let through_ratios = derivation.unknowns.ids().map(|unknown| {
                    let terms: Vec<_> = ratios
                        .iter()
                        .zip(&inputs)
                        .map(|(of, &rate)| {
                            let rate = graph.variable(rate);
                            (Number::ONE, graph.multiply(of[unknown].unwrap(), rate))
                        })
                        .collect();
                    graph.sum(&terms)
                });
                let through_ratios = through_ratios.collect();
                all.push(Derived { name: driver.name.to_string(), derivation, sheet, through_ratios });
            }
        }
    }
    (all, others)
}

fn dot<C: Id + Ord>(graph: &mut Graph, row: &Row<C>, column: &Table<C, NodeId>) -> NodeId {
    let terms: Vec<_> =
        row.iter().map(|(&place, &entry)| (Number::ONE, graph.multiply(entry, column[place]))).collect();
    graph.sum(&terms)
}

/// With u' = W v' the difference of both forms is zero. Without, they are different wherever a rate of an unknown enters. For
/// the few whose difference is too long the next test proves it: J of it is J' (W v' - u').
#[test]
fn both_forms_of_the_accelerations_are_equal() {
    let (all, others) = gallery();
    assert!(all.len() > 60 && others > 5, "{} and {others}", all.len());
    let (mut different, mut equal, mut long) = (0, 0, BTreeSet::new());
    for mut derived in all {
        let unknowns: Vec<UnknownId> = derived.derivation.unknowns.ids().collect();
        let by: FxHashMap<NodeId, NodeId> =
            unknowns.iter().map(|&unknown| (derived.rate(unknown), derived.through_ratios[unknown])).collect();
        for &unknown in &unknowns {
            let pair = derived.sheet.accelerations.each_ref().map(|all| all[unknown]);
            different += usize::from(compare(&derived.derivation.graph, pair[0], pair[1]) == Answer::Different);
            let [first, second] = pair.map(|node| derived.derivation.graph.replace(&[node], &by)[0]);
            match compare(&derived.derivation.graph, first, second) {
                Answer::Undecided(Reason::TooManyTerms) => {
                    long.insert(derived.name.clone());
                }
                answer => {
                    assert_eq!(
                        answer,
                        Answer::Equal,
                        "the acceleration of unknown {} of {}",
                        unknown.number(),
                        derived.name
                    );
                    equal += 1;
                }
            }
        }
    }
    assert!(different > 100 && equal > 200, "{different}, {equal}");
    assert_eq!(long, ["Distances"].map(str::to_owned).into());
}

/// J u'' of the second form less that of the first is J' (W v' - u'), for any rates: the identity that joins them.
#[test]
fn their_difference_is_that_of_the_rates() {
    for mut derived in gallery().0 {
        let rates: Table<UnknownId, NodeId> =
            derived.derivation.unknowns.ids().map(|unknown| derived.rate(unknown)).collect();
        for group in derived.derivation.groups.clone() {
            for &row in &group.equations {
                let graph = &mut derived.derivation.graph;
                let [first, second] = &derived.sheet.accelerations;
                let of_group = derived.derivation.jacobian[row].iter().filter_map(|(column, &entry)| {
                    let unknown = *group.unknowns.iter().find(|&&one| derived.derivation.unknowns[one] == *column)?;
                    let difference = graph.subtract(second[unknown], first[unknown]);
                    Some((Number::ONE, graph.multiply(entry, difference)))
                });
                let of_group: Vec<_> = of_group.collect();
                let left = graph.sum(&of_group);
                let late: Table<UnknownId, NodeId> = rates
                    .iter()
                    .zip(&derived.through_ratios)
                    .map(|(&rate, &through)| graph.subtract(through, rate))
                    .collect();
                let right = dot(graph, &derived.sheet.jacobian_rates.0[row], &late);
                derived.equal(left, right, &format!("row {}", row.number()));
            }
        }
    }
}

/// gamma is J' u' + A' v', and the sum of its parts. H0 is the sum of H1, H2 and H3.
#[test]
fn gamma_is_the_sum_of_its_parts() {
    let mut mixed = 0;
    for mut derived in gallery().0 {
        let rates: Table<UnknownId, NodeId> =
            derived.derivation.unknowns.ids().map(|unknown| derived.rate(unknown)).collect();
        let inputs = derived.derivation.inputs.iter().map(|&input| derived.derivation.coordinates[input].rate);
        let inputs: Vec<_> = inputs.collect();
        let graph = &mut derived.derivation.graph;
        let inputs = inputs.into_iter().map(|rate| graph.variable(rate)).collect();
        let rows: Vec<RowId> = derived.derivation.residual.ids().collect();
        for row in rows {
            let graph = &mut derived.derivation.graph;
            let (of_unknowns, of_inputs) = &derived.sheet.jacobian_rates;
            let (one, other) = (dot(graph, &of_unknowns[row], &rates), dot(graph, &of_inputs[row], &inputs));
            let product = graph.add(one, other);
            let parts = derived.sheet.gamma.each_ref().map(|part| (Number::ONE, part[row]));
            let sum = graph.sum(&parts);
            mixed += usize::from(!graph.is_zero(parts[2].1));
            let gamma = derived.derivation.gamma[row];
            derived.equal(gamma, product, "gamma as a product");
            derived.equal(gamma, sum, "gamma as a sum");
        }
    }
    assert!(mixed > 5, "{mixed}");
}
