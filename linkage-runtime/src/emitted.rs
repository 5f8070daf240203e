//! What the emitted code of every mechanism has in common but for its names. The macros are not part of the interface.

/// Names of coordinates, and their conversions from and to vectors.
#[doc(hidden)]
#[macro_export]
macro_rules! __coordinates {
    ($name:ident [$($field:ident $text:literal)*] $count:literal $($scalar:ident)?) => {
        impl<T> $name<T> {
            /// The coordinates as they were declared, in order.
            pub const NAMES: [&'static str; $count] = [$($text),*];
        }
        impl<T: $crate::Real> ::core::convert::From<$crate::nalgebra::SVector<T, $count>> for $name<T> {
            fn from(vector: $crate::nalgebra::SVector<T, $count>) -> Self {
                let [[$($field),*]] = vector.data.0;
                Self { $($field,)* $($scalar: ::core::marker::PhantomData)? }
            }
        }
        impl<T: $crate::Real> ::core::convert::From<$name<T>> for $crate::nalgebra::SVector<T, $count> {
            fn from(coordinates: $name<T>) -> Self {
                Self::from([$(coordinates.$field),*])
            }
        }
    };
}

/// Inputs or unknowns, picked from all coordinates.
#[doc(hidden)]
#[macro_export]
macro_rules! __part_of_coordinates {
    ($name:ident [$($field:ident $text:literal)*] $count:literal $coordinates:ident $($scalar:ident)?) => {
        $crate::__coordinates!($name [$($field $text)*] $count $($scalar)?);
        impl<T: $crate::Real> ::core::convert::From<&$coordinates<T>> for $name<T> {
            fn from(q: &$coordinates<T>) -> Self {
                Self { $($field: q.$field,)* $($scalar: ::core::marker::PhantomData)? }
            }
        }
    };
}

/// Names of points or outputs, and one of each from and to an array.
#[doc(hidden)]
#[macro_export]
macro_rules! __quantities {
    ($name:ident [$($field:ident $text:literal)*] $count:literal) => {
        impl<Q> $name<Q> {
            /// The names as they were declared, in order.
            pub const NAMES: [&'static str; $count] = [$($text),*];
        }
        impl<Q> ::core::convert::From<$name<Q>> for [Q; $count] {
            fn from(named: $name<Q>) -> Self {
                [$(named.$field),*]
            }
        }
        impl<Q> ::core::convert::From<[Q; $count]> for $name<Q> {
            fn from([$($field),*]: [Q; $count]) -> Self {
                Self { $($field),* }
            }
        }
    };
}

/// Names of parameters, and their conversions from and to arrays and other scalars.
#[doc(hidden)]
#[macro_export]
macro_rules! __parameters {
    ($name:ident [$($field:ident $text:literal)*] $count:literal $($scalar:ident)?) => {
        impl<T> ::core::convert::From<[T; $count]> for $name<T> {
            fn from([$($field),*]: [T; $count]) -> Self {
                Self { $($field,)* $($scalar: ::core::marker::PhantomData)? }
            }
        }
        impl<T> ::core::convert::From<$name<T>> for [T; $count] {
            fn from(parameters: $name<T>) -> Self {
                [$(parameters.$field),*]
            }
        }
        impl<T: $crate::Real> $name<T> {
            /// The parameters as they were declared, in order.
            pub const PARAMETERS: [&'static str; $count] = [$($text),*];
            /// The same mechanism with another scalar.
            #[must_use]
            pub fn map<S>(self, scalar: impl ::core::ops::Fn(T) -> S) -> $name<S> {
                $name { $($field: scalar(self.$field),)* $($scalar: ::core::marker::PhantomData)? }
            }
        }
    };
}

/// The functions of a mechanism, as general algorithms call them.
#[doc(hidden)]
#[macro_export]
macro_rules! __mechanism {
    (
        $name:ident $coordinates:ident $pose:ident,
        unknowns $unknowns:ident [$($unknown:ident $unknown_text:literal $unknown_angle:literal)*] $u:literal,
        inputs $inputs:ident [$($input:ident $input_text:literal $input_angle:literal)*] $v:literal,
        groups [$($group:literal $equations:tt $of:tt)*] $groups:literal
        $(, branch $branch:ident)?
    ) => {
        impl<T: $crate::Real> $crate::Mechanism<T, $u, $v> for $name<T> {
            const NAME: &'static str = ::core::stringify!($name);
            const UNKNOWNS: [&'static str; $u] = [$($unknown_text),*];
            const INPUTS: [&'static str; $v] = [$($input_text),*];
            const UNKNOWN_ANGLES: [bool; $u] = [$($unknown_angle),*];
            const INPUT_ANGLES: [bool; $v] = [$($input_angle),*];
            const GROUPS: &'static [$crate::Group] =
                &[$($crate::Group { name: $group, equations: &$equations, unknowns: &$of }),*];
            type Coordinates = $coordinates<T>;
            type Inputs = $inputs<T>;
            type Unknowns = $unknowns<T>;
            type Pose = $pose<T>;
            type BlockDeterminants = [T; $groups];
            fn unknowns(q: &Self::Coordinates) -> $crate::nalgebra::SVector<T, $u> {
                ::core::convert::Into::into(<$unknowns<T> as ::core::convert::From<_>>::from(q))
            }
            fn inputs(q: &Self::Coordinates) -> $crate::nalgebra::SVector<T, $v> {
                ::core::convert::Into::into(<$inputs<T> as ::core::convert::From<_>>::from(q))
            }
            fn with_inputs(q: &Self::Coordinates, inputs: $crate::nalgebra::SVector<T, $v>) -> Self::Coordinates {
                let [[$($input),*]] = inputs.data.0;
                $coordinates { $($input,)* ..*q }
            }
            fn with_unknowns(q: &Self::Coordinates, unknowns: $crate::nalgebra::SVector<T, $u>) -> Self::Coordinates {
                let [[$($unknown),*]] = unknowns.data.0;
                $coordinates { $($unknown,)* ..*q }
            }
            fn pose_at(&self, q: &Self::Coordinates) -> Self::Pose {
                self.pose_at(q)
            }
            fn residual(&self, pose: &Self::Pose) -> $crate::nalgebra::SVector<T, $u> {
                self.residual(pose)
            }
            fn closure_sizes(&self, pose: &Self::Pose) -> $crate::nalgebra::SVector<T, $u> {
                self.closure_sizes(pose)
            }
            fn jacobian_unknowns(&self, pose: &Self::Pose) -> $crate::nalgebra::SMatrix<T, $u, $u> {
                self.jacobian_unknowns(pose)
            }
            fn jacobian_inputs(&self, pose: &Self::Pose) -> $crate::nalgebra::SMatrix<T, $u, $v> {
                self.jacobian_inputs(pose)
            }
            fn jacobian_sizes(
                &self,
                pose: &Self::Pose,
            ) -> ($crate::nalgebra::SMatrix<T, $u, $u>, $crate::nalgebra::SMatrix<T, $u, $v>) {
                self.jacobian_sizes(pose)
            }
            fn determinant(&self, pose: &Self::Pose) -> T {
                self.determinant(pose)
            }
            fn block_determinants(&self, pose: &Self::Pose) -> Self::BlockDeterminants {
                self.block_determinants(pose)
            }
            fn gamma(&self, pose: &Self::Pose, rate: &Self::Coordinates) -> $crate::nalgebra::SVector<T, $u> {
                self.gamma(pose, rate)
            }
            fn solve_jacobian(
                &self,
                pose: &Self::Pose,
                right: &$crate::nalgebra::SVector<T, $u>,
            ) -> ::core::result::Result<$crate::nalgebra::SVector<T, $u>, $crate::Error> {
                self.solve_jacobian(pose, right)
            }
        }
        $(
            impl<T: $crate::Real> $crate::Assembly<T, $u, $v> for $name<T> {
                type Branch = $branch;
                fn assemble(
                    &self,
                    inputs: Self::Inputs,
                    branch: Self::Branch,
                ) -> ::core::result::Result<Self::Pose, $crate::Error> {
                    self.assemble(inputs, branch)
                }
                fn branch_of(&self, pose: &Self::Pose) -> Self::Branch {
                    self.branch_of(pose)
                }
            }
        )?
    };
}

/// Lists of the derivation: the names of parameters or coordinates.
#[doc(hidden)]
#[macro_export]
macro_rules! __symbols {
    ($($name:literal)*) => {
        &[$($crate::derivation::symbol($name)),*]
    };
}

/// Lists of the derivation: left and right sides of equations.
#[doc(hidden)]
#[macro_export]
macro_rules! __equations {
    ($($left:literal $right:literal)*) => {
        &[$($crate::derivation::equation($left, $right)),*]
    };
}

/// Lists of the derivation: functions with the work of each.
#[doc(hidden)]
#[macro_export]
macro_rules! __kernels {
    ($($function:literal $functions:literal $divisions:literal $multiplications:literal $additions:literal)*) => {
        &[$($crate::derivation::kernel($function, [$functions, $divisions, $multiplications, $additions])),*]
    };
}
