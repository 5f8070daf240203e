//! Names in all places of a mechanism: each either compiles or is an error of the macro, and after a mistake rustc says
//! nothing more.
//!
//! The names are those of the expansions themselves and, in the kinematics, those of Rust and of its standard library: one
//! in ten of them, other ones for each commit. Each is in every third place; with `NAMES=all` and in the outer ring all names
//! are in all of them, and types are in a mechanism of every effect.

mod places;

use std::collections::BTreeSet;
use std::env;

use linkage_tests::programs::{Libraries, succeeded, written};
use linkage_tests::turn;
use places::{EMPTY, GUIDES, MISTAKES, TEMPLATES, Template, functions, small_types, types};
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

const KEYWORDS: &str = "as async await break const continue crate dyn else enum extern false fn for if impl in let loop \
    match mod move mut pub ref return self Self static struct super trait true type unsafe use where while abstract \
    become box do final gen macro override priv try typeof unsized virtual yield union raw safe auto default macro_rules";

const PRELUDE: &str = "Copy Send Sized Sync Unpin Drop Fn FnMut FnOnce AsyncFn drop Box ToOwned Clone PartialEq PartialOrd \
    Eq Ord AsRef AsMut Into From Default Iterator Extend IntoIterator DoubleEndedIterator ExactSizeIterator Option Some \
    None Result Ok Err String ToString Vec TryFrom TryInto FromIterator Debug Hash vec println assert panic size_of \
    align_of";

const TYPES: &str = "bool char str u8 u16 u32 u64 u128 usize i8 i16 i32 i64 i128 isize f32 f64 Rc Arc Cell RefCell Mutex \
    HashMap BTreeMap Path Instant Duration Ordering Range Error Add Sub Mul Div Neg Index Display Write Read Matrix \
    Vector2 Point2 SVector Complex core std alloc nalgebra linkage";

const LETTERS: &str = "a b c d e f g h i j k l m n o p q r s t u v w x y z A B C D E F G H I J K L M N O P Q R S T U V W \
    X Y Z _ __ _0";

/// The mechanism with the names of three types.
type Types = fn([&str; 3]) -> String;

fn read(text: &str) -> Option<TokenStream> {
    text.parse().ok()
}

fn expanded(tokens: TokenStream) -> TokenStream {
    linkage_compiler::expand(tokens, &"::linkage".parse().unwrap())
}

fn is_rejected(expansion: &TokenStream) -> bool {
    expansion.to_string().contains("compile_error")
}

/// The identifiers of an expansion.
fn identifiers(tokens: TokenStream, found: &mut BTreeSet<String>) {
    for token in tokens {
        match token {
            TokenTree::Ident(name) => drop(found.insert(name.to_string())),
            TokenTree::Group(group) => identifiers(group.stream(), found),
            _ => {}
        }
    }
}

/// The names of all expansions, and those of Rust. A keyword is there with and without `r#`.
fn names() -> [BTreeSet<String>; 2] {
    let mut names = BTreeSet::new();
    for template in &TEMPLATES {
        for place in 0..template.places {
            let expansion = expanded(read(&template.with(place, &["name0".to_owned()])).unwrap());
            assert!(!is_rejected(&expansion), "{} {place}: {expansion}", template.what);
            identifiers(expansion, &mut names);
        }
    }
    // Those made of names of the mechanism have a zero.
    names.retain(|name| !name.contains('0'));
    let mut of_rust: BTreeSet<String> =
        [PRELUDE, TYPES, LETTERS, KEYWORDS].into_iter().flat_map(str::split_whitespace).map(str::to_owned).collect();
    let raw = KEYWORDS.split_whitespace().filter(|word| !["self", "Self", "super", "crate"].contains(word));
    of_rust.extend(raw.map(|word| format!("r#{word}")));
    [names, of_rust]
}

/// Names in rounds, in each of which they become different fields.
fn rounds<'a>(names: impl Iterator<Item = &'a String>) -> Vec<Vec<String>> {
    let mut rounds: Vec<(BTreeSet<String>, Vec<String>)> = Vec::new();
    for name in names {
        let field = name.trim_start_matches("r#").replace('_', "").to_lowercase();
        match rounds.iter_mut().find(|(fields, _)| !fields.contains(&field)) {
            Some((fields, list)) => {
                fields.insert(field);
                list.push(name.clone());
            }
            None => rounds.push((BTreeSet::from([field]), vec![name.clone()])),
        }
    }
    rounds.into_iter().map(|(_, list)| list).collect()
}

/// An expansion without the messages of the macro and without comments.
fn silent(expansion: TokenStream) -> TokenStream {
    let tokens: Vec<TokenTree> = expansion.into_iter().collect();
    let is_word = |at: usize, word: &str| matches!(tokens.get(at), Some(TokenTree::Ident(found)) if found == word);
    let is_comment = |at: usize| match (&tokens[at], tokens.get(at + 1)) {
        (TokenTree::Punct(sign), Some(TokenTree::Group(group))) => {
            sign.as_char() == '#' && group.stream().to_string().starts_with("doc =")
        }
        _ => false,
    };
    let (mut kept, mut at) = (TokenStream::new(), 0);
    while at < tokens.len() {
        // `::core::compile_error! { … }`
        at += match &tokens[at] {
            _ if is_word(at + 5, "compile_error") => 8,
            _ if is_comment(at) => 2,
            TokenTree::Group(group) if group.delimiter() != Delimiter::None => {
                kept.extend([TokenTree::Group(Group::new(group.delimiter(), silent(group.stream())))]);
                1
            }
            token => {
                kept.extend([token.clone()]);
                1
            }
        };
    }
    kept
}

/// Modules of a crate: names and texts.
#[derive(Default)]
struct Modules(Vec<(String, String)>);

impl Modules {
    /// A mechanism, and its stub after one of the mistakes.
    fn add(&mut self, name: &str, text: &str, functions: &str, mistake: usize) {
        let expansion = expanded(read(text).unwrap());
        assert!(!is_rejected(&expansion), "{name}: {text}\n{expansion}");
        self.0.push((name.to_owned(), format!("{functions}{}", silent(expansion))));
        let mistakes: Vec<_> = MISTAKES.into_iter().filter(|[place, _]| text.contains(place)).collect();
        let [place, mistake] = mistakes[mistake % mistakes.len()];
        self.add_mistaken(&format!("{name}_mistaken"), &text.replace(place, mistake), functions);
    }

    fn add_mistaken(&mut self, name: &str, text: &str, functions: &str) {
        let expansion = expanded(read(text).unwrap());
        assert!(is_rejected(&expansion), "{name}: {text}");
        // After a message rustc shows no lints.
        self.0.push((name.to_owned(), format!("#![allow(warnings)]\n{functions}{}", silent(expansion))));
    }
}

/// One in ten of the names, all if the test is full.
fn sample(names: BTreeSet<String>, is_full: bool) -> BTreeSet<String> {
    let turned = turn::of(names.len(), if is_full { 1 } else { 10 });
    names.into_iter().enumerate().filter(|(place, _)| turned(*place)).map(|(_, name)| name).collect()
}

#[test]
fn each_name_compiles_or_is_rejected() {
    let is_full = linkage_trials::is_outer() || env::var("NAMES").is_ok_and(|value| value == "all");
    let [of_expansions, of_rust] = names().map(|names| sample(names, is_full));
    let mut modules = Modules::default();
    for (number, template @ Template { what, places, mechanism, .. }) in TEMPLATES.iter().enumerate() {
        let all: BTreeSet<&String> = of_expansions.iter().chain(of_rust.iter().filter(|_| number == 0)).collect();
        let is_accepted = |place: usize, name: &String| {
            read(&template.with(place, std::slice::from_ref(name)))
                .is_some_and(|tokens| linkage_compiler::read(tokens).is_ok())
        };
        let mut of_places = vec![BTreeSet::new(); *places];
        for (place, accepted) in of_places.iter_mut().enumerate() {
            accepted.extend(all.iter().copied().filter(|name| is_accepted(place, name)));
            println!("{what} {place}: {} of {}", accepted.len(), all.len());
            assert!(accepted.len() > all.len() / 2, "{what} {place}: {accepted:?}");
        }
        // Each mechanism has another list of names in each place.
        for (round, names) in rounds(all.iter().copied()).into_iter().enumerate() {
            let lists: Vec<&[String]> = names.chunks(template.most).collect();
            let count = lists.len().max(*places);
            for first in (0..count).step_by(if is_full { 1 } else { 3 }) {
                let lists: Vec<Vec<String>> = (0..*places)
                    .map(|place| {
                        let list = lists.get((first + place) % count).copied().unwrap_or_default();
                        list.iter().filter(|name| of_places[place].contains(name)).cloned().collect()
                    })
                    .collect();
                let text = mechanism(&lists.iter().map(Vec::as_slice).collect::<Vec<_>>());
                let functions =
                    if text.contains("extern fn") { functions(&lists[6], template.most) } else { String::new() };
                modules.add(&format!("{what}_{round}_{first}"), &text, &functions, first);
            }
        }
    }
    // A type begins with a capital. Each name is that of a mechanism, of a driver and of a scene.
    let is_type = |name: &&String| name.trim_start_matches("r#").starts_with(|first: char| first.is_uppercase());
    for (what, names, mechanism) in [
        ("type", &of_expansions, if is_full { types as Types } else { small_types }),
        ("type_of_rust", &of_rust, small_types),
    ] {
        let is_accepted = |name: &&String| {
            let texts = [[name, "A0", "B0"], ["A0", name, "B0"], ["A0", "B0", name]].map(small_types);
            texts.iter().all(|text| read(text).is_some_and(|tokens| !is_rejected(&expanded(tokens))))
        };
        let accepted: Vec<&String> = names.iter().filter(is_type).filter(is_accepted).collect();
        println!("{what}: {}", accepted.len());
        for place in 0..accepted.len() {
            // Names next to each other, such as `State` and `StateRates`, would be types of each other.
            let third = accepted.len().div_ceil(3);
            let [first, second, third] =
                [0, 1, 2].map(|next| accepted[(place + next * third) % accepted.len()].as_str());
            modules.add(&format!("{what}_{place}"), &mechanism([first, second, third]), "", place);
        }
    }
    modules.add("guides", GUIDES, "", 1);
    for (number, text) in EMPTY.into_iter().enumerate() {
        modules.add_mistaken(&format!("empty_{number}"), text, "");
    }
    println!("{} modules, {} bytes", modules.0.len(), modules.0.iter().map(|(_, text)| text.len()).sum::<usize>());
    let mut library = String::from("#![no_std]\n#![allow(non_snake_case, non_camel_case_types)]\n");
    for (name, _) in &modules.0 {
        library += &format!("pub mod {name};\n");
    }
    let modules = modules.0.into_iter().map(|(name, text)| (format!("{name}.rs"), text));
    let folder = written("names", modules.chain([("lib.rs".to_owned(), library)]));
    let mut rustc = Libraries::of_tests().rustc(&folder, "lib.rs", &["linkage"]);
    succeeded(rustc.args(["--crate-type=lib", "--emit=metadata", "-Dwarnings"]));
}
