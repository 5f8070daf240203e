//! The derivations as documents, with the formulas of the Maple sheet and the lecture notes.

use linkage::derivation::{Derivation, Equation};
use linkage::{Document, Notation};

use linkage_gallery::cam_follower::*;
use linkage_gallery::cam_rocker::*;
use linkage_gallery::five_bar::*;
use linkage_gallery::five_bar_scenes::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::four_bar_effects;
use linkage_gallery::geared_five_bar::*;
use linkage_gallery::jansen::*;
use linkage_gallery::norton_four_bar::*;
use linkage_gallery::rpr::*;
use linkage_gallery::rrr::*;
use linkage_gallery::six_bar::*;
use linkage_gallery::slider_crank::*;
use linkage_gallery::slider_crank_scenes::*;

linkage::linkage! {
    /// A mass on an arm, on a cart; a rope to the mass rubs.
    pub mechanism Cart {
        param l, m1, m2, mu, load;
        input s, theta;
        point P = (s, 0);
        point G = P + l@theta;
        body cart { mass m1; center P; }
        body bob { mass m2; inertia 0; center G; angle theta; }
        scene Rubbing { inertia; friction mu, load on norm(G); reactions; }
    }
}

/// One section of a document, in text or in LaTeX.
fn section(document: &str, title: &str) -> String {
    let title_of = |line: &'_ str| {
        let numbered = line.split_once(". ").filter(|(number, _)| number.parse::<usize>().is_ok());
        let latex = || line.strip_prefix("\\subsection*{")?.strip_suffix('}');
        numbered.map(|(_, title)| title).or_else(latex).map(str::to_owned)
    };
    let mut lines = document.lines().skip_while(|line| title_of(line).as_deref() != Some(title));
    let first = lines.next().unwrap_or_else(|| panic!("no section {title}"));
    let rest = lines.take_while(|line| title_of(line).is_none());
    std::iter::once(first).chain(rest).collect::<Vec<_>>().join("\n")
}

/// Sections of a document.
fn sections(document: &str, titles: &[&str]) -> String {
    titles.iter().map(|title| section(document, title)).collect::<Vec<_>>().join("\n")
}

macro_rules! snapshots {
    ($($name:ident: $value:expr;)*) => {$(
        #[test]
        fn $name() {
            insta::with_settings!({ omit_expression => true }, {
                insta::assert_snapshot!(stringify!($name), $value);
            });
        }
    )*};
}

const HIGHER_ORDERS: &[&str] = &["Derivatives of the velocity ratios", "Jerk", "Sensitivity"];

// Whole documents.
snapshots! {
    document_in_text: FourBar::DERIVATION.to_text();
    document_in_latex: FourBar::DERIVATION.to_latex();
    scene_in_text: Turning::DERIVATION.to_text();
    scene_in_latex: Turning::DERIVATION.to_latex();
    scene_of_two_inputs: Free::DERIVATION.to_text();
    scene_with_all_effects_in_text: section(&four_bar_effects::Everything::DERIVATION.to_text(), "Equations of motion");
    scene_with_all_effects_in_latex: section(&four_bar_effects::Everything::DERIVATION.to_latex(), "Equations of motion");
    scene_with_a_drive: section(&four_bar_effects::Driven::DERIVATION.to_text(), "Equations of motion");
    scene_with_frictions_by_reactions: section(&Worn::DERIVATION.to_text(), "Equations of motion");
}

// The forces of pins and guides, with frictions, and with one that acts on a link.
snapshots! {
    forces_in_joints_of_an_open_chain: section(&Rubbing::DERIVATION.to_text(), "Forces in joints");
    forces_in_joints_in_text: section(&Worn::DERIVATION.to_text(), "Forces in joints");
    forces_in_joints_in_latex: section(&Worn::DERIVATION.to_latex(), "Forces in joints");
}

// Sections that differ from one mechanism to the next.
snapshots! {
    group_of_two_angles: section(&Rrr::DERIVATION.to_text(), "Order of solution");
    group_of_an_angle_and_a_length: section(&Rpr::DERIVATION.to_text(), "Order of solution");
    groups_of_one_unknown: section(&Compressor::DERIVATION.to_text(), "Order of solution");
    groups_in_a_row: section(&SixBar::DERIVATION.to_text(), "Order of solution");
    velocity_ratios_of_groups_in_a_row: section(&SixBar::DERIVATION.to_text(), "Velocity ratios");
    velocity_ratios_of_two_inputs: section(&FiveBar::DERIVATION.to_text(), "Velocity ratios");
    geared_angle: sections(&GearedFiveBar::DERIVATION.to_text(), &["Constraint equations", "Velocity ratios"]);
    user_function: sections(&CamRocker::DERIVATION.to_text(), &["Constraint equations", "Velocity ratios", "Acceleration"]);
    higher_orders_in_text: sections(&NortonFourBar::DERIVATION.to_text(), HIGHER_ORDERS);
    higher_orders_in_latex: sections(&NortonFourBar::DERIVATION.to_latex(), HIGHER_ORDERS);
    outputs_of_higher_order: section(&NortonFourBar::DERIVATION.to_text(), "Outputs");
    conditions: section(&Rpr::DERIVATION.to_text(), "Conditions");
}

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
    let inverse = Rrr::DERIVATION.groups[0].inverse.unwrap();
    assert_eq!(inverse.factor.unwrap().to_string(), "1/(z₁·z₂·sin(φ₁ − φ₂))");
    let entries: Vec<String> = inverse.entries.iter().map(|entry| entry.value.to_string()).collect();
    assert_eq!(entries, ["−z₂·cos(φ₂)", "−z₂·sin(φ₂)", "−z₁·cos(φ₁)", "−z₁·sin(φ₁)"]);
}

/// Derivatives that are not requested are absent.
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
    let (latex, mathml) = (value.to_latex(), value.to_mathml());
    assert!(latex.contains(prime), "{latex}");
    assert!(mathml.contains("<msup><mi>lift</mi><mo>′</mo></msup>"), "{mathml}");
}
