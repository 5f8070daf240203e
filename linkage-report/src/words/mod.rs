//! The words of sheets, one table for each language.

mod english;
mod italian;
mod names;

use linkage_runtime::derivation::{Formula, FormulaView, Group, GroupMethod};

use crate::sheet::{latex, number};

/// The language of a sheet or a drawing. Names and doc comments of a mechanism are not translated, and numbers keep the decimal
/// point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Language {
    /// English, the default.
    #[default]
    English,
    /// Italian.
    Italian,
}

/// The words of one language: headings, sentences that lead to formulas, and patterns with parts.
#[derive(Debug)]
pub(crate) struct Words {
    /// The language of a page, as HTML names it.
    pub(crate) tag: &'static str,
    pub(crate) coordinates: &'static str,
    pub(crate) open_chain: &'static str,
    pub(crate) constraints: &'static str,
    pub(crate) jacobian: &'static str,
    pub(crate) structure: &'static str,
    pub(crate) ratios: &'static str,
    pub(crate) acceleration: &'static str,
    pub(crate) ratio_derivatives: &'static str,
    pub(crate) jerk: &'static str,
    pub(crate) sensitivity: &'static str,
    pub(crate) points: &'static str,
    pub(crate) outputs: &'static str,
    pub(crate) motion: &'static str,
    pub(crate) joints: &'static str,
    pub(crate) potential: &'static str,
    pub(crate) operations: &'static str,
    pub(crate) conditions: &'static str,
    pub(crate) numbers: &'static str,
    pub(crate) given: &'static str,
    pub(crate) driven: &'static str,
    pub(crate) unknown: &'static str,
    pub(crate) counts: &'static str,
    pub(crate) lead_open_chain: &'static str,
    pub(crate) lead_constraints: &'static str,
    pub(crate) lead_implied: &'static str,
    pub(crate) lead_jacobian: &'static str,
    pub(crate) lead_determinant: &'static str,
    pub(crate) lead_position: &'static str,
    pub(crate) lead_newton: &'static str,
    pub(crate) lead_ratios: &'static str,
    pub(crate) lead_velocity: &'static str,
    pub(crate) lead_transmission: &'static str,
    pub(crate) lead_acceleration: &'static str,
    pub(crate) lead_gamma: &'static str,
    pub(crate) lead_ratio_derivatives: &'static str,
    pub(crate) lead_jerk: &'static str,
    pub(crate) lead_eta: &'static str,
    pub(crate) lead_sensitivity: &'static str,
    pub(crate) lead_parameters: &'static str,
    pub(crate) lead_motion: &'static str,
    pub(crate) lead_mass_matrix: &'static str,
    pub(crate) lead_forces: &'static str,
    pub(crate) lead_only_contacts: &'static str,
    pub(crate) lead_no_forces: &'static str,
    pub(crate) lead_contacts: &'static str,
    pub(crate) lead_rebound: &'static str,
    pub(crate) lead_drives: &'static str,
    pub(crate) lead_joints: &'static str,
    pub(crate) lead_multipliers: &'static str,
    pub(crate) lead_conditions: &'static str,
    pub(crate) kinematics: &'static str,
    pub(crate) group: &'static str,
    pub(crate) equations: &'static str,
    /// After the factor of a matrix whose entries follow.
    pub(crate) matrix: &'static str,
    pub(crate) function: &'static str,
    pub(crate) functions: &'static str,
    pub(crate) divisions: &'static str,
    pub(crate) multiplications: &'static str,
    pub(crate) additions: &'static str,
    pub(crate) lead_operations: &'static str,
    pub(crate) picture: &'static str,
    pub(crate) pictures: &'static str,
    pub(crate) parameters: &'static str,
    pub(crate) position: &'static str,
    pub(crate) degrees: &'static str,
    pub(crate) velocities: &'static str,
    pub(crate) accelerations: &'static str,
    /// The kinds of vectors in the legend of a drawing: velocity, acceleration, force.
    #[cfg(feature = "drawing")]
    pub(crate) vectors_drawn: [&'static str; 3],
    /// Before the points of a drawing.
    #[cfg(feature = "drawing")]
    pub(crate) points_drawn: &'static str,
    pub(crate) properties: &'static str,
    pub(crate) by_ratios: &'static str,
    pub(crate) otherwise: &'static str,
    pub(crate) not_a_number: &'static str,
    pub(crate) jacobian_rates: &'static str,
    pub(crate) lead_jacobian_rates: &'static str,
    pub(crate) lead_chain_rule: &'static str,
    pub(crate) lead_first_and_last: &'static str,
    pub(crate) are_jacobian_rates: &'static str,
    pub(crate) are_no_jacobian_rates: &'static str,
    pub(crate) gamma: &'static str,
    pub(crate) no_mixed_gamma: &'static str,
    pub(crate) acceleration_by_jacobians: &'static str,
    pub(crate) acceleration_by_gamma: &'static str,
    pub(crate) lead_both_equal: &'static str,
    pub(crate) choices: &'static str,
    pub(crate) lead_choices: &'static str,
    pub(crate) turning: &'static str,
    pub(crate) lead_turning: &'static str,
    pub(crate) vectors: &'static str,
    pub(crate) lead_vectors: &'static str,
    /// The end of a condition.
    pub(crate) exists: &'static str,
    /// The properties of the velocity ratios, as sentences.
    pub(crate) statements: [&'static str; 6],
    /// The kind of a group.
    pub(crate) kind: fn(&Group<'_>) -> String,
    /// The sentence about velocities and accelerations of a group.
    pub(crate) system: fn(GroupMethod) -> String,
    /// A number of equations, which links name, and their unknowns.
    pub(crate) solved: fn(usize, &str, &str) -> String,
    /// The signs of a root: its formula, the branches on which it is positive and negative.
    pub(crate) branches: fn(&str, [&str; 2]) -> String,
    /// Inputs for which a determinant has no formula.
    pub(crate) no_determinant: fn(&str) -> String,
    /// The force in the joint that limits a friction.
    pub(crate) bearing: fn(&str) -> String,
    /// The force of a friction or a stop.
    pub(crate) force_along: fn(&str) -> String,
    /// The caption of a picture at these inputs.
    pub(crate) position_at: fn(&str) -> String,
    /// The name of an effect or of a joint.
    pub(crate) name: fn(&str) -> String,
}

impl Language {
    /// The words of this language.
    pub(crate) const fn words(self) -> &'static Words {
        match self {
            Self::English => &english::WORDS,
            Self::Italian => &italian::WORDS,
        }
    }

    /// The caption of a picture at these values of the inputs, in words.
    #[must_use]
    pub fn position_at(self, inputs: &str) -> String {
        (self.words().position_at)(inputs)
    }
}

impl Words {
    /// A number to seven significant digits.
    pub(crate) fn number(&self, value: f64) -> String {
        if value.is_nan() { self.not_a_number.to_owned() } else { number(value) }
    }

    /// A number to seven significant digits as LaTeX.
    pub(crate) fn latex(&self, value: f64) -> String {
        if value.is_nan() { format!("\\text{{{}}}", self.not_a_number) } else { latex(value) }
    }

    /// The kinds of operations in the order of their columns.
    pub(crate) fn operation_counts(&self) -> [&'static str; 4] {
        [self.functions, self.divisions, self.multiplications, self.additions]
    }

    /// The statement of a property, which is one of the English ones unless someone else made it.
    pub(crate) fn statement<'s>(&self, english: &'s str) -> &'s str {
        let place = english::WORDS.statements.iter().position(|statement| *statement == english);
        place.map_or(english, |place| self.statements[place])
    }

    /// A formula in a notation; the only one with a word is that of a condition, whose end is the word.
    pub(crate) fn formula(&self, formula: &Formula<'_>, notation: String) -> String {
        let end = english::WORDS.exists;
        match (formula.view(), notation.rfind(end)) {
            (FormulaView::Exists(_), Some(at)) => {
                format!("{}{}{}", &notation[..at], self.exists, &notation[at + end.len()..])
            }
            _ => notation,
        }
    }
}

/// The words with a capital at the start.
pub(crate) fn capitalised(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use linkage_runtime::derivation::{FormulaNode, FormulaTable};

    use super::*;
    use crate::Notation;

    #[test]
    fn a_condition_ends_with_a_word() {
        let nodes = [FormulaNode::Name(0), FormulaNode::Exists(1)];
        let table = FormulaTable::checked(&nodes, &["f"], &[]).unwrap();
        let (name, exists) = (table.get(1).unwrap(), table.get(2).unwrap());
        let shown = |language: Language, of: Formula<'_>| {
            let words = language.words();
            [of.to_string(), of.to_latex(), of.to_mathml()].map(|notation| words.formula(&of, notation))
        };
        let english = shown(Language::English, exists);
        assert_eq!(english, [exists.to_string(), exists.to_latex(), exists.to_mathml()]);
        let italian = shown(Language::Italian, exists);
        assert_eq!(italian, english.map(|notation| notation.replace("exists", "esiste")));
        assert_ne!(italian[0], exists.to_string());
        assert_eq!(shown(Language::Italian, name)[0], "f");
    }

    #[test]
    fn statements_of_properties_are_translated() {
        let [english, italian] = [Language::English, Language::Italian].map(Language::words);
        for (one, other) in english.statements.iter().zip(italian.statements) {
            assert_eq!((english.statement(one), italian.statement(one)), (*one, other));
        }
        assert_eq!(italian.statement("Another one."), "Another one.");
    }

    #[test]
    fn no_number_has_words() {
        let words = Language::Italian.words();
        assert_eq!([words.number(f64::NAN), words.latex(f64::NAN)], ["non è un numero", "\\text{non è un numero}"]);
        assert_eq!(words.number(-0.5), "−0.5");
    }
}
