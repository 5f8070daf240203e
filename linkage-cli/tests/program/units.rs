//! Units of what is printed: defaults, columns, axes and messages.

use serde_json::Value;

use super::folder::Folder;

const GEARED: &str = "mechanism Geared {
    param w = 60rpm, big = 7rad, a = 45deg, L = 2, k = 3, ratio = 0.5;
    input th in 10deg..100deg;
    unknown p, q;
    loop L@th + k@p = 4@0 + k@q;
    point P = L@th + k@p;
    output mu = (p - q)/2;
    output pulse_rate = ratio*L + w + big + a;
    body rod { mass ratio; inertia 1; center P; angle p; }
    scene drop { gravity (0, -g); force (F, 0) at P; inertia; }
    param g = 9.81, F = 4;
}";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("geared.linkage", GEARED);
    folder
}

/// A default is an argument: the table with it is that without.
#[test]
fn defaults_have_their_units() {
    let folder = folder();
    let names: Value = serde_json::from_str(&folder.run("names geared.linkage --format json").works("")).unwrap();
    let own = names[0]["parameters"].as_array().unwrap();
    let of_scene = names[0]["scenes"][0]["parameters"].as_array().unwrap();
    let table =
        |more: &str| folder.run(&format!("table geared.linkage --from 20deg --to 90deg --steps 2 {more}")).works("");
    let usual = table("");
    for of in own.iter().chain(of_scene) {
        let (name, default) = (of["name"].as_str().unwrap(), of["default"].as_str().unwrap());
        if ["w", "big", "a"].contains(&name) {
            assert_eq!(table(&format!("--set {name}={default}")), usual, "{name} {default}");
        }
        let kind = match name {
            "w" => "rate of an angle in rad/s",
            "big" | "a" => "angle in radians",
            "L" | "k" => "length",
            _ => "number",
        };
        assert_eq!(of["kind"], kind, "{name}");
    }
    let text = folder.run("names geared.linkage").works("");
    assert!(text.contains("  w      60rpm  rate of an angle in rad/s\n"), "{text}");
    let message = "error: `w` is a speed, and this is a unit of angles: write such as `45rpm`\n";
    folder.run("table geared.linkage --set w=60deg").fails(2, message);
}

/// An output that is half a difference of angles is an angle, in tables and on axes.
#[test]
fn outputs_that_are_angles_have_degrees() {
    let folder = folder();
    let run =
        |more: &str| folder.run(&format!("table geared.linkage --from 20deg --to 90deg --steps 4 {more}")).works("");
    let csv = run("--degrees --rate 6rpm --columns p,q,mu,p_rate,q_rate,mu_rate");
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("p [deg],q [deg],mu [deg],p_rate [deg/s],q_rate [deg/s],mu_rate [deg/s]"));
    for line in lines {
        let of: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let near = |one: f64, other: f64| (one - other).abs() <= 1e-13 * one.abs().max(360.0);
        assert!(near(of[2], (of[0] - of[1]) / 2.0) && near(of[5], (of[3] - of[4]) / 2.0), "{line}");
    }
    let page = "simulate geared.linkage --at th=60deg --to 0.1 --steps 4 -o page.html";
    let ran = folder.run(page);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let page = folder.read("page.html");
    // Coordinates and outputs have degrees, their rates a unit.
    assert!(page.contains("[rad/s]") && page.contains("[rad/s^2]"), "{page}");
    let chart = |title: &str| page.split("<svg").find(|svg| svg.contains(title)).unwrap_or_default();
    assert!(chart("mu over time").contains('°'), "{}", chart("mu over time"));
}

/// A table for readers has no columns that are zero; those for programs have all.
#[test]
fn a_table_at_rest_has_no_rates() {
    let folder = folder();
    let head = |more: &str| {
        let text = folder.run(&format!("table geared.linkage --from 20deg --to 90deg --steps 1 {more}")).works("");
        text.lines()
            .next()
            .unwrap_or_default()
            .split([' ', ','])
            .filter(|name| !name.is_empty())
            .collect::<Vec<_>>()
            .join(" ")
    };
    assert_eq!(head("--format text"), "th p q P_x P_y mu pulse_rate");
    assert!(head("--format text --rate 1").contains("p_rate") && head("").contains("p_rate"));
    assert_eq!(head("--format text --columns p_rate,p"), "p_rate p");
    let json = folder.run("table geared.linkage --from 20deg --to 90deg --steps 1 --format json").works("");
    assert!(json.contains("\"p_rate\""));
    let summary = folder.run("table geared.linkage --from 20deg --to 90deg --steps 4 --summary --format csv").works("");
    let names: Vec<&str> = summary.lines().skip(1).filter_map(|line| line.split(',').next()).collect();
    assert_eq!(names, ["p", "q", "P_x", "P_y", "mu", "pulse_rate"]);
}

/// An input that is neither an angle nor a length is a number.
#[test]
fn inputs_have_no_false_kind() {
    let folder = Folder::new();
    let text = "mechanism Odd { param a = 1; input x; unknown s; equation s + exp(s) = a*x; }";
    folder.write("odd.linkage", text);
    let message = "error: `x` is a plain number, and this is a unit of angles\n";
    folder.run("draw odd.linkage --at x=3deg --guess s=0").fails(2, message);
    let message = "error: `x` is a number and has no turn: write --to VALUE, or --curve\n";
    folder.run("certify odd.linkage --at x=3 --guess s=0").fails(2, message);
}
