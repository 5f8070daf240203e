//! Names of the emitted program.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::{FxHashMap, FxHashSet};

use crate::derivation::Coordinate;
use crate::graph::SymbolId;
use crate::model::{Driver, Mechanism, Request, SceneRequest};

pub use linkage_ir::code::TypeNames;

/// The greatest length of a generated name in bytes; values with longer ones are numbered.
pub const LONGEST_NAME: usize = 36;

/// The names in use in one scope.
#[derive(Debug, Clone)]
pub struct Taken<'a> {
    /// Names that no value may have, such as those of arguments.
    reserved: &'a BTreeSet<String>,
    names: FxHashSet<String>,
    /// The next number for each stem: finding a free name takes constant time.
    numbers: FxHashMap<String, usize>,
}

impl<'a> Taken<'a> {
    pub fn new(reserved: &'a BTreeSet<String>) -> Self {
        Self { reserved, names: FxHashSet::default(), numbers: FxHashMap::default() }
    }

    /// All names are free.
    pub fn unreserved() -> Self {
        static NOTHING: BTreeSet<String> = BTreeSet::new();
        Self::new(&NOTHING)
    }

    /// Returns the preferred name, or one with a number if it is taken.
    pub fn unique(&mut self, preferred: &str) -> String {
        if self.claim(preferred) { preferred.to_owned() } else { self.numbered(preferred, 2) }
    }

    fn claim(&mut self, name: &str) -> bool {
        !self.reserved.contains(name) && self.names.insert(name.to_owned())
    }

    /// Returns the stem with the next free number, from `first` on.
    pub fn numbered(&mut self, stem: &str, first: usize) -> String {
        let mut number = self.numbers.get(stem).copied().unwrap_or(first);
        loop {
            let name = format!("{stem}_{number}");
            number += 1;
            if self.claim(&name) {
                self.numbers.insert(stem.to_owned(), number);
                return name;
            }
        }
    }
}

/// Converts a text to a name: `phi2` stays, `phi2 - delta` becomes `phi2_minus_delta`. `None` if the result is not an
/// identifier or longer than [`LONGEST_NAME`].
pub fn name_of(text: &str) -> Option<String> {
    let mut name = String::new();
    let mut separate = false;
    for letter in text.chars() {
        let word = match letter {
            '-' => "minus",
            '+' => "plus",
            '*' => "times",
            '/' => "over",
            letter if letter.is_alphanumeric() || letter == '_' => {
                if separate && !name.is_empty() {
                    name.push('_');
                }
                separate = false;
                name.push(letter);
                continue;
            }
            _ => {
                separate = true;
                continue;
            }
        };
        if !name.is_empty() {
            name.push('_');
        }
        name.push_str(word);
        separate = true;
    }
    let starts_well = name.chars().next().is_some_and(|first| first.is_alphabetic() || first == '_');
    (starts_well && name.len() <= LONGEST_NAME).then_some(name)
}

/// The private function that calls a user function.
pub fn call_of(names: &[String]) -> String {
    format!("extern_{}", names.first().map_or("", String::as_str))
}

/// The order of a derivative with respect to time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    Value,
    Rate,
    Acceleration,
    Jerk,
}

impl Order {
    /// All of them, in order.
    pub const ALL: [Self; 4] = [Self::Value, Self::Rate, Self::Acceleration, Self::Jerk];

    /// The type of all coordinates, or of their derivatives with respect to time.
    pub fn type_of(self, names: &TypeNames) -> &str {
        match self {
            Self::Value => &names.coordinates,
            Self::Rate => &names.rates,
            Self::Acceleration => &names.accelerations,
            Self::Jerk => &names.jerks,
        }
    }

    /// The symbol of a coordinate or of its derivative.
    pub fn symbol(self, of: &Coordinate) -> SymbolId {
        match self {
            Self::Value => of.value,
            Self::Rate => of.rate,
            Self::Acceleration => of.acceleration,
            Self::Jerk => of.jerk,
        }
    }
}

/// The names of the types of a driver.
pub fn type_names(mechanism: &Mechanism, driver: &Driver) -> TypeNames {
    let (own, shared) = (&driver.name, &mechanism.name);
    TypeNames {
        itself: own.to_string(),
        driver: own.to_string(),
        inputs: format!("{own}Inputs"),
        pose: format!("{own}Pose"),
        coordinates: format!("{shared}Coordinates"),
        rates: format!("{shared}Rates"),
        accelerations: format!("{shared}Accelerations"),
        jerks: format!("{shared}Jerks"),
        points: format!("{shared}Points"),
        outputs: format!("{shared}Outputs"),
        motion: format!("{own}Motion"),
        kinematics: format!("{own}Kinematics"),
        full_kinematics: format!("{own}FullKinematics"),
        columns: format!("{own}Columns"),
        branch: format!("{own}Branch"),
    }
}

/// The names of the types that a mechanism emits, by the mechanism, driver or scene that they belong to.
pub fn emitted_types(mechanism: &Mechanism) -> BTreeMap<String, Vec<String>> {
    let mut types: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let has_quantities = !mechanism.points.is_empty() || !mechanism.outputs.is_empty();
    let has = |request| mechanism.requests.contains(&request);
    let mut shared = Vec::new();
    for driver in &mechanism.drivers {
        let names = type_names(mechanism, driver);
        let columns = has(Request::Lanes).then_some(names.columns);
        let full = has_quantities.then_some(names.full_kinematics);
        let own = [names.itself, names.inputs, names.pose, names.motion, names.kinematics, names.branch];
        types.entry(driver.name.to_string()).or_default().extend(own.into_iter().chain(columns).chain(full));
        let jerks = has(Request::Jerk).then_some(names.jerks);
        let points = (!mechanism.points.is_empty()).then_some(names.points);
        let outputs = (!mechanism.outputs.is_empty()).then_some(names.outputs);
        let always = [names.coordinates, names.rates, names.accelerations];
        shared = always.into_iter().chain(jerks).chain(points).chain(outputs).collect();
    }
    let name = mechanism.name.to_string();
    if mechanism.is_driven_by_choice() {
        shared.push(name.clone());
    }
    types.entry(name).or_default().extend(shared);
    for scene in &mechanism.scenes {
        let of_scene = types.entry(format!("scene {}", scene.name)).or_default();
        of_scene.push(scene.name.to_string());
        if !scene.drives.is_empty() {
            of_scene.push(format!("{}Drives", scene.name));
        }
        if scene.requests.contains(&SceneRequest::Reactions) || !scene.loads.is_empty() {
            of_scene.push(format!("{}Reactions", scene.name));
        }
    }
    types
}

/// The arguments and local values that functions have in common.
#[derive(Debug, Clone)]
pub struct Arguments {
    pub pose: String,
    pub q: String,
    /// `q'`, `q''` and `q'''`.
    pub rates: String,
    pub accelerations: String,
    pub jerks: String,
    /// `v'`, `v''` and `v'''`.
    pub input_rates: String,
    pub input_accelerations: String,
    pub input_jerks: String,
    pub right: String,
    pub branch: String,
    pub turn: String,
    pub memory: String,
    pub inputs: String,
    /// u and u' in a column.
    pub unknowns: String,
    pub unknown_rates: String,
    pub guess: String,
    pub position: String,
    pub ratios: String,
    pub bias: String,
    pub contact_forces: String,
    /// The name of the mechanism or scene in errors.
    pub error_name: String,
    pub time: String,
}

impl Arguments {
    pub fn new(mechanism: &Mechanism) -> Self {
        let name = |preferred: &str| argument(mechanism, preferred);
        Self {
            pose: name("pose"),
            q: name("q"),
            rates: name("rates"),
            accelerations: name("accelerations"),
            jerks: name("jerks"),
            input_rates: name("input_rates"),
            input_accelerations: name("input_accelerations"),
            input_jerks: name("input_jerks"),
            right: name("right"),
            branch: name("branch"),
            turn: name("turn"),
            memory: name("memory"),
            inputs: name("inputs"),
            unknowns: name("unknowns"),
            unknown_rates: name("unknown_rates"),
            guess: name("guess"),
            position: name("position"),
            ratios: name("ratios"),
            bias: name("bias"),
            contact_forces: name("contact_forces"),
            error_name: name("error_name"),
            time: mechanism.time.map_or("t", |time| mechanism.graph.symbol_name(time)).to_owned(),
        }
    }

    /// The argument that holds all coordinates, or their derivatives with respect to time.
    pub fn of(&self, order: Order) -> &str {
        match order {
            Order::Value => &self.q,
            Order::Rate => &self.rates,
            Order::Acceleration => &self.accelerations,
            Order::Jerk => &self.jerks,
        }
    }

    /// The argument that holds the inputs, or their derivatives with respect to time.
    pub fn of_inputs(&self, order: Order) -> &str {
        match order {
            Order::Value => &self.inputs,
            Order::Rate => &self.input_rates,
            Order::Acceleration => &self.input_accelerations,
            Order::Jerk => &self.input_jerks,
        }
    }

    /// The names that no value may have.
    pub fn reserved(&self) -> BTreeSet<String> {
        let Self {
            pose,
            q,
            rates,
            accelerations,
            jerks,
            input_rates,
            input_accelerations,
            input_jerks,
            right,
            branch,
            turn,
            memory,
            inputs,
            unknowns,
            unknown_rates,
            guess,
            position,
            ratios,
            bias,
            contact_forces,
            error_name,
            time: _,
        } = self;
        let all = [
            pose,
            q,
            rates,
            accelerations,
            jerks,
            input_rates,
            input_accelerations,
            input_jerks,
            right,
            branch,
            turn,
            memory,
            inputs,
            unknowns,
            unknown_rates,
            guess,
            position,
            ratios,
            bias,
            contact_forces,
            error_name,
        ];
        all.into_iter().cloned().chain(["self".to_owned()]).collect()
    }
}

/// Returns the preferred name of an argument, with underscores added if a parameter or coordinate has it.
pub fn argument(mechanism: &Mechanism, preferred: &str) -> String {
    let parameters = mechanism.parameters.iter().chain(&mechanism.scene_parameters);
    let parameters = parameters.map(|parameter| &parameter.name.field);
    let coordinates = mechanism.coordinates.iter().map(|coordinate| &coordinate.name.field);
    let all: BTreeSet<&String> = parameters.chain(coordinates).collect();
    let mut name = preferred.to_owned();
    while all.contains(&name) {
        name.push('_');
    }
    name
}
