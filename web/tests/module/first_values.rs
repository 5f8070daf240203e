//! The first position of the page: the first value of each input, and other values where there is no position.

use serde_json::{Value, json};

use super::{Page, numbers};

/// The first position of the only mechanism of a text, and a page with it.
fn begun(text: &str) -> (Page, Value) {
    let mut page = Page::with(text);
    let parameters = page.defaults(0);
    let at = page.begin(0, &parameters);
    (page, at)
}

fn follow(page: &mut Page, at: &Value, parameters: &[f64], inputs: &[f64]) -> Value {
    page.at(at, &json!({ "do": "follow", "to": { "parameters": parameters, "inputs": inputs } }))
}

#[test]
fn inputs_begin_in_the_middle_of_their_ranges() {
    let degrees = f64::to_radians;
    for (range, first) in [
        ("in -15deg..15deg", 0.0),
        ("in 30deg..100deg", degrees(65.0)),
        ("in 10deg..1000deg", degrees(505.0)),
        ("in 10deg..", degrees(10.0)),
        ("in ..90deg", degrees(90.0)),
        ("", degrees(60.0)),
    ] {
        let (mut page, at) = begun(&format!("mechanism M {{ input a {range}; point B = 1@a; }}"));
        assert!((numbers(&at["place"]["inputs"])[0] - first).abs() < 1e-14, "{range}: {at}");
        // It moves from there, and stays in its range.
        let inside = if range == "in ..90deg" { first - 0.1 } else { first + 0.1 };
        let moved = follow(&mut page, &at, &[], &[inside]);
        assert!(moved["stopped"].is_null() && numbers(&moved["place"]["inputs"]) == [inside], "{range}: {moved}");
    }
    let (mut page, at) = begun("mechanism M { input a in -15deg..15deg; point B = 1@a; }");
    let moved = follow(&mut page, &at, &[], &[1.0]);
    assert_eq!(moved["stopped"]["is"], "largest", "{moved}");
    assert!((numbers(&moved["place"]["inputs"])[0] - degrees(15.0)).abs() < 1e-5, "{moved}");
    // A position of the text before that is outside counts no more.
    let near = json!({ "inputs": [1.0], "unknowns": [] });
    let again = page.ask(&json!({ "do": "begin", "mechanism": 0, "parameters": [], "near": near }));
    assert_eq!(numbers(&again["place"]["inputs"]), [0.0]);
}

/// A length, of which most values have no position, and a range within which only a part has.
#[test]
fn lengths_begin_where_there_is_a_position() {
    for range in ["", "in -75..75", "in -500..500", "in -300..", "in ..30"] {
        let text = format!(
            "mechanism M {{ param l = 80, r = 50, d = 100; input z {range}; unknown b, c; loop l@b + r@c = (d + z, 0); }}"
        );
        let (mut page, at) = begun(&text);
        let z = numbers(&at["place"]["inputs"])[0];
        let reach = (100.0 + z).abs();
        assert!(reach > 30.0 && reach < 130.0, "{range}: {z}");
        let parameters = page.defaults(0);
        let moved = follow(&mut page, &at, &parameters, &[z - 1.0]);
        assert!(moved["stopped"].is_null(), "{range}: {moved}");
    }
}

/// A parameter may move the end of a range past the position: the motion leads back into the range.
#[test]
fn motions_lead_back_into_a_range() {
    let (mut page, at) = begun("mechanism M { param w = 30deg; input a in -w..w; point B = 1@a; }");
    let parameters = page.defaults(0);
    let outer = follow(&mut page, &at, &parameters, &[0.4]);
    let at = json!({ "mechanism": 0, "parameters": parameters, "place": outer["place"] });
    let narrow = [0.2];
    let outside = follow(&mut page, &at, &narrow, &[0.4]);
    let at = json!({ "mechanism": 0, "parameters": narrow, "place": outside["place"] });
    assert_eq!(numbers(&at["place"]["inputs"]), [0.4], "{outside}");
    let stays = follow(&mut page, &at, &narrow, &[0.3]);
    assert!(!stays["stopped"].is_null() && numbers(&stays["place"]["inputs"]) == [0.4], "{stays}");
    let back = follow(&mut page, &at, &narrow, &[0.1]);
    assert!(back["stopped"].is_null() && numbers(&back["place"]["inputs"]) == [0.1], "{back}");
}
