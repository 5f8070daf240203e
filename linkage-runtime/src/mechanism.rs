//! The trait that every emitted mechanism implements.

use core::fmt::{self, Debug, Display, Formatter};

use crate::error::all_finite;
use crate::linear::same_signs;
use crate::scalar::arithmetic::*;
use crate::scalar::to_f64;
use crate::shown::Shown;
use crate::{
    BorrowedName, Build, Column, Dim, Group, InputError, Matrix, Name, PathError, PositionError, Ranged, Real,
};

/// A number for each dependent coordinate of a mechanism, or for each constraint.
pub type PerUnknown<M> = Column<<M as Mechanism>::Scalar, <M as Mechanism>::U>;

/// A number for each independent coordinate of a mechanism.
pub type PerInput<M> = Column<<M as Mechanism>::Scalar, <M as Mechanism>::V>;

/// The error of a position, with names of a mechanism.
pub type PositionErrorOf<M> = PositionError<<M as Mechanism>::Name>;

/// The error of a path, with names of a mechanism.
pub type PathErrorOf<M> = PathError<<M as Mechanism>::Name>;

/// A mechanism with constraints Psi(q) = 0, q = (u, v), which determine its dependent coordinates u from its
/// independent coordinates v. An open chain has none: U and G are 0, and J, without rows, is regular.
///
/// `linkage!` implements it for every mechanism and every driver of one. Functions that do not return a `Result` check
/// nothing: for numbers that are not finite their results are not finite or have no meaning.
///
/// Names, angles and groups of emitted code are constants. A generic function that is to take mechanisms at run time as well
/// reads them by the methods of the value, the numbers of coordinates from [`dims`](Self::dims) or from a column, and returns
/// errors with names of the type [`Name`](Self::Name).
///
/// There is no `dyn Mechanism`: mechanisms differ in their types and in the numbers of their coordinates. A function of any
/// mechanism is generic, `fn speed<M: Kinematic>(m: &M)`. A list of different ones holds a trait of yours that is implemented
/// for all, `impl<M: Kinematic<Scalar = f64>> Named for M`, as `Box<dyn Named>`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a mechanism",
    note = "`linkage!` implements `Mechanism` for each `mechanism`, or for each `drive` of one with several inputs; a scene has its mechanism in the field `mechanism`"
)]
pub trait Mechanism {
    /// The type of lengths and angles.
    type Scalar: Real;
    /// The type of its names: `&'static str` in emitted code; those of a mechanism at run time are borrowed.
    type Name: BorrowedName;
    /// The number of dependent coordinates.
    type U: Dim;
    /// The number of independent coordinates.
    type V: Dim;
    /// The number of groups.
    type G: Dim;
    /// The coordinates q by name.
    type Coordinates: Copy + Debug + PartialEq;
    /// Their rates q' by name.
    type Rates: Copy + Debug + PartialEq;
    /// The independent coordinates v by name, and the type of their rates and accelerations.
    type Inputs: Copy + Debug + PartialEq + Into<PerInput<Self>> + From<PerInput<Self>>;
    /// A position with all that is computed from its coordinates.
    type Pose;
    /// The assembly branch: the choice between the two solutions of each group that has two, with the number of the
    /// position of a group that has a list, and the turns of angles that count them.
    type Branch: Copy + Debug + Eq;

    /// The name of the mechanism, as in error messages.
    const NAME: &'static str; // Instead of `dyn`: a generic function, or a trait of yours for all `M: Mechanism`.
    /// The names of the dependent coordinates u, in the order of the columns of J.
    const UNKNOWNS: &'static [&'static str];
    /// The names of the independent coordinates v, in the order of the columns of A.
    const INPUTS: &'static [&'static str];
    /// True for each unknown that is an angle.
    const UNKNOWN_ANGLES: &'static [bool];
    /// True for each input that is an angle.
    const INPUT_ANGLES: &'static [bool];
    /// The groups, in the order in which they are solved.
    const GROUPS: &'static [Group<'static>];
    /// The names of the coordinates and outputs that have a range, in the order of declaration.
    const RANGES: &'static [&'static str] = &[];

    /// The name of the mechanism, as in error messages. Here and below: the names of emitted code are constants, those of a
    /// mechanism at run time are of its value.
    #[inline]
    fn name(&self) -> Self::Name {
        Self::Name::from_static(Self::NAME)
    }
    /// The name of an unknown, by its column of J; empty beyond the last.
    #[inline]
    fn unknown_name(&self, place: usize) -> Self::Name {
        Self::Name::from_static(Self::UNKNOWNS.get(place).copied().unwrap_or_default())
    }
    /// The name of an input, by its column of A; empty beyond the last.
    #[inline]
    fn input_name(&self, place: usize) -> Self::Name {
        Self::Name::from_static(Self::INPUTS.get(place).copied().unwrap_or_default())
    }
    /// True for each unknown that is an angle.
    #[inline]
    fn unknown_angles(&self) -> &[bool] {
        Self::UNKNOWN_ANGLES
    }
    /// True for each input that is an angle.
    #[inline]
    fn input_angles(&self) -> &[bool] {
        Self::INPUT_ANGLES
    }
    /// A group, in the order in which they are solved; none beyond the last.
    #[inline]
    fn group(&self, place: usize) -> Option<Group<'_, Self::Name>> {
        let Group { name, equations, unknowns } = *Self::GROUPS.get(place)?;
        Some(Group { name: Self::Name::from_static(name), equations, unknowns })
    }
    /// All groups, as a list that can be kept.
    #[inline]
    fn group_list(&self) -> <Self::Name as BorrowedName>::Groups {
        Self::Name::static_groups(Self::GROUPS)
    }
    /// The name of a coordinate or an output that has a range, in the order of declaration; none beyond the last.
    #[inline]
    fn range_name(&self, place: usize) -> Option<Self::Name> {
        Self::RANGES.get(place).copied().map(Self::Name::from_static)
    }
    /// The groups, in the order in which they are solved.
    #[inline]
    fn groups(&self) -> impl Iterator<Item = Group<'_, Self::Name>> + Clone {
        (0..self.dims().2.count()).filter_map(|place| self.group(place))
    }
    /// The names of the coordinates and outputs that have a range, in the order of declaration.
    #[inline]
    fn range_names(&self) -> impl Iterator<Item = Self::Name> + Clone {
        (0..).map_while(|place| self.range_name(place))
    }
    /// The range that is declared for an input, at no position; none without one.
    fn input_range(&self, input: usize) -> Option<Ranged<Self::Scalar>> {
        let name = self.input_name(input);
        let place = self.range_names().position(|of| of == name)?;
        let (u, v, _) = self.dims();
        self.ranged(place, &Self::coordinates(u.zeros(), v.zeros()))
    }

    /// The name of a coordinate, by its column of [J A]; empty beyond the last.
    #[inline]
    fn coordinate_name(&self, column: usize) -> Self::Name {
        match column.checked_sub(self.dims().0.count()) {
            None => self.unknown_name(column),
            Some(input) => self.input_name(input),
        }
    }

    /// The numbers of unknowns, of inputs and of groups. A mechanism needs a body of it if one is not a constant.
    #[inline]
    fn dims(&self) -> (Self::U, Self::V, Self::G) {
        (Dim::least(), Dim::least(), Dim::least())
    }
    /// Combines u and v into q.
    fn coordinates(unknowns: PerUnknown<Self>, inputs: PerInput<Self>) -> Self::Coordinates;
    /// Splits q into u and v.
    fn parts(q: &Self::Coordinates) -> (PerUnknown<Self>, PerInput<Self>);
    /// Combines u' and v' into q'.
    fn rates(unknowns: PerUnknown<Self>, inputs: PerInput<Self>) -> Self::Rates;
    /// Splits q' into u' and v'.
    fn rate_parts(rates: &Self::Rates) -> (PerUnknown<Self>, PerInput<Self>);
    /// Computes the pose at these coordinates.
    fn pose_at(&self, q: &Self::Coordinates) -> Self::Pose;
    /// True if every number of a pose is finite.
    fn is_finite(pose: &Self::Pose) -> bool;
    /// Returns the branch of a position. Where the position has a closed form, [`Assembly::assemble`] on it reproduces the
    /// position.
    fn branch_of(&self, pose: &Self::Pose) -> Self::Branch;

    // Without unknowns there are no equations: the functions from here to `solve_jacobian` then need no body.

    /// The residuals Psi of the constraints.
    #[inline]
    fn residual(&self, _: &Self::Pose) -> PerUnknown<Self> {
        const { no_unknowns::<Self>() };
        self.dims().0.zeros()
    }
    /// The sum of the magnitudes of the terms of each residual.
    #[inline]
    fn residual_scales(&self, _: &Self::Pose) -> PerUnknown<Self> {
        const { no_unknowns::<Self>() };
        self.dims().0.zeros()
    }
    /// J, the derivative of Psi by u.
    #[inline]
    fn jacobian_unknowns(&self, _: &Self::Pose) -> Matrix<Self::Scalar, Self::U, Self::U> {
        const { no_unknowns::<Self>() };
        let (u, _, _) = self.dims();
        u.zero_matrix(u)
    }
    /// A, the derivative of Psi by v.
    #[inline]
    fn jacobian_inputs(&self, _: &Self::Pose) -> Matrix<Self::Scalar, Self::U, Self::V> {
        const { no_unknowns::<Self>() };
        let (u, v, _) = self.dims();
        u.zero_matrix(v)
    }
    /// The largest magnitude that each entry of J can have at any angles, with the lengths of this pose.
    #[inline]
    fn jacobian_unknowns_scales(&self, _: &Self::Pose) -> Matrix<Self::Scalar, Self::U, Self::U> {
        const { no_unknowns::<Self>() };
        let (u, _, _) = self.dims();
        u.zero_matrix(u)
    }
    /// The largest magnitude that each entry of A can have at any angles, with the lengths of this pose.
    #[inline]
    fn jacobian_inputs_scales(&self, _: &Self::Pose) -> Matrix<Self::Scalar, Self::U, Self::V> {
        const { no_unknowns::<Self>() };
        let (u, v, _) = self.dims();
        u.zero_matrix(v)
    }
    /// det J, 1 without unknowns.
    #[inline]
    fn determinant(&self, _: &Self::Pose) -> Self::Scalar {
        const { no_unknowns::<Self>() };
        Self::Scalar::one()
    }
    /// The determinant of the block of J of each group.
    #[inline]
    fn block_determinants(&self, _: &Self::Pose) -> Column<Self::Scalar, Self::G> {
        const { no_unknowns::<Self>() };
        self.dims().2.zeros()
    }
    /// The quadratic velocity term (Psi_q q')_q q'.
    #[inline]
    fn gamma(&self, _: &Self::Pose, _: &Self::Rates) -> PerUnknown<Self> {
        const { no_unknowns::<Self>() };
        self.dims().0.zeros()
    }
    /// Solves J x = `right`.
    ///
    /// # Errors
    /// [`PositionError::Singular`] if J is singular, [`PositionError::NotFinite`] if the solution is not finite.
    #[inline]
    fn solve_jacobian(
        &self,
        _: &Self::Pose,
        right: &PerUnknown<Self>,
    ) -> Result<PerUnknown<Self>, PositionErrorOf<Self>> {
        const { no_unknowns::<Self>() };
        Ok(*right)
    }

    /// The scale of lengths that are inputs and occur in no constraint, as in an open chain: about the longest arm, or 1
    /// if there is none.
    #[inline]
    fn length_scale(&self, _: &Self::Pose) -> Self::Scalar {
        Self::Scalar::one()
    }
    /// Checks that the loops and equations that are declared as implied close at a position.
    ///
    /// # Errors
    /// [`PositionError::NotImplied`] if one does not.
    #[inline]
    fn check_implied(&self, _: &Self::Coordinates) -> Result<(), PositionErrorOf<Self>> {
        Ok(())
    }

    /// The value with a range at this place of [`RANGES`](Self::RANGES); none beyond the last.
    #[inline]
    fn ranged(&self, _: usize, _: &Self::Coordinates) -> Option<Ranged<Self::Scalar>> {
        None
    }
    /// True if each coordinate and output that has a range is in it, up to a few ulps.
    ///
    /// # Errors
    /// [`InputError::EmptyJointRange`] for a range whose ends are not numbers or not in order.
    fn is_within_ranges(&self, q: &Self::Coordinates) -> Result<bool, InputError<Self::Name>> {
        let mut all = (0..).zip(self.range_names()).filter_map(|(place, name)| Some((self.ranged(place, q)?, name)));
        all.try_fold(true, |are_within, (ranged, name)| {
            ranged.check_ends(self.name(), name)?;
            Ok(are_within && ranged.is_within())
        })
    }

    /// The unknowns u of q.
    #[inline]
    fn unknowns(q: &Self::Coordinates) -> PerUnknown<Self> {
        Self::parts(q).0
    }
    /// The inputs v of q.
    #[inline]
    fn inputs(q: &Self::Coordinates) -> PerInput<Self> {
        Self::parts(q).1
    }
    /// q with other values of u.
    #[inline]
    fn with_unknowns(q: &Self::Coordinates, unknowns: PerUnknown<Self>) -> Self::Coordinates {
        Self::coordinates(unknowns, Self::inputs(q))
    }
    /// q with other values of v.
    #[inline]
    fn with_inputs(q: &Self::Coordinates, inputs: PerInput<Self>) -> Self::Coordinates {
        Self::coordinates(Self::unknowns(q), inputs)
    }
    /// The coordinates q as one line for readers, the inputs first, with angles in degrees: `theta = 60°, s = 0.25`. A precision,
    /// as in `{:.2}`, is the number of decimals; without one there are seven digits.
    #[inline]
    fn named(&self, q: &Self::Coordinates) -> Named<'_, Self> {
        Named { mechanism: self, q: *q }
    }
    /// True if the determinant of each block of J has the same sign at both positions: if not, they belong to different
    /// assembly branches. NaN counts as negative.
    #[inline]
    fn same_branch(&self, pose: &Self::Pose, other: &Self::Pose) -> bool {
        same_signs(self.block_determinants(pose).as_slice(), self.block_determinants(other).as_slice())
    }
}

/// The coordinates of a position by name, in one line. Made by [`Mechanism::named`].
pub struct Named<'m, M: Mechanism + ?Sized> {
    mechanism: &'m M,
    q: M::Coordinates,
}

impl<M: Mechanism + ?Sized> Debug for Named<'_, M> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Named").field(&self.q).finish()
    }
}

impl<M: Mechanism + ?Sized> Display for Named<'_, M> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (m, (unknowns, inputs)) = (self.mechanism, M::parts(&self.q));
        let inputs = inputs.into_iter().zip((0..).map(|place| m.input_name(place))).zip(m.input_angles());
        let unknowns = unknowns.into_iter().zip((0..).map(|place| m.unknown_name(place))).zip(m.unknown_angles());
        for (place, ((value, name), &is_angle)) in inputs.chain(unknowns).enumerate() {
            f.write_str(if place == 0 { "" } else { ", " })?;
            write!(f, "{name} = ")?;
            Display::fmt(&Shown { value: to_f64(value), is_angle }, f)?;
        }
        Ok(())
    }
}

/// Does not compile for a mechanism with unknowns, which has equations of its own.
pub(crate) const fn no_unknowns<M: Mechanism + ?Sized>() {
    assert!(M::U::CAPACITY == 0, "a mechanism with unknowns has functions that compute its equations");
}

/// A mechanism whose position has a closed form.
///
/// `linkage!` implements it if all groups have one. In other mechanisms the groups without a closed form are solved by
/// Newton's method.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no position in closed form",
    note = "`linkage!` implements `Assembly` if every group has a closed form; use `solve` or `assemble_near` with a guess"
)]
pub trait Assembly: Mechanism {
    /// Computes the position at these inputs on this branch. At a change point a branch may jump to another motion; a
    /// `RangeOfMotion` stays on one.
    ///
    /// # Errors
    /// [`PositionError::Unbuildable`] if a group cannot be assembled, [`PositionError::Undetermined`] if it has
    /// infinitely many positions, [`PositionError::NotFinite`] if a number is not finite.
    fn assemble(&self, inputs: Self::Inputs, branch: Self::Branch) -> Result<Self::Pose, PositionErrorOf<Self>>;
    /// Computes the position at the inputs of a guess on this branch. If the full turns of an angle matter, as with
    /// gears, those nearest to the guess are used instead of those of the branch.
    ///
    /// # Errors
    /// Those of [`assemble`](Self::assemble), and [`InputError::OutOfRange`](crate::InputError::OutOfRange) if a guess
    /// is more turns away than a branch can count.
    fn assemble_near(
        &self,
        guess: &Self::Coordinates,
        branch: Self::Branch,
    ) -> Result<Self::Pose, PositionErrorOf<Self>> {
        self.assemble(Self::inputs(guess).into(), branch)
    }
}

/// A mechanism whose positions at given inputs can be listed.
///
/// `linkage!` implements it for every mechanism that has the function `branches`.
#[diagnostic::on_unimplemented(
    message = "the positions of `{Self}` cannot be listed",
    note = "`linkage!` implements `Branches` for each mechanism whose function `branches` lists positions: a call of it says \
            why it does not"
)]
pub trait Branches: Mechanism {
    /// All positions at these inputs, each with its branch, in the order of the branches.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`] if a number is not finite, and other errors of the function `branches` of the mechanism.
    fn all_positions(
        &self,
        inputs: Self::Inputs,
    ) -> Result<impl Iterator<Item = (Self::Branch, Self::Coordinates)>, PositionErrorOf<Self>>;
}

/// Returns an error if a number of the coordinates or of their pose is infinite or NaN.
///
/// # Errors
/// [`PositionError::NotFinite`].
#[inline]
pub(crate) fn finite_position<M: Mechanism>(
    mechanism: &M,
    q: &M::Coordinates,
    pose: &M::Pose,
) -> Result<(), PositionErrorOf<M>> {
    finite_coordinates(mechanism, q)?;
    if M::is_finite(pose) {
        Ok(())
    } else {
        Err(PositionError::NotFinite { mechanism: mechanism.name(), quantity: Name::from_static("the position") })
    }
}

/// Returns an error if a coordinate is infinite or NaN.
///
/// # Errors
/// [`PositionError::NotFinite`].
#[inline]
pub(crate) fn finite_coordinates<M: Mechanism>(mechanism: &M, q: &M::Coordinates) -> Result<(), PositionErrorOf<M>> {
    let (unknowns, inputs) = M::parts(q);
    all_finite(mechanism.name(), Name::from_static("the position"), unknowns.iter().chain(inputs.iter()))
}

/// Returns the error of the first value that is not in its range.
///
/// # Errors
/// [`InputError::EmptyJointRange`], [`InputError::OutOfRange`].
pub(crate) fn check_ranges<M: Mechanism>(mechanism: &M, q: &M::Coordinates) -> Result<(), InputError<M::Name>> {
    let mut all =
        (0..).zip(mechanism.range_names()).filter_map(|(place, name)| Some((mechanism.ranged(place, q)?, name)));
    all.try_for_each(|(ranged, name)| ranged.check(mechanism.name(), name))
}

/// Returns the name of the first group whose determinant changes its sign from one position to another.
pub(crate) fn other_group<M: Mechanism>(mechanism: &M, pose: &M::Pose, other: &M::Pose) -> M::Name {
    let [these, those] = [pose, other].map(|pose| mechanism.block_determinants(pose));
    let mut pairs = these.iter().zip(&those).zip(mechanism.groups());
    let group = pairs.find(|((this, that), _)| !same_signs(&[**this], &[**that]));
    group.map_or_else(|| Name::from_static(""), |(_, group)| group.name)
}
