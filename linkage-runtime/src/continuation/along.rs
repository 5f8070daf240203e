//! A mechanism with several inputs, driven along a path of its inputs.

use super::input_path::InputPath;
use crate::skeleton::{NoDrawing, Part, Skeleton};
use crate::{
    BorrowedName, Branches, Build, Column, D, Dim, Group, Matrix, Mechanism, PerInput, PerUnknown, PositionErrorOf,
    Ranged, Real,
};

/// A mechanism whose inputs are functions v(s) of one parameter, its only input.
///
/// The path is a function that returns v, dv/ds and d2v/ds2, each as inputs by name, or as a vector or array in the order
/// of the inputs, or one of [`OneInput`](super::OneInput) and [`Line`](super::Line). The parameter of a function is treated
/// as an angle: by default a step changes it by at most 1/4.
#[derive(Debug, Clone, Copy)]
pub struct Along<M, F> {
    /// The mechanism.
    pub mechanism: M,
    /// v, dv/ds and d2v/ds2 at s.
    pub inputs: F,
}

/// Coordinates of a mechanism and the parameter of its inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AlongCoordinates<Q, T = f64> {
    /// The coordinates of the mechanism. Their inputs are unused: [`Along::position`] returns those at the parameter.
    pub q: Q,
    /// The parameter s.
    pub parameter: T,
}

/// Rates of the coordinates of a mechanism and of the parameter of its inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AlongRates<R, T = f64> {
    /// The rates of the coordinates. Those of the inputs are unused: they are dv/ds s'.
    pub rates: R,
    /// s'.
    pub parameter: T,
}

/// A pose of the mechanism, with dv/ds and d2v/ds2 there.
#[derive(Debug, Clone, Copy)]
pub struct AlongPose<P, T: Real, V: Dim> {
    pose: P,
    slope: Column<T, V>,
    bend: Column<T, V>,
}

impl<M, F> Along<M, F> {
    /// Returns the coordinates of the mechanism, with the inputs at the parameter.
    pub fn position(&self, at: &AlongCoordinates<M::Coordinates, M::Scalar>) -> M::Coordinates
    where
        M: Mechanism,
        F: InputPath<M>,
    {
        let [inputs, ..] = self.inputs.at(at.parameter);
        M::with_inputs(&at.q, inputs)
    }
}

impl<M, F> Mechanism for Along<M, F>
where
    M: Mechanism,
    F: InputPath<M>,
{
    type Scalar = M::Scalar;
    type Name = M::Name;
    type U = M::U;
    type V = D<1>;
    type G = M::G;
    type Coordinates = AlongCoordinates<M::Coordinates, M::Scalar>;
    type Rates = AlongRates<M::Rates, M::Scalar>;
    type Inputs = Column<M::Scalar, D<1>>;
    type Pose = AlongPose<M::Pose, M::Scalar, M::V>;
    type Branch = M::Branch;

    const NAME: &'static str = M::NAME;
    const UNKNOWNS: &'static [&'static str] = M::UNKNOWNS;
    // The path of the inputs is a value.
    const INPUTS: &'static [&'static str] = panic!("the name of the parameter is `input_name` of the value");
    const UNKNOWN_ANGLES: &'static [bool] = M::UNKNOWN_ANGLES;
    const INPUT_ANGLES: &'static [bool] = panic!("the angles of the parameter are `input_angles` of the value");
    const GROUPS: &'static [Group<'static>] = M::GROUPS;
    const RANGES: &'static [&'static str] = M::RANGES;

    fn name(&self) -> M::Name {
        self.mechanism.name()
    }

    fn unknown_name(&self, place: usize) -> M::Name {
        self.mechanism.unknown_name(place)
    }

    fn input_name(&self, _: usize) -> M::Name {
        self.inputs.parameter(&self.mechanism)
    }

    fn unknown_angles(&self) -> &[bool] {
        self.mechanism.unknown_angles()
    }

    fn input_angles(&self) -> &[bool] {
        if self.inputs.is_angle(&self.mechanism) { &[true] } else { &[false] }
    }

    fn group(&self, place: usize) -> Option<Group<'_, M::Name>> {
        self.mechanism.group(place)
    }

    fn group_list(&self) -> <M::Name as BorrowedName>::Groups {
        self.mechanism.group_list()
    }

    fn range_name(&self, place: usize) -> Option<M::Name> {
        self.mechanism.range_name(place)
    }

    fn dims(&self) -> (M::U, D<1>, M::G) {
        let (u, _, g) = self.mechanism.dims();
        (u, D, g)
    }

    fn coordinates(unknowns: PerUnknown<M>, inputs: PerInput<Self>) -> Self::Coordinates {
        AlongCoordinates { q: M::coordinates(unknowns, M::V::least().zeros()), parameter: inputs[0] }
    }

    fn parts(at: &Self::Coordinates) -> (PerUnknown<M>, PerInput<Self>) {
        (M::unknowns(&at.q), Column::from([at.parameter]))
    }

    fn rates(unknowns: PerUnknown<M>, inputs: PerInput<Self>) -> Self::Rates {
        AlongRates { rates: M::rates(unknowns, M::V::least().zeros()), parameter: inputs[0] }
    }

    fn rate_parts(along: &Self::Rates) -> (PerUnknown<M>, PerInput<Self>) {
        (M::rate_parts(&along.rates).0, Column::from([along.parameter]))
    }

    fn pose_at(&self, at: &Self::Coordinates) -> Self::Pose {
        let [inputs, slope, bend] = self.inputs.at(at.parameter);
        AlongPose { pose: self.mechanism.pose_at(&M::with_inputs(&at.q, inputs)), slope, bend }
    }

    fn is_finite(at: &Self::Pose) -> bool {
        M::is_finite(&at.pose) && at.slope.is_finite() && at.bend.is_finite()
    }

    fn branch_of(&self, at: &Self::Pose) -> M::Branch {
        self.mechanism.branch_of(&at.pose)
    }

    fn ranged(&self, place: usize, at: &Self::Coordinates) -> Option<Ranged<M::Scalar>> {
        self.mechanism.ranged(place, &self.position(at))
    }

    fn residual(&self, at: &Self::Pose) -> PerUnknown<M> {
        self.mechanism.residual(&at.pose)
    }

    fn residual_scales(&self, at: &Self::Pose) -> PerUnknown<M> {
        self.mechanism.residual_scales(&at.pose)
    }

    fn jacobian_unknowns(&self, at: &Self::Pose) -> Matrix<M::Scalar, M::U, M::U> {
        self.mechanism.jacobian_unknowns(&at.pose)
    }

    fn jacobian_inputs(&self, at: &Self::Pose) -> Matrix<M::Scalar, M::U, D<1>> {
        self.dims().0.columns([self.mechanism.jacobian_inputs(&at.pose) * at.slope].into())
    }

    fn jacobian_unknowns_scales(&self, at: &Self::Pose) -> Matrix<M::Scalar, M::U, M::U> {
        self.mechanism.jacobian_unknowns_scales(&at.pose)
    }

    fn jacobian_inputs_scales(&self, at: &Self::Pose) -> Matrix<M::Scalar, M::U, D<1>> {
        self.dims().0.columns([self.mechanism.jacobian_inputs_scales(&at.pose) * at.slope.abs()].into())
    }

    fn determinant(&self, at: &Self::Pose) -> M::Scalar {
        self.mechanism.determinant(&at.pose)
    }

    fn block_determinants(&self, at: &Self::Pose) -> Column<M::Scalar, M::G> {
        self.mechanism.block_determinants(&at.pose)
    }

    // v' = dv/ds s'; v'' = d2v/ds2 s'^2 if s'' = 0.
    fn gamma(&self, at: &Self::Pose, along: &Self::Rates) -> PerUnknown<M> {
        let rates = M::rates(M::rate_parts(&along.rates).0, at.slope * along.parameter);
        let bend = at.bend * (along.parameter * along.parameter);
        self.mechanism.gamma(&at.pose, &rates) + self.mechanism.jacobian_inputs(&at.pose) * bend
    }

    fn solve_jacobian(&self, at: &Self::Pose, right: &PerUnknown<M>) -> Result<PerUnknown<M>, PositionErrorOf<M>> {
        self.mechanism.solve_jacobian(&at.pose, right)
    }

    fn length_scale(&self, at: &Self::Pose) -> M::Scalar {
        F::length_scale(&self.mechanism, &at.pose)
    }

    fn check_implied(&self, at: &Self::Coordinates) -> Result<(), PositionErrorOf<M>> {
        self.mechanism.check_implied(&self.position(at))
    }
}

/// All positions at a parameter.
impl<M, F> Branches for Along<M, F>
where
    M: Branches,
    F: InputPath<M>,
{
    fn all_positions(
        &self,
        parameter: Self::Inputs,
    ) -> Result<impl Iterator<Item = (M::Branch, Self::Coordinates)>, PositionErrorOf<M>> {
        let [inputs, ..] = self.inputs.at(parameter[0]);
        let at = move |(branch, q)| (branch, AlongCoordinates { q, parameter: parameter[0] });
        Ok(self.mechanism.all_positions(inputs.into())?.map(at))
    }
}

/// The drawing of the mechanism.
impl<M, F> Skeleton for Along<M, F>
where
    M: Skeleton,
    F: InputPath<M>,
{
    type Parts = M::Parts;

    const JOINTS: &'static [&'static str] = M::JOINTS;
    const PARTS: &'static [Part<'static>] = M::PARTS;

    fn check_drawing(&self) -> Result<(), NoDrawing> {
        self.mechanism.check_drawing()
    }

    fn joint_name(&self, place: usize) -> Option<M::Name> {
        self.mechanism.joint_name(place)
    }

    fn drawn_parts(&self) -> &[Part<'_>] {
        self.mechanism.drawn_parts()
    }

    fn joints(&self, at: &Self::Pose) -> Column<M::Scalar, M::Parts> {
        self.mechanism.joints(&at.pose)
    }

    fn guide(&self, at: &Self::Pose, place: usize) -> Option<[M::Scalar; 2]> {
        self.mechanism.guide(&at.pose, place)
    }

    fn force_place(&self, at: &Self::Pose, place: usize) -> Option<[M::Scalar; 4]> {
        self.mechanism.force_place(&at.pose, place)
    }
}
