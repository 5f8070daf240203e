//! The mechanisms of the command line.

mod four_bar;
pub mod six_bar;
mod slider_crank;
mod watt_six_bar;

pub use four_bar::{FourBar, FourBarBranch};
pub use slider_crank::{SliderCrank, SliderCrankBranch};
pub use watt_six_bar::{WattSixBar, WattSixBarBranch};

use linkage::{Elbow, Slider};
use linkage_sweep::{Case, found};

use crate::{EngineError, Family, Mechanisms};

impl Mechanisms {
    /// The mechanisms of the command line: `four_bar`, `slider_crank`, `six_bar` and `watt_six_bar`.
    ///
    /// # Errors
    /// [`EngineError::Registered`], if two had the same name.
    pub fn built_in() -> Result<Self, EngineError> {
        let mut mechanisms = Self::default();
        mechanisms
            .register("four_bar", four_bar())?
            .register("slider_crank", slider_crank())?
            .register("six_bar", six_bar::family()?)?
            .register("watt_six_bar", watt_six_bar())?;
        Ok(mechanisms)
    }
}

fn four_bar() -> Family<FourBar<f64>> {
    Family::new(FourBar::default(), FourBarBranch::new(Elbow::Left))
        .branch("left", FourBarBranch::new(Elbow::Left))
        .branch("right", FourBarBranch::new(Elbow::Right))
        .case_column("min_mu", [found("mu")], least)
}

fn slider_crank() -> Family<SliderCrank<f64>> {
    Family::new(SliderCrank::default(), SliderCrankBranch::new(Slider::Far))
}

fn watt_six_bar() -> Family<WattSixBar<f64>> {
    Family::new(WattSixBar::default(), WattSixBarBranch::new(Elbow::Left, Elbow::Left)).case_column(
        "min_mu",
        [found("mu")],
        least,
    )
}

/// The least number of a column, of a case in which all of them exist.
fn least(case: &Case<'_, f64, 1>) -> Option<f64> {
    if case.is_complete() { case.numbers(0).reduce(f64::min) } else { None }
}
