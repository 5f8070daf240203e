//! Closed forms of limits: they are recognised by third derivatives, which the identities must simplify to zero.

use linkage_compiler::{derive, read};

/// The forms of the bounds on the input of one loop.
#[derive(Debug, PartialEq)]
enum Form {
    /// a + b cos(k v) + c sin(k v)
    Angle,
    /// a + b v + c v^2
    Length,
    Searched,
}

use Form::{Angle, Length, Searched};

const LOOPS: [(&str, &str, &str, Form); 17] = [
    ("w", "u, v", "a@w + b@u + c@v = d@0", Angle),
    ("w", "u, v", "a@(2*w + delta) + b@u + c@v = d@eps + e@90deg", Angle),
    ("w", "u, v", "a@(w/3 - delta) + b@(u + delta) + c@(v - eps) = d@eps + e@delta", Angle),
    ("w", "u, v", "a@(k*w) + e@(k*w + delta) + b@u + c@v = d@0", Angle),
    ("w", "u, v", "a@w + e@(w + delta) + (a/2)@(w - eps) + b@u + c@v = d@0", Angle),
    ("w", "u, v", "a@w + b@(u + w) + c@v = d@w + e@0", Angle),
    ("w", "u, v", "a@w + b@(u + w) + c@(v + 2*w) = d@0", Angle),
    ("w", "u, s", "a@w + b@u = s@delta + c@(delta + 90deg)", Angle),
    ("w", "u, s", "a@w + e@(w + eps) + b@u = s@0 + c@90deg", Angle),
    ("w", "u, s", "a@w + e@(w + 30deg) = d@eps + c@u + s@(u + delta)", Angle),
    ("x", "u, v", "x@delta + b@u + c@v = d@0", Length),
    ("x", "u, v", "(2*x + e)@delta + b@u + c@v = d@0 + x@eps", Length),
    ("x", "u, s", "x@90deg + b@u = s@0 + d@eps", Length),
    ("x", "u, s", "(k*x + a)@delta + e@eps + b@u = s@(delta + 30deg)", Length),
    ("x", "u, s", "(x^2)@90deg + b@u = s@0", Length),
    // A rate that is not constant, and two rates.
    ("w", "u, v", "a@(w^2) + b@u + c@v = d@0", Searched),
    ("w", "u, v", "a@w + e@(2*w) + b@u + c@v = d@0", Searched),
];

#[test]
fn closed_forms_are_found_where_there_are_some() {
    for (input, unknowns, equation, form) in LOOPS {
        let words: Vec<&str> = equation.split(|c: char| !c.is_alphabetic()).collect();
        let parameters = ["a", "b", "c", "d", "e", "k", "delta", "eps"].into_iter().filter(|name| words.contains(name));
        let parameters = parameters.collect::<Vec<_>>().join(", ");
        let source = format!(
            "mechanism Loop {{ param {parameters}; input {input}; unknown {unknowns}; loop {equation}; derive limits; }}"
        );
        let mechanism = read(source.parse().unwrap()).unwrap().remove(0);
        let mut derivation = derive(&mechanism).remove(0);
        let assembly = derivation.assembly();
        let input = derivation.inputs.ids().next().unwrap();
        let (bounds, is_searched) = derivation.bounds(&assembly, input);
        assert_eq!(is_searched, form == Searched, "{equation}");
        assert_eq!(bounds.is_empty(), form == Searched, "{equation}");
        assert!(bounds.iter().all(|bound| bound.rate.is_some() == (form == Angle)), "{equation}");
    }
}
