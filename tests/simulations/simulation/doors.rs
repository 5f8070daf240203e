//! The functions of a simulation: output times, events, progress, methods, fixed steps.

use linkage::integrate::{Crossing, Dopri5};
use linkage::simulation::{RealTime, Start, Then, simulate};

use super::rig::{Idling, start};

#[test]
fn the_same_bits_again_and_output_times_that_change_none() {
    let scene = Idling::default();
    let run = || simulate(&scene, Start { t: 0.0, q: start(), input_rates: 9.0 }, 5.0, 1e-10).unwrap();
    let (mut first, mut second, mut third) = (run(), run(), run());
    let states: Vec<_> = first.by_ref().map(Result::unwrap).collect();
    assert_eq!(states, second.by_ref().map(Result::unwrap).collect::<Vec<_>>());
    let times = (0..=1000).map(|i| 5.0 * f64::from(i) / 1000.0);
    let outputs: Vec<_> = third.at(times).map(Result::unwrap).collect();
    assert_eq!(outputs.len(), 1001);
    assert_eq!((first.state(), first.t()), (third.state(), 5.0));
    // All states satisfy the constraints, and those between the ends of steps do so to the tolerance.
    for state in &outputs {
        let q = state.q;
        let x = 0.3 * q.theta.cos() + 0.9 * q.phi.cos() - 1.0 - 0.6 * q.psi.cos();
        let y = 0.3 * q.theta.sin() + 0.9 * q.phi.sin() - 0.6 * q.psi.sin();
        // An angle of many turns has a rounding error of its own.
        let rounding = f64::EPSILON * (2.0 + q.theta.abs());
        assert!(x.abs() < rounding && y.abs() < rounding, "{}: {x:e} {y:e}", state.t);
    }
    let mut exact = simulate(&scene, Start { t: 0.0, q: start(), input_rates: 9.0 }, 5.0, 1e-14).unwrap();
    let times = (0..=1000).map(|i| 5.0 * f64::from(i) / 1000.0);
    let mut worst = [0.0_f64; 2];
    for (state, exact) in outputs.iter().zip(exact.at(times).map(Result::unwrap)) {
        worst[0] = worst[0].max((state.q.theta - exact.q.theta).abs());
        worst[1] = worst[1].max((state.rates.psi - exact.rates.psi).abs());
    }
    println!("{worst:?}");
    assert!(worst[0] < 1e-7 && worst[1] < 1e-6, "{worst:?}");
    // Back in time to where it began.
    let end = *exact.state();
    let mut back = simulate(&scene, Start { t: 5.0, q: end.q, input_rates: end.rates.theta }, 0.0, 1e-13).unwrap();
    back.finish(|_, _| true).unwrap();
    assert!((back.state().q.theta - start().theta).abs() < 1e-9 && back.t() == 0.0);
}

#[test]
fn events_with_what_they_do() {
    let scene = Idling::default();
    let motion = simulate(&scene, Start { t: 0.0, q: start(), input_rates: 9.0 }, 5.0, 1e-11).unwrap();
    // The rocker turns round; the crank has made five turns.
    let mut motion = motion
        .events(
            [Crossing::Either, Crossing::Rising],
            |state| Ok([state.rates.psi, state.q.theta - 5.0 * std::f64::consts::TAU]),
            |event, _| Ok(if event == 0 { Then::GoOn } else { Then::Stop }),
        )
        .unwrap();
    let mut turns = 0;
    for state in motion.by_ref() {
        let state = state.unwrap();
        if state.event == Some(0) {
            turns += 1;
            assert!(state.rates.psi.abs() < 1e-9);
        }
    }
    let last = *motion.state();
    assert_eq!((turns, last.event), (10, Some(1)));
    assert!((last.q.theta - 5.0 * std::f64::consts::TAU).abs() < 1e-12 && motion.progress() < 1.0);
    // An impulse that turns the crank back.
    let motion = simulate(&scene, Start { t: 0.0, q: start(), input_rates: 9.0 }, 1.0, 1e-11).unwrap();
    let mut motion = motion
        .events(
            [Crossing::Rising],
            |state| Ok([state.q.theta - 2.0]),
            |_, state| Ok(Then::Restart((-0.5 * state.rates.theta).into())),
        )
        .unwrap();
    motion.finish(|state, _| state.event.is_none()).unwrap();
    let before = motion.state().rates.theta;
    let next = motion.advance().unwrap().unwrap();
    assert!(before > 0.0 && next.rates.theta < 0.0 && next.q.theta < 2.0);
}

#[test]
fn progress_methods_and_pauses() {
    let scene = Idling::default();
    let mut motion = simulate(&scene, Start { t: 0.0, q: start(), input_rates: 9.0 }, 5.0, 1e-8)
        .unwrap()
        .largest_step(0.01)
        .unwrap();
    let mut last = 0.0;
    motion
        .finish(|_, progress| {
            assert!(progress > last);
            last = progress;
            progress < 0.5
        })
        .unwrap();
    assert!((0.5..0.51).contains(&last) && motion.t() < 2.6);
    motion.finish(|_, _| true).unwrap();
    assert_eq!((motion.progress(), motion.t()), (1.0, 5.0));
    let mut other = simulate(&scene, Start { t: 0.0, q: start(), input_rates: 9.0 }, 5.0, 1e-11)
        .unwrap()
        .method::<Dopri5>()
        .unwrap();
    other.finish(|_, _| true).unwrap();
    assert!((other.state().q.theta - motion.state().q.theta).abs() < 1e-7);
    assert!(other.counts().evaluations > 0 && other.counts().accepted < motion.counts().accepted * 10);
}

/// Kutta's method: with a tenth of the step, the error is a ten-thousandth.
#[test]
fn in_step_with_a_clock() {
    let scene = Idling::default();
    let mut exact = simulate(&scene, Start { t: 0.0, q: start(), input_rates: 9.0 }, 1.0, 1e-14).unwrap();
    exact.finish(|_, _| true).unwrap();
    let error = |steps: u32| {
        let mut clock =
            RealTime::new(&scene, Start { t: 0.0, q: start(), input_rates: 9.0 }, 1.0 / f64::from(steps)).unwrap();
        for _ in 0..steps {
            clock.step().unwrap();
        }
        assert!((clock.t() - 1.0).abs() < 1e-15);
        (clock.state().unwrap().q.theta - exact.state().q.theta).abs()
    };
    let (coarse, fine) = (error(200), error(2000));
    println!("{coarse:e} {fine:e}");
    assert!(fine < coarse * 2e-4 && fine < 1e-8, "{coarse:e} {fine:e}");
}
