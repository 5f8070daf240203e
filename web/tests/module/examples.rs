//! Every question about every example.

use serde_json::{Value, json};

use super::{Page, examples, numbers, values};

/// Long answers in a development build: they are asked about the others.
const LONG: [&str; 2] = ["engine.linkage", "peaucellier.linkage"];

fn answered(name: &str, question: &Value, answer: &Value) {
    assert!(answer["why"].is_null(), "{name}: {} {answer}", question["do"]);
}

/// In the inner ring about a third of them.
#[test]
fn every_question_about_every_example() {
    for (name, text) in linkage_trials::some(examples(), 3) {
        let mut page = Page::with(&text);
        let count = page.about.as_array().unwrap().len();
        for mechanism in 0..count {
            let parameters = page.defaults(mechanism);
            let at = page.begin(mechanism, &parameters);
            let inputs = &at["place"]["inputs"];
            let further: Vec<f64> = numbers(inputs).iter().map(|input| input + 0.01).collect();
            let show = json!({ "traces": true, "velocities": true, "accelerations": true, "along": 0, "rate": 2.0 });
            let of_positions = [
                json!({ "do": "motion", "along": 0, "rate": 1.0, "steps": 60 }),
                json!({ "do": "picture", "show": show }),
                json!({ "do": "sheet", "rate": 1.0, "language": "en", "form": "html" }),
                json!({ "do": "sheet", "rate": null, "language": "en", "form": "latex" }),
                json!({ "do": "follow", "to": { "parameters": parameters, "inputs": further }, "show": show }),
            ];
            for question in &of_positions {
                let answer = page.at(&at, question);
                answered(&name, question, &answer);
                assert!(answer["stopped"].is_null(), "{name}: {answer}");
            }
            if !LONG.contains(&name.as_str()) {
                let report = page.at(&at, &json!({ "do": "report" }));
                let html = report["html"].as_str().unwrap();
                assert!(html.contains("<h2>") && !html.contains("Branch {"), "{name}");
            }
            let positions =
                json!({ "do": "positions", "mechanism": mechanism, "parameters": parameters, "inputs": inputs });
            let listed = page.ask(&positions);
            answered(&name, &positions, &listed);
            let has_begun = |one: &Value| one["unknowns"] == at["place"]["unknowns"];
            assert!(listed["positions"].as_array().unwrap().iter().any(has_begun), "{name}: {listed}");
            let rust = page.ask(&json!({ "do": "rust", "mechanism": mechanism }));
            assert!(rust["text"].as_str().unwrap().contains("impl"), "{name}");
            if listed["positions"].as_array().unwrap().len() <= 4 {
                let circuits = json!({ "do": "circuits", "mechanism": mechanism, "parameters": parameters, "inputs": inputs, "along": 0 });
                let found = page.ask(&circuits);
                answered(&name, &circuits, &found);
            }
            assert!(page.ask(&json!({ "do": "csv" }))["text"].as_str().unwrap().lines().count() == 62, "{name}");
            let columns = json!([page.about[mechanism]["points"][0].as_str().map(|point| format!("{point}_x"))]);
            if columns[0].is_string() {
                let chart = page.ask(&json!({ "do": "chart", "columns": columns }));
                assert!(chart["svg"].as_str().is_some_and(|svg| svg.starts_with("<svg")), "{name}: {chart}");
            }
            let scenes = page.about[mechanism]["scenes"].as_array().unwrap().clone();
            for (scene, about) in scenes.iter().enumerate().filter(|(_, about)| about["simulates"] == true) {
                let rates = vec![0.0; further.len()];
                let question = json!({ "do": "simulate", "scene": scene, "values": values(&about["parameters"]),
                    "rates": rates, "to": 0.02, "tolerance": 1e-6, "steps": 20 });
                let found = page.at(&at, &question);
                answered(&name, &question, &found);
                assert_eq!(found["times"].as_array().unwrap().len(), 21, "{name}");
                assert_eq!(found["places"].as_array().unwrap().len(), 21, "{name}");
                assert!(found["sections"].as_array().unwrap().len() > 1, "{name}");
            }
        }
    }
}

#[test]
fn the_words_of_the_language() {
    let words =
        Page::with("mechanism Crank { param r = 1; input phi; point P = r@phi; }").ask(&json!({ "do": "words" }));
    for (kind, word) in [("keywords", "mechanism"), ("keywords", "loop"), ("functions", "atan2"), ("functions", "dot")]
    {
        assert!(words[kind].as_array().unwrap().contains(&json!(word)), "{word}: {words}");
    }
}
