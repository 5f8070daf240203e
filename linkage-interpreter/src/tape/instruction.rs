//! The operations of a tape: the functions of the runtime over lanes, by the registers that they read and write.

use linkage_runtime::Elbow;

/// A function of one number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Unary {
    Negative,
    Sqrt,
    Abs,
    Sine,
    Cosine,
    /// With whole turns.
    Turned(i32),
}

/// A function of two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Binary {
    Plus,
    Minus,
    Times,
    Over,
    Arctangent2,
    Hypotenuse,
    /// An angle in the turn nearest to a guess: the guess, its principal value.
    NearestTurn,
}

/// A function of three numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ternary {
    IfNonzero,
    InRange,
}

/// A condition on one or two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Test {
    IsFinite,
    IsModerate,
    IsSolvable,
    IsReachable,
    HasArctangent2,
    HasHypotenuse,
    IsNonzero,
    Closes,
}

/// A half chord of numbers that say how large the parts of a group are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Chord {
    /// The half chord of a triangle: links, line, scale, reach squared, distance squared, factors.
    Elbow,
    /// The half chord of two factors.
    Factors,
    /// The half chord of two factors, if a radius is apart from rounding errors of a scale.
    Reach,
}

/// One operation: registers are read, then written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Instruction {
    Unary(Unary, u32, u32),
    Binary(Binary, u32, [u32; 2]),
    Ternary(Ternary, u32, [u32; 3]),
    SineCosine([u32; 2], u32),
    /// A number and a flag.
    Chord(Chord, Elbow, (u32, u32), Vec<u32>),
    Test(Test, u32, [u32; 2]),
    And(u32, [u32; 2]),
}

impl Instruction {
    /// The registers of numbers that it reads and writes, and those of flags.
    pub(super) fn each(&mut self, visit: &mut dyn FnMut(Use<'_>)) {
        match self {
            Self::Unary(_, to, from) => {
                visit(Use::Reads(from));
                visit(Use::Writes(to));
            }
            Self::Binary(_, to, from) => {
                from.iter_mut().for_each(|from| visit(Use::Reads(from)));
                visit(Use::Writes(to));
            }
            Self::Ternary(_, to, from) => {
                from.iter_mut().for_each(|from| visit(Use::Reads(from)));
                visit(Use::Writes(to));
            }
            Self::SineCosine(to, from) => {
                visit(Use::Reads(from));
                to.iter_mut().for_each(|to| visit(Use::Writes(to)));
            }
            Self::Chord(_, _, (to, flag), from) => {
                from.iter_mut().for_each(|from| visit(Use::Reads(from)));
                visit(Use::Writes(to));
                visit(Use::WritesFlag(flag));
            }
            Self::Test(_, flag, from) => {
                from.iter_mut().for_each(|from| visit(Use::Reads(from)));
                visit(Use::WritesFlag(flag));
            }
            Self::And(flag, from) => {
                from.iter_mut().for_each(|from| visit(Use::ReadsFlag(from)));
                visit(Use::WritesFlag(flag));
            }
        }
    }
}

/// A register of an operation.
pub(super) enum Use<'i> {
    Reads(&'i mut u32),
    Writes(&'i mut u32),
    ReadsFlag(&'i mut u32),
    WritesFlag(&'i mut u32),
}
