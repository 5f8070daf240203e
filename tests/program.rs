//! Programs as text, one line a statement, as snapshots: what each function computes, checks and calls, before a printer
//! makes a language of it.

use linkage_gallery::source;
/// The lowered program of the first mechanism of a file, as far as its functions have one of these names.
fn program(file: &str, names: &[&str]) -> String {
    let mechanism = linkage_compiler::read(source::tokens_of(file)).expect(file).remove(0);
    let text: String = linkage_compiler::programs(&mechanism).concat();
    let is_wanted = |part: &&str| {
        let name = part.trim_start_matches("inlined ").trim_start_matches("cold ").split('(').next();
        !part.contains('(') || names.iter().any(|wanted| name == Some(wanted))
    };
    text.split("\n\n").filter(is_wanted).collect::<Vec<_>>().join("\n\n")
}

macro_rules! snapshot {
    ($name:ident, $file:literal, $names:expr) => {
        #[test]
        fn $name() {
            insta::with_settings!({ omit_expression => true }, {
                insta::assert_snapshot!(stringify!($name), program($file, &$names));
            });
        }
    };
}

snapshot!(
    higher_orders,
    "norton_four_bar",
    [
        "jerk",
        "point_jerks",
        "output_jerks",
        "velocity_ratio_derivatives",
        "point_ratio_derivatives",
        "output_ratio_derivatives",
        "sensitivity",
        "point_sensitivities",
        "output_sensitivities"
    ]
);
snapshot!(ratio_derivatives, "five_bar", ["velocity_ratio_derivatives", "point_ratio_derivatives"]);
snapshot!(six_unknowns_together, "double_butterfly", ["assemble_near", "jerk"]);
snapshot!(four_bar, "four_bar", ["points", "point_velocities", "point_ratios", "output_ratios", "solve_jacobian"]);
snapshot!(
    introductory,
    "introductory",
    ["pose_at", "residual", "jacobian_unknowns", "determinant", "velocity_ratios", "gamma", "acceleration"]
);
snapshot!(slider_crank, "slider_crank", ["pose_at", "jacobian_unknowns", "determinant", "velocity_ratios", "velocity"]);
snapshot!(dyad, "rrr", ["pose_at", "residual", "determinant", "velocity_ratios", "velocity"]);
snapshot!(six_bar, "six_bar", ["pose_at", "residual", "determinant", "velocity_ratios", "acceleration"]);
snapshot!(geared_five_bar, "geared_five_bar", ["pose_at", "residual", "velocity", "outputs"]);
snapshot!(
    cam_rocker,
    "cam_rocker",
    ["pose_at", "assemble_in_turns", "assemble_near", "residual", "velocity", "acceleration", "motion"]
);
snapshot!(jansen, "jansen", ["assemble", "velocity", "branch_of"]);
snapshot!(
    five_bar_scenes,
    "five_bar_scenes",
    [
        "ratio_columns",
        "coordinate_rates",
        "kinematics_at",
        "reduced_inertia",
        "effects",
        "reduced_forces",
        "mass_matrix",
        "forces",
        "rates",
        "drives",
        "drive_forces",
        "power",
        "balance",
        "blame"
    ]
);
snapshot!(five_bar_contacts, "five_bar_contacts", ["contacts", "equations", "unreduced", "check"]);
