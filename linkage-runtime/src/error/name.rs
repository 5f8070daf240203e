//! A name in an error.

use core::fmt::{Debug, Display};

use crate::Group;

/// A name in an error, of a mechanism, a group or a quantity: `&str`, or with `std` a text that is owned.
///
/// Names in emitted code are `&'static str`. The names of a mechanism that is read while a program runs are not static: its
/// errors borrow them, and `map_names` of an error makes them owned.
///
/// ```
/// # #[cfg(feature = "std")] {
/// use std::sync::Arc;
/// use linkage_runtime::PositionError;
///
/// fn owned(error: PositionError<&str>) -> PositionError<Arc<str>> {
///     error.map_names(Arc::from)
/// }
/// let name = String::from("FourBar");
/// let error = owned(PositionError::TooManyBranches { mechanism: &*name });
/// drop(name);
/// assert!(error.to_string().starts_with("FourBar has too many branches"));
/// # }
/// ```
pub trait Name: Clone + Debug + Display + PartialEq {
    /// The names of the inputs of a mechanism.
    type List: Clone + Default + PartialEq + AsRef<[Self]>;

    /// A name that the library gives: `the position`.
    fn from_static(text: &'static str) -> Self;
}

/// A name that is borrowed, with the list of the groups of its mechanism: the names of mechanisms, where their algorithms run.
pub trait BorrowedName: Name<List: Copy> + Copy + AsRef<str> {
    /// The groups of a mechanism.
    type Groups: Copy;

    /// Groups with names that the emitted code gives.
    fn static_groups(groups: &'static [Group<'static>]) -> Self::Groups;
    /// The name of a group; none beyond the last.
    fn of_group(groups: Self::Groups, place: usize) -> Option<Self>;
}

impl<'a> BorrowedName for &'a str {
    type Groups = &'a [Group<'a, &'a str>];

    #[inline]
    fn static_groups(groups: &'static [Group<'static>]) -> Self::Groups {
        groups
    }

    #[inline]
    fn of_group(groups: Self::Groups, place: usize) -> Option<Self> {
        groups.get(place).map(|group| group.name)
    }
}

impl<'a> Name for &'a str {
    type List = &'a [&'a str];

    #[inline(always)]
    fn from_static(text: &'static str) -> Self {
        text
    }
}

#[cfg(feature = "std")]
impl Name for String {
    type List = Vec<Self>;

    fn from_static(text: &'static str) -> Self {
        text.into()
    }
}

#[cfg(feature = "std")]
impl Name for std::sync::Arc<str> {
    type List = std::sync::Arc<[Self]>;

    fn from_static(text: &'static str) -> Self {
        text.into()
    }
}
