//! Indices that functions and values are known by.

macro_rules! ids {
    ($($(#[$doc:meta])* $id:ident)*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $id(u32);

        impl $id {
            /// The id with this index.
            #[must_use]
            pub const fn new(index: usize) -> Self {
                Self(index as u32)
            }

            /// Its index.
            #[must_use]
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! {
    /// A value of a function; its operands have smaller ids.
    ValueId
    /// The place of a bound value in a call: `self`, also where a function takes none, the arguments, then what statements bind.
    Slot
    /// A function of a driver or of a scene.
    FunctionId
    /// A user function.
    ExternalId
    /// A name in the names of a program.
    Name
}
