//! The two solutions of an Assur group, named by their geometry.

use crate::{Name, PositionError, Real};

/// The choice between the two solutions of a group, which differ in the sign of a square root.
pub trait Side: Copy + PartialEq {
    /// The solution of the positive root.
    const OF_POSITIVE_ROOT: Self;
    /// The solution of the negative root.
    const OF_NEGATIVE_ROOT: Self;

    /// A positive root with the sign of this side.
    #[inline]
    #[must_use]
    fn signed<T: Real>(self, root: T) -> T {
        if self == Self::OF_POSITIVE_ROOT { root } else { -root }
    }
}

macro_rules! choices {
    ($($(#[$docs:meta])* $name:ident { $(#[$plus_docs:meta])* $plus:ident, $(#[$minus_docs:meta])* $minus:ident })*) => {$(
        $(#[$docs])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub enum $name {
            $(#[$plus_docs])*
            $plus,
            $(#[$minus_docs])*
            $minus,
        }

        impl Side for $name {
            const OF_POSITIVE_ROOT: Self = Self::$plus;
            const OF_NEGATIVE_ROOT: Self = Self::$minus;
        }
    )*};
}

// The choice is the sign of the determinant of the group's block of J, up to the order of its rows and columns. So a
// motion changes it only where the group is singular.
choices! {
    /// The side on which the middle joint of a dyad of two links (RRR) lies.
    ///
    /// It is seen along the line from the outer joint of the link that the group names first to the outer joint of the
    /// other.
    Elbow {
        /// Left of the line.
        Left,
        /// Right of the line.
        Right
    }
    /// The position of a slider on its guide (RRP, RPR), by its length as an unknown.
    Slider {
        /// The larger of the two solutions for the length.
        Far,
        /// The smaller of the two solutions for the length.
        Near
    }
    /// The choice between the two angles that solve a scalar equation a cos(phi) + b sin(phi) = h.
    Slope {
        /// The left side minus the right side increases with the angle.
        Rising,
        /// The left side minus the right side decreases as the angle increases.
        Falling
    }
}

/// A position with its branch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Assembled<B, P> {
    /// The branch.
    pub branch: B,
    /// The position on it.
    pub pose: P,
}

/// A value for each list of numbers below these counts; the last number changes fastest.
pub fn combinations<B, const N: usize>(
    counts: [usize; N],
    of: impl Fn([usize; N]) -> B + Clone,
) -> impl Iterator<Item = B> + Clone {
    (0..counts.iter().product()).map(move |place| {
        let (mut numbers, mut left) = (counts, place);
        for number in numbers.iter_mut().rev() {
            let count = *number;
            // No count is zero here, which the compiler of the emitted code cannot know.
            *number = left.checked_rem(count).unwrap_or_default();
            left = left.checked_div(count).unwrap_or_default();
        }
        of(numbers)
    })
}

/// Returns the solution of the positive root for 0, and that of the negative root for others.
#[must_use]
pub fn side_at<S: Side>(number: usize) -> S {
    if number == 0 { S::OF_POSITIVE_ROOT } else { S::OF_NEGATIVE_ROOT }
}

/// Assembles each of these branches. A branch with no position, or with infinitely many, is left out, and so is one on
/// which an implied loop does not close.
///
/// # Errors
/// Any other error of a branch, before the first position.
pub fn existing<B: Copy, P, S: Name>(
    branches: impl Iterator<Item = B> + Clone,
    mut assemble: impl FnMut(B) -> Result<P, PositionError<S>>,
) -> Result<impl Iterator<Item = Assembled<B, P>>, PositionError<S>> {
    for branch in branches.clone() {
        match assemble(branch) {
            Ok(_)
            | Err(
                PositionError::Unbuildable { .. }
                | PositionError::NoMode { .. }
                | PositionError::Undetermined { .. }
                | PositionError::NotImplied { .. },
            ) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(branches.filter_map(move |branch| Some(Assembled { branch, pose: assemble(branch).ok()? })))
}

/// Returns the side from the sign bit of a root: at a dead point, where the root is zero, from the sign of that zero.
#[must_use]
pub fn side_of<T: Real, S: Side>(root: T) -> S {
    if root.is_sign_positive() { S::OF_POSITIVE_ROOT } else { S::OF_NEGATIVE_ROOT }
}

#[cfg(test)]
mod tests {
    use super::{Elbow, combinations, side_at};

    #[test]
    fn the_last_number_of_a_combination_changes_fastest() {
        let all = combinations([2, 1, 3], |numbers| numbers);
        let expected = [[0, 0, 0], [0, 0, 1], [0, 0, 2], [1, 0, 0], [1, 0, 1], [1, 0, 2]];
        assert!(all.clone().eq(expected), "{:?}", all.collect::<Vec<_>>());
        assert_eq!(combinations([], |[]| "one").count(), 1);
    }

    #[test]
    fn the_first_side_is_that_of_the_positive_root() {
        assert_eq!([0, 1].map(side_at::<Elbow>), [Elbow::Left, Elbow::Right]);
    }
}
