//! Fuzz targets that libFuzzer guides by coverage:
//!
//! ```text
//! cargo +nightly fuzz run --sanitizer none expand -- -len_control=0 -max_total_time=600
//! cargo +nightly fuzz run --sanitizer none poses -- -len_control=0 -max_total_time=600
//! cargo +nightly fuzz run --sanitizer none texts -- -max_total_time=600
//! ```
//!
//! Without `-len_control=0` the fuzzer waits for many runs before it makes inputs longer than a few bytes.
//!
//! `expand` makes the mutants of `tests/mutants.rs`, `poses` the calls of `tests/input/invalid_numbers`, with the choices
//! made by the fuzzer instead of a seeded generator; `texts` compiles the bytes as they are. No crate here has unsafe code, so a sanitizer has nothing to look
//! for.

use rand::rngs::SmallRng;
use rand::{RngCore, SeedableRng};

/// A generator that returns the bytes chosen by a fuzzer, and pseudorandom ones after them: zeros would always choose
/// the first alternative.
pub struct Bytes {
    given: std::vec::IntoIter<u8>,
    after: SmallRng,
}

impl Bytes {
    #[must_use]
    pub fn new(given: &[u8]) -> Self {
        Self { given: given.to_vec().into_iter(), after: SmallRng::seed_from_u64(0) }
    }
}

/// Choices among a few alternatives use the leading bits, so half of the bytes suffice, and inputs are half as long.
impl RngCore for Bytes {
    fn next_u32(&mut self) -> u32 {
        let mut leading = [0; 2];
        self.fill_bytes(&mut leading);
        u32::from(u16::from_be_bytes(leading)) << 16
    }
    fn next_u64(&mut self) -> u64 {
        let mut leading = [0; 4];
        self.fill_bytes(&mut leading);
        u64::from(u32::from_be_bytes(leading)) << 32
    }
    fn fill_bytes(&mut self, bytes: &mut [u8]) {
        bytes.fill_with(|| self.given.next().unwrap_or_else(|| self.after.next_u32().to_be_bytes()[0]));
    }
}
