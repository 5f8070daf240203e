//! `derive serde`: the emitted types and those of the runtime, written and read with serde.

mod invalid;
mod runtime;
mod written_only;

use std::fmt::Debug;

use linkage::accuracy::Reached;
use linkage::{
    AnyBranch, Assembled, DoubleDouble, Elbow, Mechanism, OutputMotion, PointMotion, PositionError, Solution, linkage,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{from_str, json, to_string, to_value};

linkage! {
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70, m = 2, g = 9.81;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point C = l2@theta2 + l3@theta3;
        output mu = theta4 - theta3;
        body rod { mass m; center C; }
        scene Falling { inertia; gravity (0, -g); energy; }
        derive serde, jerk, limits;
    }
}

/// Asserts that a value is read as it was written. Its debug text has each double with the digits that identify it.
fn comes_back<X: Serialize + DeserializeOwned + Debug>(value: X) {
    let text = to_string(&value).unwrap();
    let read: X = from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    assert_eq!(format!("{read:?}"), format!("{value:?}"));
}

fn four_bar() -> (FourBar, FourBarBranch) {
    (FourBar { l2: 20.1, ..FourBar::default() }, FourBarBranch::new(Elbow::Left))
}

#[test]
fn emitted_types_come_back_with_their_bits() {
    let (m, branch) = four_bar();
    let pose = m.assemble(0.1, branch).unwrap();
    let motion = m.motion(&pose.coordinates(), 41.9, 0.3).unwrap();
    comes_back(m.clone());
    comes_back(branch);
    comes_back(motion.position);
    comes_back(motion.rates);
    comes_back(motion.accelerations);
    comes_back(m.jerk(&pose, &motion.rates, &motion.accelerations, 0.0).unwrap());
    comes_back(FourBarInputs { theta2: 0.1 });
    comes_back::<FourBarPoints<PointMotion>>(motion.points);
    comes_back::<FourBarOutputs<OutputMotion>>(motion.outputs);
    comes_back(motion);
    comes_back(pose);
    comes_back(m.kinematics(0.1, branch, 41.9, 0.3).unwrap());
    comes_back(m.full_kinematics(0.1, branch, 41.9, 0.3).unwrap());
    comes_back(Falling { g: 1.62, mechanism: m.clone(), ..Falling::default() });

    comes_back::<Vec<Assembled<_, _>>>(m.branches(0.1).unwrap().collect());
    comes_back(Reached::at(&m, pose.coordinates()));
    comes_back::<Solution<_>>(m.solve(&pose.coordinates()).unwrap());
    comes_back::<AnyBranch<_>>(m.solve_any_branch(&pose.coordinates()).unwrap());
}

/// A pose that has been read is that of the mechanism: functions of it give equal bits.
#[test]
fn functions_of_a_pose_that_was_read() {
    let (m, branch) = four_bar();
    for step in 0..360 {
        let pose = m.assemble(f64::from(step).to_radians(), branch).unwrap();
        let read: FourBarPose = from_str(&to_string(&pose).unwrap()).unwrap();
        assert_eq!(m.velocity(&read, 41.9).unwrap(), m.velocity(&pose, 41.9).unwrap());
        assert_eq!(m.points(&read).unwrap(), m.points(&pose).unwrap());
    }
}

/// No direction is too inaccurate to be read, also where the links are in line.
#[test]
fn poses_at_limits() {
    let lengths = [80.0, 50.0, 37.0, 61.0, 1e3, 0.7];
    let mut count = 0;
    for (place, l2) in (0_u32..).zip(lengths.iter().cycle().take(200).copied()) {
        let l3 = lengths[place as usize % 5] * (1.0 + f64::from(place) / 97.0);
        let m = FourBar { l2, l3, ..FourBar::default() };
        for (start, side) in [(0.3, Elbow::Left), (2.0, Elbow::Right), (-2.5, Elbow::Left)] {
            let branch = FourBarBranch::new(side);
            let Ok(limits) = m.limits(start, branch) else { continue };
            for input in [limits.lower, limits.upper].iter().filter_map(linkage::limits::Limit::input) {
                for near in [input, input * (1.0 - 1e-15), input * (1.0 - 1e-9), input * (1.0 - 1e-3)] {
                    let Ok(pose) = m.assemble(near, branch) else { continue };
                    comes_back(pose);
                    count += 1;
                }
            }
        }
    }
    assert!(count > 500, "{count}");
}

/// Poses of other scalars.
#[test]
fn poses_of_other_scalars() {
    let (m, branch) = four_bar();
    for step in 0..360 {
        let angle = f64::from(step).to_radians();
        comes_back(m.clone().map(|x| x as f32).assemble(angle as f32, branch).unwrap());
        comes_back(m.clone().map(DoubleDouble::from).assemble(DoubleDouble::from(angle), branch).unwrap());
    }
}

/// The fields have the user's names.
#[test]
fn fields_are_the_names_of_the_user() {
    let q = FourBarCoordinates { theta2: 0.5, theta3: 1.25, theta4: -2.0 };
    assert_eq!(to_value(q).unwrap(), json!({ "theta2": 0.5, "theta3": 1.25, "theta4": -2.0 }));
    let branch = to_value(FourBarBranch::new(Elbow::Left)).unwrap();
    assert_eq!(branch["theta3_theta4"], "Left");
    let derivation = to_value(FourBar::<f64>::DERIVATION).unwrap();
    assert_eq!(derivation["unknowns"].as_array().unwrap().len(), 2);
    assert_eq!(to_value(FourBar::unknowns(&q)).unwrap(), json!([1.25, -2.0]));
    let error = FourBar { l2: 1e3, ..FourBar::default() }.assemble(0.0, FourBarBranch::new(Elbow::Left)).unwrap_err();
    assert!(matches!(error, PositionError::Unbuildable { .. }));
    assert_eq!(to_value(error).unwrap()["Unbuildable"]["mechanism"], "FourBar");
}

/// Types with derives by the user, in a function, with other scalars.
#[test]
fn own_derives_and_places() {
    linkage! {
        #[derive(serde::Serialize)]
        #[serde(rename_all = "UPPERCASE")]
        mechanism Slider {
            param r = 1, l = 3;
            input phi;
            unknown psi, s;
            loop r@phi + l@psi = s@0;
            derive serde;
        }
    }
    assert_eq!(to_value(Slider::default()).unwrap(), json!({ "R": 1.0, "L": 3.0 }));
    let q = SliderCoordinates { phi: 0.5_f32, psi: 0.25, s: 3.5 };
    assert_eq!(from_str::<SliderCoordinates<f32>>(&to_string(&q).unwrap()).unwrap(), q);
}
