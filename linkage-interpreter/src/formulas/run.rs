//! The numbers of a formula, operation for operation as emitted code computes them.

use linkage_ir::ElementaryFunction;
use linkage_runtime::Number;
use linkage_runtime::derivation::number_of;

use super::{Binary, Constant, Formula, Instruction, Register, Unary};

/// Numbers that are given to a formula, and how many it takes of them: those that are missing are unknown.
pub(crate) type Given<'g, N> = (&'g [N], usize);

/// The numbers of all registers.
pub(crate) struct Registers<N>(Vec<N>);

impl<N: Number> Registers<N> {
    /// The number of a register of the formula.
    pub(crate) fn at(&self, Register(place): Register) -> N {
        self.0[place as usize]
    }

    fn constant(constant: Constant) -> N {
        match constant {
            Constant::Zero => N::zero(),
            Constant::One => N::one(),
            Constant::Pi => N::pi(),
            Constant::Unknown => N::unknown(),
            Constant::Exactly(value) => N::exactly(value),
            Constant::Near(value) => N::near(value),
            Constant::Ratio(above, below) => N::ratio(above, below),
        }
    }

    /// A function with other arguments, which no checked formula has, has no known value.
    fn called(function: ElementaryFunction, arguments: &[N]) -> N {
        number_of(function, arguments).unwrap_or_else(N::unknown)
    }

    fn unary(function: Unary, of: N) -> N {
        match function {
            Unary::Negative => -of,
            Unary::Square => of.square(),
        }
    }

    fn binary(function: Binary, one: N, other: N) -> N {
        match function {
            Binary::Plus => one + other,
            Binary::Minus => one - other,
            Binary::Times => one * other,
            Binary::Over => one / other,
        }
    }
}

impl<R> Formula<R> {
    /// Runs the instructions on the given numbers.
    pub(crate) fn run<N: Number>(&self, given: &[Given<'_, N>]) -> Registers<N> {
        let count: usize = given.iter().map(|(_, count)| count).sum();
        // Each instruction writes one or two.
        let mut all = Registers(Vec::with_capacity(count + 2 * self.instructions.len()));
        for (numbers, count) in given {
            let numbers = numbers.iter().copied().chain(std::iter::repeat_with(N::unknown));
            all.0.extend(numbers.take(*count));
        }
        for instruction in &self.instructions {
            let number = match *instruction {
                Instruction::Constant(constant) => Registers::constant(constant),
                Instruction::Unary(function, of) => Registers::unary(function, all.at(of)),
                Instruction::Binary(function, one, other) => Registers::binary(function, all.at(one), all.at(other)),
                Instruction::Of(function, of) => Registers::called(function, &[all.at(of)]),
                Instruction::OfTwo(function, one, other) => Registers::called(function, &[all.at(one), all.at(other)]),
                Instruction::SineCosine(of) => {
                    let (sine, cosine) = all.at(of).sine_cosine();
                    all.0.push(sine);
                    cosine
                }
            };
            all.0.push(number);
        }
        all
    }
}
