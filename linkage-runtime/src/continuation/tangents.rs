//! The motions that cross at a change point.

use core::ops::Index;

/// Tangents that are told of one crossing: three groups that are flat at once with a motion each have 2^3, and seven in a
/// chain 7 + 1. Each takes the memory of the coordinates in every event.
pub(super) const MOST_TANGENTS: usize = 8;

/// Rates of the coordinates along the motions that cross at a change point: first along the one that was followed, in
/// its direction; then along the others, either way.
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

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.iter().count()
    }

    /// True if there are none, which no crossing has.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// True if these are all. There are more where a whole family of motions begins, as where the outer joints of a
    /// dyad coincide, so that it turns freely; and where more than eight motions cross. They are not sought where more
    /// than seven pivots of [J A] are zero, or where the quadratic equations of more than three coordinates do not split:
    /// then that which was followed stands alone.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }
}

/// The tangent at a place below [`len`](Tangents::len): 0 is the motion that was followed.
impl<R> Index<usize> for Tangents<R> {
    type Output = R;

    fn index(&self, place: usize) -> &R {
        match &self.rates[place] {
            Some(rates) => rates,
            None => panic!("there is no tangent {place}"),
        }
    }
}
