//! Bad input: errors name the address, and nothing waits for ever.

use std::net::TcpListener;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use super::processes::{Process, Processes, until};

const QUERY: &str =
    r#"SELECT row, mu FROM sweep('four_bar', '{"factors": [{"Turn": {"column": "theta2", "count": 9}}]}')"#;

/// Runs the command line, which fails; its message.
fn message(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_linkage-sql")).args(arguments).output();
    let Output { status, stderr, stdout } = output.expect("the binary starts");
    assert!(!status.success(), "{}", String::from_utf8_lossy(&stdout));
    String::from_utf8(stderr).expect("text").trim_end().to_owned()
}

/// An address at which nobody listens.
fn free() -> String {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    listener.local_addr().expect("an address").to_string()
}

#[test]
fn unreachable_scheduler() {
    let address = free();
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("rows.parquet");
    let file = file.to_string_lossy();
    let expected = format!("error: the scheduler at {address} does not answer: Connection refused (os error 111)");
    assert_eq!(message(&["sql", "--scheduler", &address, "--parquet", &file, QUERY]), expected);
    assert!(!Path::new(&*file).exists());
    assert_eq!(message(&["executor", "--scheduler", &address]), expected);
}

#[test]
fn address_without_port() {
    let expected = "error: nowhere is not the address of a scheduler: HOST:PORT, for example 127.0.0.1:50050";
    assert_eq!(message(&["sql", "--scheduler", "nowhere", QUERY]), expected);
    assert_eq!(message(&["executor", "--scheduler", "nowhere"]), expected);
}

#[test]
fn no_name() {
    let message = message(&["scheduler", "--bind", "0.0.0.0", "--port", "0"]);
    assert_eq!(message, "error: a scheduler at 0.0.0.0 needs a name by which executors reach it: --advertise HOST");
}

#[test]
fn port_in_use() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("an address").port().to_string();
    let expected = |role: &str| {
        format!("error: the {role} cannot listen at 127.0.0.1:{port}: Address already in use (os error 98)")
    };
    assert_eq!(message(&["scheduler", "--port", &port]), expected("scheduler"));
    let processes = Processes::start(0);
    for option in ["--port", "--task-port"] {
        assert_eq!(message(&["executor", "--scheduler", &processes.address, option, &port]), expected("executor"));
    }
}

#[test]
fn no_executors() {
    let processes = Processes::start(1);
    drop(processes.executors);
    let scheduler = Process::start(&["scheduler", "--port", "0", "--executors", "2"]);
    until("the scheduler prints its address", || !scheduler.lines().is_empty());
    let address = &scheduler.lines()[0];
    let expected = format!(
        "error: the scheduler at {address} has too few executors after 1 s: not ready: 0/2 executors registered"
    );
    assert_eq!(message(&["sql", "--scheduler", address, "--wait", "1", QUERY]), expected);
}

/// A scheduler that accepts connections and does not answer.
#[test]
fn silent_scheduler() {
    let processes = Processes::start(1);
    processes.scheduler.signal("STOP");
    let address = &processes.address;
    let begin = Instant::now();
    let expected = format!("error: the scheduler at {address} does not answer: silent for 5 s");
    assert_eq!(message(&["sql", "--scheduler", address, QUERY]), expected);
    assert!(begin.elapsed() < Duration::from_secs(20));
}

/// Executors end when the scheduler is gone.
#[test]
fn scheduler_is_gone() {
    let mut processes = Processes::start(1);
    let executor = &mut processes.executors[0];
    std::thread::sleep(Duration::from_secs(1));
    processes.scheduler.kill();
    executor.end();
}

/// A file appears when it is complete.
#[test]
fn file() {
    let processes = Processes::start(1);
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("rows.parquet");
    let name = file.to_string_lossy();
    let arguments = ["sql", "--scheduler", &processes.address, "--parquet", &name];
    let message = message(&[&arguments[..], &[&QUERY.replace("mu", "1 / (row - 4)")]].concat());
    assert!(message.contains("DivideByZero"), "{message}");
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 0);
    let output = Command::new(env!("CARGO_BIN_EXE_linkage-sql")).args(arguments).arg(QUERY).output();
    assert_eq!(String::from_utf8_lossy(&output.expect("it runs").stdout), format!("9 rows in {name}\n"));
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 1);
}

/// Statements that write on an executor, or change a session that ends with them.
#[test]
fn statements() {
    let processes = Processes::start(1);
    for (statement, expected) in [
        (format!("COPY ({QUERY}) TO '/tmp/rows.parquet'"), "DML not supported: COPY"),
        (format!("CREATE TABLE rows AS {QUERY}"), "DDL not supported: CreateMemoryTable"),
    ] {
        let message = message(&["sql", "--scheduler", &processes.address, &statement]);
        assert!(message.contains(expected), "{message}");
    }
}
