//! The commands of the program, called in this process.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use clap::Parser;
use serde_json::Value;
use tempfile::TempDir;

use crate::arguments::Arguments;
use crate::commands;
use crate::failure::Failure;

/// A folder with the text of a linkage.
pub struct Program {
    folder: TempDir,
    /// The time that each command took.
    pub seconds: RefCell<BTreeMap<String, f64>>,
}

/// The value that a command wrote, or the reason why it wrote none.
pub type Answer = Result<Value, String>;

impl Program {
    pub fn new() -> Self {
        Self { folder: TempDir::new().expect("a folder"), seconds: RefCell::default() }
    }

    pub fn write(&self, text: &str) {
        std::fs::write(self.text(), text).expect("a file");
    }

    fn text(&self) -> PathBuf {
        self.folder.path().join("m.linkage")
    }

    /// The answer of a command: JSON, or text in a string.
    pub fn ask(&self, question: &[String]) -> Answer {
        let is_text = question[0] == "report";
        let out = self.folder.path().join(if is_text { "out.txt" } else { "out.json" });
        let _ = std::fs::remove_file(&out);
        let words =
            [Path::new("linkage"), Path::new(&question[0]), &self.text()].map(|word| word.as_os_str().to_owned());
        let others = question[1..].iter().map(Into::into).chain(["-o".into(), out.clone().into_os_string()]);
        let arguments =
            Arguments::try_parse_from(words.into_iter().chain(others)).map_err(|error| error.to_string())?;
        let begun = std::time::Instant::now();
        let ended = catch_unwind(AssertUnwindSafe(|| commands::run(arguments.command)));
        let ended = ended.unwrap_or_else(|_| Err(Failure::Outside("a panic".to_owned())));
        let seconds = begun.elapsed().as_secs_f64();
        *self.seconds.borrow_mut().entry(question[0].clone()).or_default() += seconds;
        let written = std::fs::read_to_string(&out).ok();
        let read = |text: String| {
            if is_text { Value::String(text) } else { serde_json::from_str(&text).unwrap_or(Value::Null) }
        };
        match (ended, written) {
            (Ok(()), Some(text)) => Ok(read(text)),
            (Ok(()), None) => Err("nothing was written".to_owned()),
            // A simulation that ends early has rows.
            (Err(Failure::Outside(why)), Some(text)) if question[0] == "simulate" => {
                let mut value = read(text);
                value["ended"] = Value::String(why);
                Ok(value)
            }
            (Err(Failure::Outside(why) | Failure::Argument(why)), _) => Err(why),
            (Err(Failure::Mistakes(all)), _) => Err(all.iter().map(|of| of.to_text()).collect()),
            (Err(other), _) => Err(format!("{other:?}")),
        }
    }
}
