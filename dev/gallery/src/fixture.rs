//! The functions of every mechanism as traits, so that a test of all mechanisms is one generic function.

use linkage::kinematic::{self, Kinematic, PerCoordinate};
use linkage::position::newton;
use linkage::{Assembly, Column, Dim, Matrix, Mechanism, OutputMotion, PerInput, PointMotion, PositionError, Real};
use nalgebra::{DMatrix, SMatrix, SVector};

/// The kinematics of a mechanism in lists, by its implementation of [`Kinematic`].
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

/// The functions of a mechanism that are in no trait of the library.
pub trait Own: Kinematic + Clone {
    fn with_parameters(parameters: &[Self::Scalar]) -> Self;
    fn parameters(&self) -> Vec<Self::Scalar>;
    /// All branches; none if the position is found by Newton's method.
    fn branches() -> Vec<Self::Branch>;
    fn jacobian(&self, pose: &Self::Pose) -> DMatrix<Self::Scalar>;
    /// `assemble` at these inputs, or `assemble_near` from these coordinates.
    fn assembled(&self, q: &Self::Coordinates, branch: Self::Branch) -> Result<Self::Pose, PositionError>;
    /// The branch of this number, or that of the coordinates if the position is found by Newton's method.
    fn branch_at(&self, q: &Self::Coordinates, number: usize) -> Self::Branch {
        let all = Self::branches();
        if all.is_empty() { self.branch_of(&self.pose_at(q)) } else { all[number] }
    }
}

impl<T: Real, M: Own<Scalar = T>> Kinematics<T> for M {
    fn with_parameters(parameters: &[T]) -> Self {
        Own::with_parameters(parameters)
    }
    fn parameters(&self) -> Vec<T> {
        Own::parameters(self)
    }
    fn named(q: &[T]) -> Self::Coordinates {
        named::<M, _>(q)
    }
    fn pose(&self, q: &[T]) -> Self::Pose {
        self.pose_at(&named::<M, _>(q))
    }
    fn listed(pose: &Self::Pose) -> Vec<T> {
        listed::<M>(M::coordinates_of(pose))
    }
    fn inputs_of(q: &[T]) -> Vec<T> {
        <M as Mechanism>::inputs(&named::<M, _>(q)).as_slice().to_vec()
    }
    fn jacobian(&self, pose: &Self::Pose) -> DMatrix<T> {
        Own::jacobian(self, pose)
    }
    fn velocity_ratios(&self, pose: &Self::Pose) -> Result<DMatrix<T>, PositionError> {
        Kinematic::velocity_ratios(self, pose).map(dynamic)
    }
    fn gamma_of(&self, pose: &Self::Pose, rates: &[T]) -> Vec<T> {
        self.gamma(pose, &named::<M, _>(rates)).as_slice().to_vec()
    }
    fn velocity(&self, pose: &Self::Pose, input_rates: &[T]) -> Result<Vec<T>, PositionError> {
        Kinematic::velocity(self, pose, inputs::<M>(input_rates)).map(listed::<M>)
    }
    fn acceleration(&self, pose: &Self::Pose, rates: &[T], given: &[T]) -> Result<Vec<T>, PositionError> {
        Kinematic::acceleration(self, pose, &named::<M, _>(rates), inputs::<M>(given)).map(listed::<M>)
    }
    fn points(&self, pose: &Self::Pose) -> Result<Vec<T>, PositionError> {
        Kinematic::points(self, pose).map(|points| pairs(M::each_point(points)))
    }
    fn point_velocities(&self, pose: &Self::Pose, rates: &[T]) -> Result<Vec<T>, PositionError> {
        Ok(pairs(M::each_point(Kinematic::point_velocities(self, pose, &named::<M, _>(rates))?)))
    }
    fn point_accelerations(&self, pose: &Self::Pose, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError> {
        let points = Kinematic::point_accelerations(self, pose, &named::<M, _>(rates), &named::<M, _>(bent))?;
        Ok(pairs(M::each_point(points)))
    }
    fn point_ratios(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError> {
        Ok(M::each_point(Kinematic::point_ratios(self, pose)?).into_iter().map(dynamic).collect())
    }
    fn outputs(&self, pose: &Self::Pose) -> Result<Vec<T>, PositionError> {
        Ok(M::each_output(Kinematic::outputs(self, pose)?).as_slice().to_vec())
    }
    fn output_velocities(&self, pose: &Self::Pose, rates: &[T]) -> Result<Vec<T>, PositionError> {
        Ok(M::each_output(Kinematic::output_velocities(self, pose, &named::<M, _>(rates))?).as_slice().to_vec())
    }
    fn output_accelerations(&self, pose: &Self::Pose, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError> {
        let outputs = Kinematic::output_accelerations(self, pose, &named::<M, _>(rates), &named::<M, _>(bent))?;
        Ok(M::each_output(outputs).as_slice().to_vec())
    }
    fn output_ratios(&self, pose: &Self::Pose) -> Result<Vec<DMatrix<T>>, PositionError> {
        Ok(M::each_output(Kinematic::output_ratios(self, pose)?).into_iter().map(dynamic).collect())
    }
    fn motion(&self, q: &[T], input_rates: &[T], given: &[T]) -> Result<Motion<T>, PositionError> {
        let motion = Kinematic::motion(self, &named::<M, _>(q), inputs::<M>(input_rates), inputs::<M>(given))?;
        Ok(Motion {
            coordinates: [listed::<M>(motion.position), listed::<M>(motion.rates), listed::<M>(motion.accelerations)],
            points: moving_points(M::each_point(motion.points)),
            outputs: moving_outputs(M::each_output(motion.outputs)),
        })
    }

    fn branch_count() -> usize {
        M::branches().len().max(1)
    }
    fn solved(&self, guess: &[T]) -> Result<Vec<T>, PositionError> {
        newton(self, &named::<M, _>(guess)).map(|solution| listed::<M>(solution.coordinates))
    }
    fn position(&self, q: &[T], branch: usize) -> Result<Self::Pose, PositionError> {
        match M::branches().is_empty() {
            true => Ok(self.pose(&self.solved(q)?)),
            false => Kinematics::assembled(self, q, branch),
        }
    }
    fn moving(
        &self,
        q: &[T],
        branch: usize,
        input_rates: &[T],
        given: &[T],
        full: bool,
    ) -> Result<Moving<Self::Pose, T>, PositionError> {
        let guess = named::<M, _>(q);
        let (branch, rates, bent) = (self.branch_at(&guess, branch), inputs::<M>(input_rates), inputs::<M>(given));
        let (kinematic::Kinematics { pose, rates, accelerations }, points, outputs) = match full {
            false => (Kinematic::kinematics(self, &guess, branch, rates, bent)?, None, None),
            true => {
                let kinematic::FullKinematics { pose, rates, accelerations, points, outputs } =
                    Kinematic::full_kinematics(self, &guess, branch, rates, bent)?;
                let points = moving_points(M::each_point(points));
                let outputs = moving_outputs(M::each_output(outputs));
                (kinematic::Kinematics { pose, rates, accelerations }, Some(points), Some(outputs))
            }
        };
        Ok(Moving { pose, rates: listed::<M>(rates), accelerations: listed::<M>(accelerations), points, outputs })
    }
    fn assembled(&self, q: &[T], branch: usize) -> Result<Self::Pose, PositionError> {
        let q = named::<M, _>(q);
        Own::assembled(self, &q, self.branch_at(&q, branch))
    }
}

impl<M: Assembly + Own> ClosedForm for M {
    fn all_branches() -> Vec<Self::Branch> {
        Self::branches()
    }
    fn coordinates_of(pose: &Self::Pose) -> Self::Coordinates {
        <M as Kinematic>::coordinates_of(pose)
    }
}

/// Implements the traits for all mechanisms of a list.
macro_rules! fixtures {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {$(
        $(
            impl<T: Real> Own for $file::$Mechanism<T> {
                fn with_parameters(parameters: &[T]) -> Self {
                    array(parameters).into()
                }
                fn parameters(&self) -> Vec<T> {
                    list(self.clone())
                }
                $crate::fixture::own!($method);
            }
            impl Fixture for $file::$Mechanism {
                const FILE: &'static str = stringify!($file);
                type Of<T: Real> = $file::$Mechanism<T>;
            }
        )+
        $crate::fixture::higher_orders!($file [$($Mechanism $method)+] $($orders)?);
    )*};
}

macro_rules! own {
    (open) => {
        fn jacobian(&self, _: &Self::Pose) -> DMatrix<T> {
            DMatrix::zeros(0, Self::INPUTS.len())
        }
        $crate::fixture::own!(@ assemble, <Self as Mechanism>::Branch::all().collect());
    };
    (closed) => {
        $crate::fixture::own!(@ jacobian);
        $crate::fixture::own!(@ assemble, <Self as Mechanism>::Branch::all().collect());
    };
    (newton) => {
        $crate::fixture::own!(@ jacobian);
        $crate::fixture::own!(@ assemble_near, Vec::new());
    };
    (@ jacobian) => {
        fn jacobian(&self, pose: &Self::Pose) -> DMatrix<T> {
            matrix(self.jacobian(pose))
        }
    };
    (@ $assemble:ident, $branches:expr) => {
        fn branches() -> Vec<Self::Branch> {
            $branches
        }
        fn assembled(&self, q: &Self::Coordinates, branch: Self::Branch) -> Result<Self::Pose, PositionError> {
            self.$assemble(q, branch)
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
                self.jerk(pose, &by_name(rates), &by_name(bent), inputs::<Self>(given)).map(column)
            }
            fn point_jerks(&self, pose: &Self::Pose, [rates, bent, jerk]: [&[T]; 3]) -> Result<Vec<T>, PositionError> {
                let points: [_; _] = self.point_jerks(pose, &by_name(rates), &by_name(bent), &by_name(jerk))?.into();
                Ok(pairs(points))
            }
            fn output_jerks(&self, pose: &Self::Pose, [rates, bent, jerk]: [&[T]; 3]) -> Result<Vec<T>, PositionError> {
                self.output_jerks(pose, &by_name(rates), &by_name(bent), &by_name(jerk)).map(list)
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

pub(crate) use {fixtures, higher_orders, orders_of_unknowns, own};

/// The entries of a list as an array.
pub(crate) fn array<T: Copy, const N: usize>(list: &[T]) -> [T; N] {
    list.try_into().expect("a number for each name")
}

/// A number for each coordinate of a mechanism, in the order of the fields.
fn named<M: Kinematic, G: From<PerCoordinate<M>>>(list: &[M::Scalar]) -> G {
    let numbers: PerCoordinate<M> = M::N::from_slice(list).expect("a number for each coordinate").into();
    G::from(numbers)
}

/// The numbers of coordinates, rates or accelerations, in the order of the fields.
fn listed<M: Kinematic>(by_name: impl Into<PerCoordinate<M>>) -> Vec<M::Scalar> {
    let numbers: <M::N as Dim>::Array<M::Scalar> = by_name.into().into();
    numbers.as_ref().to_vec()
}

/// Jerks by name, and what they are computed from.
pub(crate) fn by_name<T: Real, G: From<SVector<T, N>>, const N: usize>(list: &[T]) -> G {
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
pub(crate) fn pairs<T, P: Into<[T; 2]>>(points: impl IntoIterator<Item = P>) -> Vec<T> {
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

/// Positions, velocities and accelerations of points.
fn moving_points<T: Real, N: Dim>(points: Column<PointMotion<T>, N>) -> [Vec<T>; 3] {
    [
        pairs(points.map(|point| point.position)),
        pairs(points.map(|point| point.velocity)),
        pairs(points.map(|point| point.acceleration)),
    ]
}

/// Values, rates and second derivatives of outputs.
fn moving_outputs<T: Real, N: Dim>(outputs: Column<OutputMotion<T>, N>) -> [Vec<T>; 3] {
    [
        outputs.map(|output| output.value).as_slice().to_vec(),
        outputs.map(|output| output.velocity).as_slice().to_vec(),
        outputs.map(|output| output.acceleration).as_slice().to_vec(),
    ]
}

fn dynamic<T: Real, R: Dim, C: Dim>(matrix: Matrix<T, R, C>) -> DMatrix<T> {
    DMatrix::from_iterator(R::COUNT, C::COUNT, matrix.iter().copied())
}
