//! `linkage names`: what the arguments of the other commands can name.

use std::fmt::Write;

use linkage_compiler::model::{Measure, Request};
use serde::Serialize;

use crate::about::{About, all};
use crate::arguments::{Names, NamesFormat};
use crate::columns::{self, OF_POINT, ORDERS};
use crate::failure::Failure;
use crate::machine::Named;
use crate::output;
use crate::scene::AboutScene;
use crate::source::read;

pub fn run(arguments: &Names) -> Result<(), Failure> {
    let all = all(&read(&arguments.source.file)?, arguments.source.mechanism.as_deref(), &[Request::Drawing], |_| ())?;
    let lists: Vec<List> = all.iter().map(|(about, ..)| List::of(about)).collect();
    let text = match arguments.format {
        NamesFormat::Json => {
            serde_json::to_string_pretty(&lists).map_err(|error| Failure::Outside(error.to_string()))? + "\n"
        }
        NamesFormat::Text => lists.iter().map(List::to_text).collect::<Vec<_>>().join("\n"),
    };
    output::print(text.as_bytes())
}

/// The names of a mechanism.
#[derive(Serialize)]
struct List {
    mechanism: String,
    parameters: Vec<Parameter>,
    inputs: Vec<Input>,
    branch: Vec<Choice>,
    guess: Vec<String>,
    unknowns: Vec<String>,
    points: Vec<String>,
    outputs: Vec<String>,
    columns: Vec<String>,
    scenes: Vec<Scene>,
}

#[derive(Serialize)]
struct Parameter {
    name: String,
    default: Option<String>,
    kind: String,
}

#[derive(Serialize)]
struct Input {
    name: String,
    kind: &'static str,
}

#[derive(Serialize)]
struct Choice {
    name: String,
    words: Vec<String>,
    meaning: String,
}

#[derive(Serialize)]
struct Scene {
    name: String,
    /// The commands that take it.
    commands: Vec<&'static str>,
    /// Its parameters that the mechanism does not have.
    parameters: Vec<Parameter>,
}

impl Scene {
    fn of(about: &AboutScene) -> Self {
        let commands = [("simulate", about.has_inertia), ("equilibrium", about.has_equilibrium)];
        let parameters = about.parameters.iter().zip(&about.defaults);
        Self {
            name: about.name.clone(),
            commands: commands.into_iter().filter(|(_, takes)| *takes).map(|(command, _)| command).collect(),
            parameters: parameters.map(|((name, measure), default)| Parameter::of(name, default, *measure)).collect(),
        }
    }
}

impl Parameter {
    fn of(name: &str, default: &Option<String>, kind: Measure) -> Self {
        Self { name: name.to_owned(), default: default.clone(), kind: kind.to_string() }
    }

    fn line(&self) -> [String; 3] {
        let default = self.default.as_deref().unwrap_or("no default");
        [self.name.clone(), default.to_owned(), self.kind.clone()]
    }
}

impl List {
    fn of(about: &About) -> Self {
        let texts = |names: &[Named]| names.iter().map(|name| name.text.clone()).collect::<Vec<_>>();
        let unknowns: Vec<String> = about.unknowns.iter().map(|unknown| unknown.name.text.clone()).collect();
        let parameters = about.parameters.iter().zip(&about.defaults);
        let parameters = parameters.map(|(name, (default, measure))| Parameter::of(name, default, *measure));
        let inputs = about.inputs.iter().map(|input| Input {
            name: input.name.text.clone(),
            kind: if input.is_angle { "angle in radians" } else { "length or number" },
        });
        let branch = about.groups.iter().map(|group| Choice {
            name: group.name.clone(),
            words: group.words.clone(),
            meaning: group.meaning.clone(),
        });
        let columns = columns::names([&about.inputs, &about.unknowns], [&about.points, &about.outputs], true);
        Self {
            mechanism: about.name.clone(),
            parameters: parameters.collect(),
            inputs: inputs.collect(),
            branch: branch.collect(),
            guess: about.guessed.iter().map(|place| unknowns[*place].clone()).collect(),
            points: texts(&about.points),
            outputs: texts(&about.outputs),
            unknowns,
            columns,
            scenes: about.scenes.iter().map(Scene::of).collect(),
        }
    }

    fn to_text(&self) -> String {
        let mut text = format!("{}\n", self.mechanism);
        section(&mut text, "parameters (--set)", self.parameters.iter().map(Parameter::line));
        section(
            &mut text,
            "inputs (--at, --along)",
            self.inputs.iter().map(|of| [of.name.clone(), of.kind.to_owned()]),
        );
        let words = |words: &[String]| if words.is_empty() { "a whole number".to_owned() } else { words.join(" or ") };
        let of_groups = self.branch.iter().map(|of| [of.name.clone(), words(&of.words), of.meaning.replace('`', "")]);
        section(&mut text, "choices (--branch)", of_groups);
        section(&mut text, "unknowns without a closed form (--guess)", self.guess.iter().map(|name| [name.clone()]));
        let inputs: Vec<String> = self.inputs.iter().map(|input| input.name.clone()).collect();
        let each = |names: &[String], ends: &[&str]| {
            let ends: Vec<&str> = ends.iter().copied().filter(|end| !end.is_empty()).collect();
            [names.join(", "), format!("each with {}", ends.join(", "))]
        };
        let of_time = ["time".to_owned(), "with --rate, in s".to_owned()];
        let as_they_are = |names: &[String]| [names.join(", "), String::new()];
        let unknowns = [as_they_are(&self.unknowns), each(&self.unknowns, &ORDERS)];
        let points = [each(&self.points, &OF_POINT)];
        let outputs = [as_they_are(&self.outputs), each(&self.outputs, &ORDERS)];
        let columns = [as_they_are(&inputs), of_time].into_iter().chain(unknowns).chain(points).chain(outputs);
        section(&mut text, "columns (table --columns)", columns.filter(|[names, _]| !names.is_empty()));
        let of_scenes = self.scenes.iter().map(|scene| {
            let commands =
                if scene.commands.is_empty() { "by a program in Rust".to_owned() } else { scene.commands.join(", ") };
            [scene.name.clone(), commands]
        });
        section(&mut text, "scenes (--scene)", of_scenes);
        for scene in &self.scenes {
            let head = format!("parameters of the scene {} (--set)", scene.name);
            section(&mut text, &head, scene.parameters.iter().map(Parameter::line));
        }
        text
    }
}

/// A head, and lines whose parts are below each other; nothing without lines.
fn section<const N: usize>(text: &mut String, head: &str, lines: impl Iterator<Item = [String; N]>) {
    let lines: Vec<[String; N]> = lines.collect();
    if lines.is_empty() {
        return;
    }
    let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or_default();
    let widths: Vec<usize> = (0..N).map(width).collect();
    // Writing to a string does not fail.
    _ = writeln!(text, "{head}");
    for line in &lines {
        let parts: Vec<String> = line.iter().zip(&widths).map(|(part, width)| format!("{part:width$}")).collect();
        _ = writeln!(text, "  {}", parts.join("  ").trim_end());
    }
}
