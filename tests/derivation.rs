//! The derivations as documents: what the Maple sheet and the lecture notes print, exactly.

use linkage::Document;
use linkage::derivation::{Derivation, Equation, Formula};

use linkage_gallery::cam_follower::*;
use linkage_gallery::cam_rocker::*;
use linkage_gallery::five_bar::*;
use linkage_gallery::five_bar_scenes::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::geared_five_bar::*;
use linkage_gallery::introductory::*;
use linkage_gallery::jansen::*;
use linkage_gallery::norton_four_bar::*;
use linkage_gallery::rpr::*;
use linkage_gallery::rrr::*;
use linkage_gallery::six_bar::*;
use linkage_gallery::slider_crank::*;
use linkage_gallery::slider_crank_scenes::*;

macro_rules! snapshot {
    ($name:ident, $value:expr) => {
        #[test]
        fn $name() {
            insta::with_settings!({ prepend_module_to_snapshot => false, omit_expression => true }, {
                insta::assert_snapshot!(concat!("derivation_", stringify!($name)), $value);
            });
        }
    };
}

snapshot!(four_bar, FourBar::DERIVATION.to_text());
snapshot!(introductory, Introductory::DERIVATION.to_text());
snapshot!(engine, Engine::DERIVATION.to_text());
snapshot!(compressor, Compressor::DERIVATION.to_text());
snapshot!(rrr, Rrr::DERIVATION.to_text());
snapshot!(rpr, Rpr::DERIVATION.to_text());
snapshot!(six_bar, SixBar::DERIVATION.to_text());
snapshot!(geared_five_bar, GearedFiveBar::DERIVATION.to_text());
snapshot!(jansen, Jansen::DERIVATION.to_text());
snapshot!(cam_rocker, CamRocker::DERIVATION.to_text());
snapshot!(norton_four_bar, NortonFourBar::DERIVATION.to_text());
snapshot!(norton_four_bar_in_latex, NortonFourBar::DERIVATION.to_latex());
snapshot!(five_bar, FiveBar::DERIVATION.to_text());
snapshot!(four_bar_in_latex, FourBar::DERIVATION.to_latex());
snapshot!(scene_of_a_five_bar, Free::DERIVATION.to_text());
snapshot!(scene_of_an_engine, Turning::DERIVATION.to_text());
snapshot!(scene_of_an_engine_in_latex, Turning::DERIVATION.to_latex());

fn texts(equations: &[Equation]) -> Vec<String> {
    equations.iter().map(ToString::to_string).collect()
}

fn determinant(derivation: &Derivation) -> String {
    derivation.determinant.unwrap().right.to_string()
}

/// "Analisi cinematica mediante il metodo delle equazioni di vincolo": `Det_psi_u`, combined, and `Rap`
/// with the sign of W = -Rap.
#[test]
fn the_maple_sheet() {
    let derivation = FourBar::DERIVATION;
    assert_eq!(determinant(derivation), "−l₃·l₄·sin(θ₃ − θ₄)");
    assert_eq!(
        texts(derivation.ratios),
        ["∂θ₃/∂θ₂ = −l₂·sin(θ₂ − θ₄)/(l₃·sin(θ₃ − θ₄))", "∂θ₄/∂θ₂ = l₂·sin(θ₂ − θ₃)/(l₄·sin(θ₃ − θ₄))"]
    );
    // l3 and l4 have been cancelled.
    let conditions: Vec<String> = derivation.conditions.iter().map(ToString::to_string).collect();
    assert_eq!(conditions, ["l₃ ≠ 0", "l₄ ≠ 0"]);
}

/// Section 1.2: z1 z2 sin(phi2 - phi1) for the engine, -z2 cos(phi2) for the compressor.
#[test]
fn singular_configurations_of_the_lecture_notes() {
    assert_eq!(determinant(Engine::DERIVATION), "−z₁·z₂·sin(φ₁ − φ₂)");
    assert_eq!(determinant(Compressor::DERIVATION), "−z₂·cos(φ₂)");
}

/// Section 1.3: [phi1'; phi2'] = 1/(z1 z2 sin(phi1 - phi2)) [-z2 cos phi2, -z2 sin phi2; -z1 cos phi1, -z1 sin phi1] …
#[test]
fn inverse_of_the_dyad_rrr() {
    let inverse = Rrr::DERIVATION.blocks[0].inverse.unwrap();
    assert_eq!(inverse.factor.unwrap().to_string(), "1/(z₁·z₂·sin(φ₁ − φ₂))");
    let entries: Vec<String> = inverse.entries.iter().map(|entry| entry.value.to_string()).collect();
    assert_eq!(entries, ["−z₂·cos(φ₂)", "−z₂·sin(φ₂)", "−z₁·cos(φ₁)", "−z₁·sin(φ₁)"]);
}

/// What is not asked for is not there.
#[test]
fn only_on_request() {
    let (without, with) = (FourBar::DERIVATION, NortonFourBar::DERIVATION);
    assert!(without.jerk.is_none() && without.ratio_derivatives.is_none() && without.sensitivity.is_none());
    let points = without.points.iter().all(|point| point.ratio_derivatives.len() + point.sensitivities.len() == 0);
    assert!(points && !without.to_text().contains("Jerk"));
    let functions = |derivation: &Derivation| derivation.kernels.iter().filter(|k| k.function.contains("jerk")).count();
    assert_eq!((functions(without), functions(with)), (0, 3));
    assert_eq!(
        texts(with.sensitivity.unwrap().formulas)[..2],
        ["∂θ₃/∂a = cos(θ₂ − θ₄)/(b·sin(θ₃ − θ₄))", "∂θ₄/∂a = cos(θ₂ − θ₃)/(c·sin(θ₃ − θ₄))"]
    );
}

#[test]
fn latex_is_balanced() {
    for derivation in [FourBar::DERIVATION, SixBar::DERIVATION, Jansen::DERIVATION, NortonFourBar::DERIVATION] {
        let latex = derivation.to_latex();
        for (opening, closing) in [("{", "}"), ("\\begin", "\\end"), ("\\[", "\\]"), ("\\left", "\\right")] {
            assert_eq!(latex.matches(opening).count(), latex.matches(closing).count(), "{opening}");
        }
    }
}

/// tan(pressure) = (s' - offset) / (s + sqrt(prime^2 - offset^2)): R. L. Norton, *Design of Machinery*, chapter 8.
#[test]
fn pressure_angle_of_a_cam() {
    let value = CamFollower::DERIVATION.outputs[0].value[0].right;
    assert_eq!(value.to_string(), "arctan((lift′(θ, height, rise) − offset)/(s + √(prime² − offset²)))");
    let prime = r"\mathrm{lift}'(\theta, \mathrm{height}, \mathrm{rise})";
    let Formula { latex, mathml, .. } = value;
    assert!(latex.contains(prime), "{latex}");
    assert!(mathml.contains("<msup><mi>lift</mi><mo>′</mo></msup>"), "{mathml}");
}
