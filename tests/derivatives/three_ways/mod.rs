//! One mechanism, written with angles, with the coordinates of its joints, with distances, or with angles against the sense
//! of rotation: `assemble` gives the same positions.
//!
//! Each file is one mechanism in several ways, with the same points in the same order.

use linkage::Mechanism;
use nalgebra::Point2;

/// The points of each position that exists, and the condition number of the position.
type Positions = Vec<(Vec<Point2<f64>>, f64)>;

/// Points agree to this many ulps of the largest coordinate, times the condition number. The largest difference found is 3.0.
const ULPS: f64 = 8.0;

/// The reciprocal of Hadamard's ratio of J: |det J| divided by the product of the norms of its columns.
fn condition<M: Mechanism<Scalar = f64>>(m: &M, pose: &M::Pose) -> f64 {
    let columns = m.jacobian_unknowns(pose);
    let product: f64 = columns.columns().iter().map(|column| column.norm()).product();
    product / m.determinant(pose).abs()
}

/// True if each residual is at most 64 epsilon times the sum of the magnitudes of its terms.
fn closes<M: Mechanism<Scalar = f64>>(m: &M, pose: &M::Pose) -> bool {
    let (residual, scales) = (m.residual(pose), m.residual_scales(pose));
    residual.iter().zip(scales.iter()).all(|(residual, scale)| residual.abs() <= 64.0 * f64::EPSILON * scale)
}

/// The positions of a mechanism on all branches. Each closes, and its branch is that of its determinants.
macro_rules! positions {
    ($Mechanism:ident, $inputs:expr) => {{
        let m = $Mechanism::default();
        let found: crate::three_ways::Positions = m
            .branches($inputs)
            .unwrap()
            .map(|linkage::Assembled { branch, pose }| {
                assert_eq!(m.branch_of(&pose), branch);
                assert!(
                    crate::three_ways::closes(&m, &pose),
                    "{:?}: {:?}",
                    branch,
                    linkage::Mechanism::residual(&m, &pose)
                );
                let points: [nalgebra::Point2<f64>; _] = m.points(&pose).unwrap().into();
                (points.to_vec(), crate::three_ways::condition(&m, &pose))
            })
            .collect();
        found
    }};
}
use positions;

/// Checks that some mechanisms have as many positions as the first, and the same.
macro_rules! same {
    ($inputs:expr; $First:ident $(, $Other:ident)+) => {{
        let first = crate::three_ways::positions!($First, $inputs);
        $(crate::three_ways::compare(stringify!($Other), &first, &crate::three_ways::positions!($Other, $inputs));)+
        first.len()
    }};
}
use same;

fn compare(name: &str, first: &Positions, other: &Positions) {
    assert_eq!(first.len(), other.len(), "{name}");
    let mut left: Vec<_> = other.iter().collect();
    for (points, condition) in first {
        let size = points.iter().map(|point| point.coords.amax()).fold(0.0, f64::max);
        let difference = |other: &[Point2<f64>]| {
            points.iter().zip(other).map(|(point, other)| (point - other).amax()).fold(0.0, f64::max)
        };
        let near = (0..left.len()).min_by(|&i, &j| difference(&left[i].0).total_cmp(&difference(&left[j].0))).unwrap();
        let (nearest, other_condition) = left.remove(near);
        let ulps = difference(nearest) / (size * f64::EPSILON * condition.max(*other_condition));
        assert!(ulps <= ULPS, "{name}: {ulps} ulp, {points:?} {nearest:?}");
    }
}

mod cylinder;
mod five_bar;
mod four_bar;
mod inverted_slider_crank;
mod limits;
mod peaucellier;
mod reactions;
mod slider_crank;
mod stephenson;
mod trammel;
mod v_twin;
mod watt;
