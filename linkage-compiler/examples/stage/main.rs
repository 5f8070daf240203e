//! Prints one stage of the compiler for the mechanisms of a file, as ARCHITECTURE.md shows it:
//!
//! `cargo run -p linkage-compiler --example stage -- FILE STAGE [MECHANISM [FUNCTION]]`
//!
//! FILE is a Rust file with `linkage! { … }`, or a file with the mechanisms alone. Without MECHANISM all of them are
//! printed; with FUNCTION only the functions of this name, also those of scenes and traits.

mod mathematics;
mod mechanism;
mod plan;
mod printed;
mod source;
mod statements;
#[cfg(test)]
mod tests;

use std::env;
use std::process::ExitCode;

use linkage_compiler::derivation::{self, Derivation};
use linkage_compiler::diagnostics::{Diagnostics, suggestion};
use linkage_compiler::model::{Driver, Mechanism};
use linkage_compiler::program::Code;
use linkage_compiler::program::{self, Body, Derived, Function, Program};
use linkage_compiler::{lower, syntax};

/// The text of a function, with the type or trait that it belongs to.
struct Part {
    of: String,
    name: String,
    text: String,
}

/// The printer of a stage.
enum Print {
    /// It prints the syntax tree.
    Tree(fn(&syntax::Mechanism) -> String),
    /// It prints the mechanism as one text.
    Whole(fn(&Mechanism) -> Result<String, String>),
    /// It prints function by function.
    Functions(fn(&Mechanism) -> Result<Vec<Part>, String>),
}

/// The stages in their order, with the data that each shows.
const STAGES: [(&str, &str, Print); 9] = [
    ("statements", "the syntax tree", Print::Tree(statements::text)),
    ("mechanism", "the names resolved, the expressions in the graph", Print::Whole(mechanism::text)),
    ("groups", "the order of solution", Print::Whole(mathematics::groups)),
    ("derivation", "the mathematics", Print::Whole(mathematics::text)),
    ("document", "the derivation for readers", Print::Whole(printed::document)),
    ("plan", "the planned functions", Print::Functions(plan::functions)),
    ("code", "the lowered functions", Print::Functions(printed::code)),
    ("rust", "the emitted Rust", Print::Functions(printed::rust)),
    ("fpcore", "the formulas of functions as FPCore", Print::Functions(printed::fpcore)),
];

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    match run(&arguments.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// The text of a stage, or the message of a mistake.
fn run(arguments: &[&str]) -> Result<String, String> {
    let (file, stage, mechanism, function) = match *arguments {
        [file, stage] => (file, stage, None, None),
        [file, stage, mechanism] => (file, stage, Some(mechanism), None),
        [file, stage, mechanism, function] => (file, stage, Some(mechanism), Some(function)),
        _ => return Err(usage()),
    };
    let stages = || STAGES.iter().map(|(name, ..)| *name);
    let Some((_, _, print)) = STAGES.iter().find(|(name, ..)| *name == stage) else {
        return Err(format!("there is no stage `{stage}`: write {}", any_of(stages())));
    };
    if let (Some(function), Print::Tree(_) | Print::Whole(_)) = (function, print) {
        let with = STAGES.iter().filter(|(.., print)| matches!(print, Print::Functions(_))).map(|(name, ..)| *name);
        return Err(format!("the stage `{stage}` has no functions such as `{function}`: write {}", any_of(with)));
    }
    let is_asked = |name: &dyn ToString| mechanism.is_none_or(|asked| asked == name.to_string());
    let (mut names, mut texts) = (Vec::new(), Vec::new());
    for body in source::bodies(file)? {
        let mut outside = Diagnostics::default();
        let trees = syntax::parse(body.clone(), &mut outside);
        names.extend(trees.iter().map(|tree| tree.name.to_string()));
        // Other invocations may have mistakes.
        if mechanism.is_some() && !trees.iter().any(|tree| is_asked(&tree.name)) {
            continue;
        }
        if !outside.is_empty() {
            return Err(in_file(file, &outside.messages()));
        }
        if let Print::Tree(print) = print {
            texts.extend(trees.iter().filter(|tree| is_asked(&tree.name)).map(print));
            continue;
        }
        let mechanisms = linkage_compiler::read(body).map_err(|messages| in_file(file, &messages))?;
        for mechanism in mechanisms.iter().filter(|mechanism| is_asked(&mechanism.name)) {
            let text = match print {
                Print::Tree(_) => continue,
                Print::Whole(print) => print(mechanism),
                Print::Functions(print) => print(mechanism).and_then(|parts| listed(parts, stage, mechanism, function)),
            };
            texts.push(text.map_err(|message| in_file(file, &[message]))?);
        }
    }
    match mechanism {
        Some(asked) if texts.is_empty() => {
            Err(format!("there is no mechanism `{asked}` in {file}: write {}", any_of(names)))
        }
        None if texts.is_empty() => Err(source::without_mechanism(file)),
        _ => Ok(texts.join("\n")),
    }
}

fn usage() -> String {
    let mut text = "write FILE STAGE [MECHANISM [FUNCTION]]; the stages are".to_owned();
    STAGES.iter().for_each(|(name, of, _)| text += &format!("\n  {name:10} {of}"));
    text
}

/// The names, as a choice.
fn any_of<S: AsRef<str>>(names: impl IntoIterator<Item = S>) -> String {
    let names: Vec<String> = names.into_iter().map(|name| format!("`{}`", name.as_ref())).collect();
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
        None => "a file that has some".to_owned(),
    }
}

fn in_file(file: &str, messages: &[String]) -> String {
    format!("{file}: {}", messages.join("\n"))
}

/// The functions with a name, or all, each type and trait once as a title.
fn listed(parts: Vec<Part>, stage: &str, mechanism: &Mechanism, asked: Option<&str>) -> Result<String, String> {
    if let Some(asked) = asked
        && !parts.iter().any(|part| part.name == asked)
    {
        let meant = suggestion(asked, parts.iter().map(|part| part.name.as_str()));
        let meant = if meant.is_empty() { ": leave it out for all functions" } else { meant.as_str() };
        return Err(format!("there is no function `{asked}` of `{}` in the stage `{stage}`{meant}", mechanism.name));
    }
    let (mut text, mut title) = (String::new(), String::new());
    for part in parts.into_iter().filter(|part| asked.is_none_or(|asked| part.name == asked)) {
        if part.of != title {
            text += &format!("{}{}\n", if title.is_empty() { "" } else { "\n" }, part.of);
            title = part.of;
        }
        text += &format!("\n{}\n", part.text.trim_end());
    }
    Ok(text)
}

/// The mathematics and the planned program of a driver.
type Planned = (Derivation, Program<Body, Derived>);

/// Derives, checks and plans one driver.
fn planned(mechanism: &Mechanism, driver: &Driver) -> Result<Planned, String> {
    let spent = |_| format!("`{}` exceeds the compiler's budget of work", mechanism.name);
    mechanism.graph.budget().spend(derivation::matrices(mechanism, driver)).map_err(spent)?;
    let (mut derivation, mut diagnostics) = (derivation::derive(mechanism, driver), Diagnostics::default());
    let is_right = derivation::check(mechanism, driver, &mut derivation, &mut diagnostics);
    if !is_right {
        return Err(diagnostics.messages().join("\n"));
    }
    let program = program::plan(mechanism, driver, &mut derivation).map_err(spent)?;
    Ok((derivation, program))
}

/// The lowered program of a driver.
fn lowered(mechanism: &Mechanism, driver: &Driver) -> Result<Program<Code>, String> {
    let (derivation, program) = planned(mechanism, driver)?;
    let (program, _) = lower::program(program, &derivation).map_err(|dangling| dangling.to_string())?;
    Ok(program)
}

/// Visits the functions of a driver, of its scenes and of the traits of both, each with its type or trait.
fn each_function<B, D>(program: &Program<B, D>, visit: &mut dyn FnMut(&str, &Function<B>)) {
    let mut all = |of: &str, functions: &mut dyn Iterator<Item = &Function<B>>| {
        functions.for_each(|function| visit(of, function));
    };
    all(&program.signatures.types.itself, &mut program.functions.iter());
    for implementation in &program.implementations {
        all(&implementation.title(), &mut implementation.functions.iter());
    }
    for scene in &program.scenes {
        all(&scene.signatures.types.itself, &mut scene.functions.iter());
        if let Some(implementation) = &scene.implementation {
            all(&implementation.title(), &mut implementation.functions.iter());
        }
    }
    if let Some(any_number) = &program.any_number {
        all("over numbers of any kind", &mut any_number.functions.iter());
    }
}
