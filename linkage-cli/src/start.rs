//! The position that is asked for: on the branch, from a guess, or the listed one that is nearest to it.

use linkage_interpreter::Mechanism;

use crate::about::About;
use crate::arguments::Numbers;
use crate::failure::Failure;
use crate::names::{once, place};
use crate::values::{Assignment, Choice};

/// The position that is asked for.
#[derive(Debug, Clone, PartialEq)]
pub enum Start {
    /// The position on the branch, in closed form.
    Closed,
    /// A guess of the unknowns, for Newton's method.
    Guess(Vec<f64>),
    /// A position by its number, in the branch.
    Listed,
    /// The position that is nearest to a guess, of all.
    Near(Near),
}

/// A guess of some unknowns, to which a position of a list is near.
#[derive(Debug, Clone, PartialEq)]
pub struct Near {
    guess: Vec<Option<f64>>,
    /// The choices of --branch, which the position has too.
    choices: Vec<Choice>,
    pub among: Among,
}

/// The positions of which one is near a guess.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Among {
    /// All have a closed form.
    Closed,
    /// They are listed.
    Listed,
    /// On each branch of the groups in closed form, that which Newton's method finds from the guess of the others.
    Found,
}

/// The most groups whose sides are tried.
const MOST_SIDES: usize = 10;

impl Near {
    /// The guess for Newton's method.
    pub fn guess(&self) -> Vec<f64> {
        self.guess.iter().map(|guess| guess.unwrap_or_default()).collect()
    }

    /// The branches of the groups in closed form in words, those of --branch first; none if they are too many.
    pub fn branches(&self, mechanism: &Mechanism) -> Option<Vec<Vec<Choice>>> {
        let [sides, ..] = mechanism.branch_fields();
        let free: Vec<_> =
            sides.iter().filter(|(name, _)| self.choices.iter().all(|choice| choice.name != *name)).collect();
        let with = |all: Vec<Vec<Choice>>, (name, words): &(&str, Vec<&str>)| {
            let each = |branch: &Vec<Choice>| {
                let choice = |word: &&str| Choice { name: (*name).to_owned(), word: (*word).to_owned() };
                words.iter().map(|word| [branch.clone(), vec![choice(word)]].concat()).collect::<Vec<_>>()
            };
            all.iter().flat_map(each).collect()
        };
        (free.len() <= MOST_SIDES).then(|| free.into_iter().fold(vec![self.choices.clone()], with))
    }

    /// The choices of the position that is nearest to the guess, of those with the choices of --branch; none without one.
    pub fn nearest<'p>(
        &self,
        about: &About,
        positions: impl Iterator<Item = (Vec<Choice>, &'p Vec<f64>)>,
    ) -> Option<Vec<Choice>> {
        let has = |own: &[Choice], of: &Choice| {
            own.iter().all(|one| one.name != of.name || one.word.eq_ignore_ascii_case(&of.word))
        };
        let positions: Vec<_> =
            positions.filter(|(own, _)| self.choices.iter().all(|choice| has(own, choice))).collect();
        let off = |unknowns: &[f64]| -> f64 {
            let each = self.guess.iter().zip(unknowns).zip(&about.unknowns).enumerate();
            each.filter_map(|(place, ((guess, value), of))| {
                let guess = (*guess)?;
                if of.is_angle {
                    return Some((2.0 * ((value - guess) / 2.0).sin()).abs());
                }
                // In parts of the largest of these lengths.
                let all = positions.iter().filter_map(|(_, unknowns)| unknowns.get(place)).map(|value| value.abs());
                let size = all.fold(guess.abs(), f64::max);
                Some(if size > 0.0 { (value - guess).abs() / size } else { 0.0 })
            })
            .fold(0.0, f64::max)
        };
        let nearest = positions.iter().min_by(|(_, one), (_, other)| off(one).total_cmp(&off(other)));
        let (own, _) = nearest?;
        // The choices of --branch have the turns of angles too.
        let more = self.choices.iter().filter(|choice| own.iter().all(|one| one.name != choice.name)).cloned();
        Some(own.iter().cloned().chain(more).collect())
    }
}

impl Start {
    pub fn of(about: &About, mechanism: &Mechanism, numbers: &Numbers) -> Result<Self, Failure> {
        let (name, wrong) = (&about.name, |message: String| Err(Failure::Argument(message)));
        let [_, listed, _] = mechanism.branch_fields();
        let needed: Vec<&str> = about.guessed.iter().map(|place| about.unknowns[*place].name.text.as_str()).collect();
        let all: Vec<&str> = about.unknowns.iter().map(|unknown| unknown.name.text.as_str()).collect();
        let is_listed = needed.is_empty() || !listed.is_empty();
        let mut guess = vec![None; about.unknowns.len()];
        once("--guess", numbers.guess.iter().map(|guess| guess.name.as_str()))?;
        for Assignment { name: of, value } in &numbers.guess {
            let place = place(name, "unknown", of, &all)?;
            guess[place] = Some(about.unknowns[place].value(*value)?);
        }
        if numbers.guess.is_empty() && is_listed {
            return Ok(if needed.is_empty() { Self::Closed } else { Self::Listed });
        }
        let choice = numbers.branch.iter().find(|choice| listed.iter().any(|(group, _)| *group == choice.name));
        if let Some(choice) = choice {
            return wrong(format!("--guess and --branch {} choose the same position: leave out one", choice.name));
        }
        let missing: Vec<usize> = about.guessed.iter().copied().filter(|place| guess[*place].is_none()).collect();
        let is_of_others = (0..all.len()).any(|place| guess[place].is_some() && !about.guessed.contains(&place));
        let near = |among| Self::Near(Near { guess: guess.clone(), choices: numbers.branch.clone(), among });
        if is_listed && (needed.is_empty() || is_of_others) {
            return Ok(near(if needed.is_empty() { Among::Closed } else { Among::Listed }));
        }
        if !missing.is_empty() {
            let missing: Vec<String> = missing.iter().map(|place| format!("{}=VALUE", all[*place])).collect();
            return wrong(format!("positions of `{name}` are found from a guess: write --guess {}", missing.join(",")));
        }
        if is_of_others {
            return Ok(near(Among::Found));
        }
        // The others follow from these.
        Ok(Self::Guess(guess.into_iter().map(Option::unwrap_or_default).collect()))
    }
}

/// The choices of a branch in words.
pub fn choices(branch: &str) -> Option<Vec<Choice>> {
    let each = branch.split(", ").filter(|choice| !choice.is_empty());
    each.map(|choice| choice.parse().ok()).collect()
}
