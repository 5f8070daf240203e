//! The functions that compiled code calls and does not define: elementary ones, and those of the runtime.

use serde::{Deserialize, Serialize};

/// An elementary function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Elementary {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sqrt,
    Abs,
    Exp,
    Ln,
    Hypot,
    /// `if_nonzero(a, v, w)`: v, or w where a is zero.
    IfNonzero,
}

/// A function of the runtime, by its name there, or an operation on its types.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Operation {
    // Values that may be absent, and outcomes.
    Present,
    Success,
    Failure,
    ValueOf,
    And,
    OrElse,
    UnwrapOr,
    // Lists.
    Map,
    Get,
    AreFinite,
    Sum,
    Largest,
    /// The list of a column, of the columns of a matrix, or of the fields of a record.
    Listed,
    Matrix,
    /// The inputs of coordinates by name.
    InputsOf,
    /// A mechanism from the list of its parameters.
    MechanismOf,
    /// q and v' by name from the state of a scene.
    Parts,

    // Numbers.
    SineCosine,
    SinesCosines,
    Direction,

    // Checks.
    Finite,
    FiniteEach,
    FinitePoints,
    FiniteVectors,
    FiniteOutputs,
    FiniteMatrix,
    FinitePointMatrices,
    FiniteOutputMatrices,
    PointMotions,
    OutputMotions,
    At,
    Regular,
    IsNonzero,
    Closes,
    Solvable,
    Reachable,
    Implied,
    NotNegative,
    ValidateStops,
    ValidateContacts,

    // Half chords.
    ElbowChord,
    RegularElbowChord,
    Chord,
    ReachChord,
    RegularChord,
    RegularReachChord,

    // Forms over lanes.
    SineInLane,
    CosineInLane,
    SineCosineInLane,
    Arctangent2InLane,
    HypotenuseInLane,
    IsModerateInLane,
    HasArctangent2InLane,
    HasHypotenuseInLane,
    IsSolvableInLane,
    IsReachableInLane,
    ElbowChordInLane,
    ChordInLane,
    ReachChordInLane,

    // Groups without closed form.
    ProductOfPivots,
    Factorization,
    Solve,
    Refined,
    NewtonGroup,
    Modes,
    ModesWithLengths,
    Take,
    Memory,

    // Positions.
    Newton,
    NewtonAnyBranch,
    Turns,
    NearestTurns,
    InTurn,
    InRange,
    TurnsFound,
    Countable,
    SideOf,
    SideAt,
    NumberOfMode,
    ModeOfGuess,
    Combinations,
    Existing,
    NoClosedForm,
    NoList,
    TooManyBranches,
    Limits,
    LimitOfAngle,
    LimitOfLength,
    SearchLength,
    SearchTurn,
    NoSearch,
    UnknownAngle,
    Ranged,
    RangedDirection,
    RangedModuloTurns,

    // Twice the precision.
    Widened,
    Rounded,

    // Scenes.
    Reduced,
    Reactions,
    DriveForces,
    BearingLoss,
    EquationsAt,
    Equilibrium,
}

impl Operation {
    /// True if it returns an outcome, not a value.
    pub(crate) fn is_fallible(self) -> bool {
        match self {
            Self::Finite
            | Self::FiniteEach
            | Self::FinitePoints
            | Self::FiniteVectors
            | Self::FiniteOutputs
            | Self::FiniteMatrix
            | Self::FinitePointMatrices
            | Self::FiniteOutputMatrices
            | Self::PointMotions
            | Self::OutputMotions
            | Self::Regular
            | Self::Solvable
            | Self::Reachable
            | Self::Implied
            | Self::NotNegative
            | Self::ValidateStops
            | Self::ValidateContacts
            | Self::ElbowChord
            | Self::Chord
            | Self::ReachChord
            | Self::Factorization
            | Self::NewtonGroup
            | Self::Modes
            | Self::ModesWithLengths
            | Self::Take
            | Self::Newton
            | Self::NewtonAnyBranch
            | Self::Countable
            | Self::Existing
            | Self::NoClosedForm
            | Self::NoList
            | Self::TooManyBranches
            | Self::Limits
            | Self::Failure
            | Self::And
            | Self::OrElse
            | Self::Reduced
            | Self::Reactions
            | Self::DriveForces
            | Self::BearingLoss
            | Self::EquationsAt
            | Self::Equilibrium
            | Self::Success => true,
            Self::ValueOf
            | Self::Present
            | Self::UnwrapOr
            | Self::Map
            | Self::Get
            | Self::AreFinite
            | Self::Sum
            | Self::Largest
            | Self::Listed
            | Self::Matrix
            | Self::InputsOf
            | Self::MechanismOf
            | Self::Parts
            | Self::SineCosine
            | Self::SinesCosines
            | Self::Direction
            | Self::At
            | Self::IsNonzero
            | Self::Closes
            | Self::RegularElbowChord
            | Self::RegularChord
            | Self::RegularReachChord
            | Self::SineInLane
            | Self::CosineInLane
            | Self::SineCosineInLane
            | Self::Arctangent2InLane
            | Self::HypotenuseInLane
            | Self::IsModerateInLane
            | Self::HasArctangent2InLane
            | Self::HasHypotenuseInLane
            | Self::IsSolvableInLane
            | Self::IsReachableInLane
            | Self::ElbowChordInLane
            | Self::ChordInLane
            | Self::ReachChordInLane
            | Self::ProductOfPivots
            | Self::Solve
            | Self::Refined
            | Self::Memory
            | Self::Turns
            | Self::NearestTurns
            | Self::InTurn
            | Self::InRange
            | Self::TurnsFound
            | Self::SideOf
            | Self::SideAt
            | Self::NumberOfMode
            | Self::ModeOfGuess
            | Self::Combinations
            | Self::LimitOfAngle
            | Self::LimitOfLength
            | Self::SearchLength
            | Self::SearchTurn
            | Self::NoSearch
            | Self::UnknownAngle
            | Self::Ranged
            | Self::RangedDirection
            | Self::RangedModuloTurns
            | Self::Widened
            | Self::Rounded => false,
        }
    }
}
