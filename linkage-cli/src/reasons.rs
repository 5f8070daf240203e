//! The reasons why there is no position, in plain words: which link is too short or too long, where a closed form knows it.

use linkage_compiler::Lowered;
use linkage_compiler::derivation::Reach;
use linkage_compiler::emit::Declared;
use linkage_dynamics::MotionError;
use linkage_interpreter::{CallError, Data, Error, Words};
use linkage_report::table::Cause;
use linkage_runtime::{Name, PathError, PositionError};

/// The words about the positions of a mechanism.
#[derive(Debug, Clone)]
pub struct Reasons {
    /// The names of angles, as they are written and as fields.
    angles: Vec<String>,
    reach: Reach,
    /// The groups with two solutions, each with the word of that of the negative root.
    sides: Vec<(String, String)>,
}

impl Reasons {
    pub fn of(lowered: &Lowered<'_>, angles: Vec<String>) -> Self {
        let Declared { mechanism, driver } = lowered.declared;
        let sides = lowered.program.position.sides.iter().map(|side| {
            let [_, negative] = side.choice.variants();
            (side.field.clone(), negative.to_owned())
        });
        Self { angles, reach: Reach::of(mechanism, driver, &lowered.derivation), sides: sides.collect() }
    }

    fn is_angle(&self, name: &str) -> bool {
        self.angles.iter().any(|angle| angle == name)
    }

    /// The reason why a motion is not followed from a position.
    pub fn of_path(&self, error: &PathError<&str>) -> String {
        Words::new(&|name| self.is_angle(name)).path(error)
    }

    /// The reason why a simulation ends.
    pub fn of_motion<N: Name>(&self, error: &MotionError<N>) -> String {
        Words::new(&|name| self.is_angle(name)).motion(error)
    }

    /// The reason why cells of a table are empty.
    pub fn of_cells(&self, cause: &Cause) -> String {
        match cause {
            Cause::Path(error) => Words::new(&|name| self.is_angle(name)).path(error),
            Cause::Motion(error) => self.of_motion(error),
            other => other.to_string(),
        }
    }

    /// The error of a call with these values of the parameters and the inputs, on a branch.
    pub fn of_call(&self, error: &CallError, [parameters, inputs]: [&[f64]; 2], branch: &Data) -> String {
        if let CallError::Function(Error::Position(PositionError::Unbuildable {
            mechanism, group, inputs: at, ..
        })) = error
        {
            let is_negative = |(field, word): &(String, String)| match branch.get(field) {
                Some(Data::Text(text)) => **text == **word,
                _ => false,
            };
            let negative: Vec<bool> = self.sides.iter().map(is_negative).collect();
            if let Some(missing) = self.reach.missing(parameters, inputs, &negative) {
                return format!(
                    "{mechanism} cannot be assembled at {at}: group {group} does not close, since {missing}"
                );
            }
        }
        self.of_error(error)
    }

    /// The error of another call.
    pub fn of_error(&self, error: &CallError) -> String {
        Words::new(&|name| self.is_angle(name)).call(error)
    }
}
