//! The module of the page, asked as the page asks it.

mod bad_input;
mod examples;
mod first_values;
mod motions;
mod turns;
mod words;
mod written;

use std::fs;
use std::path::Path;

use linkage_page::Session;
use serde_json::{Value, json};

/// A session with the mechanism of a text.
struct Page {
    session: Session,
    about: Value,
}

impl Page {
    /// The page with a text that has no mistakes.
    fn with(text: &str) -> Self {
        let mut page = Self { session: Session::default(), about: Value::Null };
        let compiled = page.ask(&json!({ "do": "compile", "text": text }));
        assert!(compiled["mechanisms"].is_array(), "{compiled}");
        page.about = compiled["mechanisms"].clone();
        page
    }

    fn ask(&mut self, question: &Value) -> Value {
        let answer = self.session.ask(&question.to_string(), &mut |_| ());
        serde_json::from_str(&answer).expect("an answer is JSON")
    }

    /// The default values of the parameters of a mechanism.
    fn defaults(&self, mechanism: usize) -> Vec<f64> {
        values(&self.about[mechanism]["parameters"])
    }

    /// The first position of a mechanism, as a part of questions.
    fn begin(&mut self, mechanism: usize, parameters: &[f64]) -> Value {
        let moved = self.ask(&json!({ "do": "begin", "mechanism": mechanism, "parameters": parameters }));
        assert!(moved["why"].is_null(), "{moved}");
        json!({ "mechanism": mechanism, "parameters": parameters, "place": moved["place"] })
    }

    /// A question about a position.
    fn at(&mut self, at: &Value, more: &Value) -> Value {
        self.ask(&merged(at, more))
    }
}

/// The values of parameters.
fn values(parameters: &Value) -> Vec<f64> {
    parameters.as_array().unwrap().iter().map(|one| one["value"].as_f64().unwrap()).collect()
}

fn merged(one: &Value, more: &Value) -> Value {
    let mut all = one.clone();
    for (key, value) in more.as_object().unwrap() {
        all[key] = value.clone();
    }
    all
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().unwrap_or_else(|| panic!("{list}")).iter().map(|one| one.as_f64().unwrap()).collect()
}

/// The texts of the examples by their names.
fn examples() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let folders = ["linkages", "machines"].map(|folder| fs::read_dir(root.join(folder)).expect("a folder"));
    let paths = folders.into_iter().flatten().map(|entry| entry.expect("an entry").path());
    let mut all: Vec<(String, String)> = paths
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read_to_string(&path).unwrap()))
        .collect();
    all.sort();
    all
}
