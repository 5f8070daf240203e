//! The emitted Rust, pretty-printed, as snapshots: what a user finds who looks behind the macro.
//!
//! The types differ little from one mechanism to the next and are shown once; of the other mechanisms
//! the functions that say most are shown.

use linkage_gallery::source;
use proc_macro2::TokenStream;

/// Expands a mechanism of `tests/mechanisms` and pretty-prints the items that `keep` accepts.
fn expand(file: &str) -> syn::File {
    let root: TokenStream = "::linkage".parse().unwrap();
    let tokens = linkage_compiler::expand(source::tokens_of(file), &root);
    syn::parse2(tokens).unwrap()
}

/// The functions of these names, in the order in which they were emitted.
fn functions(file: &str, names: &[&str]) -> String {
    let mut file = expand(file);
    let mut kept = Vec::new();
    let mut keep = |item: syn::Item| {
        let syn::Item::Impl(mut item) = item else { return };
        item.items.retain(
            |item| matches!(item, syn::ImplItem::Fn(function) if names.iter().any(|name| function.sig.ident == name)),
        );
        if item.trait_.is_none() && !item.items.is_empty() {
            kept.push(syn::Item::Impl(item));
        }
    };
    for item in std::mem::take(&mut file.items) {
        let syn::Item::Const(block) = item else {
            keep(item);
            continue;
        };
        let syn::Expr::Block(block) = *block.expr else { continue };
        for statement in block.block.stmts {
            if let syn::Stmt::Item(item) = statement {
                keep(item);
            }
        }
    }
    file.items = kept;
    prettyplease::unparse(&file)
}

macro_rules! snapshot {
    ($name:ident, $value:expr) => {
        #[test]
        fn $name() {
            insta::with_settings!({ prepend_module_to_snapshot => false, omit_expression => true }, {
                insta::assert_snapshot!(stringify!($name), $value);
            });
        }
    };
}

snapshot!(four_bar_types, {
    let mut file = expand("four_bar");
    file.items.retain(|item| matches!(item, syn::Item::Struct(_)));
    prettyplease::unparse(&file)
});
snapshot!(
    four_bar_closures,
    functions(
        "four_bar",
        &["pose_at", "residual", "residual_scales", "jacobian_unknowns", "jacobian_inputs", "jacobian", "determinant"]
    )
);
snapshot!(
    four_bar_kinematics,
    functions("four_bar", &["solve_jacobian", "velocity_ratios", "velocity", "gamma", "acceleration"])
);
snapshot!(four_bar_assemble, functions("four_bar", &["assemble", "assemble_in_turns", "assemble_near", "branch_of"]));
snapshot!(
    inverted_slider_crank,
    functions("inverted_slider_crank", &["assemble", "assemble_in_turns", "assemble_near", "branch_of"])
);
snapshot!(
    offset_slider_crank,
    functions("offset_slider_crank", &["assemble", "assemble_in_turns", "assemble_near", "branch_of"])
);
snapshot!(v_twin, functions("v_twin", &["assemble", "assemble_in_turns"]));
snapshot!(four_bar_motion, functions("four_bar", &["motion"]));
snapshot!(components, functions("components", &["pose_at", "residual", "velocity_ratios"]));
snapshot!(rpr, functions("rpr", &["pose_at", "jacobian_unknowns", "determinant", "velocity"]));
snapshot!(five_bar, functions("five_bar", &["velocity_ratios", "velocity", "points", "outputs"]));
snapshot!(scotch_yoke, functions("scotch_yoke", &["pose_at", "residual", "velocity_ratios", "motion"]));
snapshot!(cam_follower, functions("cam_follower", &["pose_at", "outputs", "output_velocities"]));
snapshot!(every_function, functions("every_function", &["outputs"]));

/// The irreducible block of six unknowns is factorised once a function, whatever stands on its right.
#[test]
fn one_factorisation_serves_all_right_sides() {
    // W and L; of the sixteen parameters each moves some closure.
    for (name, right_sides) in [("jerk", 1), ("velocity_ratio_derivatives", 2), ("sensitivity", 16)] {
        let text = functions("double_butterfly", &[name]);
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

/// The functions of one scene of several.
fn of_scene(file: &str, scene: &str, names: &[&str]) -> String {
    let text = functions(file, names);
    let mut file: syn::File = syn::parse_str(&text).unwrap();
    let is_of =
        |item: &syn::ItemImpl| matches!(&*item.self_ty, syn::Type::Path(path) if path.path.segments[0].ident == scene);
    file.items.retain(|item| matches!(item, syn::Item::Impl(item) if is_of(item)));
    prettyplease::unparse(&file)
}

snapshot!(
    four_bar_idle,
    of_scene(
        "four_bar_scenes",
        "Idle",
        &[
            "reduced_inertia",
            "effects",
            "reduced_forces",
            "mass_matrix",
            "forces",
            "rates",
            "energy",
            "check",
            "check_effects"
        ]
    )
);
snapshot!(
    slider_crank_steady,
    of_scene("slider_crank_scenes", "Steady", &["effects", "rates", "drive_forces", "power"])
);

/// The statements of `four_bar_scenes` that `keep` accepts, and its expansion without white space by items.
fn part_of_scenes(keep: impl Fn(&str) -> bool) -> Vec<String> {
    let kept = source::with_statements(source::tokens_of("four_bar_scenes"), keep);
    let expansion = linkage_compiler::expand(kept, &"::linkage".parse().unwrap());
    let file: syn::File = syn::parse2(expansion).unwrap();
    let alone = |item: &syn::Item| prettyplease::unparse(&syn::File { items: vec![item.clone()], ..file.clone() });
    file.items.iter().map(alone).collect()
}

/// Whatever else is declared, a scene is the same code, and so is the mechanism: what is not called for costs nothing.
#[test]
fn what_a_scene_does_not_name_is_not_there() {
    let all = part_of_scenes(|_| true);
    let forces = ["param m2", "param g", "param k", "body", "scene", "let"];
    let bare = part_of_scenes(|statement| !forces.iter().any(|word| statement.starts_with(word)));
    assert!(bare.len() > 12);
    // The order of some terms depends on what was read first, the work does not.
    let work = |item: &String| {
        let lines = item.lines().filter(|line| line.contains("Operations: ") || line.contains("pub "));
        let mut lines: Vec<&str> = lines.map(str::trim).collect();
        // The springs on theta4 ask for its number, which the pose and the branch of the mechanism hold.
        while let Some(place) = lines.iter().position(|line| line.contains("fn assemble")) {
            let operations = lines[..place].last().is_some_and(|line| line.contains("Operations: "));
            lines.drain(place - usize::from(operations)..=place);
        }
        lines.retain(|line| !line.ends_with("_angle: T,") && !line.ends_with("_turn: i32,"));
        lines.join("\n")
    };
    let works: Vec<String> = all.iter().map(work).collect();
    for item in &bare {
        assert!(works.contains(&work(item)), "{item}");
    }
    let others = ["param k", "scene Loaded", "scene Driven", "scene Balanced", "let"];
    let idle = part_of_scenes(|statement| !others.iter().any(|word| statement.starts_with(word)));
    assert!(idle.iter().any(|item| item.contains("impl<T: __rt::Real> Idle<T>")));
    for item in &idle {
        assert!(works.contains(&work(item)), "{item}");
    }
    assert!(idle.iter().all(|item| !item.contains("kt") && !item.contains("omega")));
}
