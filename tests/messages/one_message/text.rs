//! The mechanism of each program as a text: its mistakes are the messages that rustc shows for the macro, at the same lines
//! and columns.

use linkage_compiler::budget::Budget;
use linkage_compiler::text;

use super::{Message, Planted, entry, planted};
use crate::checked::snapshot;

/// The inside of each invocation of a program, with blanks for all around it: lines and columns stay as they are.
pub fn insides(program: &str) -> Vec<String> {
    const BEFORE: &str = "linkage! {";
    program.match_indices(BEFORE).map(|(at, _)| inside(program, at + BEFORE.len())).collect()
}

/// The inside of the invocation that begins here.
fn inside(program: &str, start: usize) -> String {
    let mut depth = 1;
    let end = program[start..].find(|letter| {
        depth += i32::from(letter == '{') - i32::from(letter == '}');
        depth == 0
    });
    let end = start + end.expect("its end");
    let is_inside = |at| (start..end).contains(&at);
    let blank = |(at, letter)| if is_inside(at) || letter == '\n' { letter } else { ' ' };
    program.char_indices().map(blank).collect()
}

/// The messages of a program's text as those of rustc, with the ends of its marks.
fn messages(one: &Planted) -> Vec<Message> {
    let found = text::compile(&insides(&one.program).remove(0), &Budget::default(), |_| ()).err().unwrap_or_default();
    let of = |found: text::Message| {
        let from = (found.line, found.column);
        let mark = one.marks.iter().find(|(start, _)| *start == from);
        let to = mark.map_or((found.line, found.column + found.length), |(_, end)| *end);
        // Tokens over several lines are marked to the end of the first.
        let lines: Vec<&str> = one.program.lines().collect();
        let last = if to.0 == from.0 { to.1 } else { lines[from.0 - 1].trim_end().chars().count() + 1 };
        assert_eq!(found.length, last - found.column, "{}: {found}", one.mistake.0);
        let text = [Some(found.text), found.help].into_iter().flatten().collect::<Vec<_>>().join("\n");
        Message { level: "error".to_owned(), code: None, text, from, to }
    };
    found.into_iter().map(of).collect()
}

/// A snapshot, its lines in an order of their own.
fn expected(one: &Planted) -> Vec<String> {
    let of_macro = snapshot(one.list, one.mistake.0);
    sorted(&FOR_RUST.iter().fold(of_macro, |message, hint| message.replace(hint, "")))
}

/// Hints of the macro that a text without Rust cannot follow.
const FOR_RUST: [&str; 3] = [
    "; declare a user function with `extern fn`",
    ": put the cases into a user function, `extern fn`",
    ": put cases into a user function, `extern fn`",
];

/// The messages with all their lines, in the order of their texts.
fn sorted(entry: &str) -> Vec<String> {
    let mut messages: Vec<String> = Vec::new();
    for line in entry.trim_end().lines() {
        match messages.last_mut() {
            Some(last) if line.starts_with("    ") => *last += line,
            _ => messages.push(line.to_owned()),
        }
    }
    messages.sort();
    messages
}

/// True if rustc has a message of its own for a program.
pub fn has_one_of_rust(one: &Planted) -> bool {
    expected(one).iter().any(|line| is_of_rust(line))
}

/// True for what Rust itself says: of names outside of the macro, and of characters before it is called.
fn is_of_rust(message: &str) -> bool {
    message.contains(" error[E") || message.contains(" error: prefix `")
}

#[test]
fn a_text_has_the_messages_of_the_macro() {
    let planted = planted();
    let (mut different, mut compared, mut of_rust) = (Vec::new(), 0, 0);
    for one in &planted {
        let (others, expected): (Vec<_>, Vec<_>) = expected(one).into_iter().partition(|line| is_of_rust(line));
        let found = messages(one);
        (compared, of_rust) = (compared + found.len(), of_rust + others.len());
        let found = sorted(&entry(one.mistake, &one.program, &found));
        if found != expected {
            different.push(format!("{}\n{}", found.join("\n"), expected.join("\n")));
        }
    }
    assert!(different.is_empty(), "{} of {} differ\n{}", different.len(), planted.len(), different.join("\n\n"));
    println!("{} programs, {compared} messages, {of_rust} of Rust itself", planted.len());
    assert!(compared > 500 && of_rust == 2, "{compared} messages, {of_rust} of Rust itself");
}
