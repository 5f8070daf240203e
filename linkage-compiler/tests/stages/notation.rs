//! The three notations of formulas: names, signs, fractions, brackets.

use linkage_compiler::document::{self, LONGEST, Layout, Name};
use linkage_compiler::graph::{Condition, External, Function, Graph, NodeId, Number, SymbolId, written};
use linkage_report::Notation;
use linkage_report::lend::Lender;

/// A formula in all notations.
struct Formula {
    text: String,
    latex: String,
    mathml: String,
}

impl Formula {
    fn of(table: &document::Table, number: document::FormulaId) -> Self {
        let lender = Lender::default();
        let table = lender.table(&table.nodes()).unwrap();
        let formula = table.get(number.get()).unwrap();
        Self { text: formula.to_string(), latex: formula.to_latex(), mathml: formula.to_mathml() }
    }

    fn of_name(name: Name) -> Self {
        let mut table = document::Table::default();
        let number = table.name(name);
        Self::of(&table, number)
    }
}

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
    let mut layout = Layout::new(graph, &names);
    let number = layout.formula(node);
    Formula::of(&layout.table, number)
}

fn text(graph: &Graph, node: NodeId) -> String {
    formula(graph, node).text
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

#[test]
fn names_have_greek_letters_subscripts_and_dots() {
    for (name, expected) in [
        (Name::Plain("theta3"), ["θ₃", r"\theta_3"]),
        (Name::Plain("x_theta3"), ["x_θ₃", r"x_{\theta_{3}}"]),
        (Name::Plain("x_beta12_C"), ["x_β₁₂_C", r"x_{\beta_{12},C}"]),
        (Name::Rate("s"), ["ṡ", r"\dot{s}"]),
        (Name::Acceleration("s"), ["s̈", r"\ddot{s}"]),
        (Name::Ratio { of: "theta3", by: "theta2" }, ["∂θ₃/∂θ₂", r"\frac{\partial \theta_3}{\partial \theta_2}"]),
        (
            Name::RatioDerivative { of: "s", by: ["x", "y"] },
            ["∂²s/∂x∂y", r"\frac{\partial^2 s}{\partial x \partial y}"],
        ),
        (Name::Determinant(Some(2)), ["det J₂", r"\det J_2"]),
        (Name::Inverse(None), ["J⁻¹", "J^{-1}"]),
    ] {
        let Formula { text, latex, .. } = Formula::of_name(name);
        assert_eq!([text, latex], expected);
    }
}

/// Every function of the language has a notation of its own: LaTeX shows a user function as `\mathrm{asin}(x)`.
#[test]
fn every_function_of_the_language_has_its_own_notation() {
    for row in written() {
        let (mut g, [x]) = graph(["x"]);
        let node = g.call(row.function, &[x, x][..row.function.arity()]);
        let Formula { latex, .. } = formula(&g, node);
        assert!(!latex.contains("\\mathrm"), "{latex}");
    }
}

#[test]
fn conditions_are_statements() {
    let (mut g, [a, b]) = graph(["a", "b"]);
    let sum = g.add(a, b);
    let names = |symbol: SymbolId| named(g.symbol_name(symbol));
    let mut layout = Layout::new(&g, &names);
    let [not_zero, defined] = [Condition::NonZero(sum), Condition::Defined(a)].map(|one| layout.condition(one));
    let Formula { text, latex, mathml } = Formula::of(&layout.table, not_zero);
    assert_eq!([text.as_str(), &latex], ["a + b ≠ 0", r"a + b \neq 0"]);
    assert_eq!(mathml, "<mrow><mrow><mi>a</mi><mo>+</mo><mi>b</mi></mrow><mo>≠</mo><mn>0</mn></mrow>");
    assert_eq!(Formula::of(&layout.table, defined).text, "a exists");
}

#[test]
fn factors_stand_in_the_order_of_the_lecture() {
    let (mut g, [x, rate, ratio, det, l]) = graph(["x", "x.", "y/x", "det", "l"]);
    let sine = g.call(Function::Sin, &[x]);
    let sum = g.add(x, l);
    let node = g.product(&[(sum, 1), (sine, 1), (ratio, 1), (rate, 2), (l, 1), (x, 1), (det, 1)]);
    assert_eq!(text(&g, node), "x·l·ẋ²·(∂y/∂x)·sin(x)·(x + l)·det J");
    let powers = g.product(&[(ratio, 2), (det, -2)]);
    assert_eq!(text(&g, powers), "(∂y/∂x)²/(det J)²");
}

#[test]
fn fractions_nest_and_take_in_coefficients() {
    let (mut g, [a, b, c]) = graph(["a", "b", "c"]);
    let inner = g.divide(a, b);
    let one = g.one();
    let below = g.add(one, inner);
    let nested = g.divide(c, below);
    assert_eq!(text(&g, nested), "c/(a/b + 1)");
    let sum = g.add(a, b);
    let over = g.product(&[(sum, 1), (below, -2)]);
    assert_eq!(text(&g, over), "(a + b)/(a/b + 1)²");
    let many = g.product(&[(a, 1), (b, -1), (c, -1)]);
    let scaled = g.sum(&[(Number::ratio(-3, 2), many), (Number::ratio(1, 2), a), (Number::ratio(-2, 3), one)]);
    assert_eq!(text(&g, scaled), "a/2 − 3·a/(2·b·c) − 2/3");
    let inverse = g.product(&[(b, -2)]);
    let inverse = g.scale(Number::MINUS_ONE, inverse);
    assert_eq!(text(&g, inverse), "−1/b²");
}

#[test]
fn groups_of_a_long_product_keep_their_fractions() {
    let names: Vec<String> = (0..20).map(|i| format!("x{i}")).collect();
    let mut g = Graph::default();
    let factors: Vec<_> = names
        .iter()
        .map(|name| {
            let symbol = g.symbol(name.as_str());
            (g.variable(symbol), if name == "x0" { -1 } else { 1 })
        })
        .collect();
    let product = g.product(&factors);
    let inverse = g.power(product, -1);
    let shown: Vec<String> = names.iter().map(|name| Formula::of_name(Name::Plain(name)).text).collect();
    let first = |from: usize, to: usize| shown[from..to].join("·");
    assert_eq!(text(&g, product), format!("({}/x₀)·{}", first(1, 16), first(16, 20)));
    assert_eq!(text(&g, inverse), format!("1/(({}/x₀)·{})", first(1, 16), first(16, 20)));
}

#[test]
fn powers_bracket_sums() {
    let (mut g, [a, x]) = graph(["a", "x1"]);
    let sum = g.subtract(a, x);
    let square = g.power(sum, 2);
    let cosine = g.call(Function::Cos, &[x]);
    let node = g.product(&[(square, 1), (cosine, 2), (x, 12)]);
    assert_eq!(text(&g, node), "x₁¹²·cos²(x₁)·(a − x₁)²");
    let root = g.call(Function::Sqrt, &[square]);
    assert_eq!(text(&g, root), "√((a − x₁)²)");
}

#[test]
fn signs_lead_where_nothing_positive_can() {
    let (mut g, [a, b]) = graph(["a", "b"]);
    let difference = g.subtract(b, a);
    assert_eq!(text(&g, difference), "b − a");
    let both = g.negate(a);
    let both = g.subtract(both, b);
    assert_eq!(text(&g, both), "−a − b");
    let twice = g.scale(Number::integer(-2), a);
    let call = g.call(Function::Exp, &[twice]);
    assert_eq!(text(&g, call), "exp(−2·a)");
    let minus = g.number(Number::ratio(-1, 2));
    assert_eq!(text(&g, minus), "−1/2");
}

#[test]
fn numbers_are_ratios_where_those_are_short() {
    let mut g = Graph::default();
    let pi = g.pi();
    let turn = g.scale(Number::ratio(2, 3), pi);
    assert_eq!(text(&g, turn), "2·π/3");
    for (digits, shown) in
        [("0.1", "1/10"), ("12.3456", "12.3456"), ("1e-300", "1·10⁻³⁰⁰"), ("0.3490658503988659", "0.3490658503988659")]
    {
        let node = Number::parse(digits).map(|value| g.number(value)).unwrap_or(pi);
        assert_eq!(text(&g, node), shown);
    }
}

#[test]
fn an_ellipsis_replaces_a_part_that_is_too_long() {
    let (mut g, [a, b]) = graph(["a", "b"]);
    let mut node = a;
    // Without sharing this unfolds to 2^10000 names.
    for _ in 0..10_000 {
        let with = g.add(node, b);
        node = g.call(Function::Hypot, &[node, with]);
    }
    let shown = text(&g, node);
    assert!(shown.len() <= LONGEST && shown.contains('…'));
    let sum = g.add(a, b);
    let names = |symbol: SymbolId| Name::Plain(g.symbol_name(symbol));
    for (longest, shown) in [(5, "a + b"), (4, "…")] {
        let mut layout = Layout::new(&g, &names).longest(longest);
        let number = layout.formula(sum);
        assert_eq!(Formula::of(&layout.table, number).text, shown);
    }
}

#[test]
fn user_functions() {
    let (mut g, [theta, h]) = graph(["theta", "h"]);
    let lift = g.external(["lift1", "dlift", "ddlift"].map(str::to_owned).to_vec());
    let [value, second] = [0, 2].map(|order| g.apply(External::new(lift, 2, order), vec![theta, h]));
    assert_eq!(text(&g, value), "lift₁(θ, h)");
    let product = g.product(&[(second, 2), (h, 1)]);
    assert_eq!(text(&g, product), "h·lift₁″(θ, h)²");
}

#[test]
fn names_in_all_notations() {
    let all = |name: Name| {
        let Formula { text, latex, mathml } = Formula::of_name(name);
        [text, latex, mathml]
    };
    for (name, expected) in [
        ("theta3", ["θ₃", r"\theta_3", "<msub><mi>θ</mi><mn>3</mn></msub>"]),
        ("θ12", ["θ₁₂", r"\theta_{12}", "<msub><mi>θ</mi><mn>12</mn></msub>"]),
        ("z_t", ["z_t", "z_{t}", "<msub><mi>z</mi><mi>t</mi></msub>"]),
        ("l1_alpha", ["l₁_α", r"l_{1,\alpha}", "<msub><mi>l</mi><mrow><mn>1</mn><mo>,</mo><mi>α</mi></mrow></msub>"]),
        ("crank2", ["crank₂", r"\mathrm{crank}_2", "<msub><mi>crank</mi><mn>2</mn></msub>"]),
        ("Omega", ["Ω", r"\Omega", "<mi>Ω</mi>"]),
        ("Alpha", ["Α", r"\mathrm{A}", "<mi>Α</mi>"]),
    ] {
        assert_eq!(all(Name::Plain(name)), expected);
    }
    let dotted = "<msub><mover><mi>θ</mi><mo>˙</mo></mover><mn>3</mn></msub>";
    assert_eq!(all(Name::Rate("theta3")), ["θ̇₃", r"\dot{\theta}_3", dotted]);
    assert_eq!(all(Name::Acceleration("s")), ["s̈", r"\ddot{s}", "<mover><mi>s</mi><mo>¨</mo></mover>"]);
    let twice = Name::RatioDerivative { of: "theta3", by: ["theta2", "theta2"] };
    assert_eq!(all(twice)[..2], ["∂²θ₃/∂θ₂²", r"\frac{\partial^2 \theta_3}{\partial {\theta_2}^2}"]);
    let mixed = "<mfrac><mrow><msup><mo>∂</mo><mn>2</mn></msup><mi>s</mi></mrow>\
                 <mrow><mo>∂</mo><mi>x</mi><mo>∂</mo><mi>y</mi></mrow></mfrac>";
    assert_eq!(all(Name::RatioDerivative { of: "s", by: ["x", "y"] })[2], mixed);
    // Names that are impossible in the language must not panic.
    for name in ["", "_", "a<b&c", "r#type"] {
        all(Name::Plain(name));
    }
    assert_eq!(all(Name::Plain("a<&"))[2], "<mi>a&lt;&amp;</mi>");
}

#[test]
fn the_determinant_of_the_four_bar_in_mathml() {
    let (mut g, [l3, l4, theta3, theta4]) = graph(["l3", "l4", "theta3", "theta4"]);
    let difference = g.subtract(theta3, theta4);
    let sine = g.call(Function::Sin, &[difference]);
    let product = g.product(&[(l3, 1), (l4, 1), (sine, 1)]);
    let node = g.negate(product);
    let Formula { text, latex, mathml } = formula(&g, node);
    assert_eq!(text, "−l₃·l₄·sin(θ₃ − θ₄)");
    assert_eq!(latex, r"-l_3 l_4 \sin(\theta_3 - \theta_4)");
    let sub = |base: &str, index: u8| format!("<msub><mi>{base}</mi><mn>{index}</mn></msub>");
    let expected = format!(
        "<mrow><mo>−</mo><mrow>{}<mo>\u{2062}</mo>{}<mo rspace=\"0.17em\">\u{2062}</mo><mrow><mi>sin</mi><mo>\u{2061}</mo><mrow>\
         <mo>(</mo><mrow>{}<mo>−</mo>{}</mrow><mo>)</mo></mrow></mrow></mrow></mrow>",
        sub("l", 3),
        sub("l", 4),
        sub("θ", 3),
        sub("θ", 4)
    );
    assert_eq!(mathml, expected);
}

/// LaTeX: brackets where a factor could be read as part of an argument, bars instead of brackets, exponents at the
/// names of circular functions.
#[test]
fn products_and_powers_in_latex() {
    let (mut g, [x, l, ratio, rate, det]) = graph(["x", "l", "y/x", "x.", "det"]);
    let sum = g.add(x, l);
    let sine = g.call(Function::Sin, &[x]);
    let node = g.product(&[(x, 1), (l, 1), (rate, 2), (ratio, 1), (sine, 1), (sum, 1), (det, 1)]);
    let Formula { text, latex, mathml } = formula(&g, node);
    assert_eq!(text, "x·l·ẋ²·(∂y/∂x)·sin(x)·(x + l)·det J");
    assert_eq!(latex, r"x l \dot{x}^2 \frac{\partial y}{\partial x} \sin(x) (x + l) \det J");
    let lowered = "<msup><mpadded height=\"0.75em\"><mover><mi>x</mi><mo>˙</mo></mover></mpadded><mn>2</mn></msup>";
    assert!(mathml.contains(lowered), "{mathml}");
    let node = g.product(&[(ratio, 2), (det, -2)]);
    let Formula { text, latex, .. } = formula(&g, node);
    assert_eq!(text, "(∂y/∂x)²/(det J)²");
    assert_eq!(latex, r"\frac{\left(\frac{\partial y}{\partial x}\right)^2}{(\det J)^2}");
    let cosine = g.call(Function::Cos, &[x]);
    let node = g.product(&[(sine, 2), (cosine, 1)]);
    assert_eq!(formula(&g, node).latex, r"\sin^2 x \cos x");
}

/// Names of several letters, next to one another or to anything else, have a sign between them.
#[test]
fn words_in_products_are_apart() {
    let (mut g, [rod, lever, rate, x, theta]) = graph(["rod", "lever2", "rod.", "x", "theta"]);
    let lift = g.external(["lift", "slope", "bend"].map(str::to_owned).to_vec());
    let call = g.apply(External::new(lift, 1, 0), vec![theta]);
    let sine = g.call(Function::Sin, &[theta]);
    let sum = g.add(x, theta);
    let two = g.scale(Number::integer(2), rod);
    let dot = "<mo>⋅</mo>";
    let [rod_math, lever_math] = ["<mi>rod</mi>", "<msub><mi>lever</mi><mn>2</mn></msub>"];
    let product = |g: &mut Graph, factors: &[NodeId]| {
        let factors: Vec<_> = factors.iter().map(|&factor| (factor, 1)).collect();
        let node = g.product(&factors);
        formula(g, node)
    };
    for (factors, latex, mathml) in [
        (vec![rod, lever], r"\mathrm{rod} \cdot \mathrm{lever}_2", format!("{rod_math}{dot}{lever_math}")),
        (vec![two, lever], r"2 \cdot \mathrm{rod} \cdot \mathrm{lever}_2", format!("<mn>2</mn>{dot}{rod_math}{dot}")),
        (vec![rod, x], r"\mathrm{rod} \cdot x", format!("{rod_math}{dot}<mi>x</mi>")),
        (vec![rod, theta], r"\mathrm{rod} \cdot \theta", format!("{rod_math}{dot}<mi>θ</mi>")),
        (vec![rod, sine], r"\mathrm{rod} \cdot \sin \theta", format!("{rod_math}{dot}<mrow><mi>sin</mi>")),
        (vec![rod, sum], r"\mathrm{rod} \cdot (x + \theta)", format!("{rod_math}{dot}<mrow><mo>(</mo>")),
        (vec![rod, call], r"\mathrm{rod} \cdot \mathrm{lift}(\theta)", format!("{rod_math}{dot}<mrow><mi>lift</mi>")),
        (vec![x, call], r"x \cdot \mathrm{lift}(\theta)", format!("<mi>x</mi>{dot}<mrow><mi>lift</mi>")),
        (vec![x, rate], r"x \cdot \dot{\mathrm{rod}}", format!("<mi>x</mi>{dot}<mover><mi>rod</mi>")),
        // Single letters need no sign.
        (vec![x, theta], r"x \theta", "<mi>x</mi><mo>\u{2062}</mo><mi>θ</mi>".to_owned()),
    ] {
        let found = product(&mut g, &factors);
        assert_eq!(found.latex, latex);
        assert!(found.mathml.contains(&mathml), "{} has no {mathml}", found.mathml);
    }
    let square = g.product(&[(rod, 2), (lever, -2), (x, 1)]);
    assert_eq!(formula(&g, square).latex, r"\frac{\mathrm{rod}^2 \cdot x}{\mathrm{lever}_2^2}");
}
