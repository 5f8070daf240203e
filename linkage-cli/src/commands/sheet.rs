//! `linkage sheet`: the derivation for readers, also with numbers at a position.

use linkage_compiler::document::Documents;
use linkage_report::lend::Lender;
use linkage_report::sheet::Sheet;

use super::compiled::of_drivers;
use crate::arguments::{self, SheetFormat};
use crate::failure::Failure;
use crate::live::live;
use crate::names::listed;
use crate::output::{self, Form, form, next_to};
use crate::position::Position;
use crate::terminal::say;

const LATEX: [&str; 2] =
    ["\\documentclass{article}\n\\usepackage{amsmath}\n\\allowdisplaybreaks\n\\begin{document}\n", "\\end{document}\n"];

const FORMATS: [SheetFormat; 3] = [SheetFormat::Html, SheetFormat::Latex, SheetFormat::Text];

/// The forms of these formats.
const FORMS: [Form; 3] =
    [("HTML", &["html", "htm"]), ("LaTeX", &["tex", "latex", "ltx"]), ("text", &["txt", "text", "md"])];

pub fn run(arguments: &arguments::Sheet) -> Result<(), Failure> {
    let file = &arguments.numbers.source.file;
    let (asked, by_ending) = (arguments.format, arguments.output.as_deref());
    let of_format = |format: SheetFormat| FORMATS.iter().position(|other| *other == format).unwrap_or_default();
    let place = match (asked, by_ending) {
        (Some(format), Some(output)) => {
            let place = of_format(format);
            form(output, "this sheet", &FORMS[place..=place])?;
            place
        }
        (Some(format), None) => of_format(format),
        (None, Some(output)) => form(output, "a sheet", &FORMS)?.unwrap_or_default(),
        (None, None) => 0,
    };
    if arguments.live && FORMATS[place] != SheetFormat::Html {
        return Err(Failure::Argument("a live sheet is a page: leave out --live, or write -o NAME.html".to_owned()));
    }
    let ending = FORMS[place].1.first().copied().unwrap_or_default();
    let output = arguments.output.clone().unwrap_or_else(|| next_to(file, ending));
    let text = sheets(arguments, FORMATS[place])?;
    let text = if arguments.live { live(&text, arguments)? } else { text };
    output::write(&output, text.as_bytes(), file)?;
    if arguments.live {
        say!("the live sheet has {:.1} MB", text.len() as f64 / 1e6);
    }
    Ok(())
}

/// The sheets of all mechanisms that are meant, or of one with numbers.
fn sheets(arguments: &arguments::Sheet, format: SheetFormat) -> Result<String, Failure> {
    let written = |documents: &Documents, add: &dyn Fn(&mut Sheet<'_>)| -> Result<String, Failure> {
        let lender = Lender::default();
        let Some(mut sheet) = lender.whole(documents)? else { return Ok(String::new()) };
        add(&mut sheet);
        sheet.language(arguments.language.of_sheet());
        Ok(match format {
            SheetFormat::Html => sheet.to_html(),
            SheetFormat::Latex => sheet.to_latex(),
            SheetFormat::Text => sheet.to_text(),
        })
    };
    let text = match Position::of(arguments, format == SheetFormat::Html)? {
        Some((position, documents)) => written(&documents, &|sheet| position.add_to(sheet))?,
        None => {
            let all = of_drivers(&arguments.numbers.source, |lowered| lowered.documents())?;
            if let (SheetFormat::Html, [_, _, ..]) = (format, all.as_slice()) {
                let of = listed(&all.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>());
                let message = format!("a page has one mechanism, and the file has {of}: write --mechanism NAME");
                return Err(Failure::Argument(message));
            }
            let all: Result<Vec<String>, _> = all.iter().map(|(_, one)| written(one, &|_| ())).collect();
            all?.join("\n")
        }
    };
    let [begin, end] = LATEX;
    Ok(if format == SheetFormat::Latex { format!("{begin}{text}{end}") } else { text })
}
