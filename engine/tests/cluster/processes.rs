//! The processes of a cluster on this machine. They end with the test, also when it fails.

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use linkage_engine::Mechanisms;
use linkage_engine::cluster::Cluster;

/// The longest time that a test waits for anything.
pub const PATIENCE: Duration = Duration::from_secs(300);

/// The silence after which an executor is lost, in tests that lose one. A busy machine may keep a healthy one silent for
/// seconds.
pub const SILENCE: Duration = Duration::from_secs(12);

/// A process of the command line.
pub struct Process {
    child: Child,
    lines: Arc<Mutex<Vec<String>>>,
}

impl Process {
    /// Starts a process. The lines of both its streams are kept.
    pub fn start(arguments: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkage-sql"));
        command.args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the binary starts");
        let lines = Arc::new(Mutex::new(Vec::new()));
        let out = child.stdout.take().map(|stream| Box::new(stream) as Box<dyn Read + Send>);
        let err = child.stderr.take().map(|stream| Box::new(stream) as Box<dyn Read + Send>);
        for stream in [out, err].into_iter().flatten() {
            let lines = Arc::clone(&lines);
            thread::spawn(move || {
                for line in BufReader::new(stream).lines().map_while(Result::ok) {
                    lines.lock().expect("no reader panics").push(line);
                }
            });
        }
        Self { child, lines }
    }

    pub fn lines(&self) -> Vec<String> {
        self.lines.lock().expect("no reader panics").clone()
    }

    /// The partitions that the log says something of: "begins" or "ends".
    pub fn partitions(&self, event: &str) -> Vec<u64> {
        let number = |line: &String| {
            let words: Vec<&str> = line.split(' ').collect();
            match words.as_slice() {
                ["debug:", "partition", number, .., last] if *last == event => number.parse().ok(),
                _ => None,
            }
        };
        self.lines().iter().filter_map(number).collect()
    }

    /// Sends a signal, for example "STOP".
    pub fn signal(&self, name: &str) {
        let status = Command::new("kill").args([format!("-{name}"), self.child.id().to_string()]).status();
        assert!(status.expect("there is kill").success());
    }

    /// Kills the process and waits for its end.
    pub fn kill(&mut self) {
        self.child.kill().expect("it runs");
        self.child.wait().expect("it was started here");
    }

    /// Waits for the end of the process.
    pub fn end(&mut self) -> ExitStatus {
        let mut status = None;
        until("a process ends", || {
            status = self.child.try_wait().expect("it was started here");
            status.is_some()
        });
        status.expect("it ended")
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // An error is that of a process that ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Waits until something is true.
pub fn until(what: &str, mut is_true: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !is_true() {
        assert!(begin.elapsed() < PATIENCE, "{what}: not after {PATIENCE:?}");
        thread::sleep(Duration::from_millis(2));
    }
}

/// A scheduler and executors that compute one partition at a time.
pub struct Processes {
    // Executors end before the scheduler.
    pub executors: Vec<Process>,
    pub scheduler: Process,
    pub address: String,
}

impl Processes {
    /// Processes of which none is lost.
    pub fn start(executors: usize) -> Self {
        Self::start_with(executors, PATIENCE)
    }

    /// Processes of which one is lost after [`SILENCE`].
    pub fn start_to_lose_one(executors: usize) -> Self {
        Self::start_with(executors, SILENCE)
    }

    fn start_with(executors: usize, timeout: Duration) -> Self {
        let (count, timeout) = (executors.to_string(), timeout.as_secs().to_string());
        let scheduler = Process::start(&["scheduler", "--port", "0", "--timeout", &timeout, "--executors", &count]);
        until("the scheduler prints its address", || !scheduler.lines().is_empty());
        let address = scheduler.lines()[0].clone();
        let mut processes = Self { executors: Vec::new(), scheduler, address };
        processes.executors = (0..executors).map(|_| processes.executor()).collect();
        processes
    }

    /// Starts another executor.
    pub fn executor(&self) -> Process {
        Process::start(&["executor", "--scheduler", &self.address, "--tasks", "1", "--heartbeat", "1", "--verbose"])
    }

    /// The cluster, with 16 partitions.
    pub fn cluster(&self) -> Cluster {
        let mechanisms = Mechanisms::built_in().expect("names differ");
        Cluster::new(&self.address, mechanisms).expect("an address").with_partitions(16)
    }
}
