//! The bounds of `Rounded` against the constraints solved in 48 digits: positions on a branch, velocities, accelerations
//! and points of all mechanisms, with parameters, inputs and rates as they are.

use linkage_compiler::ids::Id;
use linkage_gallery::listed::Listed;
use linkage_oracle::precise::{Big, Scalar, big};
use linkage_rounding::Rounded;
use rand::SeedableRng;
use rand::rngs::SmallRng;

use super::reference::{Data, Reference};

/// Poses of each mechanism.
fn poses() -> usize {
    linkage_trials::count("POSES", 3, 8)
}

/// Mechanisms with user functions, whose values are data in 48 digits.
const WITH_LAWS: [&str; 2] = ["cam_follower", "cam_rocker"];

/// u, u', u'', then points with velocities and accelerations.
fn run(of: &dyn Listed<Rounded>, reference: &Reference, data: &Data) -> Option<[Vec<Rounded>; 2]> {
    let rounded = |list: &[f64]| list.iter().copied().map(Rounded::from).collect::<Vec<_>>();
    let m = of.with_parameters(&rounded(&data.parameters));
    let inputs = |order: usize| of.inputs_of(&rounded(&data.coordinates[order]));
    let pose = m.position(&rounded(&data.coordinates[0]), data.branch).ok()?;
    let velocity = pose.velocity(&inputs(1)).ok()?;
    let acceleration = pose.acceleration(&velocity, &inputs(2)).ok()?;
    let points = [
        pose.points().ok()?,
        pose.point_velocities(&velocity).ok()?,
        pose.point_accelerations(&velocity, &acceleration).ok()?,
    ];
    let position = pose.coordinates();
    let unknowns =
        |q: Vec<Rounded>| reference.derivation.unknowns.iter().map(|&place| q[place.index()]).collect::<Vec<_>>();
    Some([[position, velocity, acceleration].map(unknowns).concat(), points.concat()])
}

pub(super) fn within_bounds(of: &dyn Listed<f64>, rounded: &dyn Listed<Rounded>) {
    if WITH_LAWS.contains(&of.file()) {
        return;
    }
    let reference = Reference::new(of);
    let mut random = SmallRng::seed_from_u64(linkage_trials::seed(19_630_401));
    let (mut results, mut unknown, mut most) = (0, 0, 0.0_f64);
    for _ in 0..poses() {
        let data = reference.data(&mut random, of.branch_count());
        let Some([unknowns, points]) = run(rounded, &reference, &data) else { continue };
        let found: Vec<f64> = unknowns.iter().map(|number| number.value()).collect();
        let Some(y) = reference.solve(&data, &found, &vec![0.0; found.len()]) else { continue };
        let exact_points: Vec<Big> = reference.evaluate(&reference.points, &data, &y);
        for (number, exact) in unknowns.iter().chain(&points).zip(y.iter().chain(&exact_points)) {
            results += 1;
            if !number.error().is_finite() {
                unknown += 1;
                continue;
            }
            let off = (exact - big(number.value())).double().abs();
            let context = || format!("at {:?}, branch {}, of {:?}", data.inputs, data.branch, data.parameters);
            // The 48 digits are off by 1e-40 times a condition number.
            assert!(
                off <= number.error() + 1e-30 * number.value().abs(),
                "{number:?} is off by {off:e}: {}",
                context()
            );
            if number.error() > 0.0 {
                most = most.max(off / number.error());
            }
        }
    }
    println!("{:22} {results} results, {unknown} unknown, at most {most:.3} of the bound", of.name());
}
