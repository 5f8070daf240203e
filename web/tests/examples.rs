//! Every question about every example.

use std::fs;
use std::path::Path;

use linkage_page::Session;
use serde_json::{Value, json};

struct Page(Session);

impl Page {
    fn ask(&mut self, question: &Value) -> Value {
        let start = std::time::Instant::now();
        let answer = self.0.ask(&question.to_string(), &mut |_| ());
        eprintln!("  {} {:.1} ms, {} bytes", question["do"], start.elapsed().as_secs_f64() * 1e3, answer.len());
        serde_json::from_str(&answer).expect("an answer is JSON")
    }
}

fn examples() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let folders = ["linkages", "machines"].map(|folder| fs::read_dir(root.join(folder)).expect("a folder"));
    let mut all: Vec<(String, String)> = folders
        .into_iter()
        .flatten()
        .map(|entry| entry.expect("an entry").path())
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read_to_string(&path).unwrap()))
        .collect();
    all.sort();
    all
}

fn merged(one: &Value, more: Value) -> Value {
    let mut all = one.clone();
    for (key, value) in more.as_object().unwrap() {
        all[key] = value.clone();
    }
    all
}

#[test]
fn every_question_about_every_example() {
    for (name, text) in examples() {
        eprintln!("{name}");
        let mut page = Page(Session::default());
        let compiled = page.ask(&json!({ "do": "compile", "text": text }));
        let all = compiled["mechanisms"].as_array().unwrap_or_else(|| panic!("{name}: {compiled}")).clone();
        for (mechanism, about) in all.iter().enumerate() {
            if about["refusal"].is_string() {
                eprintln!("  refusal {}", about["refusal"]);
                continue;
            }
            let parameters: Vec<f64> =
                about["parameters"].as_array().unwrap().iter().map(|one| one["value"].as_f64().unwrap()).collect();
            let moved = page.ask(&json!({ "do": "begin", "mechanism": mechanism, "parameters": parameters }));
            assert!(moved["why"].is_null(), "{name} {moved}");
            let at = json!({ "mechanism": mechanism, "parameters": parameters, "place": moved["place"] });
            let input = at["place"]["inputs"][0].as_f64().unwrap();
            for question in [
                json!({ "do": "positions", "mechanism": mechanism, "parameters": parameters, "inputs": at["place"]["inputs"] }),
                merged(&at, json!({ "do": "motion", "along": 0, "rate": 1.0, "steps": 120 })),
                merged(
                    &at,
                    json!({ "do": "picture", "show": { "traces": true, "velocities": true, "accelerations": true } }),
                ),
                json!({ "do": "csv" }),
                merged(&at, json!({ "do": "sheet", "rate": 1.0, "language": "en", "form": "html" })),
                merged(&at, json!({ "do": "report" })),
                json!({ "do": "rust", "mechanism": mechanism }),
                json!({ "do": "circuits", "mechanism": mechanism, "parameters": parameters, "inputs": at["place"]["inputs"], "along": 0 }),
                merged(&at, json!({ "do": "follow", "to": { "parameters": parameters, "inputs": [input + 0.01] } })),
                merged(&at, json!({ "do": "follow", "to": { "parameters": parameters, "inputs": [input + 7.0] } })),
                merged(
                    &at,
                    json!({ "do": "follow", "to": { "parameters": parameters.iter().map(|one| one * 1.05).collect::<Vec<f64>>(), "inputs": [input] } }),
                ),
            ] {
                let answer = page.ask(&question);
                if answer["why"].is_string() || answer["stopped"].is_string() {
                    eprintln!("    {} {}", answer["why"], answer["stopped"]);
                }
            }
            for (scene, one) in about["scenes"].as_array().unwrap().iter().enumerate() {
                let values: Vec<f64> =
                    one["parameters"].as_array().unwrap().iter().map(|one| one["value"].as_f64().unwrap()).collect();
                let answer = page.ask(&merged(&at, json!({ "do": "simulate", "scene": scene, "values": values, "rates": [1.0], "to": 0.1, "tolerance": 1e-6, "steps": 100 })));
                eprintln!("    {} {} {}", one["name"], answer["why"], answer["lines"]);
            }
        }
    }
}
