//! Dry friction and stops of linkages: in two choices of inputs, and against the same motion of clamped or smooth
//! scenes.

use linkage::contact::Change;
use linkage::simulation::{Start, State, simulate};
use linkage::{Mode, linkage};

use linkage_oracle::close;

use linkage_gallery::five_bar_contacts::*;

linkage! {
    /// An engine with friction, that crank or piston may drive.
    #[derive(Debug, Clone)]
    mechanism Motor {
        param r = 0.05, l = 0.18, m2 = 0.8, j2 = 1.2e-2, m3 = 0.6, j3 = 2e-3, m4 = 0.9, g = 9.81, pull = 1.5;
        param ring = 6, bearing = 0.4, far = 0.2, e = 1;
        coordinate phi, psi, z;
        loop r@phi + l@psi = (z, 0);
        drive Shaft by phi;
        drive Piston by z;
        output swing = phi - psi;
        body crank { mass m2; center (r/4)@phi; inertia j2; angle phi; }
        body rod { mass m3; inertia j3; center r@phi + (l/3)@psi; angle psi; }
        body piston { mass m4; center (z, 0); }
        scene Turned of Shaft {
            inertia; gravity (0, -g); torque pull * cos(t) on phi;
            friction ring, 1 on z; friction bearing, 1 on swing;
        }
        scene Thrust of Piston {
            inertia; gravity (0, -g); torque pull * cos(t) on phi;
            friction ring, 1 on z; friction bearing, 1 on swing;
        }
        scene Knocking of Shaft { inertia; gravity (0, -g); stop swing in far..9, restitution e; }
        scene Knocked of Piston { inertia; gravity (0, -g); stop swing in far..9, restitution e; }
    }
}

type Happened = Vec<(f64, &'static str, Change)>;

/// Runs to the end, with all changes.
macro_rules! run {
    ($motion:expr) => {{
        let mut happened = Happened::new();
        for state in $motion.by_ref() {
            let state = state.unwrap();
            happened.extend(state.changes().map(|(name, change)| (state.t, name, change)));
        }
        happened
    }};
}

/// Compares changes; those at one time may come in any order.
fn agree(some: &Happened, others: &Happened, tolerance: f64) {
    let sorted = |all: &Happened| {
        let mut all = all.clone();
        all.sort_by(|a, b| if (a.0 - b.0).abs() <= tolerance { a.1.cmp(b.1) } else { a.0.total_cmp(&b.0) });
        all
    };
    let (some, others) = (sorted(some), sorted(others));
    assert_eq!(some.len(), others.len(), "{some:?} {others:?}");
    for (a, b) in some.iter().zip(&others) {
        assert_eq!((a.1, a.2), (b.1, b.2), "{some:?} {others:?}");
        close("time", a.0, b.0, tolerance);
    }
}

fn motor(phi: f64) -> MotorCoordinates<f64> {
    Turned::default().mechanism.solve(&MotorCoordinates { phi, psi: -0.25, z: 0.19 }).unwrap().coordinates
}

/// The friction of the piston reverses in its dead points, and there it does not drive the crank.
#[test]
fn friction_in_the_dead_points() {
    let (shaft, piston) = (Turned::default(), Thrust::default());
    for speed in [20.0, -20.0] {
        let mut one = simulate(&shaft, Start { t: 0.0, q: motor(1.2), input_rates: speed }, 3.0, 1e-14).unwrap();
        let rate = one.state().rates.z;
        let mut other = simulate(&piston, Start { t: 0.0, q: motor(1.2), input_rates: rate }, 3.0, 1e-14).unwrap();
        let (some, others) = (run!(one), run!(other));
        agree(&some, &others, 1e-9);
        let (a, b) = (one.state(), other.state());
        close("phi", a.q.phi, b.q.phi, 1e-9);
        close("phi'", a.rates.phi, b.rates.phi, 1e-8);
        println!("{} {:?} {:?} {:e}", some.len(), other.counts(), other.passages(), a.q.phi - b.q.phi);
        let dead: Vec<_> = some.iter().filter(|(_, name, _)| *name == "friction on z").collect();
        assert!(dead.len() > 20 && dead.iter().all(|(.., change)| *change == Change::Slips), "{dead:?}");
        assert!(other.passages().exchanges > 30 && one.passages().exchanges == 0);
    }
}

/// An elastic stop reverses the motion: it returns the way it came, over the dead points too.
#[test]
fn a_stop_on_an_output_turns_the_motion_round() {
    let (shaft, piston) = (Knocking::default(), Knocked::default());
    let q = motor(4.5);
    let start = simulate(&shaft, Start { t: 0.0, q, input_rates: -14.0 }, 1.0, 1e-13).unwrap().state().rates;
    let mut by_shaft = simulate(&shaft, Start { t: 0.0, q, input_rates: start.phi }, 1.0, 1e-13).unwrap();
    let mut by_piston = simulate(&piston, Start { t: 0.0, q, input_rates: start.z }, 1.0, 1e-13).unwrap();
    let (some, others) = (run!(by_shaft), run!(by_piston));
    agree(&some, &others, 1e-10);
    let (t, name, change) = some[0];
    assert_eq!((name, change), ("stop on swing", Change::Impact));
    println!("{some:?} {:?} {:?}", by_piston.passages(), by_piston.counts());
    let mut piston = simulate(&piston, Start { t: 0.0, q, input_rates: start.z }, 2.0 * t, 1e-13).unwrap();
    let there: Vec<_> = piston.at([0.25 * t, 0.75 * t, 1.25 * t, 1.75 * t, 2.0 * t]).map(Result::unwrap).collect();
    for (before, after) in [(there[0], there[3]), (there[1], there[2])] {
        close("phi", before.q.phi, after.q.phi, 1e-10);
        close("phi'", before.rates.phi, -after.rates.phi, 1e-9);
    }
    close("phi", there[4].q.phi, q.phi, 1e-10);
    close("z'", there[4].rates.z, -start.z, 1e-9);
    assert!(piston.passages().exchanges >= 4, "{:?}", piston.passages());
}

fn pair(theta1: f64, theta4: f64) -> PairCoordinates<f64> {
    PairCoordinates { theta2: 0.4, theta3: 1.9, theta1, theta4 }
}

/// One crank is held by its friction while the other slips, turns round and slips back: the motion with a clamped
/// crank.
#[test]
fn one_crank_sticks_while_the_other_slips() {
    let (scene, clamped) = (Braked::default(), Clamped { place: 1.1, ..Clamped::default() });
    let rates = PairInputs { theta1: 0.0, theta4: 0.4 };
    let mut motion = simulate(&scene, Start { t: 0.0, q: pair(1.1, 1.4), input_rates: rates }, 0.6, 1e-13).unwrap();
    let happened = run!(motion);
    let [(turn, "friction on theta4", Change::Slips)] = happened[..] else { panic!("{happened:?}") };
    let mut forth = simulate(&clamped, Start { t: 0.0, q: pair(1.1, 1.4), input_rates: rates }, turn, 1e-13).unwrap();
    forth.finish(|_, _| true).unwrap();
    let State { q, rates, .. } = *forth.state();
    close("turn", rates.theta4, 0.0, 1e-12);
    let back = Clamped { sign: -1.0, ..clamped.clone() };
    let mut back = simulate(
        &back,
        Start { t: turn, q, input_rates: PairInputs { theta1: 0.0, theta4: rates.theta4 } },
        0.6,
        1e-13,
    )
    .unwrap();
    back.finish(|_, _| true).unwrap();
    let (found, expected) = (motion.state(), back.state());
    close("theta4", found.q.theta4, expected.q.theta4, 1e-11);
    close("theta4'", found.rates.theta4, expected.rates.theta4, 1e-11);
    assert_eq!((found.q.theta1, found.rates.theta1), (1.1, 0.0));
    assert_eq!(found.mode("friction on theta1"), Some(Mode::Stick));
}

linkage! {
    /// A five-bar whose motor drives one crank; the other input is the other crank or an arm.
    #[derive(Debug, Clone)]
    mechanism Chain {
        param a = 0.7, b = 1.6, c = 1.5, d = 0.8, e = 1.7, hold = 2, near = 0.25, far = 1.3;
        param begin = 0.3, sway = 0.05, quick = 20, grip = 0.2;
        coordinate theta1, theta2, theta3, theta4;
        loop a@theta1 + b@theta2 = e@0 + d@theta4 + c@theta3;
        drive Cranks by theta1, theta4;
        drive Arm by theta1, theta2;
        output bend = theta3 - theta2;
        body arm { mass 2; inertia 0.9; center a@theta1 + (b/2)@theta2; angle theta2; }
        body forearm { mass 1.7; inertia 0.7; center e@0 + d@theta4 + (c/2)@theta3; angle theta3; }
        body right { mass 0.9; inertia 0.1; center e@0 + (d/2)@theta4; angle theta4; }
        scene Straight of Cranks {
            inertia; drive theta1 = begin + sway * sin(quick * t); friction hold, 1 on theta4; friction grip, 1 on theta2;
            friction grip, 1 on theta3; stop bend in 3.0..3.13, restitution 0.5;
        }
        scene Nearly of Arm {
            inertia; drive theta1 = begin + sway * sin(quick * t); friction hold, 1 on theta4; friction grip, 1 on theta2;
            friction grip, 1 on theta3; stop bend in 3.0..3.13, restitution 0.5;
        }
        scene OnCranks of Cranks {
            inertia; drive theta1 = 0.3 + 2 * t; friction hold, 1 on theta4; stop bend in near..far, restitution 0.5;
        }
        scene OnArm of Arm {
            inertia; drive theta1 = 0.3 + 2 * t; friction hold, 1 on theta4; stop bend in near..far, restitution 0.5;
        }
    }
}

/// A motor that follows its law, with a crank that sticks and slips and arms that hit their stop, through positions in
/// which one or the other choice of inputs is singular.
#[test]
fn a_motor_through_singular_inputs() {
    let (cranks, arm) = (OnCranks::default(), OnArm::default());
    let q = ChainCoordinates { theta1: 0.3, theta2: 0.8, theta3: 2.0, theta4: 0.9 };
    let q = cranks.mechanism.solve(&q).unwrap().coordinates;
    let rates = CranksInputs { theta1: 2.0, theta4: 0.0 };
    let mut one = simulate(&cranks, Start { t: 0.0, q, input_rates: rates }, 6.0, 1e-13).unwrap();
    let start = one.state().rates;
    let mut other =
        simulate(&arm, Start { t: 0.0, q, input_rates: ArmInputs { theta1: 2.0, theta2: start.theta2 } }, 6.0, 1e-13)
            .unwrap();
    let (some, others) = (run!(one), run!(other));
    println!(
        "{some:?}\n{others:?}\n{:?} {:?} {:?} {:?}",
        one.passages(),
        other.passages(),
        one.counts(),
        other.counts()
    );
    agree(&some, &others, 1e-8);
    for change in [Change::Sticks, Change::Slips, Change::Impact] {
        assert!(some.iter().any(|(.., what)| *what == change), "{change:?}");
    }
    close("theta4", one.state().q.theta4, other.state().q.theta4, 1e-8);
    // A coordinate that sticks is at rest, to rounding error, also if it is no input, and between the ends of steps
    // too.
    let mut other =
        simulate(&arm, Start { t: 0.0, q, input_rates: ArmInputs { theta1: 2.0, theta2: start.theta2 } }, 6.0, 1e-13)
            .unwrap();
    let mut stuck = 0;
    for state in other.at((0..6000).map(|i| 0.001 * f64::from(i))).map(Result::unwrap) {
        if state.contacts[0].mode == Mode::Stick {
            stuck += 1;
            assert!(state.rates.theta4.abs() < 4e-15, "{}: {:e}", state.t, state.rates.theta4);
        }
    }
    assert!(stuck > 100);
    other.finish(|_, _| true).unwrap();
    let (a, b) = (one.loads().unwrap(), other.loads().unwrap());
    println!("{a:?} {b:?}");
    assert!(a.drives.theta1.abs() > 0.1 && a.contacts[0].abs() > 0.1);
    close("motor", b.drives.theta1, a.drives.theta1, 1e-6);
    close("power", a.drive_power, 2.0 * a.drives.theta1, 1e-14);
    close("law", other.state().q.theta1, 12.3, 1e-14);
}

/// The arms stay so near to a line that the cranks are never good inputs.
#[test]
fn a_motor_near_a_singular_position() {
    let mut seen = Happened::new();
    for grip in [0.2, 20.0] {
        let begin = 2.943;
        let cranks = Straight { begin, grip, ..Straight::default() };
        let arm = Nearly { begin, grip, ..Nearly::default() };
        let q = ChainCoordinates { theta1: begin, theta2: 0.1, theta3: 3.17, theta4: 0.5 };
        let q = cranks.mechanism.solve(&q).unwrap().coordinates;
        let mut one =
            simulate(&cranks, Start { t: 0.0, q, input_rates: CranksInputs { theta1: 1.0, theta4: 0.3 } }, 0.8, 1e-13)
                .unwrap();
        let start = one.state().rates;
        let mut other = simulate(
            &arm,
            Start { t: 0.0, q, input_rates: ArmInputs { theta1: 1.0, theta2: start.theta2 } },
            0.8,
            1e-13,
        )
        .unwrap();
        let (some, others) = (run!(one), run!(other));
        agree(&some, &others, 1e-10);
        close("theta4", one.state().q.theta4, other.state().q.theta4, 1e-10);
        let (a, b) = (one.loads().unwrap(), other.loads().unwrap());
        close("motor", a.drives.theta1, b.drives.theta1, 1e-8);
        close("on theta3", a.contacts[2], b.contacts[2], 1e-8);
        close("power", a.drive_power, a.drives.theta1 * one.state().rates.theta1, 1e-12);
        assert_eq!(one.passages().exchanges, 1);
        seen.extend(some);
    }
    for change in [Change::Sticks, Change::Slips, Change::Impact] {
        assert!(seen.iter().any(|(.., what)| *what == change), "{change:?} {seen:?}");
    }
}
