//! The mechanism with resolved names: declarations, residuals and quantities as the graph has them.

use linkage_compiler::graph::NodeId;
use linkage_compiler::model::{Account, Body, ContactLaw, Mechanism, Parameter, Request, Scene};

pub fn text(mechanism: &Mechanism) -> Result<String, String> {
    let of = |node: NodeId| mechanism.graph.text(node);
    let mut text = format!("mechanism {}\n", mechanism.name);
    let mut line = |line: String| text += &format!("  {line}\n");
    mechanism.parameters.iter().for_each(|one| line(parameter(one, mechanism)));
    mechanism.scene_parameters.iter().for_each(|one| line(format!("{}, of scenes", parameter(one, mechanism))));
    for one in mechanism.coordinates.iter() {
        line(format!("coordinate {}: {}", one.name.text, one.kind));
    }
    for driver in mechanism.drivers.iter() {
        let names = |ids: &mut dyn Iterator<Item = _>| {
            ids.map(|id| mechanism.coordinates[id].name.text.clone()).collect::<Vec<_>>().join(", ")
        };
        let [inputs, unknowns] =
            [names(&mut driver.inputs.iter().copied()), names(&mut driver.unknowns.iter().copied())];
        line(format!("driver {}: from {inputs} to {unknowns}", driver.name));
    }
    for (word, all) in [("constraint", &mechanism.constraints), ("implied", &mechanism.implied)] {
        let rows = all.iter().flat_map(|constraint| &constraint.rows);
        rows.for_each(|row| line(format!("{word} 0 = {}", of(*row))));
    }
    mechanism.named.iter().for_each(|(node, name)| line(format!("let {name} = {}", of(*node))));
    mechanism.points.iter().for_each(|one| line(format!("point {} = ({}, {})", one.name.text, of(one.x), of(one.y))));
    mechanism.outputs.iter().for_each(|one| line(format!("output {} = {}", one.name.text, of(one.value))));
    for one in &mechanism.ranges {
        let [least, most] = one.ends.map(|end| end.map_or_else(String::new, of));
        line(format!("range {} in {least}..{most}", one.name));
    }
    for one in &mechanism.externals {
        let names: Vec<&str> = one.names.iter().map(|name| name.text.as_str()).collect();
        line(format!("extern ({}) -> ({})", one.arguments.join(", "), names.join(", ")));
    }
    let requests = Request::ALL.iter().filter(|(_, request)| mechanism.requests.contains(request));
    requests.for_each(|(keyword, _)| line(format!("derive {keyword}")));
    mechanism.bodies.iter().for_each(|one| line(body(one, mechanism)));
    mechanism.scenes.iter().flat_map(|one| scene(one, mechanism)).for_each(line);
    Ok(text)
}

fn parameter(one: &Parameter, mechanism: &Mechanism) -> String {
    let default = one.default.map_or_else(String::new, |default| format!(" = {}", mechanism.graph.text(default)));
    format!("parameter {}{default}: {}", one.name.text, one.kind)
}

fn body(one: &Body, mechanism: &Mechanism) -> String {
    let of = |node: NodeId| mechanism.graph.text(node);
    let mut line = format!("body {}", one.name.text);
    if let Some((mass, [x, y])) = one.mass {
        line += &format!(", mass {} at ({}, {})", of(mass), of(x), of(y));
    }
    if let Some((inertia, angle)) = one.inertia {
        line += &format!(", inertia {} about {}", of(inertia), of(angle));
    }
    line
}

/// A line for the scene and for each effect: a law acts along a scalar.
fn scene(one: &Scene, mechanism: &Mechanism) -> Vec<String> {
    let of = |node: NodeId| mechanism.graph.text(node);
    let mut lines = vec![format!("scene {} of {}", one.name, mechanism.drivers[one.driver].name)];
    for &id in one.inertia.iter().flatten() {
        lines.push(format!("  inertia of {}", mechanism.bodies[id].name.text));
    }
    for &(id, [x, y]) in &one.weights {
        lines.push(format!("  weight of {} in ({}, {})", mechanism.bodies[id].name.text, of(x), of(y)));
    }
    for law in &one.laws {
        let account = match law.account {
            Account::Stored(energy) => format!("stored as {}", of(energy)),
            Account::Dissipated => "dissipated".to_owned(),
            Account::Applied => "applied".to_owned(),
        };
        lines.push(format!("  {}: {} along {}, {account}", law.label, of(law.law), of(law.along)));
    }
    for contact in &one.contacts {
        let law = match &contact.law {
            ContactLaw::Friction(factors) => {
                format!(
                    "friction up to {}",
                    factors.iter().map(|factor| of(*factor)).collect::<Vec<_>>().join(" times ")
                )
            }
            ContactLaw::Stop { range: [from, to], restitution } => {
                format!("stop at {} and {}, restitution {}", of(*from), of(*to), of(*restitution))
            }
        };
        lines.push(format!("  {}: {law} along {}", contact.label, of(contact.along)));
    }
    lines.extend(one.drives.iter().map(|drive| format!("  drive = {}", of(drive.law))));
    lines
}
