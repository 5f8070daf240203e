//! A door that closes, latches, bounces and rests.

pub mod closing;
pub mod machine;
