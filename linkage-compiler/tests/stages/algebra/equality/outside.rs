//! Cases outside the decidable class: those that remain undecided, and those that are decided all the same.

use linkage_compiler::graph::{External, Number};
use linkage_equality::{Answer, MOST_TERMS, Reason, compare, is_zero};

use crate::algebra::formula::Formulas;

#[test]
fn functions_outside_the_class_are_not_decided() {
    for (left, right, functions) in [
        ("sqrt(x^2)", "abs(x)", &["sqrt", "abs"][..]),
        ("exp(x + y)", "exp(x)*exp(y)", &["exp"]),
        ("asin(sin(x))", "x", &["asin"]),
        ("acos(x)", "pi/2 - asin(x)", &["acos", "asin"]),
        ("ln(x*y)", "ln(x) + ln(y)", &["ln"]),
        ("atan2(y, x)", "atan(y/x)", &["atan2", "atan"]),
        ("hypot(x, y)^2", "x^2 + y^2", &["hypot"]),
        ("sin(asin(x))", "x", &["asin"]),
        ("tan(atan(x))", "x", &["atan"]),
        ("exp(x)", "exp(2*x)", &["exp"]),
        ("hypot(x, y)", "hypot(x, z)", &["hypot"]),
        ("abs(x)*abs(y)", "abs(x*y)", &["abs"]),
        ("sqrt(x)", "sqrt(x) + sqrt(y)", &["sqrt"]),
    ] {
        let answer = Formulas::default().compare(left, right);
        let Answer::Undecided(Reason::OutsideClass(name)) = answer else { panic!("{left}, {right}: {answer}") };
        assert!(functions.contains(&name), "{left}, {right}: {name}");
        let message = format!("cannot decide: `{name}` is not rational in sines and cosines");
        assert_eq!(answer.to_string(), message);
    }
}

#[test]
fn functions_outside_the_class_may_cancel() {
    for (left, right) in [
        ("sqrt(x) + a - a", "sqrt(x)"),
        ("(sqrt(x) + 1)^2", "sqrt(x)^2 + 2*sqrt(x) + 1"),
        // The graph writes the square of a magnitude as a square.
        ("abs(x)^2", "x^2"),
        ("exp(x)*(sin(y)^2 + cos(y)^2)", "exp(x)"),
        // Arguments are compared by equality, not by text.
        ("sqrt((x + y)^2)", "sqrt(x^2 + 2*x*y + y^2)"),
        ("atan2(sin(2*x), y)", "atan2(2*sin(x)*cos(x), y)"),
        ("sin(asin(x))^2", "1 - cos(asin(x))^2"),
        ("cos(2*sqrt(x))", "1 - 2*sin(sqrt(x))^2"),
        ("sin(x/(1 + y))*2*cos(x/(1 + y))", "sin(2*x/(1 + y))"),
        ("sin((x*y - x)/(y - 1))", "sin(x)"),
    ] {
        assert_eq!(Formulas::default().compare(left, right), Answer::Equal, "{left} = {right}");
    }
    // The difference is 2 a, without the function.
    assert_eq!(Formulas::default().compare("sqrt(x) + a", "sqrt(x) - a"), Answer::Different);
}

#[test]
fn functions_of_the_user_are_letters() {
    let mut formulas = Formulas::default();
    let [lift, other] = [&["lift", "slope"][..], &["other"]]
        .map(|names| formulas.graph.external(names.iter().map(ToString::to_string).collect()));
    let [left, right, third] = ["(x + y)^2", "x^2 + 2*x*y + y^2", "x^2"].map(|text| formulas.node(text));
    let g = &mut formulas.graph;
    let mut apply = |function, order, at| g.apply(External::new(function, 1, order), vec![at]);
    let (one, same) = (apply(lift, 0, left), apply(lift, 0, right));
    let strangers = [apply(lift, 0, third), apply(lift, 1, left), apply(other, 0, left)];
    assert_ne!(one, same);
    assert_eq!(compare(g, one, same), Answer::Equal);
    for stranger in strangers {
        let answer = compare(g, one, stranger);
        let Answer::Undecided(Reason::External(name)) = &answer else { panic!("{answer}") };
        assert!(["lift", "other"].contains(&name.as_str()));
        assert_eq!(answer.to_string(), format!("cannot decide: the properties of the function `{name}` are not known"));
    }
}

#[test]
fn numbers_that_are_not_exact_are_not_decided() {
    let mut formulas = Formulas::default();
    let x = formulas.node("x");
    let float = formulas.graph.number(Number::Float(0.1));
    let exact = formulas.graph.number(Number::ratio(1, 10));
    let (left, right) = (formulas.graph.multiply(float, x), formulas.graph.multiply(exact, x));
    let inexact = Answer::Undecided(Reason::Inexact(Number::Float(0.1)));
    assert_eq!(compare(&formulas.graph, left, right), inexact);
    assert_eq!(inexact.to_string(), "cannot decide: the number 0.1 is not exact");
    let y = formulas.node("y");
    let both = formulas.graph.add(left, y);
    let difference = formulas.graph.subtract(both, left);
    assert_eq!(compare(&formulas.graph, difference, y), Answer::Equal);
    let sine = formulas.graph.call(linkage_compiler::graph::Function::Sin, &[left]);
    assert_eq!(is_zero(&formulas.graph, sine), inexact);
}

#[test]
fn undefined_expressions_are_not_decided() {
    for (left, right) in [
        ("1/(sin(x)^2 + cos(x)^2 - 1)", "1"),
        ("x/((x + 1)^2 - x^2 - 2*x - 1)", "x/((x + 1)^2 - x^2 - 2*x - 1)"),
        ("tan(pi/2 + x - x)", "1"),
        ("1/(1 - 1)", "x"),
        ("sqrt(1/(sin(2*x) - 2*sin(x)*cos(x)))", "x"),
    ] {
        let answer = Formulas::default().compare(left, right);
        assert_eq!(answer, Answer::Undecided(Reason::Undefined), "{left}, {right}");
    }
}

#[test]
fn angles_and_constants_beyond_what_is_known() {
    for (left, right, reason) in [
        ("sin(x/(1 + y))", "cos(y)", Reason::AngleIsQuotient),
        ("x*cos(x*cos(1))", "x*cos(x*cos(1)) + sin(x*cos(1))", Reason::Constants),
        ("sin(x + pi/10000)", "x", Reason::TooLarge),
        ("(x*123456789012345678 + 1)^3", "x", Reason::TooLarge),
        ("(x + y + z + sin(x) + sin(y) + sin(z))^20", "1", Reason::TooManyTerms),
    ] {
        let mut formulas = Formulas::default();
        let answer = formulas.compare(left, right);
        assert!(answer == Answer::Undecided(reason), "{left}, {right}: {answer}");
    }
    // It is not known if pi and sin(1) are algebraically independent, but the values differ.
    assert_eq!(Formulas::default().compare("pi*sin(1)", "sin(pi^2)"), Answer::Different);
    // At such a large angle the numerical values have no correct digit.
    let answer = Formulas::default().compare("pi*sin(1) + cos(pi^9)", "2");
    assert_eq!(answer, Answer::Undecided(Reason::Constants));
    let text = Reason::TooManyTerms.to_string();
    assert!(text.contains(&MOST_TERMS.to_string()) && text.starts_with("cannot decide: "), "{text}");
}

#[test]
fn an_expression_too_long_is_equal_to_itself() {
    let long = "(x + y + z + sin(x) + sin(y) + sin(z))^20";
    assert_eq!(Formulas::default().compare(long, long), Answer::Equal);
}
