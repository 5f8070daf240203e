//! Sheets with numbers, drawings of several loops, and films.

use std::fs::File;

use super::folder::{Folder, SLIDER_CRANK};

const FOUR_BAR: &str = "mechanism FourBar {
    param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
    input theta2;
    unknown theta3, theta4;
    loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
    point B = l2@theta2;
    point C = B + l3@theta3;
}";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("four.linkage", FOUR_BAR);
    folder
}

/// The numbers of the sheet that the library prints for the emitted mechanism, at 20 degrees and 400 rpm.
#[test]
fn a_sheet_has_the_numbers_of_a_position() {
    let folder = folder();
    let text = folder.run("sheet four.linkage --at theta2=20deg --rate 400rpm --format text -o -").works("");
    for line in [
        "Given    l₁ = 80, l₂ = 20, l₃ = 50, l₄ = 70",
        "  Ψ₁ = l₂·cos(θ₂) + l₃·cos(θ₃) + l₄·cos(θ₄) − l₁\n",
        "Δ² = Δ_x² + Δ_y²  ≈ 3792.984",
        "det J = −l₃·l₄·sin(θ₃ − θ₄)  ≈ −2999.56",
        "theta3_rate  −18.42528",
        "theta4_acceleration  584.7108",
        "x_C_rate     582.1639",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
    let right = "sheet four.linkage --at theta2=20deg --branch theta3_theta4=right --format text -o -";
    assert!(folder.run(right).works("").contains("det J = −l₃·l₄·sin(θ₃ − θ₄)  ≈ 2999.56"));
    // Without a rate there are no velocities.
    assert!(!folder.run(right).works("").contains("theta3_rate"));
    folder.run("sheet four.linkage --set l2=25 -o four.tex").works("wrote four.tex\n");
    let latex = folder.read("four.tex");
    assert!(latex.starts_with("\\documentclass") && latex.contains("$l_2 = 25$"), "{latex}");
    folder.run("sheet four.linkage --set l2=25").works("wrote four.html\n");
    let page = folder.read("four.html");
    assert!(page.contains("<figcaption>The position at theta2 = 60°</figcaption>") && page.contains("<mn>25</mn>"));
    // Values are written also where there is no position, unless it is asked for.
    let ran = folder.run("sheet four.linkage --set l2=300 -o four.txt");
    assert!(ran.messages.starts_with("the sheet has no numbers of a position: FourBar cannot"), "{ran:?}");
    assert!(ran.code == Some(0) && folder.read("four.txt").contains("l₂ = 300"));
    assert_eq!(folder.run("sheet four.linkage --set l2=300 --at theta2=1").code, Some(1));
    let message = "error: slider.linkage has `Crank` and `Piston`: write --mechanism NAME\n";
    folder.write("slider.linkage", SLIDER_CRANK);
    folder.run("sheet slider.linkage --at phi=1").fails(2, message);
}

/// The words of a sheet are Italian, formulas and names are those of the file.
#[test]
fn a_sheet_is_in_italian() {
    let folder = folder();
    let command = "sheet four.linkage --at theta2=20deg --rate 400rpm --language it";
    let text = folder.run(&format!("{command} --format text -o -")).works("");
    for line in [
        "\n  Dati       l₁ = 80, l₂ = 20, l₃ = 50, l₄ = 70\n",
        "Gruppo 1, diade RRR: due angoli: equazioni (1), (2)\n",
        "è positiva sul ramo Left, negativa su Right.\n",
        "det J = −l₃·l₄·sin(θ₃ − θ₄)  ≈ −2999.56\n",
        "\n  Velocità\n    theta2_rate  41.8879\n",
        "\n  Angoli in gradi\n",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
    folder.run(command).works("wrote four.html\n");
    let page = folder.read("four.html");
    assert!(page.contains("<html lang=\"it\">"));
    assert!(page.contains("<figcaption>La posizione per theta2 = 20°</figcaption>"));
    folder.run(&format!("{command} -o four.tex")).works("wrote four.tex\n");
    assert!(folder.read("four.tex").contains("\\subsection*{Equazioni di chiusura}"));
    assert!(folder.run("sheet four.linkage --language fr").messages.contains("[possible values: en, it]"));
}

/// Sections and equations are counted through, and conditions are written once.
#[test]
fn a_sheet_as_text_is_one_document() {
    let folder = folder();
    let text = folder.run("sheet four.linkage --format text -o -").works("");
    let number = |line: &str| line.split_once(". ").and_then(|(number, _)| number.parse::<usize>().ok());
    let sections: Vec<usize> = text.lines().filter_map(number).collect();
    assert_eq!(sections, (1..=sections.len()).collect::<Vec<_>>(), "{text}");
    let equation = |line: &str| line.strip_prefix("  (")?.split_once(')')?.0.parse::<usize>().ok();
    let equations: Vec<usize> = text.lines().filter_map(equation).collect();
    assert_eq!(equations, (1..=equations.len()).collect::<Vec<_>>(), "{text}");
    assert_eq!((text.matches("Conditions").count(), text.matches("l₃ ≠ 0").count()), (1, 1), "{text}");
    folder.run("sheet four.linkage").works("wrote four.html\n");
    assert_eq!(folder.read("four.html").matches("<h2>Conditions</h2>").count(), 1);
}

#[test]
fn the_ending_of_a_file_says_its_form() {
    let folder = folder();
    for (arguments, what) in [
        ("sheet four.linkage", "a sheet is HTML, LaTeX or text: write -o NAME.html, NAME.tex or NAME.txt"),
        ("sheet four.linkage --format latex", "this sheet is LaTeX: write -o NAME.tex"),
        ("table four.linkage", "a table is CSV, JSON or text: write -o NAME.csv, NAME.json or NAME.txt"),
        ("report four.linkage", "a report is text or HTML: write -o NAME.txt or NAME.html"),
        ("draw four.linkage", "a picture is SVG or PNG: write -o NAME.svg or NAME.png"),
        ("animate four.linkage", "a film is SVG or GIF: write -o NAME.svg or NAME.gif"),
        ("rust four.linkage", "this code is Rust: write -o NAME.rs"),
        ("fpcore four.linkage", "this code is FPCore: write -o NAME.fpcore"),
    ] {
        for ending in ["xlsx", "jpg"] {
            let message = format!("error: {what}, not `.{ending}`\n");
            folder.run(&format!("{arguments} -o four.{ending}")).fails(2, &message);
        }
    }
    folder.run("table four.linkage --steps 1 -o four.json").works("wrote four.json\n");
    assert!(folder.read("four.json").starts_with('{'));
    folder.run("sheet four.linkage -o four.txt").works("wrote four.txt\n");
    assert!(folder.read("four.txt").starts_with("FourBar\n"));
}

/// A text with a second loop from the pivot D of the first: a link CE, a rocker FE.
fn six_bar(second_loop: &str) -> String {
    format!(
        "mechanism SixBar {{
            param l1 = 80, l2 = 20, l3 = 50, l4 = 70, l5 = 90, l6 = 50, l7 = 60;
            input theta2;
            unknown theta3, theta4, theta5, theta6;
            loop l2@theta2 + l3@theta3 = l1@0 + l4@theta4;
            {second_loop}
        }}"
    )
}

#[test]
fn a_loop_is_drawn_from_its_joint() {
    let folder = Folder::new();
    folder.write("from_origin.linkage", six_bar("loop l1@0 + l4@theta4 + l5@theta5 = l1@0 + l7@0 + l6@theta6;"));
    folder.write("from_pivot.linkage", six_bar("loop l4@theta4 + l5@theta5 = l7@0 + l6@theta6;"));
    folder.write("from_joint.linkage", six_bar("loop l5@theta5 - l6@theta6 - l7@0 + l4@theta4 = 0;"));
    let drawn = ["from_origin", "from_pivot", "from_joint"].map(|name| {
        let svg = folder.run(&format!("draw {name}.linkage -o -")).works("");
        [svg.matches("class=\"foot\"").count(), svg.matches("class=\"joint\"").count()]
    });
    assert_eq!(drawn[0], [3, 6]);
    assert_eq!((drawn[1], drawn[2]), (drawn[0], drawn[0]));
    // No vector says where it begins.
    folder.write("alone.linkage", six_bar("loop l5@theta5 + l6@theta6 = l7@(2*theta2);"));
    let ran = folder.run("draw alone.linkage -o -");
    let message = "loop 2 of `SixBar` is drawn from the origin: if it begins at another joint, declare a point on it\n";
    assert_eq!((ran.code, ran.messages.as_str()), (Some(0), message));
}

/// The times of the frames of a GIF, in hundredths of a second.
fn delays(folder: &Folder, name: &str) -> Vec<u16> {
    let mut film = gif::DecodeOptions::new().read_info(File::open(folder.path(name)).unwrap()).unwrap();
    let mut delays = Vec::new();
    while let Some(frame) = film.read_next_frame().unwrap() {
        delays.push(frame.delay);
    }
    delays
}

#[test]
fn films_take_their_time() {
    let folder = folder();
    // A turn at 60 rpm takes a second, in which 50 frames have 20 milliseconds each.
    folder.run("animate four.linkage --rate 60rpm --width 64 -o four.gif").works("wrote four.gif\n");
    assert_eq!(delays(&folder, "four.gif"), [2; 50]);
    folder.run("animate four.linkage --rate 60rpm -o four.svg").works("wrote four.svg\n");
    assert!(folder.read("four.svg").contains("dur=\"1s\""));
    let back = "`theta2` goes from 0° to 90° and back\nwrote four.svg\n";
    folder.run("animate four.linkage --to 90deg --rate 60rpm -o four.svg").works(back);
    assert!(folder.read("four.svg").contains("dur=\".5s\""));
    for (arguments, message) in [
        ("--rate 0", "--rate is not 0"),
        ("--seconds 601", "a film takes more than 0 and at most 600 seconds"),
        ("--rate 0.001", "a film takes more than 0 and at most 600 seconds, not 6.283e3"),
        ("--steps 10001", "a film has at most 10000 steps"),
        (
            "--width 8000 -o four.gif",
            "120 frames of 8000 by 6000 pixels are more than 1000 million: write a smaller --width or --steps",
        ),
    ] {
        folder.run(&format!("animate four.linkage {arguments}")).fails(2, &format!("error: {message}\n"));
    }
    let both = folder.run("animate four.linkage --rate 1 --seconds 1");
    assert!(both.code == Some(2) && both.messages.contains("cannot be used with '--seconds"), "{both:?}");
}

#[test]
fn films_say_how_they_go_on() {
    let folder = folder();
    let ran = folder.run("animate four.linkage --set l2=45 --steps 36");
    let lines: Vec<&str> = ran.messages.lines().collect();
    assert_eq!((ran.code, lines.len()), (Some(0), 3), "{lines:?}");
    let missing = "7 of 37 frames have no position; the motion of FourBar ends at theta2 = 146.0845° and 213.9155° (dead point of \
                   theta3, theta4)";
    assert_eq!(lines[0], missing);
    assert_eq!(lines[1], "`theta2` goes from -140° to 140° and back");
    folder.run("animate four.linkage --back-and-forth").works("wrote four.svg\n");
    // One turn of the crank is half a turn of the other wheel.
    folder.write(
        "gears.linkage",
        "mechanism Gears { param a = 1, b = 2; input phi; unknown psi; equation a*phi + b*psi = 0; \
         point P = a@phi; point Q = (a + b, 0) + b@psi; }",
    );
    let jumps = "the film jumps back to its start, which is another position: write more turns with --to, or --back-and-forth\n";
    folder.run("animate gears.linkage").works(&format!("{jumps}wrote gears.svg\n"));
    folder.run("animate gears.linkage --to 720deg").works("wrote gears.svg\n");
    folder.run("animate gears.linkage --back-and-forth").works("wrote gears.svg\n");
}

#[test]
fn pictures_have_their_width() {
    let folder = folder();
    folder.run("draw four.linkage --width 300 -o four.png").works("wrote four.png\n");
    let png = std::fs::read(folder.path("four.png")).unwrap();
    assert_eq!(png[16..20], 300_u32.to_be_bytes());
    for command in ["draw", "animate"] {
        folder.run(&format!("{command} four.linkage --width 300")).works("wrote four.svg\n");
        assert!(folder.read("four.svg").contains("width=\"300\""), "{command}");
        let ran = folder.run(&format!("{command} four.linkage --width -3"));
        assert!(ran.code == Some(2) && ran.messages.contains("16..=8192"), "{ran:?}");
    }
}

/// Mobility, both positions with their transmission angles, and the class: text and page.
#[test]
fn reports() {
    let folder = folder();
    let text = folder.run("report four.linkage --at theta2=20deg").works("");
    for line in [
        "4 links (ground, theta2, theta3, theta4) meet in 4 joints, all of which turn.",
        "At theta2 = 20° there are 2 modes on 2 motions, which form 2 circuits.\n",
        "Mode 1 (theta3_theta4=left): theta3 = 70.55077° and theta4 = −50.46595°.",
        "The transmission angle of theta3, theta4 is 58.98329°.",
        "Mode 2 (theta3_theta4=right): theta3 = ",
        "is a crank-rocker, seen from theta2",
        "Circuit 1: mode 1, which this report follows. theta2 turns fully",
        "Motion\ntheta2 turns fully, without limits: the motion closes after 1 turn.",
        "the angle between both links goes from 57.12165° (at theta2 = 0°) to 111.8037° (at theta2 = 180°)",
        "The time ratio of both strokes is",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
    folder.run("report four.linkage --at theta2=20deg -o report.html").works("wrote report.html\n");
    let page = folder.read("report.html");
    assert_eq!((page.matches("<img alt=\"Mode ").count(), page.matches("<h1>FourBar</h1>").count()), (2, 1));
    // Why there is no position.
    let none = folder.run("report four.linkage --set l2=300").works("");
    assert!(none.contains("The modes are not known: FourBar cannot be assembled"), "{none}");
    assert!(none.contains("This report follows no motion: FourBar cannot be assembled"), "{none}");
    // Where a motion is not followed, the report has the positions, and says why there is no more.
    folder.write(
        "five.linkage",
        "mechanism Five { param a = 1, b = 4; input u, v; unknown p, q; \
                                  loop a@u + b@p = 5@0 + a@v + b@q; }",
    );
    let two = folder.run("report five.linkage").works("");
    assert!(
        two.contains("there are 2 modes.\n") && two.contains("With 2 inputs a mechanism has as many motions"),
        "{two}"
    );
    folder.write("arm.linkage", "mechanism Arm { input u; point P = 2@u; }");
    let open = folder.run("report arm.linkage").works("");
    assert!(open.contains("This report follows no motion: all positions are those of the input."), "{open}");
    let [names, equations]: [String; 2] = [
        (0..23).map(|place| format!(", e{place}")).collect(),
        (0..23).map(|place| format!("equation e{place} = {place} * t; ")).collect(),
    ];
    let of = |names: &str, equations: &str| {
        format!("mechanism Large {{ input t; unknown p, q{names}; loop 1@t + 3@p = 2@0 + 3@q; {equations} }}")
    };
    folder.write("large.linkage", of(&names, &equations));
    let large = folder.run("report large.linkage").works("");
    assert!(large.contains("no motion: there are 25 unknowns, more than the 24"), "{large}");
    folder.run("draw large.linkage").works("wrote large.svg\n");
    let chosen = folder.run("report four.linkage --branch theta3_theta4=right").works("");
    assert!(chosen.contains("Circuit 2: mode 2, which this report follows."), "{chosen}");
}

/// A doc comment is in the sheet, in plain words.
#[test]
fn links_of_docs_are_words() {
    let folder = Folder::new();
    folder.write("four.linkage", format!("/// A [crank](crate::manual::first) AB, see [`FourBar`].\n{FOUR_BAR}"));
    folder.run("sheet four.linkage").works("wrote four.html\n");
    assert!(folder.read("four.html").contains("<p>A crank AB, see FourBar.</p>"));
    let text = folder.run("sheet four.linkage --format text -o -").works("");
    assert!(text.contains("  A crank AB, see FourBar.\n") && !text.contains("crate::"));
}
