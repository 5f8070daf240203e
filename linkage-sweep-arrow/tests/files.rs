//! Parquet: the bits, row groups, and files that appear complete or not at all.

mod common;

use std::fs::{self, File};
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::Path;

use common::{Bits, FourBar, FourBarBranch, ROWS, columns, compare, go_on, names, sweep};
use linkage_sweep::{Plan, Sweep, SweepError};
use linkage_sweep_arrow::arrow_array::RecordBatch;
use linkage_sweep_arrow::parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use linkage_sweep_arrow::{Compression, Error, MECHANISM, Options, SEED, schema, write_parquet, write_parquet_to};

/// The batches of a file, and the rows of its row groups.
fn read(path: &Path) -> (Vec<RecordBatch>, Vec<i64>) {
    let reader = ParquetRecordBatchReaderBuilder::try_new(File::open(path).unwrap()).unwrap();
    let groups = reader.metadata().row_groups().iter().map(|group| group.num_rows()).collect();
    (reader.build().unwrap().collect::<Result<_, _>>().unwrap(), groups)
}

/// The bytes of a file in memory.
fn bytes(sweep: &Sweep<FourBar<f64>>, options: &Options) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_parquet_to(sweep, &mut bytes, &columns(), options, go_on).unwrap();
    bytes
}

#[test]
fn numbers_read_back_to_the_same_bits() {
    fn check<T: Bits>() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("all.parquet");
        let options = [Options::default(), Options::default().with_compression(Compression::None)];
        for (options, rows) in options.into_iter().zip([100, 10_000]) {
            let sweep = sweep::<T>().with_rows_per_chunk(rows).unwrap();
            // The second file replaces the first one.
            write_parquet(&sweep, &path, &columns(), &options, go_on).unwrap();
            let (batches, groups) = read(&path);
            assert_eq!(groups, [ROWS as i64]);
            compare(&batches, &sweep, &columns());
            assert_eq!(names(folder.path()), [path.as_path()]);
        }
    }
    check::<f64>();
    check::<f32>();
}

#[test]
fn a_file_keeps_the_schema() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("all.parquet");
    write_parquet(&sweep::<f32>(), &path, &columns(), &Options::default(), go_on).unwrap();
    let reader = ParquetRecordBatchReaderBuilder::try_new(File::open(&path).unwrap()).unwrap();
    assert_eq!(**reader.schema(), *schema(&sweep::<f32>(), &columns()).unwrap());
    // Also for readers of Parquet without Arrow.
    let pairs = reader.metadata().file_metadata().key_value_metadata().unwrap();
    let value = |key| pairs.iter().find(|pair| pair.key == key).and_then(|pair| pair.value.as_deref());
    assert_eq!((value(MECHANISM), value(SEED)), (Some("FourBar"), Some("42")));
}

#[test]
fn small_chunks_are_gathered_and_large_ones_divided() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("all.parquet");
    for rows_per_chunk in [1, 100, 700, 10_000] {
        let sweep = sweep::<f64>().with_rows_per_chunk(rows_per_chunk).unwrap();
        let options = Options::default().with_rows_per_group(500).unwrap();
        write_parquet(&sweep, &path, &columns(), &options, go_on).unwrap();
        let (batches, groups) = read(&path);
        assert_eq!(groups, [500, 500, 500, 500, 184]);
        compare(&batches, &sweep, &columns());
    }
    // Each row is a group: no recursion is that deep.
    let plan = Plan::new().turn("theta2", 20_000);
    let sweep = Sweep::new(&FourBar::default(), FourBarBranch::new(linkage::Elbow::Left), plan).unwrap();
    let sweep = sweep.with_rows_per_chunk(20_000).unwrap();
    write_parquet(&sweep, &path, &[], &Options::default().with_rows_per_group(1).unwrap(), go_on).unwrap();
    assert_eq!(read(&path).1, vec![1; 20_000]);
    let error = Options::default().with_rows_per_group(0).unwrap_err();
    assert!(matches!(error, Error::Sweep(SweepError::Zero { .. })), "{error}");
}

#[test]
fn one_and_two_threads_write_the_same_bytes() {
    let options = Options::default().with_rows_per_group(500).unwrap();
    let one = bytes(&sweep::<f64>().with_threads(1).unwrap(), &options);
    for _ in 0..10 {
        assert!(one == bytes(&sweep::<f64>().with_threads(2).unwrap(), &options));
    }
}

#[test]
fn a_cancelled_file_does_not_appear() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("some.parquet");
    let options = Options::default().with_rows_per_group(150).unwrap();
    let cancel = |number| {
        move |progress: linkage_sweep::Progress| match progress.chunks_done == number {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    for number in [1, 3, 22] {
        let rows = (100 * number).min(2184);
        let result = write_parquet(&sweep::<f64>(), &path, &columns(), &options, cancel(number));
        let is_it = matches!(result, Err(Error::Sweep(SweepError::Cancelled { rows_done, .. })) if rows_done == rows);
        assert!(is_it, "{result:?}");
        assert!(names(folder.path()).is_empty());
    }
    fs::write(&path, "older").unwrap();
    write_parquet(&sweep::<f64>(), &path, &columns(), &options, cancel(2)).unwrap_err();
    assert_eq!(fs::read_to_string(&path).unwrap(), "older");
    assert_eq!(names(folder.path()), [path]);
}

#[test]
fn a_panic_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("some.parquet");
    let write = || write_parquet(&sweep::<f64>(), &path, &[], &Options::default(), |_| panic!("planned"));
    assert!(std::panic::catch_unwind(write).is_err());
    assert!(names(folder.path()).is_empty());
}

#[test]
fn folders_that_cannot_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let write = |path: &Path| write_parquet(&sweep::<f64>(), path, &columns(), &Options::default(), go_on).unwrap_err();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    // There is no such folder, and a file is none.
    for path in [folder.path().join("none/a.parquet"), file.join("a.parquet")] {
        let error = write(&path);
        let folder = path.parent().unwrap();
        assert!(matches!(&error, Error::Io { path: Some(path), .. } if path == folder), "{error:?}");
        assert!(error.to_string().starts_with(&format!("cannot create a file in {}: ", folder.display())));
    }
    // A kernel's file system, in which not even an administrator makes files.
    if Path::new("/proc/version").exists() {
        let error = write(Path::new("/proc/a.parquet"));
        assert!(matches!(error, Error::Io { path: Some(_), .. }), "{error:?}");
    }
    let error = write(folder.path());
    assert!(matches!(&error, Error::Sweep(SweepError::NotAFile { path }) if path == folder.path()));
    assert_eq!(names(folder.path()), [file]);
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_an_error() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("full.parquet");
    std::os::unix::fs::symlink("/dev/full", &path).unwrap();
    // A file does not replace a device.
    let options = Options::default().with_rows_per_group(500).unwrap();
    let error = write_parquet(&sweep::<f64>(), &path, &columns(), &options, go_on).unwrap_err();
    assert!(matches!(error, Error::Sweep(SweepError::NotAFile { .. })), "{error:?}");
    assert!(path.is_symlink());
    // It fails at the beginning, in a row group, and at the end.
    for bytes in [0, 8192, 1 << 20] {
        let file = fs::OpenOptions::new().write(true).open(&path).unwrap();
        let writer = io::BufWriter::with_capacity(bytes, file);
        let error = write_parquet_to(&sweep::<f64>(), writer, &columns(), &options, go_on).unwrap_err();
        let is_full = |source: &io::Error| source.kind() == io::ErrorKind::StorageFull;
        assert!(matches!(&error, Error::Io { path: None, source, .. } if is_full(source)), "{error:?}");
    }
}

#[test]
fn a_writer_that_fails_late_is_an_error() {
    /// Takes a number of bytes; its buffer is lost when it is flushed.
    struct Small(usize, bool);
    impl Write for Small {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let count = self.0.min(bytes.len());
            self.0 -= count;
            if count == 0 { Err(io::ErrorKind::StorageFull.into()) } else { Ok(count) }
        }
        fn flush(&mut self) -> io::Result<()> {
            if self.1 { Ok(()) } else { Err(io::ErrorKind::BrokenPipe.into()) }
        }
    }
    let options = Options::default().with_rows_per_group(500).unwrap();
    let length = bytes(&sweep::<f64>(), &options).len();
    let write = |small| write_parquet_to(&sweep::<f64>(), small, &columns(), &options, go_on);
    // Each boundary between two calls of the writer is among them.
    for bytes in (0..length).step_by(997).chain([length - 1]) {
        let result = write(Small(bytes, true));
        assert!(matches!(result, Err(Error::Io { path: None, .. })), "{bytes}: {result:?}");
    }
    let result = write(Small(usize::MAX, false));
    assert!(matches!(result, Err(Error::Io { path: None, .. })), "{result:?}");
    write(Small(length, true)).unwrap();
}
