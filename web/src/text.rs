//! Texts: their mechanisms, or their mistakes with the places that editors count.

use linkage_compiler::derivation::Reach;
use linkage_compiler::emit::Declared;
use linkage_compiler::graph::Number;
use linkage_compiler::ids::CoordinateId;
use linkage_compiler::model::VECTOR_FUNCTIONS;
use linkage_compiler::model::{self, Kind, Measure, Mechanism, Request, output_angles};
use linkage_compiler::program::Code;
use linkage_compiler::program::SceneProgram;
use linkage_compiler::syntax::{EFFECTS, KEYWORDS, PROPERTIES};

use linkage_compiler::text::Message;
use linkage_compiler::{Lowered, emit};
use linkage_interpreter::Program;
use proc_macro2::TokenStream;
use quote::quote;
use serde::Serialize;

use crate::Refusal;
use crate::about::{About, Parameter, Quantity, Scene};
use crate::machine::Machine;

/// The steps of the compiler: some seconds.
const MOST_STEPS: usize = linkage_compiler::budget::MOST_STEPS;

/// A mistake; its place is counted in units of UTF-16, as in the page.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Mistake {
    from: usize,
    to: usize,
    line: usize,
    column: usize,
    text: String,
    help: Option<String>,
}

/// The words of the language, for the colours of the editor and for completion.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Words {
    keywords: Vec<String>,
    functions: Vec<String>,
}

/// The words of the language.
pub fn words() -> Words {
    let keywords = ["mechanism"].iter().chain(&KEYWORDS).map(|word| (*word).to_owned());
    let of_scenes = EFFECTS.iter().chain(&PROPERTIES).map(|word| (*word).to_owned());
    let functions = linkage_compiler::graph::written().map(|row| row.function.name().to_owned());
    let of_vectors = VECTOR_FUNCTIONS.iter().map(|(name, _)| (*name).to_owned());
    Words { keywords: keywords.chain(of_scenes).collect(), functions: functions.chain(of_vectors).collect() }
}

/// The mechanisms of a text, or its mistakes.
pub fn compile(text: &str) -> Result<Vec<Machine>, Vec<Mistake>> {
    let compiled = Program::compile_with_within(text, MOST_STEPS, &[Request::Drawing], |lowered| {
        let documents = lowered.documents();
        let Declared { mechanism, driver } = lowered.declared;
        let reach = Reach::of(mechanism, driver, &lowered.derivation);
        (About { paragraphs: documents.about.clone(), ..about(&lowered) }, documents, reach)
    });
    let compiled =
        compiled.map_err(|messages| messages.iter().map(|message| mistake(text, message)).collect::<Vec<_>>())?;
    let machines = compiled.into_iter().map(|(mechanism, (about, documents, reach))| {
        let mut machine = Machine { about, documents, mechanism, reach: Some(reach) };
        let refusal = || machine.mechanism.design().prepared().err().map(|error| error.to_string());
        machine.about.refusal = machine.about.refusal.take().or_else(refusal);
        machine
    });
    Ok(machines.collect())
}

/// The mechanisms of a text for the file of a live sheet, which runs without the compiler; they are the answer to
/// [`Question::Load`](crate::Question::Load).
///
/// # Errors
/// The first mistake of the text.
pub fn compiled(text: &str) -> Result<String, Refusal> {
    let first =
        |mistakes: Vec<Mistake>| Refusal::new(mistakes.into_iter().next().map(|one| one.text).unwrap_or_default());
    Machine::written(compile(text).map_err(first)?)
}

/// A message with its place in the text.
fn mistake(text: &str, message: &Message) -> Mistake {
    let units = |text: &str| text.encode_utf16().count();
    let lines: Vec<&str> = text.split('\n').collect();
    let before: usize = lines.iter().take(message.line.saturating_sub(1)).map(|line| units(line) + 1).sum();
    let line = lines.get(message.line.saturating_sub(1)).copied().unwrap_or_default();
    let column = |count: usize| line.chars().take(count).map(char::len_utf16).sum::<usize>();
    let first = message.column.saturating_sub(1);
    Mistake {
        from: before + column(first),
        to: before + column(first + message.length),
        line: message.line,
        column: message.column,
        text: message.text.clone(),
        help: message.help.clone(),
    }
}

/// The names of a mechanism.
fn about(lowered: &Lowered<'_>) -> About {
    let Declared { mechanism, driver } = lowered.declared;
    let coordinate = |id: &CoordinateId| {
        let of = &mechanism.coordinates[*id];
        Quantity { name: of.name.text.clone(), is_angle: of.kind == Kind::Angle }
    };
    let function = mechanism.externals.iter().find_map(|of| Some(of.names.first()?.text.clone()));
    let refusal = function
        .map(|function| format!("`{}` calls `{function}`, which a program in Rust has to give it", driver.name));
    let angles = output_angles(mechanism);
    let outputs = mechanism.outputs.iter().zip(&angles);
    let outputs = outputs.map(|(output, angle)| Quantity { name: output.name.text.clone(), is_angle: angle.is_some() });
    About {
        name: driver.name.to_string(),
        paragraphs: Vec::new(),
        parameters: mechanism.parameters.iter().map(|of| parameter(mechanism, of)).collect(),
        inputs: driver.inputs.iter().map(coordinate).collect(),
        unknowns: driver.unknowns.iter().map(coordinate).collect(),
        points: mechanism.points.iter().map(|point| point.name.text.clone()).collect(),
        outputs: outputs.collect(),
        jumps: angles.iter().map(|angle| angle.and_then(|angle| angle.jump)).collect(),
        scenes: lowered.program.scenes.iter().map(|of| scene(mechanism, of)).collect(),
        refusal,
    }
}

fn scene(mechanism: &Mechanism, of: &SceneProgram<Code>) -> Scene {
    let scene = &mechanism.scenes[of.signatures.id];
    let parameters = scene.parameters.iter().map(|id| parameter(mechanism, &mechanism.scene_parameters[*id]));
    Scene { name: scene.name.to_string(), parameters: parameters.collect(), simulates: scene.inertia.is_some() }
}

fn parameter(mechanism: &Mechanism, of: &model::Parameter) -> Parameter {
    let graph = &mechanism.graph;
    let default =
        of.default.and_then(|node| graph.as_number(node).map(Number::to_f64).or_else(|| graph.constant_value(node)));
    Parameter {
        name: of.name.text.clone(),
        is_angle: of.measure == Measure::Angle,
        unit: (of.measure == Measure::Rate).then(|| "rad/s".to_owned()),
        value: default.unwrap_or(1.0),
        text: of.default_in_words(),
    }
}

/// The code that the macro emits for a driver of a text.
pub fn rust(text: &str, driver: &str) -> Result<String, Refusal> {
    let root = quote!(::linkage);
    let budget = linkage_compiler::budget::Budget::new(MOST_STEPS);
    let compiled = linkage_compiler::text::compile(text, &budget, |of| {
        (of.program.signatures.driver.clone(), emit::driver(of.declared, &of.program, Some(&of.derivation), &root))
    });
    let compiled = compiled.map_err(|_| Refusal::new("the text has mistakes"))?;
    let of = compiled.into_iter().find(|of| of.drivers.iter().any(|(name, _)| name == driver));
    let Some(of) = of else { return Err(Refusal::new("there is no such mechanism")) };
    let drivers: Vec<TokenStream> = of.drivers.into_iter().map(|(_, code)| code).collect();
    let items = emit::mechanism(&of.mechanism, drivers, &root);
    let file = syn::parse2(items).map_err(|error| Refusal::new(format!("the code is not read: {error}")))?;
    Ok(prettyplease::unparse(&file))
}
