//! The functions of every mechanism as traits, so that a test of all mechanisms is one generic function.

use linkage::{Assembly, Mechanism, PerInput, PositionError, Real};
use nalgebra::{DMatrix, SMatrix, SVector};

/// The kinematics that `linkage!` emits for a mechanism.
///
/// Lists of coordinates, rates and accelerations are in the order of their fields; points are listed as x, y, x, y, ..
pub trait Kinematics<T: Real>: Mechanism<Scalar = T> + Sized {
    /// The mechanism with these parameters, in the order of declaration.
    fn with_parameters(parameters: &[T]) -> Self;
    /// The parameters in the order of declaration.
    fn parameters(&self) -> Vec<T>;
    /// The coordinates by name.
    fn named(q: &[T]) -> Self::Coordinates;
    /// The position at coordinates.
    fn pose(&self, q: &[T]) -> Self::Pose;
    /// The coordinates of a position.
    fn listed(pose: &Self::Pose) -> Vec<T>;
    /// The inputs among the coordinates, or their derivatives.
    fn inputs_of(q: &[T]) -> Vec<T>;
    /// Psi_q, by rows of constraints and columns of coordinates.
    fn jacobian(&self, pose: &Self::Pose) -> DMatrix<T>;
    /// W.
    fn velocity_ratios(&self, pose: &Self::Pose) -> Result<DMatrix<T>, PositionError>;
    /// (Psi_q q')_q q'.
    fn gamma_of(&self, pose: &Self::Pose, rates: &[T]) -> Vec<T>;
    /// q' for the inputs' v'.
    fn velocity(&self, pose: &Self::Pose, input_rates: &[T]) -> Result<Vec<T>, PositionError>;
    /// q'' for q' and the inputs' v''.
    fn acceleration(&self, pose: &Self::Pose, rates: &[T], inputs: &[T]) -> Result<Vec<T>, PositionError>;
    fn points(&self, pose: &Self::Pose) -> Result<Vec<T>, PositionError>;
    fn point_velocities(&self, pose: &Self::Pose, rates: &[T]) -> Result<Vec<T>, PositionError>;
    fn point_accelerations(&self, pose: &Self::Pose, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError>;
    /// For each point the matrix of its velocity by the inputs' rates.
    fn point_ratios(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn outputs(&self, pose: &Self::Pose) -> Result<Vec<T>, PositionError>;
    fn output_velocities(&self, pose: &Self::Pose, rates: &[T]) -> Result<Vec<T>, PositionError>;
    fn output_accelerations(&self, pose: &Self::Pose, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError>;
    /// For each output the row of its rate by the inputs' rates.
    fn output_ratios(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError>;
    /// All of it in one call.
    fn motion(&self, q: &[T], input_rates: &[T], inputs: &[T]) -> Result<Motion<T>, PositionError>;

    /// The number of branches; 1 if the position is found by Newton's method.
    fn branch_count() -> usize;
    /// The coordinates that Newton's method finds from a guess.
    fn solved(&self, guess: &[T]) -> Result<Vec<T>, PositionError>;
    /// The position at the inputs of q, on a branch or by Newton's method from q.
    fn position(&self, q: &[T], branch: usize) -> Result<Self::Pose, PositionError>;
    /// Position, velocity and acceleration in one computation, from q as in `position`, or from q on its branch by
    /// Newton's method; with points and outputs if `full`.
    fn moving(
        &self,
        q: &[T],
        branch: usize,
        input_rates: &[T],
        given: &[T],
        full: bool,
    ) -> Result<Moving<Self::Pose, T>, PositionError>;
    /// Position, velocity and acceleration by separate calls.
    fn moving_by_parts(
        &self,
        q: &[T],
        branch: usize,
        input_rates: &[T],
        given: &[T],
    ) -> Result<Moving<Self::Pose, T>, PositionError> {
        let pose = self.assembled(q, branch)?;
        let rates = self.velocity(&pose, input_rates)?;
        let accelerations = self.acceleration(&pose, &rates, given)?;
        Ok(Moving { pose, rates, accelerations, points: None, outputs: None })
    }
    /// The position that `moving` starts from.
    fn assembled(&self, q: &[T], branch: usize) -> Result<Self::Pose, PositionError>;
}

/// A motion in lists: each with its first and second derivative.
pub struct Motion<T> {
    pub coordinates: [Vec<T>; 3],
    pub points: [Vec<T>; 3],
    pub outputs: [Vec<T>; 3],
}

/// A position with its rates and accelerations, and the motion of points and outputs if it is computed.
pub struct Moving<P, T> {
    pub pose: P,
    pub rates: Vec<T>,
    pub accelerations: Vec<T>,
    pub points: Option<[Vec<T>; 3]>,
    pub outputs: Option<[Vec<T>; 3]>,
}

/// The functions of a mechanism with `derive jerk, velocity_ratio_derivatives, sensitivity`.
pub trait HigherOrders<T: Real>: Kinematics<T> {
    /// q''' for q', q'' and the inputs' v'''.
    fn jerk(&self, pose: &Self::Pose, rates: &[T], bent: &[T], inputs: &[T]) -> Result<Vec<T>, PositionError>;
    fn point_jerks(&self, pose: &Self::Pose, q: [&[T]; 3]) -> Result<Vec<T>, PositionError>;
    fn output_jerks(&self, pose: &Self::Pose, q: [&[T]; 3]) -> Result<Vec<T>, PositionError>;
    /// For each unknown its second derivatives by the inputs.
    fn velocity_ratio_derivatives(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError>;
    /// For each x and y of each point its second derivatives by the inputs.
    fn point_ratio_derivatives(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn output_ratio_derivatives(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError>;
    /// du/dp, a column for each parameter.
    fn sensitivity(&self, pose: &Self::Pose) -> Result<DMatrix<T>, PositionError>;
    /// For each point two rows.
    fn point_sensitivities(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn output_sensitivities(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError>;
}

/// A mechanism of the gallery, in doubles and in any other scalar.
pub trait Fixture: Kinematics<f64> + Default {
    /// The file of `src/mechanisms` without its ending.
    const FILE: &'static str;
    /// The mechanism in another scalar.
    type Of<T: Real>: Kinematics<T>;
}

/// A fixture with higher orders.
pub trait WithHigherOrders: Fixture + HigherOrders<f64> {
    /// The mechanism in another scalar, with higher orders.
    type OfOrders<T: Real>: HigherOrders<T>;
}

/// A mechanism whose positions have a closed form.
pub trait ClosedForm: Assembly {
    /// All branches.
    fn all_branches() -> Vec<Self::Branch>;
    /// The coordinates of a position by name.
    fn coordinates_of(pose: &Self::Pose) -> Self::Coordinates;
}

/// Implements the traits for all mechanisms of a list.
macro_rules! fixtures {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {$(
        $(
            $crate::fixture::kinematics!($file $Mechanism $method);
            $crate::fixture::closed_form!($file $Mechanism $method);
            impl Fixture for $file::$Mechanism {
                const FILE: &'static str = stringify!($file);
                type Of<T: Real> = $file::$Mechanism<T>;
            }
        )+
        $crate::fixture::higher_orders!($file [$($Mechanism $method)+] $($orders)?);
    )*};
}

macro_rules! kinematics {
    ($file:ident $Mechanism:ident $method:ident) => {
        impl<T: Real> Kinematics<T> for $file::$Mechanism<T> {
            fn with_parameters(parameters: &[T]) -> Self {
                array(parameters).into()
            }
            fn parameters(&self) -> Vec<T> {
                let parameters: [T; _] = self.clone().into();
                parameters.to_vec()
            }
            fn named(q: &[T]) -> Self::Coordinates {
                named(q)
            }
            fn pose(&self, q: &[T]) -> Self::Pose {
                self.pose_at(&named(q))
            }
            fn listed(pose: &Self::Pose) -> Vec<T> {
                column(pose.coordinates())
            }
            fn inputs_of(q: &[T]) -> Vec<T> {
                <Self as Mechanism>::inputs(&Self::named(q)).iter().copied().collect()
            }
            fn solved(&self, guess: &[T]) -> Result<Vec<T>, PositionError> {
                newton(self, &Self::named(guess)).map(|solution| column(solution.coordinates))
            }
            $crate::fixture::position!($method);
            $crate::fixture::equations!($method);
            fn velocity(&self, pose: &Self::Pose, input_rates: &[T]) -> Result<Vec<T>, PositionError> {
                self.velocity(pose, inputs::<Self>(input_rates)).map(column)
            }
            fn acceleration(&self, pose: &Self::Pose, rates: &[T], given: &[T]) -> Result<Vec<T>, PositionError> {
                self.acceleration(pose, &named(rates), inputs::<Self>(given)).map(column)
            }
            fn points(&self, pose: &Self::Pose) -> Result<Vec<T>, PositionError> {
                self.points(pose).map(|points| pairs(points.into()))
            }
            fn point_velocities(&self, pose: &Self::Pose, rates: &[T]) -> Result<Vec<T>, PositionError> {
                self.point_velocities(pose, &named(rates)).map(|points| pairs(points.into()))
            }
            fn point_accelerations(&self, pose: &Self::Pose, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError> {
                let points = self.point_accelerations(pose, &named(rates), &named(bent));
                points.map(|points| pairs(points.into()))
            }
            fn point_ratios(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError> {
                self.point_ratios(pose).map(|ratios| matrices(ratios.into()))
            }
            fn outputs(&self, pose: &Self::Pose) -> Result<Vec<T>, PositionError> {
                self.outputs(pose).map(list)
            }
            fn output_velocities(&self, pose: &Self::Pose, rates: &[T]) -> Result<Vec<T>, PositionError> {
                self.output_velocities(pose, &named(rates)).map(list)
            }
            fn output_accelerations(
                &self,
                pose: &Self::Pose,
                rates: &[T],
                bent: &[T],
            ) -> Result<Vec<T>, PositionError> {
                self.output_accelerations(pose, &named(rates), &named(bent)).map(list)
            }
            fn output_ratios(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError> {
                self.output_ratios(pose).map(|ratios| matrices(ratios.into()))
            }
            fn motion(&self, q: &[T], input_rates: &[T], given: &[T]) -> Result<Motion<T>, PositionError> {
                let motion = self.motion(&named(q), inputs::<Self>(input_rates), inputs::<Self>(given))?;
                let (points, outputs): ([_; _], [_; _]) = (motion.points.into(), motion.outputs.into());
                Ok(Motion {
                    coordinates: [column(motion.position), column(motion.rates), column(motion.accelerations)],
                    points: [
                        pairs(points.map(|point| point.position)),
                        pairs(points.map(|point| point.velocity)),
                        pairs(points.map(|point| point.acceleration)),
                    ],
                    outputs: [
                        outputs.map(|output| output.value).to_vec(),
                        outputs.map(|output| output.velocity).to_vec(),
                        outputs.map(|output| output.acceleration).to_vec(),
                    ],
                })
            }
        }
    };
}

macro_rules! equations {
    // An open chain has no constraints and no unknowns.
    (open) => {
        fn jacobian(&self, _: &Self::Pose) -> DMatrix<T> {
            DMatrix::zeros(0, Self::INPUTS.len())
        }
        fn velocity_ratios(&self, _: &Self::Pose) -> Result<DMatrix<T>, PositionError> {
            Ok(DMatrix::zeros(0, Self::INPUTS.len()))
        }
        fn gamma_of(&self, _: &Self::Pose, _: &[T]) -> Vec<T> {
            Vec::new()
        }
    };
    ($method:ident) => {
        fn jacobian(&self, pose: &Self::Pose) -> DMatrix<T> {
            matrix(self.jacobian(pose))
        }
        fn velocity_ratios(&self, pose: &Self::Pose) -> Result<DMatrix<T>, PositionError> {
            self.velocity_ratios(pose).map(matrix)
        }
        fn gamma_of(&self, pose: &Self::Pose, rates: &[T]) -> Vec<T> {
            self.gamma(pose, &named(rates)).as_slice().to_vec()
        }
    };
}

macro_rules! position {
    (@ moving $kinematics:ident $full_kinematics:ident $assemble:ident, |$m:ident, $q:ident, $branch:ident| $from:expr, $on:expr) => {
        fn moving(
            &self,
            q: &[T],
            branch: usize,
            input_rates: &[T],
            given: &[T],
            full: bool,
        ) -> Result<Moving<Self::Pose, T>, PositionError> {
            let ($m, $q, $branch) = (self, q, branch);
            let (rates, bent) = (inputs::<Self>(input_rates), inputs::<Self>(given));
            if !full {
                let moving = self.$kinematics($from, $on, rates, bent)?;
                let (rates, accelerations) = (column(moving.rates), column(moving.accelerations));
                return Ok(Moving { pose: moving.pose, rates, accelerations, points: None, outputs: None });
            }
            let moving = self.$full_kinematics($from, $on, rates, bent)?;
            let (points, outputs): ([_; _], [_; _]) = (moving.points.into(), moving.outputs.into());
            Ok(Moving {
                pose: moving.pose,
                rates: column(moving.rates),
                accelerations: column(moving.accelerations),
                points: Some([
                    pairs(points.map(|point| point.position)),
                    pairs(points.map(|point| point.velocity)),
                    pairs(points.map(|point| point.acceleration)),
                ]),
                outputs: Some([
                    outputs.map(|output| output.value).to_vec(),
                    outputs.map(|output| output.velocity).to_vec(),
                    outputs.map(|output| output.acceleration).to_vec(),
                ]),
            })
        }
        fn assembled(&self, q: &[T], branch: usize) -> Result<Self::Pose, PositionError> {
            let ($m, $q, $branch) = (self, q, branch);
            self.$assemble($from, $on)
        }
    };
    (closed) => {
        $crate::fixture::position!(@ moving kinematics full_kinematics assemble, |_m, q, branch| inputs::<Self>(&Self::inputs_of(q)), Self::all_branches()[branch]);
        fn branch_count() -> usize {
            Self::all_branches().len()
        }
        fn position(&self, q: &[T], branch: usize) -> Result<Self::Pose, PositionError> {
            self.assemble(inputs::<Self>(&Self::inputs_of(q)), Self::all_branches()[branch])
        }
    };
    (open) => {
        $crate::fixture::position!(closed);
    };
    (newton) => {
        $crate::fixture::position!(@ moving kinematics_near full_kinematics_near assemble_near, |m, q, _branch| &Self::named(q), m.branch_of(&m.pose(q)));
        fn branch_count() -> usize {
            1
        }
        fn position(&self, q: &[T], _branch: usize) -> Result<Self::Pose, PositionError> {
            Ok(self.pose(&self.solved(q)?))
        }
    };
}

macro_rules! closed_form {
    ($file:ident $Mechanism:ident newton) => {};
    ($file:ident $Mechanism:ident $method:ident) => {
        impl<T: Real> ClosedForm for $file::$Mechanism<T> {
            fn all_branches() -> Vec<Self::Branch> {
                <Self as Assembly>::Branch::all().collect()
            }
            fn coordinates_of(pose: &Self::Pose) -> Self::Coordinates {
                pose.coordinates()
            }
        }
    };
}

macro_rules! higher_orders {
    ($file:ident [$($Mechanism:ident $method:ident)+]) => {};
    ($file:ident [$($Mechanism:ident $method:ident)+] orders) => {$(
        impl WithHigherOrders for $file::$Mechanism {
            type OfOrders<T: Real> = $file::$Mechanism<T>;
        }
        impl<T: Real> HigherOrders<T> for $file::$Mechanism<T> {
            fn jerk(&self, pose: &Self::Pose, rates: &[T], bent: &[T], given: &[T]) -> Result<Vec<T>, PositionError> {
                self.jerk(pose, &named(rates), &named(bent), inputs::<Self>(given)).map(column)
            }
            fn point_jerks(&self, pose: &Self::Pose, [rates, bent, jerk]: [&[T]; 3]) -> Result<Vec<T>, PositionError> {
                let points =
                    self.point_jerks(pose, &named(rates), &named(bent), &named(jerk));
                points.map(|points| pairs(points.into()))
            }
            fn output_jerks(&self, pose: &Self::Pose, [rates, bent, jerk]: [&[T]; 3]) -> Result<Vec<T>, PositionError> {
                self.output_jerks(pose, &named(rates), &named(bent), &named(jerk)).map(list)
            }
            $crate::fixture::orders_of_unknowns!($method);
            fn point_ratio_derivatives(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError> {
                let points: [[_; 2]; _] = self.point_ratio_derivatives(pose)?.into();
                Ok(points.into_iter().flat_map(matrices).collect())
            }
            fn output_ratio_derivatives(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError> {
                self.output_ratio_derivatives(pose).map(|outputs| matrices(outputs.into()))
            }
            fn point_sensitivities(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError> {
                self.point_sensitivities(pose).map(|points| matrices(points.into()))
            }
            fn output_sensitivities(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError> {
                self.output_sensitivities(pose).map(|outputs| matrices(outputs.into()))
            }
        }
    )+};
}

macro_rules! orders_of_unknowns {
    (open) => {
        fn velocity_ratio_derivatives(&self, _: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError> {
            Ok(Vec::new())
        }
        fn sensitivity(&self, _: &Self::Pose) -> Result<DMatrix<T>, PositionError> {
            Ok(DMatrix::zeros(0, Self::PARAMETERS.len()))
        }
    };
    ($method:ident) => {
        fn velocity_ratio_derivatives(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError> {
            self.velocity_ratio_derivatives(pose).map(matrices)
        }
        fn sensitivity(&self, pose: &Self::Pose) -> Result<DMatrix<T>, PositionError> {
            self.sensitivity(pose).map(matrix)
        }
    };
}

pub(crate) use {closed_form, equations, fixtures, higher_orders, kinematics, orders_of_unknowns, position};

/// The entries of a list as an array.
pub(crate) fn array<T: Copy, const N: usize>(list: &[T]) -> [T; N] {
    list.try_into().expect("a number for each name")
}

/// Coordinates, or their derivatives, by name.
pub(crate) fn named<T: Real, G: From<SVector<T, N>>, const N: usize>(list: &[T]) -> G {
    G::from(array(list).into())
}

/// The inputs of a mechanism by name.
pub(crate) fn inputs<M: Mechanism>(list: &[M::Scalar]) -> M::Inputs {
    PerInput::<M>::from_fn(|index| list[index]).into()
}

/// The entries of an array.
pub(crate) fn list<T: Real, const N: usize>(values: impl Into<[T; N]>) -> Vec<T> {
    values.into().to_vec()
}

/// The entries of a column.
pub(crate) fn column<T: Real, const N: usize>(values: impl Into<SVector<T, N>>) -> Vec<T> {
    values.into().as_slice().to_vec()
}

/// x, y, x, y, .. of points or vectors.
pub(crate) fn pairs<T, P: Into<[T; 2]>, const N: usize>(points: [P; N]) -> Vec<T> {
    points.into_iter().flat_map(Into::into).collect()
}

pub(crate) fn matrix<T: Real, const R: usize, const C: usize>(matrix: SMatrix<T, R, C>) -> DMatrix<T> {
    DMatrix::from_column_slice(R, C, matrix.as_slice())
}

pub(crate) fn matrices<T: Real, const R: usize, const C: usize, const N: usize>(
    matrices: [SMatrix<T, R, C>; N],
) -> Vec<DMatrix<T>> {
    matrices.map(matrix).to_vec()
}
