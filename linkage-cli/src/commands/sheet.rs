//! `linkage sheet`: the derivation for readers.

use std::path::{Path, PathBuf};

use super::compiled::of_drivers;
use super::documents::Documents;
use crate::arguments::{Sheet, SheetFormat};
use crate::failure::Failure;
use crate::names::listed;
use crate::output;
use crate::source::is_standard;

const LATEX: [&str; 2] =
    ["\\documentclass{article}\n\\usepackage{amsmath}\n\\allowdisplaybreaks\n\\begin{document}\n", "\\end{document}\n"];

pub fn run(arguments: &Sheet) -> Result<(), Failure> {
    let all = of_drivers(&arguments.source, Documents::of)?;
    let mut text = String::new();
    match arguments.format {
        SheetFormat::Html => match all.as_slice() {
            [(_, one)] => text = one.page()?,
            several => {
                let of = listed(&several.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>());
                let message = format!("a page has one mechanism, and the file has {of}: write --mechanism NAME");
                return Err(Failure::Argument(message));
            }
        },
        SheetFormat::Latex => {
            let [begin, end] = LATEX;
            text += begin;
            for (_, one) in &all {
                one.each(|document| text += &document.to_latex())?;
            }
            text += end;
        }
        SheetFormat::Text => {
            for (_, one) in &all {
                one.each(|document| text += &document.to_text())?;
            }
        }
    }
    output::write(&place(arguments), text.as_bytes(), &arguments.source.file)
}

/// The file to write: by default next to the file of the mechanism.
fn place(arguments: &Sheet) -> PathBuf {
    let ending = match arguments.format {
        SheetFormat::Html => "html",
        SheetFormat::Latex => "tex",
        SheetFormat::Text => "txt",
    };
    let file = &arguments.source.file;
    let default = || if is_standard(file) { Path::new("-").to_path_buf() } else { file.with_extension(ending) };
    arguments.output.clone().unwrap_or_else(default)
}
