//! Hard cases, one a file, each with the program or the formula that is known to fail there. If the usual formula
//! fails, the test runs it too and checks that it fails; the reference are 48-digit floats.

mod all_flat_at_once;
mod bad_input;
mod coincident_joints;
mod dead_centre;
mod equal_link_slider_crank;
mod extreme_inputs;
mod freudenstein_half_angle;
mod freudenstein_roth;
mod locked_second_group;
mod many_turns;
mod near_change_point;
mod near_dead_points;
mod near_parallel_links;
mod needle_triangle;
mod oblique_guides;
mod parallelogram_change_point;
mod random_steps;
mod scale_and_offset;
mod slider_through_tangency;
mod tangent_circles;
mod three_joints_in_line;
mod three_sides_to_an_angle;
mod turns;
mod wrong_side;

use linkage_oracle::precise::{Big, Scalar, big};

/// |found - expected| / |expected|.
fn relative(found: f64, expected: &Big) -> f64 {
    let difference = (big(found) - expected).double().abs();
    if difference == 0.0 { 0.0 } else { difference / expected.double().abs() }
}

/// A mechanism of two links between given joints: a triangle from its sides.
mod triangle {
    use linkage::linkage;

    linkage! {
        /// Two links between the origin and a given joint.
        #[derive(Debug, Clone, PartialEq)]
        pub mechanism Triangle {
            param p = 1, q = 1;
            input x, y;
            unknown alpha, beta;

            loop p@alpha + q@beta = (x, y);

            point Apex = p@alpha;
        }
    }
}
