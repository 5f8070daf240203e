//! Values of parameters: those of a mechanism, and those that a scene has of its own.

use linkage_compiler::model::Measure;

use crate::failure::Failure;
use crate::names::{once, place};
use crate::values::Assignment;

/// Parameters with what they measure and their values, NaN for one that has none.
pub struct Parameters<'a> {
    of: &'a str,
    all: Vec<(&'a str, Measure, f64)>,
}

impl<'a> Parameters<'a> {
    /// The parameters of a mechanism of this name.
    pub fn of(mechanism: &'a str, all: impl IntoIterator<Item = (&'a str, Measure, f64)>) -> Self {
        Self { of: mechanism, all: all.into_iter().collect() }
    }

    /// The values with those that are set.
    pub fn with(mut self, set: &[Assignment]) -> Result<Vec<f64>, Failure> {
        let names: Vec<&str> = self.all.iter().map(|(name, ..)| *name).collect();
        once("--set", set.iter().map(|set| set.name.as_str()))?;
        for Assignment { name, value } in set {
            let (_, measure, to) = &mut self.all[place(self.of, "parameter", name, &names)?];
            *to = match measure {
                Measure::Angle => value.angle(name),
                Measure::Rate => value.rate_of_angle(name),
                Measure::Length => value.length(name),
                Measure::Number => Ok(value.number),
            }
            .map_err(Failure::Argument)?;
        }
        match self.all.iter().find(|(.., value)| value.is_nan()) {
            Some((name, ..)) => {
                Err(Failure::Argument(format!("the parameter `{name}` has no value: write --set {name}=VALUE")))
            }
            None => Ok(self.all.into_iter().map(|(.., value)| value).collect()),
        }
    }
}
