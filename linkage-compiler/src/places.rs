//! Where equal items are found again in the list that holds each once.
//!
//! A table with open addressing and linear probing, whose hash is a few multiplications: macros run
//! unoptimised, where a general map spends most of its time on calls of its own.

/// A hash of the words that an item is made of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hash(u64);

impl Hash {
    /// The golden ratio as a fraction of 2^64 (D. E. Knuth, "The Art of Computer Programming" 3, 6.4).
    const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;

    pub(crate) fn of(kind: u64) -> Self {
        Self(kind.wrapping_mul(Self::FACTOR))
    }

    pub(crate) fn of_text(text: &str) -> Self {
        let mut hash = Self::of(text.len() as u64);
        let mut rest = text.as_bytes();
        while let Some((word, after)) = rest.split_first_chunk::<8>() {
            hash = hash.with(u64::from_le_bytes(*word));
            rest = after;
        }
        let mut last = [0; 8];
        last[..rest.len()].copy_from_slice(rest);
        hash.with(u64::from_le_bytes(last))
    }

    #[must_use]
    pub(crate) fn with(self, word: u64) -> Self {
        // High bits come down, so that the next product spreads them.
        Self((self.0 ^ (self.0 >> 32) ^ word).wrapping_mul(Self::FACTOR))
    }
}

/// The places of items by their hashes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Places {
    /// The high half of a hash and the place, counted from one.
    slots: Box<[(u32, u32)]>,
    count: usize,
}

impl Places {
    /// The place of the item with this hash that `is` the one.
    pub(crate) fn find(&self, hash: Hash, mut is: impl FnMut(usize) -> bool) -> Option<usize> {
        if self.slots.is_empty() {
            return None;
        }
        let (mask, high) = (self.slots.len() - 1, (hash.0 >> 32) as u32);
        let mut slot = high as usize & mask;
        loop {
            let (found, place) = self.slots[slot];
            if place == 0 {
                return None;
            }
            if found == high && is(place as usize - 1) {
                return Some(place as usize - 1);
            }
            slot = (slot + 1) & mask;
        }
    }

    /// Adds an item that has not been found.
    pub(crate) fn insert(&mut self, hash: Hash, place: usize) {
        const FEWEST: usize = 64;
        // At most two thirds are full, so that a search ends soon.
        if self.slots.len() < FEWEST || 3 * self.count >= 2 * self.slots.len() {
            let larger = vec![(0, 0); FEWEST.max(2 * self.slots.len())].into_boxed_slice();
            for &(high, place) in &std::mem::replace(&mut self.slots, larger) {
                if place != 0 {
                    self.put(high, place);
                }
            }
        }
        self.count += 1;
        self.put((hash.0 >> 32) as u32, u32::try_from(place + 1).unwrap_or(u32::MAX));
    }

    fn put(&mut self, high: u32, place: u32) {
        let mask = self.slots.len() - 1;
        let mut slot = high as usize & mask;
        while self.slots[slot].1 != 0 {
            slot = (slot + 1) & mask;
        }
        self.slots[slot] = (high, place);
    }
}
