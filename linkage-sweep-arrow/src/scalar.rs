//! Scalars that Arrow has.

use arrow_array::ArrowPrimitiveType;
use arrow_array::types::{Float32Type, Float64Type};
use arrow_buffer::ArrowNativeType;
use linkage_runtime::Real;

/// A scalar of mechanisms with a type of Arrow: `f64` is `Float64`, and `f32` is `Float32`.
pub trait Scalar: Real + ArrowNativeType {
    /// The type of Arrow.
    type Arrow: ArrowPrimitiveType<Native = Self>;
}

impl Scalar for f64 {
    type Arrow = Float64Type;
}

impl Scalar for f32 {
    type Arrow = Float32Type;
}
