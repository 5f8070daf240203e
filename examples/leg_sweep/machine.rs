//! The leg, and the designs around its known lengths.

use linkage::{Elbow, linkage};
use linkage_sweep::{Distribution, Plan, Sequence, Sweep, SweepError};

use crate::gait::POSITIONS;

linkage! {
    /// A leg of Theo Jansen's walking machine with his thirteen numbers ("The Great Pretender", 2007).
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Leg {
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

        point O = (0, 0);
        point Pivot = pivot;
        point Pin = m@crank;
        point Upper = pivot + b@angle_b;
        point Back = pivot + d@angle_d;
        point Knee = pivot + c@angle_c;
        point Ankle = Knee + g@angle_g;
        point Foot = Knee + i@angle_i;

        derive lanes;
    }
}

/// The names of the lengths; that of the crank is last.
pub const LENGTHS: [&str; 13] = ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m"];

/// The largest change of a length relative to the known one.
pub const SPREAD: f64 = 0.05;

/// The assembly of Jansen's leg.
pub fn branch() -> LegBranch {
    LegBranch::new(Elbow::Left, Elbow::Left, Elbow::Right, Elbow::Right, Elbow::Right)
}

/// Random designs, each over a turn of the crank. A case is a design. The crank keeps its length, which only sets the
/// scale.
pub fn sweep(designs: u64) -> Result<Sweep<Leg>, SweepError> {
    let known = Leg::default();
    let lengths: [f64; 13] = known.clone().into();
    let changed = LENGTHS.into_iter().zip(lengths).take(12);
    let columns = changed.map(|(name, length)| {
        let (from, to) = (length * (1.0 - SPREAD), length * (1.0 + SPREAD));
        (name, Distribution::Uniform { from, to })
    });
    let plan = Plan::new().sample(columns, designs, Sequence::Random).turn("crank", POSITIONS as u64);
    Sweep::new(&known, branch(), plan)?.with_case(1)
}

/// The design of a row.
pub fn design(sweep: &Sweep<Leg>, row: u64) -> Result<Leg, SweepError> {
    let numbers = sweep.row(row)?;
    Ok(Leg::from(std::array::from_fn(|place| numbers[place].1)))
}
