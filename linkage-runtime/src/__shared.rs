//! What `linkage-dynamics` shares with this crate. Not part of the interface.

pub use crate::error::{all_finite, finite};
pub use crate::linear::{Factorization, product_of_pivots, same_signs};
pub use crate::newton::{Closures, search};
pub use crate::position::beside_columns;
pub use crate::scalar::{larger, largest, smallest, to_f64};
