//! Reading and writing; an unknown bound is written as none, since JSON has no infinity.

use crate::Rounded;

/// A number that has been read, not yet checked.
#[derive(serde::Serialize, serde::Deserialize)]
struct Parts {
    value: f64,
    error: Option<f64>,
}

impl serde::Serialize for Rounded {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let error = self.error.is_finite().then_some(self.error);
        Parts { value: self.value, error }.serialize(serializer)
    }
}

impl<'de> serde::Deserialize<'de> for Rounded {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Parts::deserialize(deserializer)? {
            Parts { value, error: None } => Ok(Self::unknown(value)),
            Parts { value, error: Some(error) } if error >= 0.0 => Ok(Self::with_error(value, error)),
            _ => Err(serde::de::Error::custom("`error` is negative or not a number")),
        }
    }
}
