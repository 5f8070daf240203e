//! Simulations, loads and positions at rest of scenes at run time: the bits and the words of those of emitted code.

use linkage::integrate::{Crossing, Dop853, Dopri5, Method};
use linkage::range_of_motion::Driven;
use linkage::simulation::{AtSingularity, Loads, Start, State, Then, simulate};
use linkage::{
    Assembly, Column, Coordinates, D, Inputs, JointForces, Kinematic, Mechanism, MotionErrorOf, PerInput, Scene,
    StateParts, Table, linkage,
};
use linkage_gallery::slider_crank_contacts::{Machine, MachineBranch};
use linkage_gallery::{cart_pendulum, four_bar_effects, slider_crank_contacts, slider_crank_scenes};
use linkage_interpreter::Mechanism as Compiled;

use super::{Numbers, bits, coordinates, of_text};
use crate::at_run_time;

with_text! {
    // Laws with kinks: of time and of the state.
    pub mechanism Bent {
        param m = 1, k = 3;
        input x, y;
        body ball { mass m; center (x + y, 0); }
        body other { mass 2 * m; center (y, 0); }
        scene Turned { inertia; drive x = abs(t - 1); spring k on y; }
        scene Leaping { inertia; drive x = atan2(sin(t), cos(t)); }
        scene Gathering { inertia; drive x = t^2 * abs(sin(1 / t)); }
        scene Bouncing { inertia; potential k * abs(y) + x^2; }
    }

    // A parallelogram, which passes change points.
    pub mechanism Cranks {
        param a = 0.1, b = 0.3, j = 0.01, m = 1, t0 = 0.1, hi = 3.3, e = 0.5, mu = 0.1, radius = 0.005;
        input th;
        unknown ph, ps;
        loop a@th + b@ph = (b, 0) + a@ps;
        body left { inertia j; angle th; }
        body right { inertia j; angle ps; }
        body bar { mass m; inertia 0.01; center a@th + (b/2)@ph; angle ph; }
        scene Stopped { inertia; torque t0 on th; stop th in -100..hi, restitution e; reactions; }
        scene Rubbed { inertia; torque t0 on th; friction mu, radius, reaction on ps; }
    }
}

/// A state: all numbers by their bits, names and modes.
fn of_state<S: Scene<Scalar = f64>>(state: &State<S>) -> String {
    let ((u, v), (of_u, of_v)) = (S::Mechanism::parts(&state.q), S::Mechanism::rate_parts(&state.rates));
    let numbers = bits([&state.t].into_iter().chain(&u).chain(&v).chain(&of_u).chain(&of_v));
    let modes: Vec<_> = state.contacts.iter().map(|touch| state.mode(touch.name.as_ref())).collect();
    let changes: Vec<_> = state.changes().collect();
    format!("{numbers}{:?} {:?} {modes:?} {changes:?} {:?}", state.event, state.kink, state.contacts)
}

fn of_loads<S: Scene<Scalar = f64>>(scene: &S, loads: &Loads<S>) -> String {
    let drives: PerInput<S::Mechanism> = loads.drives.into();
    let accelerations = loads.accelerations.unknowns.iter().chain(&loads.accelerations.inputs);
    let numbers = bits(loads.contacts.iter().chain(&drives).chain([&loads.drive_power]).chain(accelerations));
    let joints: Vec<_> = loads.joints.joints().zip(loads.joints.each()).collect();
    assert!(scene.joints().eq(joints.iter().map(|(joint, _)| *joint)));
    let joints: Vec<_> = joints.iter().map(|(joint, force)| format!("{joint:?} {}", bits(force))).collect();
    format!("{numbers}{} {joints:?}", loads.are_unique)
}

fn words<X>(found: Result<X, impl std::fmt::Debug + std::fmt::Display>, text: impl FnOnce(X) -> String) -> String {
    found.map_or_else(|error| format!("{error} {error:?}"), text)
}

/// A motion of a scene: the position, the rates of the inputs, the first and the last time.
#[derive(Clone, Copy)]
struct Run<Q, R> {
    q: Q,
    rates: R,
    times: [f64; 2],
    tolerance: f64,
}

type RunOf<S> = Run<Coordinates<S>, Inputs<S>>;

/// All that a scene computes in a motion, as text.
fn all<S: Scene<Scalar = f64, Mechanism: Kinematic>>(scene: &S, run: RunOf<S>) -> Vec<String> {
    let Run { q, rates, times: [start, end], .. } = run;
    let column = |y: Column<f64, S::State>| bits(&y);
    let mut found = vec![
        scene.name().to_string(),
        format!("{:?} {:?}", scene.kinks().collect::<Vec<_>>(), scene.joints().collect::<Vec<_>>()),
        words(scene.check(), |()| String::new()),
        words(scene.start(start, &q, &rates), column),
        words(scene.loads(start, &q, rates), |loads| of_loads(scene, &loads)),
        words(scene.loads_of_motion(start, &q, rates, rates), |loads| of_loads(scene, &loads)),
        words(scene.kinetic_and_potential(&q, &rates), |energy| format!("{energy:?}")),
    ];
    if let Ok(y) = scene.start(start, &q, &rates) {
        found.push(words(scene.derivative(start, &y), column));
        let StateParts { q, input_rates } = scene.parts_of(&y);
        found.push(words(scene.loads(start, &q, input_rates), |loads| of_loads(scene, &loads)));
    }
    found.extend(steps::<S, Dop853>(scene, run, AtSingularity::Pass));
    found.extend(steps::<S, Dopri5>(scene, Run { tolerance: 1e-4, ..run }, AtSingularity::Stop));
    // Backwards, beyond all steps, and with a tolerance of zero.
    found.extend(steps::<S, Dop853>(
        scene,
        Run { times: [start, start - 0.1 * (end - start)], ..run },
        AtSingularity::Pass,
    ));
    found.extend(steps::<S, Dop853>(scene, Run { tolerance: 0.0, ..run }, AtSingularity::Pass));
    found.push(words(few_steps(scene, run), |()| String::new()));
    found.extend(tables(scene, run));
    found
}

/// A simulation as a table of its steps, and of given times.
fn tables<S: Scene<Scalar = f64, Mechanism: Kinematic>>(scene: &S, run: RunOf<S>) -> [String; 2] {
    let Run { q, rates, times: [t, end], .. } = run;
    let begun = || Ok(simulate(scene, Start { t, q, input_rates: rates }, end, 1e-6)?.most_steps(60));
    let times = (0..=6).map(|part| t + (end - t) * f64::from(part) / 5.0);
    let text = |table: Result<Table, MotionErrorOf<S>>| words(table, |table| table.to_json());
    [
        text(begun().map(|mut motion| Table::simulated(&mut motion))),
        text(begun().map(|mut motion| Table::simulated_at(&mut motion, times))),
    ]
}

/// A simulation that may take three steps.
fn few_steps<S: Scene<Scalar = f64>>(scene: &S, run: RunOf<S>) -> Result<(), MotionErrorOf<S>> {
    let Run { q, rates, times: [t, end], tolerance } = run;
    let start = Start { t, q, input_rates: rates };
    let motion = simulate(scene, start, end, tolerance)?.largest_step(0.1 * (end - t))?.first_step(0.01 * (end - t))?;
    motion.most_steps(3).finish(|_, _| true)
}

/// The states of a simulation with an event, its loads, its counts and its end, then the states at given times.
fn steps<S: Scene<Scalar = f64>, M: Method>(scene: &S, run: RunOf<S>, at_singularity: AtSingularity) -> Vec<String> {
    let Run { q, rates, times: [t, end], tolerance } = run;
    let begun = || simulate(scene, Start { t, q, input_rates: rates }, end, tolerance)?.method::<M>();
    let level = S::Mechanism::inputs(&q)[0] + 0.25;
    let watched = begun().and_then(|motion| {
        motion.at_singularity(at_singularity).events(
            [Crossing::Either],
            |state| Ok([S::Mechanism::inputs(&state.q)[0] - level]),
            |_, _| Ok(Then::GoOn),
        )
    });
    let mut motion = match watched {
        Ok(motion) => motion,
        Err(error) => return vec![format!("{error} {error:?}")],
    };
    let mut found = vec![of_state(motion.state())];
    for _ in 0..2000 {
        match motion.advance() {
            Ok(Some(state)) => {
                let loads = words(motion.loads(), |loads| of_loads(scene, &loads));
                found.push(format!("{} {loads}", of_state(&state)));
            }
            Ok(None) => break,
            Err(error) => {
                found.push(format!("{error} {error:?}"));
                break;
            }
        }
    }
    found.push(format!("{:?} {:?} {}", motion.counts(), motion.passages(), bits([&motion.progress()])));
    let times = (0..=7).map(|part| t + (end - t) * 0.15 * f64::from(part));
    if let Ok(mut motion) = begun() {
        found.extend(
            motion.at(times).with_loads().map(|state| {
                words(state, |(state, loads)| format!("{} {}", of_state(&state), of_loads(scene, &loads)))
            }),
        );
    }
    found
}

/// A scene of a mechanism, in a file of the gallery or in this one.
#[derive(Clone, Copy)]
pub struct Named {
    file: &'static str,
    mechanism: &'static str,
    scene: &'static str,
}

impl Named {
    pub fn of(file: &'static str, mechanism: &'static str, scene: &'static str) -> Self {
        Self { file, mechanism, scene }
    }

    fn compiled(&self) -> Compiled {
        match self.file {
            "" => of_text(OF_THIS_FILE, self.mechanism),
            file => at_run_time::of(file, self.mechanism),
        }
    }
}

/// Compares the motion of an emitted scene with that of the same scene at run time, with these parameters.
#[track_caller]
pub fn same<const V: usize, S>(
    of: Named,
    scene: &S,
    set: &[(&str, f64)],
    q: Coordinates<S>,
    rates: impl Into<Inputs<S>>,
    times: [f64; 2],
) -> Vec<String>
where
    S: Scene<Scalar = f64, V = D<V>, Mechanism: Kinematic<Scalar = f64, Name = &'static str, V = D<V>>>,
{
    let compiled = of.compiled();
    let (mut design, mut own) = (compiled.design(), Vec::new());
    for &(name, value) in set {
        match design.clone().with(name, value) {
            Ok(changed) => design = changed,
            Err(_) => own.push((name, value)),
        }
    }
    let at_run_time = design.scene(of.scene).expect("the scene");
    let at_run_time =
        own.into_iter().fold(at_run_time, |scene, (name, value)| scene.with(name, value).expect("a parameter"));
    let prepared = at_run_time.prepared().expect("a scene within the capacities");
    let here = prepared.with_inputs::<D<V>>().expect("as many inputs");
    let rates = rates.into();
    let (unknowns, inputs) = S::Mechanism::parts(&q);
    let numbers: Numbers = [unknowns.as_slice().to_vec(), inputs.as_slice().to_vec()];
    let of_rates: PerInput<S::Mechanism> = rates.into();
    let run_here = Run {
        q: coordinates::<linkage_interpreter::AtRunTime<'_, D<V>>>(&numbers),
        rates: of_rates,
        times,
        tolerance: 1e-8,
    };
    let (emitted, found) = (all(scene, Run { q, rates, times, tolerance: 1e-8 }), all(&here, run_here));
    for (emitted, found) in emitted.iter().zip(&found) {
        assert_eq!(emitted, found, "{}", of.scene);
    }
    assert_eq!(emitted.len(), found.len());
    assert_eq!(prepared.failure(), None);
    found
}

/// The loads of a turn at a constant rate, as a table.
fn loads_of_a_turn<S>(scene: &S, branch: <S::Mechanism as Mechanism>::Branch) -> String
where
    S: Scene<Scalar = f64, Mechanism: Kinematic + Driven<Of = <S as Scene>::Mechanism> + Assembly>,
{
    words(Table::turn_with_loads(scene, branch, 24, 3.0), |table| table.to_json())
}

/// Compares the loads of turns of a scene, and the errors of a rod that is shorter than the crank, which has no full turn.
pub fn same_loads_of_turns<S: Scene<Scalar = f64, Mechanism = Machine>>(name: &'static str, of: impl Fn(Machine) -> S) {
    let compiled = Named::of("slider_crank_contacts", "Machine", name).compiled();
    for l in [Machine::<f64>::default().l, 0.9 * Machine::<f64>::default().r] {
        let machine = Machine { l, ..Machine::default() };
        let scene = compiled.design().with("l", l).unwrap().scene(name).unwrap();
        let prepared = scene.prepared().unwrap();
        let here = prepared.with_inputs::<D<1>>().unwrap();
        let branch = MachineBranch::new(linkage::Slider::Far);
        let q = machine.assemble(0.3, branch).unwrap().coordinates();
        let (unknowns, inputs) = Machine::parts(&q);
        let numbers = [unknowns.as_slice().to_vec(), inputs.as_slice().to_vec()];
        let q = coordinates::<linkage_interpreter::AtRunTime<'_, D<1>>>(&numbers);
        let of_value = here.mechanism().branch_of(&here.mechanism().pose_at(&q));
        let (emitted, found) = (loads_of_a_turn(&of(machine), branch), loads_of_a_turn(&here, of_value));
        assert!(emitted.contains("phi_torque"), "{emitted}");
        assert_eq!(emitted, found);
    }
}

/// True if a text, such as the error of a motion, has these words.
pub fn says(found: &[String], words: &str) -> bool {
    found.iter().any(|text| text.contains(words))
}

#[test]
fn open_chains() {
    use cart_pendulum::{CartPendulumCoordinates, CartPendulumInputs, Shaken};
    let q = CartPendulumCoordinates { x: 0.0, phi: 0.5 };
    let rates = CartPendulumInputs { x: 0.9, phi: -1.0 };
    let found =
        same(Named::of("cart_pendulum", "CartPendulum", "Shaken"), &Shaken::default(), &[], q, rates, [0.0, 1.0]);
    assert!(found[0] == "Shaken" && found.len() > 40, "{}", found.len());
}

/// The slider drives the crank: other coordinates at its dead points, or an end there.
#[test]
fn dead_points() {
    use slider_crank_scenes::{MachineCoordinates, Pushed, Turning};
    let q = MachineCoordinates { phi: 1.0, psi: -0.2, z: 0.2 };
    let of = Named::of("slider_crank_scenes", "Piston", "Pushed");
    let found = same(of, &Pushed { c: 0.01, ..Pushed::default() }, &[("c", 0.01)], q, -1.5, [0.0, 0.5]);
    assert!(says(&found, "Piston is in a singular configuration"), "{found:?}");
    assert!(says(&found, "exchanges: 2"), "{found:?}");
    let of = Named::of("slider_crank_scenes", "Crank", "Turning");
    let massless = Turning { m2: 0.0, j2: 0.0, m3: 0.0, j3: 0.0, m4: 0.0, ..Turning::default() };
    let set = [("m2", 0.0), ("j2", 0.0), ("m3", 0.0), ("j3", 0.0), ("m4", 0.0)];
    let found = same(of, &massless, &set, q, 20.0, [0.0, 1.0]);
    assert!(says(&found, "the mass matrix of Turning is singular in phi"), "{found:?}");
    let negative = Turning { m4: -1.0, ..Turning::default() };
    assert!(says(&same(of, &negative, &[("m4", -1.0)], q, 20.0, [0.0, 0.2]), "of Turning is -1"));
    let infinite = Turning { c: f64::INFINITY, ..Turning::default() };
    assert!(says(&same(of, &infinite, &[("c", f64::INFINITY)], q, 20.0, [0.0, 0.2]), "of Turning is not a finite"));
}

#[test]
fn frictions_and_stops() {
    use four_bar_effects::{Everything, FourBarCoordinates};
    let of = Named::of("four_bar_effects", "FourBar", "Everything");
    let q = FourBarCoordinates { theta2: 0.3, theta3: 1.2, theta4: -1.0 };
    let found = same(of, &Everything::default(), &[], q, 12.0, [0.0, 0.8]);
    assert!(says(&found, "(\"stop on theta4\", Impact)"));
    assert!(says(&found, "Everything has a friction on theta4 and cannot be simulated backwards"));
    let beyond = Everything { upper: -1.5, ..Everything::default() };
    assert!(says(&same(of, &beyond, &[("upper", -1.5)], q, 12.0, [0.0, 1.5]), "stop on theta4"));

    use slider_crank_contacts::{Guided, MachineCoordinates};
    let of = Named::of("slider_crank_contacts", "Machine", "Guided");
    let q = MachineCoordinates { phi: 0.8, psi: 2.9, z: 0.4 };
    let found = same(of, &Guided::default(), &[], q, -4.0, [0.0, 1.5]);
    assert!(says(&found, "(\"friction on z\", Slips)"));
}

/// Drives, frictions, energies and forces in joints over a turn, and inputs without a position.
#[test]
fn loads_of_turns() {
    same_loads_of_turns("Guided", |mechanism| slider_crank_contacts::Guided { mechanism, ..Default::default() });
}

#[test]
fn frictions_by_reactions() {
    use slider_crank_scenes::{MachineCoordinates, Worn};
    let of = Named::of("slider_crank_scenes", "Crank", "Worn");
    let q = MachineCoordinates { phi: 1.0, psi: -0.2, z: 0.2 };
    same(of, &Worn::default(), &[], q, 20.0, [0.0, 0.5]);
    // So much friction that there is no motion, or that there are several.
    let found = same(of, &Worn { mu: 40.0, ..Worn::default() }, &[("mu", 40.0)], q, 20.0, [0.0, 0.5]);
    assert!(says(&found, "of Worn"), "{found:?}");
}

#[test]
fn kinks_of_laws() {
    let q = BentCoordinates { x: 1.0, y: 0.1 };
    let rates = BentInputs { x: -1.0, y: 1.0 };
    let found = same(Named::of("", "Bent", "Turned"), &Turned::default(), &[], q, rates, [0.0, 2.0]);
    assert!(says(&found, "Some(\"drive x\")"));
}

#[test]
fn change_points() {
    let of = Named::of("", "Cranks", "Stopped");
    let q = |th: f64| CranksCoordinates { th, ph: 0.0, ps: th };
    same(of, &Stopped::default(), &[], q(0.3), 2.0, [0.0, 2.0]);
    let found = same(of, &Stopped::default(), &[], q(0.0), 2.0, [0.0, 2.0]);
    assert!(says(&found, "motions of Stopped cross here, where group ph, ps"), "{found:?}");
}
