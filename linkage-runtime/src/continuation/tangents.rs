//! The tangents of the motions that cross at a change point.

use core::ops::Index;

#[cfg(feature = "serde")]
use serde::ser::SerializeStruct;

#[cfg(feature = "serde")]
use crate::serialised::Sequence;

/// The most tangents of one change point: three parallelograms side by side, singular at once, have 2^3, seven in a
/// chain 7 + 1. Every event takes the memory for this many sets of coordinates.
pub(super) const MOST_TANGENTS: usize = 8;

/// Rates of the coordinates along the motions that cross at a change point: first the followed motion, in its
/// direction, then the others, in either direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tangents<R> {
    rates: [Option<R>; MOST_TANGENTS],
    is_complete: bool,
}

impl<R: Copy> Tangents<R> {
    pub(super) fn new(rates: impl Iterator<Item = R>, is_complete: bool) -> Self {
        let mut rates = rates;
        Self { rates: core::array::from_fn(|_| rates.next()), is_complete }
    }

    /// The rates along each motion.
    pub fn iter(&self) -> impl Iterator<Item = &R> {
        self.rates.iter().flatten()
    }

    /// The number of motions.
    #[must_use]
    pub fn len(&self) -> usize {
        self.iter().count()
    }

    /// True if there are none, which never happens at a change point.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// True if these are all motions. There are more where a continuous family of motions begins, as where the outer
    /// joints of a dyad coincide and it turns freely, and where more than eight motions cross. They are not computed
    /// where more than seven pivots of [J A] are zero, or where the quadratic equations of more than three coordinates
    /// do not factor: then only the followed motion is certain to be returned.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }
}

/// The rates are written as a sequence of [`len`](Tangents::len) entries.
#[cfg(feature = "serde")]
impl<R: serde::Serialize> serde::Serialize for Tangents<R> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Tangents", 2)?;
        fields.serialize_field("rates", &Sequence(self.rates.iter().flatten()))?;
        fields.serialize_field("is_complete", &self.is_complete)?;
        fields.end()
    }
}

/// The tangent at an index below [`len`](Tangents::len); index 0 is the followed motion.
impl<R> Index<usize> for Tangents<R> {
    type Output = R;

    fn index(&self, place: usize) -> &R {
        match &self.rates[place] {
            Some(rates) => rates,
            None => panic!("the index of a tangent is {place}: it must be less than `len`"),
        }
    }
}
