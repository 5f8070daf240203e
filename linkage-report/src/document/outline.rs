//! The outline of a derivation, independent of the format.

use core::fmt;

use linkage_runtime::derivation::{
    Counts, Derivation, Equation, Formula, FormulaMatrix, Group, Kernel, Operations, Quantity, Root, SceneDerivation,
};

use crate::words::Words;

/// An equation of matrices that holds for every mechanism, in all notations.
pub(crate) struct GeneralEquation {
    pub(crate) text: &'static str,
    pub(crate) latex: &'static str,
    pub(crate) mathml: &'static str,
}

/// Ψ(u, v) = 0.
pub(crate) const CONSTRAINTS: GeneralEquation = GeneralEquation {
    text: "Ψ(u, v) = 0",
    latex: "\\Psi(u, v) = 0",
    mathml: "<mrow><mi>Ψ</mi><mo>(</mo><mi>u</mi><mo>,</mo><mi>v</mi><mo>)</mo><mo>=</mo><mn>0</mn></mrow>",
};
/// J = ∂Ψ/∂u.
pub(crate) const JACOBIAN_UNKNOWNS: GeneralEquation = GeneralEquation {
    text: "J = ∂Ψ/∂u",
    latex: "J = \\frac{\\partial \\Psi}{\\partial u}",
    mathml: "<mrow><mi>J</mi><mo>=</mo><mfrac><mrow><mo>∂</mo><mi>Ψ</mi></mrow><mrow><mo>∂</mo><mi>u</mi></mrow>\
             </mfrac></mrow>",
};
/// A = ∂Ψ/∂v.
pub(crate) const JACOBIAN_INPUTS: GeneralEquation = GeneralEquation {
    text: "A = ∂Ψ/∂v",
    latex: "A = \\frac{\\partial \\Psi}{\\partial v}",
    mathml: "<mrow><mi>A</mi><mo>=</mo><mfrac><mrow><mo>∂</mo><mi>Ψ</mi></mrow><mrow><mo>∂</mo><mi>v</mi></mrow>\
             </mfrac></mrow>",
};
/// J·∂u/∂v = −A.
pub(crate) const RATIOS: GeneralEquation = GeneralEquation {
    text: "J·∂u/∂v = −A",
    latex: "J \\frac{\\partial u}{\\partial v} = -A",
    mathml: "<mrow><mi>J</mi><mfrac><mrow><mo>∂</mo><mi>u</mi></mrow><mrow><mo>∂</mo><mi>v</mi></mrow></mfrac>\
             <mo>=</mo><mrow><mo>−</mo><mi>A</mi></mrow></mrow>",
};
/// u̇ = ∂u/∂v·v̇.
pub(crate) const VELOCITY: GeneralEquation = GeneralEquation {
    text: "u̇ = (∂u/∂v)·v̇",
    latex: "\\dot{u} = \\frac{\\partial u}{\\partial v} \\dot{v}",
    mathml: "<mrow><mover><mi>u</mi><mo>˙</mo></mover><mo>=</mo><mfrac><mrow><mo>∂</mo><mi>u</mi></mrow><mrow>\
             <mo>∂</mo><mi>v</mi></mrow></mfrac><mover><mi>v</mi><mo>˙</mo></mover></mrow>",
};
/// J·∂²u/∂vⱼ∂vₖ = −γ(wⱼ, wₖ).
pub(crate) const RATIO_DERIVATIVES: GeneralEquation = GeneralEquation {
    text: "J·∂²u/∂vⱼ∂vₖ = −γ(wⱼ, wₖ)",
    latex: "J \\frac{\\partial^2 u}{\\partial v_j \\partial v_k} = -\\gamma(w_j, w_k)",
    mathml: "<mrow><mi>J</mi><mfrac><mrow><msup><mo>∂</mo><mn>2</mn></msup><mi>u</mi></mrow><mrow><mo>∂</mo><msub><mi>v\
             </mi><mi>j</mi></msub><mo>∂</mo><msub><mi>v</mi><mi>k</mi></msub></mrow></mfrac><mo>=</mo><mrow><mo>−</mo>\
             <mi>γ</mi><mo>(</mo><msub><mi>w</mi><mi>j</mi></msub><mo>,</mo><msub><mi>w</mi><mi>k</mi></msub><mo>)</mo>\
             </mrow></mrow>",
};
/// J·u⃛ = −(A·v⃛ + η).
pub(crate) const JERK: GeneralEquation = GeneralEquation {
    text: "J·u⃛ = −(A·v⃛ + η)",
    latex: "J \\dddot{u} = -(A \\dddot{v} + \\eta)",
    mathml: "<mrow><mi>J</mi><mover><mi>u</mi><mo>⃛</mo></mover><mo>=</mo><mrow><mo>−</mo><mrow><mo>(</mo><mi>A</mi>\
             <mover><mi>v</mi><mo>⃛</mo></mover><mo>+</mo><mi>η</mi><mo>)</mo></mrow></mrow></mrow>",
};
/// J·∂u/∂p = −Ψ_p.
pub(crate) const SENSITIVITY: GeneralEquation = GeneralEquation {
    text: "J·∂u/∂p = −Ψ_p",
    latex: "J \\frac{\\partial u}{\\partial p} = -\\Psi_p",
    mathml: "<mrow><mi>J</mi><mfrac><mrow><mo>∂</mo><mi>u</mi></mrow><mrow><mo>∂</mo><mi>p</mi></mrow></mfrac>\
             <mo>=</mo><mrow><mo>−</mo><msub><mi>Ψ</mi><mi>p</mi></msub></mrow></mrow>",
};
/// J·ü = −(A·v̈ + γ).
pub(crate) const ACCELERATION: GeneralEquation = GeneralEquation {
    text: "J·ü = −(A·v̈ + γ)",
    latex: "J \\ddot{u} = -(A \\ddot{v} + \\gamma)",
    mathml: "<mrow><mi>J</mi><mover><mi>u</mi><mo>¨</mo></mover><mo>=</mo><mrow><mo>−</mo><mrow><mo>(</mo><mi>A</mi>\
             <mover><mi>v</mi><mo>¨</mo></mover><mo>+</mo><mi>γ</mi><mo>)</mo></mrow></mrow></mrow>",
};

/// M·v̈ = Q.
pub(crate) const MOTION: GeneralEquation = GeneralEquation {
    text: "M·v̈ = Q",
    latex: "M \\ddot{v} = Q",
    mathml: "<mrow><mi>M</mi><mover><mi>v</mi><mo>¨</mo></mover><mo>=</mo><mi>Q</mi></mrow>",
};

/// M·q̈ + Ψ_qᵀ·λ = F.
pub(crate) const MULTIPLIERS: GeneralEquation = GeneralEquation {
    text: "M·q̈ + (∂Ψ/∂q)ᵀ·λ = F",
    latex: "M \\ddot{q} + \\left(\\frac{\\partial \\Psi}{\\partial q}\\right)^T \\lambda = F",
    mathml: "<mrow><mi>M</mi><mover><mi>q</mi><mo>¨</mo></mover><mo>+</mo><msup><mrow><mo>(</mo><mfrac><mrow><mo>∂</mo>\
             <mi>Ψ</mi></mrow><mrow><mo>∂</mo><mi>q</mi></mrow></mfrac><mo>)</mo></mrow><mi>T</mi></msup><mi>λ</mi>\
             <mo>=</mo><mi>F</mi></mrow>",
};

/// The writer of headings, sentences and formulas in one format.
pub(crate) trait Lines {
    /// The words of its language.
    fn words(&self) -> &'static Words;
    fn heading(&mut self, heading: &str) -> fmt::Result;
    fn lead(&mut self, words: &str) -> fmt::Result;
    fn general_equation(&mut self, general: &GeneralEquation) -> fmt::Result;
    fn display(&mut self, formula: &Formula<'_>) -> fmt::Result;
    fn equation(&mut self, number: usize, equation: &Equation<'_>) -> fmt::Result;
    fn matrix(&mut self, matrix: &FormulaMatrix<'_>) -> fmt::Result;
    /// A constraint equation. It is zero at every position, so it has no numbers of a position.
    fn zero(&mut self, number: usize, equation: &Equation<'_>) -> fmt::Result {
        self.equation(number, equation)
    }
    /// An equation whose right side is the sum of these columns.
    fn sum(&mut self, number: usize, equation: &Equation<'_>, _: &[&FormulaMatrix<'_>]) -> fmt::Result {
        self.equation(number, equation)
    }
}

/// The writer of one document format.
pub(super) trait Pen: Lines {
    fn title(&mut self, mechanism: &str) -> fmt::Result;
    /// A line such as "Given: l₁ = 80, l₂", with the values that are known.
    fn list(&mut self, role: &str, formulas: &mut dyn Iterator<Item = (Formula<'_>, Option<f64>)>) -> fmt::Result;
    /// A table of numbers by name.
    fn table(&mut self, caption: &str, rows: &[(String, f64)]) -> fmt::Result;
    /// The numbers of coordinates and equations.
    fn counts(&mut self, counts: Counts) -> fmt::Result;
    /// The n-th group, counted from 1.
    fn group(&mut self, n: usize, group: &Group<'_>) -> fmt::Result;
    /// The signs of a root on both branches.
    fn branches(&mut self, root: &Root<'_>) -> fmt::Result;
    fn kernels(&mut self, kernels: &[Kernel<'_>]) -> fmt::Result;
}

/// Writes the conditions of the formulas, if there are some.
pub(super) fn conditions<'a>(
    pen: &mut dyn Pen,
    conditions: impl ExactSizeIterator<Item = &'a Formula<'a>>,
) -> fmt::Result {
    let words = pen.words();
    if conditions.len() > 0 {
        pen.heading(words.conditions)?;
        pen.lead(words.lead_conditions)?;
    }
    conditions.into_iter().try_for_each(|condition| pen.display(condition))
}

/// Writes the constraint equations, and the solutions for position, velocity and acceleration.
pub(super) fn solved(derivation: &Derivation<'_>, pen: &mut dyn Pen, number: &mut usize) -> fmt::Result {
    let words = pen.words();
    pen.heading(words.constraints)?;
    pen.lead(words.lead_constraints)?;
    pen.general_equation(&CONSTRAINTS)?;
    for equation in derivation.residual {
        *number += 1;
        pen.zero(*number, equation)?;
    }
    if !derivation.implied.is_empty() {
        pen.lead(words.lead_implied)?;
        equations(pen, number, derivation.implied)?;
    }

    pen.heading(words.jacobian)?;
    pen.lead(words.lead_jacobian)?;
    for (general, matrix) in
        [(JACOBIAN_UNKNOWNS, derivation.jacobian_unknowns), (JACOBIAN_INPUTS, derivation.jacobian_inputs)]
    {
        pen.general_equation(&general)?;
        pen.matrix(&matrix)?;
    }

    if !derivation.groups.is_empty() {
        pen.heading(words.structure)?;
    }
    for (index, group) in derivation.groups.iter().enumerate() {
        pen.group(index + 1, group)?;
        pen.list(words.unknown, &mut group.unknowns.iter().map(|unknown| (*unknown, None)))?;
        pen.lead(if group.position.is_empty() { words.lead_newton } else { words.lead_position })?;
        equations(pen, number, group.position)?;
        if let Some(root) = &group.root {
            pen.branches(root)?;
        }
        pen.lead(&(words.system)(group.method))?;
        if let Some(determinant) = group.determinant {
            equations(pen, number, &[determinant])?;
        }
        if let Some(inverse) = &group.inverse {
            pen.matrix(inverse)?;
        }
    }

    if let (Some(determinant), [_, _, ..]) = (derivation.determinant, derivation.groups) {
        pen.lead(words.lead_determinant)?;
        equations(pen, number, &[determinant])?;
    }

    pen.heading(words.ratios)?;
    pen.lead(words.lead_ratios)?;
    pen.general_equation(&RATIOS)?;
    pen.lead(words.lead_velocity)?;
    pen.general_equation(&VELOCITY)?;
    if derivation.inputs.len() == 1 {
        pen.lead(words.lead_transmission)?;
    }
    equations(pen, number, derivation.ratios)?;

    pen.heading(words.acceleration)?;
    pen.lead(words.lead_acceleration)?;
    pen.general_equation(&ACCELERATION)?;
    if !derivation.gamma.is_empty() {
        pen.lead(words.lead_gamma)?;
    }
    equations(pen, number, derivation.gamma)?;

    if let Some(formulas) = derivation.ratio_derivatives {
        pen.heading(words.ratio_derivatives)?;
        pen.lead(words.lead_ratio_derivatives)?;
        pen.general_equation(&RATIO_DERIVATIVES)?;
        equations(pen, number, formulas)?;
    }
    if let Some(eta) = derivation.jerk {
        pen.heading(words.jerk)?;
        pen.lead(words.lead_jerk)?;
        pen.general_equation(&JERK)?;
        pen.lead(words.lead_eta)?;
        equations(pen, number, eta)?;
    }
    if let Some(sensitivity) = derivation.sensitivity {
        pen.heading(words.sensitivity)?;
        pen.lead(words.lead_sensitivity)?;
        pen.general_equation(&SENSITIVITY)?;
        pen.lead(words.lead_parameters)?;
        pen.matrix(&sensitivity.jacobian)?;
        equations(pen, number, sensitivity.formulas)?;
    }
    Ok(())
}

/// Writes the equations of motion of a scene; `number` is that of the equation before them.
pub(super) fn write_scene(scene: &SceneDerivation<'_>, pen: &mut dyn Pen, number: &mut usize) -> fmt::Result {
    let words = pen.words();
    pen.title(scene.scene)?;
    if !scene.parameters.is_empty() {
        pen.list(words.given, &mut scene.parameters.iter().map(|symbol| (symbol.formula, None)))?;
    }
    pen.heading(words.motion)?;
    pen.lead(words.lead_motion)?;
    pen.general_equation(&MOTION)?;
    if !scene.mass_matrix.is_empty() {
        pen.lead(words.lead_mass_matrix)?;
        equations(pen, number, scene.mass_matrix)?;
    }
    pen.lead(lead_of_forces(words, scene))?;
    for effect in scene.forces {
        pen.lead(&(words.name)(effect.name))?;
        equations(pen, number, effect.forces)?;
    }
    if !scene.frictions_and_stops.is_empty() {
        pen.lead(words.lead_contacts)?;
    }
    for contact in scene.frictions_and_stops {
        pen.lead(&(words.name)(contact.name))?;
        equations(pen, number, &[contact.along])?;
        pen.display(&contact.bound)?;
        if let Some(joint) = &contact.bearing {
            pen.lead(&(words.bearing)(joint.name))?;
            pen.display(&joint.formula)?;
        }
        if let Some(factor) = &contact.rebound {
            pen.lead(words.lead_rebound)?;
            pen.display(factor)?;
        }
        equations(pen, number, contact.forces)?;
    }
    if !scene.drives.is_empty() {
        pen.lead(words.lead_drives)?;
        equations(pen, number, scene.drives)?;
    }
    if let Some(potential) = scene.potential {
        pen.heading(words.potential)?;
        equations(pen, number, &[potential])?;
    }
    if !scene.joints.is_empty() {
        pen.heading(words.joints)?;
        pen.lead(words.lead_joints)?;
        if !scene.multipliers.is_empty() {
            pen.lead(words.lead_multipliers)?;
            pen.general_equation(&MULTIPLIERS)?;
        }
        for contact in scene.contacts {
            pen.lead(&(words.force_along)(contact.name))?;
            pen.display(&contact.formula)?;
        }
    }
    for joint in scene.joints {
        pen.lead(&(words.name)(joint.name))?;
        equations(pen, number, &joint.components)?;
    }
    if !scene.kernels.is_empty() {
        pen.heading(words.operations)?;
        pen.kernels(scene.kernels)?;
    }
    Ok(())
}

/// The counts of operations in the order of their columns.
pub(crate) fn counts(of: &Operations) -> [usize; 4] {
    [of.functions, of.divisions, of.multiplications, of.additions]
}

/// The sentence before the generalised forces.
pub(crate) fn lead_of_forces(words: &Words, scene: &SceneDerivation<'_>) -> &'static str {
    match scene.forces {
        [] if scene.frictions_and_stops.is_empty() => words.lead_no_forces,
        [] => words.lead_only_contacts,
        _ => words.lead_forces,
    }
}

pub(super) fn equations<P: Lines + ?Sized>(pen: &mut P, number: &mut usize, equations: &[Equation<'_>]) -> fmt::Result {
    for equation in equations {
        *number += 1;
        pen.equation(*number, equation)?;
    }
    Ok(())
}

pub(super) fn quantities(
    pen: &mut dyn Pen,
    number: &mut usize,
    heading: &str,
    quantities: &[Quantity<'_>],
) -> fmt::Result {
    if !quantities.is_empty() {
        pen.heading(heading)?;
    }
    for quantity in quantities {
        pen.lead(quantity.name)?;
        equations(pen, number, quantity.value)?;
        equations(pen, number, quantity.ratios)?;
        equations(pen, number, quantity.ratio_derivatives)?;
        equations(pen, number, quantity.sensitivities)?;
    }
    Ok(())
}
