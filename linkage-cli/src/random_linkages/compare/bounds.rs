//! Least and largest values: those of certificates and of reports.

use std::f64::consts::TAU;

use super::super::linkage::{Form, Output, place};
use super::super::steps::{Node, UNITS, Why};
use super::{Comparison, Motion, class, numbers, second_difference, words};

impl Comparison<'_> {
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

    pub(super) fn certify(&mut self, branch: &str, start: &[f64], motion: &Motion) {
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
                let name = &self.linkage.coordinates[moving].name;
                // A proof goes on to the end of the declared range of the input, and over a turn without one.
                let is_end_of_input = |why: &Why| matches!(why, Why::Range(of, _) if of == name);
                let declared = self.linkage.coordinates[moving].range.filter(|[least, most]| most - least <= TAU);
                if !(has_turn || declared.is_some() && is_end_of_input(&motion.ends[1])) {
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
                let range = self.linkage.coordinates[moving].range;
                let [from, to] = [first, range.map_or(first + TAU, |[_, most]| most)];
                let inputs = numbers(&proof["inputs"]);
                let is_near =
                    |one: f64, other: f64| (one - other).abs() <= UNITS * f64::EPSILON * from.abs().max(to.abs());
                if !(inputs.len() == 2 && is_near(inputs[0], from) && is_near(inputs[1], to)) {
                    return self.fails("certify: another range of the input", &question, &proof["inputs"], [from, to]);
                }
                let nodes: Vec<Node> = motion
                    .nodes
                    .iter()
                    .filter(|node| node.q[moving] >= from && node.q[moving] <= to)
                    .cloned()
                    .collect();
                let to_the_ends = within(&motion.nodes, moving, [from, to]);
                if nodes.len() < 3 {
                    return self.count("certify: a range of a few steps");
                }
                let all = self.quantities(&nodes).into_iter().zip(self.quantities(&to_the_ends));
                for ((name, is_angle, values), (_, _, to_the_ends)) in all {
                    let Some(of) =
                        proof["quantities"].as_array().into_iter().flatten().find(|of| of["name"] == name.as_str())
                    else {
                        self.fails("certify: a quantity is missing", &question, &proof["quantities"], name);
                        continue;
                    };
                    let [least, largest] = ["least", "largest"].map(|end| numbers(&of[end]));
                    let ends =
                        |values: &[f64]| [f64::min, f64::max].map(|of| values.iter().copied().fold(values[0], of));
                    let ([low, high], [lowest, highest]) = (ends(&values), ends(&to_the_ends));
                    let slack = second_difference(&to_the_ends);
                    // A search ends at this part of the largest magnitude.
                    let width = 1e-9 * low.abs().max(high.abs());
                    // The turn of an unknown may be another one; the direction of a point is that of its formula at the start.
                    let is_direction = |of: &Output| of.name == name && matches!(of.form, Form::Angle(_));
                    let turns = if is_angle && !self.linkage.outputs.iter().any(is_direction) { 3 } else { 0 };
                    let is_right = (-turns..=turns).map(|turn| f64::from(turn) * TAU).any(|by| {
                        let holds = least[0] + by <= low + width && high - width <= largest[1] + by;
                        let is_narrow =
                            lowest <= least[1] + by + slack + width && highest >= largest[0] + by - slack - width;
                        // Of several turns the steps are those of one.
                        holds && (is_narrow || to - from > TAU * (1.0 + f64::EPSILON))
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

    pub(super) fn report(&mut self, listed: &[(String, Vec<f64>)]) {
        // It takes longer than all others together.
        if self.random[3] > 0.2 {
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
        // `Circuit 1: modes 1 and 3, which this report follows.`: the motion is that of the first of these modes.
        let line = report.lines().find(|line| line.contains("which this report follows")).unwrap_or_default();
        let modes = line.split("mode").nth(1).unwrap_or_default();
        let mode = modes.split(|of: char| !of.is_ascii_digit()).find_map(|word| word.parse::<usize>().ok());
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

/// The nodes of a motion between two inputs, and those at both, on the lines between neighbours.
fn within(nodes: &[Node], moving: usize, [from, to]: [f64; 2]) -> Vec<Node> {
    let mut all: Vec<Node> = Vec::new();
    for (place, node) in nodes.iter().enumerate() {
        let before = place.checked_sub(1).map(|place| &nodes[place]);
        if let Some(before) = before {
            let mut at: Vec<f64> =
                [from, to].into_iter().filter(|at| (before.q[moving] - at) * (node.q[moving] - at) < 0.0).collect();
            if node.q[moving] < before.q[moving] {
                at.reverse();
            }
            all.extend(at.into_iter().map(|at| {
                let part = (at - before.q[moving]) / (node.q[moving] - before.q[moving]);
                let q = before.q.iter().zip(&node.q).map(|(one, other)| one + (other - one) * part).collect();
                Node { q, tangent: node.tangent.clone() }
            }));
        }
        if node.q[moving] >= from && node.q[moving] <= to {
            all.push(node.clone());
        }
    }
    all
}
