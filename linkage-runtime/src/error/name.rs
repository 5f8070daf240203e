//! A name in an error.

use core::fmt::{Debug, Display};

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
