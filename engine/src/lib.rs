//! Sweeps of planar linkages as SQL tables.
