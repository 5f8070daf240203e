//! A mechanism with numbers: values of its parameters, a branch, and the inputs that are held.

use linkage_compiler::Lowered;
use linkage_compiler::derivation::Derivation;
use linkage_compiler::ids::CoordinateId;
use linkage_compiler::model::{Kind, Name, Request};
use linkage_interpreter::{Data, Design, Mechanism, Program};
use linkage_runtime::lane::arctangent2;

use crate::arguments::Numbers;
use crate::failure::Failure;
use crate::mistakes::{Mistakes, Source};
use crate::names::{listed, place};
use crate::progress;
use crate::source::read;
use crate::values::{Assignment, Choice, Value};

/// A name as written, and that of its field.
#[derive(Debug, Clone)]
pub struct Named {
    pub text: String,
    pub field: String,
}

/// A coordinate.
#[derive(Debug, Clone)]
pub struct Coordinate {
    pub name: Named,
    pub is_angle: bool,
}

impl Coordinate {
    /// The number of an argument as its value.
    pub fn value(&self, value: Value) -> Result<f64, Failure> {
        match self.is_angle {
            true => value.angle(&self.name.text).map_err(Failure::Argument),
            false => Ok(value.number),
        }
    }

    /// A value for readers, an angle in degrees to the millionth.
    pub fn shown(&self, value: f64) -> String {
        match self.is_angle {
            true => format!("{}°", (value.to_degrees() * 1e6).round() / 1e6),
            false => value.to_string(),
        }
    }
}

/// A mechanism with values for all but its inputs.
pub struct Machine {
    pub name: String,
    pub inputs: Vec<Coordinate>,
    pub unknowns: Vec<Coordinate>,
    pub points: Vec<Named>,
    pub outputs: Vec<Named>,
    /// Its formulas, for the drawing.
    pub derivation: Derivation,
    parameters: Vec<(String, f64)>,
    design: Design,
    branch: Data,
}

/// A position with its rates, at one choice of inputs.
pub struct Motion {
    /// The values of the inputs.
    pub inputs: Vec<f64>,
    /// The values of the unknowns; angles from -pi to pi.
    pub unknowns: Vec<f64>,
    data: Data,
}

impl Motion {
    /// The pose, with which functions are called.
    pub fn pose(&self) -> Data {
        self.data.get("pose").cloned().unwrap_or(Data::Nothing)
    }

    /// A number of the motion: `points.c.velocity.x`.
    pub fn number(&self, path: &str) -> f64 {
        self.data.get(path).and_then(Data::number).unwrap_or(f64::NAN)
    }
}

/// The names of a driver, and its derivation.
struct About {
    name: String,
    inputs: Vec<Coordinate>,
    unknowns: Vec<Coordinate>,
    points: Vec<Named>,
    outputs: Vec<Named>,
    parameters: Vec<String>,
    /// True for each parameter that is an angle.
    are_angles: Vec<bool>,
    /// The functions that are declared by `extern fn`.
    functions: Vec<String>,
    derivation: Derivation,
}

impl About {
    fn of(lowered: Lowered) -> Self {
        let (mechanism, driver) = (lowered.program.signatures.mechanism, lowered.program.signatures.driver);
        let named = |name: &Name| Named { text: name.text.clone(), field: name.field.clone() };
        let coordinate = |id: &CoordinateId| {
            let of = &mechanism.coordinates[*id];
            Coordinate { name: named(&of.name), is_angle: of.kind == Kind::Angle }
        };
        Self {
            name: driver.name.to_string(),
            inputs: driver.inputs.iter().map(coordinate).collect(),
            unknowns: driver.unknowns.iter().map(coordinate).collect(),
            points: mechanism.points.iter().map(|point| named(&point.name)).collect(),
            outputs: mechanism.outputs.iter().map(|output| named(&output.name)).collect(),
            parameters: mechanism.parameters.iter().map(|parameter| parameter.name.text.clone()).collect(),
            are_angles: mechanism.parameters.iter().map(|parameter| parameter.kind == Kind::Angle).collect(),
            functions: mechanism.externals.iter().filter_map(|of| Some(of.names.first()?.text.clone())).collect(),
            derivation: lowered.derivation,
        }
    }
}

impl Machine {
    /// The mechanism that the arguments mean, with their numbers.
    pub fn of(numbers: &Numbers) -> Result<Self, Failure> {
        Self::with(numbers, |_| ()).map(|(machine, ())| machine)
    }

    /// The mechanism that the arguments mean, with their numbers, and what a function makes of its formulas.
    pub fn with<R>(numbers: &Numbers, f: impl FnMut(&Lowered<'_>) -> R) -> Result<(Self, R), Failure> {
        let file = &numbers.source.file;
        let (about, mechanism, result) = chosen(&read(file)?, numbers.source.mechanism.as_deref(), f)?;
        if let Some(function) = about.functions.first() {
            let name = &about.name;
            return Err(Failure::Outside(format!(
                "`{name}` calls `{function}`, which a program in Rust has to give it"
            )));
        }
        let parameters = parameters(&about, &mechanism, &numbers.set)?;
        let branch = branch(&about, &mechanism, &numbers.branch)?;
        let values: Vec<f64> = parameters.iter().map(|(_, value)| *value).collect();
        let design = mechanism.design().with_parameters(&values);
        let About { name, inputs, unknowns, points, outputs, derivation, .. } = about;
        Ok((Self { name, inputs, unknowns, points, outputs, derivation, parameters, design, branch }, result))
    }

    /// The parameters with their values.
    pub fn parameters(&self) -> &[(String, f64)] {
        &self.parameters
    }

    /// Values of the inputs in words.
    pub fn at(&self, inputs: &[f64]) -> String {
        let each = self
            .inputs
            .iter()
            .zip(inputs)
            .map(|(input, value)| format!("{} = {}", input.name.text, input.shown(*value)));
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
        let coordinates = self.unknowns.iter().chain(&self.inputs);
        let named = coordinates.zip(rates).map(|(of, rate)| (of.name.field.as_str(), Data::from(*rate)));
        self.numbers("gamma", &[pose.clone(), Data::fields(named)])
    }

    /// The numbers that a function returns; none where it has no value.
    fn numbers(&self, function: &str, arguments: &[Data]) -> Vec<f64> {
        self.design.call(function, arguments).map_or_else(|_| Vec::new(), |found| found.numbers())
    }

    /// The place of an input.
    pub fn input(&self, name: &str) -> Result<usize, Failure> {
        let names: Vec<&str> = self.inputs.iter().map(|input| input.name.text.as_str()).collect();
        place(&self.name, "input", name, &names)
    }

    /// Position, velocity and acceleration; rates are constant.
    pub fn motion(&self, inputs: &[f64], rates: &[f64]) -> Result<Motion, String> {
        let still = vec![0.0; inputs.len()];
        let arguments = [given(inputs), self.branch.clone(), given(rates), given(&still)];
        // A mechanism without points and outputs has the second one only.
        let functions = ["full_kinematics", "kinematics"];
        let Some(function) = functions.into_iter().find(|function| self.design.arguments(function).is_ok()) else {
            let name = &self.name;
            return Err(format!("positions of `{name}` are found from a guess only, which this program does not take"));
        };
        let data = self.design.call(function, &arguments).map_err(|error| error.to_string())?;
        let unknowns = self.unknowns_of(data.get("pose").unwrap_or(&Data::Nothing));
        Ok(Motion { inputs: inputs.to_vec(), unknowns, data })
    }

    /// The unknowns of a pose; angles from -pi to pi.
    fn unknowns_of(&self, pose: &Data) -> Vec<f64> {
        let unknowns = self.unknowns.iter().map(|unknown| {
            let value = pose.get(&unknown.name.field);
            match value.map(Data::numbers).as_deref() {
                Some([cosine, sine]) => arctangent2(*sine, *cosine),
                Some([value]) => *value,
                _ => f64::NAN,
            }
        });
        unknowns.collect()
    }

    /// All positions at these inputs, each with its branch in words; or why they are not listed.
    pub fn positions(&self, inputs: &[f64]) -> Result<Vec<(String, Motion)>, String> {
        if self.unknowns.is_empty() {
            return self.motion(inputs, &vec![0.0; inputs.len()]).map(|motion| vec![(String::new(), motion)]);
        }
        let [_, _, turns] = self.design.mechanism().branch_fields();
        let turns: Vec<&str> = turns.iter().map(|(name, _)| *name).collect();
        let all = self.design.call("branches", &[given(inputs)]).map_err(|error| error.to_string())?;
        let position = |data: &Data| {
            let unknowns = self.unknowns_of(data.get("pose").unwrap_or(&Data::Nothing));
            let motion = Motion { inputs: inputs.to_vec(), unknowns, data: data.clone() };
            (data.get("branch").map(|branch| words(branch, &turns)).unwrap_or_default(), motion)
        };
        Ok(all.list().iter().map(position).collect())
    }

    /// The value of a symbol of the formulas at a position.
    pub fn symbol(&self, name: &str, motion: &Motion) -> f64 {
        let of = |coordinates: &[Coordinate], values: &[f64]| {
            let place = coordinates.iter().position(|of| of.name.text == name)?;
            values.get(place).copied()
        };
        let parameter = self.parameters.iter().find(|(other, _)| other == name).map(|(_, value)| *value);
        let coordinate = of(&self.inputs, &motion.inputs).or_else(|| of(&self.unknowns, &motion.unknowns));
        parameter.or(coordinate).unwrap_or(f64::NAN)
    }
}

/// Inputs as an argument.
fn given(numbers: &[f64]) -> Data {
    match numbers {
        [only] => Data::from(*only),
        several => Data::from(several),
    }
}

/// A branch as it is chosen on the command line, without the turns of angles, which are 0.
fn words(branch: &Data, turns: &[&str]) -> String {
    let Data::Fields(fields) = branch else { return String::new() };
    let each = fields.iter().filter(|(name, _)| !turns.contains(&&**name)).map(|(name, value)| match value {
        Data::Text(word) => format!("{name}={}", word.to_lowercase()),
        other => format!("{name}={}", other.number().unwrap_or(f64::NAN)),
    });
    each.collect::<Vec<_>>().join(", ")
}

/// The mechanism with a name, or the only one of a file.
fn chosen<R>(
    source: &Source,
    asked: Option<&str>,
    mut f: impl FnMut(&Lowered<'_>) -> R,
) -> Result<(About, Mechanism, R), Failure> {
    let compiled = progress::during(format!("deriving {}", source.name), || {
        Program::compile_with(&source.text, &[Request::Drawing], |lowered| {
            let result = f(&lowered);
            (About::of(lowered), result)
        })
    });
    let compiled = compiled.map_err(|messages| Mistakes::of(source, messages))?;
    let mut all: Vec<(About, Mechanism, R)> =
        compiled.into_iter().map(|(mechanism, (about, result))| (about, mechanism, result)).collect();
    let names: Vec<&str> = all.iter().map(|(about, ..)| about.name.as_str()).collect();
    let place = match (asked, names.as_slice()) {
        (Some(name), names) => place(&source.name, "mechanism", name, names)?,
        (None, [_]) => 0,
        (None, names) => {
            let of = listed(names);
            return Err(Failure::Argument(format!("{} has {of}: write --mechanism NAME", source.name)));
        }
    };
    Ok(all.swap_remove(place))
}

/// The parameters with their values.
fn parameters(about: &About, mechanism: &Mechanism, set: &[Assignment]) -> Result<Vec<(String, f64)>, Failure> {
    let mut values = mechanism.design().parameters().to_vec();
    let names: Vec<&str> = about.parameters.iter().map(String::as_str).collect();
    for Assignment { name, value } in set {
        let place = place(&about.name, "parameter", name, &names)?;
        values[place] = match about.are_angles[place] {
            true => value.angle(name).map_err(Failure::Argument)?,
            false => value.number,
        };
    }
    let parameters: Vec<(String, f64)> = about.parameters.iter().cloned().zip(values).collect();
    match parameters.iter().find(|(_, value)| value.is_nan()) {
        Some((name, _)) => {
            Err(Failure::Argument(format!("the parameter `{name}` has no value: write --set {name}=VALUE")))
        }
        None => Ok(parameters),
    }
}

/// The branch: the first position of each group where none is chosen, and no additional turns.
fn branch(about: &About, mechanism: &Mechanism, choices: &[Choice]) -> Result<Data, Failure> {
    let [sides, modes, turns] = mechanism.branch_fields();
    let words = sides.iter().map(|(_, words)| words.first().copied().map_or(Data::Nothing, Data::from));
    let numbers = modes.iter().chain(&turns).map(|_| Data::Count(0));
    let mut values: Vec<Data> = words.chain(numbers).collect();
    let groups: Vec<&(&str, Vec<&str>)> = sides.iter().chain(&modes).chain(&turns).collect();
    let names: Vec<&str> = groups.iter().map(|(name, _)| *name).collect();
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
