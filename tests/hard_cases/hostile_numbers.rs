//! Lengths and inputs that no mechanism has: infinite, not numbers, zero, negative, at the ends of the range. A
//! position is refused, or every number of it is finite.

use std::fmt::Debug;

use linkage::{Assembly, Dim, PerInput, PositionError};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use super::random_steps::*;

const HOSTILE: [f64; 13] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    f64::MAX,
    f64::MIN_POSITIVE,
    5e-324,
    1e-160,
    1e155,
    1e300,
    -1.0,
    -1e308,
];

/// How many positions there were, and how many were refused.
#[derive(Default)]
struct Found {
    positions: usize,
    refused: usize,
}

/// Assembles a mechanism whose parameters and inputs are partly hostile.
fn assail<M, const N: usize>(branches: &[M::Branch], random: &mut SmallRng, found: &mut Found)
where
    M: Assembly<Scalar = f64> + Default + From<[f64; N]>,
    [f64; N]: From<M>,
    M::Pose: Debug,
{
    for _ in 0..2000 {
        let mut parameters: [f64; N] = M::default().into();
        let mut inputs = PerInput::<M>::from_fn(|_| random.random_range(-3.0..3.0));
        for _ in 0..random.random_range(1..=3) {
            let place = random.random_range(0..N + M::V::COUNT);
            // Or a number of any size.
            let bad = match HOSTILE.get(random.random_range(0..2 * HOSTILE.len())) {
                Some(&bad) => bad,
                None => random.random_range(-2.0..2.0) * 2_f64.powi(random.random_range(-540..540)),
            };
            if place < N {
                parameters[place] = bad;
            } else {
                inputs[place - N] = bad;
            }
        }
        let m = M::from(parameters);
        for &branch in branches {
            match m.assemble(inputs.into(), branch) {
                Ok(pose) => {
                    found.positions += 1;
                    let text = format!("{pose:?}");
                    assert!(!text.contains("NaN") && !text.contains("inf"), "{parameters:?} {inputs:?}: {text}");
                }
                Err(
                    PositionError::NotFinite { .. }
                    | PositionError::Unbuildable { .. }
                    | PositionError::Undetermined { .. },
                ) => {
                    found.refused += 1;
                }
                Err(error) => panic!("{parameters:?} {inputs:?}: {error}"),
            }
        }
    }
}

/// Triangles of all shapes and sizes, in both precisions: what is plain has no verdict of its own.
#[test]
fn dyads_of_every_size() {
    let random = &mut SmallRng::seed_from_u64(5);
    let mut positions = 0;
    for _ in 0..200_000 {
        let most = [3, 30, 70, 300, 540][random.random_range(0..5)];
        let mut length = || random.random_range(1.0..2.0) * 2_f64.powi(random.random_range(-most..=most));
        let (ground, crank, p, gap) = (length(), length(), length(), length());
        // Nearly equal links, so that the line between their joints may be anything.
        let m = FourBar::new(ground, crank, p, p + gap);
        for branch in FourBarBranch::all() {
            let theta2 = random.random_range(-3.0..3.0);
            let double = m.assemble(theta2, branch).map(|pose| format!("{pose:?}"));
            let single = m.clone().map(|length| length as f32).assemble(theta2 as f32, branch);
            for text in [double, single.map(|pose| format!("{pose:?}"))].into_iter().flatten() {
                positions += 1;
                assert!(!text.contains("NaN") && !text.contains("inf"), "{m:?} {theta2}: {text}");
            }
        }
    }
    assert!(positions > 100_000, "{positions} positions");
}

macro_rules! all {
    ($random:ident, $found:ident: $($M:ident $Branch:ident)*) => {
        $(assail::<$M, _>(&$Branch::all().collect::<Vec<_>>(), $random, $found);)*
    };
}

#[test]
fn a_position_is_refused_or_finite() {
    let (random, found) = (&mut SmallRng::seed_from_u64(3), &mut Found::default());
    all! { random, found:
        Andrews AndrewsBranch
        CamFollower CamFollowerBranch
        CamRocker CamRockerBranch
        Cardan CardanBranch
        ChebyshevCoupler ChebyshevCouplerBranch
        CoupledWheels CoupledWheelsBranch
        CrankShaper CrankShaperBranch
        EllipticTrammel EllipticTrammelBranch
        FiveBar FiveBarBranch
        FourBar FourBarBranch
        GearedFiveBar GearedFiveBarBranch
        Geneva GenevaBranch
        Hart HartBranch
        Hoecken HoeckenBranch
        InvertedSliderCrank InvertedSliderCrankBranch
        Jansen JansenBranch
        Klann KlannBranch
        OffsetSliderCrank OffsetSliderCrankBranch
        Pantograph PantographBranch
        Peaucellier PeaucellierBranch
        Roberts RobertsBranch
        ScotchYoke ScotchYokeBranch
        SixBar SixBarBranch
        StephensonI StephensonIBranch
        StephensonIII StephensonIIIBranch
        VTwin VTwinBranch
        WattI WattIBranch
        WattII WattIIBranch
        WattLine WattLineBranch
        Whitworth WhitworthBranch
        Wiper WiperBranch
    }
    let Found { positions, refused } = found;
    println!("{positions} positions, {refused} refused");
    assert!(*positions > 30_000 && *refused > 150_000, "{positions} positions, {refused} refused");
}
