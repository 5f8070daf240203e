//! Expansion for a `linkage` crate without its features `dynamics`, `serde` and `interval`.

use linkage_compiler::Facade;
use linkage_compiler::budget::Budget;
use proc_macro2::TokenStream;

/// A crank with a further statement, expanded with all features or with none.
fn expanded(statement: &str, has_features: bool) -> String {
    let crank = format!(
        "mechanism Crank {{ param r = 1, m = 2; input phi; unknown x; equation x = r * cos(phi); \
         body rod {{ mass m; center (x, 0); }} {statement} }}"
    );
    let path = "::linkage".parse().unwrap();
    let facade = Facade { path, has_dynamics: has_features, has_serde: has_features, has_intervals: has_features };
    let tokens: TokenStream = crank.parse().unwrap();
    linkage_compiler::expand_within(tokens, &facade, &Budget::default()).to_string()
}

#[test]
fn a_scene_needs_the_feature() {
    let without = expanded("scene Turning { inertia; }", false);
    assert_eq!(without.matches("compile_error").count(), 1, "{without}");
    assert!(without.contains("a scene needs the feature `dynamics` of `linkage`"));
    // The stub of the mechanism is emitted, and names no item of the missing feature.
    assert!(without.contains("struct Crank") && !without.contains("Turning"), "{without}");
    assert!(!without.contains("Scene") && !without.contains("MotionError"), "{without}");

    let accepted = expanded("scene Turning { inertia; }", true);
    assert!(!accepted.contains("compile_error") && accepted.contains("struct Turning"));
}

#[test]
fn serde_needs_the_feature() {
    let without = expanded("derive serde;", false);
    assert!(without.contains("`derive serde` needs the feature `serde` of `linkage`"), "{without}");
    assert!(without.contains("struct Crank") && !without.contains("Serialize"), "{without}");
    assert!(expanded("derive serde;", true).contains("Serialize"));
}

#[test]
fn intervals_need_the_feature() {
    let without = expanded("derive intervals;", false);
    assert!(without.contains("`derive intervals` needs the feature `interval` of `linkage`"), "{without}");
    assert!(without.contains("struct Crank") && !without.contains("Formulas"), "{without}");
    let accepted = expanded("derive intervals; scene Turning { inertia; }", true);
    assert!(!accepted.contains("compile_error") && accepted.contains("Formulas") && accepted.contains("Certifiable"));
}
