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
