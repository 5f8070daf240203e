//! Measured orders of convergence.

use linkage_dynamics::integrate::{Dop853, Dopri5, FixedStep, Integration, Method, Rate};

use super::systems::{circle, kepler};
use super::{State, tolerance};

/// log2 of the ratios of successive errors.
fn slopes(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

fn assert_slopes(name: &str, errors: &[f64], order: f64) {
    let slopes = slopes(errors);
    println!("{name}: {errors:?} fall with powers {slopes:.2?}");
    assert!(slopes.iter().all(|slope| (slope - order).abs() < 0.4), "{name}: {slopes:?} and not {order}");
}

/// The rate of the circle.
type Kepler = fn(f64, &State<4>) -> super::Rate<4>;

/// Steps of fixed length: the tolerance is never exceeded.
fn steps<M: Method>(end: f64, h: f64) -> Integration<Rate<Kepler, State<4>>, M> {
    let all = Integration::new(kepler as Kepler, (0.0, circle(0.0)), end, tolerance(1.0)).unwrap();
    all.first_step(h).unwrap().largest_step(h).unwrap()
}

/// The error after two units of time in `n` steps. (After a full turn errors would cancel.)
fn after<M: Method>(n: u32) -> f64 {
    let mut integration: Integration<_, M> = steps(2.0, 2.0 / f64::from(n));
    assert_eq!(integration.by_ref().filter(|step| step.is_ok()).count(), n as usize);
    (State::from(*integration.state()) - circle(2.0)).amax()
}

/// The largest error of dense output within one step from the exact state.
fn within_a_step<M: Method>(h: f64) -> f64 {
    let mut integration: Integration<_, M> = steps(h, h);
    let times: Vec<f64> = (1..20).map(|i| h * f64::from(i) / 20.0).collect();
    let states: Vec<_> = integration.at(times).map(Result::unwrap).collect();
    assert_eq!((states.len(), integration.counts().accepted), (19, 1));
    states.iter().fold(0.0, |most: f64, (t, y)| most.max((State::from(*y) - circle(*t)).amax()))
}

#[test]
fn solutions_are_of_their_orders() {
    assert_slopes("DOPRI5", &[48, 96, 192].map(after::<Dopri5>), 5.0);
    assert_slopes("DOP853", &[4, 8, 16].map(after::<Dop853>), 8.0);
}

#[test]
fn dense_output_is_of_its_order() {
    // The local error of order q is O(h^(q + 1)).
    assert_slopes("DOPRI5", &[0.4, 0.2, 0.1, 0.05].map(within_a_step::<Dopri5>), 5.0);
    assert_slopes("DOP853", &[0.8, 0.4, 0.2].map(within_a_step::<Dop853>), 8.0);
}

#[test]
fn fixed_steps_are_of_order_4() {
    let errors = [50_u32, 100, 200].map(|n| {
        let turn = std::f64::consts::TAU;
        let mut motion = FixedStep::new(kepler, (0.0, circle(0.0)), turn / f64::from(n)).unwrap();
        (0..n).for_each(|_| motion.step().unwrap());
        assert!((motion.t() - turn).abs() <= 4.0 * f64::EPSILON);
        (State::from(*motion.state()) - circle(turn)).amax()
    });
    assert_slopes("RK4", &errors, 4.0);
}
