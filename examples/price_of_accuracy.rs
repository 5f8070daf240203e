//! The price of accuracy of two mechanisms of one's own and of a scene, each in one call: a toggle press, whose slider comes
//! nearly to rest at the end of its stroke; a crank that cannot turn; and the engine on its brake.
//!
//! `cargo run --release --features double-double --example price_of_accuracy` prints the tables and writes
//! `target/price_of_press.html`, `target/price_of_rocker.html` and `target/price_of_engine.html`.

use std::error::Error;

use linkage::price::{InOtherScalars, MotionPrice, PriceOptions, ScenePrice, ScenePriceOptions};
use linkage::range_of_motion::{RangeOfMotion, RangeOptions};
use linkage::simulation::Start;
use linkage::{DoubleDouble, Elbow, linkage};

#[path = "engine/machine.rs"]
#[expect(dead_code, reason = "the engine is that of another example")]
mod machine;
#[path = "output/mod.rs"]
mod output;

use machine::{EngineInputs, Frictionless, Motored, Running};

linkage! {
    /// A press: a crank moves the knee between two links, which straighten over the slider. In millimetres.
    #[derive(Debug, Clone)]
    pub mechanism TogglePress {
        param crank = 25, rod = 85, upper = 80, lower = 80, across = 100, up = 60;
        input theta;
        unknown phi, alpha, beta, s;
        loop crank@theta + rod@phi = (across, up) + upper@alpha;
        loop (across, up) + upper@alpha + lower@beta = (across, s);
        point Knee = (across, up) + upper@alpha;
        point Ram = (across, s);
    }
}

linkage! {
    /// A four-bar whose crank cannot turn. In decimetres.
    #[derive(Debug, Clone)]
    pub mechanism DoubleRocker {
        param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut pages = Vec::new();

    let press = TogglePress::default();
    let start = TogglePressCoordinates { theta: 0.0, phi: -0.2, alpha: -2.0, beta: -1.2, s: -90.0 };
    let start = press.solve(&start)?.coordinates;
    let range = RangeOfMotion::of(&press, &start, RangeOptions::default())?;
    let others = InOtherScalars {
        single: press.clone().map(|number| number as f32),
        double_double: press.clone().map(DoubleDouble::from),
    };
    let price = MotionPrice::of(&range, TogglePress::DERIVATION, &others, &PriceOptions::default())?;
    println!("{price}");
    pages.push(output::write("target/price_of_press.html", &price.to_html())?);

    // More than the crank can turn: the charts say where it ends, and why.
    let rocker = DoubleRocker::default();
    let start = rocker.assemble(0.5, DoubleRockerBranch::new(Elbow::Left))?.coordinates();
    let range = RangeOfMotion::of(&rocker, &start, RangeOptions::default())?;
    let others = InOtherScalars {
        single: rocker.clone().map(|number| number as f32),
        double_double: rocker.clone().map(DoubleDouble::from),
    };
    let asked = Some([(-120_f64).to_radians(), 120_f64.to_radians()]);
    let options = PriceOptions { inputs: asked, ..PriceOptions::default() };
    let price = MotionPrice::of(&range, DoubleRocker::DERIVATION, &others, &options)?;
    assert_eq!(price.gaps.len(), 2, "the motion ends at two dead points");
    println!("{price}");
    pages.push(output::write("target/price_of_rocker.html", &price.to_html())?);

    // Two turns, a cycle of four strokes, from 200 rad/s.
    let engine = Running::default();
    let start = Start { t: 0.0, q: machine::START, input_rates: EngineInputs { phi: 200.0 } };
    let twice = engine.clone().map(DoubleDouble::from);
    let options = ScenePriceOptions::default();
    let mut price = ScenePrice::of(&engine, &twice, Running::<f64>::DERIVATION, start, 0.06, &options)?;
    price.without("the friction of the rings", (&engine, start), (&Frictionless::default(), start))?;
    price.without("the gas", (&engine, start), (&Motored::default(), start))?;
    println!("{price}");
    pages.push(output::write("target/price_of_engine.html", &price.to_html())?);

    pages.iter().for_each(|page| println!("{page}"));
    Ok(())
}
