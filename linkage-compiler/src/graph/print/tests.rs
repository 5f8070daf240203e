use crate::graph::{External, Function, Graph, NodeId, Number, SymbolId};

use super::{Name, Printer};

/// A graph with these symbols.
fn graph<const N: usize>(names: [&str; N]) -> (Graph, [NodeId; N]) {
    let mut graph = Graph::default();
    let nodes = names.map(|name| {
        let symbol = graph.symbol(name);
        graph.variable(symbol)
    });
    (graph, nodes)
}

fn source(graph: &Graph, node: NodeId) -> String {
    let names = |symbol: SymbolId| named(graph.symbol_name(symbol));
    Printer::new(graph, &names).source(node).to_owned()
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
fn names_are_written_as_the_runtime_reads_them() {
    for (name, expected) in [
        (Name::Plain("theta3"), "theta3"),
        (Name::Rate("s"), "s'"),
        (Name::Acceleration("s"), "s''"),
        (Name::Ratio { of: "theta3", by: "theta2" }, "∂(theta3, theta2)"),
        (Name::RatioDerivative { of: "s", by: ["x", "y"] }, "∂(s, x, y)"),
        (Name::Determinant(Some(2)), "|J2|"),
        (Name::Inverse(None), "J^-1"),
    ] {
        let mut written = String::new();
        name.write(&mut written);
        assert_eq!(written, expected);
    }
}

#[test]
fn factors_stand_in_the_order_of_the_lecture() {
    let (mut g, [x, rate, ratio, det, l]) = graph(["x", "x.", "y/x", "det", "l"]);
    let sine = g.call(Function::Sin, &[x]);
    let sum = g.add(x, l);
    let node = g.product(&[(sum, 1), (sine, 1), (ratio, 1), (rate, 2), (l, 1), (x, 1), (det, 1)]);
    assert_eq!(source(&g, node), "x*l*x'^2*∂(y, x)*sin(x)*(x + l)*|J|");
    assert_eq!(g.text(node), "x*x.^2*y/x*det*l*sin(x)*(x + l)");
    let powers = g.product(&[(ratio, 2), (det, -2)]);
    assert_eq!(source(&g, powers), "∂(y, x)^2/|J|^2");
}

#[test]
fn fractions_nest_and_take_in_coefficients() {
    let (mut g, [a, b, c]) = graph(["a", "b", "c"]);
    let inner = g.divide(a, b);
    let one = g.one();
    let below = g.add(one, inner);
    let nested = g.divide(c, below);
    assert_eq!(source(&g, nested), "c/(a/b + 1)");
    let sum = g.add(a, b);
    let over = g.product(&[(sum, 1), (below, -2)]);
    assert_eq!(source(&g, over), "(a + b)/(a/b + 1)^2");
    let many = g.product(&[(a, 1), (b, -1), (c, -1)]);
    let scaled = g.sum(&[(Number::ratio(-3, 2), many), (Number::ratio(1, 2), a), (Number::ratio(-2, 3), one)]);
    assert_eq!(source(&g, scaled), "a/2 - 3*a/(2*b*c) - 2/3");
    assert_eq!(g.text(scaled), "a/2 - 3*a/(b*c)/2 - 2/3");
    let inverse = g.product(&[(b, -2)]);
    let inverse = g.scale(Number::MINUS_ONE, inverse);
    assert_eq!(source(&g, inverse), "-1/b^2");
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
    let first = |from: usize, to: usize| names[from..to].join("*");
    assert_eq!(source(&g, product), format!("({}/x0)*{}", first(1, 16), first(16, 20)));
    assert_eq!(source(&g, inverse), format!("1/(({}/x0)*{})", first(1, 16), first(16, 20)));
}

#[test]
fn powers_bracket_sums() {
    let (mut g, [a, x]) = graph(["a", "x1"]);
    let sum = g.subtract(a, x);
    let square = g.power(sum, 2);
    let cosine = g.call(Function::Cos, &[x]);
    let node = g.product(&[(square, 1), (cosine, 2), (x, 12)]);
    assert_eq!(source(&g, node), "x1^12*cos(x1)^2*(a - x1)^2");
    assert_eq!(g.text(node), "x1^12*(a - x1)^2*cos(x1)^2");
    let root = g.call(Function::Sqrt, &[square]);
    assert_eq!(source(&g, root), "sqrt((a - x1)^2)");
}

#[test]
fn signs_lead_where_nothing_positive_can() {
    let (mut g, [a, b]) = graph(["a", "b"]);
    let difference = g.subtract(b, a);
    assert_eq!(source(&g, difference), "b - a");
    let both = g.negate(a);
    let both = g.subtract(both, b);
    assert_eq!(source(&g, both), "-a - b");
    let twice = g.scale(Number::integer(-2), a);
    let call = g.call(Function::Exp, &[twice]);
    assert_eq!(source(&g, call), "exp(-2*a)");
    let minus = g.number(Number::ratio(-1, 2));
    assert_eq!(source(&g, minus), "-1/2");
}

#[test]
fn numbers_are_ratios_where_those_are_short() {
    let mut g = Graph::default();
    let pi = g.pi();
    let turn = g.scale(Number::ratio(2, 3), pi);
    assert_eq!(source(&g, turn), "2*pi/3");
    for (digits, shown) in
        [("0.1", "1/10"), ("12.3456", "12.3456"), ("1e-300", "1e-300"), ("0.3490658503988659", "0.3490658503988659")]
    {
        let node = Number::parse(digits).map(|value| g.number(value)).unwrap_or(pi);
        assert_eq!(source(&g, node), shown);
    }
}

#[test]
fn what_is_too_long_is_an_ellipsis() {
    let (mut g, [a, b]) = graph(["a", "b"]);
    let mut node = a;
    // Without sharing this unfolds to 2^10000 names.
    for _ in 0..10_000 {
        let with = g.add(node, b);
        node = g.call(Function::Hypot, &[node, with]);
    }
    let shown = source(&g, node);
    assert!(shown.len() <= super::LONGEST_SOURCE && shown.contains('…'));
    let sum = g.add(a, b);
    let names = |symbol: SymbolId| Name::Plain(g.symbol_name(symbol));
    for (longest, shown) in [(5, "a + b"), (4, "…")] {
        assert_eq!(Printer::new(&g, &names).longest(longest).source(sum), shown);
    }
}

#[test]
fn functions_of_the_user() {
    let (mut g, [theta, h]) = graph(["theta", "h"]);
    let lift = g.external(["lift1", "dlift", "ddlift"].map(str::to_owned).to_vec());
    let [value, second] = [0, 2].map(|order| g.apply(External::new(lift, 2, order), vec![theta, h]));
    assert_eq!(g.text(second), "ddlift(theta, h)");
    assert_eq!(source(&g, value), "lift1(theta, h)");
    let product = g.product(&[(second, 2), (h, 1)]);
    assert_eq!(source(&g, product), "h*lift1''(theta, h)^2");
}
