//! A mechanism with numbers: values of its parameters, a branch, and the inputs that are held.

use linkage_compiler::Lowered;
use linkage_compiler::graph::NodeId;
use linkage_compiler::model::Kind;
use linkage_interpreter::{Data, Mechanism};

use crate::about::{About, chosen};
use crate::arguments::Numbers;
use crate::failure::Failure;
use crate::following::{Following, Start};
use crate::names::{once, place};
use crate::solver::Solver;
pub use crate::solver::{Coordinate, Motion, Named};
use crate::source::read;
use crate::values::{Assignment, Choice};

/// A mechanism with values for all but its inputs.
pub struct Machine {
    pub about: About,
    parameters: Vec<(String, f64)>,
    /// Its positions without regard to a motion.
    pub solver: Solver,
    /// The finder of positions without a closed form.
    following: Option<Following>,
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
        let following = start(&about, &mechanism, numbers)?.map(Following::new);
        let values: Vec<f64> = parameters.iter().map(|(_, value)| *value).collect();
        let design = mechanism.design().with_parameters(&values);
        let of_kinds = about.defaults.iter().zip(&values).filter(|((_, kind), _)| *kind == Kind::Length);
        let length = of_kinds.fold(0.0, |largest: f64, (_, value)| largest.max(value.abs()));
        let has_quantities = !about.points.is_empty() || !about.outputs.is_empty();
        let (inputs, unknowns) = (about.inputs.clone(), about.unknowns.clone());
        let solver = Solver { name: about.name.clone(), inputs, unknowns, has_quantities, length, design, branch };
        Ok((Self { about, parameters, solver, following }, result))
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

    /// Position, velocity and acceleration; rates are constant. Without a closed form it is a position of the motion through those
    /// that were asked for before.
    pub fn motion(&self, inputs: &[f64], rates: &[f64]) -> Result<Motion, String> {
        match &self.following {
            Some(following) => following.motion(&self.solver, inputs, rates),
            None => self.solver.motion(inputs, rates),
        }
    }

    /// All positions at these inputs, each with its branch in words; or why they are not listed.
    pub fn positions(&self, inputs: &[f64]) -> Result<Vec<(String, Motion)>, String> {
        self.solver.positions(inputs)
    }

    /// The outputs by their formulas at these values of the unknowns, whose angles may be on other turns.
    pub fn outputs_at(&self, inputs: &[f64], unknowns: &[f64]) -> Vec<f64> {
        let derivation = &self.about.derivation;
        let nodes: Vec<NodeId> = derivation.outputs.iter().flat_map(|output| output.value.iter().copied()).collect();
        derivation.graph.evaluate(&nodes, |symbol| self.value(derivation.graph.symbol_name(symbol), inputs, unknowns))
    }

    /// The value of a symbol of the formulas at a position.
    pub fn symbol(&self, name: &str, motion: &Motion) -> f64 {
        self.value(name, &motion.inputs, &motion.unknowns)
    }

    fn value(&self, name: &str, inputs: &[f64], unknowns: &[f64]) -> f64 {
        let of = |coordinates: &[Coordinate], values: &[f64]| {
            let place = coordinates.iter().position(|of| of.name.text == name)?;
            values.get(place).copied()
        };
        let parameter = self.parameters.iter().find(|(other, _)| other == name).map(|(_, value)| *value);
        let coordinate = of(&self.about.inputs, inputs).or_else(|| of(&self.about.unknowns, unknowns));
        parameter.or(coordinate).unwrap_or(f64::NAN)
    }
}

/// The parameters with their values.
fn parameters(about: &About, mechanism: &Mechanism, set: &[Assignment]) -> Result<Vec<(String, f64)>, Failure> {
    let mut values = mechanism.design().parameters().to_vec();
    let names: Vec<&str> = about.parameters.iter().map(String::as_str).collect();
    once("--set", set.iter().map(|set| set.name.as_str()))?;
    for Assignment { name, value } in set {
        let place = place(&about.name, "parameter", name, &names)?;
        values[place] = match about.defaults[place].1 {
            Kind::Angle => value.angle(name),
            Kind::Length => value.length(name),
            Kind::Number => Ok(value.number),
        }
        .map_err(Failure::Argument)?;
    }
    let parameters: Vec<(String, f64)> = about.parameters.iter().cloned().zip(values).collect();
    match parameters.iter().find(|(_, value)| value.is_nan()) {
        Some((name, _)) => {
            Err(Failure::Argument(format!("the parameter `{name}` has no value: write --set {name}=VALUE")))
        }
        None => Ok(parameters),
    }
}

/// The beginning of a motion without closed forms: the guess that is given, or a position that is listed.
fn start(about: &About, mechanism: &Mechanism, numbers: &Numbers) -> Result<Option<Start>, Failure> {
    let (name, wrong) = (&about.name, |message: String| Err(Failure::Argument(message)));
    let [_, listed, _] = mechanism.branch_fields();
    let needed: Vec<&str> = about.guessed.iter().map(|place| about.unknowns[*place].name.text.as_str()).collect();
    let mut guess = vec![None; about.unknowns.len()];
    once("--guess", numbers.guess.iter().map(|guess| guess.name.as_str()))?;
    for Assignment { name: of, value } in &numbers.guess {
        if needed.is_empty() {
            return wrong(format!("positions of `{name}` need no guess: choose one by --branch"));
        }
        let place = about.guessed[place(name, "unknown without a closed form", of, &needed)?];
        guess[place] = Some(about.unknowns[place].value(*value)?);
    }
    let missing = about.guessed.iter().filter(|place| guess[**place].is_none());
    let missing: Vec<String> = missing.map(|place| format!("{}=VALUE", about.unknowns[*place].name.text)).collect();
    if needed.is_empty() {
        return Ok(None);
    }
    if numbers.guess.is_empty() && !listed.is_empty() {
        return Ok(Some(Start::Listed));
    }
    if let Some(choice) = numbers.branch.iter().find(|choice| listed.iter().any(|(group, _)| *group == choice.name)) {
        return wrong(format!("--guess and --branch {} choose the same position: leave out one", choice.name));
    }
    if !missing.is_empty() {
        return wrong(format!("positions of `{name}` are found from a guess: write --guess {}", missing.join(",")));
    }
    // The others follow from these.
    Ok(Some(Start::Guess(guess.into_iter().map(Option::unwrap_or_default).collect())))
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
