//! The groups in the order of solution, and the derivation.

use linkage_compiler::derivation::{Derivation, Quantity};
use linkage_compiler::graph::NodeId;
use linkage_compiler::ids::Id;
use linkage_compiler::model::Mechanism;

/// A line for each group: its kind, its unknowns and its equations.
pub fn groups(mechanism: &Mechanism) -> Result<String, String> {
    Ok(each(mechanism, |derivation| of_groups(derivation, |_| String::new())))
}

/// Psi and its Jacobian, the determinants of the groups, gamma, and the rates of points and outputs.
pub fn text(mechanism: &Mechanism) -> Result<String, String> {
    Ok(each(mechanism, |derivation| {
        let of = |node: NodeId| derivation.graph.text(node);
        let name = |symbol| derivation.graph.symbol_name(symbol);
        let mut text = String::new();
        for ((row, residual), entries) in derivation.residual.enumerated().zip(derivation.jacobian.iter()) {
            text += &format!("  Psi_{} = {}\n", row.number(), of(*residual));
            for (column, entry) in entries {
                let coordinate = &derivation.coordinates[*column].name;
                text += &format!("    d Psi_{} / d {coordinate} = {}\n", row.number(), of(*entry));
            }
        }
        text += &of_groups(derivation, of);
        for (input, ratios) in derivation.ratios.enumerated() {
            let names: Vec<&str> = ratios.iter().map(|symbol| name(*symbol)).collect();
            let input = &derivation.coordinates[derivation.inputs[input]].name;
            text += &format!("  velocity ratios by {input}: {}\n", names.join(", "));
        }
        for (row, gamma) in derivation.gamma.enumerated() {
            text += &format!("  gamma_{} = {}\n", row.number(), of(*gamma));
        }
        let of_all = |word: &str, names: Vec<&str>, all: &[Quantity]| -> String {
            let of_one = |(name, one): (&str, &Quantity)| {
                let list = |nodes: &[NodeId]| nodes.iter().map(|node| of(*node)).collect::<Vec<_>>().join(", ");
                format!("  {word} {name} = ({})\n    rate ({})\n", list(&one.value), list(&one.rate))
            };
            names.into_iter().zip(all).map(of_one).collect()
        };
        let points = mechanism.points.iter().map(|point| point.name.text.as_str()).collect();
        let outputs = mechanism.outputs.iter().map(|output| output.name.text.as_str()).collect();
        text + &of_all("point", points, &derivation.points) + &of_all("output", outputs, &derivation.outputs)
    }))
}

/// The text of each driver, with its name as a title.
fn each(mechanism: &Mechanism, text: impl Fn(&Derivation) -> String) -> String {
    let derivations = linkage_compiler::derive(mechanism);
    let drivers = mechanism.drivers.iter().zip(&derivations);
    drivers.map(|(driver, derivation)| format!("{}\n{}", driver.name, text(derivation))).collect()
}

/// The groups, each with its determinant if the text of one is not empty.
fn of_groups(derivation: &Derivation, determinant: impl Fn(NodeId) -> String) -> String {
    let mut text = String::new();
    for (number, group) in derivation.groups.iter().enumerate() {
        let equations: Vec<String> = group.equations.iter().map(|row| format!("Psi_{}", row.number())).collect();
        let [kind, unknowns] = [group.kind.description(), group.names(derivation)];
        text += &format!("  group {}: {unknowns} from {}: {kind}\n", number + 1, equations.join(", "));
        if let Some(of) = group.determinant {
            let value = determinant(of.value);
            let name = derivation.graph.symbol_name(of.symbol);
            text += &if value.is_empty() { value } else { format!("    {name} = {value}\n") };
        }
    }
    if derivation.groups.is_empty() { "  no groups: an open chain\n".to_owned() } else { text }
}
