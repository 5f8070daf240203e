//! An assembled pose is the pose at its coordinates: directions, determinants and all that follows from them.
//!
//! `assemble` finds by algebra what `pose_at` computes from the angles, and J itself gives the determinants.

use linkage::{Assembly, D, Dim, Mechanism, linkage};
use linkage_oracle::close;
use nalgebra::{DMatrix, DVector};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_gallery::multiples::*;
use linkage_gallery::slider_named_first::*;
use linkage_gallery::three_together::*;

linkage! {
    /// Each equation determines the unknown of the other: two exchanges of columns, which cancel.
    pub mechanism Crosswise {
        param k = 2;
        input v;
        unknown a, b, c, d;
        equation 3 * b = v;
        equation 5 * a = k * v;
        equation 7 * d = a + v;
        equation 2 * c = b - d;
    }
}

/// Determinants and velocity ratios of a pose against those of the matrices that it gives.
fn agrees_with_its_matrices<M: Mechanism<Scalar = f64, V = D<1>>>(m: &M, pose: &M::Pose) {
    let jacobian = m.jacobian_unknowns(pose);
    let jacobian = DMatrix::from_fn(M::U::CAPACITY, M::U::CAPACITY, |row, column| jacobian[(row, column)]);
    let determinant = jacobian.clone().lu().determinant();
    let size: f64 = jacobian.column_iter().map(|column| column.norm()).product();
    close("det J", m.determinant(pose), determinant, 1e-12 * size.max(1e-3));
    let right = m.jacobian_inputs(pose).column(0);
    let expected = jacobian.lu().solve(&DVector::from_column_slice(right.as_slice())).unwrap();
    let found = m.solve_jacobian(pose, &right).unwrap();
    let size = expected.amax().max(1.0);
    for (found, expected) in found.iter().zip(&expected) {
        close("velocity ratio", *found, *expected, 1e-12 * size.max(1e-3));
    }
}

/// Assembled poses of all branches at random inputs; `more` compares further numbers of them.
fn agrees<M>(
    m: &M,
    branches: impl Fn() -> Vec<M::Branch>,
    coordinates: impl Fn(&M::Pose) -> M::Coordinates,
    more: impl Fn(&M::Pose, &M::Pose),
) where
    M: Assembly<Scalar = f64, V = D<1>>,
{
    let random = &mut SmallRng::seed_from_u64(11);
    let mut found = 0;
    for _ in 0..200 {
        let input = M::Inputs::from([random.random_range(-7.0..7.0)].into());
        for branch in branches() {
            let Ok(pose) = m.assemble(input, branch) else { continue };
            let again = m.pose_at(&coordinates(&pose));
            let [these, those] = [&pose, &again].map(|pose| m.block_determinants(pose));
            for ((this, that), group) in these.iter().zip(&those).zip(M::GROUPS) {
                close(group.name, *this, *that, 1e-10);
            }
            assert!(m.residual(&pose).largest() < 1e-13 && m.same_branch(&pose, &again));
            agrees_with_its_matrices(m, &pose);
            agrees_with_its_matrices(m, &again);
            more(&pose, &again);
            found += 1;
        }
    }
    assert!(found > 200, "{found} positions only");
}

#[test]
fn the_order_of_the_unknowns_does_not_matter() {
    let m = SliderNamedFirst::default();
    agrees(
        &m,
        || SliderNamedFirstBranch::all().collect(),
        SliderNamedFirstPose::coordinates,
        |pose, again| {
            let [these, those] =
                [pose, again].map(|pose| m.point_velocities(pose, &m.velocity(pose, 1.0).unwrap()).unwrap());
            assert!((these.a - those.a).amax() < 1e-11 && (these.b - those.b).amax() < 1e-11);
        },
    );
}

#[test]
fn multiples_of_solved_angles() {
    let m = Multiples::default();
    agrees(
        &m,
        || MultiplesBranch::all().collect(),
        MultiplesPose::coordinates,
        |pose, again| {
            let q = pose.coordinates();
            let turned = |x: f64, y: f64, angle: f64| {
                let (sine, cosine) = angle.sin_cos();
                nalgebra::vector![x * cosine - y * sine, x * sine + y * cosine]
            };
            let expected = [
                turned(3.0, 0.0, q.u - q.w),
                turned(2.0, 0.0, -q.w),
                turned(2.0, 0.0, 2.0 * q.u),
                turned(1.0, 2.0, -3.0 * q.w + q.v),
                turned(2.0, 0.0, -4.0 * q.u + 2.0 * q.w - q.v),
                turned(1.0, 0.0, 5.0 * q.u - 6.0 * q.w),
            ];
            for pose in [pose, again] {
                let points: [nalgebra::Point2<f64>; 6] = m.points(pose).unwrap().into();
                for (found, expected) in points.iter().zip(expected) {
                    assert!((found.coords - expected).amax() < 1e-13, "{found} is not {expected}");
                }
                let outputs = m.outputs(pose).unwrap();
                close("sin(u - w)", outputs.difference, (q.u - q.w).sin(), 1e-12);
                close("cos(1 - w) + sin(-2 u)", outputs.opposite, (1.0 - q.w).cos() - (2.0 * q.u).sin(), 1e-12);
            }
        },
    );
}

#[test]
fn exchanges_that_cancel() {
    let m = Crosswise::default();
    agrees(
        &m,
        || CrosswiseBranch::all().chain(CrosswiseBranch::all()).collect(),
        CrosswisePose::coordinates,
        |pose, _| {
            assert_eq!(m.determinant(pose), 3.0 * 5.0 * 7.0 * 2.0);
        },
    );
}

/// A group of three unknowns is factorised: its determinant has no formula.
#[test]
fn three_unknowns_together() {
    let m = ThreeTogether::default();
    let mut q = ThreeTogetherCoordinates { phi: 0.9, psi: 0.1, x: 0.2, v: 3.0 };
    for step in 0..100 {
        q = m.solve(&ThreeTogetherCoordinates { v: 3.0 + 0.01 * f64::from(step), ..q }).unwrap().coordinates;
        let pose = m.pose_at(&q);
        assert_eq!(ThreeTogether::<f64>::GROUPS.len(), 1);
        agrees_with_its_matrices::<ThreeTogether>(&m, &pose);
        // Against the position a little further.
        let h = 1e-5;
        let [after, before] = [h, -h].map(|h| {
            let near = m.solve(&ThreeTogetherCoordinates { v: q.v + h, ..q }).unwrap().coordinates;
            ThreeTogether::unknowns(&near)
        });
        let ratios = m.velocity_ratios(&pose).unwrap();
        assert!(((after - before) / (2.0 * h) - ratios.into()).largest() < 1e-8);
    }
}
