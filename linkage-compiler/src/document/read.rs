//! Tables that are written and read: lists of nodes, which are checked when they are read.

use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::{Serialize, Serializer};

use super::table::{Node, Table};

impl Serialize for Table {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.nodes())
    }
}

/// An error for a formula that refers to one that is not before it, and for one that is longer or deeper than any that the
/// compiler makes.
impl<'de> Deserialize<'de> for Table {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let nodes = Vec::<Node>::deserialize(deserializer)?;
        Self::of(nodes)
            .ok_or_else(|| D::Error::custom("a formula refers to one that is not before it, or is too large"))
    }
}
