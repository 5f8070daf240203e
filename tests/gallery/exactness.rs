//! What every position satisfies: loops closed, links rigid, and one position by whichever road.

/// A length that follows from a closed loop is right to this many roundings of the sum of all lengths.
pub(super) const ROUNDINGS: f64 = 8.0;

/// Equal to the rounding of lengths whose sum is `size`.
#[track_caller]
pub(super) fn exact(found: f64, expected: f64, size: f64) {
    approx::assert_abs_diff_eq!(found, expected, epsilon = ROUNDINGS * f64::EPSILON * size);
}

/// Every position of a course in closed form, on the branch that the course is on: the same position, loops
/// closed to rounding, and the determinant from the half chord as good as from the angles.
macro_rules! closed_form {
    ($mechanism:ident, $course:ident, $input:ident) => {
        for q in &$course.positions {
            let pose = $mechanism.pose_at(q);
            let found = $mechanism.assemble(q.$input, $mechanism.branch_of(&pose)).expect("an assembly");
            assert_eq!($mechanism.branch_of(&found), $mechanism.branch_of(&pose));
            let size = $mechanism.residual_scales(&found).sum();
            $crate::exactness::exact($mechanism.residual(&found).amax(), 0.0, size);
            let (ours, theirs) = ($mechanism.block_determinants(&found), $mechanism.block_determinants(&pose));
            let (j, other) = ($mechanism.jacobian_unknowns(&found), $mechanism.jacobian_unknowns(&pose));
            approx::assert_abs_diff_eq!((j - other).amax(), 0.0, epsilon = 1e-9 * (1.0 + j.amax()));
            for (ours, theirs) in ours.into_iter().zip(theirs) {
                approx::assert_abs_diff_eq!(ours, theirs, epsilon = 1e-9 * (1.0 + theirs.abs() + size));
            }
        }
        // Whichever way a position is come by, it is the same to the bit.
        let at = |index: usize| {
            let q = &$course.positions[index];
            format!("{:?}", $mechanism.assemble(q.$input, $mechanism.branch_of(&$mechanism.pose_at(q))))
        };
        let in_order: Vec<String> = (0..$course.positions.len()).map(at).collect();
        for step in [36, 170] {
            for index in (0..in_order.len()).map(|count| count * step % in_order.len()) {
                assert_eq!(at(index), in_order[index]);
            }
        }
    };
}

/// Every position of a course from the one before it, group by group where a group has no closed form: the same
/// position, its loops closed to rounding.
macro_rules! from_the_last {
    ($mechanism:ident, $course:ident, $input:ident) => {
        for pair in $course.positions.windows(2) {
            let (mut guess, expected) = (pair[0], $mechanism.pose_at(&pair[1]));
            guess.$input = pair[1].$input;
            let found = $mechanism.assemble_near(&guess, $mechanism.branch_of(&expected)).expect("a position");
            let size = $mechanism.residual_scales(&found).sum();
            $crate::exactness::exact($mechanism.residual(&found).amax(), 0.0, size);
            let (j, other) = ($mechanism.jacobian_unknowns(&found), $mechanism.jacobian_unknowns(&expected));
            approx::assert_abs_diff_eq!((j - other).amax(), 0.0, epsilon = 1e-12 * (1.0 + j.amax()));
        }
    };
}

/// Distances of named points that stay what they are through all positions.
macro_rules! rigid {
    ($course:expr, $($p:ident - $q:ident = $length:expr),+ $(,)?) => {
        let size: f64 = [$($length),+].iter().sum();
        for q in &$course.positions {
            let points = $course.mechanism.points(&$course.mechanism.pose_at(q)).unwrap();
            $($crate::exactness::exact((points.$p - points.$q).norm(), $length, size);)+
        }
    };
}

/// A point, or one of its coordinates, at a position.
macro_rules! point {
    ($mechanism:expr, $point:ident $(, $axis:ident)?) => {
        |q: &_| $mechanism.points(&$mechanism.pose_at(q)).unwrap().$point$(.$axis)?
    };
}
