//! The designs of an answer with their motion, computed position by position.

use std::error::Error;
use std::f64::consts::TAU;

use linkage::Elbow;
use linkage::nalgebra::Complex;
use linkage_engine::mechanisms::six_bar::{Fit, FootPath, SixBar, SixBarBranch};

use crate::query::{POSITIONS, Row};

/// The positions of a path that is drawn: a multiple of those of the query.
pub const FINE: usize = 3 * POSITIONS;

/// The points of a leg, in the order of [`Leg::positions`].
pub const NAMES: [&str; 8] = ["A", "B", "C", "D", "P", "Q", "F", "Foot"];

/// A design with its motion.
pub struct Leg {
    pub row: Row,
    /// True if the crank turns clockwise as the foot follows the curve.
    pub is_clockwise: bool,
    /// The moved points at [`FINE`] positions, from that of the first point of the curve on, in the sense of the curve.
    pub positions: Vec<[Complex<f64>; 8]>,
}

/// The branch of the query.
pub fn branch() -> SixBarBranch {
    SixBarBranch::new(Elbow::Left, Elbow::Right)
}

impl Leg {
    /// The motion of a row.
    ///
    /// # Errors
    /// If the six-bar does not assemble at one of the positions between those of the query, or its distance here is not the
    /// one of the query.
    pub fn new(curve: &FootPath, row: Row) -> Result<Self, Box<dyn Error>> {
        let design = SixBar::from(row.lengths);
        let positions = (0..FINE).map(|step| points(&design, step)).collect::<Result<Vec<_>, _>>()?;
        let every = FINE / POSITIONS;
        let path: Vec<_> = positions.iter().step_by(every).map(|points| points[7]).collect();
        let fit = Fit::new(&path, &curve.at(POSITIONS).ok_or("no curve")?).ok_or("no fit")?;
        if (fit.distance - row.distance).abs() > 1e-9 * row.distance {
            return Err(format!("design {}: distance {} and not {}", row.case, fit.distance, row.distance).into());
        }
        let start = Fit { start: fit.start * every, ..fit };
        let positions = (0..FINE).map(|k| positions[start.position(k, FINE)].map(|point| fit.place(point))).collect();
        Ok(Self { row, is_clockwise: !fit.is_forward, positions })
    }
}

/// The points of a design at a step of the turn.
fn points(design: &SixBar, step: usize) -> Result<[Complex<f64>; 8], Box<dyn Error>> {
    let pose = design.assemble(TAU * step as f64 / FINE as f64, branch())?;
    let points = design.points(&pose)?;
    let all = [points.a, points.b, points.c, points.d, points.p, points.q, points.f, points.foot];
    Ok(all.map(|point| Complex::new(point.x, point.y)))
}
