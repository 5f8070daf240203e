//! The N-four-bar of the benchmark library of IFToMM (problem A02, lim.ii.udc.es/mbsbenchmark): N windows of 2 N + 1
//! uniform bars fall and turn for ever. Twice a turn all bars are in line and N + 1 motions meet.
//!
//! All uprights turn by the same angle from upright, phi'' = k sin(phi), k = g/l ((N + 1)/2 + N) / ((N + 1)/3 + N): an
//! elliptic integral, whose values were computed with 34 digits; for N = 2 the published figures of the multibody code
//! EXUDYN come to them as its step falls. Energy is the same on all branches, so that only positions tell.

use linkage::simulation::{AtSingularity, Start, simulate};
use linkage::{MotionError, PositionError};

use linkage_gallery::five_windows::*;
use linkage_gallery::one_window::*;
use linkage_gallery::two_windows::*;

const UP: f64 = std::f64::consts::FRAC_PI_2;

/// Falls from upright with 1 rad/s to 10 s and 20 s: every upright must be at the exact angle, and every bar level.
macro_rules! falls {
    ($test:ident, $scene:ty, $coordinates:ident, [$($upright:ident),*], [$($bar:ident),*], $passages:expr, $exact:expr) => {
        #[test]
        fn $test() {
            let scene = <$scene>::default();
            let start = $coordinates { $($upright: UP,)* $($bar: 0.0),* };
            let mut motion = simulate(&scene, Start { t: 0.0, q: start, input_rates: -1.0 }, 20.0, 1e-14).unwrap();
            let states: Vec<_> = motion.at([10.0, 20.0]).map(Result::unwrap).collect();
            assert_eq!(states.len(), 2);
            for (state, (angle, speed)) in states.iter().zip($exact) {
                let (q, rate) = (state.q, state.rates);
                println!("{} at {}: {:e}", stringify!($scene), state.t, q.phi0 - (UP - angle));
                // B0 is at (sin, cos) of the angle, and every other joint one bar to the right of the last.
                assert!((q.phi0.cos() - angle.sin()).hypot(q.phi0.sin() - angle.cos()) < 1e-9);
                for upright in [$((q.$upright, rate.$upright)),*] {
                    assert!((upright.0 - (UP - angle)).abs() < 1e-9, "{upright:?}");
                    assert!((upright.1 + speed).abs() < 1e-8, "{upright:?}");
                }
                for bar in [$((q.$bar, rate.$bar)),*] {
                    assert!(bar.0.abs() < 1e-12 && bar.1.abs() < 1e-10, "{bar:?}");
                }
            }
            assert_eq!(motion.passages().change_points, $passages);
            println!("{:?} {:?}", motion.counts(), motion.passages());
        }
    };
}

falls!(
    one_window,
    OneFalling,
    OneWindowCoordinates,
    [phi0, phi1],
    [psi1],
    21,
    [(31.914_741_297_738_025, 1.966_934_719_440_319_5), (64.689_640_422_695_99, 5.586_460_742_462_815)]
);
falls!(
    two_windows,
    TwoFalling,
    TwoWindowsCoordinates,
    [phi0, phi1, phi2],
    [psi1, psi2],
    20,
    [(31.750_597_186_986_1, 1.506_642_180_841_829_5), (63.828_669_393_146_12, 3.385_442_556_429_288)]
);
falls!(
    five_windows,
    FiveFalling,
    FiveWindowsCoordinates,
    [phi0, phi1, phi2, phi3, phi4, phi5],
    [psi1, psi2, psi3, psi4, psi5],
    20,
    [(31.653_957_055_797_653, 1.277_587_362_674_054_4), (63.438_261_839_077_16, 2.235_619_554_772_325)]
);

#[test]
fn a_policy_ends_the_motion_where_the_input_no_longer_drives() {
    let scene = OneFalling::default();
    let start = OneWindowCoordinates { phi0: UP, psi1: 0.0, phi1: UP };
    let motion = simulate(&scene, Start { t: 0.0, q: start, input_rates: -1.0 }, 20.0, 1e-12).unwrap();
    let mut motion = motion.at_singularity(AtSingularity::Stop);
    let error = motion.finish(|_, _| true).unwrap_err();
    assert!(
        matches!(
            error,
            MotionError::Position(PositionError::Singular { mechanism: "OneWindow", group: "psi1, phi1", .. })
        ),
        "{error}"
    );
    // The computed states stay: the bars are first in line at 0.70845 s.
    assert!(motion.t() > 0.5 && motion.t() < 0.708_46 && motion.state().q.phi0 > 0.0);
    assert!(motion.next().is_none());
}
