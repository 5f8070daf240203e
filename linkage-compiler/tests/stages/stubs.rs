//! The stub of a mechanism has the same functions as the mechanism: names, arguments and return types.

use std::fs;
use std::path::Path;

use linkage_compiler::program::Code;
use linkage_compiler::program::{self, Access, Function, Functions, Position};
use proc_macro2::{TokenStream, TokenTree};

/// The tokens in the one `linkage! { … }` of a file.
fn tokens_of(path: &Path) -> Option<TokenStream> {
    let tokens: Vec<TokenTree> =
        fs::read_to_string(path).unwrap().parse::<TokenStream>().unwrap().into_iter().collect();
    tokens.windows(3).find_map(|tokens| match tokens {
        [TokenTree::Ident(name), TokenTree::Punct(punct), TokenTree::Group(group)]
            if name == "linkage" && punct.as_char() == '!' =>
        {
            Some(group.stream())
        }
        _ => None,
    })
}

/// The public functions as text, without doc comment and body, sorted by name, since plan and stub differ in order.
fn signatures<B>(functions: &Functions<B>) -> Vec<String> {
    let public = functions
        .iter()
        .filter(|function| matches!(function.access, Access::Public | Access::Hidden | Access::OfMechanism));
    // These follow from the vectors of a finished mechanism.
    let of_vectors = ["joints", "guides", "force_places", "length_scale"];
    let public = public.filter(|function| !of_vectors.contains(&function.name.as_str()));
    let signature = |function: &Function<B>| {
        let Function { name, is_method, arguments, returns, is_fallible, .. } = function;
        format!("{name} {is_method} {arguments:?} -> {returns:?} {is_fallible}")
    };
    let mut all: Vec<String> = public.map(signature).collect();
    all.sort();
    all
}

#[test]
fn a_stub_has_the_functions_of_the_mechanism() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dev/gallery/src/mechanisms");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let (mut compared, mut with_turns, mut with_modes) = (0, 0, 0);
    for path in files {
        let Some(tokens) = tokens_of(&path) else { continue };
        for mechanism in linkage_compiler::read(tokens).unwrap() {
            for (driver, mut derivation) in mechanism.drivers.iter().zip(linkage_compiler::derive(&mechanism)) {
                let whose = format!("{} of {}", driver.name, path.display());
                let planned = program::plan(&mechanism, driver, &mut derivation).unwrap();
                let stub = program::stub::<Code>(&mechanism, driver);
                let sides =
                    |of: &Position| of.sides.iter().map(|side| (side.field.clone(), side.choice)).collect::<Vec<_>>();
                assert_eq!(sides(&planned.position), sides(&stub.position), "{whose}");
                let modes = |of: &Position| of.modes.iter().map(|group| group.field.clone()).collect::<Vec<_>>();
                assert_eq!(modes(&planned.position), modes(&stub.position), "{whose}");
                with_modes += modes(&stub.position).len();
                assert_eq!(planned.position.is_closed, stub.position.is_closed, "{whose}");
                if planned.position.is_closed {
                    let turns =
                        |position: &Position| position.turns.iter().map(|turn| turn.field.clone()).collect::<Vec<_>>();
                    assert_eq!(turns(&planned.position), turns(&stub.position), "{whose}");
                    with_turns += usize::from(!stub.position.turns.is_empty());
                }
                assert_eq!(signatures(&planned.functions), signatures(&stub.functions), "{whose}");
                assert_eq!(planned.scenes.len(), stub.scenes.len(), "{whose}");
                for (planned, stub) in planned.scenes.iter().zip(&stub.scenes) {
                    assert_eq!(signatures(&planned.functions), signatures(&stub.functions), "{whose}");
                }
                compared += 1;
            }
        }
    }
    println!("{compared} drivers, {with_turns} with turns, {with_modes} groups with numbers");
    assert!(compared > with_turns && with_turns > 0 && with_modes > 4);
}
