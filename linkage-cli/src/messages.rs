//! Mistakes for readers, with the marked line, and for editors, as JSON.

use std::fmt::Write;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use linkage_compiler::text::Message;
use serde::Serialize;

use crate::mistakes::{Mistake, Mistakes};

impl Mistakes {
    /// Writes them for readers: `file:line:column: message`, and the line with the marked token.
    pub fn to_text(&self) -> String {
        let name = &self.source.name;
        let line = |mistake: &Mistake| match mistake {
            Mistake::Text(message) => {
                format!("{BOLD}{name}:{message}{BOLD:#}\n{}", marked(&self.source.text, message))
            }
            Mistake::File(message) => format!("{BOLD}{name}: {message}{BOLD:#}\n"),
        };
        self.all.iter().map(line).collect()
    }

    /// The mistakes as items of the array for editors.
    pub fn items(&self) -> impl Iterator<Item = Item<'_>> {
        let file = self.source.name.as_str();
        self.all.iter().map(move |mistake| match mistake {
            Mistake::Text(message) => Item {
                file,
                line: Some(message.line),
                column: Some(message.column),
                length: Some(message.length),
                text: &message.text,
                help: message.help.as_deref(),
            },
            Mistake::File(text) => Item { file, line: None, column: None, length: None, text, help: None },
        })
    }
}

const BOLD: anstyle::Style = anstyle::Style::new().bold();

/// A mistake as an editor reads it; a file that cannot be read has no place.
#[derive(Serialize)]
pub struct Item<'a> {
    file: &'a str,
    line: Option<usize>,
    column: Option<usize>,
    length: Option<usize>,
    text: &'a str,
    help: Option<&'a str>,
}

/// The line of a message with its marked characters, and its help. A message about the whole text marks nothing.
fn marked(text: &str, message: &Message) -> String {
    let mut shown = String::new();
    let line = text.strip_prefix('\u{feff}').unwrap_or(text).lines().nth(message.line.saturating_sub(1));
    if let Some(line) = line.filter(|_| message.length > 0) {
        let first = message.column.saturating_sub(1);
        let [from, to] = [first, first + message.length].map(|character| byte_of(line, character));
        let snippet = Snippet::source(line).line_start(message.line).annotation(AnnotationKind::Primary.span(from..to));
        shown += &Renderer::styled().render(&[Group::with_level(Level::ERROR).element(snippet)]);
        shown.push('\n');
    }
    for help in message.help.iter().flat_map(|help| help.lines()) {
        let _ = writeln!(shown, "  {BOLD}help:{BOLD:#} {}", help.trim_start_matches("help: "));
    }
    if !shown.is_empty() {
        shown.push('\n');
    }
    shown
}

/// The byte at which a character of a line begins.
fn byte_of(line: &str, character: usize) -> usize {
    line.char_indices().nth(character).map_or(line.len(), |(byte, _)| byte)
}
