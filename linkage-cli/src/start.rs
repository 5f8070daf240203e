//! The first position of a motion without closed forms: a guess that is given, or a position that is listed.

use linkage_interpreter::Mechanism;

use crate::about::About;
use crate::arguments::Numbers;
use crate::failure::Failure;
use crate::names::{once, place};
use crate::values::Assignment;

/// The beginning of a motion.
#[derive(Debug, Clone, PartialEq)]
pub enum Start {
    /// The position on the branch, in closed form.
    Closed,
    /// A guess of the unknowns.
    Guess(Vec<f64>),
    /// A position by its number, in the branch.
    Listed,
}

impl Start {
    pub fn of(about: &About, mechanism: &Mechanism, numbers: &Numbers) -> Result<Self, Failure> {
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
            return Ok(Self::Closed);
        }
        if numbers.guess.is_empty() && !listed.is_empty() {
            return Ok(Self::Listed);
        }
        let choice = numbers.branch.iter().find(|choice| listed.iter().any(|(group, _)| *group == choice.name));
        if let Some(choice) = choice {
            return wrong(format!("--guess and --branch {} choose the same position: leave out one", choice.name));
        }
        if !missing.is_empty() {
            return wrong(format!("positions of `{name}` are found from a guess: write --guess {}", missing.join(",")));
        }
        // The others follow from these.
        Ok(Self::Guess(guess.into_iter().map(Option::unwrap_or_default).collect()))
    }
}
