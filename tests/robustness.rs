//! The macro never panics, never hangs and never floods: broken, huge and deep inputs.

#[path = "source/families.rs"]
mod families;
#[path = "source/hopeless.rs"]
mod hopeless;
mod source;

use std::time::{Duration, Instant};

use proc_macro2::{TokenStream, TokenTree};

/// An input that keeps the macro longer than this hangs. What a hopeless input takes is shown by the
/// bench `compile`; here the machine may be busy.
const PATIENCE: Duration = Duration::from_secs(20);

fn messages(source: &str) -> Vec<String> {
    let start = Instant::now();
    let result = linkage_compiler::read(source.parse().unwrap());
    let expansion = linkage_compiler::expand(source.parse().unwrap(), &"::linkage".parse().unwrap());
    assert!(!expansion.is_empty());
    assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
    result.err().unwrap_or_default()
}

/// The messages of the `compile_error!`s of an expansion.
fn expansion_messages(source: &str) -> Vec<String> {
    let tokens: TokenStream = source.parse().unwrap();
    let start = Instant::now();
    let expansion = linkage_compiler::expand(tokens, &"::linkage".parse().unwrap());
    assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
    let file: syn::File = syn::parse2(expansion).unwrap();
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
        for index in 0..inside.len() {
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
fn deep_parentheses_are_refused() {
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

/// Depth that no parenthesis shows: each name stands on the one before.
#[test]
fn deep_names_need_no_deep_stack() {
    for (depth, message) in [(200, ""), (3000, "the derivatives of `M` take"), (10_000, "`M` takes")] {
        let source = hopeless::nested(depth);
        let thread = std::thread::Builder::new().stack_size(1 << 20);
        let found = thread.spawn(move || expansion_messages(&source)).unwrap().join().unwrap();
        assert_eq!(found.len(), usize::from(!message.is_empty()), "{found:?}");
        assert!(found.iter().all(|found| found.starts_with(message)), "{found:?}");
    }
}

/// Third derivatives and a full du/dp are refused as well before anybody waits for them.
#[test]
fn higher_orders_of_hopeless_inputs() {
    let asking = |source: String| source.replacen('{', "{ derive jerk, velocity_ratio_derivatives, sensitivity;", 1);
    for (source, refused) in [
        (hopeless::nested(20), false),
        (hopeless::nested(3000), true),
        (hopeless::wide(300), false),
        (families::chain(8), false),
        (families::dense(3), false),
        (families::chain(64), true),
    ] {
        let found = expansion_messages(&asking(source));
        assert_eq!(found.len(), usize::from(refused), "{found:?}");
        assert!(found.iter().all(|found| found.contains("the derivatives of `")), "{found:?}");
    }
}

#[test]
fn more_than_anybody_waits_for_is_refused() {
    for (terms, message) in
        [(900, ""), (5000, "`M` takes 15004 expressions"), (200_000, "longer than 100000 words and signs")]
    {
        let found = expansion_messages(&hopeless::wide(terms));
        assert_eq!(found.len(), usize::from(!message.is_empty()), "{found:?}");
        assert!(found.iter().all(|found| found.starts_with(message)), "{found:?}");
    }
}

#[test]
fn constants_overflow_cleanly() {
    let large = "9000000000000000000";
    assert!(messages(&with_output(&format!("{large} * {large} * {large} / {large}"))).is_empty());
    assert!(messages(&with_output("2 ^ 500")).is_empty());
    for hopeless in ["10 ^ 400", "1e308 * 10", "0 ^ 0", "0 ^ -1", "1 / (a - a)", "v ^ 3000000000"] {
        assert_eq!(messages(&with_output(hopeless)).len(), 1, "{hopeless}");
    }
}
