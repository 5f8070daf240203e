//! The motions through dead points, and which positions they pass.

use std::f64::consts::TAU;

use super::super::steps::Why;
use super::{Comparison, class, numbers, second_difference, words};

impl Comparison<'_> {
    pub(super) fn circuits(&mut self, listed: &[(String, Vec<f64>)]) {
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
                // At a dead point just beyond the start's input the motion passes it twice between two nodes.
                if two[0].tangent[moving] * two[1].tangent[moving] < 0.0 {
                    let apart = self.difference(&two[0].q, &two[1].q);
                    for node in two {
                        let turns = (node.q[moving] - first) / TAU;
                        let turn = if self.linkage.coordinates[moving].is_angle { turns.round() } else { 0.0 };
                        let there = self.stepped.at(&node.q, first + turn * TAU);
                        if let Some(q) = there.filter(|q| self.difference(q, &node.q) <= apart) {
                            passed.extend(positions.iter().position(|of| self.difference(of, &q) <= 1e-6));
                        }
                    }
                }
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
                let is_near = |one: f64, other: f64| (one - other).abs() <= slack + 1e-9 * (most - least);
                let is_shifted = (0..=4)
                    .map(|turn| f64::from(turn - 2) * TAU)
                    .any(|by| is_near(given_least + by, least) && is_near(given_most + by, most));
                if !is_shifted {
                    self.fails("circuits: a motion between other values", &question, motion, (least, most));
                }
            }
        }
    }
}
