//! The work of a function as operation counts.

/// Operation counts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Operations {
    pub multiplications: usize,
    pub additions: usize,
    pub divisions: usize,
    /// Roots among them; sine and cosine of one angle count as one, and so do a user function and its
    /// derivatives.
    pub functions: usize,
}

impl Operations {
    /// The sum of both.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            multiplications: self.multiplications + other.multiplications,
            additions: self.additions + other.additions,
            divisions: self.divisions + other.divisions,
            functions: self.functions + other.functions,
        }
    }

    /// True if no count is above that of `limit`.
    #[must_use]
    pub fn within(self, limit: Self) -> bool {
        self.multiplications <= limit.multiplications
            && self.additions <= limit.additions
            && self.divisions <= limit.divisions
            && self.functions <= limit.functions
    }
}

impl std::ops::AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        *self = self.plus(other);
    }
}
