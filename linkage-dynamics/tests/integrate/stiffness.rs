//! What is stiff and what is not.

use linkage_dynamics::MotionError;
use linkage_dynamics::integrate::{Tolerance, dop853, dopri5};
use linkage_runtime::nalgebra::vector;

use super::{Rate, State, tolerance};

fn show<const N: usize>(name: &str, rate: impl Fn(f64, &State<N>) -> Rate<N> + Copy, y: State<N>, end: f64, scale: [f64; N], every: usize) {
    for relative in [1e-4, 1e-6, 1e-8, 1e-10] {
        let tol = || Tolerance::new(relative, scale).unwrap();
        let mut a = dop853(rate, (0.0, y), end, tol()).unwrap().stiffness_test(every);
        let ra = a.finish(|_, _| true);
        let mut b = dopri5(rate, (0.0, y), end, tol()).unwrap().stiffness_test(every);
        let rb = b.finish(|_, _| true);
        println!("{name:24} {relative:.0e}  853: {:>8} {:?}   5: {:>8} {:?}", a.counts().accepted, ra, b.counts().accepted, rb);
    }
}

#[test]
fn table() {
  for every in [1000, 1] {
    println!("every {every}");
    show("prothero 1e4", |t, y: &State<1>| Ok(vector![-1e4 * (y[0] - t.cos())]), vector![0.0], 10.0, [1.0], every);
    show("van der pol 1e3", |_, y: &State<2>| Ok(vector![y[1], 1e3 * (1.0 - y[0] * y[0]) * y[1] - y[0]]), vector![2.0, 0.0], 2000.0, [1.0, 1.0], every);
    show("van der pol 10", |_, y: &State<2>| Ok(vector![y[1], 10.0 * (1.0 - y[0] * y[0]) * y[1] - y[0]]), vector![2.0, 0.0], 1000.0, [1.0, 1.0], every);
    show("damped c 1e5 k 1e4", |t, y: &State<2>| Ok(vector![y[1], -1e5 * y[1] - 1e4 * (y[0] - t.sin())]), vector![0.0, 1.0], 10.0, [1.0, 1.0], every);
    for (zeta, w) in [(0.0, 1e3), (0.01, 1e3), (0.05, 1e3), (0.1, 1e4), (0.2, 1e4), (0.3, 1e4), (0.5, 1e4), (0.7, 1e4), (1.0, 1e4), (3.0, 1e4)] {
        for scale in [[1.0, 1.0], [1.0, 1e3], [1e3, 1.0]] {
        show(&format!("zeta {zeta} w {w:.0e} {scale:?}"), move |t: f64, y: &State<2>| Ok(vector![y[1], -2.0 * zeta * w * y[1] - w * w * (y[0] - t.sin())]), vector![0.1, 1.0], 10.0, scale, every);
        }
    }
    show("vibration 1e3", |_, y: &State<2>| Ok(vector![y[1], -1e6 * y[0]]), vector![0.1, 0.0], 10.0, [1.0, 1.0], every);
    show("vibration 1e3 w", |_, y: &State<2>| Ok(vector![y[1], -1e6 * y[0]]), vector![0.1, 0.0], 10.0, [1.0, 316.0], every);
    show("vibration 1e3 small", |_, y: &State<2>| Ok(vector![y[1], -1e6 * y[0]]), vector![1e-7, 0.0], 10.0, [1.0, 1e3], every);
    show("robertson", |_, y: &State<3>| {
        let [a, b, c] = [0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] * y[1]];
        Ok(vector![b - a, a - b - c, c])
    }, vector![1.0, 0.0, 0.0], 1e3, [1.0, 1e-4, 1.0], every);
    show("heat 8", |t, y: &State<8>| {
        let at = |i: i32| if i < 0 { t.sin() } else if i > 7 { 0.0 } else { y[i as usize] };
        Ok(State::<8>::from_fn(|i, _| 1e4 * (at(i as i32 - 1) - 2.0 * y[i] + at(i as i32 + 1))))
    }, State::<8>::zeros(), 10.0, [1.0; 8], every);
    show("string 4+4", |_, y: &State<8>| {
        let at = |i: i32| if (0..4).contains(&i) { y[i as usize] } else { 0.0 };
        Ok(State::<8>::from_fn(|i, _| if i < 4 { y[i + 4] } else { 1e4 * (at(i as i32 - 5) - 2.0 * at(i as i32 - 4) + at(i as i32 - 3)) }))
    }, State::<8>::from_fn(|i, _| if i == 0 { 1.0 } else { 0.0 }), 10.0, [1.0; 8], every);
    show("slow with light fast", |_, y: &State<4>| Ok(vector![y[2], y[3], -y[0] - 0.01 * (y[0]-y[1]), -1e6 * (y[1] - y[0])]), vector![1.0, 1.0, 0.0, 0.0], 10.0, [1.0; 4], every);
    show("slow with damped fast", |_, y: &State<4>| Ok(vector![y[2], y[3], -y[0] - 0.01 * (y[0]-y[1]), -1e6 * (y[1] - y[0]) - 4e2 * (y[3]-y[2])]), vector![1.0, 1.0, 0.0, 0.0], 100.0, [1.0; 4], every);
    show("pendulum", super::systems::pendulum, super::systems::HORIZONTAL, 2000.0, [1.0; 2], every);
    show("arenstorf", super::systems::arenstorf, super::systems::ORBIT, 10.0*17.06, [1.0; 4], every);
  }
}
