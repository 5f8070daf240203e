//! The functions of a mechanism that are in no trait of the library, and numbers by name.

use linkage::derivation::Derivation;
use linkage::kinematic::{Kinematic, PerCoordinate};
use linkage::{Dim, Mechanism, PerInput, PositionError, Real};
use nalgebra::{DMatrix, SMatrix, SVector};

/// A mechanism of the gallery.
pub trait Fixture: Kinematic<Name = &'static str> + Clone {
    /// The file of `src/mechanisms` without its ending.
    const FILE: &'static str;
    /// The constant of this name.
    const DERIVATION: &'static Derivation<'static>;
    /// The mechanism in another scalar.
    type In<T: Real>: Fixture<Scalar = T>;

    /// The default values of the parameters, in the order of declaration.
    fn defaults() -> Vec<f64>;
    /// The mechanism with these parameters, in the order of declaration.
    fn with_parameters(parameters: &[Self::Scalar]) -> Self;
    /// The parameters in the order of declaration.
    fn parameters(&self) -> Vec<Self::Scalar>;
    /// All branches; none if the position is found by Newton's method.
    fn branches() -> Vec<Self::Branch>;
    /// Psi_q, by rows of constraints and columns of coordinates.
    fn jacobian(&self, pose: &Self::Pose) -> DMatrix<Self::Scalar>;
    /// `assemble` at these inputs, or `assemble_near` from these coordinates.
    fn assembled(&self, q: &Self::Coordinates, branch: Self::Branch) -> Result<Self::Pose, PositionError>;
}

/// Implements the traits for all mechanisms of a list.
macro_rules! fixtures {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {$(
        $(
            impl<T: Real> Fixture for $file::$Mechanism<T> {
                const FILE: &'static str = stringify!($file);
                const DERIVATION: &'static Derivation<'static> = <$file::$Mechanism>::DERIVATION;
                type In<S: Real> = $file::$Mechanism<S>;

                fn defaults() -> Vec<f64> {
                    list(<$file::$Mechanism>::default())
                }
                fn with_parameters(parameters: &[T]) -> Self {
                    array(parameters).into()
                }
                fn parameters(&self) -> Vec<T> {
                    list(self.clone())
                }
                $crate::fixture::own!($method);
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

/// The functions of `derive jerk, velocity_ratio_derivatives, sensitivity`, which are in no trait of the library.
macro_rules! higher_orders {
    ($file:ident [$($Mechanism:ident $method:ident)+]) => {};
    ($file:ident [$($Mechanism:ident $method:ident)+] orders) => {$(
        impl<T: Real> PosedWithOrders<T> for At<$file::$Mechanism<T>> {
            fn jerk(&self, rates: &[T], bent: &[T], given: &[T]) -> Result<Vec<T>, PositionError> {
                let given = inputs::<$file::$Mechanism<T>>(given);
                self.mechanism.jerk(&self.pose, &by_name(rates), &by_name(bent), given).map(column)
            }
            fn point_jerks(&self, [rates, bent, jerk]: [&[T]; 3]) -> Result<Vec<T>, PositionError> {
                let points = self.mechanism.point_jerks(&self.pose, &by_name(rates), &by_name(bent), &by_name(jerk))?;
                Ok(pairs::<_, _, [_; _]>(points.into()))
            }
            fn output_jerks(&self, [rates, bent, jerk]: [&[T]; 3]) -> Result<Vec<T>, PositionError> {
                self.mechanism.output_jerks(&self.pose, &by_name(rates), &by_name(bent), &by_name(jerk)).map(list)
            }
            $crate::fixture::orders_of_unknowns!($file $Mechanism $method);
            fn point_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
                let points: [[_; 2]; _] = self.mechanism.point_ratio_derivatives(&self.pose)?.into();
                Ok(points.into_iter().flat_map(matrices).collect())
            }
            fn output_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
                self.mechanism.output_ratio_derivatives(&self.pose).map(|outputs| matrices(outputs.into()))
            }
            fn point_sensitivities(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
                self.mechanism.point_sensitivities(&self.pose).map(|points| matrices(points.into()))
            }
            fn output_sensitivities(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
                self.mechanism.output_sensitivities(&self.pose).map(|outputs| matrices(outputs.into()))
            }
        }
    )+};
}

macro_rules! orders_of_unknowns {
    ($file:ident $Mechanism:ident open) => {
        fn velocity_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
            Ok(Vec::new())
        }
        fn sensitivity(&self) -> Result<DMatrix<T>, PositionError> {
            Ok(DMatrix::zeros(0, $file::$Mechanism::<T>::PARAMETERS.len()))
        }
    };
    ($file:ident $Mechanism:ident $method:ident) => {
        fn velocity_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
            self.mechanism.velocity_ratio_derivatives(&self.pose).map(matrices)
        }
        fn sensitivity(&self) -> Result<DMatrix<T>, PositionError> {
            self.mechanism.sensitivity(&self.pose).map(matrix)
        }
    };
}

pub(crate) use {fixtures, higher_orders, orders_of_unknowns, own};

/// Coordinates, rates or accelerations from a number for each coordinate, in the order of the fields.
///
/// # Panics
/// If there are more or fewer numbers.
pub fn named<M: Kinematic, G: From<PerCoordinate<M>>>(list: &[M::Scalar]) -> G {
    let count = M::N::new(list.len()).expect("a number for each coordinate");
    G::from(count.array(|place| list[place]).into())
}

/// The inputs of a mechanism by name.
pub(crate) fn inputs<M: Mechanism>(list: &[M::Scalar]) -> M::Inputs {
    PerInput::<M>::from_slice(list).expect("a number for each input").into()
}

/// The entries of a list as an array.
pub(crate) fn array<T: Copy, const N: usize>(list: &[T]) -> [T; N] {
    list.try_into().expect("a number for each name")
}

/// Jerks by name, and what they are computed from.
pub(crate) fn by_name<T: Real, G: From<SVector<T, N>>, const N: usize>(list: &[T]) -> G {
    G::from(array(list).into())
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
pub(crate) fn pairs<T, P: Into<[T; 2]>, I: IntoIterator<Item = P>>(points: I) -> Vec<T> {
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
