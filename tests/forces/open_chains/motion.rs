//! Simulations of open chains, their contacts, and their equilibria.

use std::f64::consts::{FRAC_PI_2, TAU};

use linkage::contact::Change;
use linkage::integrate::{Dop853, Dopri5, Method};
use linkage::simulation::{RealTime, Start, State, simulate};
use linkage::{Coordinates, Energy, Inputs, Mode, MotionError, PositionError, Scene};
use linkage_oracle::close;

use linkage_gallery::{cart_pendulum, double_pendulum, pendulum, three_link_arm};

/// The energy keeps its value in a free motion of 10 s, to `most` times the largest energy.
#[track_caller]
fn conserves<S: Scene<Scalar = f64>, M: Method>(
    scene: &S,
    (q, rates): (Coordinates<S>, Inputs<S>),
    energy: impl Fn(&State<S>) -> Energy<f64>,
    [tolerance, most]: [f64; 2],
) {
    let mut motion =
        simulate(scene, Start { t: 0.0, q, input_rates: rates }, 10.0, tolerance).unwrap().method::<M>().unwrap();
    let start = energy(motion.state());
    let (mut steps, mut scale) = (0, start.kinetic.abs() + start.potential.abs());
    while let Some(state) = motion.advance().unwrap() {
        let now = energy(&state);
        scale = scale.max(now.kinetic.abs() + now.potential.abs());
        close("energy", now.kinetic + now.potential, start.kinetic + start.potential, most * scale);
        steps += 1;
    }
    assert!(steps > 20 && motion.t() == 10.0 && motion.passages().exchanges == 0, "{steps} steps");
}

#[test]
fn energy_is_conserved() {
    let pendulum = double_pendulum::Swinging::default();
    let start = (
        double_pendulum::DoublePendulumCoordinates { theta1: 0.4, theta2: 1.9 },
        double_pendulum::DoublePendulumInputs { theta1: 1.0, theta2: -2.0 },
    );
    let of_pendulum = |state: &State<double_pendulum::Swinging>| {
        pendulum.energy(&state.q, double_pendulum::DoublePendulumInputs::from(&state.rates)).unwrap()
    };
    conserves::<_, Dop853>(&pendulum, start, of_pendulum, [1e-12, 1e-10]);
    conserves::<_, Dopri5>(&pendulum, start, of_pendulum, [1e-9, 1e-6]);

    let arm = three_link_arm::Falling::default();
    let start = (
        three_link_arm::ThreeLinkArmCoordinates { phi1: 0.2, phi2: 0.7, phi3: -0.4 },
        three_link_arm::ThreeLinkArmInputs { phi1: 0.0, phi2: 1.0, phi3: 3.0 },
    );
    let of_arm = |state: &State<three_link_arm::Falling>| {
        arm.energy(&state.q, three_link_arm::ThreeLinkArmInputs::from(&state.rates)).unwrap()
    };
    conserves::<_, Dop853>(&arm, start, of_arm, [1e-12, 1e-10]);

    let cart = cart_pendulum::Sprung { mechanism: cart_pendulum::CartPendulum::default(), ..Default::default() };
    let rolling = cart_pendulum::Rolling { g: cart.g, ..Default::default() };
    let start = (
        cart_pendulum::CartPendulumCoordinates { x: 0.3, phi: 0.5 },
        cart_pendulum::CartPendulumInputs { x: -1.0, phi: 2.0 },
    );
    let of_cart = |state: &State<cart_pendulum::Rolling>| {
        rolling.energy(&state.q, cart_pendulum::CartPendulumInputs::from(&state.rates)).unwrap()
    };
    conserves::<_, Dop853>(&rolling, start, of_cart, [1e-12, 1e-10]);
}

/// Nothing pulls the cart along the track: its momentum there is constant.
#[test]
fn the_momentum_of_a_cart_is_constant() {
    let cart = cart_pendulum::Rolling::default();
    let q = cart_pendulum::CartPendulumCoordinates { x: 0.0, phi: 0.3 };
    let rates = cart_pendulum::CartPendulumInputs { x: 0.2, phi: -1.5 };
    let mut motion = simulate(&cart, Start { t: 0.0, q, input_rates: rates }, 5.0, 1e-12).unwrap();
    let momentum = |state: &State<cart_pendulum::Rolling>| {
        (cart.mc + cart.m) * state.rates.x - cart.m * cart.mechanism.l * state.rates.phi * state.q.phi.sin()
    };
    let start = momentum(motion.state());
    while let Some(state) = motion.advance().unwrap() {
        close("momentum", momentum(&state), start, 1e-11);
    }
}

/// Steps of fixed length end where the simulation does.
#[test]
fn steps_of_fixed_length() {
    let scene = double_pendulum::Damped { low: -9.0, high: 9.0, ..Default::default() };
    let free = double_pendulum::Swinging::default();
    let q = double_pendulum::DoublePendulumCoordinates { theta1: -1.0, theta2: -1.8 };
    let at_rest = double_pendulum::DoublePendulumInputs { theta1: 0.0, theta2: 0.0 };
    let mut steps = RealTime::new(&free, Start { t: 0.0, q, input_rates: at_rest }, 1e-3).unwrap();
    for _ in 0..1000 {
        steps.step().unwrap();
    }
    let mut motion = simulate(&free, Start { t: 0.0, q, input_rates: at_rest }, 1.0, 1e-12).unwrap();
    motion.finish(|_, _| true).unwrap();
    let (found, expected) = (steps.state().unwrap(), motion.state());
    close("theta1", found.q.theta1, expected.q.theta1, 1e-9);
    close("theta2", found.q.theta2, expected.q.theta2, 1e-9);
    // Damped, the pendulum comes to the equilibrium of its spring and its weight.
    let undriven = double_pendulum::Damped { c: 2.0, ..scene };
    let still = undriven.equilibrium(0.0, &q).unwrap();
    let balance = undriven.balance(0.0, &still).unwrap();
    assert!(balance.forces.iter().zip(balance.scales).all(|(force, scale)| force.abs() < 1e-13 * scale));
}

/// By the work of the friction: between two turning points the weight loses T |theta1 - theta2|, T = mu r load.
#[test]
fn a_pendulum_with_friction_comes_to_rest() {
    let scene = pendulum::Rubbing { low: -9.0, high: 9.0, ..Default::default() };
    let torque = scene.mu * scene.r * scene.load;
    let weight = scene.m * scene.g * scene.mechanism.l;
    let q = pendulum::PendulumCoordinates { theta: -FRAC_PI_2 + 0.3 };
    let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, 60.0, 1e-11).unwrap();
    let mut turns = vec![q.theta];
    while let Some(state) = motion.advance().unwrap() {
        if state.changes().count() > 0 && state.rates.theta.abs() < 1e-9 && state.t > 0.0 {
            turns.push(state.q.theta);
        }
    }
    assert!(turns.len() > 10, "{turns:?}");
    for pair in turns.windows(2) {
        let lost = weight * (pair[0].sin() - pair[1].sin());
        close("work", lost, torque * (pair[0] - pair[1]).abs(), 1e-9 * weight);
    }
    let end = motion.state();
    assert_eq!((end.rates.theta, end.mode("friction on theta")), (0.0, Some(Mode::Stick)));
    // It sticks where the weight is less than the friction.
    assert!((weight * end.q.theta.cos()).abs() <= torque);
    let held = motion.loads().unwrap().contacts[0];
    close("held", held, weight * end.q.theta.cos(), 1e-12 * weight);
}

/// At a stop the rate becomes -e times itself, and the pendulum comes to rest there.
#[test]
fn a_pendulum_against_a_stop() {
    let scene = pendulum::Rubbing { mu: 0.0, high: -1.2, low: -1.9, ..Default::default() };
    let q = pendulum::PendulumCoordinates { theta: -1.5 };
    let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 6.0 }, 4.0, 1e-11).unwrap();
    let mut impacts: Vec<f64> = Vec::new();
    let energy = |theta: f64, rate: f64| {
        let l = scene.mechanism.l;
        0.5 * (scene.m * l * l + scene.j) * rate * rate + scene.m * scene.g * l * theta.sin()
    };
    let mut last = energy(-1.5, 6.0);
    while let Some(state) = motion.advance().unwrap() {
        let [theta, rate] = [state.q.theta, state.rates.theta];
        // Rates at a change are those before it.
        close("energy between impacts", energy(theta, rate), last, 1e-9 * (last.abs() + 10.0));
        if state.changes().any(|(_, change)| change == Change::Impact) {
            impacts.push(theta);
            last = energy(theta, -scene.e * rate);
        }
    }
    assert!(impacts.len() > 2, "{impacts:?}");
    for theta in impacts {
        assert!([scene.low, scene.high].iter().any(|stop| (theta - stop).abs() < 1e-12), "{theta}");
    }
}

/// Another unit of length changes no bit of a motion with friction and stops but the exponents of lengths.
#[test]
fn another_unit_of_length() {
    let run = |unit: f64| {
        let plain = cart_pendulum::Rubbing::default();
        let scene = cart_pendulum::Rubbing {
            mechanism: cart_pendulum::CartPendulum { l: plain.mechanism.l * unit },
            j: plain.j * unit * unit,
            g: plain.g * unit,
            push: plain.push * unit,
            normal: plain.normal * unit,
            left: plain.left * unit,
            right: plain.right * unit,
            ..plain
        };
        let q = cart_pendulum::CartPendulumCoordinates { x: 0.1 * unit, phi: 0.5 };
        let rates = cart_pendulum::CartPendulumInputs { x: unit, phi: 0.0 };
        let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: rates }, 3.0, 1e-8).unwrap();
        let (mut states, mut changes) = (Vec::new(), 0);
        while let Some(state) = motion.advance().unwrap() {
            changes += state.changes().count();
            states.push([state.t, state.q.x / unit, state.q.phi, state.rates.x / unit, state.rates.phi]);
        }
        assert!(changes > 4, "{changes} changes");
        states
    };
    let plain = run(1.0);
    for power in [-300, -40, 40, 300] {
        assert_eq!(run(2_f64.powi(power)), plain, "2^{power}");
    }
}

#[test]
fn drives_follow_their_laws() {
    let arm = three_link_arm::Moved::default();
    let q = three_link_arm::ThreeLinkArmCoordinates { phi1: 0.5, phi2: 0.0, phi3: 0.3 };
    let rates = three_link_arm::ThreeLinkArmInputs { phi1: 0.8, phi2: -0.8, phi3: 0.0 };
    let mut motion = simulate(&arm, Start { t: 0.0, q, input_rates: rates }, 3.0, 1e-11).unwrap();
    while let Some(state) = motion.advance().unwrap() {
        close("phi1", state.q.phi1, 0.5 + 0.4 * (2.0 * state.t).sin(), 1e-13);
        close("phi2", state.q.phi2, -0.8 * state.t, 1e-13);
    }
    // The drives do the work that the energy gains.
    let loads = motion.loads().unwrap();
    let end = motion.state();
    let rates = three_link_arm::ThreeLinkArmInputs::from(&end.rates);
    let power = arm.power(end.t, &end.q, rates).unwrap();
    close("power", loads.drive_power, power.applied, 1e-10 * power.applied.abs());
}

#[test]
fn hanging_and_standing_pendulums_are_in_equilibrium() {
    let scene = double_pendulum::Swinging::default();
    let lean = (scene.mechanism.h2 / scene.mechanism.s2).atan();
    for (near, upper, lower) in [(-1.3, -FRAC_PI_2, -FRAC_PI_2 - lean), (1.3, FRAC_PI_2, FRAC_PI_2 - lean)] {
        let guess = double_pendulum::DoublePendulumCoordinates { theta1: near, theta2: near };
        let found = scene.equilibrium(0.0, &guess).unwrap();
        close("upper", found.theta1, upper, 1e-14);
        close("lower", found.theta2, lower, 1e-14);
        let [[first, _], [_, last]] = scene.balance(0.0, &found).unwrap().slopes;
        assert_eq!((first < 0.0, last < 0.0), (near < 0.0, near < 0.0));
    }
    // A driven angle keeps its value.
    let half = double_pendulum::Half::default();
    let guess = double_pendulum::DoublePendulumCoordinates { theta1: -1.0, theta2: 9.0 };
    let found = half.equilibrium(0.25, &guess).unwrap();
    close("driven", found.theta2, 0.8, 1e-15);
    close("hanging", found.theta1, -FRAC_PI_2, 1e-14);
    let single = pendulum::Swinging::default();
    let found = single.equilibrium(0.0, &pendulum::PendulumCoordinates { theta: -1.0 }).unwrap();
    close("single", found.theta, -FRAC_PI_2, 1e-15);
    let small = (single.m * single.mechanism.l.powi(2) + single.j) / (single.m * single.g * single.mechanism.l);
    let start = pendulum::PendulumCoordinates { theta: found.theta + 1e-6 };
    let mut motion =
        simulate(&single, Start { t: 0.0, q: start, input_rates: 0.0 }, TAU * small.sqrt(), 1e-12).unwrap();
    motion.finish(|_, _| true).unwrap();
    close("one period", motion.state().q.theta, start.theta, 1e-12);
}

/// A cart without a spring balances anywhere: no single position is found.
#[test]
fn an_equilibrium_that_is_not_isolated_is_an_error() {
    let guess = cart_pendulum::CartPendulumCoordinates { x: 0.2, phi: -1.0 };
    let error = cart_pendulum::Rolling::default().equilibrium(0.0, &guess).unwrap_err();
    assert!(matches!(error, MotionError::Position(PositionError::NotConverged { .. })), "{error:?}");
    let found = cart_pendulum::Sprung::default().equilibrium(0.0, &guess).unwrap();
    close("x", found.x, 0.0, 1e-15);
    close("phi", found.phi, -FRAC_PI_2, 1e-15);
}

/// The acceleration of an input that moves no inertia is undetermined.
#[test]
fn a_chain_without_inertia_is_an_error() {
    let q = cart_pendulum::CartPendulumCoordinates { x: 0.0, phi: FRAC_PI_2 };
    let rates = cart_pendulum::CartPendulumInputs { x: 0.0, phi: 1.0 };
    // Nothing has a mass, or the weightless cart is below a point mass.
    for (mc, m, j) in [(0.0, 0.0, 0.02), (0.0, 1.0, 0.0)] {
        let scene = cart_pendulum::Rolling { mc, m, j, ..Default::default() };
        let error = scene.acceleration(0.0, &q, rates).unwrap_err();
        assert!(matches!(error, MotionError::NoInertia { .. }), "{error:?}");
    }
    let scene = cart_pendulum::Rolling { m: -1.0, ..Default::default() };
    assert!(scene.start(0.0, &q, &rates).is_err());
}
