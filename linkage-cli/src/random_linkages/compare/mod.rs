//! The answers of the program, compared with small steps and with each other.

mod bounds;
mod circuits;
mod forces;
mod limits;
mod table;

use std::f64::consts::TAU;

use serde_json::Value;

use super::linkage::Linkage;
use super::program::Program;
use super::steps::{Node, Part, Stepped, UNITS, Why};

/// Two answers that differ.
#[derive(Debug, Clone)]
pub struct Found {
    /// The kind, which failures that are alike share.
    pub kind: String,
    pub question: String,
    pub answer: String,
    pub right: String,
}

/// The motion through a position, to its ends or once around.
struct Motion {
    /// By growing input.
    nodes: Vec<Node>,
    ends: [Why; 2],
    /// The turns of the input after which it is at its start again, and the difference of all coordinates then.
    closes: Option<(i64, Vec<f64>)>,
}

pub struct Comparison<'a> {
    pub linkage: &'a Linkage,
    pub program: &'a Program,
    pub stepped: Stepped<'a>,
    /// The values of all coordinates at the start; only the inputs count.
    pub at: Vec<f64>,
    /// A number from 0 to 1 for what is chosen at random.
    pub random: [f64; 4],
    pub found: Vec<Found>,
    /// The answers that were compared, and those that were not, with the reason.
    pub counts: Vec<String>,
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().map(|one| one.as_f64().unwrap_or(f64::NAN)).collect()
}

fn words(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_owned).collect()
}

/// A message without its numbers and names.
fn class(message: &str) -> String {
    let word = |word: &str| if word.chars().any(|of| of.is_ascii_digit()) { "#".to_owned() } else { word.to_owned() };
    let first: Vec<String> = message.lines().next().unwrap_or_default().split_whitespace().map(word).collect();
    first.join(" ")
}

impl<'a> Comparison<'a> {
    fn fails(&mut self, kind: &str, question: &[String], answer: impl std::fmt::Debug, right: impl std::fmt::Debug) {
        self.found.push(Found {
            kind: kind.to_owned(),
            question: question.join(" "),
            answer: format!("{answer:?}"),
            right: format!("{right:?}"),
        });
    }

    fn count(&mut self, what: &str) {
        self.counts.push(what.to_owned());
    }

    fn value(&self, coordinate: usize, value: f64) -> String {
        if self.linkage.coordinates[coordinate].is_angle { format!("{value}rad") } else { value.to_string() }
    }

    /// `--at` with all inputs, or those that are held.
    fn held(&self, all: bool) -> Vec<String> {
        let inputs = self.linkage.unknowns..self.linkage.coordinates.len();
        let inputs = inputs.filter(|place| all || *place != self.stepped.moving);
        let each = inputs
            .map(|place| format!("{}={}", self.linkage.coordinates[place].name, self.value(place, self.at[place])));
        let each: Vec<String> = each.collect();
        if each.is_empty() { Vec::new() } else { vec![format!("--at={}", each.join(","))] }
    }

    fn along(&self) -> Vec<String> {
        let several = self.linkage.coordinates.len() - self.linkage.unknowns > 1;
        if several {
            vec![format!("--along={}", self.linkage.coordinates[self.stepped.moving].name)]
        } else {
            Vec::new()
        }
    }

    fn branch(branch: &str) -> Vec<String> {
        if branch.is_empty() { Vec::new() } else { vec![format!("--branch={}", branch.replace(", ", ","))] }
    }

    /// The equations that are not satisfied, as the largest ratio of a residual to its bound.
    fn wrong(&self, q: &[f64]) -> Option<f64> {
        let sizes = self.linkage.sizes(q);
        let ratios =
            self.linkage.residual(q).into_iter().zip(sizes).map(|(of, size)| of.abs() / (UNITS * f64::EPSILON * size));
        let worst = ratios.fold(0.0, |worst: f64, of| if of.is_nan() { f64::INFINITY } else { worst.max(of) });
        (worst > 1.0).then_some(worst)
    }

    fn full(&self, unknowns: &[f64], moving: f64) -> Vec<f64> {
        let mut q = self.at.clone();
        q[..unknowns.len()].copy_from_slice(unknowns);
        q[self.stepped.moving] = moving;
        q
    }

    /// The largest difference of two positions, angles but for turns.
    fn difference(&self, one: &[f64], other: &[f64]) -> f64 {
        let each = one.iter().zip(other).zip(&self.linkage.coordinates).map(|((one, other), of)| {
            let by = one - other;
            if of.is_angle { (by - (by / TAU).round() * TAU).abs() } else { by.abs() }
        });
        each.fold(0.0, f64::max)
    }

    fn motion(&self, q: &[f64]) -> Option<Motion> {
        let upper = self.stepped.follow(self.stepped.begin(q, 1.0)?, false)?;
        if let Why::Closed(turns) = upper.why {
            let difference = upper.nodes.last()?.q.iter().zip(q).map(|(one, other)| one - other).collect();
            let ends = [upper.why.clone(), upper.why];
            return Some(Motion { nodes: upper.nodes, ends, closes: Some((turns, difference)) });
        }
        let lower: Part = self.stepped.follow(self.stepped.begin(q, -1.0)?, false)?;
        let ends = [lower.why, upper.why];
        if ends.contains(&Why::Long) {
            return None;
        }
        let nodes = lower.nodes.into_iter().rev().chain(upper.nodes.into_iter().skip(1)).collect();
        Some(Motion { nodes, ends, closes: None })
    }

    /// The position of a motion at a value of its input, in its range.
    fn at(&self, motion: &Motion, value: f64) -> Option<Vec<f64>> {
        let moving = self.stepped.moving;
        let of = |node: &Node| node.q[moving];
        let next = motion.nodes.iter().position(|node| of(node) >= value)?.max(1);
        let (from, to) = (motion.nodes.get(next - 1)?, motion.nodes.get(next)?);
        let part = (value - of(from)) / (of(to) - of(from));
        let near: Vec<f64> = from.q.iter().zip(&to.q).map(|(from, to)| from + part * (to - from)).collect();
        self.stepped.at(&near, value)
    }

    fn range(&self, motion: &Motion) -> [f64; 2] {
        let of = |node: Option<&Node>| node.map_or(f64::NAN, |node| node.q[self.stepped.moving]);
        [of(motion.nodes.first()), of(motion.nodes.last())]
    }

    /// Asks everything.
    pub fn run(&mut self) {
        let question: Vec<String> = words("limits").into_iter().chain(self.held(true)).chain(self.along()).collect();
        let moving = self.stepped.moving;
        let own = self
            .stepped
            .at(&self.at.clone(), self.at[moving])
            .filter(|q| self.stepped.errors(q).is_some_and(|all| all.iter().all(|of| *of < 1e-8)));
        let Some(own) = own else { return self.count("no position of its own") };
        if !self.stepped.is_within(&own) {
            return self.count("outside of ranges");
        }
        let limits = match self.program.ask(&question) {
            Ok(limits) => limits,
            Err(why) => return self.fails(&format!("limits: {}", class(&why)), &question, why, "a position"),
        };
        let listed: Vec<(String, Vec<f64>)> = limits["positions"]
            .as_array()
            .into_iter()
            .flatten()
            .map(|of| {
                (
                    of["branch"].as_str().unwrap_or_default().to_owned(),
                    self.full(&numbers(&of["unknowns"]), self.at[moving]),
                )
            })
            .collect();
        let errors = self.stepped.errors(&own).unwrap_or_default();
        let error = errors.iter().fold(0.0, |one: f64, other| one.max(*other));
        let nearest = listed.iter().enumerate().map(|(place, (_, q))| (self.difference(&own, q), place));
        let nearest = nearest.min_by(|one, other| one.0.total_cmp(&other.0));
        let chosen = match nearest {
            Some((difference, place)) if difference <= error => place,
            other => return self.fails("limits: a position is not listed", &question, other, own),
        };
        for (place, (branch, q)) in listed.iter().enumerate() {
            if let Some(times) = self.wrong(q) {
                self.fails(
                    "limits: a listed position does not satisfy the equations",
                    &question,
                    (branch, q, times),
                    "residual 0",
                );
                continue;
            }
            self.limits(&question, &limits["positions"][place], q);
        }
        self.circuits(&listed);
        // The position near the start, or another one.
        let other = (self.random[0] * listed.len() as f64) as usize % listed.len();
        let (branch, q) = match &listed[other] {
            (branch, q) if self.random[0] > 0.5 && self.wrong(q).is_none() && self.stepped.is_within(q) => {
                (branch.clone(), q.clone())
            }
            _ => (listed[chosen].0.clone(), own),
        };
        let Some(motion) = self.motion(&q) else { return self.count("not followed by small steps") };
        self.table(&branch, &q, &motion);
        self.certify(&branch, &q, &motion);
        self.report(&listed);
        // Forces know no declared ranges.
        let mut free = self.linkage.clone();
        free.coordinates.iter_mut().for_each(|of| of.range = None);
        free.outputs.iter_mut().for_each(|of| of.range = None);
        let Some(curve) = Stepped { linkage: &free, moving }.curve(&q) else {
            return self.count("no curve by small steps");
        };
        self.equilibrium(&branch, &curve);
        self.simulate(&branch, &curve);
    }
}

/// The largest second difference: what samples miss of an extreme is a part of it.
fn second_difference(values: &[f64]) -> f64 {
    values.windows(3).map(|of| (of[0] - 2.0 * of[1] + of[2]).abs()).fold(0.0, f64::max)
}

/// False for what is no number.
fn is_near(one: f64, other: f64, bound: f64) -> bool {
    (one - other).abs() <= bound
}
