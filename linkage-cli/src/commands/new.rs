//! `linkage new`: a first file to edit.

use std::path::{Path, PathBuf};

use linkage_compiler::budget::Budget;
use linkage_compiler::text;

use crate::arguments::New;
use crate::failure::Failure;
use crate::output;

const TEMPLATE: &str = include_str!("four_bar.linkage");

/// The name of the mechanism in the template.
const NAME: &str = "FourBar";

pub fn run(arguments: &New) -> Result<(), Failure> {
    let path = with_ending(&arguments.name);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let name = mechanism_name(&stem);
    let text = TEMPLATE.replace(NAME, &name).replace("FILE", &path.display().to_string());
    // It depends on the name alone whether the text is right.
    if let Err(messages) = text::compile(&text, &Budget::default(), |_| ()) {
        let why: Vec<&str> = messages.iter().map(|message| message.text.as_str()).collect();
        return Err(Failure::Argument(format!("`{stem}` does not name a mechanism: {}", why.join("; "))));
    }
    output::create(&path, text.as_bytes())
}

/// A name is that of a file without its ending.
fn with_ending(name: &Path) -> PathBuf {
    if name.extension().is_some() { name.to_path_buf() } else { name.with_extension("linkage") }
}

/// The name of a mechanism after that of a file: `wind_screen-wiper` is `WindScreenWiper`.
fn mechanism_name(stem: &str) -> String {
    let words = stem.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty());
    words
        .map(|word| {
            let mut letters = word.chars();
            letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect::<String>()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_become_names_of_mechanisms() {
        let names = ["wiper", "wind_screen-wiper", "FourBar", "leg 2", "é", ""];
        assert_eq!(names.map(mechanism_name), ["Wiper", "WindScreenWiper", "FourBar", "Leg2", "É", ""]);
        assert_eq!(with_ending(Path::new("a/wiper")), Path::new("a/wiper.linkage"));
        assert_eq!(with_ending(Path::new("wiper.txt")), Path::new("wiper.txt"));
    }
}
