//! What a simulation gives.

/// A moment of a motion: `Q` is the type of the coordinates by name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<T, Q> {
    /// The time.
    pub t: T,
    /// All coordinates by name: radians, and the unit of the lengths.
    pub q: Q,
    /// The rates of all coordinates by name.
    pub rate: Q,
    /// The number of the event that happens here, if there is one; the rates are those before it.
    pub event: Option<usize>,
}
