//! Parquet files that appear complete or not at all.

mod common;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use common::{context, digest, expected, lines, mechanisms, planned, request, sweep, table};
use datafusion::arrow::array::RecordBatch;
use datafusion::parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use datafusion::physical_plan::execute_stream;
use datafusion::prelude::SessionContext;
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
