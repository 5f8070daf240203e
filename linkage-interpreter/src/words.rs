//! Errors in plain words, for readers of programs and pages: without measures of a method and functions of Rust, and with angles in
//! degrees.

use linkage_dynamics::MotionError;
use linkage_runtime::__shared::Shown;
use linkage_runtime::{InputError, Name, PathError, PositionError, RangeEnd};

use crate::call_error::CallError;
use crate::error::Error;

/// The words of one mechanism: it is known which of its names are angles.
#[derive(Clone, Copy)]
pub struct Words<'a> {
    is_angle: &'a dyn Fn(&str) -> bool,
}

impl<'a> Words<'a> {
    /// The words of a mechanism; `is_angle` is true for the name of an angle.
    #[must_use]
    pub fn new(is_angle: &'a dyn Fn(&str) -> bool) -> Self {
        Self { is_angle }
    }

    fn shown(self, name: &str, value: f64) -> Shown {
        Shown { value, is_angle: (self.is_angle)(name) }
    }

    /// The error of a call.
    #[must_use]
    pub fn call(self, error: &CallError) -> String {
        match error {
            CallError::Function(Error::Position(error)) => self.position(error),
            CallError::Function(Error::Motion(error)) => self.motion(error),
            other => other.to_string(),
        }
    }

    /// The reason why there is no position.
    #[must_use]
    pub fn position<N: Name>(self, error: &PositionError<N>) -> String {
        match error {
            PositionError::Singular { mechanism, group, .. } => {
                format!("{mechanism} is at a dead point or a change point of {group}")
            }
            PositionError::Unbuildable { mechanism, group, inputs, .. } => {
                format!(
                    "{mechanism} cannot be assembled at {inputs}: group {group} does not close, its links do not reach each \
                     other"
                )
            }
            PositionError::Undetermined { mechanism, group } => format!(
                "{mechanism} has infinitely many positions of {group} here: joints coincide, or a link has no length"
            ),
            PositionError::NotConverged { mechanism, .. } => {
                format!("no position of {mechanism} is found near this guess: give a nearer one")
            }
            PositionError::OtherBranch { mechanism, group } => format!(
                "the position of {mechanism} that is found is on another branch than the guess: {group} is singular \
                 between the two"
            ),
            PositionError::NotImplied { mechanism, equation, .. } => {
                format!("{equation} of {mechanism} does not close at this position: check the lengths and the branch")
            }
            PositionError::NoClosedForm { mechanism, group } => {
                format!("{group} of {mechanism} has no closed form: give a guess of these unknowns")
            }
            PositionError::TooManyBranches { mechanism } => {
                format!("{mechanism} has too many positions to list them: choose one by its branch")
            }
            PositionError::NoMode { mechanism, group, count: 0, .. } => {
                format!("{mechanism} has no position here: the links of {group} do not reach each other")
            }
            PositionError::NoMode { mechanism, group, number, count } => format!(
                "{group} of {mechanism} has {count} positions here, numbered from 0: there is no number {number}"
            ),
            PositionError::Undecided { mechanism, group, .. } => format!(
                "it is not decided how many positions {group} of {mechanism} has here: some of them meet, or nearly so"
            ),
            PositionError::Input(error) => self.input(error),
            other => other.to_string(),
        }
    }

    /// The reason why a motion is not followed.
    #[must_use]
    pub fn path<N: Name>(self, error: &PathError<N>) -> String {
        match error {
            PathError::DeadPoint { mechanism, group, .. } => {
                format!("{mechanism} does not get to this input: a dead point of {group} is before it")
            }
            PathError::JointRange { mechanism, of, end, .. } => {
                let end = if *end == RangeEnd::Least { "least" } else { "largest" };
                format!("{mechanism} does not get to this input: {of} has its {end} value before it")
            }
            PathError::ChangePoint { mechanism, group } => {
                format!("motions of {mechanism} cross at a change point of {group}")
            }
            PathError::NoDirection { mechanism } => format!("{mechanism} is at a dead point"),
            PathError::Lost { mechanism, group, .. } => format!(
                "the motion of {mechanism} is not followed any farther: {group} is near a dead point or a change point"
            ),
            PathError::TooManySteps { mechanism, steps } => {
                format!("the motion of {mechanism} is not followed to its end in {steps} steps")
            }
            PathError::Position(error) => self.position(error),
            PathError::Input(error) => self.input(error),
            other => other.to_string(),
        }
    }

    /// The reason why a simulation ends.
    #[must_use]
    pub fn motion<N: Name>(self, error: &MotionError<N>) -> String {
        match error {
            MotionError::TooManySteps { t, steps } => {
                format!("the limit of {steps} steps is reached at {t:.6} s: give a larger tolerance, or more steps")
            }
            MotionError::Position(error) => self.position(error),
            MotionError::Path(error) => self.path(error),
            MotionError::Input(error) => self.input(error),
            other => other.to_string(),
        }
    }

    /// The mistake of a number that is given.
    #[must_use]
    pub fn input<N: Name>(self, error: &InputError<N>) -> String {
        match error {
            InputError::OutOfRange { of, quantity, value, least, most } => {
                let shown = |value: f64| self.shown(&quantity.to_string(), value);
                let of = of.as_ref().map_or_else(String::new, |of| format!(" of {of}"));
                let range = match (*least > f64::MIN, *most < f64::MAX) {
                    (true, true) => format!("between {} and {}", shown(*least), shown(*most)),
                    (true, false) => format!("at least {}", shown(*least)),
                    (false, true) => format!("at most {}", shown(*most)),
                    (false, false) => "a finite number".to_owned(),
                };
                format!("{quantity}{of} is {}: it must be {range}", shown(*value))
            }
            InputError::EmptyRange { scene, stop, lower, upper } => {
                let shown = |value: f64| self.of_contact(&stop.to_string(), value);
                let (lower, upper) = (shown(*lower), shown(*upper));
                format!("the {stop} in {scene} is from {lower} to {upper}: the first must be less than the second")
            }
            InputError::EmptyJointRange { mechanism, of, least, most } => {
                let shown = |value: f64| self.shown(&of.to_string(), value);
                let (least, most) = (shown(*least), shown(*most));
                format!(
                    "the range of {of} in {mechanism} is from {least} to {most}: the first must be less than the second"
                )
            }
            InputError::Inconsistent { scene, coordinate, quantity, gap } => {
                let gap = self.shown(&coordinate.to_string(), *gap);
                format!("{scene} starts with a {quantity} of {coordinate} that differs by {gap} from its drive")
            }
            InputError::BeyondStop { scene, stop, gap } => {
                format!("{scene} starts {} beyond the {stop}", self.of_contact(&stop.to_string(), *gap))
            }
            other => other.to_string(),
        }
    }

    /// A value of the quantity of a stop: `stop on s`.
    fn of_contact(self, contact: &str, value: f64) -> Shown {
        self.shown(contact.rsplit(' ').next().unwrap_or(contact), value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_theta(name: &str) -> bool {
        name == "theta"
    }

    #[test]
    fn angles_are_in_degrees() {
        let words = Words::new(&is_theta);
        let of = |quantity: &'static str| InputError::OutOfRange {
            of: Some("Bar"),
            quantity,
            value: 100_f64.to_radians(),
            least: 0.0,
            most: 90_f64.to_radians(),
        };
        assert_eq!(words.input(&of("theta")), "theta of Bar is 100°: it must be between 0° and 90°");
        assert_eq!(words.input(&of("s")), "s of Bar is 1.745329: it must be between 0 and 1.570796");
        let beyond = InputError::BeyondStop { scene: "Drop", stop: "stop on theta", gap: 0.1_f64.to_radians() };
        assert_eq!(words.input(&beyond), "Drop starts 0.1° beyond the stop on theta");
    }

    /// No word is one of a method.
    #[test]
    fn words_are_plain() {
        let words = Words::new(&is_theta);
        let (mechanism, group) = ("Bar", "phi, psi");
        let inputs = Default::default();
        let positions = [
            PositionError::Singular { mechanism, group, regularity: 1e-9 },
            PositionError::Unbuildable { mechanism, group, gap: 0.1, inputs },
            PositionError::Undetermined { mechanism, group },
            PositionError::NotConverged {
                mechanism,
                group: Some(group),
                iterations: 7,
                residual: 0.25,
                regularity: 0.125,
            },
            PositionError::OtherBranch { mechanism, group },
            PositionError::NotImplied { mechanism, equation: "implied loop 1", residual: 0.1 },
            PositionError::NoClosedForm { mechanism, group },
            PositionError::TooManyBranches { mechanism },
            PositionError::NoMode { mechanism, group, number: 3, count: 2 },
            PositionError::Undecided { mechanism, group, regularity: 0.1 },
        ];
        let paths = [
            PathError::DeadPoint { mechanism, group, gap: 0.1 },
            PathError::ChangePoint { mechanism, group },
            PathError::NoDirection { mechanism },
            PathError::Lost { mechanism, group, iterations: 7, residual: 0.25, regularity: 0.125 },
            PathError::TooManySteps { mechanism, steps: 100 },
        ];
        let all =
            positions.iter().map(|error| words.position(error)).chain(paths.iter().map(|error| words.path(error)));
        for text in all {
            for word in ["residual", "trials", "gap", "regularity", "Newton", "`", "::", "determinant"] {
                assert!(!text.contains(word), "{text}");
            }
        }
    }
}
