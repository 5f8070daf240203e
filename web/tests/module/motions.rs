//! Motions by sliders and by the pointer, against emitted code.

use linkage::{Elbow, Kinematic as _, Mechanism as _, linkage};
use serde_json::{Value, json};

use super::{Page, merged, numbers};

linkage! {
    #[derive(Debug, Clone)]
    mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point C = l2@theta2 + l3@theta3;
    }
}

const TEXT: &str = "
    mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point B = l2@theta2;
        point C = l2@theta2 + l3@theta3;
    }";

/// The page with the four-bar at this input, on the first branch.
fn at_input(page: &mut Page, parameters: &[f64], input: f64) -> Value {
    let near = json!({ "inputs": [input], "unknowns": page.begin(0, parameters)["place"]["unknowns"] });
    let moved = page.ask(&json!({ "do": "begin", "mechanism": 0, "parameters": parameters, "near": near }));
    assert_eq!(numbers(&moved["place"]["inputs"]), [input], "{moved}");
    json!({ "mechanism": 0, "parameters": parameters, "place": moved["place"] })
}

fn follow(page: &mut Page, at: &Value, parameters: &[f64], input: f64) -> Value {
    page.at(at, &json!({ "do": "follow", "to": { "parameters": parameters, "inputs": [input] } }))
}

/// A position without its full turns.
fn within_a_turn(angle: f64) -> f64 {
    angle.sin().atan2(angle.cos())
}

/// The unknowns of emitted code on the branch of these unknowns.
fn emitted(four_bar: &FourBar, input: f64, like: &Value) -> [f64; 2] {
    let unknowns = numbers(&like["place"]["unknowns"]);
    let found = [Elbow::Left, Elbow::Right].map(|side| {
        let pose = four_bar.assemble(input, FourBarBranch::new(side)).unwrap();
        let q = FourBar::coordinates_of(&pose);
        [q.theta3, q.theta4]
    });
    let far = |one: &[f64; 2]| within_a_turn(one[0] - unknowns[0]).abs() + within_a_turn(one[1] - unknowns[1]).abs();
    found.into_iter().min_by(|one, other| far(one).total_cmp(&far(other))).unwrap()
}

fn same(moved: &Value, expected: [f64; 2]) {
    let unknowns = numbers(&moved["place"]["unknowns"]);
    for (one, other) in unknowns.iter().zip(expected) {
        assert!(within_a_turn(one - other).abs() < 1e-13, "{unknowns:?} {expected:?}");
    }
}

#[test]
fn a_slider_follows_the_motion_over_turns() {
    let mut page = Page::with(TEXT);
    let parameters = page.defaults(0);
    let at = page.begin(0, &parameters);
    let from = numbers(&at["place"]["inputs"])[0];
    for input in [from + 0.3, from - 2.0, from + 20.0] {
        let moved = follow(&mut page, &at, &parameters, input);
        assert_eq!(numbers(&moved["place"]["inputs"]), [input]);
        assert!(moved["stopped"].is_null());
        same(&moved, emitted(&FourBar::default(), input, &moved));
        // The coupler of a crank-rocker goes to and fro: it is on the side on which it began.
        let sign =
            |of: &Value| (numbers(&of["place"]["unknowns"])[0] - numbers(&of["place"]["unknowns"])[1]).sin() > 0.0;
        assert_eq!(sign(&moved), sign(&at));
    }
}

#[test]
fn a_slider_stops_at_a_dead_point_and_goes_back() {
    // The crank is no crank: l2 + l1 > l3 + l4.
    let parameters = [80.0, 50.0, 50.0, 70.0];
    let mut page = Page::with(TEXT);
    let at = page.begin(0, &parameters);
    let stopped = follow(&mut page, &at, &parameters, 3.0);
    assert_eq!(stopped["stopped"], json!({ "input": 0, "is": "dead_point", "group": "theta3, theta4" }));
    // The farthest distance of the ends of l2 and the frame is l3 + l4 = 120.
    let limit = ((80.0_f64.powi(2) + 50.0_f64.powi(2) - 120.0_f64.powi(2)) / (2.0 * 80.0 * 50.0)).acos();
    let input = numbers(&stopped["place"]["inputs"])[0];
    assert!(input < limit && limit - input < 2e-6, "{input} {limit}");
    // Further in the same direction nothing moves; back there is the position of before.
    let again = json!({ "mechanism": 0, "parameters": parameters, "place": stopped["place"] });
    let more = follow(&mut page, &again, &parameters, 3.5);
    assert_eq!(more["place"], stopped["place"]);
    assert_eq!(more["stopped"], stopped["stopped"]);
    let from = numbers(&at["place"]["inputs"])[0];
    let back = follow(&mut page, &again, &parameters, from);
    let [there, here] = [&back, &at].map(|of| numbers(&of["place"]["unknowns"]));
    assert!(there.iter().zip(&here).all(|(one, other)| (one - other).abs() < 1e-9), "{there:?} {here:?}");
}

#[test]
fn parameters_change_and_the_position_goes_along() {
    let mut page = Page::with(TEXT);
    let parameters = page.defaults(0);
    let at = at_input(&mut page, &parameters, 1.0);
    for changed in [[80.0, 25.0, 50.0, 70.0], [60.0, 20.0, 90.0, 70.0], [40.0, 10.0, 25.0, 35.0]] {
        let moved = follow(&mut page, &at, &changed, 1.0);
        assert!(moved["stopped"].is_null(), "{moved}");
        let [l1, l2, l3, l4] = changed;
        let four_bar = FourBar { l1, l2, l3, l4 };
        same(&moved, emitted(&four_bar, 1.0, &moved));
        let pose = four_bar.pose_at(&FourBarCoordinates {
            theta2: 1.0,
            theta3: numbers(&moved["place"]["unknowns"])[0],
            theta4: numbers(&moved["place"]["unknowns"])[1],
        });
        let before = FourBar::default().pose_at(&FourBarCoordinates {
            theta2: 1.0,
            theta3: numbers(&at["place"]["unknowns"])[0],
            theta4: numbers(&at["place"]["unknowns"])[1],
        });
        // No branch is changed: the determinant keeps its sign.
        assert_eq!(four_bar.determinant(&pose) > 0.0, FourBar::default().determinant(&before) > 0.0);
    }
}

#[test]
fn parameters_stop_where_the_linkage_opens() {
    let mut page = Page::with(TEXT);
    let parameters = page.defaults(0);
    let at = at_input(&mut page, &parameters, 1.0);
    let opened = follow(&mut page, &at, &[200.0, 20.0, 50.0, 70.0], 1.0);
    let stop = &opened["stopped"];
    assert!(stop["input"].is_null() && stop["is"] == "error", "{stop}");
    assert!(stop["why"].as_str().unwrap().contains("theta3"), "{stop}");
    // C is where the links are in line: |(l1 - l2 cos, l2 sin)| = l3 + l4.
    let l1 = numbers(&opened["parameters"])[0];
    let (sine, cosine) = 1.0_f64.sin_cos();
    let limit = 20.0 * cosine + (120.0_f64.powi(2) - (20.0 * sine).powi(2)).sqrt();
    assert!(l1 < limit && limit - l1 < 1e-3, "{l1} {limit}");
}

#[test]
fn a_pointer_turns_the_crank_and_turns_count() {
    let mut page = Page::with(TEXT);
    let parameters = page.defaults(0);
    let mut at = page.begin(0, &parameters);
    let from = numbers(&at["place"]["inputs"])[0];
    // Three turns in steps of 20 degrees, the pointer outside of the crank's circle.
    for step in 1..=54 {
        let angle = from + f64::from(step) * 20_f64.to_radians();
        let to = [33.0 * angle.cos(), 33.0 * angle.sin()];
        let moved = page.at(&at, &json!({ "do": "drag", "joint": "B", "to": to }));
        assert!(moved["stopped"].is_null(), "{moved}");
        let input = numbers(&moved["place"]["inputs"])[0];
        assert!((input - angle).abs() < 1e-9, "{input} {angle}");
        at["place"] = moved["place"].clone();
    }
}

#[test]
fn a_pointer_moves_a_joint_of_the_coupler() {
    let mut page = Page::with(TEXT);
    let parameters = page.defaults(0);
    let at = page.begin(0, &parameters);
    let further = follow(&mut page, &at, &parameters, numbers(&at["place"]["inputs"])[0] + 0.2);
    let joints = further["picture"]["joints"].as_array().unwrap();
    let coupler = joints.iter().find(|joint| joint["name"] == "C").unwrap();
    let moved = page.at(&at, &json!({ "do": "drag", "joint": "C", "to": [coupler["x"], coupler["y"]] }));
    let [input, expected] = [&moved, &further].map(|of| numbers(&of["place"]["inputs"])[0]);
    assert!((input - expected).abs() < 1e-3, "{input} {expected}");
}

#[test]
fn a_picture_has_the_joints_where_it_says() {
    let mut page = Page::with(TEXT);
    let parameters = page.defaults(0);
    let at = at_input(&mut page, &parameters, 1.0);
    let picture = &page.at(&at, &json!({ "do": "picture" }))["picture"];
    let (origin, scale) = (numbers(&picture["origin"]), picture["scale"].as_f64().unwrap());
    let svg = picture["svg"].as_str().unwrap();
    for joint in picture["joints"].as_array().unwrap() {
        let at = [origin[0] + scale * joint["x"].as_f64().unwrap(), origin[1] - scale * joint["y"].as_f64().unwrap()];
        let [x, y] = at.map(|pixel| (pixel * 10.0).round() / 10.0);
        assert!(svg.contains(&format!("translate({x} {y})")), "{joint} {x} {y}");
    }
}

/// The numbers next to the sliders, and the places of joints in the picture.
#[test]
fn numbers_and_joints_are_those_of_emitted_code() {
    let mut page = Page::with(TEXT);
    let parameters = page.defaults(0);
    let at = page.begin(0, &parameters);
    let four_bar = FourBar::default();
    for input in [0.3, 1.9, 4.0] {
        let show = json!({ "velocities": true, "rate": 2.0 });
        let to = json!({ "parameters": parameters, "inputs": [input] });
        let moved = page.at(&at, &json!({ "do": "follow", "to": to, "show": show }));
        let [theta3, theta4] = numbers(&moved["place"]["unknowns"])[..] else { panic!("{moved}") };
        let motion = four_bar.motion(&FourBarCoordinates { theta2: input, theta3, theta4 }, 2.0, 0.0).unwrap();
        let (rates, accelerations) = (motion.rates, motion.accelerations);
        let expected = [
            ("theta2", [input, 2.0, 0.0]),
            ("theta3", [theta3, rates.theta3, accelerations.theta3]),
            ("theta4", [theta4, rates.theta4, accelerations.theta4]),
        ];
        let rows = moved["numbers"].as_array().unwrap();
        assert_eq!(rows.len(), expected.len());
        for (row, (name, numbers)) in rows.iter().zip(expected) {
            assert_eq!(row["name"], name);
            for (key, number) in ["value", "rate", "acceleration"].into_iter().zip(numbers) {
                let found = row[key].as_f64().unwrap();
                // A number as text and back.
                assert!((found - number).abs() <= f64::EPSILON * number.abs(), "{name} {key}: {found} {number}");
            }
        }
        let joint = |name: &str| -> [f64; 2] {
            let joints = moved["picture"]["joints"].as_array().unwrap();
            let joint = joints.iter().find(|joint| joint["name"] == name).unwrap();
            ["x", "y"].map(|axis| joint[axis].as_f64().unwrap())
        };
        let (found, c) = (joint("C"), motion.points.c.position);
        assert!((found[0] - c.x).hypot(found[1] - c.y) < 1e-13 * parameters[0], "{found:?} {c}");
    }
}

/// A report has the modes in the declared ranges, the circuits of a mechanism whose output has a kink, and angles that turn.
#[test]
fn reports_of_ranges_kinks_and_turns() {
    let mut page = Page::with(
        "mechanism Ranged { param crank = 2, frame = 3; input theta, z; unknown phi, s in 1.5..4.5;
             loop crank@theta = (frame + z)@0 + s@phi; }
         mechanism Kink { param a = 2, b = 5, c = 4, d = 5; input t; unknown p, s; loop a@t + b@p = d@0 + c@s;
             point B = a@t; output o = angle(B); output k = abs(sin(t)); }",
    );
    let crank = 60_f64.to_radians();
    let report = |page: &mut Page, mechanism: usize, place: Value| {
        let parameters = page.defaults(mechanism);
        let at = json!({ "mechanism": mechanism, "parameters": parameters, "place": place });
        page.at(&at, &json!({ "do": "report" }))["html"].as_str().unwrap().to_owned()
    };
    // s = -sqrt 7 is not in its range.
    let place = json!({ "inputs": [crank, 0.0], "unknowns": [3_f64.sqrt().atan2(-2.0), 7_f64.sqrt()] });
    let text = report(&mut page, 0, place);
    assert!(text.contains("there is 1 mode.") && !text.contains("Mode 2"), "{text}");
    let place =
        json!({ "inputs": [crank], "unknowns": [-73.444_902_47_f64.to_radians(), -130.077_900_4_f64.to_radians()] });
    let text = report(&mut page, 1, place);
    for part in [
        "2 modes on 2 motions, which form 2 circuits",
        "Circuit 2: mode 2, which this report follows.",
        "o turns by 360° each time the motion closes",
        "k goes from 0 (at t = 180°) to 1 (at t = 90°)",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// Both ends of a motion at which several groups lock at once, and the slider at each, name all of them.
#[test]
fn mirrored_ends_name_the_same_groups() {
    let mut page = Page::with(
        "mechanism Twin { param a = 3, b = 2, c = 2.5, d = 4; input t; unknown P, q, u, v; loop a@t + b@P = d@0 + c@q;
         loop (2*a)@t + (2*b)@u = (2*d)@0 + (2*c)@v; }",
    );
    let parameters = page.defaults(0);
    let at = page.begin(0, &parameters);
    let range = page.at(&at, &json!({ "do": "motion", "along": 0, "rate": 1.0, "steps": 4 }));
    let limit = json!({ "is": "change_point", "group": "P, q and u, v" });
    assert_eq!(range["ends"], json!([limit, limit]), "{range}");
    for input in [-3.0, 3.0] {
        let moved = follow(&mut page, &at, &parameters, input);
        assert_eq!(moved["stopped"], merged(&limit, &json!({ "input": 0 })), "{moved}");
    }
}

/// A chain of seven four-bars has 128 positions: some are listed and followed, and it is said that others are left out.
#[test]
fn many_positions_are_not_all_listed() {
    let loops = (1..=7).map(|bar| {
        let crank = if bar == 1 { "t".to_owned() } else { format!("(w{} + 0.3)", bar - 1) };
        format!("loop 1@{crank} + 4@c{bar} = 4@0 + 3@w{bar}; ")
    });
    let unknowns = (1..=7).map(|bar| format!("c{bar}, w{bar}")).collect::<Vec<_>>().join(", ");
    let text = format!("mechanism Chain {{ input t; unknown {unknowns}; {} }}", loops.collect::<String>());
    let mut page = Page::with(&text);
    let circuits = json!({ "do": "circuits", "mechanism": 0, "parameters": [], "inputs": [1.0], "along": 0 });
    let found = page.ask(&circuits);
    assert_eq!(found["more"], json!(true), "{found}");
    assert_eq!(found["motions"].as_array().map(Vec::len), Some(16), "{}", found["motions"]);
    let found = page.ask(&json!({ "do": "positions", "mechanism": 0, "parameters": [], "inputs": [1.0] }));
    assert_eq!((&found["more"], found["positions"].as_array().map(Vec::len)), (&json!(true), Some(64)), "{found}");
}
