//! The inputs in a message.

use core::fmt::{self, Debug, Display, Formatter};

use crate::shown::Shown;

/// The most inputs that an error has.
const MOST: usize = 3;

/// The values of the inputs at which something failed: of a mechanism with more than three those of the first three. None are
/// known where a function is not told the inputs.
#[derive(Clone, Copy, PartialEq, Default)]
pub struct InputValues {
    names: &'static [&'static str],
    are_angles: &'static [bool],
    values: [f64; MOST],
}

impl InputValues {
    pub(crate) fn new(names: &'static [&'static str], are_angles: &'static [bool], values: [f64; 3]) -> Self {
        Self { names, are_angles, values }
    }

    /// The name of each input and its value; angles in radians.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, f64)> {
        self.names.iter().copied().zip(self.values)
    }

    /// True if no input is known.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }
}

/// The inputs in one line, with angles in degrees: `theta = 60°, s = 0.25`; `this input` if none are known.
impl Display for InputValues {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("this input");
        }
        for (place, ((name, value), &is_angle)) in self.iter().zip(self.are_angles).enumerate() {
            f.write_str(if place == 0 { "" } else { ", " })?;
            write!(f, "{name} = ")?;
            Display::fmt(&Shown { value, is_angle }, f)?;
        }
        f.write_str(if self.names.len() > MOST { ", …" } else { "" })
    }
}

impl Debug for InputValues {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.iter()).finish()
    }
}

/// A map from names to values.
#[cfg(feature = "serde")]
impl serde::Serialize for InputValues {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter())
    }
}
