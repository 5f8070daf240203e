//! Several reducers at once.

use linkage_runtime::lanes::Lanes;

use super::Reducer;
use crate::{Block, Column, SweepError};

/// Implements the trait for a tuple.
macro_rules! tuple {
    ($($reducer:ident $index:tt),+) => {
        impl<M: Lanes, $($reducer: Reducer<M>),+> Reducer<M> for ($($reducer,)+) {
            type Part = ($($reducer::Part,)+);
            type Output = ($($reducer::Output,)+);

            fn columns(&self) -> Vec<Column> {
                [$(self.$index.columns()),+].concat()
            }

            fn start(&self) -> Result<Self::Part, SweepError> {
                Ok(($(self.$index.start()?,)+))
            }

            fn fold(&self, part: &mut Self::Part, block: &Block<'_, M>) {
                $(self.$index.fold(&mut part.$index, block);)+
            }

            fn merge(&self, part: &mut Self::Part, other: Self::Part) {
                $(self.$index.merge(&mut part.$index, other.$index);)+
            }

            fn finish(&self, part: Self::Part) -> Self::Output {
                ($(self.$index.finish(part.$index),)+)
            }
        }
    };
}

tuple!(A 0);
tuple!(A 0, B 1);
tuple!(A 0, B 1, C 2);
tuple!(A 0, B 1, C 2, D 3);
tuple!(A 0, B 1, C 2, D 3, E 4);
tuple!(A 0, B 1, C 2, D 3, E 4, F 5);
tuple!(A 0, B 1, C 2, D 3, E 4, F 5, G 6);
tuple!(A 0, B 1, C 2, D 3, E 4, F 5, G 6, H 7);

impl<M: Lanes, R: Reducer<M>> Reducer<M> for Vec<R> {
    type Part = Vec<R::Part>;
    type Output = Vec<R::Output>;

    fn columns(&self) -> Vec<Column> {
        self.iter().flat_map(Reducer::columns).collect()
    }

    fn start(&self) -> Result<Self::Part, SweepError> {
        self.iter().map(Reducer::start).collect()
    }

    fn fold(&self, part: &mut Self::Part, block: &Block<'_, M>) {
        self.iter().zip(part).for_each(|(reducer, part)| reducer.fold(part, block));
    }

    fn merge(&self, part: &mut Self::Part, other: Self::Part) {
        self.iter().zip(part.iter_mut().zip(other)).for_each(|(reducer, (part, other))| reducer.merge(part, other));
    }

    fn finish(&self, part: Self::Part) -> Self::Output {
        self.iter().zip(part).map(|(reducer, part)| reducer.finish(part)).collect()
    }
}
