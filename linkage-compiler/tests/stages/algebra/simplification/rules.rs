//! Examples of every rule: the simplified form, proved equal to the original.

use std::collections::BTreeSet;

use linkage_compiler::algebra::simplify;
use linkage_compiler::graph::{Condition, NodeId};
use linkage_equality::{Answer, Reason, compare};

use crate::algebra::formula::Formulas;

/// The simplest form of an expression, where the sines and cosines of `given` cost nothing, and its conditions.
fn simplified(text: &str, given: &[&str]) -> (String, Vec<String>) {
    let mut formulas = Formulas::default();
    let given: BTreeSet<NodeId> = given.iter().map(|angle| formulas.node(angle)).collect();
    let before = formulas.node(text);
    let written = formulas.graph.take_conditions();
    assert!(written.is_empty(), "{text} loses something as it is written: {written:?}");
    let after = simplify(&mut formulas.graph, &[before], &given)[0];
    let answer = compare(&formulas.graph, before, after);
    assert!(
        matches!(answer, Answer::Equal | Answer::Undecided(Reason::OutsideClass(_))),
        "{text} became {}: {answer}",
        formulas.graph.text(after)
    );
    let conditions = formulas.graph.take_conditions();
    let conditions = conditions.into_iter().map(|condition| match condition {
        Condition::NonZero(id) => format!("{} != 0", formulas.graph.text(id)),
        Condition::Defined(id) => format!("{} exists", formulas.graph.text(id)),
    });
    let conditions = conditions.collect();
    (formulas.graph.text(after), conditions)
}

#[track_caller]
fn becomes(before: &str, after: &str) {
    assert_eq!(simplified(before, &[]), (after.to_owned(), Vec::new()), "{before}");
}

#[test]
fn common_factors() {
    becomes("a*x + a*y", "a*(x + y)");
    becomes("x^2*y - x*y^2", "x*y*(x - y)");
    becomes("x/z + y/z", "(x + y)/z");
    becomes("2*x*y + 4*x", "x*(2*y + 4)");
    // Powers of both signs are not factored.
    becomes("x + 1/x", "x + 1/x");
}

#[test]
fn products_of_sums() {
    becomes("(x + y)*(x - y) + y^2", "x^2");
    becomes("(x + y)^2 - x^2 - 2*x*y", "y^2");
}

#[test]
fn quotients_of_sums() {
    assert_eq!(simplified("(x^2 - y^2)/(x + y)", &[]), ("x - y".to_owned(), vec!["x + y != 0".to_owned()]));
    assert_eq!(
        simplified("(x^3 + 3*x^2*y + 3*x*y^2 + y^3)/(x + y)^2", &[]),
        ("x + y".to_owned(), vec!["x + y != 0".to_owned()])
    );
    becomes("(x^2 + y^2)/(x + y)", "(x^2 + y^2)/(x + y)");
}

#[test]
fn sines_of_sums_and_differences() {
    becomes("sin(a)*cos(b) - cos(a)*sin(b)", "sin(a - b)");
    becomes("sin(a)*cos(b) + cos(a)*sin(b)", "sin(a + b)");
    becomes("cos(a)*cos(b) + sin(a)*sin(b)", "cos(a - b)");
    becomes("cos(a)*cos(b) - sin(a)*sin(b)", "cos(a + b)");
    becomes("2*sin(a)*cos(a)", "2*sin(a)*cos(a)");
    becomes("cos(a)^2 - sin(a)^2", "cos(2*a)");
    becomes("l*m*sin(a)*cos(b)/n - l*m*cos(a)*sin(b)/n", "l*m*sin(a - b)/n");
}

#[test]
fn phase_offsets() {
    becomes("z*sin(phi)*cos(delta) - z*cos(phi)*sin(delta)", "z*sin(phi - delta)");
    becomes("sin(phi - delta)*cos(delta) + cos(phi - delta)*sin(delta)", "sin(phi)");
    becomes("cos(phi + pi/6)*cos(phi) + sin(phi + pi/6)*sin(phi)", "cos(pi/6)");
}

#[test]
fn squares_of_sines() {
    becomes("sin(a)^2 + cos(a)^2", "1");
    becomes("3*sin(a)^2 + 5*cos(a)^2", "2*cos(a)^2 + 3");
    becomes("x*sin(a)^2 + x*cos(a)^2 + y", "x + y");
    becomes("1/(l*(sin(a)^2 + cos(a)^2))", "1/l");
    becomes("sin(a)^3 + sin(a)*cos(a)^2", "sin(a)");
}

#[test]
fn directions_at_hand_take_the_way_back() {
    let spread = simplified("sin(a - b)", &["a", "b"]);
    assert_eq!(spread.0, "sin(a)*cos(b) - cos(a)*sin(b)");
    assert_eq!(simplified("cos(a + b)", &["a", "b"]).0, "cos(a)*cos(b) - sin(a)*sin(b)");
    assert_eq!(simplified("sin(a - b)", &["a"]).0, "sin(a - b)");
    assert_eq!(simplified("sin(a - b)", &["a", "b", "a - b"]).0, "sin(a - b)");
    assert_eq!(simplified("sin(a)*cos(b) - cos(a)*sin(b)", &["a", "b"]).0, "sin(a)*cos(b) - cos(a)*sin(b)");
}

#[test]
fn roots_of_squares() {
    becomes("sqrt(x^2)", "abs(x)");
    becomes("hypot(l*cos(a), l*sin(a))", "abs(l)");
    becomes("sqrt((l*cos(a))^2 + (l*sin(a))^2)", "abs(l)");
    becomes("hypot(l*cos(a) - m*cos(a), l*sin(a) - m*sin(a))", "abs(l - m)");
    becomes("abs(x)^2", "x^2");
    becomes("sqrt(x^3)", "sqrt(x^3)");
}

#[test]
fn what_is_cancelled_is_recorded() {
    let mut formulas = Formulas::default();
    for (text, expected) in [
        ("x/x", "[NonZero]"),
        ("x^2/x", "[NonZero]"),
        ("x/x^2", "[]"),
        ("1/x - 1/x", "[Defined]"),
        ("0*ln(x)", "[Defined]"),
        ("0/x", "[NonZero]"),
        ("sqrt(y) - sqrt(y)", "[Defined]"),
        ("tan(y)^0", "[Defined]"),
        ("2*x - x - x", "[]"),
        ("x*y/x", "[NonZero]"),
    ] {
        formulas.node(text);
        let kinds: Vec<&str> = formulas
            .graph
            .take_conditions()
            .iter()
            .map(|condition| match condition {
                Condition::NonZero(_) => "NonZero",
                Condition::Defined(_) => "Defined",
            })
            .collect();
        assert_eq!(format!("[{}]", kinds.join(", ")), expected, "{text}");
    }
}
