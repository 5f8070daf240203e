//! Inertia and forces in all coordinates: what W makes of them are the mass matrix and the forces that are emitted.

use std::fmt::Debug;

use linkage::nalgebra::{SMatrix, SVector};
use linkage::{Error, Mechanism, Scene, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

include!("mechanisms/andrews_scene.rs");
include!("mechanisms/five_bar_scenes.rs");
include!("mechanisms/four_bar_scenes.rs");
include!("mechanisms/slider_crank_scenes.rs");

/// Poses a scene that can be assembled.
const POSES: usize = 200;

const TOLERANCE: f64 = 1e-11;

type Reduced<const V: usize> = Result<(SMatrix<f64, V, V>, SVector<f64, V>), Error>;

/// Compares at random positions whose inputs are within `spread` of those of `near`.
#[track_caller]
fn agree<S, const U: usize, const V: usize, const N: usize, const C: usize>(
    scene: &S,
    (near, spread): (<S::Mechanism as Mechanism<f64, U, V>>::Coordinates, f64),
    emitted: impl Fn(f64, &<S::Mechanism as Mechanism<f64, U, V>>::Coordinates, SVector<f64, V>) -> Reduced<V>,
) where
    S: Scene<f64, U, V, N, C>,
    <S::Mechanism as Mechanism<f64, U, V>>::Coordinates: Debug,
{
    let mechanism = scene.mechanism();
    let mut random = SmallRng::seed_from_u64(1867);
    let mut compared = 0;
    for _ in 0..POSES {
        let v = S::Mechanism::inputs(&near).map(|value| value + random.random_range(-spread..spread));
        let rate = SVector::<f64, V>::from_fn(|_, _| random.random_range(-8.0..8.0));
        let t = random.random_range(-5.0..5.0);
        let Ok(found) = linkage::position::newton(mechanism, &S::Mechanism::with_inputs(&near, v)) else { continue };
        let q = found.coordinates;
        let pose = mechanism.pose_at(&q);
        let (j, a) = (mechanism.jacobian_unknowns(&pose), mechanism.jacobian_inputs(&pose));
        let Some(inverse) = j.try_inverse() else { continue };
        let w = -(inverse * a);
        let velocity = S::Mechanism::with_inputs(&S::Mechanism::with_unknowns(&q, w * rate), rate);
        let bias = -(inverse * mechanism.gamma(&pose, &velocity));
        let all = scene.unreduced(t, &q, &velocity).unwrap();
        assert_eq!((all.unknowns, all.inputs), (all.unknowns.transpose(), all.inputs.transpose()));
        let mass = w.transpose() * (all.unknowns * w + all.mixed) + all.mixed.transpose() * w + all.inputs;
        let of_unknowns = all.unknown_forces - all.unknowns * bias;
        let forces = w.transpose() * of_unknowns + all.input_forces - all.mixed.transpose() * bias;
        let size = (w.abs().transpose() * (all.unknown_forces.abs() + all.unknowns.abs() * bias.abs())
            + all.input_forces.abs()
            + all.mixed.abs().transpose() * bias.abs())
        .amax();
        let (expected_mass, expected_forces) = emitted(t, &q, rate).unwrap();
        let error = (mass - expected_mass).amax() / expected_mass.amax();
        assert!(error < TOLERANCE, "M: {error:e} at {q:?}");
        let error = (forces - expected_forces).amax() / size;
        assert!(error < TOLERANCE, "Q: {error:e} at {q:?}");
        compared += 1;
    }
    assert!(compared > POSES / 2, "{compared}");
}

macro_rules! agrees {
    ($scene:expr, $near:expr, $inputs:ident) => {
        agree(&$scene, ($near, 0.3), |t, q, rate| {
            Ok(($scene.mass_matrix(q)?, $scene.forces(t, q, $inputs::from(rate))?))
        })
    };
}

#[test]
fn one_input() {
    let near = LoadedFourBarCoordinates { theta2: 1.0, theta3: 0.4, theta4: -1.0 };
    let near = LoadedFourBar::default().solve(&near).unwrap().coordinates;
    agrees!(Idle::default(), near, LoadedFourBarInputs);
    agrees!(Loaded::default(), near, LoadedFourBarInputs);
    let driven = Driven::default();
    agree(&driven, (near, 0.3), |t, q, rate| Ok((driven.mass_matrix(q)?, driven.forces(t, q, rate[0])?)));
}

#[test]
fn two_inputs() {
    let near = PairCoordinates { theta1: 2.0, theta4: 1.2, theta2: 0.3, theta3: 1.9 };
    let near = Pair::default().solve(&near).unwrap().coordinates;
    agrees!(Free::default(), near, PairInputs);
    agrees!(Half::default(), near, PairInputs);
}

#[test]
fn a_slider_that_drives_or_is_driven() {
    let near = MachineCoordinates { phi: 1.2, psi: -0.25, z: 0.19 };
    agrees!(Turning::default(), near, CrankInputs);
    let pushed = Pushed::default();
    agree(&pushed, (near, 0.03), |t, q, rate| Ok((pushed.mass_matrix(q)?, pushed.forces(t, q, rate[0])?)));
}

#[test]
fn seven_bodies() {
    let near = SqueezerCoordinates {
        beta: -0.0617,
        theta: 0.0,
        gamma: 0.4553,
        phi: 0.2227,
        delta: 0.4874,
        omega: -0.2227,
        epsilon: 1.2305,
    };
    agrees!(Squeezing::default(), near, SqueezerInputs);
}
