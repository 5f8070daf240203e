//! The mechanisms of the gallery by emitted code.

use linkage::PositionError;
use linkage_gallery::listed::{self, Built, Listed, Moving, Posed};

use crate::checksum::Checksum;
use crate::drawn::Drawn;

/// Positions of each mechanism with plain, extreme and nearly singular arguments.
const POSITIONS: [u64; 3] = [12, 4, 6];

/// The number of mechanisms.
pub fn count() -> usize {
    listed::all().len()
}

/// Adds what a mechanism computes at random positions; returns its name.
pub fn computed(place: usize, sum: &mut Checksum) -> String {
    let of = listed::all()[place];
    let [plain, extreme, near_zero] = POSITIONS.map(|count| 0..count);
    let plain = plain.map(|seed| Drawn::new(seed, 0.0));
    let extreme = extreme.map(|seed| Drawn::new(seed, 0.1));
    for (position, drawn) in plain.chain(extreme).chain(near_zero.map(|seed| Drawn::near_zero(seed, 0.8))).enumerate() {
        at(of, drawn, position % of.branch_count(), sum);
    }
    format!("emitted {} of {}", of.name(), of.file())
}

fn at(of: &dyn Listed<f64>, mut drawn: Drawn, branch: usize, sum: &mut Checksum) {
    let parameters: Vec<f64> = of.defaults().into_iter().map(|value| drawn.near(value)).collect();
    let built = of.with_parameters(&parameters);
    let inputs = of.inputs().len();
    let mut numbers = |count: usize| -> Vec<f64> { (0..count).map(|_| drawn.number()).collect() };
    let (q, rates) = (numbers(of.unknowns().len() + inputs), numbers(of.unknowns().len() + inputs));
    let [input_rates, given] = [(); 2].map(|()| numbers(inputs));
    sum.add(&built.solved(&q));
    sum.add(&moving(&*built, &q, branch, [&input_rates, &given]));
    sum.add(&posed(&*built.pose(&q), [&rates, &input_rates, &given]));
}

/// Position, velocity and acceleration on a branch, in one computation and by parts.
fn moving(
    built: &dyn Built<f64>,
    q: &[f64],
    branch: usize,
    [rates, given]: [&[f64]; 2],
) -> Result<[Vec<Vec<f64>>; 2], PositionError> {
    let numbers = |moving: Moving<f64>| {
        let of_parts = moving.points.into_iter().chain(moving.outputs).flatten();
        [moving.pose.coordinates(), moving.rates, moving.accelerations].into_iter().chain(of_parts).collect()
    };
    let full = built.moving(q, branch, rates, given, true)?;
    Ok([numbers(full), numbers(built.moving_by_parts(q, branch, rates, given)?)])
}

/// Results of a mechanism at its coordinates.
fn posed(at: &dyn Posed<f64>, [rates, input_rates, given]: [&[f64]; 3]) -> Result<Vec<Vec<f64>>, PositionError> {
    let bent = at.acceleration(rates, given)?;
    let ratios = [vec![at.velocity_ratios()?], at.point_ratios()?, at.output_ratios()?].concat();
    let lists = [
        at.residual(),
        at.residual_scales(),
        at.jacobian().as_slice().to_vec(),
        at.jacobian_inputs().as_slice().to_vec(),
        at.block_determinants(),
        vec![at.determinant()],
        at.gamma(rates),
        at.velocity(input_rates)?,
        at.points()?,
        at.point_velocities(rates)?,
        at.point_accelerations(rates, &bent)?,
        at.outputs()?,
        at.output_rates(rates)?,
        at.output_accelerations(rates, &bent)?,
        bent,
    ];
    Ok(lists.into_iter().chain(ratios.iter().map(|matrix| matrix.as_slice().to_vec())).collect())
}
