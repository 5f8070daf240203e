//! Tables: each number against the function that computes it alone, the text read back, columns by name.

use std::f64::consts::TAU;

use linkage::range_of_motion::{RangeOfMotion, RangeOptions};
use linkage::simulation::{Start, Then, simulate};
use linkage::table::{Cause, TableError, Units};
use linkage::{Elbow, MotionError, PathError, Real, Scene, Table, linkage};
use linkage_oracle::close;
use serde_json::Value;

linkage! {
    /// A windscreen wiper: a crank swings an arm with a blade.
    #[derive(Debug, Clone)]
    pub mechanism Wiper {
        param crank = 0.04, link = 0.1485, arm = 0.05, base = 0.1515, blade = 0.45;
        param m = 0.1, j = 0.03, g = 9.81, drag = 5, mu = 0.15, radius = 0.006, w = 5;
        input theta;
        unknown phi, psi;
        loop crank@theta + link@phi = base@0 + arm@psi;
        point O = (0, 0);
        point A = crank@theta;
        point Tip = (base, 0) + blade@psi;
        output swing = psi - phi;
        body motor { inertia 1e-4; angle theta; }
        body rod { mass m; inertia 2e-4; center A + (link / 2)@phi; angle phi; }
        body wiper { mass 2 * m; inertia j; center (base, 0) + (blade / 2)@psi; angle psi; }
        /// A motor that another force turns.
        scene Wiping {
            inertia;
            gravity (0, -g);
            friction drag on psi;
            friction mu, radius, reaction on theta;
            reaction at A;
            reaction at O;
        }
        /// A drive turns the motor.
        scene Turned {
            inertia;
            gravity (0, -g);
            friction drag on psi;
            friction mu, radius, reaction on theta;
            drive theta = w * t;
            reaction at A;
            reaction at O;
        }
        scene Free {
            inertia;
            gravity (0, -g);
            friction drag / 100 on psi;
            torque 0.4 on theta;
            energy;
        }
    }
}

const BRANCH: WiperBranch = WiperBranch::new(Elbow::Left);
const STEPS: u32 = 72;
/// rad/s
const RATE: f64 = 5.0;

fn columns<const N: usize>(table: &Table, names: [&str; N]) -> [Vec<f64>; N] {
    names.map(|name| table.column(name).unwrap_or_else(|| panic!("{name} of {:?}", table.names())).to_vec())
}

fn loads() -> Table {
    Table::turn_with_loads(&Wiping::default(), BRANCH, STEPS, RATE).unwrap()
}

/// The loads of a motion are those that the emitted functions return for a scene with a drive of the same motion.
#[test]
fn loads_are_those_of_a_drive() {
    let (table, driven) = (loads(), Turned::default());
    assert_eq!((table.len(), table.missing().len()), (73, 0));
    let [theta, time, psi, torque, power] = columns(&table, ["theta", "time", "psi", "theta_torque", "drive_power"]);
    let [drag, bearing] = columns(&table, ["friction on psi", "friction on theta"]);
    let [x, y, whole] = columns(&table, ["a_on_rod_x", "a_on_rod_y", "a_on_rod"]);
    for row in 0..table.len() {
        let q = driven.mechanism.assemble(theta[row], BRANCH).unwrap().coordinates();
        assert!((q.psi - psi[row]).abs() < 1e-14);
        assert_eq!(time[row], theta[row] / RATE);
        let t = time[row];
        let forces = driven.drive_forces(t, &q, RATE).unwrap();
        let joints = driven.reactions(t, &q, RATE).unwrap();
        let scale = joints.a_on_rod.norm();
        close("torque", torque[row], forces.theta, 1e-12 * scale * driven.mechanism.crank);
        close("power", power[row], forces.theta * RATE, 1e-12 * scale);
        for (found, expected) in [(x[row], joints.a_on_rod.x), (y[row], joints.a_on_rod.y), (whole[row], scale)] {
            close("pin", found, expected, 1e-12 * scale);
        }
        let rates = driven.mechanism.motion(&q, RATE, 0.0).unwrap().rates;
        assert_eq!(drag[row], -driven.drag * rates.psi.signum());
        // The journal bearing: mu r |R|, against the motion.
        let journal = joints.o_on_motor.norm() * driven.mu * driven.radius;
        close("bearing", bearing[row], -journal, 1e-12 * journal);
    }
}

/// Over a turn the motor does the work that the frictions take; between, by the table alone.
#[test]
fn the_motor_does_the_work_of_friction() {
    let table = Table::turn_with_loads(&Wiping::default(), BRANCH, 3600, RATE).unwrap();
    let [torque, drag, bearing, psi] =
        columns(&table, ["theta_torque", "friction on psi", "friction on theta", "psi_rate"]);
    let sum = |of: &dyn Fn(usize) -> f64| (0..3600).map(of).sum::<f64>() * TAU / 3600.0;
    let (work, lost) = (sum(&|row| torque[row]), sum(&|row| -drag[row] * psi[row] / RATE - bearing[row]));
    // The torque jumps where the blade reverses: the sums are of first order there.
    close("work", work, lost, 1e-4 * lost);
    assert!(lost > 1.0);
    // Without friction none is done.
    let smooth = Wiping { mu: 0.0, drag: 0.0, ..Wiping::default() };
    let table = Table::turn_with_loads(&smooth, BRANCH, 3600, RATE).unwrap();
    let [torque] = columns(&table, ["theta_torque"]);
    let most = torque.iter().fold(0.0_f64, |most, torque| most.max(torque.abs()));
    assert!(torque[1..].iter().sum::<f64>().abs() < 1e-9 * 3600.0 * most && most > 0.1);
}

/// A motion that ends at a dead point has its loads as far as it goes, and no row is lost.
#[test]
fn a_motion_that_ends_early() {
    let m = Wiper { crank: 0.06, arm: 0.05, ..Wiper::default() };
    let scene = Wiping { mechanism: m, ..Wiping::default() };
    let table = Table::turn_with_loads(&scene, BRANCH, STEPS, RATE).unwrap();
    let (missing, ends) = (table.missing(), table.marks());
    assert_eq!(table.len(), 73);
    assert!(missing.len() > 10 && missing.len() < 60, "{}", missing.len());
    assert!(ends.iter().any(|mark| mark.name == "dead point" && mark.column == "theta"), "{ends:?}");
    let [theta, time, psi, torque] = columns(&table, ["theta", "time", "psi", "theta_torque"]);
    let is_missing = |row: &usize| missing.iter().any(|missing| missing.row == *row);
    for row in 0..table.len() {
        assert!(theta[row].is_finite() && time[row].is_finite());
        assert_eq!([psi[row].is_nan(), torque[row].is_nan()], [is_missing(&row); 2], "{row}");
    }
    assert!(missing.iter().all(|missing| matches!(missing.cause, Cause::Path(_))));
    let json: Value = serde_json::from_str(&table.to_json()).unwrap();
    let first = missing[0].row;
    assert!(json["columns"][2]["values"][first].is_null() && json["columns"][0]["values"][first].is_number());
    assert_eq!(json["missing"][0]["row"], first);
    assert_eq!(json["missing"][0]["cause"], missing[0].cause.to_string());
}

/// The loads of a motion along a path of two inputs: the torques of both motors, against M v'' - Q.
#[test]
fn two_motors() {
    use linkage::continuation::{Along, Line};

    linkage! {
        #[derive(Debug, Clone)]
        pub mechanism Arm {
            param a = 0.4, b = 0.3, m = 2, g = 9.81;
            input shoulder, elbow;
            point Hand = a@shoulder + b@elbow;
            body hand { mass m; center Hand; }
            scene Held { inertia; gravity (0, -g); damper 0.5 on shoulder; }
        }
    }
    let scene = Held::default();
    let scale = scene.m * scene.g;
    // Along a curve the inputs accelerate: M v'' - Q.
    let curve = |s: f64| {
        let at = |shoulder, elbow| ArmInputs { shoulder, elbow };
        [at(0.2 + s, 0.9 - s * s), at(1.0, -2.0 * s), at(0.0, -2.0)]
    };
    let along = Along { mechanism: scene.mechanism.clone(), inputs: curve };
    let range = RangeOfMotion::on_branch(&along, ArmBranch::default(), [0.0], RangeOptions::default()).unwrap();
    let table = Table::over_with_loads(&scene, &range, [0.1, 0.4, 0.9], 3.0);
    assert_eq!(table.missing(), []);
    let [s, at_shoulder, at_elbow] = columns(&table, [table.names()[0], "shoulder_torque", "elbow_torque"]);
    for row in 0..3 {
        let [at, slope, bend] = curve(s[row]);
        let q = ArmCoordinates { shoulder: at.shoulder, elbow: at.elbow };
        let rates = ArmInputs { shoulder: slope.shoulder * 3.0, elbow: slope.elbow * 3.0 };
        let accelerations = [bend.shoulder * 9.0, bend.elbow * 9.0];
        let (mass, forces) = (scene.mass_matrix(&q).unwrap(), scene.forces(0.0, &q, rates).unwrap());
        for (input, found) in [at_shoulder[row], at_elbow[row]].into_iter().enumerate() {
            let inertia = mass[(input, 0)] * accelerations[0] + mass[(input, 1)] * accelerations[1];
            close("torque", found, inertia - forces[input], 1e-13 * scale);
        }
    }
    let (from, to) = (ArmInputs { shoulder: 0.2, elbow: 0.9 }, ArmInputs { shoulder: 1.1, elbow: 0.1 });
    let along = Along { mechanism: scene.mechanism.clone(), inputs: Line { from, to } };
    let start = RangeOfMotion::on_branch(&along, ArmBranch::default(), [0.0], RangeOptions::default()).unwrap();
    let table = Table::over_with_loads(&scene, &start, (0..=8).map(|step| f64::from(step) / 8.0), 2.0);
    assert_eq!(table.missing(), []);
    let [shoulder, elbow] = columns(&table, ["shoulder", "elbow"]);
    let [at_shoulder, at_elbow, power] = columns(&table, ["shoulder_torque", "elbow_torque", "drive_power"]);
    let rates = ArmInputs { shoulder: 0.9 * 2.0, elbow: -0.8 * 2.0 };
    for row in 0..table.len() {
        let q = ArmCoordinates { shoulder: shoulder[row], elbow: elbow[row] };
        let forces = scene.forces(0.0, &q, rates).unwrap();
        // At constant rates M v'' is zero, and the forces include those of inertia.
        for (found, expected) in [(at_shoulder[row], -forces[0]), (at_elbow[row], -forces[1])] {
            close("torque", found, expected, 1e-13 * scale);
        }
        close("power", power[row], -forces[0] * rates.shoulder - forces[1] * rates.elbow, 1e-12 * scale);
    }
}

/// The rows of a simulation are those of its states with their loads, and its accelerations those of the mechanism.
#[test]
fn a_simulation_by_rows() {
    let scene = Turned::default();
    let q = scene.mechanism.assemble(0.0, BRANCH).unwrap().coordinates();
    let start = || Start { t: 0.0, q, input_rates: RATE };
    let times = || (0..=120).map(|step| f64::from(step) / 100.0);
    let table = Table::simulated_at(&mut simulate(&scene, start(), 1.2, 1e-9).unwrap(), times());
    assert_eq!(
        (table.len(), table.names()[..5].to_vec()),
        (121, vec!["time", "theta", "theta_rate", "theta_acceleration", "phi"])
    );
    let names = [
        "time",
        "psi",
        "psi_rate",
        "psi_acceleration",
        "Tip_velocity_y",
        "Tip_speed",
        "Tip_acceleration_x",
        "swing_rate",
        "swing_acceleration",
    ];
    let [time, psi, rate, acceleration, velocity, speed, second, swing, swing_acceleration] = columns(&table, names);
    let [torque, pin, drag] = columns(&table, ["theta_torque", "a_on_rod", "friction on psi"]);
    let mut simulation = simulate(&scene, start(), 1.2, 1e-9).unwrap();
    for (row, state) in simulation.at(times()).with_loads().enumerate() {
        let (state, loads) = state.unwrap();
        assert_eq!([time[row], psi[row], rate[row]], [state.t, state.q.psi, state.rates.psi]);
        assert_eq!([torque[row], drag[row]], [loads.drives.theta, loads.contacts[0]]);
        let force = loads.joints.a_on_rod;
        assert_eq!(pin[row], Real::hypotenuse(force.x, force.y));
        close("pin", pin[row], force.x.hypot(force.y), 2.0 * f64::EPSILON * pin[row]);
        let motion = scene.mechanism.motion(&state.q, state.rates.theta, 0.0).unwrap();
        let scale = motion.accelerations.psi.abs() + RATE * RATE;
        close("psi''", acceleration[row], motion.accelerations.psi, 1e-11 * scale);
        close("velocity", velocity[row], motion.points.tip.velocity.y, 1e-12 * RATE);
        close("speed", speed[row], motion.points.tip.velocity.norm(), 1e-12 * RATE);
        close("acceleration", second[row], motion.points.tip.acceleration.x, 1e-11 * scale);
        close("rate", swing[row], motion.rates.psi - motion.rates.phi, 1e-12 * RATE);
        let expected = motion.accelerations.psi - motion.accelerations.phi;
        close("swing''", swing_acceleration[row], expected, 1e-11 * scale);
    }
    // The blade reverses twice in a turn, its friction with it.
    let slips = table.marks().iter().filter(|mark| mark.name == "friction on psi slips").map(|mark| mark.at);
    let slips: Vec<f64> = slips.collect();
    assert_eq!(slips.len(), 2, "{:?}", table.marks());
    for at in slips {
        let row = time.iter().position(|t| *t > at).unwrap();
        assert!(rate[row - 1] * rate[row] <= 0.0);
    }
}

/// The steps of a simulation are rows as they are, and those at events too.
#[test]
fn a_simulation_by_steps() {
    let scene = Free::default();
    let q = scene.mechanism.assemble(0.6, BRANCH).unwrap().coordinates();
    let start = || Start { t: 0.0, q, input_rates: 0.5 };
    let table = Table::simulated(&mut simulate(&scene, start(), 1.0, 1e-8).unwrap());
    let states: Vec<_> = simulate(&scene, start(), 1.0, 1e-8).unwrap().map(Result::unwrap).collect();
    assert_eq!(table.len(), states.len() + 1);
    let [time, theta] = columns(&table, ["time", "theta"]);
    assert_eq!(time[1..], states.iter().map(|state| state.t).collect::<Vec<_>>());
    assert_eq!(theta[1..], states.iter().map(|state| state.q.theta).collect::<Vec<_>>());
    // No input has a drive.
    assert_eq!((table.column("theta_torque"), table.column("drive_power")), (None, None));
    // Its energies, and another number at each state.
    let all = || simulate(&scene, start(), 1.0, 1e-8).unwrap();
    let first = *all().state();
    let energies = [first].into_iter().chain(states).map(|state| scene.energy(&state.q, state.rates.theta).unwrap());
    let energies: Vec<_> = energies.collect();
    let [kinetic, potential] = columns(&table, ["kinetic_energy", "potential_energy"]);
    assert_eq!(kinetic, energies.iter().map(|energy| energy.kinetic).collect::<Vec<_>>());
    assert_eq!(potential, energies.iter().map(|energy| energy.potential).collect::<Vec<_>>());
    let whole = energies.iter().map(|energy| energy.kinetic + energy.potential).collect();
    let table = table.with("energy", whole).unwrap();
    assert_eq!(table.names().last(), Some(&"energy"));
    let twice = table.clone().with("energy", vec![0.0; table.len()]).unwrap_err();
    assert_eq!(twice, TableError::SameName { name: "energy".to_owned() });
    let short = table.with("power", vec![0.0]).unwrap_err();
    assert!(matches!(short, TableError::Length { numbers: 1, .. }), "{short}");
}

/// A simulation that ends before the times: at an event, with an error, at its own end.
#[test]
fn a_simulation_that_ends_early() {
    let scene = Free::default();
    let q = scene.mechanism.assemble(0.6, BRANCH).unwrap().coordinates();
    let start = || Start { t: 0.0, q, input_rates: 0.5 };
    let times = || (0..=10).map(|step| f64::from(step) / 10.0);
    let simulation = simulate(&scene, start(), 1.0, 1e-8).unwrap();
    let mut stopped = simulation
        .events([linkage::integrate::Crossing::Rising], |state| Ok([state.t - 0.45]), |_, _| Ok(Then::Stop))
        .unwrap();
    let table = Table::simulated_at(&mut stopped, times());
    assert_eq!(table.marks().iter().map(|mark| mark.name.as_str()).collect::<Vec<_>>(), ["event 0"]);
    close("the event", table.marks()[0].at, 0.45, 1e-14);
    assert_eq!(table.missing().iter().map(|missing| missing.row).collect::<Vec<_>>(), [5, 6, 7, 8, 9, 10]);
    assert!(table.missing().iter().all(|missing| missing.cause == Cause::Ended));
    // Times beyond the end.
    let table = Table::simulated_at(&mut simulate(&scene, start(), 0.55, 1e-8).unwrap(), times());
    assert_eq!(table.missing().len(), 5);
    assert!(table.missing().iter().all(|missing| matches!(missing.cause, Cause::Motion(MotionError::Input(_)))));
    // An error on the way.
    let few = || simulate(&scene, start(), 1.0, 1e-8).unwrap().most_steps(5);
    let table = Table::simulated(&mut few());
    let [last] = table.missing() else { panic!("{:?}", table.missing()) };
    assert!(last.row == table.len() && matches!(last.cause, Cause::Motion(_)) && table.len() > 3, "{last:?}");
    let table = Table::simulated_at(&mut few(), times());
    assert!(table.missing().iter().any(|missing| missing.cause == last.cause), "{:?}", table.missing());
    assert_eq!(table.len(), 11);
}

#[test]
fn the_speed_of_a_point_is_the_length_of_its_velocity() {
    let table = loads();
    let [x, y, speed] = columns(&table, ["Tip_velocity_x", "Tip_velocity_y", "Tip_speed"]);
    assert!(speed.iter().any(|speed| *speed > 0.0));
    for ((x, y), speed) in x.iter().zip(y).zip(speed) {
        close("speed", speed, x.hypot(y), 4.0 * f64::EPSILON * speed);
    }
}

#[test]
fn columns_by_name_in_any_order() {
    let table = loads();
    let chosen = table.select(["theta_torque", "theta"]).unwrap();
    assert_eq!(chosen.names(), ["theta_torque", "theta"]);
    assert_eq!(chosen.column("theta"), table.column("theta"));
    let error = table.select(["theta", "thta_torque"]).unwrap_err();
    assert_eq!(error.to_string(), "the table has no column `thta_torque`; the nearest name is `theta_torque`");
    let far = table.select(["crank"]).unwrap_err();
    assert_eq!(far.to_string(), "the table has no column `crank`: its `names` lists the columns");
    let none = Table::default().select(["theta"]).unwrap_err();
    assert_eq!(none, TableError::UnknownColumn { name: "theta".to_owned(), nearest: None });
    assert!(table.clone().unit("tip", "mm").is_err() && table.clone().degrees_of(["tip"]).is_err());
    let no_steps = Table::turn_with_loads(&Wiping::default(), BRANCH, 0, RATE).unwrap_err();
    assert!(matches!(no_steps, PathError::NoDirection { .. }), "{no_steps}");
    // Two columns of one name have two names.
    assert_eq!(Table::new(["a", "a", "b", "a"]).names(), ["a", "a_2", "b", "a_3"]);
}

#[test]
fn degrees_and_units() {
    let table = loads();
    let mm = Units { length: "mm", time: "min", force: "kN" };
    let named =
        table.clone().degrees_of(["theta", "swing"]).unwrap().units(mm).unit("friction on psi", "kN mm").unwrap();
    let csv = named.to_csv();
    let heads: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    for head in [
        "theta [deg]",
        "time [min]",
        "psi [rad]",
        "psi_rate [rad/min]",
        "psi_acceleration [rad/min^2]",
        "Tip_x [mm]",
        "Tip_velocity_x [mm/min]",
        "Tip_acceleration_y [mm/min^2]",
        "swing [deg]",
        "swing_rate [deg/min]",
        "theta_torque [kN mm]",
        "drive_power [kN mm/min]",
        "friction on psi [kN mm]",
        "friction on theta",
        "a_on_rod_x [kN]",
        "a_on_rod [kN]",
    ] {
        assert!(heads.contains(&head), "{head} of {heads:?}");
    }
    for name in ["theta", "swing", "swing_rate", "swing_acceleration"] {
        let [found, radians] = [&named, &table].map(|table| table.column(name).unwrap());
        assert!(found.iter().zip(radians).all(|(found, radians)| *found == radians.to_degrees()), "{name}");
    }
    assert_eq!(named.column("psi"), table.column("psi"));
    // All angles, and once only.
    let all = table.clone().degrees();
    let twice = all.clone().degrees().degrees_of(["psi"]).unwrap();
    assert_eq!(twice, all);
    for name in ["theta", "phi", "psi_rate", "psi_acceleration"] {
        let [found, radians] = [&all, &table].map(|table| table.column(name).unwrap());
        assert!(found.iter().zip(radians).all(|(found, radians)| *found == radians.to_degrees()), "{name}");
    }
    assert!(all.to_csv().starts_with("theta [deg],time,phi [deg],phi_rate [deg/s],"));
    // In any order.
    assert_eq!(table.clone().units(mm).degrees(), table.clone().degrees().units(mm));
    assert_eq!(all.column("theta_torque"), table.column("theta_torque"));
    let no_angle = table.degrees_of(["Tip_x"]).unwrap_err();
    assert_eq!(no_angle, TableError::NotAnAngle { name: "Tip_x".to_owned() });
    assert_eq!(no_angle.to_string(), "the column `Tip_x` is no angle: degrees are for angles");
}

/// CSV and JSON read back as the same doubles, and rounded ones as rounded.
#[test]
fn text_reads_back() {
    let names = ["plain", "quoted \"\\\", with\na comma\u{1}"];
    let mut table = Table::new(names);
    let numbers =
        [0.0, 1.0, -2.5, 1e-9, 0.1 + 0.2, 1e300, -5e-324, f64::MAX, 123_456_789.0, 2e16, 1e-5, f64::NAN, f64::INFINITY];
    for number in numbers {
        table.push(&[number, -number]);
    }
    let json: Value = serde_json::from_str(&table.to_json()).unwrap();
    assert_eq!(json["columns"][1]["name"], names[1]);
    let csv = table.to_csv();
    let (head, rows) = csv.split_once("\u{1}\"\n").unwrap();
    assert_eq!(head, "plain,\"quoted \"\"\\\"\", with\na comma");
    for (row, (number, line)) in numbers.iter().zip(rows.lines()).enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        for (cell, (place, number)) in cells.iter().zip([number, &-number].into_iter().enumerate()) {
            let of_json = &json["columns"][place]["values"][row];
            if number.is_finite() {
                assert_eq!(cell.parse::<f64>().unwrap().to_bits(), number.to_bits(), "{cell}");
                assert_eq!(of_json.as_f64().unwrap(), *number);
                assert!(cell.len() < 26, "{cell}");
            } else {
                assert!(cell.is_empty() && of_json.is_null());
            }
        }
    }
    let rounded = loads().digits(4);
    let exact = loads();
    let json: Value = serde_json::from_str(&rounded.to_json()).unwrap();
    for (place, name) in exact.names().iter().enumerate() {
        for (row, number) in exact.column(name).unwrap().iter().enumerate() {
            let found = json["columns"][place]["values"][row].as_f64().unwrap();
            assert!((found - number).abs() <= 0.500_001e-3 * number.abs(), "{found} of {number}");
        }
    }
    assert!(rounded.to_csv().lines().skip(1).flat_map(|line| line.split(',')).all(|cell| cell.len() <= 11));
}

/// The rows of a slider crank, whose output is a length.
#[test]
fn a_force_for_a_length() {
    linkage! {
        #[derive(Debug, Clone)]
        pub mechanism Pusher {
            param r = 0.05, l = 0.15, j = 0.01, m = 0.9, k = 200;
            input z;
            unknown phi, psi;
            loop r@phi + l@psi = (z, 0);
            point A = r@phi;
            body crank { inertia j; angle phi; }
            body piston { mass m; center (z, 0); }
            scene Pushed { inertia; spring k, 0.1 on z; reaction on z; reaction at A; }
        }
    }
    let scene = Pushed::default();
    let start = PusherCoordinates { z: 0.15, phi: 1.0, psi: -0.3 };
    let q = scene.mechanism.solve(&start).unwrap().coordinates;
    let range = RangeOfMotion::of(&scene.mechanism, &q, RangeOptions::default()).unwrap();
    let table = Table::over_with_loads(&scene, &range, [0.14, 0.15, 0.16], 0.0);
    // At rest there is no time, and the force holds the spring.
    assert_eq!(table.column("time"), None);
    let [z, force, normal, moment] = columns(&table, ["z", "z_force", "z_normal", "z_moment"]);
    for row in 0..3 {
        close("force", force[row], scene.k * (z[row] - 0.1), 1e-13 * scene.k);
        let q = range.at(z[row]).unwrap();
        let joints = scene.loads_of_motion(0.0, &q, 0.0, 0.0).unwrap().joints;
        assert_eq!([normal[row], moment[row]], [joints.z_normal, joints.z_moment]);
    }
    let csv = table.select(["z", "z_force", "z_normal", "z_moment"]).unwrap().units(Units::SI).to_csv();
    assert!(csv.starts_with("z [m],z_force [N],z_normal [N],z_moment [N m]\n"), "{csv}");
}
