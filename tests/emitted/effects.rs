//! The cost of a scene depends on its own declarations alone: its operations in mechanisms with more and with fewer
//! scenes.

use linkage_gallery::source;

use std::collections::BTreeSet;

use linkage_compiler::program::Operations;
use linkage_tests::work::{Work, work};
use proc_macro2::TokenStream;

const SCENES: [&str; 16] = [
    "Bare",
    "Weighed",
    "Sprung",
    "Twisted",
    "Damped",
    "Pushed",
    "Turned",
    "Rough",
    "Stopped",
    "Worn",
    "Measured",
    "Loaded",
    "Driven",
    "Mounted",
    "Smooth",
    "Everything",
];

/// The scenes that need the number of turns of an angle.
const WITH_NUMBERS: [&str; 4] = ["Twisted", "Stopped", "Smooth", "Everything"];

/// `four_bar_effects` with those of its scenes that `keep` accepts, and with the parameters that these need.
fn with_scenes(keep: impl Fn(&str) -> bool) -> TokenStream {
    let second = |statement: &str| statement.split_whitespace().nth(1).unwrap_or_default().to_owned();
    let all = source::tokens_of("four_bar_effects");
    let is_kept = |statement: &str| !statement.starts_with("scene ") || keep(&second(statement));
    let kept = source::with_statements(all, is_kept);
    let others = source::with_statements(kept.clone(), |statement| !statement.starts_with("param ")).to_string();
    let words: BTreeSet<&str> = others.split(|c: char| !c.is_alphanumeric()).collect();
    let is_needed = |statement: &str| !statement.starts_with("param ") || words.contains(second(statement).as_str());
    source::with_statements(kept, is_needed)
}

/// The functions that find the turns of a guess or of a branch, and assemble to do so; without turns they do not.
const FOR_TURNS: [&str; 3] = ["assemble_near", "branch_of", "branch_near"];

fn of<'a>(work: &'a Work, name: &'a str) -> impl Iterator<Item = (&'a str, Operations)> {
    work.iter()
        .filter(move |((of, function), _)| of == name && !FOR_TURNS.contains(&function.as_str()))
        .map(|((_, function), operations)| (function.as_str(), *operations))
}

/// Each function of a scene and of its mechanism does the same operations whatever else is declared; but if a spring or
/// a stop needs the number of turns of an angle, assembly computes it.
#[test]
fn other_scenes_cost_nothing() {
    let all = work(source::tokens_of("four_bar_effects"));
    for scene in SCENES {
        let alone = work(with_scenes(|name| name == scene));
        for name in [scene, "FourBar"] {
            let (found, expected): (Vec<_>, Vec<_>) = (of(&all, name).collect(), of(&alone, name).collect());
            assert!(expected.len() > 1, "{name} of {scene}");
            let is_assembly = |(function, _): &(&str, Operations)| {
                function.starts_with("assemble") || ["kinematics", "full_kinematics"].contains(function)
            };
            let [(assembling, found), (alone, expected)] =
                [found, expected].map(|work| work.into_iter().partition::<Vec<_>, _>(is_assembly));
            assert_eq!(found, expected, "{name} of {scene}");
            for ((_, found), (_, expected)) in assembling.iter().zip(&alone) {
                let turned = usize::from(!WITH_NUMBERS.contains(&scene));
                assert_eq!(*found, Operations { functions: expected.functions + turned, ..*expected }, "{scene}");
            }
            assert_eq!(assembling.len(), alone.len());
        }
    }
}

/// The names of the fields of a struct.
fn fields(source: &TokenStream, name: &str) -> Vec<String> {
    let expansion = linkage_compiler::expand(source.clone(), &"::linkage".parse().unwrap());
    let file: syn::File = syn::parse2(expansion).unwrap();
    let found = file.items.iter().find_map(|item| match item {
        syn::Item::Struct(item) if item.ident == name => Some(item),
        _ => None,
    });
    found.expect(name).fields.iter().map(|field| field.ident.as_ref().unwrap().to_string()).collect()
}

/// The mechanism, the masses of the bodies, and one field for each number of the effect.
#[test]
fn a_scene_holds_the_parameters_of_its_effects_and_no_others() {
    let all = with_scenes(|_| true);
    let bare = fields(&all, "Bare");
    assert_eq!(bare, ["mechanism", "j2", "m3", "j3", "a3", "b3", "m4", "j4", "a4"]);
    let own: [(&str, &[&str]); 12] = [
        ("Weighed", &["g"]),
        ("Sprung", &["k", "s0", "xp", "yp"]),
        ("Twisted", &["kt", "phi0"]),
        ("Damped", &["c"]),
        ("Pushed", &["f"]),
        ("Turned", &["t0", "kw"]),
        ("Rough", &["mu", "radius", "load"]),
        ("Stopped", &["lower", "upper", "e"]),
        ("Worn", &["mu", "radius"]),
        ("Measured", &[]),
        ("Loaded", &[]),
        ("Driven", &["omega"]),
    ];
    for (scene, own) in own {
        // The motion of a drive needs no masses, but its driving force does.
        let expected: Vec<&str> = bare.iter().map(String::as_str).chain(own.iter().copied()).collect();
        assert_eq!(fields(&all, scene), expected, "{scene}");
    }
}

/// The operations that an effect adds to a derivative are at most those of the same law by hand.
#[test]
fn an_effect_costs_what_it_takes_by_hand() {
    let all = work(source::tokens_of("four_bar_effects"));
    let rates = |scene: &str| all[&(scene.to_owned(), "rates".to_owned())];
    let bare = rates("Bare");
    println!("Bare {bare:?}");
    // W, the bias, M and Q share terms, which count once since an optimising compiler computes them once: with checks, 60
    // multiplications run (`tests/instructions.rs`). One function for all has as many.
    assert!(bare.within(Operations { functions: 4, divisions: 2, multiplications: 57, additions: 25 }), "{bare:?}");
    let limits = [
        // m3 g inside the coupler's product, and m4 g a4 cos theta4 theta4'.
        ("Weighed", [0, 0, 4, 2]),
        // The length, which is a function, k (s - s0) / s, k s0, which is compared with zero, and d . C'.
        ("Sprung", [1, 1, 7, 9]),
        ("Twisted", [0, 0, 2, 2]),
        ("Damped", [0, 0, 2, 1]),
        // f t C'_y.
        ("Pushed", [0, 0, 3, 2]),
        ("Turned", [1, 0, 1, 3]),
        // The runtime receives the forces of contacts separately from the derivative.
        ("Rough", [0, 0, 0, 0]),
        ("Stopped", [0, 0, 0, 0]),
        // Reactions follow from the motion, in functions of their own.
        ("Worn", [0, 0, 0, 0]),
        ("Measured", [0, 0, 0, 0]),
        ("Loaded", [0, 0, 0, 0]),
    ];
    for (scene, [functions, divisions, multiplications, additions]) in limits {
        let found = rates(scene);
        println!("{scene} {found:?}");
        let limit = bare.plus(Operations { functions, divisions, multiplications, additions });
        assert!(found.within(limit), "{scene} {found:?}");
    }
    // A prescribed motion needs no masses, but two derivatives of its law.
    let driven = rates("Driven");
    println!("Driven {driven:?}");
    assert!(driven.within(Operations { functions: 5, divisions: 1, multiplications: 18, additions: 3 }), "{driven:?}");
}
