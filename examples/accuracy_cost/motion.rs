//! The error of each method against the input, over a turn or between two dead points.

use crate::METHODS;
use crate::comparison::{Point, QUANTITIES, Work};

/// The errors of all methods along a motion.
pub struct Motion {
    pub point: Point,
    /// By method: each input with the error there, or none if the method returns an error.
    pub curves: Vec<Vec<(f64, Option<f64>)>>,
}

impl Motion {
    /// Sorts works by their points.
    pub fn all(works: Vec<Work>) -> Vec<Self> {
        let mut motions: Vec<Self> = Vec::new();
        for Work { method, point, errors, inputs, .. } in works {
            let place = motions.iter().position(|motion| motion.point == point).unwrap_or_else(|| {
                motions.push(Self { point, curves: vec![Vec::new(); METHODS.len()] });
                motions.len() - 1
            });
            let method = METHODS.iter().position(|name| *name == method).expect("a method of the list");
            motions[place].curves[method] = inputs.into_iter().zip(errors.into_iter().map(Result::ok)).collect();
        }
        motions
    }

    /// The quantity and the motion.
    pub fn title(&self) -> String {
        let over = if self.point.dead.is_empty() { "over a turn" } else { "between dead points" };
        format!("{} {over}", QUANTITIES[self.point.order])
    }

    /// The largest error of a method; none if it returns an error anywhere.
    pub fn largest(&self, method: usize) -> Option<f64> {
        let errors = self.curves[method].iter().map(|(_, error)| *error);
        errors.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::max)
    }
}
