//! The derivation of the four-bar in words.

mod derivations;

use derivations::four_bar::FOUR_BAR;

#[test]
fn text_holds_the_whole_derivation() {
    let text = FOUR_BAR.to_string();
    for line in [
        "FourBar",
        "  Unknown  θ₃, θ₄",
        "  (1)   Ψ₁ = l₂·cos(θ₂) + l₃·cos(θ₃) + l₄·cos(θ₄) − l₁",
        "        J[1, 1] = −l₃·sin(θ₃)",
        "  Block 1: equations (1), (2), solved in closed form",
        "  (3)   det J = −l₃·l₄·sin(θ₃ − θ₄)",
        "  (4)   ∂θ₃/∂θ₂ = −l₂·sin(θ₂ − θ₄)/(l₃·sin(θ₃ − θ₄))",
        "        l₃ ≠ 0",
    ] {
        assert!(text.lines().any(|found| found == line), "{line:?} is not in\n{text}");
    }
}

#[cfg(feature = "std")]
#[test]
fn latex_is_balanced() {
    let latex = FOUR_BAR.to_latex();
    for (opening, closing) in [("{", "}"), ("\\begin", "\\end"), ("\\[", "\\]"), ("\\left", "\\right")] {
        assert_eq!(latex.matches(opening).count(), latex.matches(closing).count(), "{opening}");
    }
    assert!(
        latex.contains("\\frac{\\partial \\theta_3}{\\partial \\theta_2} = -\\frac{l_2 \\sin(\\theta_2 - \\theta_4)}")
    );
    assert!(latex.contains("  -l_3 \\sin \\theta_3 & -l_4 \\sin \\theta_4 \\\\"));
}
