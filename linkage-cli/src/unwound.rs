//! Angles that go on from row to row, instead of back by a turn at pi.
//!
//! The unknowns of a motion that is followed count turns. Those of a position on a branch have the turns nearest to the last row,
//! unless the equations do not hold there, as where another angle is half of one.
//! An output is its formula at these unknowns, as in the library, whose motions count turns. `atan2` in an output that is an
//! angle goes on as an unknown does.

use std::f64::consts::TAU;

use crate::failure::Failure;
use crate::machine::{Machine, Motion};

/// Unknowns and outputs of a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Turned {
    pub unknowns: Vec<f64>,
    pub outputs: Vec<f64>,
}

/// The last row.
#[derive(Default)]
pub struct Unwound(Option<Turned>);

impl Unwound {
    /// The row of a motion, on the turns nearest to the last one.
    pub fn next(&mut self, machine: &Machine, motion: &Motion) -> Result<Turned, Failure> {
        let mut now = Turned { unknowns: motion.unknowns.clone(), outputs: Self::outputs(machine, motion)? };
        if let Some(last) = &self.0 {
            if !motion.is_followed {
                now.unknowns = Self::near_last(machine, motion, &last.unknowns)?;
            }
            // The difference of two values of the formula is a number of jumps: where there are none, all digits stay.
            if now.unknowns != motion.unknowns {
                let on = machine.outputs_at(&motion.inputs, &now.unknowns)?;
                let off = machine.outputs_at(&motion.inputs, &motion.unknowns)?;
                now.outputs.iter_mut().zip(on.iter().zip(off)).for_each(|(value, (on, off))| *value += on - off);
            }
            let outputs = now.outputs.iter_mut().zip(&last.outputs).zip(&machine.about.output_angles);
            for ((value, last), angle) in outputs {
                if let Some(jump) = angle.and_then(|angle| angle.jump) {
                    *value = near(*value, *last, jump);
                }
            }
        }
        self.0 = Some(now.clone());
        Ok(now)
    }

    /// The unknowns on the turns nearest to the last ones: of all angles or, where the equations do not hold there, of those that
    /// alone change nothing.
    fn near_last(machine: &Machine, motion: &Motion, last: &[f64]) -> Result<Vec<f64>, Failure> {
        let solves = |unknowns: &[f64]| machine.solves(&motion.inputs, unknowns);
        let each = motion.unknowns.iter().zip(last).zip(&machine.about.unknowns);
        let turned: Vec<f64> =
            each.map(|((value, last), of)| if of.is_angle { near(*value, *last, TAU) } else { *value }).collect();
        if turned == motion.unknowns || solves(&turned)? {
            return Ok(turned);
        }
        let mut unknowns = motion.unknowns.clone();
        for (place, value) in turned.iter().enumerate() {
            let found = std::mem::replace(&mut unknowns[place], *value);
            if *value != found && !solves(&unknowns)? {
                unknowns[place] = found;
            }
        }
        Ok(unknowns)
    }

    fn outputs(machine: &Machine, motion: &Motion) -> Result<Vec<f64>, Failure> {
        machine.about.outputs.iter().map(|output| motion.number(&format!("outputs.{}.value", output.field))).collect()
    }
}

/// The value and a number of periods, nearest to the last one.
fn near(value: f64, last: f64, period: f64) -> f64 {
    value + ((last - value) / period).round() * period
}
