//! Reports of mechanisms in files: which position they are about, quantities that do not move, that jump or have a kink, and
//! the modes that they leave out. Figures were computed independently.

use super::folder::Folder;

const FILES: [(&str, &str); 8] = [
    (
        "ranged",
        "mechanism Ranged { param crank = 2, frame = 3; input theta, z; unknown phi, s in 1.5..4.5;
             loop crank@theta = (frame + z)@0 + s@phi; }",
    ),
    ("rhombus", "mechanism R { param a = 3; input t; unknown p, s; loop a@t + a@p + a@s = a@0; }"),
    (
        "cut",
        "mechanism Cut { param a = 2, b = 5, c = 4, d = 5; input th; unknown p, s; loop a@th + b@p = d@0 + c@s;
             point B = a@th; output o = angle(B); output half = angle(a@(2*th))/2;
             body crank { mass 1; inertia 1; center B; angle th; } scene Free { inertia; } }",
    ),
    (
        "kink",
        "mechanism Kink { param a = 2, b = 5, c = 4, d = 5; input t; unknown p, s; loop a@t + b@p = d@0 + c@s;
             output o = abs(t - 2); output k = abs(sin(t)); output n = norm(a@t - (a, 0));
             output h = (sin(t) + abs(sin(t)))/2; }",
    ),
    (
        "flat",
        "mechanism Flat { input x in -1..1; unknown y; equation y = 2*x;
             output f = 1000 + x^4; output g = (x^2 - 1)^2; output e = (x - 1)^4 + 1000; output i = x^3; }",
    ),
    (
        "cylinders",
        "mechanism Boom { param a = 3, h = 1; input th; unknown s, ph; loop a@th = (0, h) + s@ph; output stroke = s; }
         mechanism Arm { param a = 3, h = 9; input th; unknown s, ph; loop a@th = (0, h) + s@ph; output swing = ph; }
         mechanism Drive { param a = 3, h = 1; input s; unknown th, ph; loop a@th = (0, h) + s@ph; output swing = th; }",
    ),
    (
        "rocker",
        "mechanism Rocker { param ground = 4, crank = 3, coupler = 2, rocker = 2.5; input theta; unknown phi, psi;
             loop crank@theta + coupler@phi = ground@0 + rocker@psi; }",
    ),
    ("odd", "mechanism Odd { param a = 1; input phi; unknown s; equation s + exp(s) = a*phi; output o = s; }"),
];

fn folder() -> Folder {
    let folder = Folder::new();
    for (name, text) in FILES {
        folder.write(&format!("{name}.linkage"), text);
    }
    for dyads in [6, 14] {
        folder.write(&format!("chain{dyads}.linkage"), chain(dyads));
    }
    folder
}

/// Four-bars of which each drives the next.
fn chain(dyads: usize) -> String {
    let unknowns: Vec<String> = (1..=dyads).flat_map(|place| [format!("p{place}"), format!("q{place}")]).collect();
    let drives = |place: usize| if place == 1 { "t".to_owned() } else { format!("q{}", place - 1) };
    let of = |place: usize| format!("loop a@{} + b@p{place} = d@0 + c@q{place};", drives(place));
    let loops: String = (1..=dyads).map(of).collect();
    let params = "param a = 1, b = 3, c = 2.5, d = 3.2;";
    format!("mechanism Chain {{ {params} input t; unknown {}; {loops} }}", unknowns.join(", "))
}

fn says(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

/// s = 2.646 is in its range, s = -2.646 is not.
#[test]
fn modes_are_in_the_declared_ranges() {
    let folder = folder();
    let text = folder.run("report ranged.linkage --at z=0").works("");
    says(
        &text,
        &["At theta = 60° and z = 0 there is 1 mode.\n", "Mode 1 (phi_s=far): phi = 139.1066° and s = 2.645751."],
    );
    assert!(!text.contains("Mode 2"), "{text}");
    folder.run("report ranged.linkage --at z=0 -o ranged.html").works("wrote ranged.html\n");
    assert_eq!(folder.read("ranged.html").matches("<img alt=\"Mode ").count(), 1);
    // |(3 + z) - 2@60| is below 1.5 nowhere near z = -2.
    let none = folder.run("report ranged.linkage --at z=9").works("");
    says(&none, &["The modes are not known: no position at these inputs is in the declared ranges."]);
}

/// In a rhombus one link keeps its direction, and the other turns with the crank.
#[test]
fn what_is_constant_up_to_rounding_is_constant() {
    let folder = folder();
    let text = folder.run("report rhombus.linkage").works("");
    says(
        &text,
        &[
            "p is 0° all the time.\n",
            "s turns by 360° each time the motion closes, and moves in one direction all the time.",
            "the angle between both links goes from 0° (at t = 0°) to 180° (at t = 180°)",
        ],
    );
    assert!(text.len() < 3000, "{text}");
}

/// A point of the crank turns with it: report, table, simulation and proof count the turns.
#[test]
fn angles_go_on_at_the_cut() {
    let folder = folder();
    let text = folder.run("report cut.linkage").works("");
    for name in ["o", "half"] {
        let line =
            format!("{name} turns by 360° each time the motion closes, and moves in one direction all the time.");
        says(&text, &[&line]);
    }
    let table = folder.run("table cut.linkage --degrees --columns o,half --steps 8 --digits 9").works("");
    assert_eq!(table.lines().last(), Some("360,360"), "{table}");
    // A rad/s, 4 s.
    let simulated = folder
        .run("simulate cut.linkage --at th=0 --rate th=2 --to 4 --steps 2 --columns th,o,half --degrees --digits 6");
    let simulated = simulated.works("");
    let last = simulated.lines().last().unwrap_or_default();
    let numbers: Vec<f64> = last.split(',').map(|number| number.parse().unwrap()).collect();
    assert!(numbers[0] > 360.0 && (numbers[1] - numbers[0]).abs() < 1e-3, "{simulated}");
    assert!((numbers[2] - numbers[0]).abs() < 1e-3, "{simulated}");
    let proof = folder.run("certify cut.linkage --at th=0").works("");
    assert!(!proof.contains("bounds of one turn") && proof.contains("360"), "{proof}");
}

/// A wheel turns twice as fast as its crank. Where the factors of two angles differ, a value alone does not tell which of them has
/// jumped: rows keep their formula and say so, the report follows the motion.
#[test]
fn sums_of_angles_go_on_or_it_is_said() {
    let folder = folder();
    folder.write(
        "sums.linkage",
        "mechanism Sums { input th; unknown p; equation p = 2*th; point B = 1@th; point C = 1@p; \
         output even = angle(B) + 2*angle(C); output o = 2*angle(B) + 3*angle(C); \
         body crank { mass 1; inertia 1; center B; angle th; } scene Free { inertia; } }",
    );
    let text = folder.run("report sums.linkage").works("");
    says(&text, &["even turns by 1800° each time the motion closes", "o turns by 2880° each time the motion closes"]);
    let sentence = "`o` is a sum of angles with different factors, each of which jumps by a turn at 180°: its values are those \
                    of its formula, with these jumps; `linkage certify` and `linkage report` have its range without them\n";
    let command = "table sums.linkage --degrees --columns even,o --steps 36 --digits 9";
    let table = folder.run(command).works(sentence);
    // 2*angle(B) + 3*angle(C), and both are 0 again.
    let last: Vec<f64> = table.lines().last().unwrap().split(',').map(|number| number.parse().unwrap()).collect();
    assert!((last[0] - 1800.0).abs() < 1e-6 && last[1].abs() < 1e-6, "{table}");
    folder.run("table sums.linkage --columns even --steps 36").works("");
    let command = "simulate sums.linkage --at th=0 --rate th=1 --to 6 --steps 36 --columns o";
    folder.run(command).works(sentence);
    let proof = folder.run("certify sums.linkage --at th=0").works("");
    assert!(!proof.contains("bounds of one turn") && proof.contains("2880"), "{proof}");
}

/// The report is about the first mode, which has all of its circuits and strokes.
#[test]
fn kinks_are_turning_points() {
    let folder = folder();
    let text = folder.run("report kink.linkage").works("");
    says(
        &text,
        &[
            "At t = 60° there are 2 modes on 2 motions, which form 2 circuits.",
            "Circuit 1: mode 1, which this report follows.",
            // 2 rad
            "From 60° to 114.5916° it moves from 54.59156° to 0°",
            "k goes from 0 (at t = 180°) to 1 (at t = 90°). From 90° to 180° it moves from 1 to 0, in 25 % of the motion.",
            "n goes from 0 (at t = 0°) to 4 (at t = 180°).",
        ],
    );
    // It rests for half a turn, which is part of no stroke.
    let line = text.lines().find(|line| line.starts_with("h goes")).unwrap_or_default();
    says(
        line,
        &[
            "From 90° to 180° it moves from 1 to 0, in 25 % of the motion. From 0° to 90° it moves from 0 to 1, in 25 %",
            "The time ratio of both strokes is 1.",
            "It dwells between 0 and 0 from 180° to 0°, in 50 %",
        ],
    );
    assert_eq!(line.matches("it moves from").count(), 2, "{line}");
}

/// No stroke goes from a number to itself: at an extreme of fourth order, of third order, at ends.
#[test]
fn strokes_go_somewhere() {
    let text = folder().run("report flat.linkage --at x=0.3").works("");
    let lines = |name: &str| text.lines().find(|line| line.starts_with(name)).unwrap_or_default().to_owned();
    for (name, strokes) in [("f ", 2), ("g ", 2), ("e ", 0), ("i ", 0)] {
        let line = lines(name);
        assert_eq!(line.matches("it moves from").count(), strokes, "{line}");
    }
    says(&lines("g "), &["From −1 to 0 it moves from 0 to 1, in 50 % of the motion. From 0 to 1 it moves from 1 to 0"]);
}

/// A cylinder has a transmission angle where it drives; a slotted arm has one, too.
#[test]
fn cylinders_transmit_where_they_drive() {
    let folder = folder();
    let of = |name: &str| {
        folder
            .run(&format!(
                "report cylinders.linkage --mechanism {name} --at {}",
                match name {
                    "Drive" => "s=3",
                    _ => "th=60deg",
                }
            ))
            .works("")
    };
    let boom = of("Boom");
    assert!(!boom.contains("The transmission angle of") && !boom.contains("Dyad"), "{boom}");
    says(&boom, &["The group s, ph has no transmission angle: it is a cylinder"]);
    says(&of("Arm"), &["is 90° all the time"]);
    // cos = (a^2 + h^2 - s^2)/(2 a h)
    says(&of("Drive"), &["The transmission angle is at least 0° (at s = 4)"]);
}

/// The ends of a motion are in order, not on other turns.
#[test]
fn ranges_are_unwound() {
    let folder = folder();
    let text = folder.run("report rocker.linkage --at theta=340deg").works("");
    says(&text, &["theta goes to and fro between 281.4152° and 438.5848°; 2 dead points at theta = 438.5848°"]);
}

#[test]
fn a_branch_or_a_guess_chooses() {
    let folder = folder();
    let text = folder.run("report kink.linkage --branch p_s=right").works("");
    says(&text, &["Circuit 2: mode 2, which this report follows."]);
    let text = folder.run("circuits kink.linkage --branch p_s=right --at t=60deg").works("");
    says(&text, &["Kink: 1 position, 1 motion, 1 circuit\n", "  1  motion 1: t = 60°, p_s=right\n"]);
    let text = folder.run("circuits rocker.linkage --branch phi_psi=right --at theta=20deg").works("");
    says(&text, &["Rocker: 2 positions, 1 motion, 1 circuit\n"]);
    // Positions that are not listed.
    let text = folder.run("report odd.linkage --guess s=0 --at phi=1").works("");
    says(&text, &["The modes and circuits are not known", "o goes from"]);
    let none = folder.run("report kink.linkage --branch p_s=up");
    none.fails(2, "error: `p_s` is `left` or `right`, not `up`\n");
}

/// 12 unknowns in six groups of two; 2^14 modes.
#[test]
fn work_is_bounded_and_said() {
    let folder = folder();
    let table = folder.run("table chain6.linkage --steps 1 --from 10deg --to 20deg --columns q6 --degrees --digits 6");
    assert_eq!(table.works("").lines().count(), 3);
    let text = folder.run("report chain14.linkage").works("");
    says(&text, &["At t = 60° the first 64 modes are listed; up to 16320 more are left out.\n", "Mode 64 ("]);
    assert!(!text.contains("Mode 65"), "{text}");
}

/// A motion whose end is singular to the last digit: next to it an output has no derivative by the input, and the report goes on.
#[test]
fn an_end_that_is_singular_to_the_last_digit() {
    let folder = Folder::new();
    folder.write(
        "group.linkage",
        "mechanism M { input z0; unknown a0, a1, a2, a3, a4, a5, a6; \
         loop 1.784@0 + 1.288@z0 + 1.338@a0 - 1.919@0 - 2.562@a1 = 0; equation -2*z0 - a2 - 0.943 = 0; \
         loop 3.229@0 + 2.561@a3 + 1.065@(a4 - 0.273) - 1.58@0.277 - 2.767@a5 = 0; \
         loop 3.229@0 + 2.561@a3 + 1.373@(a4 + 1.373) - 3.083@0.077 - 1.958@a2 - 0.699@a6 = 0; \
         point P = 3.229@0 + 2.561@a3 + 1.373@(a4 + 1.373); point Z = 1@z0; output o = a6; \
         output d = angle(3.229@0 + 2.561@a3 + 1.373@(a4 + 1.373)); }",
    );
    let text = folder.run("report group.linkage --at z0=-2.378rad").works("");
    says(&text, &["z0 goes to and fro between −148.643° and −122.1408°"]);
    assert!(!text.contains("follows no motion"), "{text}");
}
