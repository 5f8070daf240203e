//! Limits and circuits: against the law of cosines, and motions that are known.

use serde_json::Value;

use super::folder::{Folder, SLIDER_CRANK};

const FOUR_BAR: &str = "mechanism FourBar {
    param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
    input theta;
    unknown phi, psi;
    loop crank@theta + coupler@phi = ground@0 + rocker@psi;
}";

const PARALLEL: &str = "mechanism Parallel {
    param ground = 4, crank = 2;
    input theta;
    unknown phi, psi;
    loop crank@theta + ground@phi = ground@0 + crank@psi;
}";

/// Four angles are solved together.
const SIX_BAR: &str = "mechanism SixBar {
    param a = 1, bx = 0.5, by = -1, p = 4, q = 4.25, cd = 1.5, ex = 2, ey = 2, r = 2.5, gx = 5, gy = -2;
    input theta;
    unknown alpha, beta, tau, rho;
    let first = a@theta + p@alpha;
    loop first + cd@tau = (bx, by)@theta + q@beta;
    loop first + (ex, ey)@tau = (gx, gy) + r@rho;
}";

/// Its second input turns the ground.
const TWO_INPUTS: &str = "mechanism TwoInputs {
    param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
    input tilt, theta;
    unknown phi, psi;
    loop crank@theta + coupler@phi = ground@tilt + rocker@psi;
}";

fn folder() -> Folder {
    let folder = Folder::new();
    for (name, text) in [
        ("four", FOUR_BAR),
        ("parallel", PARALLEL),
        ("six", SIX_BAR),
        ("two", TWO_INPUTS),
        ("slider", SLIDER_CRANK),
        ("ranged", &FOUR_BAR.replace("input theta;", "input theta in -20deg..;")),
        ("odd", "mechanism Odd { param a = 1; input phi; unknown s; equation s + exp(s) = a*phi; }"),
    ] {
        folder.write(&format!("{name}.linkage"), text);
    }
    folder
}

fn json(folder: &Folder, arguments: &str) -> Value {
    serde_json::from_str(&folder.run(&format!("{arguments} --format json")).works("")).unwrap()
}

/// The angle at which crank and ground leave this distance.
fn angle_at(distance: f64) -> f64 {
    ((9.0 + 16.0 - distance * distance) / 24.0).acos()
}

fn close(one: &Value, other: f64) -> bool {
    one.as_f64().is_some_and(|one| (one - other).abs() <= 1e-13 * other.abs())
}

#[test]
fn limits_are_those_of_the_law_of_cosines() {
    let folder = folder();
    let (crank, text) = (angle_at(4.5), folder.run("limits four.linkage").works(""));
    let [end, name] = [format!("{:.5}", crank.to_degrees()), "(dead point of phi, psi)".to_owned()];
    for side in ["left", "right"] {
        let line = format!("  phi_psi={side}: theta from -{end}° {name} to {end}° {name}");
        assert!(text.lines().any(|other| other == line), "{line}\n{text}");
    }
    let of = json(&folder, "limits four.linkage");
    assert_eq!(of["positions"].as_array().map(Vec::len), Some(2));
    for position in of["positions"].as_array().unwrap() {
        assert!(close(&position["to"]["input"], crank) && close(&position["from"]["input"], -crank), "{position}");
        assert_eq!((&position["to"]["reason"], &position["to"]["group"]), (&"dead_point".into(), &"phi, psi".into()));
    }
    // One of them.
    let one = json(&folder, "limits four.linkage --branch phi_psi=right");
    assert_eq!(one["positions"].as_array().map(Vec::len), Some(1));
    // The other input is held, and turns all.
    let two = json(&folder, "limits two.linkage --along theta --at tilt=30deg --branch phi_psi=left");
    assert!(close(&two["positions"][0]["to"]["input"], crank + 30_f64.to_radians()), "{two}");
    // The nearer of a range and of a dead point.
    let ranged = folder.run("limits ranged.linkage --branch phi_psi=left").works("");
    assert!(ranged.contains(&format!("theta from -20° (the least value of theta) to {end}° {name}")), "{ranged}");
}

#[test]
fn limits_of_motions_that_go_on() {
    let folder = folder();
    let text = folder.run("limits parallel.linkage --branch phi_psi=left").works("");
    assert_eq!(text, "Parallel about theta = 60°\n  theta turns without limits, through change points at 180°, 360°\n");
    let of = json(&folder, "limits parallel.linkage");
    assert_eq!((&of["positions"][0]["from"], &of["positions"][0]["closes_after_turns"]), (&Value::Null, &1.into()));
    // Without a closed form: by a list, and by a guess.
    let listed = json(&folder, "limits six.linkage");
    assert_eq!(listed["positions"].as_array().map(Vec::len), Some(4));
    let guess = "--at theta=0 --guess alpha=-30deg,beta=-30deg,tau=-105deg,rho=-70deg";
    let guessed = folder.run(&format!("limits six.linkage {guess}")).works("");
    assert_eq!(guessed, "SixBar about theta = 0°\n  theta turns without limits\n");
    let odd = folder.run("limits odd.linkage --guess s=0 --at phi=1").works("");
    assert!(odd.contains("phi from ") && odd.contains("(it goes on)"), "{odd}");
    // A slider stops where crank and rod are in line.
    let slider = json(&folder, "limits slider.linkage --mechanism Piston --at s=3");
    assert!(close(&slider["positions"][0]["from"]["input"], 2.0), "{slider}");
    assert!(close(&slider["positions"][0]["to"]["input"], 4.0), "{slider}");
}

#[test]
fn circuits_join_positions() {
    let folder = folder();
    let of = json(&folder, "circuits four.linkage --at theta=20deg");
    assert_eq!((&of["circuits"], &of["motions"][0]["kind"]), (&serde_json::json!([[1]]), &"to_and_fro".into()));
    assert_eq!(of["motions"][0]["positions"], serde_json::json!([1, 2]));
    assert!(close(&of["motions"][0]["largest"], angle_at(4.5)), "{of}");
    let event = &of["motions"][0]["events"][0];
    assert!(close(&event["input"], angle_at(4.5)) && event["positions"] == serde_json::json!([1, 2]), "{event}");
    // Two motions cross at 0 and at 180 degrees.
    let text = folder.run("circuits parallel.linkage --at theta=60deg").works("");
    let expected = "\
Parallel: 2 positions, 2 motions, 1 circuit

positions
  1  motion 1: theta = 60°, phi_psi=left
  2  motion 2: theta = 60°, phi_psi=right

motion 1: theta turns fully
  passes position 1
  change point of phi, psi at theta = 180°
  change point of phi, psi at theta = 360°

motion 2: theta turns fully
  passes position 2
  change point of phi, psi at theta = 180°
  change point of phi, psi at theta = 360°

circuit 1: motions 1, 2
";
    assert_eq!(text, expected);
    // Over a turn, a motion that passes many of the values is found once.
    let over = json(&folder, "circuits six.linkage");
    assert_eq!(over["motions"].as_array().map(Vec::len), Some(3));
    let kinds: Vec<&Value> = over["motions"].as_array().unwrap().iter().map(|motion| &motion["kind"]).collect();
    assert_eq!(kinds.iter().filter(|kind| **kind == "turns").count(), 2);
    let held = folder.run("circuits two.linkage --along theta --at tilt=30deg,theta=50deg -o two.txt");
    held.works("wrote two.txt\n");
    assert!(folder.read("two.txt").starts_with("TwoInputs with tilt = 30°: 2 positions, 1 motion, 1 circuit\n"));
    folder.run("circuits four.linkage -o four.json").works("wrote four.json\n");
    assert!(folder.read("four.json").starts_with('{'));
    let slider = json(&folder, "circuits slider.linkage --mechanism Piston --at s=3");
    assert_eq!(slider["motions"][0]["positions"], serde_json::json!([1, 2]));
    let ranged = folder.run("circuits ranged.linkage --at theta=0").works("");
    assert!(ranged.contains("at the ends of ranges") && ranged.contains("the least value of theta at theta = -20°"));
}

/// The charts of the library, whose numbers begin at 1 as those of the list do.
#[test]
fn circuits_have_charts() {
    let folder = folder();
    folder.run("circuits four.linkage --at theta=20deg -o four.html").works("wrote four.html\n");
    let page = folder.read("four.html");
    assert!(page.contains("<h1>FourBar</h1>") && page.contains("circuit 1: modes 1, 2, 2 dead points"), "{page}");
    assert!(page.contains("phi over theta, one circuit") && page.contains("psi over theta, one circuit"), "{page}");
    assert!(page.contains("motion 1: theta goes to and fro"), "{page}");
    folder.run("circuits four.linkage --chart psi -o four.svg").works("wrote four.svg\n");
    let chart = folder.read("four.svg");
    // The linkage is drawn at both dead points.
    assert!(chart.starts_with("<svg") && chart.contains("psi over theta, one circuit"), "{chart}");
    assert_eq!((chart.matches("</svg>").count(), chart.matches("class=\"bar driven\"").count()), (1, 2), "{chart}");
    // One of two inputs moves.
    let two = "circuits two.linkage --along theta --at tilt=30deg,theta=50deg --format svg";
    assert!(folder.run(two).works("").contains("one circuit of 2 modes"));
    for (arguments, message) in [
        ("--chart phi", "charts are HTML or SVG: write -o NAME.html or NAME.svg, or leave out --chart"),
        ("--chart phi,psi -o four.svg", "a picture has one chart: write one --chart, or -o NAME.html"),
        (
            "--chart theta -o four.svg",
            "FourBar has no unknown `theta`: it has `phi` and `psi`; `linkage names` lists all names",
        ),
    ] {
        folder.run(&format!("circuits four.linkage {arguments}")).fails(2, &format!("error: {message}\n"));
    }
}

#[test]
fn wrong_arguments_of_motions() {
    let folder = folder();
    for (arguments, code, message) in [
        (
            "circuits four.linkage --at theta=1 --from 0",
            2,
            "--at theta is one value, and --from and --to a range: leave out one",
        ),
        ("circuits four.linkage --from 1 --to 1", 2, "--from is less than --to"),
        ("circuits slider.linkage --mechanism Piston", 2, "`s` is a length: write --at s=VALUE, or --from and --to"),
        (
            "circuits four.linkage -o four.csv",
            2,
            "a list of circuits is text, JSON, HTML or SVG: write -o NAME.txt, NAME.json, NAME.html or NAME.svg, not `.csv`",
        ),
        (
            "circuits parallel.linkage --at theta=0",
            1,
            "from position 1, motions of Parallel cross at a change point of phi, psi: write another --at",
        ),
        (
            "limits parallel.linkage --at theta=0",
            1,
            "at theta = 0°, motions of Parallel cross at a change point of phi, psi: write another --at",
        ),
        (
            "limits two.linkage --along psi",
            2,
            "TwoInputs has no input `psi`: it has `tilt` and `theta`; `linkage names` lists all names",
        ),
        ("limits slider.linkage --mechanism Piston", 2, "the input `s` has no value: write --at s=VALUE"),
    ] {
        folder.run(arguments).fails(code, &format!("error: {message}\n"));
    }
    // No position: the reason is that of the first branch.
    for command in ["limits four.linkage --at theta=80deg", "circuits four.linkage --at theta=80deg"] {
        let ran = folder.run(command);
        assert_eq!((ran.code, ran.messages.lines().count()), (Some(1), 1), "{ran:?}");
        assert!(ran.messages.starts_with("error: FourBar cannot be assembled at theta = 80°"), "{}", ran.messages);
    }
    let odd = folder.run("circuits odd.linkage --at phi=1");
    assert_eq!((odd.code, odd.messages.lines().count()), (Some(1), 1), "{odd:?}");
}
