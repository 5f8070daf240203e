//! Groups of unknowns.

/// Unknowns that are solved together once the groups before them are solved: an Assur group, for instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Group<'m, N = &'static str> {
    /// The unknowns by name, as in error messages.
    pub name: N,
    /// The constraints that determine them: rows of J.
    pub equations: &'m [usize],
    /// The unknowns: columns of J.
    pub unknowns: &'m [usize],
}
