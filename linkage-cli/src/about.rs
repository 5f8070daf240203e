//! The names of the mechanisms of a file, and their formulas.

use std::rc::Rc;

use linkage_compiler::Lowered;
use linkage_compiler::derivation::Derivation;
use linkage_compiler::emit::Declared;
use linkage_compiler::graph::NodeId;
use linkage_compiler::ids::CoordinateId;
use linkage_compiler::model::{Kind, Measure, Name, OutputAngle, Request, output_angles};
use linkage_compiler::program::Position;
use linkage_interpreter::{Mechanism, Program};

use crate::failure::Failure;
use crate::mistakes::{Mistakes, Source};
use crate::names::{listed, place};
use crate::progress;
use crate::reasons::Reasons;
use crate::scene::AboutScene;
use crate::solver::{Coordinate, Named};
use crate::symbols::Symbols;

/// The names of a driver, and its derivation.
pub struct About {
    pub name: String,
    pub inputs: Vec<Coordinate>,
    /// The ends of the range of each input that are declared, as formulas of the derivation.
    pub input_ends: Vec<[Option<NodeId>; 2]>,
    pub unknowns: Vec<Coordinate>,
    pub points: Vec<Named>,
    pub outputs: Vec<Named>,
    pub output_angles: Vec<Option<OutputAngle>>,
    pub parameters: Vec<String>,
    /// The default of each parameter with its unit, and what it measures.
    pub defaults: Vec<(Option<String>, Measure)>,
    /// The groups that have several positions.
    pub groups: Vec<Group>,
    /// The functions that are declared by `extern fn`.
    pub functions: Vec<String>,
    /// The places of the unknowns that are found from a guess or a list; none if all positions have a closed form.
    pub guessed: Vec<usize>,
    /// The scenes, in the order of the text.
    pub scenes: Vec<AboutScene>,
    pub derivation: Derivation,
    /// The places of the values of its symbols.
    pub symbols: Symbols,
    pub reasons: Rc<Reasons>,
}

/// A group that has several positions.
pub struct Group {
    pub name: String,
    /// Its positions in words; none if it is a number.
    pub words: Vec<String>,
    pub meaning: String,
}

impl Group {
    /// The groups of a driver, in the order of its branch.
    fn all(position: &Position) -> Vec<Self> {
        let sides = position.sides.iter().map(|side| Self {
            name: side.field.clone(),
            words: side.choice.variants().map(str::to_lowercase).to_vec(),
            meaning: side.meaning.clone(),
        });
        let modes = position.modes.iter().map(|group| Self {
            name: group.field.clone(),
            words: Vec::new(),
            meaning: format!(
                "The number of a position of {}, from 0; there are at most {}.",
                group.unknowns, group.most
            ),
        });
        let turns = position.turns_of_branch().iter().map(|turn| Self {
            name: turn.field.clone(),
            words: Vec::new(),
            meaning: format!("The whole turns that are added to `{}`, 0 without it.", turn.coordinate),
        });
        sides.chain(modes).chain(turns).collect()
    }
}

impl About {
    fn of(lowered: Lowered) -> Self {
        let Declared { mechanism, driver } = lowered.declared;
        let named = |name: &Name| Named { text: name.text.clone(), field: name.field.clone() };
        let coordinate = |id: &CoordinateId| {
            let of = &mechanism.coordinates[*id];
            Coordinate { name: named(&of.name), is_angle: of.kind == Kind::Angle, is_length: of.kind == Kind::Length }
        };
        let ends = |id: &CoordinateId| {
            let name = &mechanism.coordinates[*id].name.text;
            mechanism.ranges.iter().find(|range| range.name == *name).map_or([None; 2], |range| range.ends)
        };
        let output_angles = output_angles(mechanism);
        let of_coordinates = mechanism.coordinates.iter().filter(|of| of.kind == Kind::Angle).map(|of| &of.name);
        let of_outputs = mechanism.outputs.iter().zip(&output_angles).filter(|(_, angle)| angle.is_some());
        let names = of_coordinates.chain(of_outputs.map(|(output, _)| &output.name));
        let angles = names.flat_map(|name| [name.text.clone(), name.field.clone()]).collect();
        let position = &lowered.program.position;
        let of_list = position.modes.iter().map(|group| group.unknowns.as_str());
        let of_guess = position.open.iter().map(|(unknowns, _)| unknowns.as_str());
        let guessed: Vec<&str> = of_list.chain(of_guess).flat_map(|unknowns| unknowns.split(", ")).collect();
        let is_guessed = |id: &CoordinateId| guessed.contains(&mechanism.coordinates[*id].name.field.as_str());
        let unknowns = driver.unknowns.iter().enumerate();
        let guessed =
            unknowns.filter(|(_, id)| !position.is_closed && is_guessed(id)).map(|(place, _)| place).collect();
        Self {
            guessed,
            groups: Group::all(position),
            name: driver.name.to_string(),
            inputs: driver.inputs.iter().map(coordinate).collect(),
            input_ends: driver.inputs.iter().map(ends).collect(),
            unknowns: driver.unknowns.iter().map(coordinate).collect(),
            points: mechanism.points.iter().map(|point| named(&point.name)).collect(),
            outputs: mechanism.outputs.iter().map(|output| named(&output.name)).collect(),
            output_angles,
            parameters: mechanism.parameters.iter().map(|parameter| parameter.name.text.clone()).collect(),
            defaults: mechanism.parameters.iter().map(|of| (of.default_in_words(), of.measure)).collect(),
            functions: mechanism.externals.iter().filter_map(|of| Some(of.names.first()?.text.clone())).collect(),
            scenes: AboutScene::all(&lowered),
            symbols: Symbols::of(mechanism, driver),
            reasons: Rc::new(Reasons::of(&lowered, angles)),
            derivation: lowered.derivation,
        }
    }
}

/// The mechanism with a name, or the only one of a file, with these `derive` statements besides its own, and what a function
/// makes of its formulas.
pub fn chosen<R>(
    source: &Source,
    asked: Option<&str>,
    requests: &[Request],
    f: impl FnMut(&Lowered<'_>) -> R,
) -> Result<(About, Mechanism, R), Failure> {
    let mut all = all(source, asked, requests, f)?;
    match all.as_slice() {
        [_] => Ok(all.swap_remove(0)),
        several => {
            let of = listed(&several.iter().map(|(about, ..)| about.name.as_str()).collect::<Vec<_>>());
            Err(Failure::Argument(format!("{} has {of}: write --mechanism NAME", source.name)))
        }
    }
}

/// The mechanism with a name, or all of a file, each with these `derive` statements besides its own, and what a function makes
/// of their formulas.
pub fn all<R>(
    source: &Source,
    asked: Option<&str>,
    requests: &[Request],
    mut f: impl FnMut(&Lowered<'_>) -> R,
) -> Result<Vec<(About, Mechanism, R)>, Failure> {
    let compiled = progress::during(format!("deriving {}", source.name), || {
        Program::compile_with(&source.text, requests, |lowered| {
            let result = f(&lowered);
            (About::of(lowered), result)
        })
    });
    let compiled = compiled.map_err(|messages| Mistakes::of(source, messages))?;
    let mut all: Vec<(About, Mechanism, R)> =
        compiled.into_iter().map(|(mechanism, (about, result))| (about, mechanism, result)).collect();
    if let Some(name) = asked {
        let names: Vec<&str> = all.iter().map(|(about, ..)| about.name.as_str()).collect();
        let place = place(&source.name, "mechanism", name, &names)?;
        return Ok(vec![all.swap_remove(place)]);
    }
    Ok(all)
}
