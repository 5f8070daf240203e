//! The script that starts and stops a cluster on this machine.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use super::processes::until;

const QUERY: &str =
    r#"SELECT count(mu) FROM sweep('four_bar', '{"factors": [{"Turn": {"column": "theta2", "count": 9}}]}')"#;

/// A cluster of the script, which ends with the test.
struct Script<'a> {
    folder: &'a Path,
}

impl Script<'_> {
    fn run(&self, arguments: &[&str], port: &str) -> Output {
        let mut command = Command::new(concat!(env!("CARGO_MANIFEST_DIR"), "/cluster.sh"));
        command.args(arguments).env("LINKAGE_SQL", env!("CARGO_BIN_EXE_linkage-sql"));
        command.env("LINKAGE_CLUSTER", self.folder).env("LINKAGE_PORT", port).output().expect("there is bash")
    }

    /// The processes that run.
    fn processes(&self) -> Vec<String> {
        let pids = fs::read_to_string(self.folder.join("pids")).unwrap_or_default();
        pids.lines().map(str::to_owned).filter(|pid| runs(pid)).collect()
    }
}

impl Drop for Script<'_> {
    fn drop(&mut self) {
        self.run(&["stop"], "0");
    }
}

fn runs(pid: &str) -> bool {
    Path::new("/proc").join(pid).exists()
}

#[test]
fn starts_and_stops() {
    let folder = tempfile::tempdir().expect("a folder");
    let script = Script { folder: folder.path() };
    let start = script.run(&["start", "2"], "0");
    assert!(start.status.success(), "{start:?}");
    let address = String::from_utf8(start.stdout).expect("text");
    let processes = script.processes();
    assert_eq!(processes.len(), 3);

    let query =
        Command::new(env!("CARGO_BIN_EXE_linkage-sql")).args(["sql", "--scheduler", address.trim(), QUERY]).output();
    let query = query.expect("it runs");
    assert!(String::from_utf8_lossy(&query.stdout).contains("| 9 "), "{query:?}");

    // A second one, in the same folder and at the same port.
    assert!(!script.run(&["start"], "0").status.success());
    let other = tempfile::tempdir().expect("a folder");
    let other = Script { folder: other.path() };
    let (_, port) = address.trim().rsplit_once(':').expect("a port");
    let start = other.run(&["start"], port);
    let message = String::from_utf8_lossy(&start.stderr);
    assert!(!start.status.success() && message.contains(&format!("cannot listen at 127.0.0.1:{port}")), "{message}");
    assert_eq!(other.processes().len(), 0);

    assert!(script.run(&["stop"], "0").status.success());
    until("all processes end", || !processes.iter().any(|pid| runs(pid)));
}
