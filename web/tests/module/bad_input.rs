//! Texts that are half typed or too long, those of strangers, and questions that have no answer.

use serde_json::{Value, json};

use super::{Page, examples};

fn empty() -> Page {
    Page::with("mechanism Crank { param r = 1; input phi; point P = r@phi; }")
}

/// In the inner ring so many prefixes of each example, or `PREFIXES`, from another one for each commit.
#[test]
fn every_prefix_of_every_example_has_an_answer() {
    let mut page = empty();
    for (name, text) in examples() {
        let step = text.len().div_ceil(linkage_trials::count("PREFIXES", 40, text.len()));
        let first = (linkage_trials::seed(0) % step as u64) as usize;
        for end in (first..text.len()).step_by(step).filter(|end| text.is_char_boundary(*end)) {
            let answer = page.ask(&json!({ "do": "compile", "text": &text[..end] }));
            let units = text[..end].encode_utf16().count() as u64;
            for mistake in answer["mistakes"].as_array().into_iter().flatten() {
                let [from, to] = ["from", "to"].map(|place| mistake[place].as_u64().unwrap());
                assert!(from <= to && to <= units, "{name} {end}: {mistake}");
            }
            assert!(answer["mechanisms"].is_array() || answer["mistakes"][0]["text"].is_string(), "{name} {end}");
        }
    }
}

#[test]
fn a_mistake_is_on_its_token_after_letters_of_two_units() {
    let text = "/// \u{1d703} is an angle.\nmechanism Crank { /* \u{1d703} */ param r = wrong; input phi; }";
    let answer = empty().ask(&json!({ "do": "compile", "text": text }));
    let units: Vec<u16> = text.encode_utf16().collect();
    let [from, to] = ["from", "to"].map(|place| answer["mistakes"][0][place].as_u64().unwrap() as usize);
    assert_eq!(String::from_utf16(&units[from..to]).unwrap(), "wrong");
}

#[test]
fn long_texts_are_refused_in_a_sentence() {
    let mut page = empty();
    let megabyte = "// comment\n".repeat(100_000);
    let answer = page.ask(&json!({ "do": "compile", "text": megabyte }));
    assert!(answer["mistakes"][0]["text"].as_str().unwrap().contains("split it"), "{answer}");
    let loops: String = (0..200).map(|k| format!("unknown a{k}, b{k}; loop l@a{k} + l@b{k} = 1.5 l@phi;\n")).collect();
    let many = format!("mechanism Many {{ param l = 1; input phi; {loops} }}");
    let answer = page.ask(&json!({ "do": "compile", "text": many }));
    assert!(answer["mistakes"][0]["text"].as_str().is_some_and(|words| !words.is_empty()), "{answer}");
}

#[test]
fn a_position_that_does_not_exist_names_the_group_and_the_gap() {
    let (_, text) = examples().into_iter().find(|(name, _)| name == "four_bar.linkage").unwrap();
    let mut page = Page::with(&text);
    let parameters: Vec<f64> = page.defaults(0);
    let mut opened = parameters.clone();
    opened[0] *= 3.0;
    let inputs = page.begin(0, &parameters)["place"]["inputs"].clone();
    for question in [
        json!({ "do": "begin", "mechanism": 0, "parameters": opened }),
        json!({ "do": "positions", "mechanism": 0, "parameters": opened, "inputs": inputs }),
    ] {
        let why = page.ask(&question)["why"].as_str().unwrap().to_owned();
        assert!(why.contains("theta3, theta4") && why.chars().any(|letter| letter.is_ascii_digit()), "{why}");
    }
}

#[test]
fn words_of_strangers_are_text_in_every_answer() {
    let text = "
        /// </script><script>alert(1)</script> <img src=x onerror=alert(2)>
        mechanism FourBar {
            /// <img onerror=alert(3)>
            param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
            input theta2;
            unknown theta3, theta4;
            loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
            /// \"><script>alert(4)</script>
            point C = l2@theta2 + l3@theta3;
        }";
    let mut page = Page::with(text);
    let parameters = page.defaults(0);
    let at = page.begin(0, &parameters);
    let answers: Vec<Value> = [
        json!({ "do": "picture" }),
        json!({ "do": "motion", "along": 0, "rate": 1.0, "steps": 20 }),
        json!({ "do": "sheet", "rate": 1.0, "language": "en", "form": "html" }),
        json!({ "do": "report" }),
    ]
    .iter()
    .map(|question| page.at(&at, question))
    .collect();
    for html in answers.iter().flat_map(|answer| [&answer["picture"]["svg"], &answer["text"], &answer["html"]]) {
        let html = html.as_str().unwrap_or_default();
        assert!(!html.contains("<script") && !html.contains("<img src=x") && !html.contains("<img onerror"), "{html}");
    }
}

#[test]
fn questions_without_sense_are_refused() {
    let mut page = empty();
    let at = json!({ "mechanism": 0, "parameters": [1.0], "place": { "inputs": [1.0], "unknowns": [] } });
    for question in [
        json!({ "do": "dance" }),
        json!({ "do": "csv" }),
        json!({ "do": "chart", "columns": ["P_x"] }),
        json!({ "do": "begin", "mechanism": 7, "parameters": [] }),
        json!({ "do": "picture", "mechanism": 0, "parameters": [1.0], "place": { "inputs": [], "unknowns": [1.0] } }),
        super::merged(&at, &json!({ "do": "motion", "along": 3, "rate": 1.0, "steps": 10 })),
        super::merged(&at, &json!({ "do": "drag", "joint": "Z", "to": [1.0, 1.0] })),
        super::merged(
            &at,
            &json!({ "do": "simulate", "scene": 0, "values": [], "rates": [0.0], "to": 1.0, "tolerance": 1e-6, "steps": 10 }),
        ),
    ] {
        let answer = page.ask(&question);
        assert!(answer["why"].as_str().is_some_and(|why| !why.is_empty()), "{question}: {answer}");
    }
    let answer: Value = serde_json::from_str(&page.session.ask("no JSON", &mut |_| ())).unwrap();
    assert!(answer["why"].is_string());
}

#[test]
fn a_law_that_begins_where_no_motion_leads_says_where_it_stops() {
    let mut page = Page::with(
        "mechanism Rocking {
            param l1 = 80, l2 = 50, l3 = 50, l4 = 70;
            input theta2;
            unknown theta3, theta4;
            loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
            body crank { inertia 1; angle theta2; }
            scene Driven { inertia; drive theta2 = 3 + t; }
        }",
    );
    let parameters = page.defaults(0);
    let at = page.begin(0, &parameters);
    let asked = json!({ "do": "simulate", "scene": 0, "values": [], "rates": [0.0], "to": 1.0, "tolerance": 1e-6, "steps": 10 });
    let answer = page.at(&at, &asked);
    let why = answer["why"].as_str().unwrap();
    let (before, stop) = why.split_once("; the motion to this position stops at theta2 = ").unwrap();
    assert_eq!(before, "the laws of the scene begin at theta2 = 3.000000");
    // The coupler and the rocker are in line: l3 + l4 from the end of the frame.
    let limit = ((80.0_f64.powi(2) + 50.0_f64.powi(2) - 120.0_f64.powi(2)) / (2.0 * 80.0 * 50.0)).acos();
    assert!((stop.parse::<f64>().unwrap() - limit).abs() < 3e-6, "{why}");
}
