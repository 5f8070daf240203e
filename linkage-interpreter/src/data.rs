//! Arguments and results of functions.

use std::fmt::{self, Formatter};
use std::sync::Arc;

use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A value by its parts: an argument or a result of a function of a mechanism at run time.
///
/// `serde` writes it as it is, fields as a map; a format from which it is read says the types of its values, as JSON does.
#[derive(Debug, Clone, PartialEq)]
pub enum Data {
    /// Nothing: the value of a function that only checks, or one that is absent.
    Nothing,
    /// True or false.
    Flag(bool),
    /// A number that counts: a turn, or the number of a position.
    Count(i64),
    /// A number.
    Number(f64),
    /// A word: a solution of a group, or the name of an effect.
    Text(Arc<str>),
    /// Values in order: a vector, a point as x and y, a direction as its cosine and its sine. A matrix is the list of its rows.
    List(Vec<Data>),
    /// Values by name, in the order of the fields of the emitted type.
    Fields(Vec<(Arc<str>, Data)>),
}

impl Data {
    /// The number.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Count(count) => Some(*count as f64),
            _ => None,
        }
    }

    /// A field, or the field of a field: `points.c.velocity`.
    #[must_use]
    pub fn get(&self, path: &str) -> Option<&Self> {
        path.split('.').try_fold(self, |of, name| match of {
            Self::Fields(fields) => fields.iter().find(|(field, _)| **field == *name).map(|(_, value)| value),
            Self::List(all) => match name {
                "x" | "re" => all.first(),
                "y" | "im" => all.get(1),
                index => all.get(index.parse::<usize>().ok()?),
            },
            _ => None,
        })
    }

    /// The values of a list.
    #[must_use]
    pub fn list(&self) -> &[Self] {
        match self {
            Self::List(all) => all,
            _ => &[],
        }
    }

    /// All numbers in it, in order.
    #[must_use]
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Self::List(all) => all.iter().flat_map(Self::numbers).collect(),
            Self::Fields(fields) => fields.iter().flat_map(|(_, value)| value.numbers()).collect(),
            other => other.number().into_iter().collect(),
        }
    }

    /// Values by name.
    #[must_use]
    pub fn fields<'n>(fields: impl IntoIterator<Item = (&'n str, Self)>) -> Self {
        Self::Fields(fields.into_iter().map(|(name, value)| (name.into(), value)).collect())
    }
}

impl From<f64> for Data {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Data {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl From<&[f64]> for Data {
    fn from(numbers: &[f64]) -> Self {
        Self::List(numbers.iter().copied().map(Self::Number).collect())
    }
}

impl Serialize for Data {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Nothing => serializer.serialize_none(),
            Self::Flag(flag) => serializer.serialize_bool(*flag),
            Self::Count(count) => serializer.serialize_i64(*count),
            Self::Number(number) => serializer.serialize_f64(*number),
            Self::Text(text) => serializer.serialize_str(text),
            Self::List(all) => serializer.collect_seq(all),
            Self::Fields(fields) => serializer.collect_map(fields.iter().map(|(name, value)| (name, value))),
        }
    }
}

impl<'de> Deserialize<'de> for Data {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Read)
    }
}

struct Read;

impl<'de> Visitor<'de> for Read {
    type Value = Data;

    fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("a number, a word, a list, or values by name")
    }

    fn visit_unit<E: Error>(self) -> Result<Data, E> {
        Ok(Data::Nothing)
    }

    fn visit_none<E: Error>(self) -> Result<Data, E> {
        Ok(Data::Nothing)
    }

    fn visit_bool<E: Error>(self, flag: bool) -> Result<Data, E> {
        Ok(Data::Flag(flag))
    }

    fn visit_i64<E: Error>(self, count: i64) -> Result<Data, E> {
        Ok(Data::Count(count))
    }

    fn visit_u64<E: Error>(self, count: u64) -> Result<Data, E> {
        Ok(i64::try_from(count).map_or(Data::Number(count as f64), Data::Count))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Data, E> {
        Ok(Data::Number(number))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Data, E> {
        Ok(Data::Text(text.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut all: A) -> Result<Data, A::Error> {
        let mut list = Vec::new();
        while let Some(value) = all.next_element()? {
            list.push(value);
        }
        Ok(Data::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut all: A) -> Result<Data, A::Error> {
        let mut fields = Vec::new();
        while let Some((name, value)) = all.next_entry::<String, Data>()? {
            fields.push((name.into(), value));
        }
        Ok(Data::Fields(fields))
    }
}
