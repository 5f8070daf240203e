//! Certificates: what is proved, against the law of cosines; what is not, with the reason.

use std::f64::consts::{PI, TAU};

use serde_json::Value;

use super::folder::{Folder, SLIDER_CRANK};

const CRANK_ROCKER: &str = "mechanism CrankRocker {
    param ground = 4, crank = 1, coupler = 3, rocker = 3;
    input theta;
    unknown phi, psi in 40deg..170deg;
    loop crank@theta + coupler@phi = ground@0 + rocker@psi;
    point A = crank@theta;
    output mu = psi - phi;
}";

/// The crank goes to and fro.
const ROCKER: &str = "mechanism Rocker {
    param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
    input tilt, theta;
    unknown phi, psi;
    loop crank@theta + coupler@phi = ground@tilt + rocker@psi;
}";

/// A full turn ends on another mode.
const TRIAD: &str = "mechanism Triad {
    param a = 4.9, b = 1.23, c = 4.18, d = 1.52, px = 0.83, py = -2.31, e = 4.26, f = 2.25, fx = 2.04, fy = 1.17;
    input theta;
    unknown alpha, beta, gamma, epsilon;
    loop a@alpha + b@beta = d@0 + c@gamma;
    loop a@alpha + (px, py)@beta + e@epsilon = (fx, fy) + f@theta;
}";

fn folder() -> Folder {
    let folder = Folder::new();
    for (name, text) in [
        ("crank", CRANK_ROCKER),
        ("rocker", ROCKER),
        ("triad", TRIAD),
        ("slider", SLIDER_CRANK),
        ("wheel", "mechanism Wheel { input theta; unknown psi; equation 2*psi = theta; point P = 1@theta + 1@psi; }"),
        (
            "parallel",
            "mechanism Parallel {
            param ground = 4, crank = 2;
            input theta;
            unknown phi, psi;
            loop crank@theta + ground@phi = ground@0 + crank@psi;
        }",
        ),
    ] {
        folder.write(&format!("{name}.linkage"), text);
    }
    folder
}

fn json(folder: &Folder, arguments: &str) -> Value {
    serde_json::from_str(&folder.run(&format!("{arguments} --format json")).works("")).unwrap()
}

/// The two numbers between which a value is proved to be.
fn contains(between: &Value, value: f64) -> bool {
    let end = |place: usize| between[place].as_f64().unwrap();
    end(0) <= value && value <= end(1)
}

#[test]
fn a_turn_is_proved() {
    let folder = folder();
    insta::assert_snapshot!("a_turn", folder.run("certify crank.linkage").works(""));
    let of = json(&folder, "certify crank.linkage --branch phi_psi=right");
    assert_eq!((&of["end"]["kind"], &of["input"]), (&"closed".into(), &"theta".into()));
    // The distance of the pins is ground +- crank; the branch has the other sign of the angle. Of both turns of psi, which are out
    // of its range, the one is a part of mu that is nearer to the range.
    let mu = |distance: f64| ((9.0 + 9.0 - distance * distance) / 18.0).acos();
    let found = &of["quantities"][2];
    assert_eq!((&found["name"], &found["is_angle"], &found["is_sharp"]), (&"mu".into(), &true.into(), &true.into()));
    assert!(contains(&found["least"], TAU - mu(5.0)) && contains(&found["largest"], TAU - mu(3.0)), "{found}");
    // With tolerances there are more mechanisms, and more values.
    let wide = json(&folder, "certify crank.linkage --tolerance 0.1%");
    let width = |of: &Value| {
        of["quantities"][2]["least"][1].as_f64().unwrap() - of["quantities"][2]["least"][0].as_f64().unwrap()
    };
    assert!(width(&wide) > 1e-4 && width(&of) < 1e-8);
    assert!(wide["statement"].as_str().unwrap().ends_with(", for all parameters within their tolerances"));
}

#[test]
fn a_range_is_proved() {
    let folder = folder();
    let text = folder.run("certify crank.linkage --from 20deg --to 90deg").works("");
    assert!(text.starts_with("CrankRocker: one motion without dead points, theta from 20° to 90°\n"), "{text}");
    // A length has no turn; the crank is at rest at neither end.
    let slider = folder.run("certify slider.linkage --mechanism Piston --from 3 --to 3.5").works("");
    assert!(slider.starts_with("Piston: one motion without dead points, s from 3 to 3.5\n"), "{slider}");
    // The range of psi is left on the other branch.
    let left = folder.run("certify crank.linkage --branch phi_psi=right --from 20deg --to 30deg").works("");
    let kept = folder.run("certify crank.linkage --branch phi_psi=left --from 20deg --to 30deg").works("");
    assert!([&left, &kept].iter().any(|text| text.contains("psi stays in its range\n")), "{left}{kept}");
    assert!([&left, &kept].iter().any(|text| text.contains("psi goes above its range\n")), "{left}{kept}");
}

#[test]
fn a_curve_goes_through_dead_points() {
    let folder = folder();
    let curve = "certify rocker.linkage --along theta --at tilt=30deg,theta=60deg --curve";
    insta::assert_snapshot!("a_curve", folder.run(curve).works(""));
    let of = json(&folder, curve);
    let limit = ((9.0 + 16.0 - 4.5_f64 * 4.5) / 24.0).acos();
    let at = |sign: f64| 30_f64.to_radians() + sign * limit;
    let points = of["dead_points"].as_array().unwrap();
    let near = |of: &Value, value: f64| (of["input"][0].as_f64().unwrap() - value).abs() < 1e-12;
    assert!(points.iter().any(|of| near(of, at(1.0)) && of["is_largest"] == true), "{of}");
    assert!(points.iter().any(|of| near(of, at(-1.0)) && of["is_largest"] == false), "{of}");
}

#[test]
fn other_ends_of_a_turn() {
    let folder = folder();
    // The positions have numbers from 0.
    let arrives = folder.run("certify triad.linkage --at theta=0 --branch alpha_beta_gamma_epsilon=1").works("");
    let end = "to the position with the number 3 of those given\nposition 3 is alpha_beta_gamma_epsilon=3\n";
    assert!(arrives.contains(end), "{arrives}");
    // A wheel is at its start after two turns.
    let wheel = |turns: u32| folder.run(&format!("certify wheel.linkage --turns {turns}")).works("");
    assert!(
        !wheel(1).contains("at its start again") && wheel(2).contains("theta from 60° to 780°, at its start again")
    );
}

#[test]
fn what_is_not_proved() {
    let folder = folder();
    for (arguments, code, message) in [
        (
            "certify rocker.linkage --along theta --at tilt=0",
            1,
            "not certified: theta turns back at 78.584842°, a dead point of phi, psi; --curve goes through it",
        ),
        (
            "certify parallel.linkage",
            1,
            "not certified: at theta = 180° there is a change point or a dead point of phi, psi, or nearly so",
        ),
        (
            "certify parallel.linkage --at theta=0",
            1,
            "not certified: theta = 0° is a dead point or a change point of phi, psi, or nearly so: write another --at",
        ),
        (
            "certify crank.linkage --from 1 --at theta=1",
            2,
            "--at theta and --from are both the first value: leave out one",
        ),
        ("certify crank.linkage --from 1 --to 1", 2, "--to is the first value of `theta`"),
        (
            "certify slider.linkage --mechanism Piston --at s=3",
            2,
            "`s` is a length and has no turn: write --to VALUE, or --curve",
        ),
        (
            "certify crank.linkage -o crank.csv",
            2,
            "a certificate is text or JSON: write -o NAME.txt or NAME.json, not `.csv`",
        ),
    ] {
        folder.run(arguments).fails(code, &format!("error: {message}\n"));
    }
    let part = folder.run("certify crank.linkage --tolerance 120%");
    assert!(part.code == Some(2) && part.messages.contains("write a part from 0 to less than 1"), "{part:?}");
    let cam = "mechanism Cam { input phi; unknown s; extern fn lift(phi) -> (l, l1, l2); equation s = l(phi); }";
    folder.write("cam.linkage", cam);
    let message = "error: `Cam` calls `l`, which a program in Rust has to give it\n";
    folder.run("certify cam.linkage").fails(1, message);
}

/// The numbers after a name in a line of the table of a certificate.
fn bounds(text: &str, name: &str) -> [String; 2] {
    let line = text.lines().find(|line| line.trim_start().starts_with(&format!("{name} "))).unwrap_or(text);
    let parts: Vec<&str> = line.trim().split("  ").filter(|part| !part.is_empty()).collect();
    [parts[1], parts[2]].map(|part| part.trim().to_owned())
}

/// The least value of the table is not above the least one, the largest not below the largest one, each with its own digits.
#[test]
fn bounds_are_rounded_outward() {
    let folder = folder();
    let text = "mechanism M { param a = 40, b = 120, c = 80, d = 100; input t; unknown p, q; \
                loop a@t + b@p = d@0 + c@q; output g = exp(1/(1.01 + cos(t))); output h = cos(t)/3; \
                output i = 1e-9*cos(t)/3; output j = atan2(sin(t), 2 + cos(t)); }";
    folder.write("m.linkage", text);
    let shown = folder.run("certify m.linkage --at t=40deg").works("");
    let found = json(&folder, "certify m.linkage --at t=40deg");
    let quantities = found["quantities"].as_array().unwrap().iter().chain(found["velocity_ratios"].as_array().unwrap());
    for of in quantities {
        let [least, largest] = bounds(&shown, of["name"].as_str().unwrap());
        let unit = if of["is_angle"] == true { 1_f64.to_degrees() } else { 1.0 };
        let end = |text: &str, place: usize| -> f64 {
            let ends: Vec<&str> = text.trim_end_matches('°').split(" to ").collect();
            ends[place.min(ends.len() - 1)].parse().unwrap()
        };
        // Of an interval in degrees the ends are rounded outward before.
        let error = |value: f64| 4.0 * f64::EPSILON * value.abs();
        let proved = |side: &str, place: usize| of[side][place].as_f64().unwrap() * unit;
        let (low, high) = (proved("least", 0), proved("largest", 1));
        assert!(end(&least, 0) <= low + error(low) && end(&largest, 1) >= high - error(high), "{of} {shown}");
        assert!((end(&least, 0) - low).abs() <= 2e-7 * low.abs(), "{of} {shown}");
        assert!((end(&largest, 1) - high).abs() <= 2e-7 * high.abs(), "{of} {shown}");
    }
    // exp(1/2.01), exp(100), 1/3: computed independently.
    let [least, largest] = bounds(&shown, "g");
    assert!(least.starts_with("1.6446") && largest == "2.6881172e43", "{shown}");
    assert_eq!(bounds(&shown, "h"), ["-0.33333334", "0.33333334"]);
    assert_eq!(bounds(&shown, "i"), ["-3.3333334e-10", "3.3333334e-10"]);
    assert_eq!(bounds(&shown, "j"), ["-30.000001°", "30.000001°"]);
    // With tolerances a dead point has two ends.
    let curve =
        folder.run("certify rocker.linkage --along theta --at tilt=0,theta=60deg --curve --tolerance 0.2%").works("");
    let line = |start: &str| curve.lines().find(|line| line.contains(start)).unwrap_or_default().to_owned();
    assert_eq!(line("turns back at").matches(" to ").count(), 2, "{curve}");
    assert!(line("largest theta").contains(" to ") && line("least theta").contains(" to -"), "{curve}");
    // With wider ones one of the two dead points is not found for sure: nothing is proved.
    let wide = folder.run("certify rocker.linkage --along theta --at tilt=0,theta=60deg --curve --tolerance 0.5%");
    assert!(wide.code == Some(1) && wide.messages.contains("the bounds are too wide"), "{wide:?}");
}

/// Without `--to`, a motion goes over the declared range of its input.
#[test]
fn a_declared_range_is_that_of_the_motion() {
    let folder = folder();
    for (name, input, ends) in [
        ("both", "input theta in 20deg..90deg;", "20° to 90°"),
        ("capital", "param T = 0.5; input theta in -T..T;", "-28.64789° to 28.64789°"),
        ("largest", "input theta in ..90deg;", "-270° to 90°"),
    ] {
        folder.write(&format!("{name}.linkage"), CRANK_ROCKER.replace("input theta;", input));
        let text = folder.run(&format!("certify {name}.linkage")).works("");
        assert!(text.contains(&format!("without dead points, theta from {ends}\n")), "{text}");
        assert!(text.contains("theta stays in its range"), "{text}");
    }
    let at = folder.run("certify both.linkage --at theta=50deg").works("");
    assert!(at.contains("theta from 50° to 90°\n"), "{at}");
    let whole = folder.run("certify both.linkage --turns 1").works("");
    assert!(
        whole.contains("theta from 55° to 415°, at its start again") && whole.contains("theta goes above its range"),
        "{whole}"
    );
    let slider = "mechanism Cylinder { param a = 2, b = 3; input s in 2..4.5; unknown p, q; loop a@p = b@0 + s@q; point P = a@p; }";
    folder.write("cylinder.linkage", slider);
    let text = folder.run("certify cylinder.linkage").works("");
    assert!(text.contains("s from 2 to 4.5\n") && text.contains("s stays in its range\n"), "{text}");
}

/// An angle by `atan2` goes on at pi, as in a report: one turns, others go to and fro about 180 degrees.
#[test]
fn bounds_of_angles_go_on_at_the_cut() {
    let folder = folder();
    folder.write(
        "cut.linkage",
        "mechanism Cut { param a = 2, b = 5, c = 4, d = 5; input t; unknown p, s; loop a@t + b@p = d@0 + c@s; \
         point B = a@t; point C = (3, 4)@s; output o = angle(B); output twice = 2*angle(B); \
         output swing = angle(C); output half = angle(C)/2; }",
    );
    let of = json(&folder, "certify cut.linkage --at t=40deg");
    assert_eq!(of["within_a_turn"], Value::Array(Vec::new()));
    let is = |name: &str, ends: [f64; 2]| {
        let bounds = of["quantities"].as_array().unwrap().iter().find(|of| of["name"] == name).unwrap();
        assert_eq!(bounds["is_sharp"], true, "{bounds}");
        for (side, end) in ["least", "largest"].into_iter().zip(ends) {
            assert!([0, 1].iter().all(|at| (bounds[side][at].as_f64().unwrap() - end).abs() < 1e-7), "{bounds} {end}");
        }
    };
    let start = 40_f64.to_radians();
    is("o", [start, start + TAU]);
    is("twice", [2.0 * start, 2.0 * (start + TAU)]);
    // The rocker is at its ends where crank and coupler are in line.
    let end = |distance: f64| PI - ((25.0 + 16.0 - distance * distance) / 40.0).acos() + 4_f64.atan2(3.0);
    is("swing", [7.0, 3.0].map(end));
    is("half", [7.0, 3.0].map(|distance| 0.5 * end(distance)));
    let report = folder.run("report cut.linkage").works("");
    for line in ["o turns by 360°", "twice turns by 720°", "swing goes from 131.5931°", "to 196.2602°"] {
        assert!(report.contains(line), "{report}");
    }
    // The coupler turns while the crank goes to and fro.
    folder.write(
        "turns.linkage",
        "mechanism Turns { param ground = 4, crank = 3, coupler = 1, rocker = 3.5; input theta; unknown phi, psi; \
         loop crank@theta + coupler@phi = ground@0 + rocker@psi; point P = coupler@phi; output o = angle(P); }",
    );
    let of = json(&folder, "certify turns.linkage --at theta=60deg --curve");
    let o = &of["quantities"][2];
    let turned = o["largest"][1].as_f64().unwrap() - o["least"][0].as_f64().unwrap();
    assert!(o["is_sharp"] == true && (TAU..TAU + 1.0).contains(&turned), "{of}");
    // A point that comes to the origin has no direction there.
    folder.write(
        "origin.linkage",
        "mechanism Origin { input t; unknown p; equation p = t; point B = (1, 0) + 1@t; output o = angle(B); }",
    );
    let text = folder.run("certify origin.linkage --at t=40deg").works("");
    assert!(text.contains("these are bounds of one turn\n"), "{text}");
}
