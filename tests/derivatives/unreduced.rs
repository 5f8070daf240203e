//! Inertia and forces in all coordinates: reduced by W they are the emitted mass matrix and forces.

use linkage::nalgebra::SMatrix;
use linkage::{Build, Column, D, Matrix, Mechanism, MotionError, Scene};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_gallery::andrews_scene::*;
use linkage_gallery::five_bar_scenes::*;
use linkage_gallery::four_bar_scenes::*;
use linkage_gallery::slider_crank_scenes::*;

/// Assembled random poses of a scene.
const POSES: usize = 200;

const TOLERANCE: f64 = 1e-11;

type Reduced<S> = Result<(Matrix<f64, <S as Scene>::V, <S as Scene>::V>, Column<f64, <S as Scene>::V>), MotionError>;

/// Compares at random positions whose inputs are within `spread` of those of `near`.
#[track_caller]
fn agree<S, M, const U: usize>(
    scene: &S,
    (near, spread): (M::Coordinates, f64),
    emitted: impl Fn(f64, &M::Coordinates, Column<f64, S::V>) -> Reduced<S>,
) where
    S: Scene<Scalar = f64, U = D<U>, Mechanism = M>,
    M: Mechanism<Scalar = f64, U = D<U>, V = S::V>,
{
    let mechanism = scene.mechanism();
    let mut random = SmallRng::seed_from_u64(1867);
    let mut compared = 0;
    for _ in 0..POSES {
        let v = M::inputs(&near).map(|value| value + random.random_range(-spread..spread));
        let input_rates = v.dim().column(|_| random.random_range(-8.0..8.0));
        let t = random.random_range(-5.0..5.0);
        let Ok(found) = linkage::position::newton(mechanism, &M::with_inputs(&near, v)) else { continue };
        let q = found.coordinates;
        let pose = mechanism.pose_at(&q);
        let (j, a) = (mechanism.jacobian_unknowns(&pose), mechanism.jacobian_inputs(&pose));
        let Some(inverse) = SMatrix::from(j).try_inverse().map(Matrix::from) else { continue };
        let w = -(inverse * a);
        let rates = M::rates(w * input_rates, input_rates);
        let bias = -(inverse * mechanism.gamma(&pose, &rates));
        let all = scene.unreduced(t, &q, &rates).unwrap();
        assert_eq!((all.unknowns, all.inputs), (all.unknowns.transpose(), all.inputs.transpose()));
        let mass = w.transpose() * (all.unknowns * w + all.mixed) + all.mixed.transpose() * w + all.inputs;
        let of_unknowns = all.unknown_forces - all.unknowns * bias;
        let forces = w.tr_mul(&of_unknowns) + all.input_forces - all.mixed.tr_mul(&bias);
        let size = (w.abs().tr_mul(&(all.unknown_forces.abs() + all.unknowns.abs() * bias.abs()))
            + all.input_forces.abs()
            + all.mixed.abs().tr_mul(&bias.abs()))
        .largest();
        let (expected_mass, expected_forces) = emitted(t, &q, input_rates).unwrap();
        let error = (mass - expected_mass).largest() / expected_mass.largest();
        assert!(error < TOLERANCE, "M: {error:e} at {q:?}");
        let error = (forces - expected_forces).largest() / size;
        assert!(error < TOLERANCE, "Q: {error:e} at {q:?}");
        compared += 1;
    }
    assert!(compared > POSES / 2, "{compared}");
}

macro_rules! agrees {
    ($scene:expr, $near:expr, $inputs:ident, $spread:expr) => {
        agree(&$scene, ($near, $spread), |t, q, rates| {
            Ok(($scene.mass_matrix(q)?.into(), $scene.forces(t, q, $inputs::from(rates))?.into()))
        })
    };
}

#[test]
fn one_input() {
    let near = LoadedFourBarCoordinates { theta2: 1.0, theta3: 0.4, theta4: -1.0 };
    let near = LoadedFourBar::default().solve(&near).unwrap().coordinates;
    agrees!(Idle::default(), near, LoadedFourBarInputs, 0.3);
    agrees!(Loaded::default(), near, LoadedFourBarInputs, 0.3);
    agrees!(Driven::default(), near, LoadedFourBarInputs, 0.3);
}

#[test]
fn two_inputs() {
    let near = PairCoordinates { theta1: 2.0, theta4: 1.2, theta2: 0.3, theta3: 1.9 };
    let near = Pair::default().solve(&near).unwrap().coordinates;
    agrees!(Free::default(), near, PairInputs, 0.3);
    agrees!(Half::default(), near, PairInputs, 0.3);
}

#[test]
fn a_slider_that_drives_or_is_driven() {
    let near = MachineCoordinates { phi: 1.2, psi: -0.25, z: 0.19 };
    agrees!(Turning::default(), near, CrankInputs, 0.3);
    agrees!(Pushed::default(), near, PistonInputs, 0.03);
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
    agrees!(Squeezing::default(), near, SqueezerInputs, 0.3);
}
