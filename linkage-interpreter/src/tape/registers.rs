//! Operations that nothing needs are left out, and registers are used again after their last reading.

use super::Tape;
use super::instruction::{Instruction, Use};
use super::traced::{Flag, Recorder, Recording, Traced};

/// The tape of a recording, for these found columns.
pub(crate) fn recorded(of: &Recording, found: Vec<Traced>, accepted: Flag) -> Tape {
    let Recorder { instructions, numbers, flags, given, constants } = of.take();
    let (numbers, flags) = (numbers as usize, flags as usize);
    reused(Tape { instructions, numbers, flags, given, constants, found, accepted })
}

/// The tape without needless operations, on few registers.
fn reused(mut tape: Tape) -> Tape {
    let Tape { numbers, flags, .. } = tape;
    let mut needed = Needed { numbers: vec![false; numbers], flags: vec![false; flags] };
    for found in &tape.found {
        if let Traced::Register(_, register) = found {
            needed.numbers[*register as usize] = true;
        }
    }
    if let Flag::Register(_, register) = &tape.accepted {
        needed.flags[*register as usize] = true;
    }
    // A register of a result is read after all operations.
    let kept_numbers = needed.numbers.clone();
    let kept_flags = needed.flags.clone();
    let mut kept: Vec<Instruction> = Vec::new();
    for mut instruction in std::mem::take(&mut tape.instructions).into_iter().rev() {
        if needed.is_needed(&mut instruction) {
            needed.mark(&mut instruction);
            kept.push(instruction);
        }
    }
    kept.reverse();
    tape.given.retain(|(_, register)| needed.numbers[*register as usize]);
    tape.constants.retain(|(_, register)| needed.numbers[*register as usize]);
    let [mut places, mut of_flags] = [Places::new(kept_numbers), Places::new(kept_flags)];
    for (_, register) in &tape.given {
        places.fixed(*register);
    }
    for (_, register) in &tape.constants {
        places.fixed(*register);
    }
    for (place, instruction) in kept.iter_mut().enumerate() {
        instruction.each(&mut |of| match of {
            Use::Reads(register) => places.last_read(*register, place),
            Use::ReadsFlag(register) => of_flags.last_read(*register, place),
            Use::Writes(_) | Use::WritesFlag(_) => {}
        });
    }
    for (place, instruction) in kept.iter_mut().enumerate() {
        // What is written has another register than what is read.
        instruction.each(&mut |of| match of {
            Use::Writes(register) => *register = places.written(*register),
            Use::WritesFlag(register) => *register = of_flags.written(*register),
            Use::Reads(_) | Use::ReadsFlag(_) => {}
        });
        instruction.each(&mut |of| match of {
            Use::Reads(register) => *register = places.read(*register, place),
            Use::ReadsFlag(register) => *register = of_flags.read(*register, place),
            Use::Writes(_) | Use::WritesFlag(_) => {}
        });
        places.free(place);
        of_flags.free(place);
    }
    for (_, register) in &mut tape.given {
        *register = places.of(*register);
    }
    for (_, register) in &mut tape.constants {
        *register = places.of(*register);
    }
    for found in &mut tape.found {
        if let Traced::Register(_, register) = found {
            *register = places.of(*register);
        }
    }
    if let Flag::Register(_, register) = &mut tape.accepted {
        *register = of_flags.of(*register);
    }
    Tape { instructions: kept, numbers: places.count as usize, flags: of_flags.count as usize, ..tape }
}

/// The registers that are read later.
struct Needed {
    numbers: Vec<bool>,
    flags: Vec<bool>,
}

impl Needed {
    fn is_needed(&self, instruction: &mut Instruction) -> bool {
        let mut is_needed = false;
        instruction.each(&mut |of| match of {
            Use::Writes(register) => is_needed |= self.numbers[*register as usize],
            Use::WritesFlag(register) => is_needed |= self.flags[*register as usize],
            Use::Reads(_) | Use::ReadsFlag(_) => {}
        });
        is_needed
    }

    fn mark(&mut self, instruction: &mut Instruction) {
        instruction.each(&mut |of| match of {
            Use::Reads(register) => self.numbers[*register as usize] = true,
            Use::ReadsFlag(register) => self.flags[*register as usize] = true,
            Use::Writes(_) | Use::WritesFlag(_) => {}
        });
    }
}

/// The registers in place of those that were recorded, which are written once.
struct Places {
    /// True if it is read after all operations.
    is_kept: Vec<bool>,
    last: Vec<usize>,
    to: Vec<Option<u32>>,
    free: Vec<u32>,
    /// Those that are read for the last time now.
    ended: Vec<u32>,
    count: u32,
}

impl Places {
    fn new(is_kept: Vec<bool>) -> Self {
        let count = is_kept.len();
        Self { is_kept, last: vec![0; count], to: vec![None; count], free: Vec::new(), ended: Vec::new(), count: 0 }
    }

    /// A register that keeps its value from block to block.
    fn fixed(&mut self, register: u32) {
        self.is_kept[register as usize] = true;
        self.written(register);
    }

    fn last_read(&mut self, register: u32, place: usize) {
        self.last[register as usize] = place;
    }

    fn written(&mut self, register: u32) -> u32 {
        let to = self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.to[register as usize] = Some(to);
        to
    }

    fn read(&mut self, register: u32, place: usize) -> u32 {
        let to = self.of(register);
        let index = register as usize;
        if self.last[index] == place && !self.is_kept[index] && !self.ended.contains(&to) {
            self.ended.push(to);
        }
        to
    }

    /// Frees the registers that were read for the last time.
    fn free(&mut self, _: usize) {
        self.free.append(&mut self.ended);
    }

    fn of(&self, register: u32) -> u32 {
        self.to[register as usize].unwrap_or_default()
    }
}
