//! Expansion for a `linkage` crate without its feature `dynamics`.

use linkage_compiler::Facade;
use linkage_compiler::budget::Budget;
use proc_macro2::TokenStream;

/// A crank with a scene, or with none.
fn expanded(scene: &str, has_dynamics: bool) -> String {
    let crank = format!(
        "mechanism Crank {{ param r = 1, m = 2; input phi; unknown x; equation x = r * cos(phi); \
         body rod {{ mass m; center (x, 0); }} {scene} }}"
    );
    let facade = Facade { path: "::linkage".parse().unwrap(), has_dynamics };
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
