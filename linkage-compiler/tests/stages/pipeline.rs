//! All that is made of a mechanism goes through the same stages: it has the same mistakes, and one message when the budget
//! of work is spent.

use linkage_compiler::budget::{Budget, MOST_STEPS};
use linkage_compiler::{Facade, bounds, compile, documents, expand, expand_within, programs, read};
use proc_macro2::TokenStream;
use quote::quote;

/// The determinant is a product of constants that are in range, 1e-200 * 1e-200.
const OUT_OF_RANGE: &str =
    "mechanism M { input v; unknown u, w; equation 1e-200 * u + 2 * w = v; equation u = 1e-200 * w; }";

#[test]
fn a_mistake_in_derivatives_is_one_of_everything_made_of_the_mechanism() {
    let root = quote!(::linkage);
    let mechanism = read(OUT_OF_RANGE.parse().unwrap()).unwrap().remove(0);
    let compiled = compile(&mechanism, &root).map(|_| ()).unwrap_err();
    assert!(matches!(compiled.as_slice(), [one] if one.starts_with("in the derivatives of `M`")), "{compiled:?}");
    assert_eq!(programs(&mechanism).unwrap_err(), compiled);
    assert_eq!(documents(&mechanism).unwrap_err(), compiled);
    assert_eq!(bounds(&mechanism).map(|_| ()).unwrap_err(), compiled);
    assert!(expand(OUT_OF_RANGE.parse().unwrap(), &root).to_string().contains("in the derivatives of `M`"));
}

/// The budget may end in each stage of each mechanism: in the resolution of both, then in the derivation of both.
#[test]
fn a_spent_budget_is_one_message_and_leaves_stubs() {
    let four_bar = |name: &str| {
        format!(
            "mechanism {name} {{ param a, b, c, d; input phi; unknown psi, chi; loop a@phi + b@psi = (d, 0) + c@chi; \
             point P = a@phi + (b, c)@psi; body coupler {{ mass a; center P; }} scene {name}Scene {{ inertia; }} }}"
        )
    };
    let source = [four_bar("First"), four_bar("Second")].concat();
    let expanded = |budget: &Budget| -> String {
        let tokens: TokenStream = source.parse().unwrap();
        expand_within(tokens, &Facade::complete(&quote!(::linkage)), budget).to_string()
    };
    let budget = Budget::default();
    assert!(!expanded(&budget).contains("compile_error"));
    let all = MOST_STEPS - budget.left();
    const PARTS: usize = 32;
    let mut reported = Vec::new();
    for part in 0..PARTS {
        let expansion = expanded(&Budget::new(all * part / PARTS + 1));
        let messages: Vec<&str> = ["First", "Second"]
            .into_iter()
            .filter(|name| expansion.contains(&format!("budget of work in `{name}`")))
            .collect();
        assert_eq!(expansion.matches("compile_error").count(), 1, "{part}: {expansion}");
        let [one] = messages.as_slice() else { panic!("{part}: {messages:?}") };
        reported.push(*one);
        for name in ["First", "Second"] {
            assert!(expansion.contains(&format!("struct {name}Pose")), "{part}: {name}");
        }
    }
    reported.dedup();
    println!("{reported:?}");
    // Few steps are of the resolution: the first mechanism is derived when the second is resolved.
    assert!(reported.ends_with(&["First", "Second"]), "{reported:?}");
}
