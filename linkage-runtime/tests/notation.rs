//! Formulas in their three notations, from their source.

use linkage_runtime::derivation::formula;

/// A formula in Unicode, LaTeX and MathML.
fn all(source: &'static str) -> [String; 3] {
    let formula = formula(source);
    let (latex, mathml) = (formula.latex().to_string(), formula.mathml().to_string());
    assert_balanced(&mathml);
    assert_eq!(latex.matches('{').count(), latex.matches('}').count(), "{latex}");
    assert_eq!(latex.matches("\\left").count(), latex.matches("\\right").count(), "{latex}");
    [formula.to_string(), latex, mathml]
}

/// One element in which every element is closed.
fn assert_balanced(mathml: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut roots = 0;
    for piece in mathml.split('<').skip(1) {
        let (tag, text) = piece.split_once('>').unwrap_or_else(|| panic!("no end of a tag in {mathml}"));
        let tag = tag.split(' ').next().unwrap_or(tag);
        match tag.strip_prefix('/') {
            Some(tag) => assert_eq!(open.pop(), Some(tag), "{mathml}"),
            None => {
                roots += usize::from(open.is_empty());
                open.push(tag);
            }
        }
        assert!(
            !text.contains(['<', '>'])
                && (text.is_empty() || open.last().is_some_and(|tag| ["mi", "mn", "mo", "mtext"].contains(tag)))
        );
    }
    assert!(open.is_empty() && roots == 1 && mathml.starts_with('<'), "{mathml}");
}

/// The formula in Unicode and LaTeX.
#[track_caller]
fn assert_shown(source: &'static str, unicode: &str, latex: &str) {
    assert_eq!(all(source)[..2], [unicode, latex]);
}

#[test]
fn determinant_of_the_four_bar() {
    let [unicode, latex, mathml] = all("-l3*l4*sin(theta3 - theta4)");
    assert_eq!(unicode, "−l₃·l₄·sin(θ₃ − θ₄)");
    assert_eq!(latex, "-l_3 l_4 \\sin(\\theta_3 - \\theta_4)");
    let sub = |base: &str, index: u8| format!("<msub><mi>{base}</mi><mn>{index}</mn></msub>");
    assert_eq!(
        mathml,
        format!(
            "<mrow><mo>−</mo><mrow>{}<mo>\u{2062}</mo>{}<mo rspace=\"0.17em\">\u{2062}</mo><mrow><mi>sin</mi><mo>\u{2061}</mo><mrow>\
             <mo>(</mo><mrow>{}<mo>−</mo>{}</mrow><mo>)</mo></mrow></mrow></mrow></mrow>",
            sub("l", 3),
            sub("l", 4),
            sub("θ", 3),
            sub("θ", 4)
        )
    );
}

#[test]
fn names_have_letters_indices_and_dots() {
    assert_eq!(all("theta3"), ["θ₃", "\\theta_3", "<msub><mi>θ</mi><mn>3</mn></msub>"]);
    assert_eq!(all("θ12"), ["θ₁₂", "\\theta_{12}", "<msub><mi>θ</mi><mn>12</mn></msub>"]);
    assert_eq!(all("z_t"), ["z_t", "z_{t}", "<msub><mi>z</mi><mi>t</mi></msub>"]);
    assert_eq!(
        all("l1_alpha"),
        ["l₁_α", "l_{1,\\alpha}", "<msub><mi>l</mi><mrow><mn>1</mn><mo>,</mo><mi>α</mi></mrow></msub>"]
    );
    assert_eq!(all("crank2"), ["crank₂", "\\mathrm{crank}_2", "<msub><mi>crank</mi><mn>2</mn></msub>"]);
    assert_eq!(all("Omega"), ["Ω", "\\Omega", "<mi>Ω</mi>"]);
    assert_eq!(all("Alpha"), ["Α", "\\mathrm{A}", "<mi>Α</mi>"]);
    assert_eq!(
        all("theta3'"),
        ["θ̇₃", "\\dot{\\theta}_3", "<msub><mover><mi>θ</mi><mo>˙</mo></mover><mn>3</mn></msub>"]
    );
    assert_eq!(all("s''"), ["s̈", "\\ddot{s}", "<mover><mi>s</mi><mo>¨</mo></mover>"]);
    assert_shown("∂(theta3, theta2)", "∂θ₃/∂θ₂", "\\frac{\\partial \\theta_3}{\\partial \\theta_2}");
    assert_shown("∂(theta3, theta2, theta2)", "∂²θ₃/∂θ₂²", "\\frac{\\partial^2 \\theta_3}{\\partial {\\theta_2}^2}");
    assert_eq!(
        all("∂(s, x, y)"),
        [
            "∂²s/∂x∂y",
            "\\frac{\\partial^2 s}{\\partial x \\partial y}",
            "<mfrac><mrow><msup><mo>∂</mo><mn>2</mn></msup><mi>s</mi></mrow>\
             <mrow><mo>∂</mo><mi>x</mi><mo>∂</mo><mi>y</mi></mrow></mfrac>"
        ]
    );
    assert_shown("|J2|", "det J₂", "\\det J_2");
    assert_shown("J^-1", "J⁻¹", "J^{-1}");
    // Names that cannot come from the language do no harm.
    for name in ["", "_", "a<b&c", "r#type"] {
        all(name);
    }
    assert_eq!(all("a<& + b")[2], "<mrow><mi>a&lt;&amp;</mi><mo>+</mo><mi>b</mi></mrow>");
}

#[test]
fn arguments_are_bracketed_where_what_follows_could_be_taken_for_a_part_of_them() {
    let source = "x*l*x'^2*∂(y, x)*sin(x)*(x + l)*|J|";
    assert_shown(
        source,
        "x·l·ẋ²·(∂y/∂x)·sin(x)·(x + l)·det J",
        "x l \\dot{x}^2 \\frac{\\partial y}{\\partial x} \\sin(x) (x + l) \\det J",
    );
    let lowered = "<msup><mpadded height=\"0.75em\"><mover><mi>x</mi><mo>˙</mo></mover></mpadded><mn>2</mn></msup>";
    assert!(all(source)[2].contains(lowered));
    assert_shown(
        "∂(y, x)^2/|J|^2",
        "(∂y/∂x)²/(det J)²",
        "\\frac{\\left(\\frac{\\partial y}{\\partial x}\\right)^2}{(\\det J)^2}",
    );
    assert_shown("∂(y, x) - l", "∂y/∂x − l", "\\frac{\\partial y}{\\partial x} - l");
    assert_shown("l/∂(y, x)", "l/(∂y/∂x)", "\\frac{l}{\\frac{\\partial y}{\\partial x}}");
}

#[test]
fn bars_stand_for_brackets() {
    assert_shown("c/(a/b + 1)", "c/(a/b + 1)", "\\frac{c}{\\frac{a}{b} + 1}");
    assert_shown("(a + b)/(a/b + 1)^2", "(a + b)/(a/b + 1)²", "\\frac{a + b}{\\left(\\frac{a}{b} + 1\\right)^2}");
    assert_shown("(a + b)*(a - b)/c", "(a + b)·(a − b)/c", "\\frac{(a + b) (a - b)}{c}");
    assert_shown(
        "a/2 - 3*a/(2*b*c) - 2/3",
        "a/2 − 3·a/(2·b·c) − 2/3",
        "\\frac{a}{2} - \\frac{3 a}{2 b c} - \\frac{2}{3}",
    );
    assert_shown("-1/b^2", "−1/b²", "-\\frac{1}{b^2}");
    assert_eq!(all("-a - b")[2], "<mrow><mo>−</mo><mi>a</mi><mo>−</mo><mi>b</mi></mrow>");
}

#[test]
fn powers_bracket_sums_and_stand_at_the_names_of_circular_functions() {
    let source = "x1^12*cos(x1)^2*(a - x1)^2";
    assert_shown(source, "x₁¹²·cos²(x₁)·(a − x₁)²", "x_1^{12} \\cos^2(x_1) (a - x_1)^2");
    assert!(all(source)[2].contains("<msubsup><mi>x</mi><mn>1</mn><mn>12</mn></msubsup>"));
    assert_shown("sqrt((a - x1)^2)", "√((a − x₁)²)", "\\sqrt{(a - x_1)^2}");
    assert_shown("exp(a)^2", "exp(a)²", "\\exp(a)^2");
}

#[test]
fn functions_and_numbers() {
    for (source, unicode, latex) in [
        ("atan2(y, x)", "atan2(y, x)", "\\operatorname{atan2}(y, x)"),
        ("abs(y)", "|y|", "\\left|y\\right|"),
        ("asin(y)", "arcsin(y)", "\\arcsin(y)"),
        ("sin(x)*cos(y)", "sin(x)·cos(y)", "\\sin x \\cos y"),
        ("sin(x')", "sin(ẋ)", "\\sin(\\dot{x})"),
        ("exp(-2*a)", "exp(−2·a)", "\\exp(-2 a)"),
        ("sin(a/2)", "sin(a/2)", "\\sin\\left(\\frac{a}{2}\\right)"),
        ("2*pi/3", "2·π/3", "\\frac{2 \\pi}{3}"),
        ("1/10", "1/10", "\\frac{1}{10}"),
        ("12.3456", "12.3456", "12.3456"),
        ("80.0", "80", "80"),
        ("1e-300", "1·10⁻³⁰⁰", "1 \\cdot 10^{-300}"),
        ("sqrt(… - b)", "√(… − b)", "\\sqrt{\\ldots - b}"),
        ("l4 != 0", "l₄ ≠ 0", "l_4 \\neq 0"),
        ("sqrt(l4 - s) exists", "√(l₄ − s) exists", "\\sqrt{l_4 - s} \\text{ exists}"),
    ] {
        assert_shown(source, unicode, latex);
    }
}

#[test]
fn functions_of_the_user() {
    for (source, unicode, latex, mathml) in [
        ("lift1(theta, h)", "lift₁(θ, h)", r"\mathrm{lift}_1(\theta, h)", "<msub><mi>lift</mi><mn>1</mn></msub>"),
        (
            "lift1'(theta, h)",
            "lift₁′(θ, h)",
            r"\mathrm{lift}_1'(\theta, h)",
            "<msubsup><mi>lift</mi><mn>1</mn><mo>′</mo></msubsup>",
        ),
        (
            "lift1''(theta, h)",
            "lift₁″(θ, h)",
            r"\mathrm{lift}_1''(\theta, h)",
            "<msubsup><mi>lift</mi><mn>1</mn><mo>″</mo></msubsup>",
        ),
    ] {
        let arguments = "<mo>\u{2061}</mo><mrow><mo>(</mo><mi>θ</mi><mo>,</mo><mi>h</mi><mo>)</mo></mrow>";
        assert_eq!(all(source), [unicode, latex, &format!("<mrow>{mathml}{arguments}</mrow>")]);
    }
    assert_shown("h*s''''(theta)^2", "h·s⁽⁴⁾(θ)²", r"h s^{(4)}(\theta)^2");
    let derivative = "<msup><mi>s</mi><mrow><mo>(</mo><mn>4</mn><mo>)</mo></mrow></msup>";
    assert!(all("h*s''''(theta)^2")[2].contains(derivative));
    assert_shown("f(a/b)", "f(a/b)", r"f\left(\frac{a}{b}\right)");
}
