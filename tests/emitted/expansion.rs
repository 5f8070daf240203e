//! The emitted Rust, pretty-printed, as snapshots: each form of the printer once. The computations are in the snapshots of
//! `tests/emitted/program.rs`.

use std::collections::{BTreeMap, BTreeSet};

use linkage_gallery::source;
use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Expr, ImplItem, Item, Stmt, Visibility};

use linkage_tests::work::work;

/// All items that are emitted for the tokens of a mechanism, those of inner blocks too.
fn expand(tokens: TokenStream) -> Vec<Item> {
    let root: TokenStream = "::linkage".parse().unwrap();
    let file: syn::File = syn::parse2(linkage_compiler::expand(tokens, &root)).unwrap();
    let mut items = Vec::new();
    for item in file.items {
        match item {
            Item::Const(block) => {
                let Expr::Block(block) = *block.expr else { panic!("a block of items") };
                items.extend(block.block.stmts.into_iter().filter_map(|statement| match statement {
                    Stmt::Item(item) => Some(item),
                    _ => None,
                }));
            }
            item => items.push(item),
        }
    }
    items
}

fn unparse(items: Vec<Item>) -> String {
    prettyplease::unparse(&syn::File { items, ..syn::parse_str("").unwrap() })
}

/// The name of the type that a block implements something for.
fn implementor(block: &syn::ItemImpl) -> String {
    let syn::Type::Path(path) = &*block.self_ty else { return String::new() };
    path.path.segments.last().unwrap().ident.to_string()
}

/// The types of these names.
fn structures(items: Vec<Item>, names: &[&str]) -> Vec<Item> {
    let is_one = |ident: &syn::Ident| names.iter().any(|name| ident == name);
    let is_named = |item: &Item| match item {
        Item::Struct(item) => is_one(&item.ident),
        Item::Type(item) => is_one(&item.ident),
        _ => false,
    };
    items.into_iter().filter(is_named).collect()
}

/// The inherent functions of a type that have one of these names.
fn inherent(items: Vec<Item>, of: &str, names: &[&str]) -> Vec<Item> {
    let mut kept = Vec::new();
    for item in items {
        let Item::Impl(mut item) = item else { continue };
        item.items.retain(|item| matches!(item, ImplItem::Fn(item) if names.iter().any(|name| item.sig.ident == name)));
        if item.trait_.is_none() && implementor(&item) == of && !item.items.is_empty() {
            kept.push(Item::Impl(item));
        }
    }
    assert!(!kept.is_empty(), "{of} has no {names:?}");
    kept
}

fn functions(file: &str, of: &str, names: &[&str]) -> Vec<Item> {
    inherent(expand(source::tokens_of(file)), of, names)
}

/// The implementation of a trait.
fn implementation(file: &str, of: &str, name: &str) -> Vec<Item> {
    let is_it = |item: &Item| match item {
        Item::Impl(item) => {
            let of_trait = item.trait_.as_ref().and_then(|(path, _)| path.segments.last());
            implementor(item) == of && of_trait.is_some_and(|last| last.ident == name)
        }
        _ => false,
    };
    expand(source::tokens_of(file)).into_iter().filter(is_it).collect()
}

/// The constant `DERIVATION` with some of its fields.
fn derivation(file: &str, fields: &[&str]) -> Vec<Item> {
    let constants = expand(source::tokens_of(file)).into_iter().filter_map(|item| {
        let Item::Impl(mut item) = item else { return None };
        let ImplItem::Const(constant) = item.items.first_mut()? else { return None };
        let Expr::Block(block) = &mut constant.expr else { return None };
        let Some(Stmt::Expr(Expr::Reference(reference), _)) = block.block.stmts.last_mut() else { return None };
        let Expr::Struct(all) = &mut *reference.expr else { return None };
        let kept = std::mem::take(&mut all.fields).into_iter();
        all.fields = kept
            .filter(|field| fields.iter().any(|name| field.member.to_token_stream().to_string() == *name))
            .collect();
        Some(Item::Impl(item))
    });
    constants.collect()
}

/// The error, the pose and two functions of a mechanism with a mistake.
fn stub() -> Vec<Item> {
    let text = "pub mechanism Mistaken { param a = 1; input v; unknown u; equation u = a * w; point P = (u, v); }";
    let items = expand(text.parse().unwrap());
    let errors = items.iter().filter(|item| matches!(item, Item::Macro(_))).cloned().collect();
    let pose = structures(items.clone(), &["MistakenPose"]);
    [errors, pose, inherent(items, "Mistaken", &["motion", "branches"])].concat()
}

macro_rules! snapshots {
    ($($name:ident: $items:expr;)*) => {$(
        #[test]
        fn $name() {
            insta::with_settings!({ omit_expression => true }, {
                insta::assert_snapshot!(stringify!($name), unparse($items));
            });
        }
    )*};
}

snapshots! {
    types: structures(
        expand(source::tokens_of("four_bar")),
        &["FourBar", "FourBarCoordinates", "FourBarPoints", "FourBarPose", "FourBarBranch", "FourBarMotion"],
    );
    kinematic_function: functions("four_bar", "FourBar", &["velocity_ratios"]);
    closed_form: functions("four_bar", "FourBar", &["assemble_in_turns", "assemble"]);
    user_function: functions("cam_rocker", "CamRocker", &["pose_at", "extern_turn"]);
    every_operation: functions("every_function", "EveryFunction", &["outputs"]);
    scene: functions("slider_crank_scenes", "Steady", &["drive_forces", "effects"]);
    trait_implementation: implementation("scotch_yoke", "ScotchYoke", "Mechanism");
    motion: implementation("scotch_yoke", "ScotchYoke", "Kinematic");
    motion_of_an_open_chain: implementation("cart_pendulum", "CartPendulum", "Kinematic");
    open_chain: implementation("cart_pendulum", "CartPendulum", "Mechanism");
    columns: structures(expand(source::tokens_of("scotch_yoke")), &["ScotchYokeColumns"]);
    lanes: implementation("scotch_yoke", "ScotchYoke", "Lanes");
    formulas: implementation("scotch_yoke", "ScotchYoke", "Formulas");
    certifiable: implementation("scotch_yoke", "ScotchYoke", "Certifiable");
    derivation_constant: derivation("scotch_yoke", &["mechanism", "inputs", "residual", "blocks", "ratios"]);
    stub_on_error: stub();
}

/// The irreducible block of six unknowns is factorised once in a function, for all right-hand sides.
#[test]
fn one_factorisation_serves_all_right_sides() {
    // W and L; each of the sixteen parameters is in some loop equation.
    for (name, right_sides) in [("jerk", 1), ("velocity_ratio_derivatives", 2), ("sensitivity", 16)] {
        let text = unparse(functions("double_butterfly", "DoubleButterfly", &[name]));
        assert_eq!(text.matches("Factorization::new").count(), 1, "{name}");
        assert_eq!(text.matches(".solve(").count(), right_sides, "{name}");
    }
}

#[test]
fn expansion_is_repeatable() {
    for file in ["four_bar", "six_bar", "every_function", "slider_crank"] {
        let root: TokenStream = "::linkage".parse().unwrap();
        let once = linkage_compiler::expand(source::tokens_of(file), &root).to_string();
        let again = linkage_compiler::expand(source::tokens_of(file), &root).to_string();
        assert_eq!(once, again, "{file}");
    }
}

/// Without `derive lanes, intervals` nothing of them is emitted, and with it all else stays as it is.
#[test]
fn lanes_and_intervals_are_emitted_if_asked_for() {
    let with = source::tokens_of("scotch_yoke");
    let without = source::with_statements(with.clone(), |statement| !statement.starts_with("derive"));
    let text = unparse(expand(without.clone()));
    assert!(!["Lanes", "Columns", "lane", "batch"].iter().any(|word| text.contains(word)), "{text}");
    assert!(!["Formulas", "Certifiable", "Number"].iter().any(|word| text.contains(word)), "{text}");
    let (with, without) = (surface(with), surface(without));
    assert!(with.len() == without.len() + 1 && with.contains_key("ScotchYokeColumns"), "{:?}", with.keys());
    for (name, members) in without {
        assert!(members.is_subset(&with[&name]), "{name}");
    }
}

/// `derive sheet` adds the constant `SHEET` and changes no other token; without it there is none.
#[test]
fn a_sheet_adds_one_constant() {
    let root: TokenStream = "::linkage".parse().unwrap();
    let is_sheet = |item: &Item| match item {
        Item::Impl(item) => item.items.iter().any(|item| matches!(item, ImplItem::Const(one) if one.ident == "SHEET")),
        _ => false,
    };
    for (file, drivers) in [("four_bar", 1), ("six_bar", 1), ("slider_crank", 2), ("five_bar", 1), ("cart_pendulum", 1)]
    {
        let without = source::tokens_of(file);
        let with: TokenStream = {
            let mut tokens: Vec<_> = without.clone().into_iter().collect();
            for token in &mut tokens {
                if let proc_macro2::TokenTree::Group(group) = token
                    && group.delimiter() == proc_macro2::Delimiter::Brace
                {
                    let inside = group.stream();
                    *group = proc_macro2::Group::new(group.delimiter(), quote::quote!(#inside derive sheet;));
                }
            }
            tokens.into_iter().collect()
        };
        let [without, with] = [without, with]
            .map(|tokens| syn::parse2::<syn::File>(linkage_compiler::expand(tokens, &root)).unwrap().items);
        let text = |items: &[&Item]| items.iter().map(|item| item.to_token_stream().to_string()).collect::<Vec<_>>();
        let (sheets, rest): (Vec<&Item>, Vec<&Item>) = with.iter().partition(|item| is_sheet(item));
        assert_eq!(sheets.len(), drivers, "{file}");
        assert_eq!(text(&rest), text(&without.iter().collect::<Vec<_>>()), "{file}");
        assert!(!without.iter().any(is_sheet));
    }
}

/// The tokens of `four_bar_scenes` with those statements that begin with none of these words.
fn scenes_without(words: &[&str]) -> TokenStream {
    let keep = |statement: &str| !words.iter().any(|word| statement.starts_with(word));
    source::with_statements(source::tokens_of("four_bar_scenes"), keep)
}

/// The public fields and signatures by type, without those for the number of turns of an angle.
fn surface(tokens: TokenStream) -> BTreeMap<String, BTreeSet<String>> {
    let turns = |name: &syn::Ident| name.to_string().starts_with("assemble_");
    let is_public = |visibility: &Visibility| matches!(visibility, Visibility::Public(_));
    let mut surface: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for item in expand(tokens) {
        match item {
            Item::Struct(item) => {
                let fields = item.fields.iter().filter(|field| is_public(&field.vis));
                let fields = fields
                    .map(|field| (field.ident.as_ref().unwrap().to_string(), field.ty.to_token_stream().to_string()));
                let fields = fields.filter(|(name, _)| !name.ends_with("_angle") && !name.ends_with("_turn"));
                let fields = fields.map(|(name, of)| format!("{name}: {of}"));
                surface.entry(item.ident.to_string()).or_default().extend(fields);
            }
            Item::Impl(item) if item.trait_.is_none() => {
                let signatures = item.items.iter().filter_map(|item| match item {
                    ImplItem::Fn(function) if is_public(&function.vis) && !turns(&function.sig.ident) => {
                        Some(function.sig.to_token_stream().to_string())
                    }
                    _ => None,
                });
                surface.entry(implementor(&item)).or_default().extend(signatures);
            }
            _ => {}
        }
    }
    surface
}

/// A scene is the same code with other scenes or without, and so is the mechanism.
#[test]
fn scenes_add_nothing_to_others() {
    let bare = scenes_without(&["param m2", "param g", "param k", "body", "scene", "let"]);
    let idle = scenes_without(&["param k", "scene Loaded", "scene Driven", "scene Balanced", "let"]);
    let all = source::tokens_of("four_bar_scenes");
    let (all_work, all_surface) = (work(all.clone()), surface(all));
    for (some, types) in [(bare, 9), (idle, 10)] {
        let some_surface = surface(some.clone());
        assert!(some_surface.len() >= types, "{:?}", some_surface.keys());
        for (name, members) in &some_surface {
            let difference: Vec<_> = members.symmetric_difference(&all_surface[name]).collect();
            assert!(difference.is_empty(), "{name}: {difference:?}");
        }
        for (function, operations) in work(some) {
            // The springs on theta4 ask for its number of turns; a pose then holds its number. The last two assemble.
            let has_number = function.1.starts_with("assemble")
                || ["kinematics", "full_kinematics", "coordinates", "branch_of", "branch_near"]
                    .contains(&function.1.as_str());
            if !has_number {
                assert_eq!(Some(&operations), all_work.get(&function), "{function:?}");
            }
        }
    }
    let text = unparse(expand(scenes_without(&["param k", "scene Loaded", "scene Driven", "scene Balanced", "let"])));
    assert!(text.contains("impl<T: __rt::Real> Idle<T>") && !text.contains("kt") && !text.contains("omega"));
}
