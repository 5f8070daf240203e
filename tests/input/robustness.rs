//! The macro never panics, never hangs and never exhausts memory: broken, huge and deep inputs.

use linkage_compiler::Facade;
use linkage_compiler::budget::Budget;
use linkage_gallery::{families, source};
use proc_macro2::{TokenStream, TokenTree};

/// The expansion, whose work is within the budget or an error.
fn expansion(tokens: TokenStream) -> TokenStream {
    let budget = Budget::default();
    let facade = Facade::complete(&"::linkage".parse().unwrap());
    let expansion = linkage_compiler::expand_within(tokens, &facade, &budget);
    assert!(!expansion.is_empty());
    assert!(budget.left() > 0 || expansion.to_string().contains("compile_error"));
    expansion
}

fn messages(source: &str) -> Vec<String> {
    expansion(source.parse().unwrap());
    linkage_compiler::read(source.parse().unwrap()).err().unwrap_or_default()
}

/// The messages of the `compile_error!`s of an expansion.
fn expansion_messages(source: &str) -> Vec<String> {
    let tokens: TokenStream = source.parse().unwrap();
    let file: syn::File = syn::parse2(expansion(tokens)).unwrap();
    let macros = file.items.into_iter().filter_map(|item| match item {
        syn::Item::Macro(item) => syn::parse2::<syn::LitStr>(item.mac.tokens).ok(),
        _ => None,
    });
    macros.map(|message| message.value()).collect()
}

fn with_output(expression: &str) -> String {
    format!("mechanism M {{ param a = 2; input v; unknown u; equation u = a * v; output o = {expression} + v; }}")
}

#[test]
fn no_token_missing_or_doubled_makes_it_panic() {
    let root: TokenStream = "::linkage".parse().unwrap();
    for file in ["four_bar", "slider_crank", "geared_five_bar", "norton_four_bar", "cam_rocker"] {
        let tokens: Vec<TokenTree> = source::tokens_of(file).into_iter().collect();
        let Some(TokenTree::Group(body)) = tokens.last() else { panic!("{file} ends in its braces") };
        let inside: Vec<TokenTree> = body.stream().into_iter().collect();
        for index in linkage_trials::some(0..inside.len(), 5) {
            let mut missing = inside.clone();
            missing.remove(index);
            let mut doubled = inside.clone();
            doubled.insert(index, inside[index].clone());
            let mut swapped = inside.clone();
            swapped.swap(index, (index + 1) % inside.len());
            for body in [missing, doubled, swapped] {
                let mut input = tokens[..tokens.len() - 1].to_vec();
                let body = proc_macro2::Group::new(proc_macro2::Delimiter::Brace, body.into_iter().collect());
                input.push(TokenTree::Group(body));
                let expansion = linkage_compiler::expand(input.into_iter().collect(), &root);
                syn::parse2::<syn::File>(expansion).unwrap();
            }
        }
    }
}

#[test]
fn deep_parentheses_are_rejected() {
    let found = messages(&with_output(&format!("{}v{}", "(".repeat(1000), ")".repeat(1000))));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("nested deeper than 64 levels"));
    assert!(messages(&with_output(&format!("{}v{}", "(".repeat(50), ")".repeat(50)))).is_empty());
}

#[test]
fn long_chains_are_only_long() {
    assert!(messages(&with_output(&"v + ".repeat(5000).replace("v + v", "v + a * v"))).len() <= 1);
    assert!(messages(&with_output(&format!("{}v", "-".repeat(10_000)))).is_empty());
    assert!(messages(&with_output(&vec!["v"; 3000].join(" * "))).is_empty());
    assert!(messages(&with_output(&vec!["sin(v)"; 3000].join(" - "))).is_empty());
}

/// Depth without parentheses: each name depends on the one before.
#[test]
fn deep_names_need_no_deep_stack() {
    for (depth, message) in [(200, ""), (8000, "the derivatives of `M` take"), (12_000, "the derivatives of `M` take")]
    {
        let source = families::nested(depth);
        let thread = std::thread::Builder::new().stack_size(1 << 20);
        let found = thread.spawn(move || expansion_messages(&source)).unwrap().join().unwrap();
        assert_eq!(found.len(), usize::from(!message.is_empty()), "{found:?}");
        assert!(found.iter().all(|found| found.starts_with(message)), "{found:?}");
    }
}

/// Matrices of points, outputs and masses by the inputs are counted, zeros too: an open chain has no loops to limit them.
#[test]
fn wide_open_chains_are_within_the_budget() {
    let list = |count: usize, one: &dyn Fn(usize) -> String| (0..count).map(one).collect::<Vec<_>>();
    let points = |count: usize| {
        let (inputs, points) =
            (list(count, &|i| format!("x{i}")), list(count, &|i| format!("point P{i} = (x{i}, 0);")));
        format!("mechanism M {{ input {}; {} }}", inputs.join(", "), points.concat())
    };
    let masses = |count: usize| {
        let inputs = list(count, &|i| format!("x{i}"));
        let body = format!("body all {{ mass 1; center ({}, 0); }}", inputs.join(" + "));
        format!("mechanism M {{ input {}; {body} scene S {{ inertia; }} }}", inputs.join(", "))
    };
    for (source, is_within) in [(points(40), true), (points(3000), false), (masses(10), true), (masses(3000), false)] {
        let found = expansion_messages(&source);
        assert_eq!(found.len(), usize::from(!is_within), "{found:?}");
        assert!(found.iter().all(|message| message.contains("budget of work")), "{found:?}");
    }
}

/// Third derivatives and a full du/dp are rejected as well, before they take long.
#[test]
fn higher_orders_of_huge_inputs() {
    let asking = |source: String| source.replacen('{', "{ derive jerk, velocity_ratio_derivatives, sensitivity;", 1);
    for (source, rejected) in [
        (families::nested(20), false),
        (families::nested(3000), true),
        (families::wide(300), false),
        (families::chain(8), false),
        (families::dense(3), false),
        (families::chain(64), true),
    ] {
        let found = expansion_messages(&asking(source));
        assert_eq!(found.len(), usize::from(rejected), "{found:?}");
        assert!(found.iter().all(|found| found.contains("the derivatives of `")), "{found:?}");
    }
}

#[test]
fn inputs_that_take_too_long_are_rejected() {
    for (terms, message) in [(900, ""), (10_000, "`M` has 30004 expressions"), (200_000, "more than 100000 tokens")] {
        let found = expansion_messages(&families::wide(terms));
        assert_eq!(found.len(), usize::from(!message.is_empty()), "{found:?}");
        assert!(found.iter().all(|found| found.starts_with(message)), "{found:?}");
    }
}

#[test]
fn constants_overflow_cleanly() {
    let large = "9000000000000000000";
    assert!(messages(&with_output(&format!("{large} * {large} * {large} / {large}"))).is_empty());
    assert!(messages(&with_output("2 ^ 500")).is_empty());
    for invalid in ["10 ^ 400", "1e308 * 10", "0 ^ 0", "0 ^ -1", "1 / (a - a)", "v ^ 3000000000"] {
        assert_eq!(messages(&with_output(invalid)).len(), 1, "{invalid}");
    }
}

/// Bodies whose centres are at r and at -r along one line: products that differ in the signs inside them alone.
#[test]
fn products_that_differ_in_signs_are_shared() {
    let source = "mechanism M { param k = 1, m = 1; input v; unknown r; equation r = k * v;
        body b { mass m; center r@v; } body c { mass m; center (-r)@v; } scene Loaded { inertia; } }";
    assert_eq!(expansion_messages(source), [""; 0]);
    let squares = with_output("(a - v) * (v + 1) + (v - a) * (v + 1) + ((a - v) * (v - a))^3");
    assert_eq!(expansion_messages(&squares), [""; 0]);
}

/// Each name uses the one before twice, so that the number of paths doubles with each.
#[test]
fn shared_angles_are_looked_at_once() {
    let chain: String = (1..60).map(|link| format!("let a{link} = a{0} * a{0} + a{0};", link - 1)).collect();
    let source = format!(
        "mechanism M {{ input v; unknown u; let a0 = v; {chain} let _last = a59; equation u = sin(a30) + cos(a31); output o = sin(a29) * u; }}"
    );
    let chain_used = source.split("equation").next().unwrap().len();
    assert!(chain_used > 1000);
    assert_eq!(expansion_messages(&source), [""; 0]);
}

#[test]
fn tokens_after_an_attribute_are_reported() {
    // In a part of a mechanism a `derive` has no effect, which is the first message.
    for (attribute, of_a_part) in
        [("#[derive(Clone) nonsense]", "`#[derive]` has no effect here"), ("#[doc = \"x\" y]", "unexpected token")]
    {
        let source = format!("{attribute} {}", with_output("v"));
        let found = expansion_messages(&source);
        assert!(matches!(found.as_slice(), [one] if one.contains("unexpected token")), "{found:?}");
        let inside = with_output("v").replacen("output", &format!("{attribute} output"), 1);
        let found = expansion_messages(&inside);
        assert!(matches!(found.as_slice(), [one] if one.contains(of_a_part)), "{found:?}");
    }
}

#[test]
fn attributes_without_effect_are_rejected() {
    // These attributes are the input of this test, `allow` too: none of them applies to the code of the test.
    for (attribute, statement, message) in [
        ("#[cfg(test)]", "param", "does not work on a part"),
        ("#[cfg(test)]", "equation", "does not work on a part"),
        ("#[cfg_attr(test, cfg(any()))]", "param", "does not work on a part"),
        ("#[inline]", "output", "`#[inline]` has no effect here"),
        ("#[serde::skip]", "input", "`#[serde::skip]` has no effect here"),
        ("#[allow(unused)]", "equation", "`#[allow]` has no effect here"),
        ("#[deprecated]", "param", "would warn"),
        ("#[doc(hidden)]", "equation", "only a plain doc comment"),
        ("#[doc = (-\"x\")]", "mechanism", "only a plain doc comment"),
        ("#[doc = (1 + 2)]", "param", "only a plain doc comment"),
        ("#[deprecated]", "mechanism", "would warn"),
        ("#[cfg_attr(test, cfg(any()))]", "mechanism", "some of the emitted items"),
    ] {
        let source = with_output("v").replacen(statement, &format!("{attribute} {statement}"), 1);
        let found = expansion_messages(&source);
        assert!(matches!(found.as_slice(), [one] if one.contains(message)), "{attribute} {statement}: {found:?}");
    }
    let commented = with_output("v").replace("equation", "/// Said of it.\n equation");
    assert_eq!(expansion_messages(&commented), [""; 0]);
    assert_eq!(expansion_messages(&commented.replacen("param", "#[cfg_attr(test, serde(skip))] param", 1)), [""; 0]);
}

#[test]
fn constants_beyond_the_range_are_rejected() {
    for invalid in [
        "v / 5e-324",
        "(1e200 * v)^2",
        "v * pi * 1e308",
        "sqrt(1e300 * v * 1e300)",
        "1e-200 * v * 1e-200",
        "1e-400 * v",
        "(1e-200 * v)^2",
        "v + 1e308 + 1e308",
    ] {
        let found = expansion_messages(&with_output(invalid));
        assert!(matches!(found.as_slice(), [one] if one.contains("beyond the range of `f64`")), "{invalid}: {found:?}");
    }
    // The determinant is a product of constants that are in range.
    for (first, second) in [("1e-200 * u + 2 * w = v", "u = 1e-200 * w"), ("1e200 * u = w^2 + v", "w * 1e200 = u^2")] {
        let source = format!("mechanism M {{ input v; unknown u, w; equation {first}; equation {second}; }}");
        let found = expansion_messages(&source);
        assert!(matches!(found.as_slice(), [one] if one.starts_with("in the derivatives of `M`")), "{found:?}");
    }
}

/// The most legs that 100 000 tokens hold; the work of an invocation is the sum over its mechanisms.
#[test]
fn a_hundred_thousand_tokens_of_honest_input_are_within_the_budget() {
    use linkage_compiler::budget::{Budget, MOST_STEPS};
    const LEGS: usize = 345;
    let leg = source::tokens_of("jansen").to_string().replace(" , intervals", "").replace(", intervals", "");
    assert!(!leg.contains("intervals"));
    let steps = |legs: usize| {
        let budget = Budget::default();
        let legs: String = (0..legs).map(|number| leg.replace("Jansen", &format!("Jansen{number}"))).collect();
        let expansion = linkage_compiler::expand_within(
            legs.parse().unwrap(),
            &linkage_compiler::Facade::complete(&"::linkage".parse().unwrap()),
            &budget,
        );
        assert!(!expansion.to_string().contains("compile_error"));
        MOST_STEPS - budget.left()
    };
    let one = steps(1);
    assert_eq!(steps(3), 3 * one);
    assert!(LEGS * one < MOST_STEPS, "{one} steps a leg");
}

/// Matrices of millions of entries, most of them zero, are rejected before they are computed.
#[test]
fn as_many_inputs_as_unknowns() {
    let source = |count: usize| {
        let list = |name: &str| (0..count).map(|index| format!("{name}{index}")).collect::<Vec<_>>().join(", ");
        let equations: String = (0..count).map(|index| format!("equation u{index} = 2 * v{index};")).collect();
        format!("mechanism M {{ input {}; unknown {}; {equations} }}", list("v"), list("u"))
    };
    assert_eq!(expansion_messages(&source(40)), [""; 0]);
    let found = expansion_messages(&source(1500));
    assert!(matches!(found.as_slice(), [one] if one.contains("budget of work")), "{found:?}");
}
