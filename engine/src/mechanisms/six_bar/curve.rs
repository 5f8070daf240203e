//! The given curve: the path of a foot.

use linkage::nalgebra::Complex;
use linkage::{Elbow, linkage};
use linkage_sweep::{Plan, Sweep, SweepError, found};

linkage! {
    /// A leg of Theo Jansen's walking machine with his thirteen numbers ("The Great Pretender", 2007).
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism JansenLeg {
        param a = 38, b = 41.5, c = 39.3, d = 40.1, e = 55.8,
            f = 39.4, g = 36.7, h = 65.7, i = 49, j = 50, k = 61.9, l = 7.8, m = 15;
        input crank;
        unknown angle_b, angle_j, angle_d, angle_e, angle_c, angle_k, angle_f, angle_g, angle_h, angle_i;

        let pivot = (-a, -l);
        loop m@crank + j@angle_j = pivot + b@angle_b;
        loop b@angle_b + e@angle_e = d@angle_d;
        loop m@crank + k@angle_k = pivot + c@angle_c;
        loop d@angle_d + f@angle_f = c@angle_c + g@angle_g;
        loop g@angle_g + h@angle_h = i@angle_i;

        point Foot = pivot + c@angle_c + i@angle_i;

        derive lanes;
    }
}

/// The positions of a turn for which the curve is known. Many numbers divide this one.
const POSITIONS: u64 = 720;

/// The path of the foot of Jansen's leg over a turn of its crank at constant speed. Its lowest point has the height 0, and
/// its width is 1, so that lengths are relative to the width of a step.
#[derive(Debug, Clone, PartialEq)]
pub struct FootPath(Vec<Complex<f64>>);

impl FootPath {
    /// Computes the path.
    ///
    /// # Errors
    /// Those of [`Sweep::chunk`].
    pub fn new() -> Result<Self, SweepError> {
        let branch = JansenLegBranch::new(Elbow::Left, Elbow::Left, Elbow::Right, Elbow::Right, Elbow::Right);
        let sweep = Sweep::new(&JansenLeg::default(), branch, Plan::new().turn("crank", POSITIONS))?;
        let sweep = sweep.with_rows_per_chunk(POSITIONS as usize)?;
        let [x, y] = [found("foot_x"), found("foot_y")];
        let chunk = sweep.chunk(0, &[x.clone(), y.clone()])?;
        let [x, y] =
            [x, y].map(|column| column.place::<JansenLeg<f64>>().map(|place| chunk.column(place).unwrap_or_default()));
        let (x, y) = (x?, y?);
        let least = |values: &[f64]| values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (left, low, width) = (least(x), least(y), most(x) - least(x));
        Ok(Self(x.iter().zip(y).map(|(x, y)| Complex::new(x - left, y - low) / width).collect()))
    }

    /// The path at this many equal steps of the crank; none if the number does not divide 720.
    #[must_use]
    pub fn at(&self, positions: usize) -> Option<Vec<Complex<f64>>> {
        let step = self.0.len().checked_div(positions).filter(|step| step * positions == self.0.len())?;
        Some(self.0.iter().copied().step_by(step).collect())
    }
}
