//! Tables, pictures and films: their numbers are those of the macro.

use linkage::{Elbow, Table};

use super::folder::{Folder, SLIDER_CRANK};

/// One text for the program and for the macro.
macro_rules! both {
    ($($tokens:tt)*) => {
        linkage::linkage! { $($tokens)* }

        const TEXT: &str = stringify!($($tokens)*);
    };
}

both! {
    mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point B = l2@theta2;
        point C = B + l3@theta3;
        output transmission = theta4 - theta3;
    }
}

const FIVE_BAR: &str = "mechanism FiveBar {
    param a = 1, b = 4, d;
    input left, right;
    unknown phi, psi;
    loop a@left + b@phi = d@0 + a@right + b@psi;
    point P = a@left + b@phi;
}";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("four.linkage", TEXT);
    folder.write("five.linkage", FIVE_BAR);
    folder
}

/// The numbers of a CSV by columns, with their names.
fn columns(csv: &str) -> Vec<(String, Vec<f64>)> {
    let mut lines = csv.lines();
    let heads = lines.next().unwrap().split(',');
    let mut columns: Vec<(String, Vec<f64>)> = heads.map(|head| (head.to_owned(), Vec::new())).collect();
    for line in lines {
        for ((_, numbers), cell) in columns.iter_mut().zip(line.split(',')) {
            numbers.push(cell.parse().unwrap_or(f64::NAN));
        }
    }
    columns
}

#[test]
fn a_turn_is_that_of_the_macro() {
    let folder = folder();
    let own = columns(&folder.run("table four.linkage --steps 36 --rate 10 --branch theta3_theta4=right").works(""));
    let mechanism = FourBar::default();
    let table = Table::turn(&mechanism, FourBarBranch::new(Elbow::Right), 36, 10.0).unwrap();
    let emitted = columns(&table.unit("time", "s").unwrap().to_csv());
    assert_eq!(own.len(), emitted.len());
    for ((name, own), (other, emitted)) in own.iter().zip(&emitted) {
        assert_eq!((name, own.len()), (other, 37));
        // Both follow the motion, and have the position in closed form.
        for (one, other) in own.iter().zip(emitted) {
            assert_eq!(one, other, "{name}");
        }
    }
}

#[test]
fn tables() {
    let folder = folder();
    let asked =
        "table four.linkage --set l2=25 --from=-90deg --to 90deg --steps 2 --degrees --columns theta2,C_x --digits 6";
    let csv = folder.run(asked).works("");
    assert_eq!(csv, "theta2 [deg],C_x\n-90,13.8969\n0,30.6818\n90,38.7721\n");
    let json = folder.run("table four.linkage --steps 1 --format json -o four.json").works("wrote four.json\n");
    assert_eq!(json, "");
    assert!(folder.read("four.json").contains("\"theta3\""));
    // Two inputs: one moves, the other is held.
    let five = columns(&folder.run("table five.linkage --set d=3 --at left=120deg --steps 4").works(""));
    assert_eq!((five[0].0.as_str(), five[1].0.as_str()), ("left", "right"));
    assert!(five[0].1.iter().all(|left| *left == 120_f64.to_radians()));
    assert_eq!(five[1].1.len(), 5);
    // Rows without a position are empty, and one message says why.
    let long = folder.run("table four.linkage --set l2=45 --steps 4 --columns theta2,C_x");
    assert_eq!(long.code, Some(0));
    assert_eq!(long.messages.lines().count(), 1, "{}", long.messages);
    let message = "1 of 5 rows have no position; the motion of FourBar ends at theta2 = 146.0845° and 213.9155° (dead point of \
                   theta3, theta4)\n";
    assert_eq!(long.messages, message);
    assert!(long.output.lines().nth(3).is_some_and(|row| row.ends_with(',')), "{}", long.output);
}

#[test]
fn names_and_values_that_do_not_exist() {
    let folder = folder();
    for (arguments, message) in [
        (
            "table four.linkage --set l33=2",
            "FourBar has no parameter `l33`: it has `l1`, `l2`, `l3` and `l4`; `linkage names` lists all names",
        ),
        (
            "table four.linkage --at theta=2",
            "FourBar has no input `theta`, did you mean `theta2`? `linkage names` lists all names",
        ),
        ("draw four.linkage --branch theta3_theta4=up", "`theta3_theta4` is `left` or `right`, not `up`"),
        (
            "draw four.linkage --branch theta3theta4=left",
            "FourBar has no group with several positions `theta3theta4`, did you mean `theta3_theta4`? `linkage names` lists \
             all names",
        ),
        (
            "table four.linkage --columns C_z",
            "the table has no column `C_z`; near names: `C_x` and `C_y`; `linkage names` lists all columns",
        ),
        ("draw five.linkage", "the parameter `d` has no value: write --set d=VALUE"),
        ("animate four.linkage --seconds 0", "a film takes more than 0 and at most 600 seconds"),
        (
            "draw four.linkage --at theta2=45rpm",
            "`theta2` is an angle, and `rpm` is a unit of speeds: write such as `60deg`",
        ),
        ("draw four.linkage --set l2=30deg", "`l2` is a length, and this is a unit of angles: write a plain number"),
        ("table four.linkage --rate 45deg", "--rate is a speed, and this is a unit of angles: write such as `45rpm`"),
        (
            "animate four.linkage --rate 3000rpm",
            "at this --rate the film takes 0.020 seconds: for slow motion write --seconds",
        ),
        ("table four.linkage --from 1 --to 1", "--from and --to are equal"),
        ("table four.linkage --at theta2=1", "each input is held: leave out one --at"),
        ("draw four.linkage -o four.pdf", "a picture is SVG or PNG: write -o NAME.svg or NAME.png, not `.pdf`"),
        ("animate four.linkage -o four.mp4", "a film is SVG or GIF: write -o NAME.svg or NAME.gif, not `.mp4`"),
    ] {
        folder.run(arguments).fails(2, &format!("error: {message}\n"));
    }
    folder.write("piston.linkage", SLIDER_CRANK);
    let ran = folder.run("table piston.linkage --mechanism Piston");
    ran.fails(2, "error: `s` is a length: write --from and --to\n");
    let csv = folder.run("table piston.linkage --mechanism Piston --from 2.5 --to 3.5 --steps 1 --columns s").works("");
    assert_eq!(csv, "s\n2.5\n3.5\n");
    for arguments in ["--set l2", "--set l2=25mm", "--steps 0", "--steps 1000000000", "--rate fast"] {
        let ran = folder.run(&format!("table four.linkage {arguments}"));
        assert_eq!((ran.code, ran.output.as_str()), (Some(2), ""), "{arguments}");
    }
    assert_eq!(folder.names(), ["five.linkage", "four.linkage", "piston.linkage"]);
}

/// A position that needs a guess, or a function in Rust.
#[test]
fn what_the_program_cannot_compute() {
    let folder = Folder::new();
    folder.write(
        "cam.linkage",
        "mechanism Cam { extern fn rise(phi) -> (lift, slope, bend, change); input phi; unknown s; equation s = lift(phi); point P = s@0; }",
    );
    let ran = folder.run("draw cam.linkage");
    assert_eq!((ran.code, ran.output.as_str()), (Some(1), ""), "{}", ran.messages);
    assert_eq!(ran.messages, "error: `Cam` calls `lift`, which a program in Rust has to give it\n");
    folder.write(
        "odd.linkage",
        "mechanism Odd { param a = 1; input phi; unknown s; equation s + exp(s) = a*phi; point P = s@0; }",
    );
    let ran = folder.run("table odd.linkage --from 0 --to 1");
    ran.fails(2, "error: positions of `Odd` are found from a guess: write --guess s=VALUE\n");
}

/// There is no position: one message, and the old file is as it was.
#[test]
fn no_position() {
    let folder = folder();
    folder.write("four.svg", "old");
    folder.write("four.csv", "old");
    let message =
        |at: &str| format!("error: FourBar cannot be assembled at theta2 = {at}: group theta3, theta4 does not close");
    for (arguments, at) in [
        ("draw four.linkage --set l2=300", "60°"),
        ("animate four.linkage --set l2=300", "0°"),
        ("table four.linkage --set l2=300 -o four.csv", "0°"),
    ] {
        let ran = folder.run(arguments);
        assert_eq!((ran.code, ran.messages.lines().count()), (Some(1), 1), "{ran:?}");
        assert!(ran.messages.starts_with(&message(at)), "{}", ran.messages);
    }
    assert_eq!([folder.read("four.svg"), folder.read("four.csv")], ["old", "old"]);
}

#[test]
fn pictures() {
    let folder = folder();
    folder.run("draw four.linkage").works("wrote four.svg\n");
    let still = folder.read("four.svg");
    assert!(still.starts_with("<svg") && still.contains("\nC\n") && !still.contains("animateTransform"));
    folder.run("animate four.linkage -o film.svg").works("wrote film.svg\n");
    assert!(folder.read("film.svg").contains("animateTransform"));
    folder.run("draw four.linkage --at theta2=20deg -o four.png").works("wrote four.png\n");
    assert!(std::fs::read(folder.path("four.png")).unwrap().starts_with(b"\x89PNG\r\n"));
    assert!(folder.run_with("draw - -o -", TEXT).works("").starts_with("<svg"));
}

/// A film has its frames, takes its seconds and repeats.
#[test]
fn films() {
    let folder = folder();
    folder.run("animate four.linkage --steps 5 --seconds 1.5 -o four.gif").works("wrote four.gif\n");
    let file = std::fs::File::open(folder.path("four.gif")).unwrap();
    let mut film = gif::DecodeOptions::new().read_info(file).unwrap();
    assert_eq!((film.width(), film.height(), film.repeat()), (720, 540, gif::Repeat::Infinite));
    let mut delays = Vec::new();
    while let Some(frame) = film.read_next_frame().unwrap() {
        delays.push(frame.delay);
    }
    assert_eq!(delays, [30; 5]);
}
