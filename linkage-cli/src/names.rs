//! Names among those that there are.

use std::collections::BTreeSet;

use linkage_compiler::diagnostics::suggestion;

use crate::failure::Failure;

/// The place of a name in a list, or the failure that nothing of this kind has it.
pub fn place(of: &str, kind: &str, name: &str, names: &[&str]) -> Result<usize, Failure> {
    let found = names.iter().position(|other| *other == name);
    found.ok_or_else(|| {
        let meant = suggestion(name, names.iter().copied());
        let meant = if meant.is_empty() { format!(": it has {}", listed(names)) } else { meant };
        // The other kinds are names in a mechanism.
        let list = match (kind, meant.ends_with('?')) {
            ("mechanism", _) => "",
            (_, true) => " `linkage names` lists all names",
            (_, false) => "; `linkage names` lists all names",
        };
        Failure::Argument(format!("{of} has no {kind} `{name}`{meant}{list}"))
    })
}

/// Names in a sentence.
pub fn listed(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => "none".to_owned(),
    }
}

/// The failure that an option names one thing twice.
pub fn once<'n>(option: &str, names: impl IntoIterator<Item = &'n str>) -> Result<(), Failure> {
    let mut known = BTreeSet::new();
    match names.into_iter().find(|name| !known.insert(*name)) {
        Some(name) => Err(Failure::Argument(format!("{option} has `{name}` twice: write it once"))),
        None => Ok(()),
    }
}
