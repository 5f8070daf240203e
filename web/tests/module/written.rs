//! Mechanisms that were compiled before, as a live sheet has them.

use linkage_page::{Session, compiled};
use serde_json::{Value, json};

use super::{Page, examples, numbers};

#[test]
fn a_written_mechanism_answers_as_that_of_the_text() {
    for (name, text) in examples() {
        let written = compiled(&text).unwrap();
        let mut page = Page::with(&text);
        let mut live = Page { session: Session::default(), about: Value::Null };
        let loaded = live.ask(&json!({ "do": "load", "written": written }));
        assert_eq!(loaded["mechanisms"], page.about, "{name}");
        let parameters = page.defaults(0);
        let at = page.begin(0, &parameters);
        assert_eq!(live.begin(0, &parameters), at, "{name}");
        let further: Vec<f64> = numbers(&at["place"]["inputs"]).iter().map(|input| input + 0.02).collect();
        for question in [
            json!({ "do": "sheet", "rate": 2.0, "language": "en", "form": "html" }),
            json!({ "do": "follow", "to": { "parameters": parameters, "inputs": further } }),
        ] {
            assert_eq!(live.at(&at, &question), page.at(&at, &question), "{name}");
        }
    }
}

#[test]
fn damaged_mechanisms_are_refused() {
    let written = compiled("mechanism Crank { param r = 1; input phi; point P = r@phi; }").unwrap();
    let mut page = Page { session: Session::default(), about: Value::Null };
    for damaged in ["", "{}", &written[..written.len() / 2], &written.replace("\"version\":3", "\"version\":2")] {
        let answer = page.ask(&json!({ "do": "load", "written": damaged }));
        assert!(answer["why"].is_string(), "{answer}");
    }
}
