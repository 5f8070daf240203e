//! A generator puts short sequences of tokens wherever a name or a number stands: the macro never panics, stays within its
//! counted budget, gives what Rust can read, and says nothing twice. In the inner ring one in eight is tried, others for each commit.

use linkage_compiler::budget::{Budget, MOST_STEPS};
use linkage_tests::expanded::{expanded, is_rejected, parsed};
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

/// A mechanism with every statement and every effect.
const EVERYTHING: &str = "
    #[derive(Clone)]
    pub mechanism Crank {
        param r = 1, l = 3, e = 30deg;
        coordinate a in 0deg..150deg, b, x in ..r + l;
        extern fn table::gas(s, p) -> (gas, slope, bend);
        let d = r@(a + e);
        loop d + l@b = (x, 0);
        implied equation x = r * cos(a + e) + l * cos(b);
        point P = 2 * d;
        output o in 1.. = x^2 + gas(x, 3);
        drive Turned by a;
        body rod { mass 2; inertia r; center P; angle b; }
        scene Loaded of Turned {
            inertia rod;
            gravity (0, -9.81) on rod;
            spring r, 2 between P and (1, x);
            damper 0.5 on b;
            torque 3 * t + rate(a) on a;
            force (1, r) at P;
            potential x^2;
            friction 0.1, r, 5 on b;
            stop x in 1..l, restitution 0.5;
            reaction at P;
            energy;
        }
        scene Given { drive a = 2 * t; power; }
        derive limits;
    }";

/// The sequences: numbers, names, keywords, signs, groups, and what is written in other languages.
const SEQUENCES: [&str; 32] = [
    "", "1", "-1", "0x10", "1u8", "1deg", "1e400", "2theta", "'a'", "\"s\"", "'a", "c", "r#type", "type", "self", "_",
    "t", "r#sin", "é", "in", "a", "@", "..", "=", "#", "$", "(1,)", "(1, 2)", "{a}", "a::b(1)", "a.b", "c e",
];

/// Every sequence instead of each name and number, at any depth.
fn with_sequences(tokens: &TokenStream, given: &mut dyn FnMut(TokenStream)) {
    let trees: Vec<TokenTree> = tokens.clone().into_iter().collect();
    let around = |place: usize, sequence: TokenStream| -> TokenStream {
        let before = trees[..place].iter().cloned();
        before.chain(sequence).chain(trees[place + 1..].iter().cloned()).collect()
    };
    for (place, tree) in trees.iter().enumerate() {
        match tree {
            TokenTree::Group(group) => with_sequences(&group.stream(), &mut |inner| {
                given(around(place, TokenTree::Group(Group::new(group.delimiter(), inner)).into()));
            }),
            TokenTree::Ident(_) | TokenTree::Literal(_) => {
                let fragment = Group::new(Delimiter::None, "1 + 2".parse().unwrap());
                for sequence in SEQUENCES {
                    given(around(place, sequence.parse().unwrap()));
                }
                given(around(place, TokenTree::Group(fragment).into()));
            }
            TokenTree::Punct(_) => {}
        }
    }
}

/// The messages of an expansion.
fn messages(expansion: TokenStream, input: &TokenStream) -> Vec<String> {
    let macros = parsed(expansion, input).items.into_iter().filter_map(|item| match item {
        syn::Item::Macro(item) => syn::parse2::<syn::LitStr>(item.mac.tokens).ok(),
        _ => None,
    });
    macros.map(|message| message.value()).collect()
}

#[test]
fn no_sequence_makes_the_macro_panic_run_away_or_repeat_itself() {
    let root = "::linkage".parse().unwrap();
    let everything: TokenStream = EVERYTHING.parse().unwrap();
    let expansion = expanded(&everything, &root, &Budget::default());
    assert!(!is_rejected(&expansion), "{:?}", messages(expansion, &everything));
    let (mut count, mut tried, mut accepted, mut most) = (0, 0, 0, 0);
    let mut chosen = linkage_trials::some(0.., 8).peekable();
    let mut repeated = Vec::new();
    with_sequences(&everything, &mut |input| {
        count += 1;
        if chosen.next_if_eq(&(count - 1)).is_none() {
            return;
        }
        tried += 1;
        let budget = Budget::default();
        let expansion = expanded(&input, &root, &budget);
        most = most.max(MOST_STEPS - budget.left());
        if !is_rejected(&expansion) {
            accepted += 1;
            // Rust that can be read; the names and the mutants are compiled elsewhere.
            parsed(expansion, &input);
            return;
        }
        let mut all = messages(expansion, &input);
        assert!(!all.is_empty(), "{input}");
        // What is missing before a token is missing at each place.
        all.retain(|message| !message.contains("before this"));
        all.sort_unstable();
        if let Some(pair) = all.windows(2).find(|pair| pair[0] == pair[1]) {
            repeated.push(format!("{input}\n    {}", pair[0]));
        }
    });
    println!("{tried} of {count} inputs, {accepted} accepted, at most {most} steps of {MOST_STEPS}");
    assert!(count > 3400 && accepted > tried / 20, "{accepted} of {tried} are accepted");
    assert!(most < MOST_STEPS / 10, "{most} steps");
    assert!(repeated.is_empty(), "{} of {tried}: {}", repeated.len(), repeated.join("\n"));
}
