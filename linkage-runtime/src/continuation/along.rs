//! A mechanism with several inputs along a path of them.

use nalgebra::{SMatrix, SVector};

use crate::{Error, Group, Mechanism, Real};

/// A mechanism whose inputs v(s) are functions of one parameter, which is then its only input.
///
/// The function gives v, dv/ds and d2v/ds2, each as a vector of the inputs in their order. The parameter counts as an
/// angle does: one that changes by 1/4 is a step.
#[derive(Debug, Clone, Copy)]
pub struct Along<M, F> {
    /// The mechanism.
    pub mechanism: M,
    /// v, dv/ds and d2v/ds2 at s.
    pub inputs: F,
}

/// Coordinates of a mechanism and the parameter of its inputs; their rates as well.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AlongCoordinates<Q, T = f64> {
    /// The coordinates of the mechanism. Their inputs mean nothing: [`Along::position`] has those of the parameter.
    pub q: Q,
    /// The parameter s.
    pub parameter: T,
}

/// A pose of the mechanism, and dv/ds and d2v/ds2 there.
#[derive(Debug, Clone, Copy)]
pub struct AlongPose<P, T, const V: usize> {
    pose: P,
    slope: SVector<T, V>,
    bend: SVector<T, V>,
}

impl<M, F> Along<M, F> {
    /// The coordinates of the mechanism with the inputs of the parameter.
    pub fn position<T, const U: usize, const V: usize>(
        &self,
        at: &AlongCoordinates<M::Coordinates, T>,
    ) -> M::Coordinates
    where
        T: Real,
        M: Mechanism<T, U, V>,
        F: Fn(T) -> [SVector<T, V>; 3],
    {
        let [inputs, ..] = (self.inputs)(at.parameter);
        M::with_inputs(&at.q, inputs)
    }
}

impl<T, M, F, const U: usize, const V: usize> Mechanism<T, U, 1> for Along<M, F>
where
    T: Real,
    M: Mechanism<T, U, V>,
    F: Fn(T) -> [SVector<T, V>; 3],
{
    const NAME: &'static str = M::NAME;
    const UNKNOWNS: [&'static str; U] = M::UNKNOWNS;
    const INPUTS: [&'static str; 1] = ["the parameter"];
    const GROUPS: &'static [Group] = M::GROUPS;
    const UNKNOWN_ANGLES: [bool; U] = M::UNKNOWN_ANGLES;
    const INPUT_ANGLES: [bool; 1] = [true];
    type Coordinates = AlongCoordinates<M::Coordinates, T>;
    type Inputs = SVector<T, 1>;
    type Unknowns = M::Unknowns;
    type Pose = AlongPose<M::Pose, T, V>;
    type BlockDeterminants = M::BlockDeterminants;

    fn inputs(at: &Self::Coordinates) -> SVector<T, 1> {
        SVector::from([[at.parameter]])
    }

    fn with_inputs(at: &Self::Coordinates, inputs: SVector<T, 1>) -> Self::Coordinates {
        AlongCoordinates { parameter: inputs[0], ..*at }
    }

    fn unknowns(at: &Self::Coordinates) -> SVector<T, U> {
        M::unknowns(&at.q)
    }

    fn with_unknowns(at: &Self::Coordinates, unknowns: SVector<T, U>) -> Self::Coordinates {
        AlongCoordinates { q: M::with_unknowns(&at.q, unknowns), ..*at }
    }

    fn pose_at(&self, at: &Self::Coordinates) -> Self::Pose {
        let [inputs, slope, bend] = (self.inputs)(at.parameter);
        AlongPose { pose: self.mechanism.pose_at(&M::with_inputs(&at.q, inputs)), slope, bend }
    }

    fn is_finite(at: &Self::Pose) -> bool {
        M::is_finite(&at.pose) && at.slope.iter().chain(at.bend.iter()).all(T::is_finite)
    }

    fn residual(&self, at: &Self::Pose) -> SVector<T, U> {
        self.mechanism.residual(&at.pose)
    }

    fn closure_sizes(&self, at: &Self::Pose) -> SVector<T, U> {
        self.mechanism.closure_sizes(&at.pose)
    }

    fn jacobian_unknowns(&self, at: &Self::Pose) -> SMatrix<T, U, U> {
        self.mechanism.jacobian_unknowns(&at.pose)
    }

    fn jacobian_inputs(&self, at: &Self::Pose) -> SMatrix<T, U, 1> {
        self.mechanism.jacobian_inputs(&at.pose) * at.slope
    }

    fn jacobian_sizes(&self, at: &Self::Pose) -> (SMatrix<T, U, U>, SMatrix<T, U, 1>) {
        let (unknowns, inputs) = self.mechanism.jacobian_sizes(&at.pose);
        (unknowns, inputs * at.slope.abs())
    }

    fn determinant(&self, at: &Self::Pose) -> T {
        self.mechanism.determinant(&at.pose)
    }

    fn block_determinants(&self, at: &Self::Pose) -> Self::BlockDeterminants {
        self.mechanism.block_determinants(&at.pose)
    }

    // v' = dv/ds s', and dv/ds turns by d2v/ds2 s'.
    fn gamma(&self, at: &Self::Pose, rate: &Self::Coordinates) -> SVector<T, U> {
        let rates = M::with_inputs(&rate.q, at.slope * rate.parameter);
        let bend = at.bend * (rate.parameter * rate.parameter);
        self.mechanism.gamma(&at.pose, &rates) + self.mechanism.jacobian_inputs(&at.pose) * bend
    }

    fn solve_jacobian(&self, at: &Self::Pose, right: &SVector<T, U>) -> Result<SVector<T, U>, Error> {
        self.mechanism.solve_jacobian(&at.pose, right)
    }
}
