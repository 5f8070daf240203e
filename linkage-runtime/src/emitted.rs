//! What the emitted code of every mechanism has in common but for its names. The macros are not part of the interface.

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
