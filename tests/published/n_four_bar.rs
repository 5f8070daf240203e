//! The N-four-bar of the benchmark library of IFToMM (problem A02, lim.ii.udc.es/mbsbenchmark) with 10, 20 and 40
//! windows at tolerances drawn at random: 2 N + 1 uniform bars fall from upright with 1 m/s and turn for 20 s. Twice a
//! turn all bars are in line and N + 1 motions meet.
//!
//! No run may end on another motion than that of parallel uprights, and each that stops returns a typed error. The
//! energy is the same on all motions, so that only positions distinguish them. A step over a change point has the error of any
//! other: at 1e-6 it changes the energy by 4e-6 moments of inertia on the mean, others by 3e-6; ten windows end 1.1e-3 m off and
//! forty 1.7e-3 m, medians of 16 tolerances.
//!
//! ```text
//! TOLERANCES=64 cargo test --release --test published n_four_bar -- --nocapture
//! ```

use linkage::integrate::{Tolerance, dop853};
use linkage::simulation::{Start, simulate};
use linkage::{MotionError, PositionError, linkage};
use nalgebra::vector;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// Tolerances are drawn from 1e-12 to 1e-4, evenly by their logarithm.
const EXPONENTS: std::ops::Range<f64> = -12.0..-4.0;

/// The seed of the tolerances, different from the one that the steps over change points were tuned with.
const SEED: u64 = 40_961;

/// The angle from upright, and its rate, at a time: phi'' = k sin(phi) by Dormand and Prince's method, with a tolerance
/// of 1e-14.
fn pendulum(windows: f64, t: f64) -> (f64, f64) {
    let k = 9.81 * (0.5 * (windows + 1.0) + windows) / ((windows + 1.0) / 3.0 + windows);
    let tolerance = Tolerance::new(1e-14, [1.0, 1.0]).unwrap();
    let law = |_, y: &nalgebra::SVector<f64, 2>| Ok(vector![y[1], k * y[0].sin()]);
    let mut motion = dop853(law, (0.0, vector![0.0, 1.0]), t, tolerance).unwrap();
    motion.finish(|_, _| true).unwrap();
    (motion.state()[0], motion.state()[1])
}

/// The law against an elliptic integral, computed with 25 digits for 40 windows.
#[test]
fn the_pendulum_is_the_elliptic_integral() {
    for (t, angle) in [(10.0, 31.597_433_743_985_77), (20.0, 63.255_295_368_190_93)] {
        assert!((pendulum(40.0, t).0 - angle).abs() < 1e-11, "{t}");
    }
}

/// The outcome of one motion.
#[derive(Debug, Default)]
struct Run {
    /// The largest angle of an upright from the first, and of a bar from level.
    spread: f64,
    /// The distance of the first joint from its exact position at the end, in metres.
    off: f64,
    stop: Option<(f64, MotionError)>,
}

/// Runs at random tolerances, and checks their outcomes.
fn check_runs(windows: f64, count: usize, run: impl Fn(f64, (f64, f64)) -> Run) {
    let random = &mut SmallRng::seed_from_u64(SEED + windows as u64);
    let exact = pendulum(windows, 20.0);
    let (mut stops, mut worst_spread, mut worst_share) = (0, 0.0_f64, 0.0_f64);
    for _ in 0..count {
        let tolerance = 10_f64.powf(random.random_range(EXPONENTS));
        let Run { spread, off, stop } = run(tolerance, exact);
        if let Some((t, error)) = stop {
            println!("{windows} windows at {tolerance:.3e} stop at {t}: {error:?}");
            assert!(
                matches!(
                    error,
                    MotionError::ChangePoint { .. } | MotionError::Position(PositionError::Singular { .. })
                ),
                "{error}"
            );
            stops += 1;
        } else {
            worst_share = worst_share.max(off / tolerance);
        }
        worst_spread = worst_spread.max(spread);
        // On another motion, angles differ. Next to a change point, where a run stops, the rounding error divided by
        // the remaining angle is 1e-8.
        assert!(spread < 1e-5, "{windows} windows at {tolerance:e}: {spread:e}");
        assert!(off <= 2e5 * tolerance, "{windows} windows at {tolerance:e}: {off:e}");
    }
    println!(
        "{windows} windows: {stops} of {count} stop; spread {worst_spread:.1e}, off by {worst_share:.1e} tolerances"
    );
    assert!(50 * stops <= count, "{stops} of {count} stop");
}

/// Windows by number, each by its left upright, its bar, its right upright, their bodies and its number; tolerances of the inner
/// and of the outer ring.
macro_rules! windows {
    ($size:ident, $windows:literal, $few:literal $all:literal, $([$left:ident $bar:ident $right:ident $upright:ident $beam:ident $at:tt])*) => {
        mod $size {
            use super::{Run, Start, check_runs, linkage, simulate};

            linkage! {
                /// Uprights on the ground, one metre apart, joined by bars; angles from the horizontal.
                #[derive(Debug, Clone, PartialEq)]
                pub mechanism Windows {
                    param l = 1, m = 1, g = 9.81;
                    input phi0;
                    unknown $($bar, $right),*;
                    $(loop (($at - 1) * l, 0) + l@$left + l@$bar = ($at * l, 0) + l@$right;)*

                    let j = m * l^2 / 12;
                    body upright0 { mass m; inertia j; center (l/2)@phi0; angle phi0; }
                    $(body $upright { mass m; inertia j; center ($at * l, 0) + (l/2)@$right; angle $right; })*
                    $(body $beam { mass m; inertia j; center (($at - 1) * l, 0) + l@$left + (l/2)@$bar; angle $bar; })*

                    scene Falling { inertia; gravity (0, -g); energy; }
                }
            }

            #[test]
            fn never_on_another_motion() {
                check_runs($windows, linkage_trials::count("TOLERANCES", $few, $all), |tolerance, (angle, _)| {
                    let scene = Falling::default();
                    let up = std::f64::consts::FRAC_PI_2;
                    let start = WindowsCoordinates { phi0: up, $($bar: 0.0, $right: up),* };
                    let mut motion = simulate(&scene, Start { t: 0.0, q: start, input_rates: -1.0 }, 20.0, tolerance).unwrap();
                    let mut run = Run::default();
                    let end = motion.finish(|state, _| {
                        let q = &state.q;
                        for spread in [$(q.$right - q.phi0, q.$bar),*] {
                            run.spread = run.spread.max(spread.abs());
                        }
                        true
                    });
                    match end {
                        Ok(()) => {
                            let q = motion.state().q;
                            run.off = (q.phi0.cos() - angle.sin()).hypot(q.phi0.sin() - angle.cos());
                        }
                        Err(error) => run.stop = Some((motion.t(), error)),
                    }
                    run
                });
            }
        }
    };
}

/// 10, 20 and 40 windows out of four times ten.
macro_rules! sizes {
    ({$($one:tt)*} {$($two:tt)*} {$($three:tt)*} {$($four:tt)*}) => {
        windows!(ten, 10.0, 2 8, $($one)*);
        windows!(twenty, 20.0, 1 2, $($one)* $($two)*);
        windows!(forty, 40.0, 1 1, $($one)* $($two)* $($three)* $($four)*);
    };
}

sizes! {
    {
        [phi0 psi1 phi1 upright1 bar1 1] [phi1 psi2 phi2 upright2 bar2 2]
        [phi2 psi3 phi3 upright3 bar3 3] [phi3 psi4 phi4 upright4 bar4 4]
        [phi4 psi5 phi5 upright5 bar5 5] [phi5 psi6 phi6 upright6 bar6 6]
        [phi6 psi7 phi7 upright7 bar7 7] [phi7 psi8 phi8 upright8 bar8 8]
        [phi8 psi9 phi9 upright9 bar9 9] [phi9 psi10 phi10 upright10 bar10 10]
    }
    {
        [phi10 psi11 phi11 upright11 bar11 11] [phi11 psi12 phi12 upright12 bar12 12]
        [phi12 psi13 phi13 upright13 bar13 13] [phi13 psi14 phi14 upright14 bar14 14]
        [phi14 psi15 phi15 upright15 bar15 15] [phi15 psi16 phi16 upright16 bar16 16]
        [phi16 psi17 phi17 upright17 bar17 17] [phi17 psi18 phi18 upright18 bar18 18]
        [phi18 psi19 phi19 upright19 bar19 19] [phi19 psi20 phi20 upright20 bar20 20]
    }
    {
        [phi20 psi21 phi21 upright21 bar21 21] [phi21 psi22 phi22 upright22 bar22 22]
        [phi22 psi23 phi23 upright23 bar23 23] [phi23 psi24 phi24 upright24 bar24 24]
        [phi24 psi25 phi25 upright25 bar25 25] [phi25 psi26 phi26 upright26 bar26 26]
        [phi26 psi27 phi27 upright27 bar27 27] [phi27 psi28 phi28 upright28 bar28 28]
        [phi28 psi29 phi29 upright29 bar29 29] [phi29 psi30 phi30 upright30 bar30 30]
    }
    {
        [phi30 psi31 phi31 upright31 bar31 31] [phi31 psi32 phi32 upright32 bar32 32]
        [phi32 psi33 phi33 upright33 bar33 33] [phi33 psi34 phi34 upright34 bar34 34]
        [phi34 psi35 phi35 upright35 bar35 35] [phi35 psi36 phi36 upright36 bar36 36]
        [phi36 psi37 phi37 upright37 bar37 37] [phi37 psi38 phi38 upright38 bar38 38]
        [phi38 psi39 phi39 upright39 bar39 39] [phi39 psi40 phi40 upright40 bar40 40]
    }
}
