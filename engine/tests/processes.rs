//! The binary at its ends: interrupts, and readers that go.
#![cfg(unix)]

use std::fs;
use std::io::Read;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

const BINARY: &str = env!("CARGO_BIN_EXE_linkage-sql");

/// A query that computes for hours.
const LONG: &str =
    r#"SELECT * FROM sweep('four_bar', '{"factors": [{"Turn": {"column": "theta2", "count": 1000000000000}}]}')"#;

fn names(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}

/// Waits until something is true, for a minute at most.
fn until(mut is_true: impl FnMut() -> bool) {
    let end = Instant::now() + Duration::from_secs(60);
    while !is_true() {
        assert!(Instant::now() < end, "not after a minute");
        thread::sleep(Duration::from_millis(5));
    }
}

/// Waits for the end of a process, and kills it after a minute.
fn end(mut child: Child) -> (std::process::ExitStatus, String) {
    let mut status = None;
    let begin = Instant::now();
    while status.is_none() {
        if begin.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
        }
        status = child.try_wait().unwrap();
        thread::sleep(Duration::from_millis(5));
    }
    let mut text = String::new();
    if let Some(mut stream) = child.stderr.take() {
        stream.read_to_string(&mut text).unwrap();
    }
    (status.unwrap(), text)
}

fn writing(path: &Path, before: &str) -> Child {
    let mut command = Command::new("sh");
    command.args(["-c", &format!(r#"{before} exec "$0" "$@""#), BINARY, "sql", LONG, "--parquet"]).arg(path);
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

fn send(signal: &str, child: &Child) {
    assert!(Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).status().unwrap().success());
}

/// True if this test was started to ignore a signal, as by `nohup`: a process that it starts ignores it as well.
fn is_ignored(number: u32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.is_some_and(|mask| u64::from_str_radix(mask.trim(), 16).unwrap() >> (number - 1) & 1 == 1)
}

#[test]
fn an_interrupt_leaves_no_part_of_a_file() {
    let signals = [("INT", 2), ("TERM", 15), ("HUP", 1)];
    for (signal, number) in signals.into_iter().filter(|(_, number)| !is_ignored(*number)) {
        let code = 128 + i32::try_from(number).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("large.parquet");
        fs::write(&path, "older").unwrap();
        let child = writing(&path, "");
        until(|| names(folder.path()).len() > 1);
        send(signal, &child);
        let (status, text) = end(child);
        assert_eq!((status.code(), text.as_str()), (Some(code), ""), "{signal}");
        assert_eq!(
            (fs::read_to_string(&path).unwrap().as_str(), names(folder.path())),
            ("older", vec![path]),
            "{signal}"
        );
    }
}

/// `nohup` ignores the loss of the terminal, and a shell lets its jobs in the background ignore interrupts.
#[test]
fn a_signal_that_is_ignored_stays_ignored() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.parquet");
    let mut child = writing(&path, "trap '' HUP INT;");
    until(|| !names(folder.path()).is_empty());
    send("HUP", &child);
    send("INT", &child);
    thread::sleep(Duration::from_millis(300));
    assert!(child.try_wait().unwrap().is_none());
    send("TERM", &child);
    assert_eq!(end(child).0.code(), Some(143));
    assert!(names(folder.path()).is_empty());
}

#[test]
fn a_reader_that_goes_ends_the_process_quietly() {
    let many = r#"SELECT * FROM sweep('four_bar', '{"factors": [{"Turn": {"column": "theta2", "count": 5000}}]}')"#;
    for arguments in [["sql", many].as_slice(), &["sql", many, "--progress"], &["--help"], &["sql", "SELECT 1"]] {
        let mut child =
            Command::new(BINARY).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // As `head -1`: some bytes, and then no reader.
        let mut some = [0; 1];
        child.stdout.take().unwrap().read_exact(&mut some).unwrap();
        let (status, text) = end(child);
        assert!(status.success() && status.signal().is_none(), "{arguments:?}: {status:?}, {text}");
        // The progress has a stream of its own.
        let is_progress = |line: &str| arguments.contains(&"--progress") && line.ends_with(" chunks");
        assert!(text.lines().all(is_progress), "{arguments:?}: {text}");
    }
    // Nor does it need a reader of its errors.
    let mut child =
        Command::new(BINARY).args(["sql", "SELEC"]).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(end(child).0.code(), Some(1));
    let (mut child, folder) = {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.parquet");
        let query =
            r#"SELECT row FROM sweep('four_bar', '{"factors": [{"Turn": {"column": "theta2", "count": 50}}]}')"#;
        let mut command = Command::new(BINARY);
        command.args(["sql", query, "--parquet"]).arg(path).stdout(Stdio::piped()).stderr(Stdio::piped());
        (command.spawn().unwrap(), folder)
    };
    drop(child.stdout.take());
    let (status, text) = end(child);
    assert!(status.success() && text.is_empty(), "{status:?}, {text}");
    assert_eq!(names(folder.path()), [folder.path().join("a.parquet")]);
}

#[test]
fn an_output_that_is_full_is_an_error() {
    let Ok(full) = fs::OpenOptions::new().write(true).open("/dev/full") else { return };
    let mut command = Command::new(BINARY);
    let child = command.args(["sql", "SELECT 1"]).stdout(full).stderr(Stdio::piped()).spawn().unwrap();
    let (status, text) = end(child);
    assert_eq!(status.code(), Some(1));
    assert!(text.starts_with("error: cannot write the standard output: No space left"), "{text}");
}
