//! Frictions and stops that act where [J A] loses rank, against exact motions of a parallelogram.

use std::f64::consts::PI;

use linkage::contact::Change;
use linkage::simulation::{Start, State, simulate};
use linkage::{Mode, MotionError, linkage};

use linkage_oracle::close;

linkage! {
    /// Two equal cranks and a coupler that stays parallel to the frame, without gravity.
    #[derive(Debug, Clone)]
    mechanism Cranks {
        param a = 1, d = 2, m = 1.2, j = 5, limit = 1.5, e = 0.5, bound = 4;
        input theta;
        unknown phi, psi;
        loop a@theta + d@phi = d@0 + a@psi;
        body left { inertia j; angle theta; }
        body coupler { mass m; center a@theta + (d/2)@phi; }
        body right { inertia j; angle psi; }
        scene Rubbed { inertia; friction limit on psi; }
        scene Hit { inertia; stop psi in -9..bound, restitution e; }
    }
}

fn at(theta: f64) -> CranksCoordinates<f64> {
    CranksCoordinates { theta, phi: 0.0, psi: theta }
}

/// The inertia of all parts that turn.
const INERTIA: f64 = 2.0 * 5.0 + 1.2;

/// Slowed evenly it stops after the angle that its energy lasts for, beyond 1, 2 and 3 change points or next to one.
#[test]
fn friction_takes_all_the_energy() {
    let (scene, start) = (Rubbed::default(), 0.5);
    let near = [-0.3, -0.1, -0.03, -0.01, 0.01, 0.03, 0.1, 0.3].map(|beyond| PI + beyond);
    for end in [2.9, 5.0, 7.8, 8.9, 10.1].into_iter().chain(near) {
        let speed = (2.0 * scene.limit / INERTIA * (end - start)).sqrt();
        let mut motion = simulate(&scene, Start { t: 0.0, q: at(start), input_rates: speed }, 40.0, 1e-12).unwrap();
        let mut stuck = None;
        let mut last = 0.0;
        while let Some(state) = motion.advance().unwrap() {
            let times = (0..=10).map(|part| last + (state.t - last) * f64::from(part) / 10.0);
            for between in motion.at(times).map(Result::unwrap) {
                let ends = INERTIA * speed / scene.limit;
                let t = between.t.min(ends);
                close("theta", between.q.theta, start + t * (speed - 0.5 * scene.limit / INERTIA * t), 1e-8);
                close("psi", between.q.psi, between.q.theta, 1e-8);
                // The remaining energy is the initial energy less the work of friction.
                let energy = 0.5 * INERTIA * between.rates.theta.powi(2);
                let left = 0.5 * INERTIA * speed * speed - scene.limit * (between.q.psi - start);
                close("energy", energy, left, 1e-7);
            }
            last = state.t;
            for (_, change) in state.changes() {
                assert_eq!((change, stuck), (Change::Sticks, None));
                stuck = Some(state.t);
            }
        }
        close("sticks", stuck.unwrap(), INERTIA * speed / scene.limit, 1e-8);
        assert_eq!(motion.state().mode("friction on psi"), Some(Mode::Stick));
        close("end", motion.state().q.psi, end, 1e-8);
    }
}

/// A stop just after a change point, or before it: the crank returns at the right moment, over the change point again.
#[test]
fn a_stop_near_a_change_point() {
    let (start, speed) = (0.5, 1.3);
    for beyond in [-0.9, -0.3, -0.1, -0.03, -0.01, -1e-3, 0.0, 1e-3, 0.01, 0.03, 0.1, 0.3, 0.9] {
        let bound = PI + beyond;
        let scene = Hit { bound, ..Hit::default() };
        let mut motion = simulate(&scene, Start { t: 0.0, q: at(start), input_rates: speed }, 6.0, 1e-12).unwrap();
        let hits = (bound - start) / speed;
        let mut impacts = Vec::new();
        let mut failure = None;
        for state in motion.by_ref() {
            match state {
                Ok(state) => {
                    let expected =
                        if state.t <= hits { start + speed * state.t } else { bound - 0.5 * speed * (state.t - hits) };
                    close("theta", state.q.theta, expected, 1e-7);
                    close("psi", state.q.psi, expected, 1e-7);
                    impacts.extend(state.changes().map(|(_, change)| (state.t, change)));
                }
                Err(error) => failure = Some(error),
            }
        }
        if beyond == 0.0 {
            // In the change point itself the motion that follows is not determined.
            let Some(MotionError::ChangePoint { crossing: Some(crossing), .. }) = failure else {
                panic!("{failure:?}")
            };
            // The cranks turn alike, or crossed as d - a to -(d + a).
            assert_eq!(crossing.coordinates, ["psi", "theta"]);
            for (found, right) in crossing.rates.iter().flatten().zip([-1.0 / 3.0, 1.0, 1.0, 1.0]) {
                close("rates", *found, right, 1e-12);
            }

            continue;
        }
        assert_eq!(failure, None, "{beyond}");
        // The crank passes each multiple of pi, on its way to the stop and back.
        let passed = |from: f64, to: f64| ((from / PI).floor() - (to / PI).floor()).abs();
        let all = passed(start, bound) + passed(bound, bound - 0.5 * speed * (6.0 - hits));
        assert_eq!(f64::from(u32::try_from(motion.passages().change_points).unwrap()), all, "{beyond}");
        let [(t, Change::Impact)] = impacts[..] else { panic!("{beyond} {impacts:?}") };
        close("hits", t, hits, 1e-8);
    }
}

linkage! {
    /// Three flywheels on the links of a four-bar, a crossed parallelogram or a kite.
    #[derive(Debug, Clone)]
    mechanism Wheels {
        param a = 1, b = 2, c = 1, d = 2, j1 = 5, j2 = 1.2, j3 = 3, limit = 1.5, e = 0.5, least = -9;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = d@0 + c@psi;
        body left { inertia j1; angle theta; }
        body coupler { inertia j2; angle phi; }
        body right { inertia j3; angle psi; }
        scene Spinning { inertia; friction limit on psi; stop psi in least..20, restitution e; }
    }
}

/// Over change points: the work of friction is its moment times the distance of the wheel, an impact takes 1 - e^2.
#[test]
fn the_account_of_energy_closes() {
    let crossed = Spinning::default();
    let mut kite = Spinning::default();
    (kite.mechanism.b, kite.mechanism.c, kite.mechanism.d) = (2.0, 2.0, 1.0);
    let of_kite = WheelsCoordinates { theta: 1.0, phi: -0.4, psi: 1.8 };
    let of_crossed = WheelsCoordinates { theta: 0.9, phi: -1.03, psi: -1.93 };
    // The angle of the crank from one change point to the next.
    for (name, scene, q, between) in [("crossed", crossed, of_crossed, PI), ("kite", kite, of_kite, 2.0 * PI)] {
        for (limit, least) in [(1.5, -20.0), (0.3, -20.0), (0.3, -3.3), (0.3, -3.2), (0.0, -4.0), (1.5, -6.0)] {
            let mut scene = scene.clone();
            (scene.limit, scene.least) = (limit, least);
            let q = scene.mechanism.solve(&q).unwrap().coordinates;
            let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 4.0 }, 12.0, 1e-12).unwrap();
            let kinetic = |rate: &WheelsRates<f64>| {
                0.5 * (scene.j1 * rate.theta.powi(2) + scene.j2 * rate.phi.powi(2) + scene.j3 * rate.psi.powi(2))
            };
            let (whole, mut taken, mut last) = (kinetic(&motion.state().rates), 0.0, motion.state().q.psi);
            let (mut impacts, mut passed, mut half_turns) = (0, 0, (motion.state().q.theta / between).floor());
            for state in motion.by_ref().map(Result::unwrap) {
                let now = (state.q.theta / between).floor();
                passed += usize::from(now != half_turns);
                half_turns = now;
                taken += limit * (state.q.psi - last).abs();
                last = state.q.psi;
                close(name, kinetic(&state.rates), whole - taken, 1e-7 * whole);
                if state.changes().any(|(_, change)| change == Change::Impact) {
                    impacts += 1;
                    taken += (1.0 - scene.e.powi(2)) * kinetic(&state.rates);
                }
            }
            assert!(impacts == 1 && passed > 1, "{name} {limit} {least}: {impacts} {passed}");
            assert_eq!(motion.passages().change_points, passed, "{name} {limit} {least}");
        }
    }
}

linkage! {
    /// Steady rotation over change points, with a block that its friction holds on the coupler.
    #[derive(Debug, Clone)]
    mechanism Tray {
        param a = 1, d = 2, m = 1.2, omega = 2, from = 0.5, grip = 3;
        input theta, s;
        unknown phi, psi;
        loop a@theta + d@phi = d@0 + a@psi;
        body block { mass m; center a@theta + s@phi; }
        scene Carried { inertia; drive theta = from + omega * t; friction grip on s; }
    }
}

/// The block is held while m a omega^2 |cos theta| is at most its friction, and slips where that is exceeded, also next
/// to a change point.
#[test]
fn it_slips_in_time_near_a_change_point() {
    let omega = 2.0_f64;
    for before in [0.9, 0.5, 0.3, 0.2, 0.1, 0.05, 0.02] {
        let grip = 1.2 * omega * omega * f64::cos(before);
        let scene = Carried { grip, ..Carried::default() };
        let from = 0.5_f64.max(before + 0.1);
        let scene = Carried { from, ..scene };
        let q = TrayCoordinates { theta: from, s: 0.3, phi: 0.0, psi: from };
        let slips = (PI - before - from) / omega;
        let mut motion = simulate(
            &scene,
            Start { t: 0.0, q, input_rates: TrayInputs { theta: omega, s: 0.0 } },
            slips + 4.0 * before / omega,
            1e-12,
        )
        .unwrap();
        let mut happened = Vec::new();
        for state in motion.by_ref() {
            let state: State<_> = state.unwrap();
            happened.extend(state.changes().map(|(_, change)| (state.t, change, state.q.s)));
        }
        assert!(motion.passages().change_points > 0);
        let [(t, Change::Slips, s), (again, Change::Sticks, rest), ..] = happened[..] else { panic!("{happened:?}") };
        close("slips", t, slips, 1e-8);
        close("held until then", s, 0.3, 1e-15);
        // Also if the simulation ends next to the change point.
        for end in [-0.6, 0.0, 0.2].map(|part| (PI - from + part * before) / omega) {
            let mut motion =
                simulate(&scene, Start { t: 0.0, q, input_rates: TrayInputs { theta: omega, s: 0.0 } }, end, 1e-12)
                    .unwrap();
            motion.finish(|_, _| true).unwrap();
            let mode = motion.state().mode("friction on s");
            assert_eq!((motion.state().t, mode), (end, Some(Mode::SlipBackward)), "{before}");
        }
        // m (x'' + s'') = grip from there on, with x = a cos theta.
        let theta = |lag: f64| PI - before + omega * lag;
        let rate = |lag: f64| omega * (theta(lag).sin() - before.sin() + omega * before.cos() * lag);
        let way = |lag: f64| {
            0.5 * (omega * lag).powi(2) * before.cos() - theta(lag).cos() - before.cos() - omega * lag * before.sin()
        };
        let (mut slow, mut fast) = (2.0 * before / omega, 4.0 * before / omega);
        for _ in 0..60 {
            let middle = 0.5 * (slow + fast);
            if rate(middle) < 0.0 { slow = middle } else { fast = middle }
        }
        close("sticks", again, slips + fast, 1e-7);
        close("slid", rest, 0.3 + way(fast), 1e-8);
    }
}
