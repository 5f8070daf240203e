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
        $(, branch $branch:ident $($near:ident)?)?
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
            fn is_finite(pose: &Self::Pose) -> bool {
                pose.is_finite()
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
                $(
                    fn $near(
                        &self,
                        guess: &Self::Coordinates,
                        branch: Self::Branch,
                    ) -> ::core::result::Result<Self::Pose, $crate::Error> {
                        self.$near(guess, branch)
                    }
                )?
                fn branch_of(&self, pose: &Self::Pose) -> Self::Branch {
                    self.branch_of(pose)
                }
            }
        )?
    };
}

/// The derivation as data: every list by its name, what is optional with or without one.
#[doc(hidden)]
#[macro_export]
macro_rules! __derivation {
    (
        $driver:ident $mechanism:literal,
        parameters $parameters:tt inputs $inputs:tt unknowns $unknowns:tt
        residual $residual:tt jacobian_unknowns $j:tt jacobian_inputs $a:tt
        blocks [$([
            $($unknown:literal)*; $($equation:literal)*; $group:literal $method:ident;
            $([$($block_determinant:tt)*])?; $([$($inverse:tt)*])?
        ])*]
        determinant $([$($determinant:tt)*])?
        ratios $ratios:tt ratio_derivatives $([$($second:tt)*])?
        gamma $gamma:tt jerk $([$($jerk:tt)*])?
        sensitivity $([$by_parameters:tt $sensitivities:tt])?
        points $points:tt outputs $outputs:tt
        conditions [$($condition:literal)*] kernels $kernels:tt
    ) => {
        impl $driver {
            /// The derivation as data: every formula, to be written as text, `LaTeX` or `MathML`, the order of
            /// solution and the work of each function. It costs nothing where it is not used.
            pub const DERIVATION: &'static $crate::derivation::Derivation = &$crate::derivation::Derivation {
                mechanism: $mechanism,
                parameters: $crate::__symbols!$parameters,
                inputs: $crate::__symbols!$inputs,
                unknowns: $crate::__symbols!$unknowns,
                residual: $crate::__equations!$residual,
                jacobian_unknowns: $crate::__matrix!$j,
                jacobian_inputs: $crate::__matrix!$a,
                blocks: &[$($crate::derivation::Block {
                    unknowns: &[$($crate::derivation::formula($unknown)),*],
                    equations: &[$($equation),*],
                    group: $group,
                    method: $crate::derivation::Method::$method,
                    determinant: $crate::__optional!($($crate::__equation!($($block_determinant)*))?),
                    inverse: $crate::__optional!($($crate::__matrix!($($inverse)*))?),
                }),*],
                determinant: $crate::__optional!($($crate::__equation!($($determinant)*))?),
                ratios: $crate::__equations!$ratios,
                ratio_derivatives: $crate::__optional!($($crate::__equations!($($second)*))?),
                gamma: $crate::__equations!$gamma,
                jerk: $crate::__optional!($($crate::__equations!($($jerk)*))?),
                sensitivity: $crate::__optional!($($crate::derivation::Sensitivity {
                    jacobian: $crate::__matrix!$by_parameters,
                    formulas: $crate::__equations!$sensitivities,
                })?),
                points: $crate::__derived!$points,
                outputs: $crate::__derived!$outputs,
                conditions: &[$($crate::derivation::formula($condition)),*],
                kernels: $crate::__kernels!$kernels,
            };
        }
    };
}

/// The equations of motion of a scene as data, likewise.
#[doc(hidden)]
#[macro_export]
macro_rules! __scene_derivation {
    (
        $name:ident $scene:literal $mechanism:literal,
        parameters $parameters:tt mass_matrix $mass_matrix:tt
        forces [$($effect:literal $force:tt)*]
        potential $([$($potential:tt)*])?
        kernels $kernels:tt
    ) => {
        impl $name {
            /// The equations of motion as data: every formula, to be written as text, `LaTeX` or `MathML`, and the
            /// work of each function. It costs nothing where it is not used.
            pub const DERIVATION: &'static $crate::derivation::Scene = &$crate::derivation::Scene {
                scene: $scene,
                mechanism: $mechanism,
                parameters: $crate::__symbols!$parameters,
                mass_matrix: $crate::__equations!$mass_matrix,
                forces: &[$($crate::derivation::Effect { name: $effect, forces: $crate::__equations!$force }),*],
                potential: $crate::__optional!($($crate::__equation!($($potential)*))?),
                kernels: $crate::__kernels!$kernels,
            };
        }
    };
}

/// What is there, or not.
#[doc(hidden)]
#[macro_export]
macro_rules! __optional {
    () => {
        ::core::option::Option::None
    };
    ($value:expr) => {
        ::core::option::Option::Some($value)
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

/// Left and right side of an equation.
#[doc(hidden)]
#[macro_export]
macro_rules! __equation {
    ($left:literal $right:literal) => {
        $crate::derivation::equation($left, $right)
    };
}

/// Lists of the derivation: left and right sides of equations.
#[doc(hidden)]
#[macro_export]
macro_rules! __equations {
    ($($left:literal $right:literal)*) => {
        &[$($crate::__equation!($left $right)),*]
    };
}

/// A matrix of the derivation: its name, what it is multiplied with, rows, columns, and the entries that are not zero.
#[doc(hidden)]
#[macro_export]
macro_rules! __matrix {
    (
        $name:literal $(* $factor:literal)? $rows:literal $columns:literal
        [$($row:literal $column:literal $value:literal)*]
    ) => {
        $crate::derivation::Matrix {
            name: $crate::derivation::formula($name),
            factor: $crate::__optional!($($crate::derivation::formula($factor))?),
            rows: $rows,
            columns: $columns,
            entries: &[$($crate::derivation::entry($row, $column, $value)),*],
        }
    };
}

/// Lists of the derivation: points or outputs.
#[doc(hidden)]
#[macro_export]
macro_rules! __derived {
    ($($name:literal $value:tt $ratios:tt $second:tt $first:tt)*) => {
        &[$($crate::derivation::Quantity {
            name: $name,
            value: $crate::__equations!$value,
            ratios: $crate::__equations!$ratios,
            ratio_derivatives: $crate::__equations!$second,
            sensitivities: $crate::__equations!$first,
        }),*]
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
