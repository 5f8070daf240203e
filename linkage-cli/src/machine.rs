//! A mechanism with numbers: values of its parameters, a branch, and the inputs that are held.

use std::f64::consts::TAU;

use linkage_compiler::Lowered;
use linkage_compiler::graph::NodeId;
use linkage_compiler::ids::Id;
use linkage_compiler::model::Request;
use linkage_interpreter::{Data, Design, Mechanism, SceneDesign};
use linkage_runtime::Ranged;

use crate::about::{About, chosen};
use crate::arguments::Numbers;
use crate::failure::Failure;
use crate::names::{once, place};
use crate::parameters::Parameters;
use crate::scene::AboutScene;
use crate::solver::Solver;
pub use crate::solver::{Coordinate, Motion, Named};
use crate::source::read;
use crate::start::{Among, Near, Start, choices};
use crate::symbols::Given;
use crate::values::{Assignment, Choice};

/// The angle at which an input without a range is held without a value: every crank can be there.
const HELD: f64 = TAU / 6.0;

/// The share of its scale up to which a determinant counts as zero: at an end of a motion, whose input has half of its digits as
/// errors of the unknowns.
const SINGULAR: f64 = 1e-6;

/// A mechanism with values for all but its inputs.
pub struct Machine {
    pub about: About,
    parameters: Vec<(String, f64)>,
    /// Its positions without regard to a motion.
    pub solver: Solver,
    start: Start,
    /// The ends of the declared range of each input.
    ranges: Vec<[Option<f64>; 2]>,
}

impl Machine {
    /// The mechanism that the arguments mean, with their numbers.
    pub fn of(numbers: &Numbers) -> Result<Self, Failure> {
        Self::with(numbers, |_| ()).map(|(machine, ())| machine)
    }

    /// The mechanism that the arguments mean, with their numbers, and what a function makes of its formulas.
    pub fn with<R>(numbers: &Numbers, f: impl FnMut(&Lowered<'_>) -> R) -> Result<(Self, R), Failure> {
        let (machine, _, result) = Self::begun(numbers, &[Request::Drawing], |_| Ok(None), Start::of, f)?;
        Ok((machine, result))
    }

    /// The mechanism that the arguments mean with one of its scenes, with their numbers.
    pub fn with_scene(
        numbers: &Numbers,
        scene: impl FnOnce(&About) -> Result<usize, Failure>,
    ) -> Result<(Self, SceneDesign), Failure> {
        let (machine, scene, ()) = Self::begun(numbers, &[], |about| scene(about).map(Some), Start::of, |_| ())?;
        let scene = scene.ok_or_else(|| Failure::Argument(format!("`{}` has no scene", machine.about.name)))?;
        Ok((machine, scene))
    }

    /// The mechanism that the arguments mean, with its formulas over intervals.
    pub fn with_intervals(numbers: &Numbers) -> Result<Self, Failure> {
        let (machine, ..) = Self::begun(numbers, &[Request::Intervals], |_| Ok(None), Start::of, |_| ())?;
        Ok(machine)
    }

    /// The mechanism of all whose positions there is something to say. One of them is chosen only if there is a branch or a
    /// guess, so that none is needed.
    pub fn of_all<R>(numbers: &Numbers, f: impl FnMut(&Lowered<'_>) -> R) -> Result<(Self, R), Failure> {
        let start = |about: &About, mechanism: &Mechanism, numbers: &Numbers| match numbers.choose() {
            true => Start::of(about, mechanism, numbers),
            false => Ok(Start::Listed),
        };
        let (machine, _, result) = Self::begun(numbers, &[Request::Drawing], |_| Ok(None), start, f)?;
        Ok((machine, result))
    }

    fn begun<R>(
        numbers: &Numbers,
        requests: &[Request],
        scene: impl FnOnce(&About) -> Result<Option<usize>, Failure>,
        start: impl FnOnce(&About, &Mechanism, &Numbers) -> Result<Start, Failure>,
        f: impl FnMut(&Lowered<'_>) -> R,
    ) -> Result<(Self, Option<SceneDesign>, R), Failure> {
        let file = &numbers.source.file;
        let (about, mechanism, result) = chosen(&read(file)?, numbers.source.mechanism.as_deref(), requests, f)?;
        if let Some(function) = about.functions.first() {
            let name = &about.name;
            return Err(Failure::Outside(format!(
                "`{name}` calls `{function}`, which a program in Rust has to give it"
            )));
        }
        let scene = scene(&about)?.map(|place| &about.scenes[place]);
        let (design, scene) = valued(&about, &mechanism, scene, &numbers.set)?;
        let values = design.parameters().iter().copied();
        let parameters: Vec<(String, f64)> = about.parameters.iter().cloned().zip(values).collect();
        let branch = branch(&about, &mechanism, &numbers.branch)?;
        let start = start(&about, &mechanism, numbers)?;
        let (inputs, unknowns) = (about.inputs.clone(), about.unknowns.clone());
        let (points, outputs) = (about.points.clone(), about.outputs.clone());
        let reasons = about.reasons.clone();
        let solver = Solver { inputs, unknowns, points, outputs, design, branch, reasons };
        let ranges = ranges(&about, &parameters)?;
        Ok((Self { about, parameters, solver, start, ranges }, scene, result))
    }

    /// The parameters with their values.
    pub fn parameters(&self) -> &[(String, f64)] {
        &self.parameters
    }

    /// Values of the inputs in words.
    pub fn at(&self, inputs: &[f64]) -> String {
        let each = self.about.inputs.iter().zip(inputs);
        let each = each.map(|(input, value)| format!("{} = {}", input.name.text, input.shown(*value)));
        each.collect::<Vec<_>>().join(", ")
    }

    /// The velocity ratios at a position: for each unknown those by all inputs.
    pub fn ratios(&self, motion: &Motion) -> Vec<f64> {
        self.numbers("velocity_ratios", &[motion.pose()])
    }

    /// The derivatives of the constraint equations by the unknowns, row by row.
    pub fn jacobian(&self, motion: &Motion) -> Vec<f64> {
        self.numbers("jacobian_unknowns", &[motion.pose()])
    }

    /// The quadratic velocity terms at rates of the unknowns, then of the inputs.
    pub fn gamma(&self, pose: &Data, rates: &[f64]) -> Vec<f64> {
        let coordinates = self.about.unknowns.iter().chain(&self.about.inputs);
        let named = coordinates.zip(rates).map(|(of, rate)| (of.name.field.as_str(), Data::from(*rate)));
        self.numbers("gamma", &[pose.clone(), Data::fields(named)])
    }

    /// The numbers that a function returns; none where it has no value.
    fn numbers(&self, function: &str, arguments: &[Data]) -> Vec<f64> {
        self.solver.design.call(function, arguments).map_or_else(|_| Vec::new(), |found| found.numbers())
    }

    /// The place of an input.
    pub fn input(&self, name: &str) -> Result<usize, Failure> {
        let names: Vec<&str> = self.about.inputs.iter().map(|input| input.name.text.as_str()).collect();
        place(&self.about.name, "input", name, &names)
    }

    /// The ends of the range that is declared for an input.
    pub fn declared(&self, input: usize) -> [Option<f64>; 2] {
        self.ranges.get(input).copied().unwrap_or_default()
    }

    /// The first value of an input: that of its declared range, of another angle 60 degrees, none of another length.
    pub fn first_value(&self, input: usize) -> Option<f64> {
        let [least, most] = self.declared(input);
        let of_angle = || self.about.inputs.get(input)?.is_angle.then_some(HELD);
        Ranged { value: 0.0, least, most, is_direction: false }.first().or_else(of_angle)
    }

    /// Position, velocity and acceleration at the position that the branch or the guess chooses; rates are constant.
    pub fn motion(&self, inputs: &[f64], rates: &[f64]) -> Result<Motion, String> {
        match &self.start {
            Start::Closed => self.solver.motion(inputs, rates),
            Start::Guess(guess) => self.solver.motion_near(inputs, guess, rates),
            Start::Listed => self.solver.motion_near(inputs, &self.solver.on_branch(inputs)?, rates),
            Start::Near(near) => {
                let solver = self.near(near, inputs)?;
                match near.among {
                    Among::Closed => solver.motion(inputs, rates),
                    Among::Listed => solver.motion_near(inputs, &solver.on_branch(inputs)?, rates),
                    Among::Found => solver.motion_near(inputs, &near.guess(), rates),
                }
            }
        }
    }

    /// The solver on the branch of the position that is nearest to a guess.
    fn near(&self, near: &Near, inputs: &[f64]) -> Result<Solver, String> {
        let positions: Vec<(Vec<Choice>, Vec<f64>)> = match near.among {
            Among::Found => {
                let branches = near.branches(self.solver.design.mechanism());
                let branches = branches.ok_or("the groups have too many sides for a guess: write --branch")?;
                let (guess, still) = (near.guess(), vec![0.0; inputs.len()]);
                let on = |choices: Vec<Choice>| {
                    let found = self.on(&choices).ok()?.motion_near(inputs, &guess, &still).ok()?;
                    Some((choices, found.unknowns))
                };
                branches.into_iter().filter_map(on).collect()
            }
            Among::Closed | Among::Listed => {
                let all = self.solver.positions(inputs)?.into_iter();
                all.filter_map(|(branch, at)| Some((choices(&branch)?, at.unknowns))).collect()
            }
        };
        let nearest = near.nearest(&self.about, positions.iter().map(|(choices, at)| (choices.clone(), at)));
        match nearest {
            Some(choices) => self.on(&choices),
            None => {
                let other = || format!("`{}` has no position on this branch at {}", self.about.name, self.at(inputs));
                Err(self.solver.on_branch(inputs).err().unwrap_or_else(other))
            }
        }
    }

    /// The solver on another branch.
    fn on(&self, choices: &[Choice]) -> Result<Solver, String> {
        let branch = branch(&self.about, self.solver.design.mechanism(), choices).map_err(|failure| match failure {
            Failure::Argument(why) | Failure::Outside(why) => why,
            _ => format!("`{}` has no such branch", self.about.name),
        })?;
        Ok(Solver { branch, ..self.solver.clone() })
    }

    /// True if all positions have a closed form, on the same branch.
    pub fn is_closed(&self) -> bool {
        self.start == Start::Closed
    }

    /// The unknowns at the position that the branch or the guess chooses, which need not have rates.
    pub fn place(&self, inputs: &[f64], rates: &[f64]) -> Result<Vec<f64>, String> {
        match &self.start {
            Start::Closed => self.solver.on_branch(inputs),
            Start::Near(near) if near.among == Among::Closed => self.near(near, inputs)?.on_branch(inputs),
            _ => self.motion(inputs, rates).map(|motion| motion.unknowns),
        }
    }

    /// All positions at these inputs, each with its branch in words; or why they are not listed.
    pub fn positions(&self, inputs: &[f64]) -> Result<Vec<(String, Motion)>, String> {
        self.solver.positions(inputs)
    }

    /// The first positions at these inputs, at most so many, and how many more there may be; or why they are not listed.
    pub fn first_positions(&self, inputs: &[f64], most: usize) -> Result<(Vec<(String, Motion)>, usize), String> {
        self.solver.first_positions(inputs, most)
    }

    /// True if two positions at the same inputs are one, up to whole turns and to half of the digits.
    pub fn are_same(&self, one: &[f64], other: &[f64]) -> bool {
        let each = || one.iter().zip(other).zip(&self.about.unknowns);
        let lengths = each().filter(|(_, of)| !of.is_angle);
        let size = lengths.fold(0.0, |size: f64, ((one, other), _)| size.max(one.abs()).max(other.abs()));
        let near = f64::EPSILON.sqrt();
        each().all(|((one, other), of)| match of.is_angle {
            true => ((one - other) / 2.0).sin().abs() <= near,
            false => (one - other).abs() <= near * size,
        })
    }

    /// The outputs by their formulas at these values of the unknowns, whose angles may be on other turns.
    pub fn outputs_at(&self, inputs: &[f64], unknowns: &[f64]) -> Result<Vec<f64>, Failure> {
        let outputs = self.about.derivation.outputs.iter();
        let nodes: Vec<NodeId> = outputs.flat_map(|output| output.value.iter().copied()).collect();
        self.formulas_at(&nodes, inputs, unknowns)
    }

    /// True if the equations hold at these values of the unknowns.
    pub fn solves(&self, inputs: &[f64], unknowns: &[f64]) -> Result<bool, Failure> {
        let derivation = &self.about.derivation;
        let residual = self.formulas_at(&derivation.residual, inputs, unknowns)?;
        let scales = self.formulas_at(&derivation.residual_scales, inputs, unknowns)?;
        Ok(residual.iter().zip(scales).all(|(residual, scale)| residual.abs() <= scale * f64::EPSILON.sqrt()))
    }

    /// The groups that are singular at a position, or nearly so: their determinants are small against their scales.
    pub fn singular(&self, inputs: &[f64], unknowns: &[f64]) -> Result<Vec<String>, Failure> {
        let mut names = Vec::new();
        for group in self.about.derivation.groups.iter() {
            let Some(determinant) = group.determinant else { continue };
            let found = self.formulas_at(&[determinant.value, determinant.scale], inputs, unknowns)?;
            if let [value, scale] = found.as_slice()
                && value.abs() <= SINGULAR * scale.abs()
            {
                let of = group.unknowns.iter().filter_map(|id| self.about.unknowns.get(id.index()));
                names.push(of.map(|unknown| unknown.name.text.as_str()).collect::<Vec<_>>().join(", "));
            }
        }
        Ok(names)
    }

    /// The values of formulas at a position.
    pub fn formulas_at(&self, nodes: &[NodeId], inputs: &[f64], unknowns: &[f64]) -> Result<Vec<f64>, Failure> {
        let given = Given { parameters: &self.parameters, inputs, unknowns };
        self.about.symbols.evaluate(&self.about.derivation.graph, nodes, given)
    }
}

/// The mechanism, and its scene, with values of their parameters.
fn valued(
    about: &About,
    mechanism: &Mechanism,
    scene: Option<&AboutScene>,
    set: &[Assignment],
) -> Result<(Design, Option<SceneDesign>), Failure> {
    let design = mechanism.design();
    let begun = scene.map(|scene| design.scene(&scene.name)).transpose();
    let begun = begun.map_err(|error| Failure::Outside(error.to_string()))?;
    let own = about.parameters.iter().zip(&about.defaults).zip(design.parameters());
    let own = own.map(|((name, (_, measure)), value)| (name.as_str(), *measure, *value));
    let of_scene = scene.iter().flat_map(|scene| &scene.parameters).zip(begun.iter().flat_map(SceneDesign::parameters));
    let of_scene = of_scene.map(|((name, measure), value)| (name.as_str(), *measure, *value));
    let values = Parameters::of(&about.name, own.chain(of_scene)).with(set)?;
    let (own, of_scene) = values.split_at(about.parameters.len());
    let design = mechanism.design().with_parameters(own);
    let scene = scene.map(|scene| design.scene(&scene.name)).transpose();
    let scene = scene.map_err(|error| Failure::Outside(error.to_string()))?;
    Ok((design, scene.map(|scene| scene.with_parameters(of_scene))))
}

/// The ends of the declared range of each input.
fn ranges(about: &About, parameters: &[(String, f64)]) -> Result<Vec<[Option<f64>; 2]>, Failure> {
    let given = Given { parameters, inputs: &[], unknowns: &[] };
    let value = |end: Option<NodeId>| {
        let found = about.symbols.evaluate(&about.derivation.graph, end.as_slice(), given)?;
        Ok::<_, Failure>(found.first().copied())
    };
    about.input_ends.iter().map(|[least, most]| Ok([value(*least)?, value(*most)?])).collect()
}

/// The branch: the first position of each group where none is chosen, and no additional turns.
fn branch(about: &About, mechanism: &Mechanism, choices: &[Choice]) -> Result<Data, Failure> {
    let [sides, modes, turns] = mechanism.branch_fields();
    let words = sides.iter().map(|(_, words)| words.first().copied().map_or(Data::Nothing, Data::from));
    let numbers = modes.iter().chain(&turns).map(|_| Data::Count(0));
    let mut values: Vec<Data> = words.chain(numbers).collect();
    let groups: Vec<&(&str, Vec<&str>)> = sides.iter().chain(&modes).chain(&turns).collect();
    let names: Vec<&str> = groups.iter().map(|(name, _)| *name).collect();
    once("--branch", choices.iter().map(|choice| choice.name.as_str()))?;
    for Choice { name, word } in choices {
        let place = place(&about.name, "group with several positions", name, &names)?;
        values[place] = position(&groups[place].1, word)
            .map_err(|all| Failure::Argument(format!("`{name}` is {all}, not `{word}`")))?;
    }
    Ok(Data::fields(names.into_iter().zip(values)))
}

/// A position by its word, or by its number where positions have no words; what it can be otherwise.
fn position(words: &[&str], chosen: &str) -> Result<Data, String> {
    if words.is_empty() {
        return chosen.parse().map(Data::Count).map_err(|_| "a whole number".to_owned());
    }
    let found = words.iter().find(|word| word.eq_ignore_ascii_case(chosen));
    found.map(|word| Data::from(*word)).ok_or_else(|| {
        let all: Vec<String> = words.iter().map(|word| format!("`{}`", word.to_lowercase())).collect();
        all.join(" or ")
    })
}
