//! Angles that an equation takes as numbers: the page has the position on its turn, follows it and lists it.

use serde_json::{Value, json};

use super::{Page, numbers};

/// A wheel between two dyads.
const BETWEEN: &str = "mechanism Between {
    param a = 1, c = 3;
    input t;
    unknown p, q, u, r, s;
    loop a@t + c@p = 3.5@0 + 2.5@q;
    equation u = 2*p - t;
    loop a@u + c@r = 3.5@0 + 2.5@s;
    point C = a@u + c@r;
}";

/// A wheel before two loops that are solved together.
const BEFORE: &str = "mechanism Before {
    param a = 1.318787, b = 0.694, c = 0.75474, d = 1.037, e = 0.926, f = 1.655198, h = 1.143275, k = 1.26;
    input z;
    unknown w, t, p, s, u;
    equation w = 3*z;
    point Z = 1@z;
    loop a@t + b@p - c@s - d@0 = 0;
    loop a@t + e@(p - 1.263) + f@u - h@w - k@0 = 0;
}";

/// All positions at an input, as parts of questions.
fn listed(page: &mut Page, input: f64) -> Vec<Value> {
    let parameters = page.defaults(0);
    let found = page.ask(&json!({ "do": "positions", "mechanism": 0, "parameters": parameters, "inputs": [input] }));
    let each = found["positions"].as_array().unwrap_or_else(|| panic!("{found}")).iter();
    let at = |unknowns: &Value| json!({ "mechanism": 0, "parameters": parameters, "place": { "inputs": [input], "unknowns": unknowns } });
    each.map(|position| at(&position["unknowns"])).collect()
}

#[test]
fn a_wheel_between_groups() {
    let mut page = Page::with(BETWEEN);
    for turn in [0.0, 3.0] {
        let t = f64::to_radians(100.0 + 360.0 * turn);
        let all = listed(&mut page, t);
        assert_eq!(all.len(), 4);
        for at in all {
            let unknowns = numbers(&at["place"]["unknowns"]);
            assert!((unknowns[2] - (2.0 * unknowns[0] - t)).abs() < 1e-13, "{at}");
            let range = page.at(&at, &json!({ "do": "motion", "along": 0, "rate": 1.0, "steps": 36 }));
            assert_eq!(range["turns"], json!(true), "{range}");
            let goal = json!({ "parameters": at["parameters"], "inputs": [t + 4.0 * std::f64::consts::PI] });
            let moved = page.at(&at, &json!({ "do": "follow", "to": goal }));
            assert!(moved["stopped"].is_null(), "{moved}");
            let after = numbers(&moved["place"]["unknowns"]);
            // After two turns the rocker is back, and the wheel has gone on by two turns.
            let gone = [0.0, 0.0, -4.0 * std::f64::consts::PI];
            for (place, gone) in gone.iter().enumerate() {
                assert!((after[place] - unknowns[place] - gone).abs() < 1e-9, "{unknowns:?} {after:?}");
            }
            assert!(((after[3] - unknowns[3]) / 2.0).sin().abs() < 1e-9, "{unknowns:?} {after:?}");
        }
    }
}

#[test]
fn a_wheel_before_loops() {
    let mut page = Page::with(BEFORE);
    let all = listed(&mut page, 4.359);
    // As a continuation by small steps has them.
    let ends = [[233.2615, 390.703], [212.5522, 274.6732], [113.2615, 270.703]];
    for (place, at) in all.iter().enumerate() {
        let range = page.at(at, &json!({ "do": "motion", "along": 0, "rate": 1.0, "steps": 4 }));
        for (end, expected) in ["least", "largest"].iter().zip(ends[place / 2]) {
            assert!((range[end].as_f64().unwrap().to_degrees() - expected).abs() < 1e-3, "{range}");
        }
    }
    assert_eq!(all.len(), 6);
}
