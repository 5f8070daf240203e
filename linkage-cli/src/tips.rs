//! Wrong arguments: after the message, what to write instead.

use std::error::Error as _;
use std::path::Path;

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, Error, ErrorKind};
use clap::{Arg, Command, CommandFactory};
use linkage_compiler::diagnostics::nearest;

use crate::arguments::Arguments;
use crate::values::Value;

/// The arguments that take `NAME=VALUE`.
const ASSIGNED: [&str; 3] = ["--set", "--at", "--branch"];

/// An error of these words on the command line, with a tip that is meant for them instead of the general one.
pub fn with_tip(mut error: Error, words: &[String]) -> Error {
    let all = Arguments::command();
    let mut command = words.iter().find_map(|word| all.find_subcommand(word)).unwrap_or(&all).clone();
    let Some(ContextValue::String(wrong)) =
        error.get(ContextKind::InvalidArg).or(error.get(ContextKind::InvalidSubcommand))
    else {
        return error;
    };
    // Of several letters in one word, the message has the first.
    let word = words.iter().find(|word| *word == wrong).or(words.iter().find(|word| word.starts_with(wrong.as_str())));
    let word = word.unwrap_or(wrong).clone();
    let tip = match error.kind() {
        ErrorKind::UnknownArgument => {
            for general in [ContextKind::Suggested, ContextKind::SuggestedArg, ContextKind::TrailingArg] {
                error.remove(general);
            }
            let usage = command.clone().bin_name(format!("linkage {}", command.get_name())).render_usage();
            if command.get_name() != all.get_name() {
                error.insert(ContextKind::Usage, ContextValue::StyledStr(usage));
            }
            unknown(&all, &mut command, &word, words)
        }
        ErrorKind::InvalidSubcommand if word.contains('.') || Path::new(&word).exists() => {
            Some(format!("a command comes before the file, as in `linkage check {word}`"))
        }
        ErrorKind::ValueValidation if error.source().is_some_and(|source| source.is::<std::num::ParseIntError>()) => {
            Some("write a whole number, such as `120`".to_owned())
        }
        _ => None,
    };
    if let Some(tip) = tip {
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![StyledStr::from(tip)]));
    }
    error
}

/// A tip: the words that a command takes in place of one that it does not.
fn unknown(all: &Command, command: &mut Command, word: &str, words: &[String]) -> Option<String> {
    command.build();
    let longs: Vec<&str> = command.get_arguments().filter_map(Arg::get_long).collect();
    let has = |long: &str| longs.contains(&long);
    if let Some(rest) = word.strip_prefix("--") {
        let (name, given) = rest.split_once('=').map_or((rest, None), |(name, value)| (name, Some(value)));
        let mut begins = longs.iter().filter(|long| long.starts_with(name));
        // A beginning, if it is that of one alone.
        let begun = begins.next().copied().filter(|_| begins.next().is_none());
        let others =
            all.get_subcommands().filter(|other| other.get_arguments().any(|arg| arg.get_long() == Some(name)));
        let others: Vec<String> = others.map(|other| format!("`linkage {}`", other.get_name())).collect();
        if !others.is_empty() {
            return Some(format!("`--{name}` is an argument of {}", others.join(", ")));
        }
        if let Some(meant) = begun.or_else(|| nearest(name, longs.iter().copied())) {
            return Some(format!("write `--{meant}`"));
        }
        let next = || words.iter().skip_while(|other| *other != word).nth(1).map(String::as_str);
        let value = given.or_else(next).filter(|value| value.parse::<Value>().is_ok() && has("set"));
        return value.map(|value| assignments(&format!("{name}={value}"), has("at")));
    }
    if let Some(rest) = word.strip_prefix('-') {
        if rest.starts_with(|first: char| first.is_ascii_digit() || first == '.') {
            return has("from").then(|| format!("a value follows its argument, as in `--from {word}`"));
        }
        return has(rest).then(|| format!("write `--{rest}`"));
    }
    // `--set l2 25`
    let at = words.iter().position(|other| other == word);
    let before = at.and_then(|at| words.get(at.checked_sub(2)?..at));
    if let Some([long, name]) = before
        && ASSIGNED.contains(&long.as_str())
    {
        return Some(format!("write `{long} {name}={word}`"));
    }
    match word.contains('=') && has("set") {
        true => Some(assignments(word, has("at"))),
        false => Some(format!("`linkage {}` takes one file", command.get_name())).filter(|_| Path::new(word).exists()),
    }
}

/// The form of the value of a name.
fn assignments(assigned: &str, has_at: bool) -> String {
    let input = if has_at { format!(", that of an input `--at {assigned}`") } else { String::new() };
    format!("the value of a parameter is written `--set {assigned}`{input}")
}
