//! The outline of an analysis by hand, line by line.

use core::fmt;

use linkage_runtime::derivation::{ChainVector, DriverChoice, FormulaMatrix, PointVectors, SheetDerivation, Turning};

use super::outline::{GeneralEquation, Lines, equations};

macro_rules! mi {
    ($letter:literal) => {
        concat!("<mi>", $letter, "</mi>")
    };
}

macro_rules! mo {
    ($sign:literal) => {
        concat!("<mo>", $sign, "</mo>")
    };
}

/// A letter with dots.
macro_rules! over {
    ($letter:literal, $dots:literal) => {
        concat!("<mover><mi>", $letter, "</mi><mo>", $dots, "</mo></mover>")
    };
}

macro_rules! sub {
    ($letter:literal, $index:literal) => {
        concat!("<msub><mi>", $letter, "</mi><mi>", $index, "</mi></msub>")
    };
}

macro_rules! row {
    ($($part:expr),+ $(,)?) => {
        concat!("<mrow>", $($part),+, "</mrow>")
    };
}

/// ∂(a·ḃ)/∂c.
macro_rules! partial {
    ($matrix:literal, $rate:literal, $by:literal) => {
        concat!(
            "<mfrac><mrow><mo>∂</mo><mrow><mo>(</mo><mi>",
            $matrix,
            "</mi><mover><mi>",
            $rate,
            "</mi><mo>˙</mo></mover><mo>)</mo></mrow></mrow><mrow><mo>∂</mo><mi>",
            $by,
            "</mi></mrow></mfrac>"
        )
    };
}

const SECOND_DERIVATIVE: GeneralEquation = GeneralEquation {
    text: "J·ü + A·v̈ + J̇·u̇ + Ȧ·v̇ = 0",
    latex: "J \\ddot{u} + A \\ddot{v} + \\dot{J} \\dot{u} + \\dot{A} \\dot{v} = 0",
    mathml: row!(
        mi!("J"),
        over!("u", "¨"),
        mo!("+"),
        mi!("A"),
        over!("v", "¨"),
        mo!("+"),
        over!("J", "˙"),
        over!("u", "˙"),
        mo!("+"),
        over!("A", "˙"),
        over!("v", "˙"),
        mo!("="),
        "<mn>0</mn>"
    ),
};

const UNKNOWNS_RATE: GeneralEquation = GeneralEquation {
    text: "J̇ = ∂(J·u̇)/∂u + ∂(A·v̇)/∂u",
    latex: "\\dot{J} = \\frac{\\partial (J \\dot{u})}{\\partial u} + \\frac{\\partial (A \\dot{v})}{\\partial u}",
    mathml: row!(over!("J", "˙"), mo!("="), partial!("J", "u", "u"), mo!("+"), partial!("A", "v", "u")),
};

const INPUTS_RATE: GeneralEquation = GeneralEquation {
    text: "Ȧ = ∂(J·u̇)/∂v + ∂(A·v̇)/∂v",
    latex: "\\dot{A} = \\frac{\\partial (J \\dot{u})}{\\partial v} + \\frac{\\partial (A \\dot{v})}{\\partial v}",
    mathml: row!(over!("A", "˙"), mo!("="), partial!("J", "u", "v"), mo!("+"), partial!("A", "v", "v")),
};

const GAMMA: GeneralEquation = GeneralEquation {
    text: "γ = J̇·u̇ + Ȧ·v̇ = γ_u + γ_v + γ_uv",
    latex: "\\gamma = \\dot{J} \\dot{u} + \\dot{A} \\dot{v} = \\gamma_u + \\gamma_v + \\gamma_{uv}",
    mathml: row!(
        mi!("γ"),
        mo!("="),
        over!("J", "˙"),
        over!("u", "˙"),
        mo!("+"),
        over!("A", "˙"),
        over!("v", "˙"),
        mo!("="),
        sub!("γ", "u"),
        mo!("+"),
        sub!("γ", "v"),
        mo!("+"),
        sub!("γ", "uv")
    ),
};

const TERMS: GeneralEquation = GeneralEquation {
    text: "H₁ = A·v̈, H₂ = J̇·W·v̇, H₃ = Ȧ·v̇, H₀ = H₁ + H₂ + H₃",
    latex: "H_1 = A \\ddot{v}, \\quad H_2 = \\dot{J} W \\dot{v}, \\quad H_3 = \\dot{A} \\dot{v}, \\quad \
            H_0 = H_1 + H_2 + H_3",
    mathml: row!(
        sub!("H", "1"),
        mo!("="),
        mi!("A"),
        over!("v", "¨"),
        mo!(","),
        sub!("H", "2"),
        mo!("="),
        over!("J", "˙"),
        mi!("W"),
        over!("v", "˙"),
        mo!(","),
        sub!("H", "3"),
        mo!("="),
        over!("A", "˙"),
        over!("v", "˙"),
        mo!(","),
        sub!("H", "0"),
        mo!("="),
        sub!("H", "1"),
        mo!("+"),
        sub!("H", "2"),
        mo!("+"),
        sub!("H", "3")
    ),
};

const FIRST: GeneralEquation = GeneralEquation {
    text: "ü = −J⁻¹·H₀",
    latex: "\\ddot{u} = -J^{-1} H_0",
    mathml: row!(
        over!("u", "¨"),
        mo!("="),
        mo!("−"),
        "<msup><mi>J</mi><mrow><mo>−</mo><mn>1</mn></mrow></msup>",
        sub!("H", "0")
    ),
};

const SECOND: GeneralEquation = GeneralEquation {
    text: "ü = W·v̈ − J⁻¹·γ",
    latex: "\\ddot{u} = W \\ddot{v} - J^{-1} \\gamma",
    mathml: row!(
        over!("u", "¨"),
        mo!("="),
        mi!("W"),
        over!("v", "¨"),
        mo!("−"),
        "<msup><mi>J</mi><mrow><mo>−</mo><mn>1</mn></mrow></msup>",
        mi!("γ")
    ),
};

const DIFFERENCE: GeneralEquation = GeneralEquation {
    text: "W·v̈ − J⁻¹·γ + J⁻¹·H₀ = J⁻¹·J̇·(W·v̇ − u̇) = 0",
    latex: "W \\ddot{v} - J^{-1} \\gamma + J^{-1} H_0 = J^{-1} \\dot{J} (W \\dot{v} - \\dot{u}) = 0",
    mathml: row!(
        mi!("W"),
        over!("v", "¨"),
        mo!("−"),
        "<msup><mi>J</mi><mrow><mo>−</mo><mn>1</mn></mrow></msup>",
        mi!("γ"),
        mo!("+"),
        "<msup><mi>J</mi><mrow><mo>−</mo><mn>1</mn></mrow></msup>",
        sub!("H", "0"),
        mo!("="),
        "<msup><mi>J</mi><mrow><mo>−</mo><mn>1</mn></mrow></msup>",
        over!("J", "˙"),
        mo!("("),
        mi!("W"),
        over!("v", "˙"),
        mo!("−"),
        over!("u", "˙"),
        mo!(")"),
        mo!("="),
        "<mn>0</mn>"
    ),
};

const RIGID: GeneralEquation = GeneralEquation {
    text: "v = v₀ + Ω·r, a = a₀ + Ω²·r + α·r",
    latex: "v = v_0 + \\Omega r, \\quad a = a_0 + \\Omega^2 r + \\alpha r",
    mathml: row!(
        mi!("v"),
        mo!("="),
        sub!("v", "0"),
        mo!("+"),
        mi!("Ω"),
        mi!("r"),
        mo!(","),
        mi!("a"),
        mo!("="),
        sub!("a", "0"),
        mo!("+"),
        "<msup><mi>Ω</mi><mn>2</mn></msup>",
        mi!("r"),
        mo!("+"),
        mi!("α"),
        mi!("r")
    ),
};

const SUM: GeneralEquation = GeneralEquation {
    text: "Ṗ = M₁·w₁ + M₂·w₂ + …, w = (ż, φ̇)",
    latex: "\\dot{P} = M_1 w_1 + M_2 w_2 + \\dots, \\quad w = (\\dot{z}, \\dot{\\varphi})",
    mathml: row!(
        over!("P", "˙"),
        mo!("="),
        sub!("M", "1"),
        sub!("w", "1"),
        mo!("+"),
        sub!("M", "2"),
        sub!("w", "2"),
        mo!("+"),
        mo!("…"),
        mo!(","),
        mi!("w"),
        mo!("="),
        mo!("("),
        over!("z", "˙"),
        mo!(","),
        over!("φ", "˙"),
        mo!(")")
    ),
};

const SINGULAR: GeneralEquation = GeneralEquation {
    text: "det J = 0",
    latex: "\\det J = 0",
    mathml: row!("<mi>det</mi>", "<mo rspace=\"0.17em\">\u{2061}</mo>", mi!("J"), mo!("="), "<mn>0</mn>"),
};

/// Writes an analysis by hand without its conditions; `number` is that of the equation before it.
pub(crate) fn write(sheet: &SheetDerivation<'_>, pen: &mut dyn Lines, number: &mut usize) -> fmt::Result {
    let words = pen.words();
    let [jacobian_rate, input_rate] = &sheet.jacobian_rates;
    if jacobian_rate.rows > 0 {
        pen.heading(words.jacobian_rates)?;
        pen.lead(words.lead_acceleration)?;
        pen.general_equation(&SECOND_DERIVATIVE)?;
        pen.lead(words.lead_jacobian_rates)?;
        pen.matrix(jacobian_rate)?;
        pen.matrix(input_rate)?;
        pen.lead(words.lead_chain_rule)?;
        pen.general_equation(&UNKNOWNS_RATE)?;
        pen.general_equation(&INPUTS_RATE)?;
        pen.lead(words.lead_first_and_last)?;
        let [of_unknowns, of_inputs] = &sheet.jacobians_of_rates;
        pen.matrix(of_unknowns)?;
        pen.matrix(of_inputs)?;
        pen.lead(match of_unknowns.entries == jacobian_rate.entries && of_inputs.entries == input_rate.entries {
            true => words.are_jacobian_rates,
            false => words.are_no_jacobian_rates,
        })?;

        pen.heading(words.gamma)?;
        pen.general_equation(&GAMMA)?;
        let [by_unknowns, by_inputs, mixed] = &sheet.gamma;
        pen.matrix(by_unknowns)?;
        pen.matrix(by_inputs)?;
        match mixed.entries {
            [] => pen.lead(words.no_mixed_gamma)?,
            _ => pen.matrix(mixed)?,
        }

        pen.heading(words.acceleration_by_jacobians)?;
        pen.general_equation(&TERMS)?;
        for term in &sheet.terms {
            pen.matrix(term)?;
        }
        pen.general_equation(&FIRST)?;
        let [first, second] = sheet.accelerations;
        equations(pen, number, first)?;

        pen.heading(words.acceleration_by_gamma)?;
        pen.general_equation(&SECOND)?;
        equations(pen, number, second)?;
        pen.lead(words.lead_both_equal)?;
        pen.general_equation(&DIFFERENCE)?;
    }
    if !sheet.choices.is_empty() && jacobian_rate.rows > 0 {
        pen.heading(words.choices)?;
        pen.lead(words.lead_choices)?;
        pen.general_equation(&SINGULAR)?;
        for DriverChoice { inputs, determinant } in sheet.choices {
            match determinant {
                Some(determinant) => equations(pen, number, &[*determinant])?,
                None => {
                    let names: Vec<String> = inputs.iter().map(ToString::to_string).collect();
                    pen.lead(&(words.no_determinant)(&names.join(", ")))?;
                }
            }
        }
    }
    if !sheet.turning.is_empty() {
        pen.heading(words.turning)?;
        pen.lead(words.lead_turning)?;
        pen.general_equation(&RIGID)?;
        for Turning { rate, acceleration, .. } in sheet.turning {
            pen.matrix(rate)?;
            pen.matrix(acceleration)?;
        }
    }
    if !sheet.points.is_empty() {
        pen.heading(words.vectors)?;
        pen.lead(words.lead_vectors)?;
        pen.general_equation(&SUM)?;
        for ChainVector { vector, matrix, rates, velocity, acceleration } in sheet.vectors {
            for part in [vector, matrix, rates, velocity, acceleration] {
                if !part.entries.is_empty() {
                    pen.matrix(part)?;
                }
            }
        }
        for PointVectors { name, vectors, sums } in sheet.points {
            pen.lead(name)?;
            let all = || vectors.iter().filter_map(|&place| sheet.vectors.get(place));
            let parts: [Vec<&FormulaMatrix<'_>>; 3] = [
                all().map(|of| &of.vector).collect(),
                all().map(|of| &of.velocity).collect(),
                all().map(|of| &of.acceleration).collect(),
            ];
            for (sum, parts) in sums.iter().zip(&parts) {
                *number += 1;
                pen.sum(*number, sum, parts)?;
            }
        }
    }
    Ok(())
}
