//! Conditions on every position of a course: loops are closed, links are rigid, and all methods find the same position.

use linkage::{Assembly, D, Kinematic, Mechanism, PositionError};
use nalgebra::Point2;

use super::course::Course;

/// Error of a length that follows from a closed loop, in epsilons of the sum of all lengths.
pub(super) const EPSILONS: f64 = 8.0;

/// Compares lengths whose sum is `size`, to rounding error.
#[track_caller]
pub(super) fn exact(found: f64, expected: f64, size: f64) {
    approx::assert_abs_diff_eq!(found, expected, epsilon = EPSILONS * f64::EPSILON * size);
}

impl<M: Mechanism<Scalar = f64, V = D<1>>> Course<'_, M> {
    /// Checks that the distances between points are constant: two points and their distance.
    #[track_caller]
    pub(super) fn rigid<P, const N: usize>(
        &self,
        points: impl Fn(&M, &M::Pose) -> Result<P, PositionError>,
        links: impl Fn(P) -> [(Point2<f64>, Point2<f64>, f64); N],
    ) {
        for q in &self.positions {
            let links = links(points(self.mechanism, &self.mechanism.pose_at(q)).expect("finite points"));
            let size: f64 = links.iter().map(|(_, _, length)| length).sum();
            for (one, other, length) in links {
                exact((one - other).norm(), length, size);
            }
        }
    }

    /// Checks that `assemble_near`, group by group from the last position, finds each position with its loops closed.
    #[track_caller]
    pub(super) fn assembles_from_the_last(
        &self,
        assemble_near: impl Fn(&M::Coordinates, &M::Pose) -> Result<M::Pose, PositionError>,
    ) {
        let m = self.mechanism;
        for pair in self.positions.windows(2) {
            let expected = m.pose_at(&pair[1]);
            let guess = M::with_inputs(&pair[0], M::inputs(&pair[1]));
            let found = assemble_near(&guess, &expected).expect("a position");
            self.is_closed(&found);
            self.same_jacobian(&found, &expected, 1e-12);
        }
    }

    #[track_caller]
    fn is_closed(&self, found: &M::Pose) {
        let size = self.mechanism.residual_scales(found).sum();
        exact(self.mechanism.residual(found).largest(), 0.0, size);
    }

    #[track_caller]
    fn same_jacobian(&self, found: &M::Pose, expected: &M::Pose, tolerance: f64) {
        let [found, expected] = [found, expected].map(|pose| self.mechanism.jacobian_unknowns(pose));
        approx::assert_abs_diff_eq!((found - expected).largest(), 0.0, epsilon = tolerance * (1.0 + found.largest()));
    }
}

impl<M: Assembly + Kinematic<Scalar = f64, V = D<1>>> Course<'_, M> {
    /// Checks the closed form on the branch of the course: it finds each position with its loops closed, and its
    /// determinants, from the half chord, are those from the angles.
    #[track_caller]
    pub(super) fn closed_form(&self) {
        let m = self.mechanism;
        for q in &self.positions {
            let expected = m.pose_at(q);
            let branch = m.branch_of(&expected);
            let found = self.assembled(q);
            assert_eq!(m.branch_of(&found), branch);
            self.is_closed(&found);
            self.same_jacobian(&found, &expected, 1e-9);
            let size = m.residual_scales(&found).sum();
            for (ours, theirs) in m.block_determinants(&found).iter().zip(&m.block_determinants(&expected)) {
                approx::assert_abs_diff_eq!(*ours, *theirs, epsilon = 1e-9 * (1.0 + theirs.abs() + size));
            }
        }
        // In any order of calls each position is the same to the last bit.
        let at = |index: usize| bits(m, &self.assembled(&self.positions[index]));
        let in_order: Vec<_> = (0..self.positions.len()).map(at).collect();
        for step in [36, 170] {
            for index in (0..in_order.len()).map(|count| count * step % in_order.len()) {
                assert_eq!(at(index), in_order[index]);
            }
        }
    }

    #[track_caller]
    fn assembled(&self, q: &M::Coordinates) -> M::Pose {
        let branch = self.mechanism.branch_of(&self.mechanism.pose_at(q));
        self.mechanism.assemble(M::inputs(q).into(), branch).expect("an assembly")
    }
}

/// The bits of the coordinates of a pose and of all numbers that the constraints make of it.
fn bits<M: Kinematic<Scalar = f64>>(m: &M, pose: &M::Pose) -> Vec<u64> {
    let (unknowns, inputs) = M::parts(&M::coordinates_of(pose));
    let (residual, determinants, determinant) = (m.residual(pose), m.block_determinants(pose), m.determinant(pose));
    let (j, a) = (m.jacobian_unknowns(pose), m.jacobian_inputs(pose));
    let columns = [unknowns.as_slice(), inputs.as_slice(), residual.as_slice(), determinants.as_slice()];
    let numbers = columns.into_iter().flatten().chain(j.iter()).chain(a.iter()).chain([&determinant]);
    numbers.map(|number| number.to_bits()).collect()
}
