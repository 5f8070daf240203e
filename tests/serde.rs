//! `derive serde`: the emitted types and those of the runtime, written and read with serde.

#![cfg(feature = "serde")]

use linkage::{Elbow, Energy, Mechanism, Mode, OutputMotion, PointMotion, PositionError, linkage};
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
        derive serde, jerk;
    }
}

/// Numbers are written so that they read back as the same bits.
#[test]
fn emitted_types_come_back_with_their_bits() {
    let m = FourBar { l2: 20.1, ..FourBar::default() };
    let branch = FourBarBranch::new(Elbow::Left);
    let motion = m.motion(&m.assemble(0.1, branch).unwrap().coordinates(), 41.9, 0.3).unwrap();
    macro_rules! there_and_back {
        ($($value:expr, $Type:ty;)*) => {$(
            let text = to_string(&$value).unwrap();
            assert_eq!(from_str::<$Type>(&text).unwrap(), $value, "{text}");
        )*};
    }
    there_and_back! {
        m, FourBar;
        branch, FourBarBranch;
        motion.position, FourBarCoordinates;
        motion.rates, FourBarRates;
        motion.accelerations, FourBarAccelerations;
        FourBarInputs { theta2: 0.1 }, FourBarInputs;
        motion.points, FourBarPoints<PointMotion>;
        motion.outputs, FourBarOutputs<OutputMotion>;
        motion, FourBarMotion;
    }
    let scene = Falling { g: 1.62, mechanism: m, ..Falling::default() };
    let text = to_string(&scene).unwrap();
    let read: Falling = from_str(&text).unwrap();
    assert_eq!((read.g, &read.mechanism), (scene.g, &scene.mechanism), "{text}");
    let energy = scene.energy(&motion.position, 41.9).unwrap();
    there_and_back! { energy, Energy<f64>; Mode::Stick, Mode; }
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
