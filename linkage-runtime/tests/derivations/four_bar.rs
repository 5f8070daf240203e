//! The derivation of tests/mechanisms/four_bar.rs.

use linkage_runtime::derivation::{
    Block, Derivation, Entry, Equation, Formula, Kernel, Matrix, Method, Operations, Quantity, Symbol,
};

pub const FOUR_BAR: Derivation = Derivation {
    mechanism: "FourBar",
    parameters: &[
        Symbol {
            name: "l1",
            formula: Formula { text: "l₁", latex: r"l_1", mathml: "<msub><mi>l</mi><mn>1</mn></msub>" },
        },
        Symbol {
            name: "l2",
            formula: Formula { text: "l₂", latex: r"l_2", mathml: "<msub><mi>l</mi><mn>2</mn></msub>" },
        },
        Symbol {
            name: "l3",
            formula: Formula { text: "l₃", latex: r"l_3", mathml: "<msub><mi>l</mi><mn>3</mn></msub>" },
        },
        Symbol {
            name: "l4",
            formula: Formula { text: "l₄", latex: r"l_4", mathml: "<msub><mi>l</mi><mn>4</mn></msub>" },
        },
    ],
    inputs: &[Symbol {
        name: "theta2",
        formula: Formula { text: "θ₂", latex: r"\theta_2", mathml: "<msub><mi>θ</mi><mn>2</mn></msub>" },
    }],
    unknowns: &[
        Symbol {
            name: "theta3",
            formula: Formula { text: "θ₃", latex: r"\theta_3", mathml: "<msub><mi>θ</mi><mn>3</mn></msub>" },
        },
        Symbol {
            name: "theta4",
            formula: Formula { text: "θ₄", latex: r"\theta_4", mathml: "<msub><mi>θ</mi><mn>4</mn></msub>" },
        },
    ],
    residual: &[
        Equation {
            left: Formula { text: "Ψ₁", latex: r"\Psi_1", mathml: "<msub><mi>Ψ</mi><mn>1</mn></msub>" },
            right: Formula {
                text: "l₂·cos(θ₂) + l₃·cos(θ₃) + l₄·cos(θ₄) − l₁",
                latex: r"l_2 \cos \theta_2 + l_3 \cos \theta_3 + l_4 \cos \theta_4 - l_1",
                mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mo>+</mo><mrow><msub><mi>l</mi><mn>4</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow><mo>−</mo><msub><mi>l</mi><mn>1</mn></msub></mrow>"#,
            },
        },
        Equation {
            left: Formula { text: "Ψ₂", latex: r"\Psi_2", mathml: "<msub><mi>Ψ</mi><mn>2</mn></msub>" },
            right: Formula {
                text: "l₂·sin(θ₂) + l₃·sin(θ₃) + l₄·sin(θ₄)",
                latex: r"l_2 \sin \theta_2 + l_3 \sin \theta_3 + l_4 \sin \theta_4",
                mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mo>+</mo><mrow><msub><mi>l</mi><mn>4</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow></mrow>"#,
            },
        },
    ],
    jacobian_unknowns: Matrix {
        name: Formula { text: "J", latex: r"J", mathml: "<mi>J</mi>" },
        factor: None,
        rows: 2,
        columns: 2,
        entries: &[
            Entry {
                row: 0,
                column: 0,
                value: Formula {
                    text: "−l₃·sin(θ₃)",
                    latex: r"-l_3 \sin \theta_3",
                    mathml: r#"<mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow></mrow>"#,
                },
            },
            Entry {
                row: 0,
                column: 1,
                value: Formula {
                    text: "−l₄·sin(θ₄)",
                    latex: r"-l_4 \sin \theta_4",
                    mathml: r#"<mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>4</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow></mrow>"#,
                },
            },
            Entry {
                row: 1,
                column: 0,
                value: Formula {
                    text: "l₃·cos(θ₃)",
                    latex: r"l_3 \cos \theta_3",
                    mathml: r#"<mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow>"#,
                },
            },
            Entry {
                row: 1,
                column: 1,
                value: Formula {
                    text: "l₄·cos(θ₄)",
                    latex: r"l_4 \cos \theta_4",
                    mathml: r#"<mrow><msub><mi>l</mi><mn>4</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow>"#,
                },
            },
        ],
    },
    jacobian_inputs: Matrix {
        name: Formula { text: "A", latex: r"A", mathml: "<mi>A</mi>" },
        factor: None,
        rows: 2,
        columns: 1,
        entries: &[
            Entry {
                row: 0,
                column: 0,
                value: Formula {
                    text: "−l₂·sin(θ₂)",
                    latex: r"-l_2 \sin \theta_2",
                    mathml: r#"<mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow></mrow>"#,
                },
            },
            Entry {
                row: 1,
                column: 0,
                value: Formula {
                    text: "l₂·cos(θ₂)",
                    latex: r"l_2 \cos \theta_2",
                    mathml: r#"<mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow>"#,
                },
            },
        ],
    },
    blocks: &[Block {
        unknowns: &[
            Formula { text: "θ₃", latex: r"\theta_3", mathml: "<msub><mi>θ</mi><mn>3</mn></msub>" },
            Formula { text: "θ₄", latex: r"\theta_4", mathml: "<msub><mi>θ</mi><mn>4</mn></msub>" },
        ],
        equations: &[0, 1],
        method: Method::ClosedForm,
        determinant: Some(Equation {
            left: Formula {
                text: "det J",
                latex: r"\det J",
                mathml: r#"<mrow><mi>det</mi><mo rspace="0.17em">⁡</mo><mi>J</mi></mrow>"#,
            },
            right: Formula {
                text: "−l₃·l₄·sin(θ₃ − θ₄)",
                latex: r"-l_3 l_4 \sin(\theta_3 - \theta_4)",
                mathml: r#"<mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo>⁢</mo><msub><mi>l</mi><mn>4</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo>⁡</mo><mrow><mo>(</mo><mrow><msub><mi>θ</mi><mn>3</mn></msub><mo>−</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow><mo>)</mo></mrow></mrow></mrow></mrow>"#,
            },
        }),
        inverse: Some(Matrix {
            name: Formula {
                text: "J⁻¹",
                latex: r"J^{-1}",
                mathml: "<msup><mi>J</mi><mrow><mo>−</mo><mn>1</mn></mrow></msup>",
            },
            rows: 2,
            columns: 2,
            entries: &[
                Entry {
                    row: 0,
                    column: 0,
                    value: Formula {
                        text: "l₄·cos(θ₄)/det J",
                        latex: r"\frac{l_4 \cos \theta_4}{\det J}",
                        mathml: r#"<mfrac><mrow><msub><mi>l</mi><mn>4</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow><mrow><mi>det</mi><mo rspace="0.17em">⁡</mo><mi>J</mi></mrow></mfrac>"#,
                    },
                },
                Entry {
                    row: 0,
                    column: 1,
                    value: Formula {
                        text: "l₄·sin(θ₄)/det J",
                        latex: r"\frac{l_4 \sin \theta_4}{\det J}",
                        mathml: r#"<mfrac><mrow><msub><mi>l</mi><mn>4</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow><mrow><mi>det</mi><mo rspace="0.17em">⁡</mo><mi>J</mi></mrow></mfrac>"#,
                    },
                },
                Entry {
                    row: 1,
                    column: 0,
                    value: Formula {
                        text: "−l₃·cos(θ₃)/det J",
                        latex: r"-\frac{l_3 \cos \theta_3}{\det J}",
                        mathml: r#"<mrow><mo>−</mo><mfrac><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mrow><mi>det</mi><mo rspace="0.17em">⁡</mo><mi>J</mi></mrow></mfrac></mrow>"#,
                    },
                },
                Entry {
                    row: 1,
                    column: 1,
                    value: Formula {
                        text: "−l₃·sin(θ₃)/det J",
                        latex: r"-\frac{l_3 \sin \theta_3}{\det J}",
                        mathml: r#"<mrow><mo>−</mo><mfrac><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mrow><mi>det</mi><mo rspace="0.17em">⁡</mo><mi>J</mi></mrow></mfrac></mrow>"#,
                    },
                },
            ],
        }),
    }],
    determinant: None,
    ratios: &[
        Equation {
            left: Formula {
                text: "∂θ₃/∂θ₂",
                latex: r"\frac{\partial \theta_3}{\partial \theta_2}",
                mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
            },
            right: Formula {
                text: "−l₂·sin(θ₂ − θ₄)/(l₃·sin(θ₃ − θ₄))",
                latex: r"-\frac{l_2 \sin(\theta_2 - \theta_4)}{l_3 \sin(\theta_3 - \theta_4)}",
                mathml: r#"<mrow><mo>−</mo><mfrac><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo>⁡</mo><mrow><mo>(</mo><mrow><msub><mi>θ</mi><mn>2</mn></msub><mo>−</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow><mo>)</mo></mrow></mrow></mrow><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo>⁡</mo><mrow><mo>(</mo><mrow><msub><mi>θ</mi><mn>3</mn></msub><mo>−</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow><mo>)</mo></mrow></mrow></mrow></mfrac></mrow>"#,
            },
        },
        Equation {
            left: Formula {
                text: "∂θ₄/∂θ₂",
                latex: r"\frac{\partial \theta_4}{\partial \theta_2}",
                mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
            },
            right: Formula {
                text: "l₂·sin(θ₂ − θ₃)/(l₄·sin(θ₃ − θ₄))",
                latex: r"\frac{l_2 \sin(\theta_2 - \theta_3)}{l_4 \sin(\theta_3 - \theta_4)}",
                mathml: r#"<mfrac><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo>⁡</mo><mrow><mo>(</mo><mrow><msub><mi>θ</mi><mn>2</mn></msub><mo>−</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow><mo>)</mo></mrow></mrow></mrow><mrow><msub><mi>l</mi><mn>4</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo>⁡</mo><mrow><mo>(</mo><mrow><msub><mi>θ</mi><mn>3</mn></msub><mo>−</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow><mo>)</mo></mrow></mrow></mrow></mfrac>"#,
            },
        },
    ],
    gamma: &[
        Equation {
            left: Formula { text: "γ₁", latex: r"\gamma_1", mathml: "<msub><mi>γ</mi><mn>1</mn></msub>" },
            right: Formula {
                text: "−l₂·θ̇₂²·cos(θ₂) − l₃·θ̇₃²·cos(θ₃) − l₄·θ̇₄²·cos(θ₄)",
                latex: r"-l_2 \dot{\theta}_2^2 \cos \theta_2 - l_3 \dot{\theta}_3^2 \cos \theta_3 - l_4 \dot{\theta}_4^2 \cos \theta_4",
                mathml: r#"<mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>2</mn></msub><mo>⁢</mo><msubsup><mpadded height="0.75em"><mover><mi>θ</mi><mo>˙</mo></mover></mpadded><mn>2</mn><mn>2</mn></msubsup><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo>⁢</mo><msubsup><mpadded height="0.75em"><mover><mi>θ</mi><mo>˙</mo></mover></mpadded><mn>3</mn><mn>2</mn></msubsup><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>4</mn></msub><mo>⁢</mo><msubsup><mpadded height="0.75em"><mover><mi>θ</mi><mo>˙</mo></mover></mpadded><mn>4</mn><mn>2</mn></msubsup><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow></mrow>"#,
            },
        },
        Equation {
            left: Formula { text: "γ₂", latex: r"\gamma_2", mathml: "<msub><mi>γ</mi><mn>2</mn></msub>" },
            right: Formula {
                text: "−l₂·θ̇₂²·sin(θ₂) − l₃·θ̇₃²·sin(θ₃) − l₄·θ̇₄²·sin(θ₄)",
                latex: r"-l_2 \dot{\theta}_2^2 \sin \theta_2 - l_3 \dot{\theta}_3^2 \sin \theta_3 - l_4 \dot{\theta}_4^2 \sin \theta_4",
                mathml: r#"<mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>2</mn></msub><mo>⁢</mo><msubsup><mpadded height="0.75em"><mover><mi>θ</mi><mo>˙</mo></mover></mpadded><mn>2</mn><mn>2</mn></msubsup><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo>⁢</mo><msubsup><mpadded height="0.75em"><mover><mi>θ</mi><mo>˙</mo></mover></mpadded><mn>3</mn><mn>2</mn></msubsup><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>4</mn></msub><mo>⁢</mo><msubsup><mpadded height="0.75em"><mover><mi>θ</mi><mo>˙</mo></mover></mpadded><mn>4</mn><mn>2</mn></msubsup><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow></mrow>"#,
            },
        },
    ],
    points: &[
        Quantity {
            name: "b",
            value: &[
                Equation {
                    left: Formula { text: "x_b", latex: r"x_{b}", mathml: "<msub><mi>x</mi><mi>b</mi></msub>" },
                    right: Formula {
                        text: "l₂·cos(θ₂)",
                        latex: r"l_2 \cos \theta_2",
                        mathml: r#"<mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow>"#,
                    },
                },
                Equation {
                    left: Formula { text: "y_b", latex: r"y_{b}", mathml: "<msub><mi>y</mi><mi>b</mi></msub>" },
                    right: Formula {
                        text: "l₂·sin(θ₂)",
                        latex: r"l_2 \sin \theta_2",
                        mathml: r#"<mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow>"#,
                    },
                },
            ],
            ratios: &[
                Equation {
                    left: Formula {
                        text: "∂x_b/∂θ₂",
                        latex: r"\frac{\partial x_{b}}{\partial \theta_2}",
                        mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>x</mi><mi>b</mi></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
                    },
                    right: Formula {
                        text: "−l₂·sin(θ₂)",
                        latex: r"-l_2 \sin \theta_2",
                        mathml: r#"<mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow></mrow>"#,
                    },
                },
                Equation {
                    left: Formula {
                        text: "∂y_b/∂θ₂",
                        latex: r"\frac{\partial y_{b}}{\partial \theta_2}",
                        mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>y</mi><mi>b</mi></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
                    },
                    right: Formula {
                        text: "l₂·cos(θ₂)",
                        latex: r"l_2 \cos \theta_2",
                        mathml: r#"<mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow>"#,
                    },
                },
            ],
        },
        Quantity {
            name: "c",
            value: &[
                Equation {
                    left: Formula { text: "x_c", latex: r"x_{c}", mathml: "<msub><mi>x</mi><mi>c</mi></msub>" },
                    right: Formula {
                        text: "l₂·cos(θ₂) + l₃·cos(θ₃)",
                        latex: r"l_2 \cos \theta_2 + l_3 \cos \theta_3",
                        mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow></mrow>"#,
                    },
                },
                Equation {
                    left: Formula { text: "y_c", latex: r"y_{c}", mathml: "<msub><mi>y</mi><mi>c</mi></msub>" },
                    right: Formula {
                        text: "l₂·sin(θ₂) + l₃·sin(θ₃)",
                        latex: r"l_2 \sin \theta_2 + l_3 \sin \theta_3",
                        mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow></mrow>"#,
                    },
                },
            ],
            ratios: &[
                Equation {
                    left: Formula {
                        text: "∂x_c/∂θ₂",
                        latex: r"\frac{\partial x_{c}}{\partial \theta_2}",
                        mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>x</mi><mi>c</mi></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
                    },
                    right: Formula {
                        text: "−l₂·sin(θ₂) − l₃·(∂θ₃/∂θ₂)·sin(θ₃)",
                        latex: r"-l_2 \sin \theta_2 - l_3 \frac{\partial \theta_3}{\partial \theta_2} \sin \theta_3",
                        mathml: r#"<mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo>⁢</mo><mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow></mrow>"#,
                    },
                },
                Equation {
                    left: Formula {
                        text: "∂y_c/∂θ₂",
                        latex: r"\frac{\partial y_{c}}{\partial \theta_2}",
                        mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>y</mi><mi>c</mi></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
                    },
                    right: Formula {
                        text: "l₂·cos(θ₂) + l₃·(∂θ₃/∂θ₂)·cos(θ₃)",
                        latex: r"l_2 \cos \theta_2 + l_3 \frac{\partial \theta_3}{\partial \theta_2} \cos \theta_3",
                        mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo>⁢</mo><mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow></mrow>"#,
                    },
                },
            ],
        },
        Quantity {
            name: "g2",
            value: &[
                Equation {
                    left: Formula {
                        text: "x_g2",
                        latex: r"x_{\mathrm{g2}}",
                        mathml: "<msub><mi>x</mi><mi>g2</mi></msub>",
                    },
                    right: Formula {
                        text: "l₂·cos(θ₂)/2",
                        latex: r"\frac{l_2 \cos \theta_2}{2}",
                        mathml: r#"<mfrac><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mn>2</mn></mfrac>"#,
                    },
                },
                Equation {
                    left: Formula {
                        text: "y_g2",
                        latex: r"y_{\mathrm{g2}}",
                        mathml: "<msub><mi>y</mi><mi>g2</mi></msub>",
                    },
                    right: Formula {
                        text: "l₂·sin(θ₂)/2",
                        latex: r"\frac{l_2 \sin \theta_2}{2}",
                        mathml: r#"<mfrac><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mn>2</mn></mfrac>"#,
                    },
                },
            ],
            ratios: &[
                Equation {
                    left: Formula {
                        text: "∂x_g2/∂θ₂",
                        latex: r"\frac{\partial x_{\mathrm{g2}}}{\partial \theta_2}",
                        mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>x</mi><mi>g2</mi></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
                    },
                    right: Formula {
                        text: "−l₂·sin(θ₂)/2",
                        latex: r"-\frac{l_2 \sin \theta_2}{2}",
                        mathml: r#"<mrow><mo>−</mo><mfrac><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mn>2</mn></mfrac></mrow>"#,
                    },
                },
                Equation {
                    left: Formula {
                        text: "∂y_g2/∂θ₂",
                        latex: r"\frac{\partial y_{\mathrm{g2}}}{\partial \theta_2}",
                        mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>y</mi><mi>g2</mi></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
                    },
                    right: Formula {
                        text: "l₂·cos(θ₂)/2",
                        latex: r"\frac{l_2 \cos \theta_2}{2}",
                        mathml: r#"<mfrac><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mn>2</mn></mfrac>"#,
                    },
                },
            ],
        },
        Quantity {
            name: "g3",
            value: &[
                Equation {
                    left: Formula {
                        text: "x_g3",
                        latex: r"x_{\mathrm{g3}}",
                        mathml: "<msub><mi>x</mi><mi>g3</mi></msub>",
                    },
                    right: Formula {
                        text: "l₂·cos(θ₂) + l₃·cos(θ₃)/2",
                        latex: r"l_2 \cos \theta_2 + \frac{l_3 \cos \theta_3}{2}",
                        mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mfrac><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mn>2</mn></mfrac></mrow>"#,
                    },
                },
                Equation {
                    left: Formula {
                        text: "y_g3",
                        latex: r"y_{\mathrm{g3}}",
                        mathml: "<msub><mi>y</mi><mi>g3</mi></msub>",
                    },
                    right: Formula {
                        text: "l₂·sin(θ₂) + l₃·sin(θ₃)/2",
                        latex: r"l_2 \sin \theta_2 + \frac{l_3 \sin \theta_3}{2}",
                        mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mfrac><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mn>2</mn></mfrac></mrow>"#,
                    },
                },
            ],
            ratios: &[
                Equation {
                    left: Formula {
                        text: "∂x_g3/∂θ₂",
                        latex: r"\frac{\partial x_{\mathrm{g3}}}{\partial \theta_2}",
                        mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>x</mi><mi>g3</mi></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
                    },
                    right: Formula {
                        text: "−l₂·sin(θ₂) − l₃·(∂θ₃/∂θ₂)·sin(θ₃)/2",
                        latex: r"-l_2 \sin \theta_2 - \frac{l_3 \frac{\partial \theta_3}{\partial \theta_2} \sin \theta_3}{2}",
                        mathml: r#"<mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>−</mo><mfrac><mrow><msub><mi>l</mi><mn>3</mn></msub><mo>⁢</mo><mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mn>2</mn></mfrac></mrow>"#,
                    },
                },
                Equation {
                    left: Formula {
                        text: "∂y_g3/∂θ₂",
                        latex: r"\frac{\partial y_{\mathrm{g3}}}{\partial \theta_2}",
                        mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>y</mi><mi>g3</mi></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
                    },
                    right: Formula {
                        text: "l₂·cos(θ₂) + l₃·(∂θ₃/∂θ₂)·cos(θ₃)/2",
                        latex: r"l_2 \cos \theta_2 + \frac{l_3 \frac{\partial \theta_3}{\partial \theta_2} \cos \theta_3}{2}",
                        mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mfrac><mrow><msub><mi>l</mi><mn>3</mn></msub><mo>⁢</mo><mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mn>2</mn></mfrac></mrow>"#,
                    },
                },
            ],
        },
        Quantity {
            name: "g4",
            value: &[
                Equation {
                    left: Formula {
                        text: "x_g4",
                        latex: r"x_{\mathrm{g4}}",
                        mathml: "<msub><mi>x</mi><mi>g4</mi></msub>",
                    },
                    right: Formula {
                        text: "l₂·cos(θ₂) + l₃·cos(θ₃) + l₄·cos(θ₄)/2",
                        latex: r"l_2 \cos \theta_2 + l_3 \cos \theta_3 + \frac{l_4 \cos \theta_4}{2}",
                        mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mo>+</mo><mfrac><mrow><msub><mi>l</mi><mn>4</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow><mn>2</mn></mfrac></mrow>"#,
                    },
                },
                Equation {
                    left: Formula {
                        text: "y_g4",
                        latex: r"y_{\mathrm{g4}}",
                        mathml: "<msub><mi>y</mi><mi>g4</mi></msub>",
                    },
                    right: Formula {
                        text: "l₂·sin(θ₂) + l₃·sin(θ₃) + l₄·sin(θ₄)/2",
                        latex: r"l_2 \sin \theta_2 + l_3 \sin \theta_3 + \frac{l_4 \sin \theta_4}{2}",
                        mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mo>+</mo><mfrac><mrow><msub><mi>l</mi><mn>4</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow><mn>2</mn></mfrac></mrow>"#,
                    },
                },
            ],
            ratios: &[
                Equation {
                    left: Formula {
                        text: "∂x_g4/∂θ₂",
                        latex: r"\frac{\partial x_{\mathrm{g4}}}{\partial \theta_2}",
                        mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>x</mi><mi>g4</mi></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
                    },
                    right: Formula {
                        text: "−l₂·sin(θ₂) − l₃·(∂θ₃/∂θ₂)·sin(θ₃) − l₄·(∂θ₄/∂θ₂)·sin(θ₄)/2",
                        latex: r"-l_2 \sin \theta_2 - l_3 \frac{\partial \theta_3}{\partial \theta_2} \sin \theta_3 - \frac{l_4 \frac{\partial \theta_4}{\partial \theta_2} \sin \theta_4}{2}",
                        mathml: r#"<mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>−</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo>⁢</mo><mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mo>−</mo><mfrac><mrow><msub><mi>l</mi><mn>4</mn></msub><mo>⁢</mo><mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac><mo rspace="0.17em">⁢</mo><mrow><mi>sin</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow><mn>2</mn></mfrac></mrow>"#,
                    },
                },
                Equation {
                    left: Formula {
                        text: "∂y_g4/∂θ₂",
                        latex: r"\frac{\partial y_{\mathrm{g4}}}{\partial \theta_2}",
                        mathml: "<mfrac><mrow><mo>∂</mo><msub><mi>y</mi><mi>g4</mi></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
                    },
                    right: Formula {
                        text: "l₂·cos(θ₂) + l₃·(∂θ₃/∂θ₂)·cos(θ₃) + l₄·(∂θ₄/∂θ₂)·cos(θ₄)/2",
                        latex: r"l_2 \cos \theta_2 + l_3 \frac{\partial \theta_3}{\partial \theta_2} \cos \theta_3 + \frac{l_4 \frac{\partial \theta_4}{\partial \theta_2} \cos \theta_4}{2}",
                        mathml: r#"<mrow><mrow><msub><mi>l</mi><mn>2</mn></msub><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mrow><mo>+</mo><mrow><msub><mi>l</mi><mn>3</mn></msub><mo>⁢</mo><mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow></mrow><mo>+</mo><mfrac><mrow><msub><mi>l</mi><mn>4</mn></msub><mo>⁢</mo><mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac><mo rspace="0.17em">⁢</mo><mrow><mi>cos</mi><mo rspace="0.17em">⁡</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow></mrow><mn>2</mn></mfrac></mrow>"#,
                    },
                },
            ],
        },
    ],
    outputs: &[Quantity {
        name: "mu",
        value: &[Equation {
            left: Formula { text: "μ", latex: r"\mu", mathml: "<mi>μ</mi>" },
            right: Formula {
                text: "θ₃ − θ₄",
                latex: r"\theta_3 - \theta_4",
                mathml: "<mrow><msub><mi>θ</mi><mn>3</mn></msub><mo>−</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow>",
            },
        }],
        ratios: &[Equation {
            left: Formula {
                text: "∂μ/∂θ₂",
                latex: r"\frac{\partial \mu}{\partial \theta_2}",
                mathml: "<mfrac><mrow><mo>∂</mo><mi>μ</mi></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac>",
            },
            right: Formula {
                text: "∂θ₃/∂θ₂ − ∂θ₄/∂θ₂",
                latex: r"\frac{\partial \theta_3}{\partial \theta_2} - \frac{\partial \theta_4}{\partial \theta_2}",
                mathml: "<mrow><mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>3</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac><mo>−</mo><mfrac><mrow><mo>∂</mo><msub><mi>θ</mi><mn>4</mn></msub></mrow><mrow><mo>∂</mo><msub><mi>θ</mi><mn>2</mn></msub></mrow></mfrac></mrow>",
            },
        }],
    }],
    conditions: &[Formula {
        text: "l₃ ≠ 0",
        latex: "l_3 \\neq 0",
        mathml: "<mrow><msub><mi>l</mi><mn>3</mn></msub><mo>≠</mo><mn>0</mn></mrow>",
    }],
    kernels: &[
        Kernel {
            function: "residual",
            operations: Operations { functions: 0, divisions: 0, multiplications: 6, additions: 5 },
        },
        Kernel {
            function: "velocity_ratios",
            operations: Operations { functions: 3, divisions: 2, multiplications: 4, additions: 3 },
        },
        Kernel {
            function: "motion",
            operations: Operations { functions: 9, divisions: 4, multiplications: 41, additions: 27 },
        },
    ],
};
