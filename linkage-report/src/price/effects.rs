//! The cost of the effects of a scene, by the operations of their formulas.

use std::collections::{BTreeMap, BTreeSet};

use linkage_runtime::derivation::{
    Effect, ElementaryFunction as Function, Equation, Formula, FormulaView, Operations, SceneDerivation,
};

use super::prediction::Machine;

/// The cost of a body or an effect in a right-hand side.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct EffectPrice {
    /// Its name in error messages: "spring on theta3".
    pub name: String,
    /// The operations of its contribution to the forces, of which common ones count once. Sines and cosines of coordinates
    /// are those of the pose.
    pub operations: Operations,
    /// Those of them that no other body or effect has: without it, a right-hand side has so many less.
    pub alone: Operations,
    /// The calls of user functions, whose operations are not known.
    pub calls: Vec<String>,
    /// True if its formula has a part that is too long to be printed, whose operations are not known.
    pub is_shortened: bool,
    /// The time of the operations that are known, in seconds.
    pub predicted: f64,
}

/// The bodies, effects, frictions and stops of a scene.
pub(super) fn effects(derivation: &SceneDerivation<'_>, machine: &Machine) -> Vec<EffectPrice> {
    let forces = derivation.forces.iter().map(|Effect { name, forces }| (*name, forces.to_vec()));
    let contacts = derivation.frictions_and_stops.iter().map(|contact| {
        // The law and the scalar, which the runtime takes, in place of the force that it finds.
        let bound = Equation { left: contact.along.left, right: contact.bound };
        (contact.name, contact.forces.iter().copied().chain([contact.along, bound]).collect())
    });
    // One effect may be listed in several parts.
    let mut named: Vec<(&str, BTreeMap<u32, Formula<'_>>)> = Vec::new();
    for (name, equations) in forces.chain(contacts) {
        let equations: Vec<Equation<'_>> = equations;
        let place = named.iter().position(|(other, _)| *other == name).unwrap_or_else(|| {
            named.push((name, BTreeMap::new()));
            named.len() - 1
        });
        equations.iter().for_each(|equation| nodes(equation.right, &mut named[place].1));
    }
    let priced = named.iter().enumerate().map(|(place, (name, all))| {
        let others = named.iter().enumerate().filter(|(other, _)| *other != place);
        let others: BTreeSet<u32> = others.flat_map(|(_, (_, nodes))| nodes.keys().copied()).collect();
        let count = |formulas: &mut dyn Iterator<Item = &Formula<'_>>| {
            super::prediction::sum(formulas.map(|formula| operations(*formula)))
        };
        let operations = count(&mut all.values());
        let alone = count(&mut all.iter().filter(|(number, _)| !others.contains(number)).map(|(_, formula)| formula));
        let calls = all.values().filter_map(|formula| match formula.view() {
            FormulaView::External(name, ..) => Some(name.to_owned()),
            _ => None,
        });
        EffectPrice {
            name: (*name).to_owned(),
            operations,
            alone,
            calls: calls.collect(),
            is_shortened: all.values().any(|formula| matches!(formula.view(), FormulaView::Ellipsis)),
            predicted: machine.time::<f64>(operations),
        }
    });
    priced.collect()
}

/// The nodes of a formula by their numbers.
fn nodes<'a>(formula: Formula<'a>, all: &mut BTreeMap<u32, Formula<'a>>) {
    if all.insert(formula.number(), formula).is_some() {
        return;
    }
    match formula.view() {
        FormulaView::Sum(terms) => terms.iter().for_each(|(_, term)| nodes(term, all)),
        FormulaView::Product(list)
        | FormulaView::Call(_, list)
        | FormulaView::External(_, _, list)
        | FormulaView::AtMost(list) => list.iter().for_each(|part| nodes(part, all)),
        FormulaView::Quotient(one, other) | FormulaView::Multiple(one, other) => {
            nodes(one, all);
            nodes(other, all);
        }
        FormulaView::Power(of, _) | FormulaView::NonZero(of) | FormulaView::Exists(of) => nodes(of, all),
        _ => {}
    }
}

/// The operations of the sine or cosine of an angle. Those of coordinates are in the pose, and those of a sum of them follow
/// by the addition theorem.
fn of_pose(angle: Formula<'_>) -> Operations {
    let is_name = |formula: Formula<'_>| matches!(formula.view(), FormulaView::Name(_));
    match angle.view() {
        FormulaView::Name(_) => Operations::default(),
        FormulaView::Sum(terms) if terms.iter().all(|(_, term)| is_name(term)) => {
            let sums = terms.iter().len().saturating_sub(1);
            Operations { functions: 0, divisions: 0, multiplications: 2 * sums, additions: sums }
        }
        _ => Operations { functions: 1, ..Operations::default() },
    }
}

/// The operations of a node alone.
fn operations(formula: Formula<'_>) -> Operations {
    let none = Operations::default();
    match formula.view() {
        FormulaView::Sum(terms) => Operations { additions: terms.iter().len().saturating_sub(1), ..none },
        FormulaView::Product(factors) => Operations { multiplications: factors.iter().len().saturating_sub(1), ..none },
        FormulaView::Multiple(..) => Operations { multiplications: 1, ..none },
        FormulaView::Quotient(..) => Operations { divisions: 1, ..none },
        // By squares and products.
        FormulaView::Power(_, exponent) => {
            let products = exponent.checked_ilog2().unwrap_or(0) + exponent.count_ones().saturating_sub(1);
            Operations { multiplications: products as usize, ..none }
        }
        FormulaView::Call(Function::Sin | Function::Cos, arguments) => arguments.only().map_or(none, of_pose),
        FormulaView::Call(..) => Operations { functions: 1, ..none },
        _ => none,
    }
}
