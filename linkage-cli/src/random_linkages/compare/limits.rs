//! The ends of motions, with their reasons.

use serde_json::Value;

use super::super::linkage::{Form, Linear};
use super::super::steps::{Node, UNITS, Why};
use super::{Comparison, class};

impl Comparison<'_> {
    /// The error of an end, by rounding.
    fn error_of_end(&self, node: &Node, why: &Why) -> Option<f64> {
        let moving = self.stepped.moving;
        let rounding = UNITS * f64::EPSILON * node.q[moving].abs();
        match why {
            Why::Range(name, _) => {
                let place = self.linkage.coordinates.iter().position(|of| of.name == *name);
                let form = match place {
                    Some(place) if place == moving => return Some(rounding),
                    Some(place) => Linear::of(place),
                    None => match &self.linkage.outputs.iter().find(|of| of.name == *name)?.form {
                        Form::Linear(form) => form.clone(),
                        Form::Angle(_) => return None,
                    },
                };
                let (errors, ratios) = (self.stepped.errors(&node.q)?, self.stepped.ratios(&node.q)?);
                let slope: f64 = form.terms.iter().map(|(factor, place)| factor * ratios[*place]).sum();
                let of_errors = form
                    .terms
                    .iter()
                    .map(|(factor, place)| errors.get(*place).map_or(rounding, |of| factor.abs() * of));
                Some(rounding + of_errors.sum::<f64>() / slope.abs())
            }
            _ => self.stepped.error_of_input(node),
        }
    }

    /// The end of the declared range of the input that moves.
    fn declared_end(&self, why: &Why) -> Option<f64> {
        let Why::Range(name, is_most) = why else { return None };
        let moving = &self.linkage.coordinates[self.stepped.moving];
        moving.range.filter(|_| moving.name == *name).map(|range| range[usize::from(*is_most)])
    }

    pub(super) fn limits(&mut self, question: &[String], answer: &Value, q: &[f64]) {
        let branch = answer["branch"].as_str().unwrap_or_default();
        let is_regular = self.stepped.errors(q).is_some_and(|all| all.iter().all(|of| *of < 1e-8));
        if !is_regular {
            return self.count("limits: nearly singular");
        }
        if let Some(why) = answer["fails"].as_str() {
            return match self.stepped.is_within(q) {
                false => self.count("limits: outside of ranges"),
                true => self.fails(&format!("limits: not followed: {}", class(why)), question, (branch, why), q),
            };
        }
        let Some(motion) = self.motion(q) else { return self.count("limits: not followed by small steps") };
        self.count("limits: compared");
        let own: Vec<(f64, Why)> = self.range(&motion).into_iter().zip(motion.ends.clone()).collect();
        if let Some((turns, _)) = motion.closes {
            if answer["closes_after_turns"].as_i64() != Some(turns.abs()) {
                self.fails("limits: a closed motion", question, answer, own);
            }
            return;
        }
        let nodes = [motion.nodes.first(), motion.nodes.last()];
        for ((end, node), (value, why)) in ["from", "to"].into_iter().zip(nodes).zip(&own) {
            // The declared end of the input is exact; small steps reach it with the rounding errors of their sum.
            let value = self.declared_end(why).unwrap_or(*value);
            let (Some(given), Some(node)) = (answer[end]["input"].as_f64(), node) else {
                return self.fails("limits: no end", question, answer, own);
            };
            let Some(error) = self.error_of_end(node, why) else { continue };
            if error > 1e-7 {
                self.count("limits: an end is ill-conditioned");
            } else if (given - value).abs() > 2.0 * error {
                return self.fails("limits: an end has another value", question, (answer, given - value, error), own);
            }
            let reason = answer[end]["reason"].as_str().unwrap_or_default();
            let is_same = match why {
                Why::DeadPoint => reason == "dead_point",
                Why::Range(name, is_most) => {
                    reason == "range"
                        && answer[end]["of"] == name.as_str()
                        && (answer[end]["end"] == "largest") == *is_most
                }
                _ => true,
            };
            if !is_same {
                return self.fails("limits: an end has another reason", question, answer, own);
            }
        }
    }
}
