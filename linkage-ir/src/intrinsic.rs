//! The functions that compiled code calls and does not define: those of the runtime, of the scalar, and of emitted types.

use crate::{ElementaryFunction, Operations};

/// The syntax of a call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// `f(a, b)`, a function of the runtime.
    Function,
    /// `a.f(b)`
    Method,
    /// `Type::f(a, b)`
    Associated,
}

/// The meaning of an argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The name of the mechanism or scene in errors.
    Mechanism,
    /// The name of a group of unknowns, a point, or another part in errors.
    Part,
    Number,
    /// A list of numbers.
    Numbers,
    /// The columns of a matrix, or of several.
    Columns,
    /// A side of a chord: 1 or -1.
    Side,
    /// A number of a list.
    Place,
    /// A function.
    Code,
    /// A struct, a mechanism, or another value.
    Data,
}

/// The result of a function that succeeds, as far as its numbers are finite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finite {
    /// Nothing is known.
    Unknown,
    /// It is finite if this argument is, and only then.
    With(usize),
    /// It is finite, and so are the factors in this argument, a list or a triangle: the function checks them.
    Checks(usize),
}

/// The form of a function over lanes, without branches.
#[derive(Debug, Clone, Copy)]
pub struct InLane {
    pub function: Intrinsic,
    /// The arguments that it takes.
    pub takes: &'static [usize],
    pub result: LaneResult,
}

/// The result of a form over lanes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LaneResult {
    /// The result, always right.
    Right,
    /// The result, and whether it is right.
    Flagged,
    /// True if the check passes.
    Flag,
}

/// The kind of a condition in the code of a function, as in `KernelCheck` of the runtime.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CheckKind {
    Regular,
    Nonzero,
    Positive,
    Apart,
    Moderate,
    Open,
}

/// The formula of a result in FPCore, for a regular position: checks pass, triangles are open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meaning {
    /// It has none.
    None,
    /// This argument.
    Argument(usize),
    /// A condition of this kind on these arguments.
    Check(CheckKind, &'static [usize]),
    /// The half chord of the factors and the side at these places.
    Chord { factors: usize, side: usize },
    /// A half chord whose radius and scale are apart; the scale may be the first of a list.
    ReachChord { factors: usize, radius: usize, scale: usize, side: usize },
    /// The half chord of a triangle, and a flag if it says how well it is conditioned.
    Elbow { triangle: usize, side: usize, is_flagged: bool },
    /// A direction from its cosine and its sine.
    Direction,
    /// The sine and the cosine of an angle.
    SineCosine,
    /// The sines and the cosines of a list of angles.
    SinesCosines,
    /// A vector from the list of its entries, a matrix from that of its columns, or a struct of other numbers.
    From,
    /// Turns that are all zero: angles have their principal values.
    NoTurns,
    /// The principal value of an angle, in turns that are all zero.
    InTurn { turns: usize, principal: usize },
    /// The last argument with its entries by the names of points or outputs.
    Named(Entry),
}

/// An entry of a list that has one for each point or output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Entry {
    /// x and y of a point or a vector.
    Point,
    Output,
    /// A matrix as the list of its columns: of points, or of outputs, as the text says.
    Columns,
    /// Position, velocity and acceleration.
    PointMotion,
    /// Value, rate and acceleration.
    OutputMotion,
}

/// One row of the table.
#[derive(Debug)]
pub struct Row {
    /// The path in the runtime, or the name of the method, in Rust; several methods may have the same.
    pub name: &'static str,
    pub form: Form,
    pub roles: &'static [Role],
    pub cost: Operations,
    /// True if it returns an outcome: a value or an error.
    pub fails: bool,
    pub finite: Finite,
    pub in_lane: Option<InLane>,
    pub meaning: Meaning,
    /// True if the numbers of its result are those of its arguments, unchanged.
    pub is_unchanged: bool,
}

const NOTHING: Row = Row {
    name: "",
    form: Form::Function,
    roles: &[],
    cost: Operations { multiplications: 0, additions: 0, divisions: 0, functions: 0 },
    fails: false,
    finite: Finite::Unknown,
    in_lane: None,
    meaning: Meaning::None,
    is_unchanged: false,
};

/// A square root and a product.
const CHORD: Operations = Operations { multiplications: 1, additions: 0, divisions: 0, functions: 1 };

/// One function.
const FUNCTION: Operations = Operations { multiplications: 0, additions: 0, divisions: 0, functions: 1 };

const fn in_lane(function: Intrinsic, takes: &'static [usize], result: LaneResult) -> Option<InLane> {
    Some(InLane { function, takes, result })
}

macro_rules! intrinsics {
    ($($(#[$doc:meta])* $variant:ident $name:literal $form:ident [$($role:ident),*] {$($field:ident: $value:expr),*})*) => {
        /// A function that the program does not define.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub enum Intrinsic {$(
            $(#[$doc])*
            $variant,
        )*}

        impl Intrinsic {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            const ROWS: &'static [Row] = &[$(Row {
                name: $name,
                form: Form::$form,
                roles: &[$(Role::$role),*],
                $($field: $value,)*
                ..NOTHING
            }),*];

            /// The row of the table.
            #[must_use]
            pub fn row(self) -> &'static Row {
                &Self::ROWS[self as usize]
            }
        }
    };
}

intrinsics! {
    // Results of other types.
    Some "Some" Function [Data] {}
    Ok "Ok" Function [Data] { fails: true }
    Err "Err" Function [Data] { fails: true }
    Into "into" Method [Data] { meaning: Meaning::Argument(0) }
    /// The value of a `Result`, without the error.
    ValueOf "ok" Method [Data] {}
    And "and" Method [Data, Data] { fails: true }
    OrElse "or_else" Method [Data, Code] { fails: true, meaning: Meaning::Argument(0) }
    Map "map" Method [Data, Code] {}
    Iter "iter" Method [Data] {}
    AreAll "all" Method [Data, Code] {}
    Get "get" Method [Data, Place] {}
    Copied "copied" Method [Data] {}
    UnwrapOr "unwrap_or" Method [Data, Data] {}
    From "from" Associated [Data] { meaning: Meaning::From, is_unchanged: true }
    Zeros "zeros" Associated [] {}
    Default "default" Associated [] {}
    New "new" Associated [Numbers] {}
    /// All branches.
    All "all" Associated [] {}
    /// The coordinates of a pose.
    Coordinates "coordinates" Method [Data] {}
    /// A branch without sides, modes and turns.
    OnlyBranch "new" Associated [] {}
    /// The parts of the state of a scene.
    Parts "parts" Associated [Data] {}

    // Numbers.
    IsFinite "is_finite" Method [Number] {}
    Sum "sum" Method [Numbers] {}
    Square "square" Method [Number] {}
    SineCosine "sine_cosine" Method [Number] {
        cost: FUNCTION,
        in_lane: in_lane(Intrinsic::SineCosineInLane, &[0], LaneResult::Right),
        meaning: Meaning::SineCosine
    }
    SinesCosines "sines_cosines" Associated [Numbers] { meaning: Meaning::SinesCosines }
    Pi "pi" Associated [] {}
    /// A number of which nothing is known.
    Unknown "unknown" Associated [] {}
    Largest "largest" Function [Numbers] {}
    Unit "unit" Function [Number, Number] { meaning: Meaning::Direction, is_unchanged: true }

    // Checks.
    Finite "finite" Function [Mechanism, Part, Numbers] { fails: true }
    FiniteEach "finite_each" Function [Mechanism, Data] { fails: true }
    FinitePoints "finite_points" Function [Mechanism, Part, Columns] {
        fails: true,
        meaning: Meaning::Named(Entry::Point), is_unchanged: true
    }
    FiniteVectors "finite_vectors" Function [Mechanism, Part, Columns] {
        fails: true,
        meaning: Meaning::Named(Entry::Point), is_unchanged: true
    }
    FiniteOutputs "finite_outputs" Function [Mechanism, Part, Numbers] {
        fails: true,
        meaning: Meaning::Named(Entry::Output), is_unchanged: true
    }
    FiniteMatrix "finite_matrix" Function [Mechanism, Part, Data] { fails: true }
    EachSized "each_sized" Function [Data] {}
    FiniteMatrices "finite_matrices" Function [Mechanism, Part, Columns] {
        fails: true,
        meaning: Meaning::Named(Entry::Columns), is_unchanged: true
    }
    PointMotions "point_motions" Function [Mechanism, Columns] {
        fails: true,
        meaning: Meaning::Named(Entry::PointMotion), is_unchanged: true
    }
    OutputMotions "output_motions" Function [Mechanism, Columns] {
        fails: true,
        meaning: Meaning::Named(Entry::OutputMotion), is_unchanged: true
    }
    /// The mechanism at its inputs, in place of its name, so that an error names them.
    At "at" Function [Data, Numbers] {}
    Regular "regular" Function [Mechanism, Part, Number, Number] { fails: true, meaning: Meaning::Check(CheckKind::Regular, &[2, 3]) }
    IsNonzero "is_nonzero" Function [Number, Number] { meaning: Meaning::Check(CheckKind::Regular, &[0, 1]) }
    Closes "closes" Function [Number, Number] {}
    Solvable "solvable" Function [Mechanism, Part, Number, Numbers, Numbers] {
        fails: true,
        in_lane: in_lane(Intrinsic::IsSolvableInLane, &[2], LaneResult::Flag),
        meaning: Meaning::Check(CheckKind::Nonzero, &[2])
    }
    Reachable "reachable" Function [Mechanism, Part, Number] {
        fails: true,
        in_lane: in_lane(Intrinsic::IsReachableInLane, &[2], LaneResult::Flag),
        meaning: Meaning::Check(CheckKind::Positive, &[2])
    }
    Implied "implied" Function [Mechanism, Data, Numbers, Numbers] { fails: true }
    NotNegative "not_negative::<T, _>" Function [Mechanism, Data] { fails: true }
    ValidateStops "validate_stops" Function [Mechanism, Data] { fails: true }
    ValidateContacts "validate_contacts" Function [Mechanism, Data] { fails: true }

    // Half chords.
    ElbowChord "elbow_chord" Function [Mechanism, Part, Data, Side] {
        fails: true,
        cost: CHORD, finite: Finite::Checks(2),
        meaning: Meaning::Elbow { triangle: 2, side: 3, is_flagged: true }
    }
    RegularElbowChord "regular_elbow_chord" Function [Data, Side] {
        cost: CHORD, finite: Finite::Checks(0),
        in_lane: in_lane(Intrinsic::ElbowChordInLane, &[0, 1], LaneResult::Flagged),
        meaning: Meaning::Elbow { triangle: 0, side: 1, is_flagged: false }
    }
    Chord "chord" Function [Mechanism, Part, Numbers, Number, Numbers, Side] {
        fails: true,
        cost: CHORD, finite: Finite::Checks(2),
        meaning: Meaning::Chord { factors: 2, side: 5 }
    }
    ReachChord "reach_chord" Function [Mechanism, Part, Numbers, Number, Numbers, Side] {
        fails: true,
        cost: CHORD, finite: Finite::Checks(2),
        meaning: Meaning::ReachChord { factors: 2, radius: 3, scale: 4, side: 5 }
    }
    RegularChord "regular_chord" Function [Numbers, Number, Side] {
        cost: CHORD, finite: Finite::Checks(0),
        in_lane: in_lane(Intrinsic::ChordInLane, &[0, 2], LaneResult::Flagged),
        meaning: Meaning::Chord { factors: 0, side: 2 }
    }
    RegularReachChord "regular_reach_chord" Function [Numbers, Number, Number, Side] {
        cost: CHORD, finite: Finite::Checks(0),
        in_lane: in_lane(Intrinsic::ReachChordInLane, &[0, 1, 2, 3], LaneResult::Flagged),
        meaning: Meaning::ReachChord { factors: 0, radius: 1, scale: 2, side: 3 }
    }

    // Forms over lanes.
    SineInLane "lane::sine" Function [Number] { cost: FUNCTION }
    CosineInLane "lane::cosine" Function [Number] { cost: FUNCTION }
    SineCosineInLane "lane::sine_cosine" Function [Number] { cost: FUNCTION }
    Arctangent2InLane "lane::arctangent2" Function [Number, Number] { cost: FUNCTION }
    HypotenuseInLane "lane::hypotenuse" Function [Number, Number] { cost: FUNCTION }
    IsModerateInLane "lane::is_moderate" Function [Number] {}
    HasArctangent2InLane "lane::has_arctangent2" Function [Number, Number] {}
    HasHypotenuseInLane "lane::has_hypotenuse" Function [Number, Number] {}
    IsSolvableInLane "lane::is_solvable" Function [Number] {}
    IsReachableInLane "lane::is_reachable" Function [Number] {}
    ElbowChordInLane "lane::elbow_chord" Function [Data, Side] { cost: CHORD, finite: Finite::Checks(0) }
    ChordInLane "lane::chord" Function [Numbers, Side] { cost: CHORD, finite: Finite::Checks(0) }
    ReachChordInLane "lane::reach_chord" Function [Numbers, Number, Number, Side] { cost: CHORD, finite: Finite::Checks(0) }

    // Groups without closed form.
    ProductOfPivots "product_of_pivots" Function [Columns] {}
    /// The factorisation of a matrix.
    Factorization "new" Associated [Mechanism, Part, Columns, Numbers] { fails: true }
    Solve "solve" Method [Data, Numbers] {}
    Refined "refined" Method [Data, Data, Code] {}
    NewtonGroup "newton_group" Function [Mechanism, Part, Numbers, Code] { fails: true }
    Modes "modes" Method [Data, Mechanism, Part, Data, Code, Code] { fails: true }
    ModesWithLengths "modes_with_lengths" Method [Data, Mechanism, Part, Data, Data, Code, Code] { fails: true }
    Take "take" Method [Data, Mechanism, Part, Data] { fails: true }

    // Positions.
    Newton "newton" Function [Data, Data] { fails: true }
    NewtonAnyBranch "newton_any_branch" Function [Data, Data] { fails: true }
    Turns "Turns" Function [Data] { meaning: Meaning::NoTurns }
    /// The number of an angle in a turn: its principal value and whole turns.
    InTurn "number" Method [Data, Place, Number] {
        finite: Finite::With(2), meaning: Meaning::InTurn { turns: 0, principal: 2 }
    }
    /// The value of an angle in the turn nearest to a range.
    InRange "in_range" Function [Number, Number, Number] { finite: Finite::With(0) }
    TurnsFound "turns" Method [Data] {}
    Countable "countable" Function [Mechanism, Numbers] { fails: true }
    SideOf "side_of" Function [Number] {}
    SideAt "side_at" Function [Place] {}
    NumberOfMode "AssemblyMode::Number" Function [Place] {}
    Combinations "combinations" Function [Numbers, Code] {}
    Existing "existing" Function [Data, Code] { fails: true }
    NoClosedForm "no_closed_form" Function [Mechanism, Part] { fails: true }
    NoList "no_list" Function [Mechanism, Part] { fails: true }
    TooManyBranches "too_many_branches" Function [Mechanism] { fails: true }
    Limits "limits" Function [Data, Place, Data, Data, Data, Code, Code] { fails: true }
    LimitOfAngle "Bound::Angle" Function [Part, Numbers, Number] {}
    LimitOfLength "Bound::Length" Function [Part, Numbers] {}
    SearchLength "Search::Length" Function [Number] {}

    Ranged "ranged" Function [Number, Data, Data] {}
    RangedDirection "ranged_direction" Function [Number, Data, Data] {}
    RangedModuloTurns "ranged_modulo_turns" Function [Number, Data, Data] {}

    // Twice the precision.
    Widened "widened" Function [Number] {}
    WidenedDirection "widened_direction" Function [Data] {}
    WidenedByName "widened_by_name" Function [Data] {}
    WidenedColumn "widened_column" Function [Data] {}
    Rounded "rounded" Function [Data, Data] {}
    RoundedByName "rounded_by_name" Function [Data, Data] {}
    RoundedEach "rounded_each" Function [Data, Data] {}

    // Scenes.
    Reduced "reduced" Function [Mechanism, Data, Columns, Numbers] { fails: true }
    Reactions "reactions" Function [Data, Number, Data, Data] { fails: true }
    DriveForces "drive_forces" Function [Data, Number, Data, Data] { fails: true }
    BearingLoss "bearing_loss" Function [Data, Number, Data, Data] { fails: true }
    EquationsAt "at" Associated [Data, Data, Data, Data, Data] { fails: true }
    Equilibrium "equilibrium" Function [Mechanism, Numbers, Code] { fails: true }
}

impl Intrinsic {
    /// The form of an elementary function over lanes, if it has one of its own; and the check of the arguments for which
    /// that form has the same value.
    pub fn in_lane_of(function: ElementaryFunction) -> Option<[Self; 2]> {
        match function {
            ElementaryFunction::Sin => Some([Self::SineInLane, Self::IsModerateInLane]),
            ElementaryFunction::Cos => Some([Self::CosineInLane, Self::IsModerateInLane]),
            ElementaryFunction::Atan2 => Some([Self::Arctangent2InLane, Self::HasArctangent2InLane]),
            ElementaryFunction::Hypot => Some([Self::HypotenuseInLane, Self::HasHypotenuseInLane]),
            _ => None,
        }
    }
}

/// A constant that the program does not define.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Constant {
    /// The name of the mechanism or scene in errors.
    Name,
    None,
    /// An unknown of a group that is an angle.
    Angle,
    SearchTurn,
    NoSearch,
    /// The position of a group nearest to a guess.
    OfGuess,
    False,
    /// A mark that stands for the scalar of a type without numbers.
    Mark,
    /// The constant argument that is true if angles, points and outputs are wanted.
    Quantities,
}

impl Constant {
    /// True if it belongs to the runtime.
    pub fn is_of_runtime(self) -> bool {
        !matches!(self, Self::Name | Self::False | Self::Quantities)
    }

    /// The path.
    pub fn path(self) -> &'static str {
        match self {
            Self::Name => "Self::NAME",
            Self::None => "None",
            Self::Angle => "Unknown::Angle",
            Self::SearchTurn => "Search::Turn",
            Self::NoSearch => "Search::ClosedFormOnly",
            Self::OfGuess => "AssemblyMode::OfGuess",
            Self::False => "false",
            Self::Mark => "PhantomData",
            Self::Quantities => "QUANTITIES",
        }
    }
}
