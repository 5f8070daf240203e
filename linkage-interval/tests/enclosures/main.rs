//! Intervals, elementary functions over them, boxes and certificates.

mod certify;
mod enclosure;
mod interval;
mod kernels;
