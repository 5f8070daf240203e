use crate::graph::{External, Function, Graph, NodeId, Number};

/// A graph with these symbols.
fn graph<const N: usize>(names: [&str; N]) -> (Graph, [NodeId; N]) {
    let mut graph = Graph::default();
    let nodes = names.map(|name| {
        let symbol = graph.symbol(name);
        graph.variable(symbol)
    });
    (graph, nodes)
}

#[test]
fn factors_stand_in_the_order_of_the_graph() {
    let (mut g, [x, rate, ratio, det, l]) = graph(["x", "x_rate", "y_ratio", "det", "l"]);
    let sine = g.call(Function::Sin, &[x]);
    let sum = g.add(x, l);
    let node = g.product(&[(sum, 1), (sine, 1), (ratio, 1), (rate, 2), (l, 1), (x, 1), (det, 1)]);
    assert_eq!(g.text(node), "x*x_rate^2*y_ratio*det*l*sin(x)*(x + l)");
    let powers = g.product(&[(ratio, 2), (det, -2)]);
    assert_eq!(g.text(powers), "y_ratio^2/det^2");
}

#[test]
fn fractions_nest_with_their_coefficients() {
    let (mut g, [a, b, c]) = graph(["a", "b", "c"]);
    let inner = g.divide(a, b);
    let one = g.one();
    let below = g.add(one, inner);
    let nested = g.divide(c, below);
    assert_eq!(g.text(nested), "c/(a/b + 1)");
    let many = g.product(&[(a, 1), (b, -1), (c, -1)]);
    let scaled = g.sum(&[(Number::ratio(-3, 2), many), (Number::ratio(1, 2), a), (Number::ratio(-2, 3), one)]);
    assert_eq!(g.text(scaled), "a/2 - 3*a/(b*c)/2 - 2/3");
    let inverse = g.product(&[(b, -2)]);
    let inverse = g.scale(Number::MINUS_ONE, inverse);
    assert_eq!(g.text(inverse), "-1/b^2");
}

#[test]
fn powers_bracket_sums() {
    let (mut g, [a, x]) = graph(["a", "x1"]);
    let sum = g.subtract(a, x);
    let square = g.power(sum, 2);
    let cosine = g.call(Function::Cos, &[x]);
    let node = g.product(&[(square, 1), (cosine, 2), (x, 12)]);
    assert_eq!(g.text(node), "x1^12*(a - x1)^2*cos(x1)^2");
    let root = g.call(Function::Sqrt, &[square]);
    assert_eq!(g.text(root), "sqrt((a - x1)^2)");
}

#[test]
fn signs_lead_where_nothing_positive_can() {
    let (mut g, [a, b]) = graph(["a", "b"]);
    let difference = g.subtract(b, a);
    assert_eq!(g.text(difference), "b - a");
    let both = g.negate(a);
    let both = g.subtract(both, b);
    assert_eq!(g.text(both), "-a - b");
    let twice = g.scale(Number::integer(-2), a);
    let call = g.call(Function::Exp, &[twice]);
    assert_eq!(g.text(call), "exp(-2*a)");
    let minus = g.number(Number::ratio(-1, 2));
    assert_eq!(g.text(minus), "-1/2");
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
    let shown = g.text(node);
    assert!(shown.len() <= super::LONGEST && shown.contains('…'), "{shown}");
}

#[test]
fn user_functions() {
    let (mut g, [theta, h]) = graph(["theta", "h"]);
    let lift = g.external(["lift1", "dlift", "ddlift"].map(str::to_owned).to_vec());
    let second = g.apply(External::new(lift, 2, 2), vec![theta, h]);
    assert_eq!(g.text(second), "ddlift(theta, h)");
}
