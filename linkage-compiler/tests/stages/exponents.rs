//! A large exponent is a message, or it compiles: derivatives and bounds of rounding errors overflow for none.

use linkage_compiler::graph::LARGEST_EXPONENT;
use linkage_compiler::{Facade, budget::Budget, expand_within};
use proc_macro2::TokenStream;
use quote::quote;

/// True if an output with this formula compiles with all derivatives.
fn compiles(formula: &str) -> bool {
    let text = format!(
        "mechanism M {{ param r = 3; input u; output value = {formula}; derive jerk, sensitivity, \
         velocity_ratio_derivatives; }}"
    );
    let tokens: TokenStream = text.parse().unwrap();
    let expanded = expand_within(tokens, &Facade::complete(&quote!(::linkage)), &Budget::default()).to_string();
    !expanded.contains("compile_error")
}

#[test]
fn large_exponents_do_not_overflow() {
    let largest = LARGEST_EXPONENT;
    let above = largest + 1;
    let formulas = [
        (format!("r + u^{largest}"), true),
        (format!("r * u^{largest} * sin(u)^{largest} * (u + r)^{largest}"), true),
        (format!("((r + u)^{largest} + (r + 2*u)^{largest})^{largest}"), true),
        (format!("r + u^-{}", largest - 8), true),
        // Its derivative has one more.
        (format!("r + u^-{largest}"), false),
        (format!("r + u^{above}"), false),
        (format!("r + u^-{above}"), false),
        (format!("r + u^{largest} * u"), false),
        (format!("r + (u^{largest})^{largest}"), false),
        ("r + u^2147483647".to_owned(), false),
        ("r + u^(-2^31)".to_owned(), false),
        ("r + u^-2147483648".to_owned(), false),
        ("r + u^1e300".to_owned(), false),
    ];
    for (formula, expected) in formulas {
        assert_eq!(compiles(&formula), expected, "{formula}");
    }
}
