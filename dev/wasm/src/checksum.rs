//! A checksum of texts.

use std::fmt::{self, Debug, Display, Formatter};

/// The results that were added, those without an error, and their checksum, FNV-1a.
pub struct Checksum {
    results: usize,
    values: usize,
    bits: u64,
}

impl Default for Checksum {
    fn default() -> Self {
        Self { results: 0, values: 0, bits: 0xcbf2_9ce4_8422_2325 }
    }
}

impl Checksum {
    pub fn add<V: Debug, E: Debug>(&mut self, result: &Result<V, E>) {
        let step = |bits: u64, byte: u8| (bits ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        self.bits = format!("{result:?}\n").bytes().fold(self.bits, step);
        self.results += 1;
        self.values += usize::from(result.is_ok());
    }
}

impl Display for Checksum {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}\t{}\t{:016x}", self.results, self.values, self.bits)
    }
}
