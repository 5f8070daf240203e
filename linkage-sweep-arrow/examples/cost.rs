//! Time and size of files: a sweep of a four-bar without a file, as record batches, as CSV and as Parquet.
//!
//! Run it with `--release`. The first argument is the number of designs, each with a turn of 360 positions.

use std::error::Error;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use linkage::{Elbow, linkage};
use linkage_sweep::{Column, Distribution, Plan, Sequence, Sweep, found, given};
use linkage_sweep_arrow::{Compression, Options, for_each_record_batch, write_parquet};

linkage! {
    /// Crank a, coupler b, rocker c, ground d.
    mechanism FourBar {
        param a = 40, b = 120, c = 80, d = 100;
        input theta2;
        unknown theta3, theta4;
        loop a@theta2 + b@theta3 = c@theta4 + d@0;
        point P = a@theta2 + (b/2, 30)@theta3;
        output mu = theta4 - theta3;
        derive lanes;
    }
}

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Writes a line, or returns the error that it cannot be written.
macro_rules! line {
    ($($text:tt)*) => { writeln!(io::stdout(), $($text)*)? };
}

/// Runs something three times and prints the least time per row, and the size of the file if there is one.
fn measure(name: &str, rows: u64, path: &Path, mut run: impl FnMut() -> Result<()>) -> Result<()> {
    let mut least = f64::INFINITY;
    for _ in 0..3 {
        let start = Instant::now();
        run()?;
        least = least.min(start.elapsed().as_secs_f64());
    }
    let size = fs::metadata(path).map_or(0, |metadata| metadata.len());
    let rows = rows as f64;
    line!("{name:<22} {:7.3} s {:8.2} million rows/s {:7.2} bytes/row", least, rows / least / 1e6, size as f64 / rows);
    if path.exists() {
        fs::remove_file(path)?;
    }
    Ok(())
}

fn main() -> Result<()> {
    match measured() {
        // The reader has gone, as `head` does.
        Err(error) if error.downcast_ref().is_some_and(|error: &io::Error| error.kind() == ErrorKind::BrokenPipe) => {
            Ok(())
        }
        measured => measured,
    }
}

fn measured() -> Result<()> {
    let designs = std::env::args().nth(1).map_or(Ok(5000), |text| text.parse())?;
    let lengths = ["a", "b", "c", "d"].into_iter().zip([40.0, 120.0, 80.0, 100.0]);
    let lengths = lengths.map(|(name, mean)| (name, Distribution::Normal { mean, deviation: 5.0 }));
    let plan = Plan::new().sample(lengths, designs, Sequence::Random).turn("theta2", 360).constant("theta2_rate", 1.0);
    let sweep = Sweep::new(&FourBar::<f64>::default(), FourBarBranch::new(Elbow::Left), plan)?;
    let rows = sweep.rows();
    let names = ["a", "b", "c", "d", "theta2"];
    let some: Vec<Column> = names.into_iter().map(given).chain(["theta3", "theta4", "mu"].map(found)).collect();
    let path = std::env::temp_dir().join(format!("cost-{}.parquet", std::process::id()));
    let go_on = |_| ControlFlow::Continue(());
    for (title, columns) in
        [("five given and three found columns", some), ("all columns", Column::all::<FourBar<f64>>())]
    {
        line!("{title} ({}), {rows} rows", columns.len());
        measure("chunks", rows, &path, || {
            Ok(sweep.for_each_chunk(&columns, go_on, |_| Ok::<(), linkage_sweep::SweepError>(()))?)
        })?;
        measure("record batches", rows, &path, || {
            Ok(for_each_record_batch(&sweep, &columns, go_on, |_| Ok::<(), linkage_sweep_arrow::Error>(()))?)
        })?;
        for compression in [Compression::Snappy, Compression::None] {
            let options = Options::default().with_compression(compression);
            measure(&format!("Parquet, {compression:?}"), rows, &path, || {
                Ok(write_parquet(&sweep, &path, &columns, &options, go_on)?)
            })?;
        }
        measure("CSV", rows, &path, || Ok(sweep.write_csv(&path, &columns, go_on)?))?;
    }
    Ok(())
}
