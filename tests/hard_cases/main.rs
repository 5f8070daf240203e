//! Hard cases: positions at which a formula or a program in common use is known to fail. In each the usual form runs
//! beside the emitted code and is seen to fail; the reference are 48-digit floats.

mod equal_link_slider_crank;
mod freudenstein_half_angle;
mod near_parallel_links;
mod needle_triangle;
mod oblique_guides;
mod scale_and_offset;
mod slider_through_tangency;
mod tangent_circles;
mod three_sides_to_an_angle;
mod turns;

#[path = "../oracle/precise.rs"]
#[allow(dead_code)]
mod precise;

use precise::{Big, Scalar, big};

/// |found - expected| / |expected|.
fn relative(found: f64, expected: &Big) -> f64 {
    let difference = (big(found) - expected).double().abs();
    if difference == 0.0 { 0.0 } else { difference / expected.double().abs() }
}

/// A mechanism of two links between joints that are given: a triangle from its sides.
mod triangle {
    use linkage::linkage;

    linkage! {
        /// Two links between the origin and a joint that is given.
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
