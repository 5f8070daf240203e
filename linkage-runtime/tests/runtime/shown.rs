//! Results as one line for readers.

use linkage::{Column, D, Elbow, Matrix, Mechanism, Slider};

linkage::linkage! {
    #[derive(Debug, Clone)]
    mechanism FourBar {
        param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        derive limits;
    }

    /// A piston that drives a crank.
    #[derive(Debug, Clone)]
    mechanism Engine {
        param r = 1, l = 3;
        input z;
        unknown phi, psi;
        loop r@phi + l@psi = z@0;
        derive limits;
    }

    #[derive(Debug, Clone)]
    mechanism Compressor {
        param r = 1, l = 3;
        input phi in 0deg..;
        unknown psi, z;
        loop r@phi + l@psi = z@0;
        derive limits;
    }

    #[derive(Debug, Clone)]
    mechanism Robot {
        param a = 1, b = 1.2, e = 2;
        input left, right;
        unknown phi, psi;
        loop a@left + b@phi = e@0 + a@right + b@psi;
    }

    /// The second dyad stops the first.
    #[derive(Debug, Clone)]
    mechanism SixBar {
        param a = 2, b = 7, c = 6, d = 8, e = 3, f = 3, g = 5, h = 14;
        input theta1;
        unknown theta2, theta3, theta4, theta5;
        loop a@theta1 + b@theta2 = d@0 + c@theta3;
        loop d@0 + e@theta3 + f@theta4 = h@0 + g@theta5;
        derive limits;
    }
}

/// Vectors and matrices take one line, also with many decimals.
#[test]
fn vectors_in_one_line() {
    let column = Column::from([1.5, -2.0, 1.0 / 3.0]);
    assert_eq!([format!("{column:.2}"), format!("{column}")], ["[1.50, -2.00, 0.33]", "[1.5, -2, 0.3333333333333333]"]);
    let matrix = Matrix::<f64, D<2>, D<3>>::from_fn(|row, column| (3 * row + column) as f64);
    assert_eq!(matrix.to_string(), "[[0, 1, 2], [3, 4, 5]]");
    assert_eq!(Column::<f64, D<0>>::zeros().to_string(), "[]");
}

/// Coordinates have names, and angles degrees.
#[test]
fn coordinates_by_name() {
    let m = Engine::default();
    let q = m.assemble(3.0, EngineBranch::new(Elbow::Left)).unwrap().coordinates();
    assert_eq!(m.named(&q).to_string(), "z = 3, phi = 80.40593°, psi = -19.18814°");
    assert_eq!(format!("{:.1}", m.named(&q)), "z = 3.0, phi = 80.4°, psi = -19.2°");
    let found = m.solve(&EngineCoordinates { z: 3.0, phi: -1.4, psi: 0.33 }).unwrap();
    let line = found.to_string();
    let expected =
        "EngineCoordinates { phi: -1.403348, psi: 0.334896, z: 3.000000 } after 4 Newton steps, relative residual ";
    assert!(line.starts_with(expected), "{line}");
    let any = m.solve_any_branch(&EngineCoordinates { z: 3.0, phi: -1.4, psi: 0.33 }).unwrap();
    assert_eq!(any.to_string(), line);
}

/// Limits have the name of the input and their reasons.
#[test]
fn limits_in_one_line() {
    let crank = FourBar::default().limits(0.5, FourBarBranch::new(Elbow::Left)).unwrap();
    assert_eq!(
        crank.to_string(),
        "theta from -78.58484° (links of phi, psi in line) to 78.58484° (links of phi, psi in line)"
    );
    assert_eq!(
        format!("{crank:.1}"),
        "theta from -78.6° (links of phi, psi in line) to 78.6° (links of phi, psi in line)"
    );
    let piston = Engine::default().limits(3.0, EngineBranch::new(Elbow::Left)).unwrap();
    assert_eq!(piston.to_string(), "z from 2 (links of phi, psi in line) to 4 (links of phi, psi in line)");
    let from = Compressor::default().limits(0.5, CompressorBranch::new(Slider::Far)).unwrap();
    assert_eq!(from.to_string(), "phi from 0° (the least value of phi) on");
    let m = SixBar::default();
    let branch = SixBarBranch::new(Elbow::Left, Elbow::Left);
    let start = (0..360).map(|degree| f64::from(degree).to_radians()).find(|v| m.assemble(*v, branch).is_ok()).unwrap();
    let searched = m.limits(start, branch).unwrap().to_string();
    assert!(searched.contains("° (theta4, theta5, found by search)"), "{searched}");
}

/// The error of a position has the inputs at which there is none.
#[test]
fn inputs_of_errors() {
    let (m, branch) = (FourBar::default(), FourBarBranch::new(Elbow::Left));
    let start = "FourBar cannot be assembled at theta = 90°: group phi, psi ";
    let theta = std::f64::consts::FRAC_PI_2;
    let none = m.assemble(theta, branch).unwrap_err();
    assert!(none.to_string().starts_with(start), "{none}");
    assert_eq!(m.kinematics(theta, branch, 1.0, 0.0).unwrap_err(), none);
    // The last digits of the gap are those of the scalar.
    let single = FourBar::<f32>::new(4.0, 3.0, 2.0, 2.5).assemble(theta as f32, branch).unwrap_err();
    assert!(single.to_string().starts_with(start), "{single}");
    let robot = Robot::default();
    let none = robot.assemble(RobotInputs { left: 3.0, right: 0.25 }, RobotBranch::new(Elbow::Left)).unwrap_err();
    assert!(
        none.to_string().starts_with("Robot cannot be assembled at left = 171.8873°, right = 14.32394°: "),
        "{none}"
    );
}
