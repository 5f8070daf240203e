use crate::graph::{External, Function, Graph, NodeId, Number, SymbolId};

use super::{Formula, Name, Notation, Printer};

/// A graph with these symbols.
fn graph<const N: usize>(names: [&str; N]) -> (Graph, [NodeId; N]) {
    let mut graph = Graph::default();
    let nodes = names.map(|name| {
        let symbol = graph.symbol(name);
        graph.variable(symbol)
    });
    (graph, nodes)
}

fn formula(graph: &Graph, node: NodeId) -> Formula {
    let names = |symbol: SymbolId| named(graph.symbol_name(symbol));
    let formula = Printer::new(graph, &names).formula(node);
    assert_balanced(&formula.mathml);
    assert_eq!(formula.latex.matches('{').count(), formula.latex.matches('}').count(), "{}", formula.latex);
    assert_eq!(formula.latex.matches("\\left").count(), formula.latex.matches("\\right").count());
    formula
}

/// `theta3.` is a rate, `theta3/theta2` a ratio, `det` the determinant.
fn named(name: &str) -> Name<'_> {
    match (name.split_once('/'), name.strip_suffix('.')) {
        (Some((of, by)), _) => Name::Ratio { of, by },
        (_, Some(name)) => Name::Rate(name),
        _ if name == "det" => Name::Determinant(None),
        _ => Name::Plain(name),
    }
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
        assert!(!text.contains(['<', '>']) && (text.is_empty() || open.last().is_some_and(|tag| tag.len() == 2)));
    }
    assert!(open.is_empty() && roots == 1 && mathml.starts_with('<'), "{mathml}");
}

#[test]
fn determinant_of_the_four_bar() {
    let (mut g, [theta3, theta4, l3, l4]) = graph(["theta3", "theta4", "l3", "l4"]);
    let angle = g.subtract(theta3, theta4);
    let sine = g.call(Function::Sin, &[angle]);
    let product = g.product(&[(l3, 1), (l4, 1), (sine, 1)]);
    let node = g.negate(product);
    let formula = formula(&g, node);
    assert_eq!(formula.unicode, "−l₃·l₄·sin(θ₃ − θ₄)");
    assert_eq!(formula.latex, "-l_3 l_4 \\sin(\\theta_3 - \\theta_4)");
    let sub = |base: &str, index: u8| format!("<msub><mi>{base}</mi><mn>{index}</mn></msub>");
    assert_eq!(
        formula.mathml,
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
    let all = |name: Name| {
        let formula = name.formula();
        assert_balanced(&formula.mathml);
        [formula.unicode, formula.latex, formula.mathml]
    };
    assert_eq!(all(Name::Plain("theta3")), ["θ₃", "\\theta_3", "<msub><mi>θ</mi><mn>3</mn></msub>"]);
    assert_eq!(all(Name::Plain("θ12")), ["θ₁₂", "\\theta_{12}", "<msub><mi>θ</mi><mn>12</mn></msub>"]);
    assert_eq!(all(Name::Plain("z_t")), ["z_t", "z_{t}", "<msub><mi>z</mi><mi>t</mi></msub>"]);
    assert_eq!(
        all(Name::Plain("l1_alpha")),
        ["l₁_α", "l_{1,\\alpha}", "<msub><mi>l</mi><mrow><mn>1</mn><mo>,</mo><mi>α</mi></mrow></msub>"]
    );
    assert_eq!(all(Name::Plain("crank2")), ["crank₂", "\\mathrm{crank}_2", "<msub><mi>crank</mi><mn>2</mn></msub>"]);
    assert_eq!(all(Name::Plain("Omega")), ["Ω", "\\Omega", "<mi>Ω</mi>"]);
    assert_eq!(all(Name::Plain("Alpha")), ["Α", "\\mathrm{A}", "<mi>Α</mi>"]);
    assert_eq!(
        all(Name::Rate("theta3")),
        ["θ̇₃", "\\dot{\\theta}_3", "<msub><mover><mi>θ</mi><mo>˙</mo></mover><mn>3</mn></msub>"]
    );
    assert_eq!(all(Name::Acceleration("s")), ["s̈", "\\ddot{s}", "<mover><mi>s</mi><mo>¨</mo></mover>"]);
    assert_eq!(
        all(Name::Ratio { of: "theta3", by: "theta2" })[..2],
        ["∂θ₃/∂θ₂", "\\frac{\\partial \\theta_3}{\\partial \\theta_2}"]
    );
    assert_eq!(
        all(Name::RatioDerivative { of: "theta3", by: ["theta2", "theta2"] })[..2],
        ["∂²θ₃/∂θ₂²", "\\frac{\\partial^2 \\theta_3}{\\partial {\\theta_2}^2}"]
    );
    assert_eq!(
        all(Name::RatioDerivative { of: "s", by: ["x", "y"] }),
        [
            "∂²s/∂x∂y",
            "\\frac{\\partial^2 s}{\\partial x \\partial y}",
            "<mfrac><mrow><msup><mo>∂</mo><mn>2</mn></msup><mi>s</mi></mrow>\
             <mrow><mo>∂</mo><mi>x</mi><mo>∂</mo><mi>y</mi></mrow></mfrac>"
        ]
    );
    assert_eq!(all(Name::Determinant(Some(2)))[..2], ["det J₂", "\\det J_2"]);
    assert_eq!(all(Name::Inverse(None))[..2], ["J⁻¹", "J^{-1}"]);
    // Names that cannot come from the language do no harm.
    for name in ["", "_", "12", "a<b&c", "r#type"] {
        all(Name::Plain(name));
    }
    assert_eq!(all(Name::Plain("a<b&c"))[2], "<mi>a&lt;b&amp;c</mi>");
}

#[test]
fn factors_stand_in_the_order_of_the_lecture() {
    let (mut g, [x, rate, ratio, det, l]) = graph(["x", "x.", "y/x", "det", "l"]);
    let sine = g.call(Function::Sin, &[x]);
    let sum = g.add(x, l);
    let node = g.product(&[(sum, 1), (sine, 1), (ratio, 1), (rate, 2), (l, 1), (x, 1), (det, 1)]);
    assert_eq!(formula(&g, node).unicode, "x·l·ẋ²·(∂y/∂x)·sin(x)·(x + l)·det J");
    assert_eq!(
        formula(&g, node).latex,
        "x l \\dot{x}^2 \\frac{\\partial y}{\\partial x} \\sin(x) (x + l) \\det J",
        "an argument is bracketed where what follows could be taken for a part of it"
    );
    assert!(
        formula(&g, node).mathml.contains(
            "<msup><mpadded height=\"0.75em\"><mover><mi>x</mi><mo>˙</mo></mover></mpadded><mn>2</mn></msup>"
        )
    );
    assert_eq!(g.text(node), "x*x.^2*y/x*det*l*sin(x)*(x + l)");
    let powers = g.product(&[(ratio, 2), (det, -2)]);
    assert_eq!(formula(&g, powers).unicode, "(∂y/∂x)²/(det J)²");
    assert_eq!(formula(&g, powers).latex, "\\frac{\\left(\\frac{\\partial y}{\\partial x}\\right)^2}{(\\det J)^2}");
    let difference = g.subtract(ratio, l);
    assert_eq!(formula(&g, difference).unicode, "∂y/∂x − l");
}

#[test]
fn fractions_nest_and_take_in_coefficients() {
    let (mut g, [a, b, c]) = graph(["a", "b", "c"]);
    let inner = g.divide(a, b);
    let one = g.one();
    let below = g.add(one, inner);
    let nested = g.divide(c, below);
    assert_eq!(formula(&g, nested).unicode, "c/(a/b + 1)");
    assert_eq!(formula(&g, nested).latex, "\\frac{c}{\\frac{a}{b} + 1}");
    let sum = g.add(a, b);
    let over = g.product(&[(sum, 1), (below, -2)]);
    assert_eq!(formula(&g, over).unicode, "(a + b)/(a/b + 1)²");
    assert_eq!(formula(&g, over).latex, "\\frac{a + b}{\\left(\\frac{a}{b} + 1\\right)^2}");
    let many = g.product(&[(a, 1), (b, -1), (c, -1)]);
    let scaled = g.sum(&[(Number::ratio(-3, 2), many), (Number::ratio(1, 2), a), (Number::ratio(-2, 3), one)]);
    assert_eq!(formula(&g, scaled).unicode, "a/2 − 3·a/(2·b·c) − 2/3");
    assert_eq!(formula(&g, scaled).latex, "\\frac{a}{2} - \\frac{3 a}{2 b c} - \\frac{2}{3}");
    assert_eq!(g.text(scaled), "a/2 - 3*a/(b*c)/2 - 2/3");
    let inverse = g.product(&[(b, -2)]);
    let inverse = g.scale(Number::MINUS_ONE, inverse);
    assert_eq!(formula(&g, inverse).unicode, "−1/b²");
    assert_eq!(formula(&g, inverse).latex, "-\\frac{1}{b^2}");
}

#[test]
fn powers_bracket_sums_and_stand_at_the_names_of_circular_functions() {
    let (mut g, [a, x]) = graph(["a", "x1"]);
    let sum = g.subtract(a, x);
    let square = g.power(sum, 2);
    let cosine = g.call(Function::Cos, &[x]);
    let root = g.call(Function::Sqrt, &[square]);
    let node = g.product(&[(square, 1), (cosine, 2), (x, 12)]);
    assert_eq!(formula(&g, node).unicode, "x₁¹²·cos²(x₁)·(a − x₁)²");
    assert_eq!(formula(&g, node).latex, "x_1^{12} \\cos^2(x_1) (a - x_1)^2");
    assert!(formula(&g, node).mathml.contains("<msubsup><mi>x</mi><mn>1</mn><mn>12</mn></msubsup>"));
    assert_eq!(g.text(node), "x1^12*(a - x1)^2*cos(x1)^2");
    assert_eq!(formula(&g, root).unicode, "√((a − x₁)²)");
    assert_eq!(formula(&g, root).latex, "\\sqrt{(a - x_1)^2}");
}

#[test]
fn signs_lead_where_nothing_positive_can() {
    let (mut g, [a, b]) = graph(["a", "b"]);
    let difference = g.subtract(b, a);
    assert_eq!(formula(&g, difference).unicode, "b − a");
    let both = g.negate(a);
    let both = g.subtract(both, b);
    assert_eq!(formula(&g, both).unicode, "−a − b");
    assert_eq!(formula(&g, both).mathml, "<mrow><mo>−</mo><mi>a</mi><mo>−</mo><mi>b</mi></mrow>");
    let twice = g.scale(Number::integer(-2), a);
    let call = g.call(Function::Exp, &[twice]);
    assert_eq!(formula(&g, call).unicode, "exp(−2·a)");
    let minus = g.number(Number::ratio(-1, 2));
    assert_eq!(formula(&g, minus).unicode, "−1/2");
}

#[test]
fn functions_and_numbers() {
    let (mut g, [y, x]) = graph(["y", "x"]);
    let angle = g.call(Function::Atan2, &[y, x]);
    assert_eq!(formula(&g, angle).latex, "\\operatorname{atan2}(y, x)");
    let modulus = g.call(Function::Abs, &[y]);
    assert_eq!(formula(&g, modulus).unicode, "|y|");
    assert_eq!(formula(&g, modulus).latex, "\\left|y\\right|");
    let arc = g.call(Function::Asin, &[y]);
    assert_eq!(formula(&g, arc).latex, "\\arcsin(y)");
    let (sine, cosine) = (g.call(Function::Sin, &[x]), g.call(Function::Cos, &[y]));
    let circular = g.multiply(sine, cosine);
    assert_eq!(formula(&g, circular).latex, "\\sin x \\cos y");
    assert_eq!(formula(&g, circular).unicode, "sin(x)·cos(y)");
    let pi = g.pi();
    let turn = g.scale(Number::ratio(2, 3), pi);
    assert_eq!(formula(&g, turn).unicode, "2·π/3");
    for (digits, unicode, latex) in [
        ("0.1", "1/10", "\\frac{1}{10}"),
        ("12.3456", "12.3456", "12.3456"),
        ("1e-300", "1·10⁻³⁰⁰", "1 \\cdot 10^{-300}"),
        ("0.3490658503988659", "0.3490658503988659", "0.3490658503988659"),
    ] {
        let node = Number::parse(digits).map(|value| g.number(value)).unwrap_or(y);
        assert_eq!(formula(&g, node).unicode, unicode);
        assert_eq!(formula(&g, node).latex, latex);
    }
}

#[test]
fn names_are_escaped_in_formulas() {
    let (mut g, [a, b]) = graph(["a<&", "b"]);
    let sum = g.add(a, b);
    assert_eq!(formula(&g, sum).mathml, "<mrow><mi>a&lt;&amp;</mi><mo>+</mo><mi>b</mi></mrow>");
}

#[test]
fn what_is_too_long_is_an_ellipsis_in_all_notations() {
    let (mut g, [a, b]) = graph(["a", "b"]);
    let mut node = a;
    // Without sharing this unfolds to 2^10000 names.
    for _ in 0..10_000 {
        let with = g.add(node, b);
        node = g.call(Function::Hypot, &[node, with]);
    }
    let formula = formula(&g, node);
    assert!(formula.unicode.chars().count() <= super::LONGEST);
    assert!(formula.unicode.contains('…') && formula.latex.contains("\\ldots") && formula.mathml.contains('…'));
    let names = |symbol: SymbolId| Name::Plain(g.symbol_name(symbol));
    let (terms, shown) = ([a, b].map(|term| (Number::ONE, term)), ["a + b", "…"]);
    let mut other = g.clone();
    let sum = other.sum(&terms);
    for (longest, shown) in [5, 4].into_iter().zip(shown) {
        assert_eq!(Printer::new(&other, &names).longest(longest).write(sum, Notation::Unicode), shown);
    }
}

#[test]
fn functions_of_the_user() {
    let (mut g, [theta, h]) = graph(["theta", "h"]);
    let lift = g.external(["lift1", "dlift", "ddlift"].map(str::to_owned).to_vec());
    let [value, first, second] = [0, 1, 2].map(|order| g.apply(External::new(lift, 2, order), vec![theta, h]));
    assert_eq!(g.text(second), "ddlift(theta, h)");
    for (node, unicode, latex, mathml) in [
        (value, "lift₁(θ, h)", r"\mathrm{lift}_1(\theta, h)", "<msub><mi>lift</mi><mn>1</mn></msub>"),
        (first, "lift₁′(θ, h)", r"\mathrm{lift}_1'(\theta, h)", "<msubsup><mi>lift</mi><mn>1</mn><mo>′</mo></msubsup>"),
        (
            second,
            "lift₁″(θ, h)",
            r"\mathrm{lift}_1''(\theta, h)",
            "<msubsup><mi>lift</mi><mn>1</mn><mo>″</mo></msubsup>",
        ),
    ] {
        let found = formula(&g, node);
        assert_eq!((found.unicode.as_str(), found.latex.as_str()), (unicode, latex));
        let arguments = "<mo>\u{2061}</mo><mrow><mo>(</mo><mi>θ</mi><mo>,</mo><mi>h</mi><mo>)</mo></mrow>";
        assert_eq!(found.mathml, format!("<mrow>{mathml}{arguments}</mrow>"));
    }
    let law = g.external(vec!["s".to_owned(); 6]);
    let fourth = g.apply(External::new(law, 1, 4), vec![theta]);
    let product = g.product(&[(fourth, 2), (h, 1)]);
    let Formula { unicode, latex, mathml } = formula(&g, product);
    assert_eq!((unicode.as_str(), latex.as_str()), ("h·s⁽⁴⁾(θ)²", r"h s^{(4)}(\theta)^2"));
    let derivative = "<msup><mi>s</mi><mrow><mo>(</mo><mn>4</mn><mo>)</mo></mrow></msup>";
    assert!(mathml.contains(derivative), "{mathml}");
}
