//! `linkage check`: the mistakes of all files, or a line for each mechanism.

use std::path::Path;

use linkage_compiler::model::Mechanism;

use super::compiled::compiled;
use crate::arguments::{Check, MessageFormat};
use crate::failure::Failure;
use crate::messages::Item;
use crate::mistakes::Mistakes;
use crate::output;
use crate::source::read;
use crate::terminal::say;

pub fn run(arguments: &Check) -> Result<(), Failure> {
    let (mut right, mut wrong) = (String::new(), Vec::new());
    for file in &arguments.files {
        match checked(file) {
            Ok(lines) => right += &lines,
            Err(mistakes) => wrong.push(mistakes),
        }
    }
    match arguments.format {
        MessageFormat::Json => {
            let items: Vec<Item<'_>> = wrong.iter().flat_map(Mistakes::items).collect();
            let json = serde_json::to_string_pretty(&items).map_err(|error| Failure::Outside(error.to_string()))?;
            output::print(format!("{json}\n").as_bytes())?;
            if wrong.is_empty() { Ok(()) } else { Err(Failure::Reported) }
        }
        MessageFormat::Text => {
            output::print(right.as_bytes())?;
            if wrong.is_empty() { Ok(()) } else { Err(Failure::Mistakes(wrong)) }
        }
    }
}

/// A line for each mechanism of a file.
fn checked(file: &Path) -> Result<String, Mistakes> {
    let source = read(file)?;
    let compiled = compiled(&source, |_| ())?;
    for mechanism in compiled.iter().map(|of| &of.mechanism) {
        if let Some(name) = mechanism.externals.iter().find_map(|of| Some(&of.names.first()?.text)) {
            let driver = mechanism.drivers.iter().next().map(|driver| driver.name.to_string()).unwrap_or_default();
            say!(
                "{}: note: `{driver}` calls `{name}`, which a program in Rust has to give it: here it has no numbers",
                source.name
            );
        }
    }
    Ok(compiled.iter().map(|of| format!("{}: {}\n", source.name, summary(&of.mechanism))).collect())
}

/// A mechanism in one line.
fn summary(mechanism: &Mechanism) -> String {
    let drivers = mechanism.drivers.iter().map(|driver| driver.name.to_string()).collect::<Vec<_>>().join(", ");
    let count = |number: usize, of: &str| format!("{number} {of}{}", if number == 1 { "" } else { "s" });
    let freedom = mechanism.drivers.iter().next().map_or(0, |driver| driver.inputs.len());
    format!(
        "{drivers}: no mistakes; {} of freedom, {}, {}",
        if freedom == 1 { "1 degree".to_owned() } else { format!("{freedom} degrees") },
        count(mechanism.points.len(), "point"),
        count(mechanism.outputs.len(), "output"),
    )
}
