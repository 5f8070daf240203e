//! The names used by emitted code, in one module so that they cannot collide with names in the user's crate. Not part
//! of the interface.

pub use core::clone::Clone;
pub use core::convert::Into;
pub use core::iter::Iterator;
pub use core::marker::PhantomData;
pub use core::option::Option::{self, None, Some};
pub use core::result::Result::{self, Err, Ok};

pub use nalgebra::{Point2, SMatrix, SVector, Scalar, UnitComplex, Vector2};

pub use crate::branch::{combinations, existing, side_at, side_of};
pub use crate::chord::{
    Triangle, chord, elbow_chord, reach_chord, reachable, regular_chord, regular_elbow_chord, regular_reach_chord,
    solvable,
};
pub use crate::error::{finite, finite_matrix, no_closed_form, no_list, too_many_branches};
pub use crate::implied::{closes, implied};
pub use crate::joints::{Joint, JointForces};
pub use crate::kinematic::{FullKinematicsOf, Kinematic, KinematicsOf, MotionOf, Quantity};
pub use crate::lanes::{Batch, Lanes, Values};
pub use crate::limits::{Bound, Search, limits};
pub use crate::linear::{Factorization, is_nonzero, product_of_pivots, regular};
pub use crate::modes::{Loops, Memory, Unknown};
pub use crate::motion::{
    each_sized, finite_matrices, finite_outputs, finite_points, finite_vectors, output_motions, point_motions,
};
pub use crate::origin::{Origin, at, at_named};
pub use crate::position::newton_group;
pub use crate::ranges::{in_range, ranged, ranged_direction, ranged_modulo_turns};
pub use crate::scalar::{largest, unit};
pub use crate::skeleton::{Part, Skeleton};
pub use crate::turn::{NearestTurns, Turn, Turns, countable};
pub use crate::wide::{
    Wide, rounded, rounded_by_name, rounded_each, widened, widened_by_name, widened_column, widened_direction,
};
pub use crate::{
    AnyBranch, Assembled, Assembly, AssemblyMode, Branches, Certifiable, Column, D, Elbow, Formulas, Group, InputError,
    Limits, Matrix, Mechanism, Number, OutputMotion, PointMotion, PositionError, Ranged, Real, Slider, Slope, Solution,
    lane, newton, newton_any_branch, real,
};

/// The types of emitted derivations.
pub mod derivation {
    /// The names that constants use.
    pub mod prelude {
        pub use core::option::Option::{None, Some};

        pub use crate::derivation::ElementaryFunction::*;
        pub use crate::derivation::FormulaNode::*;
        pub use crate::derivation::constants::{FormulaLists, table};
        pub use crate::derivation::*;
    }
}

/// The crate `serde`, and names for its attributes.
#[cfg(feature = "serde")]
pub mod serde {
    pub use ::serde::*;

    pub use crate::Real;
    pub use crate::serialised::direction;
}

/// Traits imported without a name, for the methods that emitted code calls.
pub mod prelude {
    pub use core::convert::{From as _, Into as _};
    pub use core::default::Default as _;
    pub use core::iter::Iterator as _;

    pub use crate::turn::Turn as _;
}
