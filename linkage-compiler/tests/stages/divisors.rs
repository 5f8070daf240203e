//! A divisor of several quotients is inverted once.

/// The comment on the operations of a function of a mechanism.
fn operations(source: &str, function: &str) -> String {
    let mechanism = linkage_compiler::read(source.parse().unwrap()).unwrap().remove(0);
    let text = linkage_compiler::programs(&mechanism).unwrap().concat();
    let of = text.split("\n\n").find(|part| part.starts_with(&format!("{function}("))).unwrap();
    let counts = of.lines().map(str::trim).find(|line| line.starts_with("# ")).unwrap();
    counts.trim_start_matches("# ").to_owned()
}

/// Also where a quotient has no other factor.
#[test]
fn a_reciprocal_and_a_quotient_share_their_divisor() {
    let of = |items: &str| operations(&format!("mechanism M {{ input s; {items} }}"), "outputs");
    assert_eq!(of("param a; output p = 1/s; output q = a/s;"), "1 division, 1 multiplication");
    assert_eq!(of("param a, b; output p = a/s; output q = b/s;"), "1 division, 2 multiplications");
    // Quotients by different divisors do not.
    assert_eq!(of("param a, b; output p = 1/s; output q = a/(s + b);"), "2 divisions, 1 addition");
}
