//! Numbers and flags that stand for registers of a tape.

use std::cell::RefCell;
use std::rc::Rc;

use linkage_runtime::__rt::{self as rt, NearestTurns, Triangle, Turn as _, Turns, lane};
use linkage_runtime::Elbow;

use super::instruction::{Binary, Chord, Instruction, Ternary, Test, Unary};

/// A recording.
#[derive(Debug, Default)]
pub(crate) struct Recorder {
    pub(super) instructions: Vec<Instruction>,
    pub(super) numbers: u32,
    pub(super) flags: u32,
    pub(super) given: Vec<(usize, u32)>,
    pub(super) constants: Vec<(f64, u32)>,
}

/// A recording that its numbers share.
pub(crate) type Recording = Rc<RefCell<Recorder>>;

/// A number: a constant, or a register.
#[derive(Debug, Clone)]
pub(crate) enum Traced {
    Constant(f64),
    Register(Recording, u32),
}

/// A flag.
#[derive(Debug, Clone)]
pub(crate) enum Flag {
    Constant(bool),
    Register(Recording, u32),
}

impl Recorder {
    fn number(&mut self) -> u32 {
        self.numbers += 1;
        self.numbers - 1
    }

    fn flag(&mut self) -> u32 {
        self.flags += 1;
        self.flags - 1
    }

    /// The register of a constant: one for each bit pattern.
    fn constant(&mut self, value: f64) -> u32 {
        let same = |(other, _): &&(f64, u32)| other.to_bits() == value.to_bits();
        if let Some((_, register)) = self.constants.iter().find(same) {
            return *register;
        }
        let register = self.number();
        self.constants.push((value, register));
        register
    }

    /// The register of a given column.
    pub(crate) fn given(of: &Recording, column: usize) -> Traced {
        let mut recorder = of.borrow_mut();
        let register = recorder.number();
        recorder.given.push((column, register));
        Traced::Register(Rc::clone(of), register)
    }
}

/// The recording of the first register among numbers.
fn recording<'t>(of: impl IntoIterator<Item = &'t Traced>) -> Option<Recording> {
    of.into_iter().find_map(|one| match one {
        Traced::Register(recording, _) => Some(Rc::clone(recording)),
        Traced::Constant(_) => None,
    })
}

impl Traced {
    fn constant(&self) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Register(..) => f64::NAN,
        }
    }

    fn register(&self, recorder: &mut Recorder) -> u32 {
        match self {
            Self::Constant(value) => recorder.constant(*value),
            Self::Register(_, register) => *register,
        }
    }

    pub(crate) fn unary(&self, of: Unary) -> Self {
        match self {
            Self::Constant(value) => Self::Constant(unary(of, *value)),
            Self::Register(recording, from) => {
                let mut recorder = recording.borrow_mut();
                let to = recorder.number();
                recorder.instructions.push(Instruction::Unary(of, to, *from));
                Self::Register(Rc::clone(recording), to)
            }
        }
    }

    pub(crate) fn binary(&self, of: Binary, other: &Self) -> Self {
        let Some(recording) = recording([self, other]) else {
            return Self::Constant(binary(of, self.constant(), other.constant()));
        };
        let mut recorder = recording.borrow_mut();
        let from = [self, other].map(|one| one.register(&mut recorder));
        let to = recorder.number();
        recorder.instructions.push(Instruction::Binary(of, to, from));
        drop(recorder);
        Self::Register(recording, to)
    }

    pub(crate) fn ternary(&self, of: Ternary, others: [&Self; 2]) -> Self {
        let all = [self, others[0], others[1]];
        let Some(recording) = recording(all) else {
            return Self::Constant(ternary(of, all.map(Self::constant)));
        };
        let mut recorder = recording.borrow_mut();
        let from = all.map(|one| one.register(&mut recorder));
        let to = recorder.number();
        recorder.instructions.push(Instruction::Ternary(of, to, from));
        drop(recorder);
        Self::Register(recording, to)
    }

    pub(crate) fn sine(&self) -> Self {
        self.unary(Unary::Sine)
    }

    pub(crate) fn cosine(&self) -> Self {
        self.unary(Unary::Cosine)
    }

    /// The sine and the cosine.
    pub(crate) fn sine_cosine(&self) -> [Self; 2] {
        match self {
            Self::Constant(value) => {
                let (sine, cosine) = lane::sine_cosine(*value);
                [Self::Constant(sine), Self::Constant(cosine)]
            }
            Self::Register(recording, from) => {
                let mut recorder = recording.borrow_mut();
                let to = [recorder.number(), recorder.number()];
                recorder.instructions.push(Instruction::SineCosine(to, *from));
                to.map(|to| Self::Register(Rc::clone(recording), to))
            }
        }
    }

    pub(crate) fn arctangent2(&self, x: &Self) -> Self {
        self.binary(Binary::Arctangent2, x)
    }

    pub(crate) fn hypotenuse(&self, y: &Self) -> Self {
        self.binary(Binary::Hypotenuse, y)
    }

    pub(crate) fn turned(&self, turns: i32) -> Self {
        self.unary(Unary::Turned(turns))
    }

    /// The principal value of an angle in the turn nearest to this guess.
    pub(crate) fn nearest_turn(&self, principal: &Self) -> Self {
        self.binary(Binary::NearestTurn, principal)
    }

    pub(crate) fn in_range(&self, least: &Self, most: &Self) -> Self {
        self.ternary(Ternary::InRange, [least, most])
    }

    /// A condition on this number, and on another if it has two.
    pub(crate) fn test(&self, of: Test, other: &Self) -> Flag {
        let Some(recording) = recording([self, other]) else {
            return Flag::Constant(test(of, self.constant(), other.constant()));
        };
        let mut recorder = recording.borrow_mut();
        let from = [self, other].map(|one| one.register(&mut recorder));
        let flag = recorder.flag();
        recorder.instructions.push(Instruction::Test(of, flag, from));
        drop(recorder);
        Flag::Register(recording, flag)
    }

    /// A half chord, and whether it is right.
    pub(crate) fn chord(of: Chord, side: Elbow, numbers: &[Self]) -> (Self, Flag) {
        let Some(recording) = recording(numbers) else {
            let numbers: Vec<f64> = numbers.iter().map(Self::constant).collect();
            let (chord, is_right) = chord(of, side, &numbers);
            return (Self::Constant(chord), Flag::Constant(is_right));
        };
        let mut recorder = recording.borrow_mut();
        let from = numbers.iter().map(|one| one.register(&mut recorder)).collect();
        let (to, flag) = (recorder.number(), recorder.flag());
        recorder.instructions.push(Instruction::Chord(of, side, (to, flag), from));
        drop(recorder);
        (Self::Register(Rc::clone(&recording), to), Flag::Register(recording, flag))
    }
}

impl Flag {
    /// True where both are.
    pub(crate) fn and(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Constant(true), one) | (one, Self::Constant(true)) => one.clone(),
            (Self::Constant(false), _) | (_, Self::Constant(false)) => Self::Constant(false),
            (Self::Register(recording, one), Self::Register(_, other)) => {
                let mut recorder = recording.borrow_mut();
                let flag = recorder.flag();
                recorder.instructions.push(Instruction::And(flag, [*one, *other]));
                Self::Register(Rc::clone(recording), flag)
            }
        }
    }
}

#[inline(always)]
pub(super) fn unary(of: Unary, x: f64) -> f64 {
    match of {
        Unary::Negative => -x,
        Unary::Sqrt => x.sqrt(),
        Unary::Abs => x.abs(),
        Unary::Sine => lane::sine(x),
        Unary::Cosine => lane::cosine(x),
        Unary::Turned(turns) => Turns([turns]).number(0, x),
    }
}

#[inline(always)]
pub(super) fn binary(of: Binary, x: f64, y: f64) -> f64 {
    match of {
        Binary::Plus => x + y,
        Binary::Minus => x - y,
        Binary::Times => x * y,
        Binary::Over => x / y,
        Binary::Arctangent2 => lane::arctangent2(x, y),
        Binary::Hypotenuse => lane::hypotenuse(x, y),
        Binary::NearestTurn => NearestTurns::new([x]).number(0, y),
    }
}

#[inline(always)]
pub(super) fn ternary(of: Ternary, [x, y, z]: [f64; 3]) -> f64 {
    match of {
        Ternary::IfNonzero => linkage_runtime::Real::if_nonzero(x, y, z),
        Ternary::InRange => rt::in_range(x, y, z),
    }
}

#[inline(always)]
pub(super) fn test(of: Test, x: f64, y: f64) -> bool {
    match of {
        Test::IsFinite => x.is_finite(),
        Test::IsModerate => lane::is_moderate(x),
        Test::IsSolvable => lane::is_solvable(x),
        Test::IsReachable => lane::is_reachable(x),
        Test::HasArctangent2 => lane::has_arctangent2(x, y),
        Test::HasHypotenuse => lane::has_hypotenuse(x, y),
        Test::IsNonzero => rt::is_nonzero(x, y),
        Test::Closes => rt::closes(x, y),
    }
}

#[inline(always)]
pub(super) fn chord(of: Chord, side: Elbow, numbers: &[f64]) -> (f64, bool) {
    match (of, numbers) {
        (Chord::Elbow, &[p, q, x, y, scale, reach_squared, distance_squared, low, high]) => {
            let (links, line, factors) = ([p, q], [x, y], [low, high]);
            lane::elbow_chord(Triangle { links, line, scale, reach_squared, distance_squared, factors }, side)
        }
        (Chord::Factors, &[low, high]) => lane::chord([low, high], side),
        (Chord::Reach, &[low, high, radius, scale]) => lane::reach_chord([low, high], radius, scale, side),
        _ => (f64::NAN, false),
    }
}
