//! Programs that tests write, compiled by rustc itself with libraries that cargo has built: those of the tests, so that no
//! library is built for them, or `linkage` with other features.
//!
//! They need no manifest: a package of its own, a member of the workspace too, would be built with libraries of its own.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::{env, fs};

use serde_json::Value;

use crate::ROOT;

/// Variables that change what cargo, rustc and clippy do, and the beginnings of others.
const CLEARED: [&str; 5] =
    ["CARGO_ENCODED_RUSTFLAGS", "CARGO_MAKEFLAGS", "RUSTC_WORKSPACE_WRAPPER", "RUSTC_WRAPPER", "RUSTFLAGS"];
const CLEARED_BEGINNINGS: [&str; 4] = ["CARGO_BUILD_", "CARGO_TARGET_", "CARGO_PKG_", "CLIPPY_"];

/// A tool of Rust by its name, or as a variable says; without the wrappers and flags of the caller.
pub fn tool(name: &str) -> Command {
    let mut command = Command::new(of_variable(name));
    for (variable, _) in env::vars_os() {
        let text = variable.to_string_lossy();
        if CLEARED.contains(&&*text) || CLEARED_BEGINNINGS.iter().any(|beginning| text.starts_with(beginning)) {
            command.env_remove(&variable);
        }
    }
    command
}

/// `cargo` as `CARGO` says, `rustc` as `RUSTC` says.
fn of_variable(name: &str) -> String {
    env::var(name.to_uppercase()).unwrap_or_else(|_| name.to_owned())
}

/// The output of a command that succeeds.
///
/// # Panics
///
/// With what it writes, if it fails.
pub fn succeeded(command: &mut Command) -> Output {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(output.status.success(), "{command:?}\n{}", String::from_utf8_lossy(&output.stderr));
    output
}

/// A folder for a program, with these files in their places and no others.
pub fn written(name: &str, files: impl IntoIterator<Item = (String, String)>) -> PathBuf {
    let folder = target().join("generated").join(name);
    // Those of an earlier test.
    drop(fs::remove_dir_all(&folder));
    for (file, text) in files {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder that can be made");
        fs::write(path, text).expect("a file that can be written");
    }
    folder
}

/// The folder of builds, and in it that of the build to which this program belongs.
fn places() -> (PathBuf, PathBuf) {
    let program = env::current_exe().expect("this program");
    // `target/debug/deps/program`
    let built = program.parent().and_then(Path::parent).expect("the folder of a profile");
    (built.parent().expect("the folder of builds").to_owned(), built.to_owned())
}

fn target() -> PathBuf {
    places().0
}

/// Libraries that cargo has built.
pub struct Libraries {
    /// All files, those of libraries under libraries too.
    pub files: Vec<PathBuf>,
    /// The folders in which rustc looks for libraries under libraries.
    folders: Vec<PathBuf>,
    /// The name and the file of each.
    named: Vec<(String, PathBuf)>,
    target: Option<String>,
}

impl Libraries {
    /// Those that the tests are linked with, if these were built with all features of the workspace, or of other `PACKAGES`:
    /// arguments such as `-p linkage -p linkage-tests`.
    pub fn of_tests() -> &'static Self {
        static BUILT: OnceLock<Libraries> = OnceLock::new();
        BUILT.get_or_init(|| {
            let (target, built) = places();
            let profile = built.file_name().expect("a name").to_string_lossy().replace("debug", "dev");
            // As the caller built them, with its packages, wrappers and flags: nothing is built again. A test, since libraries
            // of tests have features of their own.
            let packages = env::var("PACKAGES").unwrap_or_else(|_| "--workspace".to_owned());
            let mut command = Command::new(of_variable("cargo"));
            command.args(["build", "--all-features", "--test", "hygiene", "--profile", &profile]);
            command.args(packages.split_whitespace());
            Self::built(command.arg("--target-dir").arg(target), None)
        })
    }

    /// Those of a package with these features alone, by a profile, for a target.
    pub fn of(package: &str, features: &str, profile: &str, target: Option<&str>) -> Self {
        let mut command = tool("cargo");
        command.args(["build", "--lib", "--no-default-features", "--package", package, "--profile", profile]);
        command.args(["--features", features, "--target-dir"]).arg(self::target().join("generated/target"));
        if let Some(target) = target {
            command.args(["--target", target]);
        }
        Self::built(&mut command, target)
    }

    fn built(command: &mut Command, target: Option<&str>) -> Self {
        command.args(["--quiet", "--message-format=json-render-diagnostics"]).current_dir(ROOT);
        let output = String::from_utf8(succeeded(command).stdout).expect("a text");
        let mut libraries =
            Self { files: Vec::new(), folders: Vec::new(), named: Vec::new(), target: target.map(str::to_owned) };
        for line in output.lines() {
            let message: Value = serde_json::from_str(line).expect("a message");
            let files = message["filenames"].as_array().into_iter().flatten().filter_map(Value::as_str).map(Path::new);
            let is_library = |file: &&Path| file.extension().is_some_and(|end| end == "rlib");
            for file in files.filter(is_library) {
                let name = message["target"]["name"].as_str().expect("a name").replace('-', "_");
                libraries.named.push((name, file.to_owned()));
                libraries.files.push(file.to_owned());
                let folder = file.parent().expect("a folder");
                let folder = if folder.ends_with("deps") { folder.to_owned() } else { folder.join("deps") };
                if !libraries.folders.contains(&folder) {
                    libraries.folders.push(folder);
                }
            }
        }
        libraries
    }

    /// rustc for a program in a folder, whose file this is; it can name these libraries.
    pub fn rustc(&self, folder: &Path, file: &str, named: &[&str]) -> Command {
        self.compiler("rustc", folder, file, named)
    }

    /// Clippy, likewise; its lints are the arguments that follow.
    pub fn clippy(&self, folder: &Path, file: &str, named: &[&str]) -> Command {
        let mut command = self.compiler("clippy-driver", folder, file, named);
        command.env("CLIPPY_CONF_DIR", folder).arg("--emit=metadata");
        command
    }

    fn compiler(&self, name: &str, folder: &Path, file: &str, named: &[&str]) -> Command {
        let mut command = tool(name);
        let crate_name = folder.file_name().expect("a name");
        command.arg(folder.join(file)).args(["--edition=2024", "--crate-name"]).arg(crate_name);
        // Where messages find the lines of the libraries.
        command.arg("--out-dir").arg(folder).current_dir(ROOT);
        for folder in &self.folders {
            command.arg(format!("-Ldependency={}", folder.display()));
        }
        for name in named {
            let (_, file) = self.named.iter().find(|(other, _)| other == name).expect("a library that is built");
            command.arg(format!("--extern={name}={}", file.display()));
        }
        if let Some(target) = &self.target {
            command.arg(format!("--target={target}"));
        }
        command
    }
}
