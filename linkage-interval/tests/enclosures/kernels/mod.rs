//! Proofs of the bounds of rounding errors of the runtime's sine, cosine and arctangent for `f64`.
//!
//! The kernels are run over intervals that cover their arguments, in an arithmetic that bounds each rounding error; the
//! errors of the polynomials are bounded in 200 bits; the errors of the reduction are those of every multiple of pi/2.

mod approximation;
mod arctangent;
mod reduction;
mod sine;
mod tracked;
