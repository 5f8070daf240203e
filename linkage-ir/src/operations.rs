//! Operation counts of functions.

/// The operation counts of a function.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Operations {
    /// Calls of elementary functions such as sine, and square roots. Sine and cosine of one angle count as one, and so do a
    /// user function and its derivatives.
    pub functions: usize,
    /// Divisions.
    pub divisions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Additions and subtractions.
    pub additions: usize,
}

impl Operations {
    /// The counts of functions, divisions, multiplications and additions.
    #[must_use]
    pub const fn new([functions, divisions, multiplications, additions]: [usize; 4]) -> Self {
        Self { functions, divisions, multiplications, additions }
    }

    /// Returns the sum of both.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            multiplications: self.multiplications + other.multiplications,
            additions: self.additions + other.additions,
            divisions: self.divisions + other.divisions,
            functions: self.functions + other.functions,
        }
    }

    /// Returns true if no count exceeds that of `limit`.
    #[must_use]
    pub fn within(self, limit: Self) -> bool {
        self.multiplications <= limit.multiplications
            && self.additions <= limit.additions
            && self.divisions <= limit.divisions
            && self.functions <= limit.functions
    }
}

impl core::ops::AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        *self = self.plus(other);
    }
}
