//! The outline of a derivation, independent of the format.

use core::fmt;

use linkage_runtime::derivation::{
    Counts, Derivation, Equation, Formula, FormulaMatrix, Group, Kernel, Quantity, Root, SceneDerivation, Symbol,
};

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

/// The headings and introductory sentences of the sections.
pub(crate) mod words {
    pub(crate) const COORDINATES: &str = "Coordinates";
    pub(crate) const OPEN_CHAIN: &str = "Open chain";
    pub(crate) const CONSTRAINTS: &str = "Constraint equations";
    pub(crate) const JACOBIAN: &str = "Jacobian";
    pub(crate) const STRUCTURE: &str = "Order of solution";
    pub(crate) const RATIOS: &str = "Velocity ratios";
    pub(crate) const ACCELERATION: &str = "Acceleration";
    pub(crate) const RATIO_DERIVATIVES: &str = "Derivatives of the velocity ratios";
    pub(crate) const JERK: &str = "Jerk";
    pub(crate) const SENSITIVITY: &str = "Sensitivity";
    pub(crate) const POINTS: &str = "Points";
    pub(crate) const OUTPUTS: &str = "Outputs";
    pub(crate) const MOTION: &str = "Equations of motion";
    pub(crate) const JOINTS: &str = "Forces in joints";
    pub(crate) const POTENTIAL: &str = "Potential energy";
    pub(crate) const OPERATIONS: &str = "Operations";
    pub(crate) const CONDITIONS: &str = "Conditions";
    pub(crate) const NUMBERS: &str = "Numbers";

    pub(crate) const GIVEN: &str = "Given";
    pub(crate) const DRIVEN: &str = "Driven";
    pub(crate) const UNKNOWN: &str = "Unknown";
    pub(crate) const COUNTS: &str = "Counts";

    pub(crate) const LEAD_OPEN_CHAIN: &str =
        "The driven coordinates determine the position, and no equation is solved.";
    pub(crate) const LEAD_CONSTRAINTS: &str = "The mechanism is assembled where";
    pub(crate) const LEAD_IMPLIED: &str = "These equations follow, and are checked at each position:";
    pub(crate) const LEAD_JACOBIAN: &str =
        "The derivatives of the constraint equations with respect to the unknowns and the inputs:";
    pub(crate) const LEAD_DETERMINANT: &str = "All groups together:";
    pub(crate) const LEAD_POSITION: &str = "The position, each formula in terms of those before it:";
    pub(crate) const LEAD_NEWTON: &str = "The position has no closed form: Newton's method finds it from a guess, and the list of branches has all positions of loops of links.";
    pub(crate) const LEAD_RATIOS: &str = "Differentiated once, the constraint equations give";
    pub(crate) const LEAD_VELOCITY: &str = "so that";
    pub(crate) const LEAD_TRANSMISSION: &str =
        "With one input they are the transmission ratios, each the rate of an unknown divided by that of the input:";
    pub(crate) const LEAD_ACCELERATION: &str = "Differentiated twice, the constraint equations give";
    pub(crate) const LEAD_GAMMA: &str = "with the terms that contain no acceleration:";
    pub(crate) const LEAD_RATIO_DERIVATIVES: &str = "The derivatives of the velocity ratios follow from the rates of all coordinates at a unit rate of each input, and from the quadratic velocity term as a bilinear form of two of them:";
    pub(crate) const LEAD_JERK: &str = "Differentiated three times, the constraint equations give";
    pub(crate) const LEAD_ETA: &str = "with the terms that contain no jerk:";
    pub(crate) const LEAD_SENSITIVITY: &str = "With fixed inputs, the unknowns depend on the parameters p by";
    pub(crate) const LEAD_PARAMETERS: &str =
        "with the nonzero derivatives of the constraint equations with respect to the parameters:";
    pub(crate) const LEAD_MOTION: &str = "The velocity ratios reduce all inertia and all forces to the inputs:";
    pub(crate) const LEAD_MASS_MATRIX: &str = "with the reduced mass matrix";
    pub(crate) const LEAD_FORCES: &str = "and the generalised forces, the sum of the following; the bias of an unknown is its acceleration if no input accelerates:";
    pub(crate) const LEAD_ONLY_CONTACTS: &str = "and the generalised forces of frictions and stops only.";
    pub(crate) const LEAD_NO_FORCES: &str = "and no generalised forces.";
    pub(crate) const LEAD_CONTACTS: &str =
        "Frictions and stops act along scalars s. Their laws determine their forces f, which add to Q:";
    pub(crate) const LEAD_REBOUND: &str = "At an impact the rate of s is multiplied by";
    pub(crate) const LEAD_DRIVES: &str = "The driven inputs move by";
    pub(crate) const LEAD_JOINTS: &str =
        "The force of each joint on a link along x and y; of a guide the normal force and the moment.";
    pub(crate) const LEAD_MULTIPLIERS: &str =
        "There is one multiplier for each constraint equation. In all coordinates";
    pub(crate) const LEAD_CONDITIONS: &str = "The formulas assume that";
}

/// The writer of headings, sentences and formulas in one format.
pub(crate) trait Lines {
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
    if conditions.len() > 0 {
        pen.heading(words::CONDITIONS)?;
        pen.lead(words::LEAD_CONDITIONS)?;
    }
    conditions.into_iter().try_for_each(|condition| pen.display(condition))
}

/// Writes the constraint equations, and the solutions for position, velocity and acceleration.
pub(super) fn solved(derivation: &Derivation<'_>, pen: &mut dyn Pen, number: &mut usize) -> fmt::Result {
    pen.heading(words::CONSTRAINTS)?;
    pen.lead(words::LEAD_CONSTRAINTS)?;
    pen.general_equation(&CONSTRAINTS)?;
    for equation in derivation.residual {
        *number += 1;
        pen.zero(*number, equation)?;
    }
    if !derivation.implied.is_empty() {
        pen.lead(words::LEAD_IMPLIED)?;
        equations(pen, number, derivation.implied)?;
    }

    pen.heading(words::JACOBIAN)?;
    pen.lead(words::LEAD_JACOBIAN)?;
    for (general, matrix) in
        [(JACOBIAN_UNKNOWNS, derivation.jacobian_unknowns), (JACOBIAN_INPUTS, derivation.jacobian_inputs)]
    {
        pen.general_equation(&general)?;
        pen.matrix(&matrix)?;
    }

    if !derivation.groups.is_empty() {
        pen.heading(words::STRUCTURE)?;
    }
    for (index, group) in derivation.groups.iter().enumerate() {
        pen.group(index + 1, group)?;
        pen.list(words::UNKNOWN, &mut group.unknowns.iter().map(|unknown| (*unknown, None)))?;
        pen.lead(if group.position.is_empty() { words::LEAD_NEWTON } else { words::LEAD_POSITION })?;
        equations(pen, number, group.position)?;
        if let Some(root) = &group.root {
            pen.branches(root)?;
        }
        pen.lead(&system(group))?;
        if let Some(determinant) = group.determinant {
            equations(pen, number, &[determinant])?;
        }
        if let Some(inverse) = &group.inverse {
            pen.matrix(inverse)?;
        }
    }

    if let (Some(determinant), [_, _, ..]) = (derivation.determinant, derivation.groups) {
        pen.lead(words::LEAD_DETERMINANT)?;
        equations(pen, number, &[determinant])?;
    }

    pen.heading(words::RATIOS)?;
    pen.lead(words::LEAD_RATIOS)?;
    pen.general_equation(&RATIOS)?;
    pen.lead(words::LEAD_VELOCITY)?;
    pen.general_equation(&VELOCITY)?;
    if derivation.inputs.len() == 1 {
        pen.lead(words::LEAD_TRANSMISSION)?;
    }
    equations(pen, number, derivation.ratios)?;

    pen.heading(words::ACCELERATION)?;
    pen.lead(words::LEAD_ACCELERATION)?;
    pen.general_equation(&ACCELERATION)?;
    if !derivation.gamma.is_empty() {
        pen.lead(words::LEAD_GAMMA)?;
    }
    equations(pen, number, derivation.gamma)?;

    if let Some(formulas) = derivation.ratio_derivatives {
        pen.heading(words::RATIO_DERIVATIVES)?;
        pen.lead(words::LEAD_RATIO_DERIVATIVES)?;
        pen.general_equation(&RATIO_DERIVATIVES)?;
        equations(pen, number, formulas)?;
    }
    if let Some(eta) = derivation.jerk {
        pen.heading(words::JERK)?;
        pen.lead(words::LEAD_JERK)?;
        pen.general_equation(&JERK)?;
        pen.lead(words::LEAD_ETA)?;
        equations(pen, number, eta)?;
    }
    if let Some(sensitivity) = derivation.sensitivity {
        pen.heading(words::SENSITIVITY)?;
        pen.lead(words::LEAD_SENSITIVITY)?;
        pen.general_equation(&SENSITIVITY)?;
        pen.lead(words::LEAD_PARAMETERS)?;
        pen.matrix(&sensitivity.jacobian)?;
        equations(pen, number, sensitivity.formulas)?;
    }
    Ok(())
}

/// Writes the equations of motion of a scene; `number` is that of the equation before them.
pub(super) fn write_scene(scene: &SceneDerivation<'_>, pen: &mut dyn Pen, number: &mut usize) -> fmt::Result {
    pen.title(scene.scene)?;
    if !scene.parameters.is_empty() {
        pen.list(words::GIVEN, &mut scene.parameters.iter().map(|symbol| (symbol.formula, None)))?;
    }
    pen.heading(words::MOTION)?;
    pen.lead(words::LEAD_MOTION)?;
    pen.general_equation(&MOTION)?;
    if !scene.mass_matrix.is_empty() {
        pen.lead(words::LEAD_MASS_MATRIX)?;
        equations(pen, number, scene.mass_matrix)?;
    }
    pen.lead(lead_of_forces(scene))?;
    for effect in scene.forces {
        pen.lead(effect.name)?;
        equations(pen, number, effect.forces)?;
    }
    if !scene.frictions_and_stops.is_empty() {
        pen.lead(words::LEAD_CONTACTS)?;
    }
    for contact in scene.frictions_and_stops {
        pen.lead(contact.name)?;
        equations(pen, number, &[contact.along])?;
        pen.display(&contact.bound)?;
        if let Some(joint) = &contact.bearing {
            pen.lead(&bearing(joint))?;
            pen.display(&joint.formula)?;
        }
        if let Some(factor) = &contact.rebound {
            pen.lead(words::LEAD_REBOUND)?;
            pen.display(factor)?;
        }
        equations(pen, number, contact.forces)?;
    }
    if !scene.drives.is_empty() {
        pen.lead(words::LEAD_DRIVES)?;
        equations(pen, number, scene.drives)?;
    }
    if let Some(potential) = scene.potential {
        pen.heading(words::POTENTIAL)?;
        equations(pen, number, &[potential])?;
    }
    if !scene.joints.is_empty() {
        pen.heading(words::JOINTS)?;
        pen.lead(words::LEAD_JOINTS)?;
        if !scene.multipliers.is_empty() {
            pen.lead(words::LEAD_MULTIPLIERS)?;
            pen.general_equation(&MULTIPLIERS)?;
        }
        for contact in scene.contacts {
            pen.lead(&force_along(contact))?;
            pen.display(&contact.formula)?;
        }
    }
    for joint in scene.joints {
        pen.lead(joint.name)?;
        equations(pen, number, &joint.components)?;
    }
    if !scene.kernels.is_empty() {
        pen.heading(words::OPERATIONS)?;
        pen.kernels(scene.kernels)?;
    }
    Ok(())
}

/// The sentence before the generalised forces.
pub(crate) fn lead_of_forces(scene: &SceneDerivation<'_>) -> &'static str {
    match scene.forces {
        [] if scene.frictions_and_stops.is_empty() => words::LEAD_NO_FORCES,
        [] => words::LEAD_ONLY_CONTACTS,
        _ => words::LEAD_FORCES,
    }
}

/// The sentence before the force in the joint that limits a friction.
pub(crate) fn bearing(joint: &Symbol<'_>) -> String {
    format!("with the force of {}:", joint.name)
}

/// The name of the force of a friction or a stop.
pub(crate) fn force_along(contact: &Symbol<'_>) -> String {
    format!("The force of {} is", contact.name)
}

/// The sentence about velocities and accelerations of a group.
pub(crate) fn system(group: &Group<'_>) -> String {
    format!("Velocities and accelerations solve a linear system, {}.", group.method.words())
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
