//! Circuits: the assembly modes of linkages at one input, and the motions that connect them, as charts on one page.
//!
//! `cargo run --example circuits` writes `target/circuits.html`. In each chart the input is across and an angle up; modes are
//! dots, dead points are letters, with the linkage drawn below.

use std::error::Error;

use linkage::circuits::{CircuitOptions, Circuits};
use linkage::continuation::Options;
use linkage::drawing::CircuitChart;
use linkage::skeleton::Skeleton;
use linkage::{Branches, D};
use linkage_examples::output;

mod machines;
mod page;

use machines::{DoubleButterfly, FourBar, GearedFiveBar, Parallelogram, SliderCrank, StephensonI, Triad};

/// A chart with its text, and the numbers of modes, circuits and full turns.
pub struct Figure {
    words: &'static str,
    svg: String,
    counts: [usize; 3],
}

/// The figure of a mechanism at a start input; `unknown` is drawn up.
fn figure<M>(
    title: &'static str,
    words: &'static str,
    mechanism: &M,
    input: f64,
    unknown: &str,
) -> Result<Figure, Box<dyn Error>>
where
    M: Skeleton<Scalar = f64, Name = &'static str, V = D<1>> + Branches,
{
    // Short steps, for smooth curves.
    let path = Options { longest_step: 0.05, ..Options::default() };
    let found = Circuits::of(mechanism, input, CircuitOptions { path, ..CircuitOptions::default() })?;
    let svg = CircuitChart::of(mechanism, &found, unknown)?.title(title).to_svg();
    let counts = [found.modes.len(), found.circuits.len(), found.full_turns()];
    println!("{title}: {} modes, {} circuits, {} full turns", counts[0], counts[1], counts[2]);
    Ok(Figure { words, svg, counts })
}

fn figures() -> Result<Vec<Figure>, Box<dyn Error>> {
    let bars = |ground, crank, coupler, rocker| FourBar { ground, crank, coupler, rocker };
    Ok(vec![
        figure(
            "Crank-rocker",
            "Shortest and longest link together are shorter than the other two, and the crank is shortest: it turns, in two \
             circuits that no motion connects.",
            &bars(4.0, 1.5, 3.5, 3.0),
            1.0,
            "psi",
        )?,
        figure(
            "Four-bar in which no link turns",
            "Shortest and longest link together are longer than the other two. Both modes are one circuit; they meet where \
             coupler and rocker are in line.",
            &bars(4.0, 3.0, 2.0, 2.5),
            0.5,
            "psi",
        )?,
        figure(
            "Double rocker",
            "The coupler is shortest. The circuit above the line of the pivots; the one below has no mode at this input.",
            &bars(4.0, 3.0, 1.0, 3.5),
            0.8,
            "psi",
        )?,
        figure(
            "Slider-crank, driven by its slider",
            "The input is a length, from dead centre to dead centre.",
            &SliderCrank::default(),
            3.0,
            "phi",
        )?,
        figure(
            "Stephenson I six-bar",
            "Two modes turn fully, each a circuit; the other two are one circuit with two dead points.",
            &StephensonI::default(),
            0.2,
            "rho",
        )?,
        figure(
            "Parallelogram",
            "Parallelogram and antiparallelogram cross at both change points: two motions, one circuit.",
            &Parallelogram::default(),
            0.6,
            "phi",
        )?,
        figure(
            "Geared five-bar",
            "The second crank turns twice while the first turns three times the other way: a motion closes after three turns.",
            &GearedFiveBar::default(),
            0.3,
            "phi",
        )?,
        figure(
            "Stephenson III six-bar, driven by the far link of its dyad",
            "No loop has two unknowns only: the positions are numbered. Modes 0 and 1 change places near 37° while both are \
             regular. A full turn from mode 1 passes no dead point, and ends on mode 3.",
            &Triad::default(),
            0.5,
            "alpha",
        )?,
        figure(
            "Double butterfly",
            "Three loops, six unknowns, eight modes at this input.",
            &DoubleButterfly::default(),
            1.0,
            "rocker",
        )?,
    ])
}

fn main() -> Result<(), Box<dyn Error>> {
    let figures = figures()?;
    let counts: Vec<[usize; 3]> = figures.iter().map(|figure| figure.counts).collect();
    assert_eq!(
        counts,
        [[2, 2, 2], [2, 1, 0], [2, 1, 0], [2, 1, 0], [4, 3, 2], [2, 1, 2], [2, 2, 2], [4, 2, 0], [8, 7, 5]]
    );
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/circuits.html".to_owned());
    println!("Circuits: {}", output::write(path, &page::html(&figures))?);
    Ok(())
}
