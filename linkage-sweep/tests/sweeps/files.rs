//! CSV: digits that read back, and files that appear complete or not at all.

use std::fs;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use crate::common::{bits, crank, go_on, sweep};
use linkage_sweep::{Column, Plan, Sweep, SweepError, found, given};

type Crank = crate::common::Crank<f64>;

/// The names in a folder.
fn names(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}

/// The numbers of a column of CSV.
fn read(text: &str, column: usize) -> Vec<f64> {
    text.lines().skip(1).map(|line| line.split(',').nth(column).unwrap().parse().unwrap()).collect()
}

#[test]
fn numbers_read_back_to_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("all.csv");
    let columns = [given("r"), given("l"), given("theta"), found("s"), found("s rate")];
    for (rows, threads) in [(10_000, 1), (33, 3)] {
        let sweep = sweep::<f64>().with_rows_per_chunk(rows).unwrap().with_threads(threads).unwrap();
        // The second file replaces the first one.
        sweep.write_csv(&path, &columns, go_on).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(text.lines().count(), 2185);
        assert_eq!(text.lines().next(), Some("r,l,theta,s,s rate,accepted"));
        let chunk = sweep.clone().with_rows_per_chunk(usize::MAX).unwrap().chunk(0, &columns).unwrap();
        for (index, (_, name, values)) in chunk.columns().enumerate() {
            assert_eq!(bits(&read(&text, index)), bits(values), "{name}");
        }
        let mask = text.lines().skip(1).map(|line| line.rsplit(',').next().unwrap().parse::<bool>().unwrap());
        assert!(mask.eq(chunk.accepted().iter().copied()));
        assert_eq!(names(folder.path()), [path.as_path()]);
    }
}

#[test]
fn names_in_a_header_are_unique_and_quoted() {
    let mut text = Vec::new();
    let sweep = Sweep::new(&crank::<f64>(), (), Plan::new().turn("theta", 1)).unwrap();
    sweep.write_csv_to(&mut text, &Column::all::<Crank>(), go_on).unwrap();
    let header = "r,l,e,given theta,given theta rate,given theta acceleration,theta,s,theta rate,s rate,\
                  theta acceleration,s acceleration,\"lean, \"\"y / q\"\"\",accepted\n";
    assert!(text.starts_with(header.as_bytes()), "{}", String::from_utf8_lossy(&text));
}

#[test]
fn a_cancelled_file_does_not_appear() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("some.csv");
    let sweep = sweep::<f64>().with_rows_per_chunk(100).unwrap();
    let cancel = |number| {
        move |progress: linkage_sweep::Progress| match progress.chunks_done == number {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    for number in [1, 3, 22] {
        let rows = (100 * number).min(2184);
        let result = sweep.write_csv(&path, &[found("s")], cancel(number));
        assert!(matches!(result, Err(SweepError::Cancelled { rows_done, rows: 2184 }) if rows_done == rows));
        assert!(names(folder.path()).is_empty());
    }
    fs::write(&path, "older").unwrap();
    sweep.write_csv(&path, &[found("s")], cancel(2)).unwrap_err();
    assert_eq!(fs::read_to_string(&path).unwrap(), "older");
    assert_eq!(names(folder.path()), [path]);
}

#[test]
fn a_panic_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("some.csv");
    let write = || sweep::<f64>().write_csv(&path, &[], |_| panic!("planned"));
    assert!(std::panic::catch_unwind(write).is_err());
    assert!(names(folder.path()).is_empty());
}

#[test]
fn folders_that_cannot_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    // There is no such folder, and a file is none.
    for path in [folder.path().join("none/a.csv"), file.join("a.csv")] {
        let error = sweep::<f64>().write_csv(&path, &[], go_on).unwrap_err();
        let folder = path.parent().unwrap();
        assert!(matches!(&error, SweepError::Io { path: Some(path), .. } if path == folder), "{error:?}");
        assert!(error.to_string().starts_with(&format!("cannot create a file in {}: ", folder.display())));
    }
    // A kernel's file system, in which not even an administrator makes files.
    if Path::new("/proc/version").exists() {
        let error = sweep::<f64>().write_csv("/proc/a.csv", &[], go_on).unwrap_err();
        assert!(matches!(error, SweepError::Io { path: Some(_), .. }), "{error:?}");
    }
    let error = sweep::<f64>().write_csv(folder.path(), &[], go_on).unwrap_err();
    assert!(matches!(&error, SweepError::NotAFile { path } if path == folder.path()));
    assert_eq!(names(folder.path()), [file]);
}

#[cfg(unix)]
#[test]
fn a_device_is_not_replaced() {
    // By a link, which a wrong renaming would replace instead of the device.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("device");
    std::os::unix::fs::symlink("/dev/null", &path).unwrap();
    let error = sweep::<f64>().write_csv(&path, &[], go_on).unwrap_err();
    assert!(matches!(error, SweepError::NotAFile { .. }));
    assert!(path.is_symlink());
}

/// A link stays a link, and the file that it leads to is replaced: in its own folder, also if it is not there yet.
#[cfg(unix)]
#[test]
fn a_symbolic_link_keeps_its_target() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let (links, files) = (folder.path().join("links"), folder.path().join("files"));
    fs::create_dir(&links).unwrap();
    fs::create_dir(&files).unwrap();
    let [one, two, first, second, absolute] =
        ["one", "two", "first", "second", "absolute"].map(|name| links.join(name));
    fs::write(files.join("there.csv"), "older").unwrap();
    symlink("../files/there.csv", &one).unwrap();
    symlink("../files/new.csv", &two).unwrap();
    symlink("second", &first).unwrap();
    symlink("one", &second).unwrap();
    symlink(files.join("other.csv"), &absolute).unwrap();
    for (link, file) in [(&one, "there.csv"), (&two, "new.csv"), (&first, "there.csv"), (&absolute, "other.csv")] {
        for rows in [5, 7] {
            let plan = Plan::new().turn("theta", rows);
            let sweep = Sweep::new(&crank::<f64>(), (), plan).unwrap();
            sweep.write_csv(link, &[found("s")], go_on).unwrap();
            assert!(link.is_symlink() && fs::symlink_metadata(files.join(file)).unwrap().is_file());
            assert_eq!(fs::read_to_string(files.join(file)).unwrap().lines().count() as u64, rows + 1);
        }
    }
    // Nothing else is in the folders: neither a temporary file nor a link that became a file.
    assert_eq!((names(&links).len(), names(&files).len()), (5, 3));
    // Around in a circle, and into a folder that is not there.
    let [circle, nowhere] = ["circle", "nowhere"].map(|name| links.join(name));
    symlink("circle", &circle).unwrap();
    symlink("../none/a.csv", &nowhere).unwrap();
    for link in [circle, nowhere] {
        let error = sweep::<f64>().write_csv(&link, &[], go_on).unwrap_err();
        assert!(matches!(error, SweepError::Io { path: Some(_), .. }), "{error:?}");
        assert!(link.is_symlink());
    }
}

#[test]
fn a_full_disk_is_an_error() {
    if let Ok(full) = fs::OpenOptions::new().write(true).open("/dev/full") {
        // It fails in the header, in the rows, and at the end.
        for bytes in [0, 8192, 1 << 20] {
            let writer = io::BufWriter::with_capacity(bytes, &full);
            let error = sweep::<f64>().write_csv_to(writer, &[found("s")], go_on).unwrap_err();
            let is_full = |source: &io::Error| source.kind() == io::ErrorKind::StorageFull;
            assert!(matches!(&error, SweepError::Io { path: None, source, .. } if is_full(source)), "{error:?}");
        }
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
    let sweep = sweep::<f64>().with_rows_per_chunk(100).unwrap();
    for (bytes, flushes) in [(0, true), (20_000, true), (usize::MAX, false)] {
        let result = sweep.write_csv_to(Small(bytes, flushes), &[found("s")], go_on);
        assert!(matches!(result, Err(SweepError::Io { path: None, .. })), "{result:?}");
    }
    sweep.write_csv_to(Small(usize::MAX, true), &[found("s")], go_on).unwrap();
}

#[test]
fn a_column_of_a_file_is_named_once() {
    let error = sweep::<f64>().write_csv_to(Vec::new(), &[found("s"), found(1)], go_on).unwrap_err();
    assert!(matches!(error, SweepError::Twice { .. }));
}

#[cfg(unix)]
#[test]
fn a_file_has_the_permissions_of_other_files() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let mode = |name: &str| fs::metadata(folder.path().join(name)).unwrap().permissions().mode();
    fs::write(folder.path().join("other"), "").unwrap();
    sweep::<f64>().write_csv(folder.path().join("a.csv"), &[], go_on).unwrap();
    assert_eq!(mode("a.csv"), mode("other"));
}
