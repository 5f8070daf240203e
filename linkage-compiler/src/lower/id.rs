//! Values by id.

use crate::ids::Id;

/// A value of lowered code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ValueId(pub(super) usize);

/// A value or its negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Signed {
    pub negative: bool,
    pub value: ValueId,
}

impl Id for ValueId {
    fn new(index: usize) -> Self {
        Self(index)
    }

    fn index(self) -> usize {
        self.0
    }
}

impl Signed {
    pub fn positive(value: ValueId) -> Self {
        Self { negative: false, value }
    }
}
