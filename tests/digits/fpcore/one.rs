//! One mechanism and its scene with `derive fpcore`, with names that FPCore does not know.

use std::collections::BTreeMap;

use linkage::{Document, Elbow, FpCore, linkage};
use linkage_oracle::precise::{Big, big};

use super::reader::Core;

linkage! {
    /// A four-bar; the height of the floor has the name of a function, and letters are not ASCII.
    mechanism FourBar {
        param floor = 80, a = 20, länge = 50, λ = 70;
        /// A length with the name that the rate of the crank has.
        param θ_rate = 1;
        param m = 0.3, j = 40, k = 2.5;
        input θ;
        unknown ψ, φ;
        loop a@θ + länge@ψ = floor@0 + λ@φ;
        point C = a@θ + (länge, θ_rate)@ψ;
        output swing = φ - ψ;
        body coupler { mass m; inertia j; center C; angle ψ; }
        derive fpcore;

        scene Loaded {
            inertia;
            gravity (0, -9.81);
            spring k, 0.1 on swing;
            energy;
        }
    }
}

fn core(all: &[FpCore<'static>], name: &str) -> FpCore<'static> {
    all.iter().find(|core| core.name() == name).unwrap_or_else(|| panic!("no {name}")).clone()
}

/// The formulas of the mechanism and of the scene.
fn all() -> Vec<FpCore<'static>> {
    let (mechanism, scene) = (FourBar::<f64>::DERIVATION.fpcore(), Loaded::<f64>::DERIVATION.fpcore());
    mechanism.into_iter().chain(scene).collect()
}

fn data(crank: f64) -> BTreeMap<String, f64> {
    let data = [
        ("floor_2", 80.0),
        ("a", 20.0),
        ("lu e4nge", 50.0),
        ("lambda", 70.0),
        ("theta_rate", 1.0),
        ("theta_rate_2", 1.5),
        ("m", 0.3),
        ("j", 40.0),
        ("k", 2.5),
        ("theta", crank),
        ("theta_acceleration", -0.7),
        ("psi_phi_side", 1.0),
    ];
    data.into_iter().map(|(name, number)| (name.replace(' ', ""), number)).collect()
}

#[test]
fn a_name_is_ascii_and_one_of_a_kind() {
    let arguments = |name: &str| core(&all(), name).arguments().map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(
        arguments("FourBar::point_velocities.c.x"),
        ["theta", "psi", "a", "theta_rate_2", "psi_rate", "lue4nge", "theta_rate"]
    );
}

#[test]
fn text_of_the_four_bar() {
    let all = all();
    let one = |name: &str| core(&all, name);
    let design = one("FourBar::kinematics.pose.psi_angle")
        .with("floor_2", 80.0)
        .with("a", 20.0)
        .with("lue4nge", 50.0)
        .with("lambda", 70.0)
        .with("psi_phi_side", -1.0)
        .with("no argument", 1.0)
        .within("theta", 0.5..=1.0);
    let texts = [one("FourBar::velocity.psi"), design, one("Loaded::forces[0]")];
    let text = texts.map(|core| core.to_string()).join("\n\n");
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!("four_bar", text) });
}

/// Numbers in place of arguments change no bit.
#[test]
fn given_numbers() {
    for core in all() {
        let names = core.arguments().map(str::to_owned).enumerate();
        let data: BTreeMap<String, f64> = names.map(|(place, name)| (name, 0.7 + 0.3 * place as f64)).collect();
        let given = data.iter().fold(core.clone(), |core, (name, number)| core.with(name, *number));
        assert_eq!(given.arguments().count(), 0);
        let [general, given] = [core, given].map(|core| Core::read(&core.to_string()));
        let nothing = BTreeMap::new();
        assert_eq!(given.is_valid::<f64>(&nothing), general.is_valid(&data), "{}", general.name);
        let [given, of_data] = [given.value::<f64>(&nothing), general.value(&data)];
        assert!(given == of_data || given.is_nan() && of_data.is_nan(), "{}: {given:e} {of_data:e}", general.name);
    }
}

#[test]
fn a_range_is_a_precondition() {
    let core = core(&all(), "FourBar::kinematics.accelerations.phi").within("theta", 0.5..=1.0);
    let core = Core::read(&core.to_string());
    assert!(core.is_valid(&data(0.9)) && !core.is_valid(&data(0.4)) && !core.is_valid(&data(1.1)));
}

/// Links that do not reach: the precondition says so.
#[test]
fn the_precondition_is_that_of_the_code() {
    let core = Core::read(&core(&all(), "FourBar::kinematics.rates.phi").to_string());
    let mut data = data(0.9);
    assert!(core.is_valid(&data));
    data.insert("lambda".to_owned(), 5.0);
    assert!(!core.is_valid(&data));
}

/// The text in 48 digits is what the function rounds.
#[test]
fn the_text_in_48_digits() {
    let m = FourBar::default();
    let core = Core::read(&core(&all(), "FourBar::kinematics.accelerations.phi").to_string());
    let mut errors = Vec::new();
    for step in 0..40 {
        let crank = 0.15 * f64::from(step) - 3.0;
        let found = m.kinematics(crank, FourBarBranch::new(Elbow::Left), 1.5, -0.7).unwrap();
        let exact = data(crank).into_iter().map(|(name, number)| (name, big(number))).collect();
        let exact: Big = core.value(&exact);
        let error = big(found.accelerations.φ) - exact.clone();
        errors.push((error / exact).to_f64().value().abs());
    }
    errors.sort_by(f64::total_cmp);
    let [median, most] = [errors[20], errors[39]];
    println!("relative errors of {median:.1e} in the median, of at most {most:.1e}");
    assert!((1e-17..1e-15).contains(&median) && most < 1e-13, "{median:e} {most:e}");
}

#[test]
fn a_scene_has_the_bits_of_its_functions() {
    let all = all();
    let (loaded, coordinates) = (Loaded::default(), |values: [f64; 3]| {
        let [ψ, φ, θ] = values;
        FourBarCoordinates { ψ, φ, θ }
    });
    for step in 0..50 {
        let turn = 0.1 * f64::from(step);
        let q = coordinates([0.3 + turn, 2.0 - turn, 1.0 + 0.5 * turn]);
        let mut data = data(q.θ);
        data.extend([("psi", q.ψ), ("phi", q.φ)].map(|(name, value)| (name.to_owned(), value)));
        let value = |name: &str| Core::read(&core(&all, name).to_string()).value(&data);
        let (mass, forces) = (loaded.mass_matrix(&q).unwrap(), loaded.forces(0.0, &q, 1.5).unwrap());
        assert_eq!(value("Loaded::mass_matrix[0]"), mass[0]);
        assert_eq!(value("Loaded::forces[0]"), forces[0]);
        let energy = loaded.energy(&q, 1.5).unwrap();
        assert_eq!(value("Loaded::energy.kinetic"), energy.kinetic);
        assert_eq!(value("Loaded::energy.potential"), energy.potential);
    }
}
