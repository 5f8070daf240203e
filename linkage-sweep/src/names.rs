//! The names of columns in a file.

use linkage_runtime::lanes::Lanes;

use crate::column::places;
use crate::{Column, Place, SweepError};

/// The name of the last column: whether a row is accepted.
const ACCEPTED: &str = "accepted";

/// The names of these columns in a file, and that of the column `accepted`. A given column with the name of a found one
/// in the same file gets the prefix "given ".
///
/// # Errors
/// [`SweepError::Twice`], [`UnknownColumn`](SweepError::UnknownColumn) and
/// [`UnknownIndex`](SweepError::UnknownIndex).
pub fn names<M: Lanes>(columns: &[Column]) -> Result<Vec<String>, SweepError> {
    let places = places::<M>(columns)?;
    let is_found = |name| places.iter().any(|place| matches!(place, Place::Found(_)) && place.name::<M>() == name);
    let mut names: Vec<String> = Vec::with_capacity(places.len() + 1);
    let given = |place: Place| matches!(place, Place::Given(_)) && is_found(place.name::<M>());
    let all = places.iter().map(|&place| if given(place) { "given " } else { "" }.to_owned() + place.name::<M>());
    for name in all.chain([ACCEPTED.to_owned()]) {
        if names.contains(&name) {
            return Err(SweepError::Twice { column: name });
        }
        names.push(name);
    }
    Ok(names)
}
