//! Types with text of the program, such as the names of groups: they can be written, not read.

use std::sync::Arc;

use linkage::continuation::{AtChangePoint, Direction, Options, Path};
use linkage::report::{Report, ReportOptions};
use linkage::simulation::{Start, simulate};
use linkage::skeleton::Skeleton;
use linkage::{Error, InputValues, Mechanism, MotionError, PositionError, Scene, Table, linkage, singularity};
use serde::Deserialize;
use serde_json::{Value, from_value, json, to_value};

use crate::runtime::{PressCoordinates, PressRates, Working};
use crate::{FourBarCoordinates, four_bar};

linkage! {
    mechanism Parallelogram {
        param a = 2, b = 5;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = b@0 + a@psi;
        derive serde, drawing, lanes, limits;
    }
}

/// A start of a simulation, as a user may declare it.
#[derive(Deserialize)]
struct Written {
    t: f64,
    q: PressCoordinates,
    rates: PressRates,
}

#[test]
fn a_simulation_goes_on_from_a_state_that_was_written() {
    let scene = Working::default();
    let start = PressCoordinates { phi: 1.2, psi: 2.9, z: 0.4 };
    let mut motion = simulate(&scene, Start { t: 0.0, q: start, input_rates: 0.0 }, 0.05, 1e-9).unwrap();
    motion.finish(|_, _| true).unwrap();
    let state = to_value(motion.state()).unwrap();
    assert_eq!(state["contacts"][0], json!({ "name": "friction on z", "mode": "SlipBackward", "change": null }));
    let Written { t, q, rates } = from_value(state).unwrap();
    assert_eq!((t, q, rates), (motion.state().t, motion.state().q, motion.state().rates));
    assert!(simulate(&scene, Start { t, q, input_rates: rates.phi }, 0.1, 1e-9).is_ok());
    let contact = to_value(Scene::contacts(&scene, t, &q, &rates).unwrap()).unwrap();
    assert_eq!(contact[1]["law"]["Stop"]["lower"], 0.26);
}

#[test]
fn steps_of_a_path() {
    let m = Parallelogram::default();
    let start = ParallelogramCoordinates { theta: 0.1, phi: 0.0, psi: 0.1 };
    let options = Options { at_change_point: AtChangePoint::Keep, ..Options::default() };
    let mut path = Path::with(&m, &start, Direction::Decreasing, options).unwrap();
    let step = std::iter::repeat_with(|| path.advance().unwrap()).take(100).find(|step| step.event.is_some()).unwrap();
    let written = to_value(step).unwrap();
    assert_eq!(written["length"].as_f64(), Some(step.length));
    let event = &written["event"]["ChangePoint"];
    assert_eq!(event["groups"], json!(["phi, psi"]));
    assert_eq!(
        (event["tangents"]["rates"].as_array().unwrap().len(), &event["tangents"]["is_complete"]),
        (2, &json!(true))
    );
}

#[test]
fn singular_positions() {
    let m = Parallelogram::default();
    let report =
        singularity::report(&m, &m.pose_at(&ParallelogramCoordinates { theta: 0.0, phi: 0.0, psi: 0.0 })).unwrap();
    let written = to_value(report).unwrap();
    assert_eq!((&written["rank"], &written["groups"][0]["name"]), (&json!(1), &json!("phi, psi")));
    assert_eq!(written["free"].as_array().unwrap().len(), report.free().count());
    assert_eq!(written["admissible"].as_array().unwrap().len(), report.admissible().count());
    assert_eq!(written["drivers"].as_array().unwrap().len(), report.drivers().count());

    let (m, branch) = four_bar();
    let accuracy = singularity::accuracy(&m, &m.assemble(0.3, branch).unwrap()).unwrap();
    let written = to_value(accuracy).unwrap();
    assert_eq!(written["attainable"].as_f64(), Some(accuracy.attainable()));
    assert_eq!(written["unknowns"], to_value(accuracy.unknowns()).unwrap());
}

/// A value whose numbers are doubles: 1 is 1.0.
fn in_doubles(value: Value) -> Value {
    match value {
        Value::Number(number) => number.as_f64().into(),
        Value::Array(all) => all.into_iter().map(in_doubles).collect(),
        Value::Object(all) => all.into_iter().map(|(name, value)| (name, in_doubles(value))).collect(),
        other => other,
    }
}

#[test]
fn names_limits_tables_and_errors() {
    let m = Parallelogram::default();
    let branch = m.branch_near(&ParallelogramCoordinates { theta: 0.6, phi: 0.0, psi: 0.6 });
    assert_eq!(
        to_value(m.limits(0.6, branch).unwrap()).unwrap()["lower"],
        to_value(m.limits(0.6, branch).unwrap().lower).unwrap()
    );
    assert_eq!(to_value(Parallelogram::<f64>::GROUPS).unwrap()[0]["name"], "phi, psi");
    assert!(
        to_value(Parallelogram::<f64>::PARTS).unwrap().as_array().unwrap().iter().any(|part| part.get("Bar").is_some())
    );
    let table = Table::turn(&m, branch, 12, 1.0).unwrap();
    let written = to_value(&table).unwrap();
    assert_eq!(
        (&written["columns"][0]["name"], written["columns"][0]["values"].as_array().unwrap().len()),
        (&"theta".into(), 13)
    );
    assert_eq!(in_doubles(written), in_doubles(serde_json::from_str(&table.to_json()).unwrap()));

    let start = ParallelogramCoordinates { theta: 0.6, phi: 0.0, psi: 0.6 };
    let report = Report::of(&m, Parallelogram::DERIVATION, &start, &ReportOptions::default()).unwrap();
    let written = to_value(&report).unwrap();
    assert_eq!(written["mobility"]["chain"]["turning"], 4);
    assert_eq!(written["motion"]["ends"][0]["Closed"]["turns"], 1);
    assert_eq!(written["motion"]["four_bars"][0]["class"], "ChangePoint");
    assert_eq!(written["modes"]["Listed"]["modes"].as_array().unwrap().len(), 2);

    let error: Error =
        four_bar().0.solve(&FourBarCoordinates { theta2: f64::NAN, theta3: 0.0, theta4: 0.0 }).unwrap_err().into();
    let written: Value = to_value(error).unwrap();
    assert_eq!(written["Position"]["NotFinite"]["mechanism"], "FourBar");
}

/// Errors with borrowed and owned names are written as those with static ones.
#[test]
fn errors_with_names_of_any_type() {
    let name = "FourBar".to_owned();
    let names = ["theta", "s"].map(str::to_owned);
    let names = names.each_ref().map(String::as_str);
    let inputs = InputValues::new(names.as_slice(), &[true, false], [0.5, 2.0, 0.0]);
    let error = PositionError::Unbuildable { mechanism: name.as_str(), group: "phi, psi", gap: 0.25, inputs };
    let expected = json!({
        "mechanism": "FourBar", "group": "phi, psi", "gap": 0.25, "inputs": { "theta": 0.5, "s": 2.0 }
    });
    let [borrowed, owned] = [to_value(error), to_value(error.map_names(Arc::<str>::from))].map(Result::unwrap);
    assert_eq!([&borrowed["Unbuildable"], &owned["Unbuildable"]], [&expected, &expected]);
    let motion = to_value(MotionError::from(error).map_names(String::from)).unwrap();
    assert_eq!(motion["Position"], owned);
}
