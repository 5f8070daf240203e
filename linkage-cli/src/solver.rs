//! Positions, velocities and accelerations: calls of the functions of a mechanism.

use std::rc::Rc;

use linkage_interpreter::{CallError, Data, Design};
use linkage_runtime::{OutputMotion, PointMotion};

use crate::ends::shown;
use crate::failure::Failure;
use crate::reasons::Reasons;
use crate::values::Value;

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
    /// True for a length; a coordinate that is used as neither is a number.
    pub is_length: bool,
}

impl Coordinate {
    /// The number of an argument as its value.
    pub fn value(&self, value: Value) -> Result<f64, Failure> {
        match (self.is_angle, self.is_length) {
            (true, _) => value.angle(&self.name.text),
            (_, true) => value.length(&self.name.text),
            _ => value.plain(&self.name.text),
        }
        .map_err(Failure::Argument)
    }

    /// The number of an argument as its rate.
    pub fn rate(&self, value: Value) -> Result<f64, Failure> {
        value.rate(&self.name.text, self.kind(), self.is_angle).map_err(Failure::Argument)
    }

    /// Its kind in words, such as `a length`.
    pub fn kind(&self) -> &'static str {
        match (self.is_angle, self.is_length) {
            (true, _) => "an angle",
            (_, true) => "a length",
            _ => "a plain number",
        }
    }

    /// A value for readers, an angle in degrees to the millionth.
    pub fn shown(&self, value: f64) -> String {
        match self.is_angle {
            true => format!("{}°", (value.to_degrees() * 1e6).round() / 1e6),
            false => shown(value, false),
        }
    }
}

/// A position with its rates, at one choice of inputs.
pub struct Motion {
    /// The values of the inputs.
    pub inputs: Vec<f64>,
    /// The values of the unknowns.
    pub unknowns: Vec<f64>,
    /// True of a motion that is followed: its angles count turns. Others are those of the branch, and directions among them
    /// are from -pi to pi.
    pub is_followed: bool,
    data: Data,
}

impl Motion {
    /// The pose, with which functions are called.
    pub fn pose(&self) -> Data {
        self.data.get("pose").cloned().unwrap_or(Data::Nothing)
    }

    /// A number of the motion: `points.c.velocity.x`.
    pub fn number(&self, path: &str) -> Result<f64, Failure> {
        let found = self.data.get(path).and_then(Data::number);
        found.ok_or_else(|| Failure::Outside(format!("the position has no number `{path}`")))
    }

    /// The numbers of the motion with these endings of a path.
    pub fn numbers<const N: usize>(&self, of: &str, ends: [&str; N]) -> Result<[f64; N], Failure> {
        let mut numbers = [0.0; N];
        for (number, end) in numbers.iter_mut().zip(ends) {
            *number = self.number(&format!("{of}.{end}"))?;
        }
        Ok(numbers)
    }
}

/// The most branches whose positions are computed for a list of some: each takes up to a millisecond.
const MOST_BRANCHES: usize = 1024;

/// A mechanism with values of its parameters, and a branch.
#[derive(Clone)]
pub struct Solver {
    pub inputs: Vec<Coordinate>,
    pub unknowns: Vec<Coordinate>,
    pub points: Vec<Named>,
    pub outputs: Vec<Named>,
    pub design: Design,
    pub branch: Data,
    /// The words about positions that do not exist.
    pub reasons: Rc<Reasons>,
}

impl Solver {
    /// The motion at the position that Newton's method finds from these unknowns.
    pub fn motion_near(&self, inputs: &[f64], unknowns: &[f64], rates: &[f64]) -> Result<Motion, String> {
        let of = |coordinates: &'_ [Coordinate], values: &[f64]| -> Vec<(String, Data)> {
            let fields = coordinates.iter().map(|coordinate| coordinate.name.field.clone());
            fields.zip(values.iter().copied().map(Data::from)).collect()
        };
        let guess = [of(&self.inputs, inputs), of(&self.unknowns, unknowns)].concat();
        let guess = Data::fields(guess.iter().map(|(name, value)| (name.as_str(), value.clone())));
        self.called("full_kinematics_near", guess, inputs, rates)
    }

    /// The motion on the branch.
    pub fn motion(&self, inputs: &[f64], rates: &[f64]) -> Result<Motion, String> {
        self.called("full_kinematics", Self::given(inputs), inputs, rates)
    }

    /// The motion with these inputs, unknowns, rates and accelerations. It has no pose, and its angles count turns.
    pub fn moved(
        &self,
        [inputs, unknowns, rates, accelerations]: [Vec<f64>; 4],
        points: &[PointMotion<f64>],
        outputs: &[OutputMotion<f64>],
    ) -> Motion {
        let named = |numbers: &[f64]| {
            let fields = self.unknowns.iter().map(|unknown| unknown.name.field.as_str());
            Data::fields(fields.zip(numbers.iter().copied().map(Data::from)))
        };
        let point = |of: &PointMotion<f64>| {
            let vectors = [of.position.coords, of.velocity, of.acceleration];
            let vectors = vectors.map(|vector| Data::from(vector.as_slice()));
            Data::fields(["position", "velocity", "acceleration"].into_iter().zip(vectors))
        };
        let output = |of: &OutputMotion<f64>| {
            let numbers = [of.value, of.rate, of.acceleration].map(Data::from);
            Data::fields(["value", "rate", "acceleration"].into_iter().zip(numbers))
        };
        let each = |of: &'_ [Named], all: Vec<Data>| {
            Data::fields(of.iter().map(|name| name.field.as_str()).zip(all).collect::<Vec<_>>())
        };
        let data = Data::fields([
            ("rates", named(&rates)),
            ("accelerations", named(&accelerations)),
            ("points", each(&self.points, points.iter().map(point).collect())),
            ("outputs", each(&self.outputs, outputs.iter().map(output).collect())),
        ]);
        Motion { inputs, unknowns, is_followed: true, data }
    }

    /// The unknowns at the position on the branch, which may have a number.
    pub fn on_branch(&self, inputs: &[f64]) -> Result<Vec<f64>, String> {
        let pose = self.design.call("assemble", &[Self::given(inputs), self.branch.clone()]);
        let pose = pose.map_err(|error| self.why(&error, inputs))?;
        self.of_pose(&pose)
    }

    /// All positions at these inputs, each with its branch in words; or why they are not listed.
    pub fn positions(&self, inputs: &[f64]) -> Result<Vec<(String, Motion)>, String> {
        if self.unknowns.is_empty() {
            return self.motion(inputs, &vec![0.0; inputs.len()]).map(|motion| vec![(String::new(), motion)]);
        }
        let [_, _, turns] = self.design.mechanism().branch_fields();
        let turns: Vec<&str> = turns.iter().map(|(name, _)| *name).collect();
        let all = self.design.call("branches", &[Self::given(inputs)]).map_err(|error| self.why(&error, inputs))?;
        let position = |data: &Data| {
            let motion = self.of_data(inputs, data.clone())?;
            Ok((data.get("branch").map(|branch| words(branch, &turns)).unwrap_or_default(), motion))
        };
        all.list().iter().map(position).collect()
    }

    /// True if there are more than 256 branches of sides.
    pub fn has_many_branches(&self) -> bool {
        let [sides, ..] = self.design.mechanism().branch_fields();
        sides.len() > 8
    }

    /// The first positions at these inputs, at most so many, and how many more there may be. Of few branches all positions are
    /// listed; of many, branch after branch is assembled until there are enough.
    pub fn first_positions(&self, inputs: &[f64], most: usize) -> Result<(Vec<(String, Motion)>, usize), String> {
        let [sides, modes, turns] = self.design.mechanism().branch_fields();
        let branches = u32::try_from(sides.len()).ok().and_then(|sides| 1_usize.checked_shl(sides));
        let many = branches.filter(|branches| *branches <= MOST_BRANCHES).is_none() && modes.is_empty();
        if self.unknowns.is_empty() || !many {
            let mut all = self.positions(inputs)?;
            let more = all.len().saturating_sub(most);
            all.truncate(most);
            return Ok((all, more));
        }
        let turns: Vec<&str> = turns.iter().map(|(name, _)| *name).collect();
        let (mut found, mut first) = (Vec::new(), None);
        let mut tried = 0;
        // The first side changes faster than the others, as in the list of all.
        while tried < MOST_BRANCHES && found.len() < most {
            let chosen = sides.iter().enumerate().map(|(place, (name, words))| {
                let second = tried.checked_shr(place as u32).unwrap_or_default() & 1;
                (*name, words.get(second).copied().map_or(Data::Nothing, Data::from))
            });
            let branch = Data::fields(chosen.chain(turns.iter().map(|name| (*name, Data::Count(0)))));
            tried += 1;
            match self.design.call("assemble", &[Self::given(inputs), branch.clone()]) {
                Ok(pose) => {
                    let data = Data::fields([("branch", branch.clone()), ("pose", pose)]);
                    found.push((words(&branch, &turns), self.of_data(inputs, data)?));
                }
                Err(error) => _ = first.get_or_insert_with(|| self.why(&error, inputs)),
            }
        }
        match first.filter(|_| found.is_empty()) {
            Some(why) => Err(why),
            None => Ok((found, branches.unwrap_or(usize::MAX).saturating_sub(tried))),
        }
    }

    /// The reason why a call has no value at these inputs.
    fn why(&self, error: &CallError, inputs: &[f64]) -> String {
        self.reasons.of_call(error, [self.design.parameters(), inputs], &self.branch)
    }

    /// Inputs as an argument.
    fn given(numbers: &[f64]) -> Data {
        match numbers {
            [only] => Data::from(*only),
            several => Data::from(several),
        }
    }

    /// The motion that a function returns; without points and outputs, it is another one.
    fn called(&self, function: &str, from: Data, inputs: &[f64], rates: &[f64]) -> Result<Motion, String> {
        let still = vec![0.0; inputs.len()];
        let arguments = [from, self.branch.clone(), Self::given(rates), Self::given(&still)];
        let has_quantities = !self.points.is_empty() || !self.outputs.is_empty();
        let function = if has_quantities { function } else { function.trim_start_matches("full_") };
        let data = self.design.call(function, &arguments).map_err(|error| self.why(&error, inputs))?;
        self.of_data(inputs, data)
    }

    /// The motion that data with a pose is.
    fn of_data(&self, inputs: &[f64], data: Data) -> Result<Motion, String> {
        let unknowns = data.get("pose").map(|pose| self.of_pose(pose)).transpose()?.unwrap_or_default();
        Ok(Motion { inputs: inputs.to_vec(), unknowns, is_followed: false, data })
    }

    /// The unknowns of a pose, as the equations have them.
    fn of_pose(&self, pose: &Data) -> Result<Vec<f64>, String> {
        let all = self.design.coordinates(pose).map_err(|error| self.reasons.of_error(&error))?;
        let number = |of: &Coordinate| all.get(&of.name.field).and_then(Data::number).unwrap_or(f64::NAN);
        Ok(self.unknowns.iter().map(number).collect())
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
