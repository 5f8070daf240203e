//! A folder of its own for each test, in which the program runs.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::{fs, str};

use tempfile::TempDir;

pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) {
        fs::write(self.path(name), contents).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// The names of all files, hidden ones among them.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    pub fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkage"));
        command.current_dir(self.0.path()).args(arguments.split_whitespace());
        command
    }

    /// Runs the program without input.
    pub fn run(&self, arguments: &str) -> Ran {
        Ran::from(self.command(arguments).stdin(Stdio::null()).output().unwrap())
    }

    /// Runs the program with this standard input.
    pub fn run_with(&self, arguments: &str, input: &str) -> Ran {
        let mut command = self.command(arguments);
        let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut program = piped.spawn().unwrap();
        program.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
        Ran::from(program.wait_with_output().unwrap())
    }
}

/// The end of a run.
#[derive(Debug, PartialEq, Eq)]
pub struct Ran {
    pub code: Option<i32>,
    pub output: String,
    pub messages: String,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        let text = |bytes: &[u8]| str::from_utf8(bytes).unwrap().to_owned();
        Self { code: output.status.code(), output: text(&output.stdout), messages: text(&output.stderr) }
    }
}

impl Ran {
    /// A run that ended with this code and printed nothing but messages.
    #[track_caller]
    pub fn fails(&self, code: i32, messages: &str) {
        assert_eq!((self.code, self.output.as_str(), self.messages.as_str()), (Some(code), "", messages));
    }

    /// A run that ended well, with these messages; its output.
    #[track_caller]
    pub fn works(self, messages: &str) -> String {
        assert_eq!((self.code, self.messages.as_str()), (Some(0), messages));
        self.output
    }
}

/// A mechanism that is right, with two drivers.
pub const SLIDER_CRANK: &str = "mechanism SliderCrank {
    param r = 1, l = 3;
    coordinate phi, psi, s;
    loop r@phi + l@psi = (s, 0);
    point Pin = r@phi;
    drive Crank by phi;
    drive Piston by s;
}
";

/// A mechanism with two mistakes.
pub const WRONG: &str = "mechanism Wrong {
    param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
    input theta2;
    unknown theta3, theta4;
    loop l2@theta2 + l3@theta3 + l4@theta5 = l1@0;
    point C = l2@theta2 + l33@theta3;
}
";
