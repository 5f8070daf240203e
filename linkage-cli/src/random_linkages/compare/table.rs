//! The rows of a table: each is on the motion, or empty where it does not come.

use std::f64::consts::TAU;

use super::super::algebra;
use super::super::linkage::{Form, place};
use super::super::steps::UNITS;
use super::{Comparison, Motion, class, is_near, numbers, words};

impl Comparison<'_> {
    pub(super) fn table(&mut self, branch: &str, start: &[f64], motion: &Motion) {
        let of = &self.linkage.coordinates[self.stepped.moving];
        let by = if of.is_angle {
            [TAU, -TAU, 1.0, 2.0 * TAU, -1.5][(self.random[1] * 5.0) as usize]
        } else {
            self.random[1] - 0.5
        };
        let first = self.at[self.stepped.moving];
        self.rows(branch, [first, first + by], Some((start, motion)));
        if self.random[3] < 0.6 {
            return;
        }
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
            // Where the row is on the motion, and how many whole motions before it.
            let mut passed = 0.0;
            let (found, is_direct) = match &motion.closes {
                Some((turns, _)) => {
                    let period = *turns as f64 * TAU;
                    passed = ((value - first) / period).floor();
                    (self.at(motion, (value - passed * period).clamp(least, most)), true)
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
                            // The range of an input of at most a turn is one of directions.
                            .filter(|_| of.is_angle && of.range.is_none_or(|[least, most]| most - least <= TAU));
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
            let Some(found) = found else { continue };
            let own: Vec<f64> = match &motion.closes {
                Some((_, by)) => found.iter().zip(by).map(|(of, by)| of + passed * by).collect(),
                None => found.clone(),
            };
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
            // The reference was computed at another turn, where the angles and so their rounding errors are larger.
            let Some(errors) = self.stepped.errors(&found) else { continue };
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
    pub(super) fn error_of_ratios(&self, q: &[f64]) -> Option<Vec<f64>> {
        let (ratios, errors) = (self.stepped.ratios(q)?, self.stepped.errors(q)?);
        let n = self.linkage.unknowns;
        let largest = |all: &[f64]| all.iter().fold(1.0, |one: f64, other| one.max(other.abs()));
        let part = 4.0 * UNITS * f64::EPSILON + 4.0 * errors.iter().sum::<f64>();
        let right: Vec<f64> = self.linkage.sizes(q).iter().map(|size| size * part * largest(&ratios)).collect();
        let rows: Vec<Vec<f64>> = self.linkage.jacobian(q).into_iter().map(|row| row[..n].to_vec()).collect();
        algebra::bounds(&rows, &right)
    }
}
