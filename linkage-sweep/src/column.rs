//! Columns by name or index.

use linkage_runtime::lanes::Lanes;

use crate::SweepError;

/// A column asked for. A given and a found column may have the same name.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Column {
    /// A given column.
    Given(Key),
    /// A found column.
    Found(Key),
}

/// The name or index of a column.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Key {
    /// The name.
    Name(String),
    /// The index.
    Index(usize),
}

impl From<&str> for Key {
    fn from(name: &str) -> Self {
        Self::Name(name.to_owned())
    }
}

impl From<String> for Key {
    fn from(name: String) -> Self {
        Self::Name(name)
    }
}

impl From<usize> for Key {
    fn from(index: usize) -> Self {
        Self::Index(index)
    }
}

/// The given column of this name, or of this index in [`Lanes::GIVEN`].
pub fn given(key: impl Into<Key>) -> Column {
    Column::Given(key.into())
}

/// The found column of this name, or of this index in [`Lanes::FOUND`].
pub fn found(key: impl Into<Key>) -> Column {
    Column::Found(key.into())
}

/// The place of a column of a mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Place {
    /// The index in [`Lanes::GIVEN`].
    Given(usize),
    /// The index in [`Lanes::FOUND`].
    Found(usize),
}

impl Place {
    /// The name of the column.
    #[must_use]
    pub fn name<M: Lanes>(self) -> &'static str {
        let name = match self {
            Self::Given(index) => M::GIVEN.get(index),
            Self::Found(index) => M::FOUND.get(index),
        };
        name.copied().unwrap_or_default()
    }
}

impl Column {
    /// All columns of a mechanism, the given ones first.
    #[must_use]
    pub fn all<M: Lanes>() -> Vec<Self> {
        (0..M::GIVEN.len()).map(given).chain((0..M::FOUND.len()).map(found)).collect()
    }

    /// Finds the column.
    ///
    /// # Errors
    /// [`SweepError::UnknownColumn`] and [`SweepError::UnknownIndex`].
    pub fn place<M: Lanes>(&self) -> Result<Place, SweepError> {
        let (key, kind, names): (_, _, &'static [&'static str]) = match self {
            Self::Given(key) => (key, "given", M::GIVEN),
            Self::Found(key) => (key, "found", M::FOUND),
        };
        let index = match key {
            Key::Name(name) => index::<M>(name, kind, names)?,
            Key::Index(index) if *index < names.len() => *index,
            &Key::Index(index) => {
                return Err(SweepError::UnknownIndex { mechanism: M::NAME, kind, index, count: names.len() });
            }
        };
        Ok(match self {
            Self::Given(_) => Place::Given(index),
            Self::Found(_) => Place::Found(index),
        })
    }
}

/// The places of columns, each of which is asked for once.
pub(crate) fn places<M: Lanes>(columns: &[Column]) -> Result<Vec<Place>, SweepError> {
    let mut places = Vec::with_capacity(columns.len());
    for column in columns {
        let place = column.place::<M>()?;
        if places.contains(&place) {
            return Err(SweepError::Twice { column: place.name::<M>().to_owned() });
        }
        places.push(place);
    }
    Ok(places)
}

/// The index of a name.
pub(crate) fn index<M: Lanes>(
    name: &str,
    kind: &'static str,
    names: &'static [&'static str],
) -> Result<usize, SweepError> {
    names.iter().position(|candidate| *candidate == name).ok_or_else(|| SweepError::UnknownColumn {
        mechanism: M::NAME,
        kind,
        column: name.to_owned(),
        nearest: nearest(name, names),
    })
}

/// The candidate with the smallest edit distance to `name`, up to half of its letters and 3.
fn nearest(name: &str, candidates: &'static [&'static str]) -> Option<&'static str> {
    let limit = (name.chars().count() / 2).clamp(1, 3);
    let distance = |candidate: &str| match name.eq_ignore_ascii_case(candidate) {
        true => 0,
        false => strsim::osa_distance(name, candidate),
    };
    let distances = candidates.iter().map(|candidate| (distance(candidate), *candidate));
    let near = distances.filter(|(distance, _)| *distance <= limit);
    near.min_by_key(|(distance, _)| *distance).map(|(_, candidate)| candidate)
}
