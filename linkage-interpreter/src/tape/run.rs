//! Running a tape on blocks of lanes.

use super::Tape;
use super::instruction::{Binary, Chord, Instruction, Ternary, Test, Unary};
use super::traced::{Flag, Traced, binary, chord, ternary, test, unary};

/// The registers of a tape, for a number of lanes.
#[derive(Debug)]
pub(crate) struct Block<const LANES: usize> {
    tape: Tape,
    registers: Registers<LANES>,
}

#[derive(Debug)]
struct Registers<const LANES: usize> {
    numbers: Vec<[f64; LANES]>,
    flags: Vec<[bool; LANES]>,
}

impl<const LANES: usize> Block<LANES> {
    pub(crate) fn new(tape: Tape) -> Self {
        let mut numbers = vec![[0.0; LANES]; tape.numbers];
        for (value, register) in &tape.constants {
            numbers[*register as usize] = [*value; LANES];
        }
        let registers = Registers { numbers, flags: vec![[false; LANES]; tape.flags] };
        Self { tape, registers }
    }

    /// Computes a block from these numbers of the given columns.
    pub(crate) fn run(&mut self, given: impl Fn(usize, &mut [f64; LANES])) {
        for (column, register) in &self.tape.given {
            given(*column, &mut self.registers.numbers[*register as usize]);
        }
        for instruction in &self.tape.instructions {
            self.registers.step(instruction);
        }
    }

    /// The numbers of a wanted column.
    pub(crate) fn found(&self, place: usize) -> [f64; LANES] {
        match self.tape.found.get(place) {
            Some(Traced::Register(_, register)) => self.registers.numbers[*register as usize],
            Some(Traced::Constant(value)) => [*value; LANES],
            None => [f64::NAN; LANES],
        }
    }

    /// True in the lanes whose results are right.
    pub(crate) fn accepted(&self) -> [bool; LANES] {
        match &self.tape.accepted {
            Flag::Register(_, register) => self.registers.flags[*register as usize],
            Flag::Constant(flag) => [*flag; LANES],
        }
    }
}

impl<const LANES: usize> Registers<LANES> {
    fn step(&mut self, instruction: &Instruction) {
        match *instruction {
            // One loop for each function, which the compiler vectorises.
            Instruction::Unary(of, to, from) => match of {
                Unary::Negative => self.one(to, from, |x| unary(Unary::Negative, x)),
                Unary::Sqrt => self.one(to, from, |x| unary(Unary::Sqrt, x)),
                Unary::Abs => self.one(to, from, |x| unary(Unary::Abs, x)),
                Unary::Sine => self.one(to, from, |x| unary(Unary::Sine, x)),
                Unary::Cosine => self.one(to, from, |x| unary(Unary::Cosine, x)),
                Unary::Turned(turns) => self.one(to, from, |x| unary(Unary::Turned(turns), x)),
            },
            Instruction::Binary(of, to, from) => match of {
                Binary::Plus => self.two(to, from, |x, y| binary(Binary::Plus, x, y)),
                Binary::Minus => self.two(to, from, |x, y| binary(Binary::Minus, x, y)),
                Binary::Times => self.two(to, from, |x, y| binary(Binary::Times, x, y)),
                Binary::Over => self.two(to, from, |x, y| binary(Binary::Over, x, y)),
                Binary::Arctangent2 => self.two(to, from, |x, y| binary(Binary::Arctangent2, x, y)),
                Binary::Hypotenuse => self.two(to, from, |x, y| binary(Binary::Hypotenuse, x, y)),
                Binary::NearestTurn => self.two(to, from, |x, y| binary(Binary::NearestTurn, x, y)),
            },
            Instruction::Ternary(of, to, from) => {
                let [x, y, z] = from.map(|from| self.numbers[from as usize]);
                let to = &mut self.numbers[to as usize];
                match of {
                    Ternary::IfNonzero => {
                        (0..LANES).for_each(|i| to[i] = ternary(Ternary::IfNonzero, [x[i], y[i], z[i]]))
                    }
                    Ternary::InRange => (0..LANES).for_each(|i| to[i] = ternary(Ternary::InRange, [x[i], y[i], z[i]])),
                }
            }
            Instruction::SineCosine([sine, cosine], from) => {
                let registers = [sine, cosine, from].map(|register| register as usize);
                if let Ok([sine, cosine, from]) = self.numbers.get_disjoint_mut(registers) {
                    for i in 0..LANES {
                        (sine[i], cosine[i]) = linkage_runtime::__rt::lane::sine_cosine(from[i]);
                    }
                }
            }
            Instruction::Chord(of, side, to, ref from) => match of {
                Chord::Elbow => self.chord::<9>(to, from, |numbers| chord(Chord::Elbow, side, &numbers)),
                Chord::Factors => self.chord::<2>(to, from, |numbers| chord(Chord::Factors, side, &numbers)),
                Chord::Reach => self.chord::<4>(to, from, |numbers| chord(Chord::Reach, side, &numbers)),
            },
            Instruction::Test(of, flag, from) => {
                let [x, y] = from.map(|from| &self.numbers[from as usize]);
                let flag = &mut self.flags[flag as usize];
                macro_rules! each {
                    ($($test:ident),*) => {
                        match of {
                            $(Test::$test => (0..LANES).for_each(|i| flag[i] = test(Test::$test, x[i], y[i])),)*
                        }
                    };
                }
                each!(IsFinite, IsModerate, IsSolvable, IsReachable, HasArctangent2, HasHypotenuse, IsNonzero, Closes);
            }
            Instruction::And(flag, from) => {
                let [x, y] = from.map(|from| self.flags[from as usize]);
                let flag = &mut self.flags[flag as usize];
                (0..LANES).for_each(|i| flag[i] = x[i] & y[i]);
            }
        }
    }

    #[inline(always)]
    fn chord<const N: usize>(&mut self, (to, flag): (u32, u32), from: &[u32], f: impl Fn([f64; N]) -> (f64, bool)) {
        let Some(from) = from.first_chunk::<N>() else { return };
        let numbers = from.map(|from| self.numbers[from as usize]);
        let (to, flag) = (&mut self.numbers[to as usize], &mut self.flags[flag as usize]);
        for i in 0..LANES {
            (to[i], flag[i]) = f(numbers.each_ref().map(|numbers| numbers[i]));
        }
    }

    #[inline(always)]
    fn one(&mut self, to: u32, from: u32, f: impl Fn(f64) -> f64) {
        if let Ok([to, from]) = self.numbers.get_disjoint_mut([to as usize, from as usize]) {
            to.iter_mut().zip(from).for_each(|(to, from)| *to = f(*from));
        }
    }

    #[inline(always)]
    fn two(&mut self, to: u32, [one, other]: [u32; 2], f: impl Fn(f64, f64) -> f64) {
        if one == other {
            return self.one(to, one, |x| f(x, x));
        }
        if let Ok([to, one, other]) = self.numbers.get_disjoint_mut([to as usize, one as usize, other as usize]) {
            to.iter_mut().zip(one).zip(other).for_each(|((to, one), other)| *to = f(*one, *other));
        }
    }
}
