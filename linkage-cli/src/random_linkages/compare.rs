//! The answers of the program, compared with small steps and with each other.

use std::f64::consts::TAU;

use serde_json::Value;

use super::algebra::bounds;
use super::linkage::{Form, Linear, Linkage, Output, derivatives, place};
use super::program::Program;
use super::steps::{Curve, Node, Part, Stepped, UNITS, Why};

/// Two answers that differ.
#[derive(Debug, Clone)]
pub struct Found {
    /// The same for failures that are alike.
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
    /// What was compared, and what was not, with the reason.
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

    fn limits(&mut self, question: &[String], answer: &Value, q: &[f64]) {
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

    fn table(&mut self, branch: &str, start: &[f64], motion: &Motion) {
        let of = &self.linkage.coordinates[self.stepped.moving];
        let by = if of.is_angle {
            [TAU, -TAU, 1.0, 2.0 * TAU, -1.5][(self.random[1] * 5.0) as usize]
        } else {
            self.random[1] - 0.5
        };
        let first = self.at[self.stepped.moving];
        self.rows(branch, [first, first + by], Some((start, motion)));
        // The first row that has the position asked for chooses.
        let from = first + if of.is_angle { 6.0 } else { 1.0 } * (self.random[2] - 0.5);
        self.rows(branch, [from, from + by], None);
    }

    /// The motion that is chosen by the first of these inputs at which there is a position on a branch.
    fn chosen(&mut self, branch: &str, inputs: &[f64]) -> Option<(Vec<f64>, Motion)> {
        let moving = self.stepped.moving;
        let at = self.at.clone();
        for value in inputs {
            self.at[moving] = *value;
            let mut asked = words("limits --format=json");
            asked.extend(self.held(true));
            asked.extend(self.along());
            let answer = self.program.ask(&asked);
            self.at.clone_from(&at);
            let listed = answer.ok().and_then(|answer| answer["positions"].as_array().cloned()).unwrap_or_default();
            let Some(here) = listed.into_iter().find(|of| of["branch"] == branch) else { continue };
            let q = self.full(&numbers(&here["unknowns"]), *value);
            let is_regular = self.stepped.errors(&q).is_some_and(|all| all.iter().all(|of| *of < 1e-8));
            if !is_regular || self.wrong(&q).is_some() {
                return None;
            }
            if self.stepped.is_within(&q) {
                let motion = self.motion(&q)?;
                return Some((q, motion));
            }
        }
        None
    }

    fn rows(&mut self, branch: &str, [first, last]: [f64; 2], known: Option<(&[f64], &Motion)>) {
        let moving = self.stepped.moving;
        let of = &self.linkage.coordinates[moving];
        let steps = 10;
        let mut question = words("table --format=json --rate");
        let rate = if last > first { 1.0 } else { -1.0 };
        *question.last_mut().expect("words") = format!("--rate={rate}");
        question.extend(Self::branch(branch));
        question.extend(self.held(false));
        question.extend(self.along());
        question.extend([
            format!("--from={}", self.value(moving, first)),
            format!("--to={}", self.value(moving, last)),
            format!("--steps={steps}"),
        ]);
        let table = match self.program.ask(&question) {
            Ok(table) => table,
            Err(why) => {
                return match known {
                    Some((start, _)) => self.fails(&format!("table: {}", class(&why)), &question, why, start),
                    None => self.count(&format!("table from another value: {}", class(&why))),
                };
            }
        };
        let column = |name: &str| -> Vec<f64> {
            let found = table["columns"].as_array().into_iter().flatten().find(|of| of["name"] == name);
            found.map(|of| numbers(&of["values"])).unwrap_or_default()
        };
        let inputs = column(&of.name);
        let found;
        let (start, motion) = match known {
            Some(known) => known,
            None => {
                found = self.chosen(branch, &inputs);
                let Some((start, motion)) = &found else { return self.count("table from another value: not compared") };
                (start.as_slice(), motion)
            }
        };
        let first = start[moving];
        self.count(if known.is_some() { "table: compared" } else { "table from another value: compared" });
        let n = self.linkage.unknowns;
        let unknowns: Vec<[Vec<f64>; 2]> = self.linkage.coordinates[..n]
            .iter()
            .map(|of| [column(&of.name), column(&format!("{}_rate", of.name))])
            .collect();
        let outputs: Vec<Vec<f64>> = self.linkage.outputs.iter().map(|of| column(&of.name)).collect();
        let points: Vec<[Vec<f64>; 2]> = self
            .linkage
            .points
            .iter()
            .map(|(name, _)| ["x", "y"].map(|axis| column(&format!("{name}_{axis}"))))
            .collect();
        let [least, most] = self.range(motion);
        let mut turns: Option<Vec<i64>> = None;
        for (row, value) in inputs.iter().enumerate() {
            let unknowns_here: Vec<f64> =
                unknowns.iter().map(|of| of[0].get(row).copied().unwrap_or(f64::NAN)).collect();
            let is_empty = unknowns_here.iter().all(|of| of.is_nan());
            let q = self.full(&unknowns_here, *value);
            // Where the row is on the motion, by whole turns.
            let (own, is_direct) = match &motion.closes {
                Some((turns, by)) => {
                    let period = *turns as f64 * TAU;
                    let times = ((value - first) / period).floor();
                    let own = self.at(motion, (value - times * period).clamp(least, most));
                    (own.map(|own| own.iter().zip(by).map(|(own, by)| own + times * by).collect::<Vec<f64>>()), true)
                }
                None => {
                    let edge = 1e-7 * (most - least);
                    let is_in = |value: f64| value > least + edge && value < most - edge;
                    if is_in(*value) {
                        (self.at(motion, *value), true)
                    } else {
                        let shifted = (-3..=3)
                            .map(|turn| value + f64::from(turn) * TAU)
                            .find(|value| is_in(*value))
                            .filter(|_| of.is_angle && of.range.is_none());
                        let is_edge = (-3..=3).any(|turn| {
                            [least, most].iter().any(|end| (value + f64::from(turn) * TAU - end).abs() <= 2.0 * edge)
                        });
                        match shifted {
                            Some(shifted) => (self.at(motion, shifted), false),
                            None if is_edge || is_empty => continue,
                            None => {
                                return self.fails(
                                    "table: a row beyond the ends has a position",
                                    &question,
                                    (row, &q),
                                    (least, most, &motion.ends),
                                );
                            }
                        }
                    }
                }
            };
            let Some(own) = own else { continue };
            if is_empty {
                if is_direct {
                    return self.fails(
                        "table: a row of the motion is empty",
                        &question,
                        (row, value, &table["missing"]),
                        own,
                    );
                }
                self.count("table: a row a turn away is empty");
                continue;
            }
            if let Some(times) = self.wrong(&q) {
                return self.fails("table: a row does not satisfy the equations", &question, (row, &q, times), own);
            }
            let Some(errors) = self.stepped.errors(&own) else { continue };
            if errors.iter().any(|of| *of > 1e-7) {
                self.count("table: nearly singular");
                continue;
            }
            let mut here = vec![0; n];
            for place in 0..n {
                let mut by = q[place] - own[place];
                if self.linkage.coordinates[place].is_angle {
                    here[place] = (by / TAU).round() as i64;
                    by -= here[place] as f64 * TAU;
                }
                if by.abs() > 2.0 * errors[place] + UNITS * f64::EPSILON * q[place].abs() {
                    return self.fails("table: a row is not on the motion", &question, (row, &q, by), own);
                }
            }
            if is_direct {
                let first = turns.get_or_insert_with(|| here.clone());
                if *first != here {
                    return self.fails("table: an angle jumps by a turn between rows", &question, (row, &q), own);
                }
            }
            for (output, values) in self.linkage.outputs.iter().zip(&outputs) {
                let mut right = output.form.at(&q);
                if matches!(output.form, Form::Angle(_)) {
                    right += ((values[row] - right) / TAU).round() * TAU;
                }
                let mut size = right.abs() + q.iter().map(|of| of.abs()).sum::<f64>();
                if let Form::Angle(sum) = &output.form {
                    let [x, y] = place(sum, &q);
                    size += self.linkage.sizes(&q).iter().fold(0.0, |one: f64, other| one.max(*other)) / x.hypot(y);
                }
                if !is_near(values[row], right, UNITS * f64::EPSILON * size) {
                    return self.fails("table: an output", &question, (row, &output.name, values[row]), right);
                }
            }
            for ((name, sum), values) in self.linkage.points.iter().zip(&points) {
                let right = place(sum, &q);
                for axis in [0, 1] {
                    let size = right[0].hypot(right[1])
                        + self.linkage.sizes(&q).iter().fold(0.0, |one: f64, other| one.max(*other));
                    if !is_near(values[axis][row], right[axis], UNITS * f64::EPSILON * size) {
                        return self.fails("table: a point", &question, (row, name, axis, values[axis][row]), right);
                    }
                }
            }
            let (Some(ratios), Some(error)) = (self.stepped.ratios(&q), self.error_of_ratios(&q)) else { continue };
            for place in 0..n {
                let given = unknowns[place][1].get(row).copied().unwrap_or(f64::NAN);
                if !is_near(given, rate * ratios[place], error[place]) {
                    return self.fails(
                        "table: a rate",
                        &question,
                        (row, &self.linkage.coordinates[place].name, given),
                        (rate * ratios[place], error[place]),
                    );
                }
            }
        }
    }

    /// The largest errors of the velocity ratios: derivatives are wrong by rounding and by the error of the position.
    fn error_of_ratios(&self, q: &[f64]) -> Option<Vec<f64>> {
        let (ratios, errors) = (self.stepped.ratios(q)?, self.stepped.errors(q)?);
        let n = self.linkage.unknowns;
        let largest = |all: &[f64]| all.iter().fold(1.0, |one: f64, other| one.max(other.abs()));
        let part = 4.0 * UNITS * f64::EPSILON + 4.0 * errors.iter().sum::<f64>();
        let right: Vec<f64> = self.linkage.sizes(q).iter().map(|size| size * part * largest(&ratios)).collect();
        let rows: Vec<Vec<f64>> = self.linkage.jacobian(q).into_iter().map(|row| row[..n].to_vec()).collect();
        bounds(&rows, &right)
    }

    fn circuits(&mut self, listed: &[(String, Vec<f64>)]) {
        let question: Vec<String> =
            words("circuits --format=json").into_iter().chain(self.held(true)).chain(self.along()).collect();
        let circuits = match self.program.ask(&question) {
            Ok(circuits) => circuits,
            Err(why) => {
                let is_singular = listed
                    .iter()
                    .any(|(_, q)| self.stepped.errors(q).is_none_or(|all| all.iter().any(|of| *of > 1e-8)));
                return if is_singular {
                    self.count("circuits: nearly singular")
                } else {
                    self.fails(&format!("circuits: {}", class(&why)), &question, why, "circuits")
                };
            }
        };
        let moving = self.stepped.moving;
        let first = self.at[moving];
        let positions: Vec<Vec<f64>> = circuits["positions"]
            .as_array()
            .into_iter()
            .flatten()
            .map(|of| self.full(&numbers(&of["unknowns"]), of["input"].as_f64().unwrap_or(f64::NAN)))
            .collect();
        let within = listed.iter().filter(|(_, q)| self.stepped.is_within(q)).count();
        if positions.len() != within {
            return self.fails("circuits: another number of positions than limits", &question, positions.len(), within);
        }
        for motion in circuits["motions"].as_array().into_iter().flatten() {
            let members: Vec<usize> = motion["positions"]
                .as_array()
                .into_iter()
                .flatten()
                .filter_map(|of| of.as_u64())
                .map(|of| of as usize - 1)
                .collect();
            let Some(start) = members.first().map(|place| positions[*place].clone()) else { continue };
            if self.wrong(&start).is_some() {
                self.fails("circuits: a position does not satisfy the equations", &question, start, "residual 0");
                continue;
            }
            let Some(curve) = self.stepped.curve(&start) else {
                self.count("circuits: not followed by small steps");
                continue;
            };
            self.count("circuits: compared");
            // The positions at the start's input.
            let mut passed: Vec<usize> = Vec::new();
            for two in curve.nodes.windows(2) {
                let [one, other] = [&two[0], &two[1]].map(|node| (node.q[moving] - first) / TAU);
                let turn = if self.linkage.coordinates[moving].is_angle { one.max(other).floor() } else { 0.0 };
                if one.min(other) > turn || one.max(other) < turn || one == other {
                    continue;
                }
                let part = (turn - one) / (other - one);
                let near: Vec<f64> =
                    two[0].q.iter().zip(&two[1].q).map(|(from, to)| from + part * (to - from)).collect();
                if let Some(q) = self.stepped.at(&near, first + turn * TAU) {
                    passed.extend(positions.iter().position(|of| self.difference(of, &q) <= 1e-6));
                }
            }
            passed.sort_unstable();
            passed.dedup();
            let mut given = members.clone();
            given.sort_unstable();
            given.dedup();
            if !passed.is_empty() && passed != given {
                self.fails("circuits: other positions on a motion", &question, motion, passed);
                continue;
            }
            let kind = match curve.why {
                Why::Closed(0) => "to_and_fro",
                Why::Closed(_) if curve.has_dead_points => "to_and_fro",
                Why::Closed(_) => "turns",
                _ => "ends",
            };
            if motion["kind"] != kind {
                self.fails("circuits: a motion of another kind", &question, motion, kind);
                continue;
            }
            if let (Why::Closed(turns), "turns") = (&curve.why, kind)
                && motion["turns"].as_i64() != Some(turns.abs())
            {
                self.fails("circuits: a motion of other turns", &question, motion, turns);
            }
            if curve.why == Why::Closed(0) || kind == "ends" {
                let values: Vec<f64> = curve.nodes.iter().map(|node| node.q[moving]).collect();
                let slack = second_difference(&values);
                let [least, most] = [f64::min, f64::max].map(|of| values.iter().copied().fold(values[0], of));
                let [given_least, given_most] =
                    ["least", "largest"].map(|end| motion[end].as_f64().unwrap_or(f64::NAN));
                let is_near = |one: f64, other: f64| (one - other).abs() <= slack + 1e-9;
                let is_shifted = (0..=4)
                    .map(|turn| f64::from(turn - 2) * TAU)
                    .any(|by| is_near(given_least + by, least) && is_near(given_most + by, most));
                if !is_shifted {
                    self.fails("circuits: a motion between other values", &question, motion, (least, most));
                }
            }
        }
    }

    /// The values of the quantities that the program has bounds of, along a motion: points, outputs.
    fn quantities(&self, nodes: &[Node]) -> Vec<(String, bool, Vec<f64>)> {
        let mut all = Vec::new();
        for (name, sum) in &self.linkage.points {
            for (axis, letter) in ["x", "y"].into_iter().enumerate() {
                let values = nodes.iter().map(|node| place(sum, &node.q)[axis]).collect();
                all.push((format!("{name}_{letter}"), false, values));
            }
        }
        all.extend(self.linkage.outputs.iter().map(|of| self.of_output(of, nodes)));
        all
    }

    fn of_output(&self, output: &Output, nodes: &[Node]) -> (String, bool, Vec<f64>) {
        let is_angle = match &output.form {
            Form::Angle(_) => true,
            Form::Linear(form) => form.terms.iter().all(|(_, place)| self.linkage.coordinates[*place].is_angle),
        };
        (output.name.clone(), is_angle, output.form.along(nodes.iter().map(|node| node.q.as_slice())))
    }

    fn certify(&mut self, branch: &str, start: &[f64], motion: &Motion) {
        let question: Vec<String> = words("certify --format=json")
            .into_iter()
            .chain(Self::branch(branch))
            .chain(self.held(true))
            .chain(self.along())
            .collect();
        let moving = self.stepped.moving;
        if !self.linkage.coordinates[moving].is_angle {
            return;
        }
        let [_, most] = self.range(motion);
        let first = self.at[moving];
        let has_turn = motion.closes.is_some() || most - first > TAU;
        match self.program.ask(&question) {
            Ok(proof) => {
                self.count("certify: compared");
                let is_range = |why: &Why| matches!(why, Why::Range(..));
                if !has_turn && !is_range(&motion.ends[1]) {
                    return self.fails(
                        "certify: a motion with a dead point is certified",
                        &question,
                        &proof["statement"],
                        most,
                    );
                }
                if !has_turn {
                    let is_said = proof["ranges"].as_array().into_iter().flatten().any(|of| of["proof"] != "within");
                    return if is_said {
                        self.count("certify: a range is left, and said")
                    } else {
                        self.fails(
                            "certify: a declared range is left without a word",
                            &question,
                            proof,
                            (most, &motion.ends),
                        )
                    };
                }
                let nodes: Vec<Node> = motion
                    .nodes
                    .iter()
                    .filter(|node| node.q[moving] >= first && node.q[moving] <= first + TAU)
                    .cloned()
                    .collect();
                for (name, is_angle, values) in self.quantities(&nodes) {
                    let Some(of) =
                        proof["quantities"].as_array().into_iter().flatten().find(|of| of["name"] == name.as_str())
                    else {
                        self.fails("certify: a quantity is missing", &question, &proof["quantities"], name);
                        continue;
                    };
                    let [least, largest] = ["least", "largest"].map(|end| numbers(&of[end]));
                    let [low, high] = [f64::min, f64::max].map(|of| values.iter().copied().fold(values[0], of));
                    let slack = second_difference(&values);
                    let rounding = 1e-9 * (1.0 + low.abs().max(high.abs()));
                    // The turn of an angle may be another one.
                    let is_right = (-3..=3).map(|turn| f64::from(turn) * if is_angle { TAU } else { 0.0 }).any(|by| {
                        least[0] + by <= low + rounding
                            && low <= least[1] + by + slack + rounding
                            && high - rounding <= largest[1] + by
                            && high >= largest[0] + by - slack - rounding
                    });
                    if !is_right {
                        self.fails("certify: bounds do not hold the motion", &question, of, (low, high));
                    }
                }
            }
            Err(why) => {
                if let Some(rest) = why.split("turns back at ").nth(1) {
                    let number: String =
                        rest.chars().take_while(|of| of.is_ascii_digit() || "-.".contains(*of)).collect();
                    let given = number.parse::<f64>().map_or(f64::NAN, f64::to_radians);
                    if has_turn || !((given - most).abs() <= 1e-4 || matches!(motion.ends[1], Why::Range(..))) {
                        self.fails("certify: another dead point", &question, why, (most, &motion.ends));
                    }
                } else {
                    let is_regular = self.stepped.errors(start).is_some_and(|all| all.iter().all(|of| *of < 1e-10));
                    let kind = class(&why);
                    if has_turn && is_regular && self.linkage.family != "change_points" {
                        self.count(&format!("certify: {kind}"));
                    }
                }
            }
        }
    }

    fn report(&mut self, listed: &[(String, Vec<f64>)]) {
        // It takes longer than all others together.
        if self.random[3] > 0.4 {
            return;
        }
        let question: Vec<String> = words("report").into_iter().chain(self.held(true)).collect();
        let report = match self.program.ask(&question) {
            Ok(report) => report.as_str().unwrap_or_default().replace('\u{2212}', "-"),
            Err(why) => return self.fails(&format!("report: {}", class(&why)), &question, why, "a report"),
        };
        let within = listed.iter().filter(|(_, q)| self.stepped.is_within(q)).count();
        let modes = report.lines().filter(|line| line.starts_with("Mode ")).count();
        if modes != within {
            self.fails("report: another number of modes", &question, modes, within);
        }
        if self.linkage.coordinates.len() - self.linkage.unknowns > 1 {
            return;
        }
        if !report.contains("which this report follows") {
            let why = report.lines().find(|line| line.contains("follows no motion")).unwrap_or("no motion").to_owned();
            return self.fails(&format!("report: {}", class(&why)), &question, why, "a motion");
        }
        // The number of the mode is the last before these words.
        let before = report.split(", which this report follows").next().unwrap_or_default();
        let mode = before.rsplit(|of: char| !of.is_ascii_digit()).find_map(|word| word.parse::<usize>().ok());
        let within: Vec<&Vec<f64>> = listed.iter().map(|(_, q)| q).filter(|q| self.stepped.is_within(q)).collect();
        let Some(start) = mode.and_then(|mode| within.get(mode.checked_sub(1)?)).copied() else {
            return self.fails("report: the mode that is followed", &question, mode, within.len());
        };
        if self.wrong(start).is_some() {
            return self.count("report: the first position is wrong");
        }
        let Some(motion) = self.motion(start) else { return self.count("report: not followed by small steps") };
        self.count("report: compared");
        let mut all: Vec<(String, bool, Vec<f64>)> = Vec::new();
        for (place, of) in self.linkage.coordinates[..self.linkage.unknowns].iter().enumerate() {
            all.push((of.name.clone(), of.is_angle, motion.nodes.iter().map(|node| node.q[place]).collect()));
        }
        all.extend(self.linkage.outputs.iter().map(|of| self.of_output(of, &motion.nodes)));
        for (name, is_angle, values) in all {
            let [low, high] = [f64::min, f64::max].map(|of| values.iter().copied().fold(values[0], of));
            let Some(line) = report.lines().find(|line| line.starts_with(&format!("{name} "))) else {
                self.fails("report: a quantity is missing", &question, &report, &name);
                continue;
            };
            let sentence = line.split(". ").next().unwrap_or_default();
            let words = sentence.split(" (at ").map(|part| part.split_once(')').map_or(part, |(_, rest)| rest));
            let first = sentence.split(" (at ").next().unwrap_or_default().to_owned();
            let plain = first + " " + &words.skip(1).collect::<Vec<_>>().join(" ");
            let ends = numbers_in(&plain[name.len()..]);
            let turned = match (&motion.closes, values.first(), values.last()) {
                (Some(_), Some(first), Some(last)) => last - first,
                _ => 0.0,
            };
            let slack = second_difference(&values) + 2e-6 * (1.0 + low.abs().max(high.abs()));
            let is_near = |one: f64, other: f64| (one - other).abs() <= slack;
            let is_right = if line.contains("turns by") {
                ends.first().is_some_and(|by| is_near(by.abs(), turned.abs()) && turned.abs() > 1.0)
            } else if line.contains("goes from") {
                // An angle may be told some turns away.
                let is_it = |by: f64| match ends.as_slice() {
                    [one, other, ..] => is_near(one + by, low) && is_near(other + by, high),
                    _ => false,
                };
                turned.abs() < 1.0 && (-4..=4).map(|turn| if is_angle { f64::from(turn) * TAU } else { 0.0 }).any(is_it)
            } else if line.contains("all the time") {
                high - low <= slack
            } else {
                self.count(&format!("report: {line}"));
                true
            };
            if !is_right {
                self.fails("report: the range of a quantity", &question, line, (low, high, turned));
            }
        }
    }

    fn on_curve(&self, curve: &Curve, q: &[f64]) -> bool {
        // No node is farther from its neighbours than a step.
        curve.nodes.iter().any(|node| self.difference(&node.q, q) <= 0.05)
    }

    fn scene(&self, command: &str, branch: &str, scene: &str) -> Vec<String> {
        words(command)
            .into_iter()
            .chain([format!("--scene={scene}"), "--format=json".to_owned()])
            .chain(Self::branch(branch))
            .chain(self.held(true))
            .collect()
    }

    fn equilibrium(&mut self, branch: &str, curve: &Curve) {
        let question = self.scene("equilibrium", branch, "Rest");
        let rest = match self.program.ask(&question) {
            Ok(rest) => rest,
            Err(why) => return self.count(&format!("equilibrium: {}", class(&why))),
        };
        self.count("equilibrium: compared");
        let inputs = self.linkage.coordinates.len() - self.linkage.unknowns;
        let given: Vec<f64> = rest["coordinates"]
            .as_array()
            .into_iter()
            .flatten()
            .map(|of| of["value"].as_f64().unwrap_or(f64::NAN))
            .collect();
        // Inputs are listed first.
        let q: Vec<f64> = given[inputs..].iter().chain(&given[..inputs]).copied().collect();
        if let Some(times) = self.wrong(&q) {
            return self.fails(
                "equilibrium: the position does not satisfy the equations",
                &question,
                (&q, times),
                "residual 0",
            );
        }
        if inputs == 1 && !self.on_curve(curve, &q) {
            return self.fails(
                "equilibrium: the position is on another motion",
                &question,
                &q,
                "a position on the motion through the start",
            );
        }
        let of_point = derivatives(&self.linkage.points[0].1, &q);
        for moving in self.linkage.unknowns..q.len() {
            let stepped = Stepped { linkage: self.linkage, moving };
            let (Some(ratios), Some(errors)) = (stepped.ratios(&q), self.error_of_ratios(&q)) else { continue };
            let each = || of_point.iter().zip(&ratios).map(|(by, ratio)| (0.3 * by[0] - by[1]) * ratio);
            let work: f64 = each().sum();
            let size: f64 = each().map(f64::abs).sum::<f64>()
                + of_point.iter().zip(&errors).map(|(by, error)| (by[0].abs() + by[1].abs()) * error).sum::<f64>()
                    / f64::EPSILON;
            if !is_near(work, 0.0, 100.0 * UNITS * f64::EPSILON * size) {
                return self.fails("equilibrium: the virtual work is not zero", &question, (&q, work), size);
            }
        }
    }

    fn simulate(&mut self, branch: &str, curve: &Curve) {
        let mut question = self.scene("simulate", branch, "Fall");
        question.extend(words("--to=1.5 --steps=6"));
        question.push(format!("--rate={}=0.4", self.linkage.coordinates[self.stepped.moving].name));
        let table = match self.program.ask(&question) {
            Ok(table) => table,
            Err(why) => return self.fails(&format!("simulate: {}", class(&why)), &question, why, "a motion"),
        };
        self.count("simulate: compared");
        if let Some(why) = table["ended"].as_str() {
            self.count(&format!("simulate: {}", class(why)));
        }
        let column = |name: &str| -> Vec<f64> {
            let found = table["columns"].as_array().into_iter().flatten().find(|of| of["name"] == name);
            found.map(|of| numbers(&of["values"])).unwrap_or_default()
        };
        let columns: Vec<Vec<f64>> = self.linkage.coordinates.iter().map(|of| column(&of.name)).collect();
        let [kinetic, potential] = ["kinetic_energy", "potential_energy"].map(column);
        let inputs = self.linkage.coordinates.len() - self.linkage.unknowns;
        for row in 0..kinetic.len() {
            let q: Vec<f64> = columns.iter().map(|of| of[row]).collect();
            if q.iter().any(|of| of.is_nan()) {
                if table["ended"].is_null() && table["missing"].as_array().is_none_or(Vec::is_empty) {
                    return self.fails("simulate: an empty row without a word", &question, (row, &q), "a row");
                }
                continue;
            }
            if let Some(times) = self.wrong(&q) {
                return self.fails(
                    "simulate: a row does not satisfy the equations",
                    &question,
                    (row, &q, times),
                    "residual 0",
                );
            }
            if inputs == 1 && matches!(curve.why, Why::Closed(_)) && !self.on_curve(curve, &q) {
                return self.fails(
                    "simulate: a row is on another motion",
                    &question,
                    (row, &q),
                    "the motion through the start",
                );
            }
            let (now, first) = (kinetic[row] + potential[row], kinetic[0] + potential[0]);
            let size = kinetic
                .iter()
                .chain(&potential)
                .filter(|of| of.is_finite())
                .fold(0.0, |one: f64, other| one.max(other.abs()));
            if !is_near(now, first, 1e-6 * size) {
                return self.fails("simulate: the energy changes", &question, (row, now), first);
            }
        }
    }
}

/// The largest second difference: what samples miss of an extreme is a part of it.
fn second_difference(values: &[f64]) -> f64 {
    values.windows(3).map(|of| (of[0] - 2.0 * of[1] + of[2]).abs()).fold(0.0, f64::max)
}

/// The numbers of a sentence, angles in radians.
fn numbers_in(line: &str) -> Vec<f64> {
    let number = |word: &str| {
        let word = word.trim_matches(|of: char| "().,;".contains(of));
        match word.strip_suffix('\u{b0}') {
            Some(degrees) => degrees.parse::<f64>().ok().map(f64::to_radians),
            None => word.parse::<f64>().ok(),
        }
    };
    line.split_whitespace().filter_map(number).collect()
}

/// False for what is no number.
fn is_near(one: f64, other: f64, bound: f64) -> bool {
    (one - other).abs() <= bound
}
