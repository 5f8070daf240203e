//! Parquet files that appear complete or not at all.

mod common;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use common::{context, digest, expected, lines, mechanisms, planned, request, sweep, table};
use datafusion::arrow::array::RecordBatch;
use datafusion::parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use datafusion::physical_plan::execute_stream;
use datafusion::physical_plan::stream::RecordBatchStreamAdapter;
use datafusion::prelude::SessionContext;
use futures::StreamExt;
use linkage_engine::{EngineError, Request, write_parquet};

fn read(path: &Path) -> Vec<RecordBatch> {
    let reader = ParquetRecordBatchReaderBuilder::try_new(File::open(path).unwrap()).unwrap();
    reader.build().unwrap().collect::<Result<_, _>>().unwrap()
}

fn names(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}

async fn write(context: &SessionContext, query: &str, path: &Path) -> Result<u64, EngineError> {
    let plan = planned(context, query).await?;
    write_parquet(execute_stream(plan, context.task_ctx())?, path).await
}

#[tokio::test]
async fn files_have_the_same_digits() {
    let folder = tempfile::tempdir().unwrap();
    let alone = digest(&expected(&sweep()));
    let query = format!("SELECT * FROM {}", table("sweep", &Request { rows_per_chunk: Some(100), ..request() }));
    let context = context(mechanisms(), 3, 64);
    let path = folder.path().join("all.parquet");
    // The second file replaces the first one.
    for _ in 0..2 {
        assert_eq!(write(&context, &query, &path).await.unwrap(), common::ROWS);
        assert_eq!(digest(&lines(&read(&path))), alone);
        assert_eq!(names(folder.path()), [path.as_path()]);
    }
    let copy = folder.path().join("copy.parquet");
    common::rows(&context, &format!("COPY ({query}) TO '{}'", copy.display())).await.unwrap();
    assert_eq!(digest(&lines(&read(&copy))), alone);
}

#[tokio::test]
async fn a_query_that_fails_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("some.parquet");
    let context = context(mechanisms(), 2, 64);
    // The last row divides by zero.
    let table = table("sweep", &Request { rows_per_chunk: Some(10), ..request() });
    let query = format!("SELECT row, 1 / (row - 2183) FROM {table}");
    let message = write(&context, &query, &path).await.unwrap_err().to_string();
    assert!(message.contains("Divide by zero"), "{message}");
    assert!(names(folder.path()).is_empty());
    fs::write(&path, "older").unwrap();
    write(&context, &query, &path).await.unwrap_err();
    assert_eq!((fs::read_to_string(&path).unwrap().as_str(), names(folder.path())), ("older", vec![path]));
}

#[tokio::test]
async fn folders_that_cannot_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let context = context(mechanisms(), 2, 64);
    let query = format!("SELECT row FROM {}", table("sweep", &request()));
    let none = folder.path().join("none");
    let message = write(&context, &query, &none.join("a.parquet")).await.unwrap_err().to_string();
    assert!(message.starts_with(&format!("cannot create a file in {}: ", none.display())), "{message}");
    let message = write(&context, &query, folder.path()).await.unwrap_err().to_string();
    assert!(message.ends_with("is a folder or a device: a file cannot replace it"), "{message}");
    assert!(names(folder.path()).is_empty());
}

/// DataFusion alone tries some of these again and again, or speaks of a bug of its own.
#[tokio::test]
async fn places_that_copy_cannot_write() {
    let folder = tempfile::tempdir().unwrap();
    let context = context(mechanisms(), 2, 64);
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let copy = |place: &str| format!("COPY (SELECT row FROM {}) TO '{place}'", table("sweep", &request()));
    let mut places = vec![
        (
            format!("{}/a.parquet", file.display()),
            format!("cannot create a file in {}: not a directory", file.display()),
        ),
        (format!("{}/b/a.csv", file.display()), format!("cannot create a file in {}: not a directory", file.display())),
        (
            "s3://bucket/a.parquet".to_owned(),
            "there is no store for s3://bucket/a.parquet: COPY writes files of this machine".to_owned(),
        ),
        (
            "http://host/a.json".to_owned(),
            "there is no store for http://host/a.json: COPY writes files of this machine".to_owned(),
        ),
    ];
    // A kernel's file system, in which not even an administrator makes files.
    if Path::new("/proc/version").exists() {
        for name in ["a.parquet", "a.csv", "none/a.parquet"] {
            places.push((format!("/proc/{name}"), "cannot create a file in /proc: ".to_owned()));
        }
        places.push(("file:///proc/a.parquet".to_owned(), "cannot create a file in /proc: ".to_owned()));
    }
    #[cfg(unix)]
    {
        let link = folder.path().join("link");
        std::os::unix::fs::symlink("nowhere", &link).unwrap();
        places.push((format!("{}/a.parquet", link.display()), format!("cannot create a file in {}: ", link.display())));
    }
    for (place, expected) in places {
        let message = common::message(&context, &copy(&place)).await;
        assert!(message.starts_with(&expected), "{place}: {message}");
        assert!(!message.contains("bug"), "{message}");
    }
    // Missing folders are made.
    let path = folder.path().join("new/folder with spaces/a.parquet");
    common::rows(&context, &copy(path.to_str().unwrap())).await.unwrap();
    assert_eq!(read(&path).iter().map(RecordBatch::num_rows).sum::<usize>() as u64, common::ROWS);
}

#[cfg(unix)]
#[tokio::test]
async fn a_symbolic_link_keeps_its_target() {
    let folder = tempfile::tempdir().unwrap();
    let (link, files) = (folder.path().join("link.parquet"), folder.path().join("files"));
    fs::create_dir(&files).unwrap();
    std::os::unix::fs::symlink("files/a.parquet", &link).unwrap();
    let context = context(mechanisms(), 2, 64);
    let query = format!("SELECT row FROM {}", table("sweep", &request()));
    // The file is not there at first, and is replaced then.
    for _ in 0..2 {
        assert_eq!(write(&context, &query, &link).await.unwrap(), common::ROWS);
        assert!(link.is_symlink() && fs::symlink_metadata(files.join("a.parquet")).unwrap().is_file());
        assert_eq!((names(&files).len(), names(folder.path()).len()), (1, 2));
    }
    assert_eq!(read(&link).iter().map(RecordBatch::num_rows).sum::<usize>() as u64, common::ROWS);
}

/// The rows that came before are not a file.
#[tokio::test]
async fn a_query_that_is_given_up_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("some.parquet");
    fs::write(&path, "older").unwrap();
    let context = context(mechanisms(), 2, 64);
    let query = format!("SELECT row FROM {}", table("sweep", &Request { rows_per_chunk: Some(10), ..request() }));
    let plan = planned(&context, &query).await.unwrap();
    let rows = execute_stream(plan, context.task_ctx()).unwrap();
    let (schema, first) = (rows.schema(), rows.take(3));
    // The stream has some rows, and then none for ever.
    let stuck = first.chain(futures::stream::pending());
    let stuck = Box::pin(RecordBatchStreamAdapter::new(schema, stuck));
    let written = tokio::time::timeout(Duration::from_millis(300), write_parquet(stuck, &path)).await;
    assert!(written.is_err());
    // The writer has its own thread.
    let end = Instant::now() + Duration::from_secs(60);
    while names(folder.path()).len() > 1 && Instant::now() < end {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    assert_eq!((fs::read_to_string(&path).unwrap().as_str(), names(folder.path())), ("older", vec![path]));
}

/// The shell limits the size of files, so that writing fails as on a full disk, in the middle of the file.
#[cfg(unix)]
#[test]
fn a_full_disk_is_an_error_and_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.parquet");
    fs::write(&path, "older").unwrap();
    let query = r#"SELECT * FROM sweep('four_bar', '{"factors": [{"Turn": {"column": "theta2", "count": 40000}}]}')"#;
    // Blocks are of 512 or 1024 bytes.
    let output = Command::new("sh")
        .args(["-c", r#"trap "" XFSZ; ulimit -f 100; exec "$0" "$@""#, env!("CARGO_BIN_EXE_linkage-sql"), "sql", query])
        .arg("--parquet")
        .arg(&path)
        .output()
        .unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.starts_with(&format!("error: cannot write {}: File too large", path.display())), "{message}");
    assert!(!output.status.success());
    assert_eq!((fs::read_to_string(&path).unwrap().as_str(), names(folder.path())), ("older", vec![path]));
}
