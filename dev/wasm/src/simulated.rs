//! Simulations of scenes, as tables.

use linkage::integrate::{Dop853, Dopri5, Method};
use linkage::simulation::{Start, simulate};
use linkage::{Column, Coordinates, D, Inputs, Kinematic, Mechanism, PerInput, Scene, Table};
use linkage_gallery::{four_bar_effects, slider_crank_scenes};

use crate::checksum::Checksum;
use crate::gallery::mechanisms;

/// The number of simulations.
pub const COUNT: usize = 2;

/// A position, the rates of the inputs and the last time.
struct Run<'n> {
    unknowns: &'n [f64],
    inputs: &'n [f64],
    rates: &'n [f64],
    end: f64,
}

/// Adds the tables of a simulation, by emitted code and at run time; returns the name of its scene.
pub fn computed(place: usize, sum: &mut Checksum) -> String {
    match place {
        0 => {
            let run = Run { unknowns: &[-0.2, 0.2], inputs: &[1.0], rates: &[20.0], end: 0.5 };
            both("slider_crank_scenes", &slider_crank_scenes::Turning::default(), &run, sum)
        }
        // All effects, with a friction and an impact.
        _ => {
            let run = Run { unknowns: &[1.2, -1.0], inputs: &[0.3], rates: &[12.0], end: 0.8 };
            both("four_bar_effects", &four_bar_effects::Everything::default(), &run, sum)
        }
    }
}

fn both<const V: usize, S>(file: &str, scene: &S, run: &Run<'_>, sum: &mut Checksum) -> String
where
    S: Scene<Scalar = f64, V = D<V>, Mechanism: Kinematic<Scalar = f64, Name = &'static str, V = D<V>>>,
{
    let all = mechanisms(file);
    let mechanism = all.iter().find(|one| one.name() == S::Mechanism::NAME).expect("the mechanism");
    let at_run_time = mechanism.design().scene(S::NAME).expect("the scene");
    let prepared = at_run_time.prepared().expect("a scene within the capacities");
    let here = prepared.with_inputs::<D<V>>().expect("as many inputs");
    for table in tables(scene, run).iter().chain(&tables(&here, run)) {
        sum.add(table);
    }
    format!("simulation of {}", S::NAME)
}

fn tables<S: Scene<Scalar = f64, Mechanism: Kinematic>>(scene: &S, run: &Run<'_>) -> [Result<String, String>; 2] {
    [table::<S, Dop853>(scene, run), table::<S, Dopri5>(scene, run)]
}

/// The steps of a motion.
fn table<S: Scene<Scalar = f64, Mechanism: Kinematic>, M: Method>(scene: &S, run: &Run<'_>) -> Result<String, String> {
    let q = coordinates::<S>(run).expect("a number for each coordinate");
    let rates: PerInput<S::Mechanism> = Column::from_slice(run.rates).expect("a number for each input");
    let rates: Inputs<S> = rates.into();
    let start = Start { t: 0.0, q, input_rates: rates };
    let motion = simulate(scene, start, run.end, 1e-8).and_then(|motion| motion.method::<M>());
    let table = motion.map(|mut motion| Table::simulated(&mut motion));
    table.map(|table| table.to_json()).map_err(|error| error.to_string())
}

fn coordinates<S: Scene<Scalar = f64>>(run: &Run<'_>) -> Option<Coordinates<S>> {
    let (unknowns, inputs) = (Column::from_slice(run.unknowns)?, Column::from_slice(run.inputs)?);
    Some(S::Mechanism::coordinates(unknowns, inputs))
}
