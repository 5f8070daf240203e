//! The sweep of all designs.

use std::error::Error;
use std::ops::ControlFlow;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use linkage_sweep::{Best, Front, Progress, Ranked, Unbeaten};

use crate::density::{Cells, Density, Grid};
use crate::fates::{Counts, Fates};
use crate::gait::{Condition, columns};
use crate::legs::Walker;
use crate::machine;

/// The least stride relative to that of Jansen's leg.
pub const LEAST_STRIDE: f64 = 0.9;

/// The results of the sweep.
pub struct Study {
    pub designs: u64,
    pub rows: u64,
    pub seconds: f64,
    pub fates: Counts,
    /// The Pareto front of -unevenness and step height, the flattest leg first.
    pub front: Vec<Unbeaten<2>>,
    /// The leg with the longest stride that is as flat as Jansen's and steps as high.
    pub longest: Vec<Ranked>,
    /// Step height over unevenness, both in per cent, of all legs that walk.
    pub gaits: (Grid, Cells),
    /// All positions of the feet of these legs.
    pub reach: (Grid, Cells),
}

/// A leg to draw.
pub struct Chosen {
    pub letter: char,
    pub name: &'static str,
    pub walker: Walker,
}

impl Study {
    /// Computes all designs. The progress shows on a terminal only.
    pub fn new(designs: u64, known: &Walker) -> Result<Self, Box<dyn Error>> {
        let sweep = machine::sweep(designs)?;
        let top = -known.design.m;
        let condition = Condition { top, least_stride: LEAST_STRIDE * known.gait.stride };
        let gaits = Grid { x: [0.0, 10.0], y: [0.0, 140.0], cells: [80, 60] };
        let reach = Grid { x: [-130.0, 20.0], y: [-110.0, top], cells: [120, 76] };
        let reducers = (
            Fates(condition),
            Front::new(columns(), |case| condition.gait(case).map(|gait| [-gait.unevenness, gait.step])),
            Best::new(1, columns(), |case| {
                let is_better = |gait: &_| known.gait.is_no_better_than(gait);
                condition.gait(case).filter(is_better).map(|gait| gait.stride)
            }),
            Density::new(&gaits, |case, add| {
                if let Some(gait) = condition.gait(case) {
                    add([100.0 * gait.unevenness, 100.0 * gait.step]);
                }
            }),
            Density::new(&reach, |case, add| {
                if condition.gait(case).is_some() {
                    let [x, y] = case.columns;
                    x.iter().zip(y).for_each(|(x, y)| add([*x, *y]));
                }
            }),
        );
        let style = "{bar:30} {percent} %, {human_pos} positions, {eta} left";
        let bar = ProgressBar::new(sweep.rows()).with_style(ProgressStyle::with_template(style)?);
        let start = Instant::now();
        let (fates, front, longest, of_gaits, of_reach) = sweep.reduce(&reducers, |progress: Progress| {
            bar.set_position(progress.rows_done);
            // `Break` would cancel the sweep.
            ControlFlow::Continue(())
        })?;
        bar.finish_and_clear();
        Ok(Self {
            designs,
            rows: sweep.rows(),
            seconds: start.elapsed().as_secs_f64(),
            fates,
            front,
            longest,
            gaits: (gaits, of_gaits),
            reach: (reach, of_reach),
        })
    }

    /// The legs to draw: that of Jansen and the best of this sweep.
    pub fn chosen(&self, known: Walker) -> Result<Vec<Chosen>, Box<dyn Error>> {
        let sweep = machine::sweep(self.designs)?;
        let flat = self.front.iter().find(|leg| leg.scores[1] >= known.gait.step);
        let high = self.front.iter().rfind(|leg| -leg.scores[0] <= known.gait.unevenness);
        let rows = [
            ("the flattest", self.front.first().map(|leg| leg.first_row)),
            ("steps as high as A, the flattest of these", flat.map(|leg| leg.first_row)),
            ("as flat as A, the highest step of these", high.map(|leg| leg.first_row)),
            ("the highest step", self.front.last().map(|leg| leg.first_row)),
            ("as flat as A with a step as high, the longest stride", self.longest.first().map(|leg| leg.first_row)),
        ];
        let mut legs = vec![Chosen { letter: 'A', name: "Jansen's numbers", walker: known }];
        for ((name, row), letter) in rows.into_iter().zip('B'..) {
            let walker = row.map(|row| Walker::new(machine::design(&sweep, row)?)).transpose()?.flatten();
            legs.extend(walker.map(|walker| Chosen { letter, name, walker }));
        }
        Ok(legs)
    }
}
