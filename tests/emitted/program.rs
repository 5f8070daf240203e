//! Programs as text, one line a statement: the computations, checks and calls of each kind of function, before a printer
//! makes Rust of them. A snapshot shows one thing and is named after it.

use linkage_gallery::source;

/// The lowered functions of one driver or scene of a file, as far as they have one of these names.
fn program(file: &str, of: &str, names: &[&str]) -> String {
    let mechanism = linkage_compiler::read(source::tokens_of(file)).expect(file).remove(0);
    let text: String = linkage_compiler::programs(&mechanism).unwrap().concat();
    let mut current = "";
    let mut kept = vec![of];
    for part in text.split("\n\n") {
        let Some((signature, _)) = part.split_once('(') else {
            current = part.trim();
            continue;
        };
        let name = signature.trim_start_matches("inlined ").trim_start_matches("cold ");
        let name = name.trim_start_matches("of a trait ");
        if current == of && names.contains(&name) {
            kept.push(part);
        }
    }
    assert_eq!(kept.len(), 1 + names.len(), "{file}: {of} must have {names:?}");
    kept.join("\n\n")
}

macro_rules! snapshots {
    ($($name:ident: $file:literal $of:literal [$($function:literal),+];)*) => {$(
        #[test]
        fn $name() {
            insta::with_settings!({ omit_expression => true }, {
                insta::assert_snapshot!(stringify!($name), program($file, $of, &[$($function),+]));
            });
        }
    )*};
}

// Positions.
snapshots! {
    pose: "rrr" "Rrr" ["pose_at"];
    pose_with_an_angle_as_a_number: "geared_five_bar" "GearedFiveBar" ["pose_at"];
    pose_with_a_user_function: "cam_rocker" "CamRocker" ["pose_at"];
    branch_with_turns: "jansen" "Jansen" ["branch_of"];
    assembly_on_a_branch: "four_bar" "FourBar" ["assemble", "assemble_near", "branch_of"];
    assembly_of_two_links: "four_bar" "FourBar" ["assemble_in_turns"];
    assembly_of_an_angle_before_a_length: "offset_slider_crank" "OffsetSliderCrank" ["assemble_in_turns"];
    assembly_of_a_turning_slide: "inverted_slider_crank" "InvertedSliderCrank" ["assemble_in_turns"];
    assembly_of_two_groups: "v_twin" "VTwin" ["assemble"];
    assembly_with_a_user_function: "cam_rocker" "CamRocker" ["assemble_in_turns"];
    assembly_by_newton: "double_butterfly" "DoubleButterfly" ["assemble_near"];
    assembly_by_number: "double_butterfly" "DoubleButterfly" ["assemble_remembering", "assemble", "branches", "branch_of"];
    assembly_of_two_loops: "three_rrr" "ThreeRrr" ["assemble_remembering"];
    assembly_of_groups_by_number: "two_triads" "TwoTriads" ["assemble_remembering", "assemble"];
}

// Constraints.
snapshots! {
    residual: "four_bar" "FourBar" ["residual", "residual_scales"];
    jacobian_of_an_angle_and_a_length: "introductory" "Introductory" ["jacobian_unknowns", "determinant"];
    gamma: "introductory" "Introductory" ["gamma"];
    solve_jacobian: "four_bar" "FourBar" ["solve_jacobian"];
    scalar_equation: "scotch_yoke" "ScotchYoke" ["pose_at", "residual", "velocity_ratios"];
}

// Velocities and accelerations.
snapshots! {
    velocity_ratios: "components" "Components" ["velocity_ratios"];
    velocity_ratios_of_two_inputs: "five_bar" "FiveBar" ["velocity_ratios"];
    velocity_by_the_slider: "slider_crank" "Engine" ["velocity"];
    velocity_by_the_crank: "slider_crank" "Compressor" ["velocity"];
    velocity_of_five_groups: "jansen" "Jansen" ["velocity"];
    velocity_with_a_user_function: "cam_rocker" "CamRocker" ["velocity"];
    acceleration: "introductory" "Introductory" ["acceleration"];
    acceleration_of_two_groups: "six_bar" "SixBar" ["acceleration"];
    kinematics: "four_bar" "FourBar" ["kinematics", "full_kinematics", "kinematics_by_parts"];
    kinematics_of_five_groups: "klann" "Klann" ["kinematics"];
    kinematics_by_newton: "double_butterfly" "DoubleButterfly" ["kinematics_near"];
    kinematics_in_twice_the_precision: "double_butterfly" "DoubleButterfly"
        ["velocity_ratios", "precise_velocity_ratios", "precise_kinematics", "widened", "widened_pose", "at_numbers"];
    motion: "four_bar" "FourBar" ["motion"];
    motion_with_a_user_function: "cam_rocker" "CamRocker" ["motion"];
    lanes: "inverted_slider_crank" "InvertedSliderCrank" ["kinematics_in_lane", "quantities_in_lane"];
}

// Points and outputs.
snapshots! {
    points: "four_bar" "FourBar" ["points"];
    point_velocities: "four_bar" "FourBar" ["point_velocities"];
    point_ratios: "four_bar" "FourBar" ["point_ratios"];
    output_ratios: "four_bar" "FourBar" ["output_ratios"];
    outputs_with_a_user_function: "cam_follower" "CamFollower" ["outputs", "output_rates"];
}

// Higher orders.
snapshots! {
    jerk: "norton_four_bar" "NortonFourBar" ["jerk"];
    jerk_by_factorization: "double_butterfly" "DoubleButterfly" ["jerk"];
    point_jerks: "norton_four_bar" "NortonFourBar" ["point_jerks"];
    ratio_derivatives: "norton_four_bar" "NortonFourBar" ["velocity_ratio_derivatives"];
    ratio_derivatives_of_two_inputs: "five_bar" "FiveBar" ["velocity_ratio_derivatives"];
    point_ratio_derivatives: "norton_four_bar" "NortonFourBar" ["point_ratio_derivatives"];
    sensitivity: "norton_four_bar" "NortonFourBar" ["sensitivity"];
    point_sensitivities: "norton_four_bar" "NortonFourBar" ["point_sensitivities"];
}

// Scenes.
snapshots! {
    scene_kinematics: "five_bar_scenes" "Pair" ["ratio_columns", "coordinate_rates", "reduced_motion"];
    scene_inertia: "five_bar_scenes" "Free" ["reduced_inertia"];
    scene_effects: "five_bar_scenes" "Free" ["effects", "reduced_forces"];
    scene_equations: "five_bar_scenes" "Free" ["rates", "mass_matrix", "forces"];
    scene_energy: "four_bar_scenes" "Idle" ["energy"];
    scene_power: "five_bar_scenes" "Free" ["power"];
    scene_equilibrium: "five_bar_scenes" "Free" ["balance"];
    scene_with_a_drive: "five_bar_scenes" "Half" ["rates", "drive_forces", "drives"];
    scene_with_all_inputs_driven: "slider_crank_scenes" "Steady" ["rates", "drive_forces"];
    scene_checks: "four_bar_scenes" "Idle" ["check", "check_effects"];
}

// Open chains.
snapshots! {
    open_chain: "cart_pendulum" "CartPendulum"
        ["assemble", "kinematics", "velocity", "acceleration", "length_scale", "coordinate_rates"];
    open_chain_in_motion: "cart_pendulum" "Rolling" ["rates", "mass_matrix", "equilibrium"];
}

// Contacts.
snapshots! {
    contacts_with_friction: "five_bar_contacts" "Braked" ["contacts"];
    contacts_with_stops: "five_bar_contacts" "Stopped" ["contacts"];
    contact_equations: "five_bar_contacts" "Braked" ["equations"];
    contact_checks: "five_bar_contacts" "Shaken" ["check"];
    unreduced_equations: "five_bar_contacts" "Clamped" ["unreduced"];
}

// Functions of poses, branches and traits.
snapshots! {
    functions_of_a_pose: "geared_five_bar" "GearedFiveBarPose" ["is_finite", "coordinates"];
    branches: "jansen" "JansenBranch" ["all"];
    branches_by_number: "double_butterfly" "DoubleButterflyBranch" ["all"];
    trait_of_a_mechanism: "four_bar" "Mechanism of FourBar" ["pose_at", "is_finite", "branch_of"];
    trait_of_an_open_chain: "cart_pendulum" "Mechanism of CartPendulum" ["pose_at", "is_finite", "branch_of"];
    trait_of_motion: "four_bar" "Kinematic of FourBar"
        ["coordinates_of", "velocity", "velocity_ratios", "points", "output_ratios", "kinematics", "full_kinematics", "motion"];
    trait_of_motion_by_newton: "double_butterfly" "Kinematic of DoubleButterfly" ["kinematics"];
    trait_of_closed_forms: "four_bar" "Assembly of FourBar" ["assemble", "assemble_near"];
    trait_of_lists: "double_butterfly" "Branches of DoubleButterfly" ["all_positions"];
    trait_of_lanes: "inverted_slider_crank" "Lanes of InvertedSliderCrank" ["lane", "exact"];
    trait_of_a_scene: "five_bar_scenes" "Scene of Half" ["derivative", "equations", "contacts", "reactions", "prescribed"];
    trait_of_contacts: "five_bar_contacts" "Scene of Braked" ["equations", "contacts"];
}

/// The motion of sixty loops in a chain, in blocks: each ends between two loops, where the fewest values are used later.
/// Only these leave it: an acceleration of each loop, to be checked at the end, the results of the last loop, to be
/// stored, and the square of its last rate, which the next loop uses too.
#[test]
fn long_functions_are_divided_where_few_values_are_used_later() {
    let one = |i: usize| {
        let before = i - 1;
        format!("param a{i}, b{i}, c{i}; unknown u{i}, w{i}; loop a{i}@w{before} + b{i}@u{i} = c{i}@w{i} + d@0;")
    };
    let loops: String = (1..=60).map(one).collect();
    let source = format!("mechanism Chain {{ param d; input w0; {loops} }}");
    let mechanism = linkage_compiler::read(source.parse().unwrap()).unwrap().remove(0);
    let text = linkage_compiler::programs(&mechanism).unwrap().concat();
    let motion = text.split("\n\n").find(|part| part.starts_with("motion(")).unwrap();
    let blocks: Vec<_> = motion.lines().filter_map(|line| line.trim().split_once(" = {")).collect();
    assert!(blocks.len() > 3, "{blocks:?}");
    let mut first = 1;
    for (names, _) in blocks {
        let names: Vec<_> = names.trim_matches(['(', ')']).split(", ").collect();
        let last =
            first + names.iter().filter(|name| name.starts_with('u') && name.ends_with("_acceleration")).count() - 1;
        let mut expected: Vec<_> = (first..last).map(|i| format!("u{i}_acceleration")).collect();
        // The last block ends with the last check: all rates are stored in it.
        if last < 60 {
            expected.extend(["u#_rate", "w#_rate", "w#_rate_squared"].map(|name| name.replace('#', &last.to_string())));
        }
        expected.extend(['u', 'w'].map(|unknown| format!("{unknown}{last}_acceleration")));
        assert_eq!(names, expected);
        first = last + 1;
    }
    assert_eq!(first, 61);
}
