//! The inputs in a message.

use core::fmt::{self, Debug, Display, Formatter};

use super::Name;
use crate::shown::Shown;

/// The most inputs that an error has.
const MOST: usize = 3;

/// The values of the inputs at which something failed: of a mechanism with more than three those of the first three. None are
/// known where a function is not told the inputs.
#[derive(Clone, PartialEq)]
pub struct InputValues<N: Name = &'static str> {
    names: N::List,
    values: [f64; MOST],
    /// A bit for each input, one for an angle. An array of `bool` would also hold the tag of the error, which takes emitted
    /// code an instruction more.
    are_angles: u8,
}

impl<N: Name<List: Copy>> Copy for InputValues<N> {}

impl<N: Name> InputValues<N> {
    /// The inputs of a mechanism by name, each with a flag that is true for an angle, and the values of the first three.
    #[must_use]
    pub fn new(names: N::List, are_angles: &[bool], values: [f64; 3]) -> Self {
        let flags = are_angles.iter().take(MOST).rev();
        let are_angles = flags.fold(0, |bits, is_angle| (bits << 1) | u8::from(*is_angle));
        Self { names, values, are_angles }
    }

    /// The name of each input and its value; angles in radians.
    pub fn iter(&self) -> impl Iterator<Item = (N, f64)> {
        self.names.as_ref().iter().cloned().zip(self.values)
    }

    /// True if no input is known.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.names.as_ref().is_empty()
    }

    /// These inputs with the names of a list.
    #[must_use]
    pub fn with_names<M: Name>(self, names: M::List) -> InputValues<M> {
        let Self { values, are_angles, .. } = self;
        InputValues { names, values, are_angles }
    }

    /// These inputs with other names.
    #[must_use]
    pub fn map_names<M: Name<List: FromIterator<M>>>(self, f: impl FnMut(N) -> M) -> InputValues<M> {
        let Self { names, values, are_angles } = self;
        InputValues { names: names.as_ref().iter().cloned().map(f).collect(), values, are_angles }
    }
}

impl<N: Name> Default for InputValues<N> {
    fn default() -> Self {
        Self { names: N::List::default(), values: [0.0; MOST], are_angles: 0 }
    }
}

/// The inputs in one line, with angles in degrees: `theta = 60°, s = 0.25`; `this input` if none are known.
impl<N: Name> Display for InputValues<N> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("this input");
        }
        for (place, (name, value)) in self.iter().enumerate() {
            let is_angle = (self.are_angles >> place) & 1 == 1;
            f.write_str(if place == 0 { "" } else { ", " })?;
            write!(f, "{name} = ")?;
            Display::fmt(&Shown { value, is_angle }, f)?;
        }
        f.write_str(if self.names.as_ref().len() > MOST { ", …" } else { "" })
    }
}

impl<N: Name> Debug for InputValues<N> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.iter()).finish()
    }
}

/// A map from names to values.
#[cfg(feature = "serde")]
impl<N: Name + serde::Serialize> serde::Serialize for InputValues<N> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter())
    }
}
