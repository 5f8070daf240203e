//! The definition of records.

/// Structures with public fields, in every storage `S`: each field is copied, visited, written and read.
macro_rules! records {
    ($($(#[$doc:meta])* $Record:ident { $($(#[$of_field:meta])* $field:ident: $Type:ty,)+ })+) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq, Eq)]
        pub struct $Record<'a, S: Storage<'a>> {
            $($(#[$of_field])* pub $field: $Type,)+
        }

        impl<'a, F: $crate::document::Item + Copy + 'a> Copy for $Record<'a, $crate::document::Lent<F>> {}

        #[cfg(feature = "serde")]
        impl<'a, F> serde::Serialize for $Record<'a, $crate::document::Lent<F>>
        where
            F: $crate::document::Item + Copy + serde::Serialize + 'a,
        {
            record!(serialize $Record $($field)+);
        }

        #[cfg(feature = "code")]
        impl $crate::document::Part for $Record<'_, $crate::document::Kept> {
            type In<'a, S: Storage<'a>> = $Record<'a, S>;

            fn each(&mut self, visit: &mut dyn FnMut(&mut $crate::document::FormulaId)) {
                $($crate::document::Part::each(&mut self.$field, visit);)+
            }

            fn copied<'a, S, T>(&self, store: &T) -> Result<$Record<'a, S>, T::Error>
            where
                S: Storage<'a>,
                T: $crate::document::Store<'a, S>,
            {
                Ok($Record { $($field: $crate::document::Part::copied(&self.$field, store)?,)+ })
            }
        }

        #[cfg(all(feature = "code", feature = "serde"))]
        impl serde::Serialize for $Record<'_, $crate::document::Kept> {
            record!(serialize $Record $($field)+);
        }

        #[cfg(all(feature = "code", feature = "serde"))]
        impl<'de> serde::Deserialize<'de> for $Record<'_, $crate::document::Kept> {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                type S = $crate::document::Kept;

                #[derive(serde::Deserialize)]
                struct Fields<'a> {
                    $($field: $Type,)+
                }

                let Fields { $($field),+ } = Fields::deserialize(deserializer)?;
                Ok(Self { $($field),+ })
            }
        }
    )+};
}

#[cfg(feature = "serde")]
macro_rules! record {
    (serialize $Record:ident $($field:ident)+) => {
        fn serialize<W: serde::Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
            use serde::ser::SerializeStruct;

            let mut record = serializer.serialize_struct(stringify!($Record), [$(stringify!($field)),+].len())?;
            $(record.serialize_field(stringify!($field), &self.$field)?;)+
            record.end()
        }
    };
}
