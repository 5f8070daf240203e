//! Factorisations of small dense matrices of fixed size. Nothing is allocated.
//!
//! | matrix | method | used for |
//! |---|---|---|
//! | square | [`Lu`]: partial pivoting | J of a group |
//! | square, leading part | [`solve`]: partial pivoting, with a rank test; [`contraction`]: without exchanges | forces of bearings |
//! | symmetric, positive definite | [`Definite`]: L D L' without exchanges; [`Cholesky`] | mass matrices; normal equations |
//! | symmetric, of any rank | [`Ranked`]: L D L' with diagonal pivoting | held contacts |
//! | wide | [`reduce_rows`]: Gauss-Jordan elimination with given pivots | rates and motions with contacts at rest |
//!
//! They do not share their substitutions: the order of the operations differs, and with it the last bits. [`Lu`] multiplies
//! by reciprocals, the others divide.
//!
//! Three eliminations are elsewhere, since they are more than factorisations: [`Elimination`](crate::jacobian::Elimination)
//! finds the rank and the null spaces of [J A] and reuses an order of pivots; those of Dixon's determinant have complex entries
//! and bound their errors; the inverse in `linkage-interval` has a size known at run time only.

mod cholesky;
mod definite;
mod leading;
mod lu;
mod ranked;
mod rows;
#[cfg(test)]
mod tests;

pub use cholesky::Cholesky;
pub use definite::Definite;
pub use leading::{contraction, solve};
pub(crate) use lu::Lu;
pub use ranked::Ranked;
pub use rows::reduce_rows;
