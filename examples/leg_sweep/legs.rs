//! Single legs: their gait, their path and their picture.

use std::error::Error;
use std::f64::consts::TAU;

use linkage::drawing::Animation;
use linkage_sweep::{Plan, Sweep, SweepError};

use crate::gait::{Gait, POSITIONS, columns};
use crate::machine::{Leg, branch};

/// The frames of an animation, and its duration in seconds.
const FRAMES: u32 = 48;
const SECONDS: f64 = 3.0;

/// A leg with the path of its foot.
pub struct Walker {
    pub design: Leg,
    pub gait: Gait,
    pub path: Vec<[f64; 2]>,
}

impl Walker {
    /// The leg of a design; none if it does not walk.
    pub fn new(design: Leg) -> Result<Option<Self>, SweepError> {
        let sweep = Sweep::new(&design, branch(), Plan::new().turn("crank", POSITIONS as u64))?;
        let chunk = sweep.with_rows_per_chunk(POSITIONS)?.chunk(0, &columns())?;
        let [x, y] = [0, 1].map(|index| chunk.columns().nth(index).map_or(&[][..], |(_, _, values)| values));
        let path = x.iter().zip(y).map(|(x, y)| [*x, *y]).collect();
        let gait = if chunk.rejected() == 0 { Gait::of([x, y]) } else { None };
        Ok(gait.map(|gait| Self { design, gait, path }))
    }

    /// The leg in motion.
    pub fn picture(&self, title: &str) -> Result<String, Box<dyn Error>> {
        let mut picture = Animation::new(title, SECONDS);
        for frame in 0..=FRAMES {
            let crank = TAU * f64::from(frame) / f64::from(FRAMES);
            let points = self.design.points(&self.design.assemble(crank, branch())?)?;
            picture.frame([
                ("O", points.o),
                ("Pivot", points.pivot),
                ("Pin", points.pin),
                ("Upper", points.upper),
                ("Back", points.back),
                ("Knee", points.knee),
                ("Ankle", points.ankle),
                ("Foot", points.foot),
            ]);
        }
        picture.link(&["Pivot", "Upper", "Back"]).link(&["Knee", "Ankle", "Foot"]).link(&["Pin", "Upper"]);
        picture.link(&["Pin", "Knee"]).link(&["Pivot", "Knee"]).link(&["Back", "Ankle"]);
        picture.crank(&["O", "Pin"]).ground("O").ground("Pivot").trace("Foot");
        Ok(picture.to_svg()?)
    }
}
