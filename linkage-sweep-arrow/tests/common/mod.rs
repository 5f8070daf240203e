//! A four-bar of two scalars, and a sweep of it in which some rows cannot be assembled.
#![allow(dead_code, reason = "compiled into each test file, which calls some of these functions")]

use std::fmt::Debug;
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use linkage::lanes::Lanes;
use linkage::nalgebra::ComplexField;
use linkage::{Elbow, Real, linkage, real};
use linkage_sweep::{Column, Distribution, Plan, Progress, Sequence, Sweep, found, given};
use linkage_sweep_arrow::Scalar;
use linkage_sweep_arrow::arrow_array::cast::AsArray;
use linkage_sweep_arrow::arrow_array::{Array, RecordBatch};

linkage! {
    /// Crank a, coupler b, rocker c, ground d.
    #[derive(Debug, Clone)]
    pub mechanism FourBar {
        param a = 40, b = 120, c = 80, d = 100;
        input theta2;
        unknown theta3, theta4;
        loop a@theta2 + b@theta3 = c@theta4 + d@0;
        point P = a@theta2 + (b/2, 30)@theta3;
        output mu = theta4 - theta3;
        output lift = sqrt(sin(theta4));
        derive lanes;
    }
}

pub const ROWS: usize = 7 * 13 * 24;

/// A sweep of 2184 rows in chunks of 100.
pub fn sweep<T: Real>() -> Sweep<FourBar<T>> {
    let lengths = [
        ("b", Distribution::Uniform { from: 60.0, to: 140.0 }),
        ("c", Distribution::Normal { mean: 80.0, deviation: 5.0 }),
    ];
    let design = FourBar { a: real(40.0), b: real(120.0), c: real(80.0), d: real(100.0) };
    let plan = Plan::new()
        .grid("a", 20.0, 110.0, 7)
        .sample(lengths, 13, Sequence::Random)
        .turn("theta2", 24)
        .constant("theta2_rate", 2.0)
        .seed(42);
    let sweep = Sweep::new(&design, FourBarBranch::new(Elbow::Left), plan).unwrap();
    sweep.with_rows_per_chunk(100).unwrap()
}

pub fn columns() -> Vec<Column> {
    vec![given("theta2"), found("theta4"), given("a"), given("d"), found("lift"), found("mu")]
}

pub fn go_on(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The names in a folder.
pub fn names(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}

/// The bits of a number.
pub trait Bits: Scalar {
    fn bits(self) -> u64;
}

impl Bits for f64 {
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

impl Bits for f32 {
    fn bits(self) -> u64 {
        self.to_bits().into()
    }
}

/// Compares batches with the chunk of all rows: the same bits, and null exactly where a row is rejected or a number does
/// not exist. Returns how many of these there are in accepted rows.
pub fn compare<M: Lanes>(batches: &[RecordBatch], sweep: &Sweep<M>, columns: &[Column]) -> usize
where
    M::Scalar: Bits + Debug,
    Sweep<M>: Clone,
{
    let chunk = sweep.clone().with_rows_per_chunk(usize::MAX).unwrap().chunk(0, columns).unwrap();
    assert!(chunk.rejected() > 100 && chunk.rejected() < chunk.rows() - 100, "{}", chunk.rejected());
    assert_eq!(batches.iter().map(RecordBatch::num_rows).sum::<usize>(), chunk.rows());
    let (mut row, mut missing) = (0, 0);
    for batch in batches {
        assert_eq!(batch.num_columns(), columns.len() + 1);
        let accepted = batch.column(columns.len()).as_boolean();
        assert_eq!(accepted.null_count(), 0);
        for line in 0..batch.num_rows() {
            assert_eq!(accepted.value(line), chunk.accepted()[row]);
            for ((place, name, values), array) in chunk.columns().zip(batch.columns()) {
                let array = array.as_primitive::<<M::Scalar as Scalar>::Arrow>();
                let is_found = matches!(place, linkage_sweep::Place::Found(_));
                let exists = values[row].is_finite();
                missing += usize::from(chunk.accepted()[row] && !exists);
                assert!(exists || is_found, "{name} of row {row}");
                assert!(!is_found || !exists || chunk.accepted()[row], "{name} of row {row}");
                assert_eq!(array.is_valid(line), exists, "{name} of row {row}");
                if array.is_valid(line) {
                    assert_eq!(array.value(line).bits(), values[row].bits(), "{name} of row {row}");
                }
            }
            row += 1;
        }
    }
    missing
}
