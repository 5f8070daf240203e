//! Positions of equilibrium and simulations: they are on the motion through the start.

use super::super::linkage::derivatives;
use super::super::steps::{Curve, Stepped, UNITS, Why};
use super::{Comparison, class, is_near, numbers, words};

impl Comparison<'_> {
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

    pub(super) fn equilibrium(&mut self, branch: &str, curve: &Curve) {
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
        // Newton's method may find another one, and says so.
        if rest["on_motion"] == false {
            self.count("equilibrium: not on the motion");
        } else if inputs == 1 && !self.on_curve(curve, &q) {
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

    pub(super) fn simulate(&mut self, branch: &str, curve: &Curve) {
        let mut question = self.scene("simulate", branch, "Fall");
        // A motion of a thousand steps has the energy to a thousand times its tolerance.
        question.extend(words("--to=1.5 --steps=6 --tolerance=1e-10"));
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
            // Near a dead point the last step of Newton's method may leave more than rounding errors.
            if let Some(times) = self.wrong(&q).filter(|times| *times > 32.0) {
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
