//! The trait that general algorithms take.

use nalgebra::{SMatrix, SVector};

use crate::error::all_finite;
use crate::{Error, Real, same_signs};

/// Unknowns that are solved together once the groups before them are solved: an Assur group, for instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Group {
    /// The unknowns by name, as errors give them.
    pub name: &'static str,
    /// The closures that determine them: rows of J.
    pub equations: &'static [usize],
    /// The unknowns: columns of J.
    pub unknowns: &'static [usize],
}

/// A mechanism with `U` dependent and `V` independent coordinates, closed where Psi(q) = 0.
///
/// `linkage!` implements it for every mechanism and every driver of one. The functions without `Result` refuse nothing:
/// their results of numbers that are not finite are not finite either, or mean nothing.
pub trait Mechanism<T: Real, const U: usize, const V: usize> {
    /// The name of the mechanism, as errors give it.
    const NAME: &'static str;
    /// The names of the dependent coordinates u, in the order of the columns of J.
    const UNKNOWNS: [&'static str; U];
    /// The names of the independent coordinates v, in the order of the columns of A.
    const INPUTS: [&'static str; V];
    /// The groups, in the order in which they are solved.
    const GROUPS: &'static [Group];
    /// Which unknowns are angles.
    const UNKNOWN_ANGLES: [bool; U];
    /// Which inputs are angles.
    const INPUT_ANGLES: [bool; V];
    /// The coordinates q by name.
    type Coordinates: Copy;
    /// The independent coordinates v by name.
    type Inputs: Copy + Into<SVector<T, V>> + From<SVector<T, V>>;
    /// The dependent coordinates u by name.
    type Unknowns: Copy;
    /// A position ready for use.
    type Pose;
    /// A number for each of [`GROUPS`](Self::GROUPS).
    type BlockDeterminants: Copy + AsRef<[T]> + AsMut<[T]>;

    /// u, taken out of q.
    fn unknowns(q: &Self::Coordinates) -> SVector<T, U>;
    /// v, taken out of q.
    fn inputs(q: &Self::Coordinates) -> SVector<T, V>;
    /// q with other values of v.
    fn with_inputs(q: &Self::Coordinates, inputs: SVector<T, V>) -> Self::Coordinates;
    /// q with other values of u.
    fn with_unknowns(q: &Self::Coordinates, unknowns: SVector<T, U>) -> Self::Coordinates;
    /// The position at these coordinates.
    fn pose_at(&self, q: &Self::Coordinates) -> Self::Pose;
    /// True if every number of a position is finite.
    fn is_finite(pose: &Self::Pose) -> bool;
    /// Psi.
    fn residual(&self, pose: &Self::Pose) -> SVector<T, U>;
    /// The sum of the magnitudes of the terms of each closure.
    fn closure_sizes(&self, pose: &Self::Pose) -> SVector<T, U>;
    /// J, the derivative of Psi by u.
    fn jacobian_unknowns(&self, pose: &Self::Pose) -> SMatrix<T, U, U>;
    /// A, the derivative of Psi by v.
    fn jacobian_inputs(&self, pose: &Self::Pose) -> SMatrix<T, U, V>;
    /// The largest magnitude that each entry of J and of A could have at these lengths.
    fn jacobian_sizes(&self, pose: &Self::Pose) -> (SMatrix<T, U, U>, SMatrix<T, U, V>);
    /// det J.
    fn determinant(&self, pose: &Self::Pose) -> T;
    /// The determinant of each block of J: of each group.
    fn block_determinants(&self, pose: &Self::Pose) -> Self::BlockDeterminants;
    /// The quadratic velocity term (Psi_q q')_q q'.
    fn gamma(&self, pose: &Self::Pose, rate: &Self::Coordinates) -> SVector<T, U>;
    /// Whether the determinant of each block of J has the same sign at both positions: if not, they
    /// belong to different assembly branches. One that is not a number counts as negative.
    fn same_branch(&self, pose: &Self::Pose, other: &Self::Pose) -> bool {
        same_signs(self.block_determinants(pose).as_ref(), self.block_determinants(other).as_ref())
    }
    /// The x of J x = `right`.
    ///
    /// # Errors
    /// [`Error::Singular`] where J has no inverse, [`Error::NotFinite`] if the solution is not finite.
    fn solve_jacobian(&self, pose: &Self::Pose, right: &SVector<T, U>) -> Result<SVector<T, U>, Error>;
}

/// A mechanism whose position has a closed form.
///
/// `linkage!` implements it where all groups have one; of the others some are found by Newton's method.
pub trait Assembly<T: Real, const U: usize, const V: usize>: Mechanism<T, U, V> {
    /// Which solution is meant of each group that has two.
    type Branch: Copy;

    /// The position at these inputs on this branch.
    ///
    /// # Errors
    /// [`Error::Unbuildable`] if a group does not reach, [`Error::Undetermined`] if it can stand anywhere,
    /// [`Error::NotFinite`] if a number is not finite.
    fn assemble(&self, inputs: Self::Inputs, branch: Self::Branch) -> Result<Self::Pose, Error>;
    /// The position at the inputs of a guess on this branch; where the numbers of angles matter, in the turns that are
    /// nearest to the guess instead of those of the branch.
    ///
    /// # Errors
    /// Those of [`assemble`](Self::assemble), and [`Error::OutOfRange`] if a guess is more turns away than a branch can
    /// count.
    fn assemble_near(&self, guess: &Self::Coordinates, branch: Self::Branch) -> Result<Self::Pose, Error> {
        self.assemble(Self::inputs(guess).into(), branch)
    }
    /// The branch that a position belongs to: `assemble` on it gives the position back.
    fn branch_of(&self, pose: &Self::Pose) -> Self::Branch;
}

/// Refuses coordinates and their pose if a number of them is infinite or not a number.
///
/// # Errors
/// [`Error::NotFinite`].
#[inline]
pub(crate) fn finite_position<M, T, const U: usize, const V: usize>(
    q: &M::Coordinates,
    pose: &M::Pose,
) -> Result<(), Error>
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    finite_coordinates::<M, T, U, V>(q)?;
    if M::is_finite(pose) { Ok(()) } else { Err(Error::NotFinite { mechanism: M::NAME, quantity: "the position" }) }
}

/// Refuses coordinates of which one is infinite or not a number.
///
/// # Errors
/// [`Error::NotFinite`].
#[inline]
pub(crate) fn finite_coordinates<M, T, const U: usize, const V: usize>(q: &M::Coordinates) -> Result<(), Error>
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    let (unknowns, inputs) = (M::unknowns(q), M::inputs(q));
    all_finite(M::NAME, "the position", unknowns.iter().chain(inputs.iter()))
}

/// The name of the first group whose determinant changes its sign from one position to another.
pub(crate) fn other_group<M, T, const U: usize, const V: usize>(
    mechanism: &M,
    pose: &M::Pose,
    other: &M::Pose,
) -> &'static str
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    let [these, those] = [pose, other].map(|pose| mechanism.block_determinants(pose));
    let mut pairs = these.as_ref().iter().zip(those.as_ref()).zip(M::GROUPS);
    let group = pairs.find(|((this, that), _)| !same_signs(&[**this], &[**that]));
    group.map(|(_, group)| group.name).unwrap_or_default()
}
