//! A stiff spring is no stiff equation.

use linkage::simulation::{Start, simulate};
use linkage::{MotionError, linkage};
use linkage_oracle::close;

linkage! {
    #[derive(Debug, Clone)]
    pub mechanism Block {
        param m = 1, k = 1e6, c = 0;
        input y;
        body block { mass m; center (0, y); }
        scene Trembling { inertia; spring k on y; }
        scene Sprung { inertia; spring k on y; damper c on y; force (0, k * sin(t) / 10) at (0, y); }
    }
}

/// y'' = -w^2 (y - sin t / 10), y(0) = 1/10, y'(0) = 0: y = cos(w t) / 10 - p sin(w t) / w + p sin t with
/// p = w^2 / (w^2 - 1) / 10.
#[test]
fn a_vibration_of_ten_seconds() {
    let scene = Sprung::default();
    let start = Start { t: 0.0, q: BlockCoordinates { y: 0.1 }, input_rates: 0.0 };
    let mut motion = simulate(&scene, start, 10.0, 1e-8).unwrap();
    motion.finish(|_, _| true).unwrap();
    let (w, driven) = (1e3, 0.1 * 1e6 / (1e6 - 1.0));
    let exact = 0.1 * (w * 10.0_f64).cos() - driven / w * (w * 10.0).sin() + driven * 10f64.sin();
    // 1592 turns.
    close("y(10)", motion.state().q.y, exact, 1e-3);
    assert!(motion.counts().accepted < 20_000, "{:?}", motion.counts());
}

/// A vibration of a millimetre that starts in its middle: y = sin(w t) / w.
#[test]
fn a_small_vibration_of_ten_seconds() {
    let scene = Trembling::default();
    let start = Start { t: 0.0, q: BlockCoordinates { y: 0.0 }, input_rates: 1.0 };
    let mut motion = simulate(&scene, start, 10.0, 1e-8).unwrap();
    motion.finish(|_, _| true).unwrap();
    close("y(10)", motion.state().q.y, 1e-3 * 1e4_f64.sin(), 1e-5);
    assert!(motion.counts().accepted < 20_000, "{:?}", motion.counts());
}

/// With a hundred times the critical damping it follows the force, and stability limits the step.
#[test]
fn a_damped_spring_is_stiff() {
    let scene = Sprung { c: 2e5, ..Sprung::default() };
    let start = Start { t: 0.0, q: BlockCoordinates { y: 0.0 }, input_rates: 0.1 };
    let mut motion = simulate(&scene, start, 10.0, 1e-8).unwrap();
    let error = motion.finish(|_, _| true).unwrap_err();
    let MotionError::Stiff { t, product } = error else { panic!("{error}") };
    assert!(t < 1.0 && product > 6.1, "{t} {product}");
}
