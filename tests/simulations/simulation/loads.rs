//! Forces at given times: those of the states that `at` returns, and `Scene::loads` at the same states.

use linkage::simulation::{Loads, Start, State, simulate};
use linkage::{Mode, PerInput, Scene, Slider, linkage};
use linkage_oracle::close;

linkage! {
    /// An arm that turns about its pin.
    #[derive(Debug, Clone)]
    pub mechanism Arm {
        param c = 0.4, m = 2, j = 0.05, g = 9.81, swing = 0.8, w = 3, limit = 0.7, mu = 0.2, radius = 0.05;
        input phi;
        body arm { mass m; inertia j; center c@phi; angle phi; }
        scene Swung {
            inertia;
            gravity (0, -g);
            drive phi = swing * sin(w * t);
            friction limit on phi;
            reaction at (0, 0);
        }
        scene Worn {
            inertia;
            gravity (0, -g);
            drive phi = swing * sin(w * t);
            friction mu, radius, reaction on phi;
            reaction at (0, 0);
        }
        /// At rest until t = 2.
        scene Held { inertia; gravity (0, -g); torque m * g * c * (1 + t) on phi; friction 2 * m * g * c on phi; }
    }
}

linkage! {
    /// A slider-crank in the coordinate of its slider or of its crank.
    #[derive(Debug, Clone)]
    pub mechanism Pump {
        param r = 0.05, l = 0.15, j = 0.01, m = 0.9, mu = 0.1, w = 40, lower = 0.15, least = 0.2;
        coordinate z, phi, psi;
        loop r@phi + l@psi = (z, 0);
        point A = r@phi;
        drive ByPiston by z;
        drive ByCrank by phi;
        body crank { inertia j; angle phi; }
        body rod { mass m / 3; inertia 1e-3; center A + (l / 2)@psi; angle psi; }
        body piston { mass m; center (z, 0); }
        scene Pressed of ByPiston { inertia; force (-20, 0) at (z, 0); friction 4 on z; reaction at A; }
        scene Turned of ByCrank { inertia; force (-20, 0) at (z, 0); friction 4 on z; reaction at A; }
        /// At rest on a stop of the piston, for a part of the time.
        scene Stopped of ByCrank { inertia; torque 2 * cos(20 * t) - 1 on phi; stop z in lower..1, restitution 0; friction 1 on z; reaction at A; }
        /// At rest on a stop of the crank near the dead point of the piston, which moves it.
        scene Pinched of ByPiston { inertia; force (20, 0) at (z, 0); stop phi in least..3, restitution 0; reaction at A; }
        scene Driven of ByCrank { inertia; drive phi = w * t; friction mu, reaction on z; reaction at A; }
    }
}

/// The forces of contacts and drives, the power of the drives, and the force in a pin.
fn listed<S: Scene<Scalar = f64>>(loads: &Loads<S>, pin: impl Into<[f64; 2]>) -> Vec<f64> {
    let drives: PerInput<S::Mechanism> = loads.drives.into();
    let all = loads.contacts.iter().chain(drives.iter()).copied().chain([loads.drive_power]);
    all.chain(pin.into()).collect()
}

/// Compares lists relative to the largest force.
#[track_caller]
fn agree(t: f64, found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    let scale = expected.iter().fold(0.0_f64, |scale, force| scale.max(force.abs()));
    for (&found, &expected) in found.iter().zip(expected) {
        close(format!("t = {t}"), found, expected, tolerance * scale);
    }
}

/// 100 times within steps.
fn times(end: f64) -> impl Iterator<Item = f64> + Clone {
    (0..100).map(move |i| end * (f64::from(i) + 0.377) / 100.0)
}

/// Inverse dynamics of the driven arm: the torque (j + m c^2) phi'' + m g c cos phi against the friction, and the force
/// m (a + g) in the pin.
#[test]
fn forces_of_a_driven_arm() {
    let (c, m, j, g, swing, w) = (0.4, 2.0, 0.05, 9.81, 0.8, 3.0_f64);
    let expected = |t: f64, limit: &dyn Fn([f64; 2]) -> f64| {
        let (sin, cos) = (w * t).sin_cos();
        let [phi, rate, acceleration] = [swing * sin, swing * w * cos, -swing * w * w * sin];
        let along = m * (g * phi.sin() - c * rate * rate);
        let across = m * (g * phi.cos() + c * acceleration);
        let pin = [along * phi.cos() - across * phi.sin(), along * phi.sin() + across * phi.cos()];
        let friction = -limit(pin) * rate.signum();
        let torque = (j + m * c * c) * acceleration + m * g * c * phi.cos() - friction;
        [friction, torque, torque * rate, pin[0], pin[1]]
    };
    let start = || Start { t: 0.0, q: ArmCoordinates { phi: 0.0 }, input_rates: swing * w };
    let (swung, worn) = (Swung::default(), Worn::default());
    let mut of_swung = simulate(&swung, start(), 4.0, 1e-10).unwrap();
    let mut of_worn = simulate(&worn, start(), 4.0, 1e-10).unwrap();
    for t in times(4.0) {
        let expected_torque = expected(t, &|_| 0.7);
        let State { q, rates, .. } = of_swung.at([t]).next().unwrap().unwrap();
        let (within, apart) = (of_swung.loads().unwrap(), swung.loads(t, &q, rates.phi).unwrap());
        agree(t, &listed(&within, within.joints.origin_on_arm), &expected_torque, 1e-13);
        agree(t, &listed(&apart, apart.joints.origin_on_arm), &expected_torque, 1e-13);
        assert_eq!(swung.drive_forces(t, &q, rates.phi).unwrap().phi, apart.drives.phi);

        let expected_torque = expected(t, &|[x, y]| 0.2 * 0.05 * x.hypot(y));
        let State { q, rates, .. } = of_worn.at([t]).next().unwrap().unwrap();
        let (within, apart) = (of_worn.loads().unwrap(), worn.loads(t, &q, rates.phi).unwrap());
        agree(t, &listed(&within, within.joints.origin_on_arm), &expected_torque, 1e-13);
        agree(t, &listed(&apart, apart.joints.origin_on_arm), &expected_torque, 1e-13);
        assert_eq!(worn.drive_forces(t, &q, rates.phi).unwrap().phi, apart.drives.phi);
    }
    // The times are within steps, and the joint has turned back seven times.
    let counts = of_swung.counts();
    assert!(counts.accepted < 60, "{counts:?}");
}

/// `with_loads` and the loads after `at` are those of `Scene::loads`, where the friction slips and where it sticks.
#[test]
fn forces_between_a_rest_and_a_slip() {
    let (weight, held) = (2.0 * 9.81 * 0.4, Held::default());
    let start = || Start { t: 0.0, q: ArmCoordinates { phi: 0.0 }, input_rates: 0.0 };
    let mut motion = simulate(&held, start(), 2.2, 1e-10).unwrap();
    let mut modes = [0; 2];
    for item in motion.at(times(2.2)).with_loads() {
        let (state, loads) = item.unwrap();
        let sticks = state.contacts[0].mode == Mode::Stick;
        // At rest it carries the torque that exceeds the weight.
        let expected = if sticks { -weight * state.t } else { -2.0 * weight };
        close("friction", loads.contacts[0], expected, 1e-12 * weight);
        let apart = held.loads(state.t, &state.q, state.rates.phi).unwrap();
        close("apart", apart.contacts[0], expected, 1e-12 * weight);
        assert!(loads.are_unique && apart.are_unique);
        modes[usize::from(sticks)] += 1;
    }
    assert!(modes[0] > 5 && modes[1] > 80, "{modes:?}");
    // The loads follow the state that was returned last: after a step those of its end, with the new mode at an event.
    let mut motion = simulate(&held, start(), 2.2, 1e-10).unwrap();
    close("start", motion.loads().unwrap().contacts[0], 0.0, 1e-12 * weight);
    while let Some(state) = motion.advance().unwrap() {
        let expected = if state.contacts[0].mode == Mode::Stick { -weight * state.t } else { -2.0 * weight };
        close("end of a step", motion.loads().unwrap().contacts[0], expected, 1e-10 * weight);
        let end = motion.loads().unwrap();
        let [earlier] = [state.t * (1.0 - 1e-3)];
        if let Some(Ok(within)) = motion.at([earlier]).next() {
            let at_rest = within.contacts[0].mode == Mode::Stick;
            let expected = if at_rest { -weight * earlier } else { -2.0 * weight };
            close("within", motion.loads().unwrap().contacts[0], expected, 1e-10 * weight);
        }
        motion.at([state.t]).next().unwrap().unwrap();
        assert_eq!(motion.loads().unwrap(), end);
    }
}

/// A motion in the coordinate of the piston passes its dead points in other coordinates; the crank has none.
#[test]
fn forces_near_dead_points() {
    let (pressed, turned) = (Pressed::default(), Turned::default());
    let q = turned.mechanism.assemble(0.9, ByCrankBranch { z_psi: Slider::Far }).unwrap().coordinates();
    let rates = turned.mechanism.motion(&q, 30.0, 0.0).unwrap().rates;
    let mut motion = simulate(&pressed, Start { t: 0.0, q, input_rates: rates.z }, 0.4, 1e-11).unwrap();
    let mut least = f64::INFINITY;
    for item in motion.at(times(0.4)).with_loads() {
        let (state, within) = item.unwrap();
        let apart = turned.loads(state.t, &state.q, state.rates.phi).unwrap();
        let expected = listed(&apart, apart.joints.a_on_rod);
        agree(state.t, &listed(&within, within.joints.a_on_rod), &expected, 1e-11);
        least = least.min(state.q.phi.sin().abs());
    }
    // Some times are near dead points.
    assert!(least < 0.1 && motion.passages().exchanges >= 4, "{least} {:?}", motion.passages());
}

/// The power of the drive is that of the inertia and of the friction by reaction: at constant speed dE/dt + mu |N z'|.
#[test]
fn power_of_a_drive_against_friction_by_reaction() {
    let driven = Driven::default();
    let q = driven.mechanism.assemble(0.0, ByCrankBranch { z_psi: Slider::Far }).unwrap().coordinates();
    let mut motion = simulate(&driven, Start { t: 0.0, q, input_rates: 40.0 }, 0.3, 1e-10).unwrap();
    let free = Driven { mu: 0.0, ..driven.clone() };
    for item in motion.at(times(0.3)).with_loads() {
        let (state, loads) = item.unwrap();
        let apart = driven.loads(state.t, &state.q, 40.0).unwrap();
        agree(state.t, &listed(&loads, loads.joints.a_on_rod), &listed(&apart, apart.joints.a_on_rod), 1e-12);
        let lossless = free.drive_forces(state.t, &state.q, 40.0).unwrap().phi * 40.0;
        let friction = loads.contacts[0] * state.rates.z;
        assert!(friction <= 0.0);
        close("power", loads.drive_power, lossless - friction, 1e-11 * lossless.abs().max(1.0));
    }
}

/// `Scene::loads` finds what rests in a simulation, also near the dead point of the input that moves it.
#[test]
fn forces_at_rest_on_a_stop() {
    let mut rests = 0;
    for step in 0..20 {
        let lower = 0.12 + 0.003 * f64::from(step);
        let stopped = Stopped { lower, ..Stopped::default() };
        let q = stopped.mechanism.assemble(0.3, ByCrankBranch { z_psi: Slider::Far }).unwrap().coordinates();
        let mut motion = simulate(&stopped, Start { t: 0.0, q, input_rates: 10.0 }, 0.5, 1e-9).unwrap();
        for item in motion.at(times(0.5)).with_loads() {
            let (state, within) = item.unwrap();
            let apart = stopped.loads(state.t, &state.q, state.rates.phi).unwrap();
            let expected = listed(&within, within.joints.a_on_rod);
            agree(state.t, &listed(&apart, apart.joints.a_on_rod), &expected, 1e-9);
            rests += usize::from(state.contacts[0].mode == Mode::AtLower);
        }
        let least = 0.1 + 0.02 * f64::from(step);
        let pinched = Pinched { least, ..Pinched::default() };
        let q = stopped.mechanism.assemble(0.8, ByCrankBranch { z_psi: Slider::Far }).unwrap().coordinates();
        let mut motion = simulate(&pinched, Start { t: 0.0, q, input_rates: 0.0 }, 0.5, 1e-9).unwrap();
        for item in motion.at(times(0.5)).with_loads() {
            let (state, within) = item.unwrap();
            let apart = pinched.loads(state.t, &state.q, state.rates.z).unwrap();
            let expected = listed(&within, within.joints.a_on_rod);
            agree(state.t, &listed(&apart, apart.joints.a_on_rod), &expected, 1e-9);
            rests += usize::from(state.contacts[0].mode == Mode::AtLower);
        }
    }
    assert!(rests > 1000, "{rests}");
}
