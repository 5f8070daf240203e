//! Words and units of what the page says.

use serde_json::json;

use super::{Page, values};

/// A parameter with `rpm` has a unit, an output of half a difference of angles is an angle, also as a column and in charts.
#[test]
fn what_the_page_shows_has_units() {
    let text = "mechanism Bar { param Lg = 4, a = 1, c = 3, w = 60rpm, turn = 20deg; input th; unknown p, q; \
                loop a@th + c@p = Lg@0 + c@q; output mu = (q - p)/2; output speed = w*Lg; output bent = q + turn; }";
    let mut page = Page::with(text);
    let about = page.about[0].clone();
    let of =
        |name: &str| about["parameters"].as_array().unwrap().iter().find(|one| one["name"] == name).unwrap().clone();
    assert_eq!(
        (&of("w")["unit"], &of("w")["text"], &of("w")["is_angle"]),
        (&json!("rad/s"), &json!("60rpm"), &json!(false))
    );
    assert_eq!((&of("turn")["unit"], &of("turn")["is_angle"]), (&json!(null), &json!(true)));
    assert_eq!(about["outputs"][0], json!({ "name": "mu", "is_angle": true }));
    let parameters = values(&about["parameters"]);
    let at = page.begin(0, &parameters);
    let motion = page.at(&at, &json!({ "do": "motion", "along": 0, "rate": 1.0, "steps": 24 }));
    let column =
        |name: &str| motion["columns"].as_array().unwrap().iter().find(|one| one["name"] == name).unwrap().clone();
    assert_eq!((&column("mu")["is_angle"], &column("speed")["is_angle"]), (&json!(true), &json!(false)));
    let mut chart =
        |columns: &[&str]| page.ask(&json!({ "do": "chart", "columns": columns }))["svg"].as_str().unwrap().to_owned();
    assert!(chart(&["mu"]).matches('°').count() >= 6, "{}", chart(&["mu"]));
    assert!(chart(&["mu_rate"]).contains("[rad/s]") && chart(&["mu", "mu_rate"]).contains("mu [rad]"));
}

/// The reason why there is no position: which links, and by how much, in the user's names.
#[test]
fn links_that_do_not_reach() {
    let text = "mechanism FourBar { param l1 = 80, l2 = 300, l3 = 50, L4 = 70; input theta2; unknown theta3, theta4; \
                loop l2@theta2 + l3@theta3 + L4@theta4 = l1@0; }";
    let mut page = Page::with(text);
    let parameters = page.defaults(0);
    // By the law of cosines, computed independently.
    let why = "FourBar cannot be assembled at theta2 = 60°: group theta3, theta4 does not close, since `l3` and `L4` together are 149.07 too short: their ends are 269.07 apart";
    let sixty = std::f64::consts::FRAC_PI_3;
    let asked = page.ask(&json!({ "do": "positions", "mechanism": 0, "parameters": parameters, "inputs": [sixty] }));
    assert_eq!(asked["why"], why);
    let begun = page.ask(&json!({ "do": "begin", "mechanism": 0, "parameters": parameters }));
    assert_eq!(begun["why"], why);
    // A slider of a parameter stops where the links do not reach.
    let at = page.begin(0, &[80.0, 20.0, 50.0, 70.0]);
    let to = json!({ "do": "follow", "to": { "parameters": parameters, "inputs": at["place"]["inputs"] } });
    let stopped = page.at(&at, &to)["stopped"].clone();
    assert_eq!((&stopped["is"], &stopped["why"]), (&json!("error"), &json!(why)));
    for word in ["residual", "relative gap", "trials", "assemble_near"] {
        assert!(!asked.to_string().contains(word) && !stopped.to_string().contains(word));
    }
}

/// An output by `atan2` goes on where that goes from pi to -pi, in tables and charts of a motion as in its report.
#[test]
fn angles_go_on_at_the_cut() {
    let text = "mechanism Cut { param a = 2, b = 5, c = 4, d = 5; input t; unknown p, s; loop a@t + b@p = d@0 + c@s; \
                point B = a@t; output o = angle(B); output half = angle(B)/2; }";
    let mut page = Page::with(text);
    let parameters = values(&page.about[0]["parameters"]);
    let at = page.begin(0, &parameters);
    page.at(&at, &json!({ "do": "motion", "along": 0, "rate": 1.0, "steps": 36 }));
    let csv = page.ask(&json!({ "do": "csv" }))["text"].as_str().unwrap().to_owned();
    let names: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    let column = |name: &str| -> Vec<f64> {
        let place = names.iter().position(|other| *other == name).unwrap();
        csv.lines().skip(1).map(|row| row.split(',').nth(place).unwrap().parse().unwrap()).collect()
    };
    let [t, o, half] = ["t", "o", "half"].map(column);
    for row in 1..t.len() {
        let moved = t[row] - t[0];
        assert!((o[row] - o[0] - moved).abs() < 1e-12 && (half[row] - half[0] - moved / 2.0).abs() < 1e-12, "{row}");
    }
}
