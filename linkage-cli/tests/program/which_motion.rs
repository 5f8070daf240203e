//! The motion that an answer is about: the position asked for, the first row that has it, and the turn of each row.

use super::folder::Folder;

/// The numbers of a column of a CSV, NaN where it is empty.
fn column(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines();
    let place = lines.next().unwrap().split(',').position(|head| head.split(' ').next() == Some(name));
    let place = place.unwrap_or_else(|| panic!("{name}: {csv}"));
    lines.map(|line| line.split(',').nth(place).unwrap().parse().unwrap_or(f64::NAN)).collect()
}

fn folder(text: &str) -> Folder {
    let folder = Folder::new();
    folder.write("m.linkage", text);
    folder
}

const SIX_BAR: &str = "mechanism SixBar {
    param a = 2.11, bx = -0.03, by = 0.18, p = 3.92, q = 3.44, cd = 2.46, ex = -0.8, ey = -1.94, r = 3.87,
        gx = 3.25, gy = -1.33;
    input theta;
    unknown alpha, beta, tau, rho;
    let first = a@theta + p@alpha;
    loop first + cd@tau = (bx, by)@theta + q@beta;
    loop first + (ex, ey)@tau = (gx, gy) + r@rho;
}";

/// A motion of 651 degrees to and fro is at its end at 294.275 degrees: a turn earlier it is elsewhere.
#[test]
fn more_than_a_turn_to_and_fro() {
    let folder = folder(SIX_BAR);
    let run = |more: &str| folder.run(&format!("table m.linkage --branch alpha_beta_tau_rho=0 --degrees {more}"));
    let ran = run("--steps 12");
    let message = "3 of 13 rows have no position; the motion of SixBar ends at theta = -356.576° and 294.275° (dead point of \
                   alpha, beta, tau, rho)\n";
    assert_eq!((ran.code, ran.messages.as_str()), (Some(0), message));
    let alpha = column(&ran.output, "alpha");
    assert!(alpha[..10].iter().all(|alpha| alpha.is_finite()) && alpha[10..].iter().all(|alpha| alpha.is_nan()));
    // No row jumps, and those a turn earlier differ.
    let [ahead, back] =
        ["--to 294deg --steps 294", "--to=-356deg --steps 356"].map(|more| column(&run(more).works(""), "alpha"));
    for alpha in [&ahead, &back] {
        assert!(alpha.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 30.0));
    }
    let turned = (ahead[240] - back[120]) / 360.0;
    assert!((turned - turned.round()).abs() > 0.01, "{turned}");
    // A film goes to and fro over the part that it has.
    let film = folder.run("animate m.linkage --branch alpha_beta_tau_rho=0 --steps 60");
    assert!(film.messages.contains("`theta` goes from 0° to 294° and back"), "{}", film.messages);
}

const LEVER: &str = "mechanism Lever {
    param crank = 2, frame = 3;
    input theta;
    unknown phi, s in 1.5..4.5;
    loop crank@theta = frame@0 + s@phi;
    output lift in ..1.9 = crank*sin(theta);
}";

/// The rows outside of the ranges are many, and the first within them chooses. Those on the same branch beyond the hole are not
/// on the motion, and a message says so.
#[test]
fn rows_outside_of_ranges() {
    let folder = folder(LEVER);
    for (steps, within, elsewhere) in [(120, 15, 40), (90, 11, 29), (720, 91, 240)] {
        let ran = folder.run(&format!("table m.linkage --steps {steps} --degrees --columns theta,s"));
        let message = format!(
            "{} of {} rows are not on the motion; the motion of Lever ends at theta = 26.38433° (the least value of s) and \
             71.80513° (the largest value of lift); {elsewhere} of them have positions on the branch, to which it does not get\n",
            steps + 1 - within,
            steps + 1
        );
        assert_eq!((ran.code, ran.messages.as_str()), (Some(0), message.as_str()));
        let rows = column(&ran.output, "theta").into_iter().zip(column(&ran.output, "s"));
        let rows: Vec<(f64, f64)> = rows.filter(|(_, s)| s.is_finite()).collect();
        assert_eq!(rows.len(), within);
        for (theta, s) in rows {
            let expected = (13.0 - 12.0 * theta.to_radians().cos()).sqrt();
            assert!((26.38..71.81).contains(&theta) && (s - expected).abs() < 1e-14, "{theta} {s}");
        }
    }
    // Without a row in the ranges the reason is that of the first.
    let ran = folder.run("table m.linkage --to 20deg");
    assert!(
        ran.code == Some(1) && ran.messages.contains("s of Lever is 1: it must be between 1.5 and 4.5"),
        "{}",
        ran.messages
    );
}

const FOUR_BAR: &str = "mechanism FourBar {
    param ground = 80, crank = 20, coupler = 50, rocker = 70;
    input theta;
    unknown phi, psi;
    loop crank@theta + coupler@phi = ground@0 + rocker@psi;
    point C = crank@theta + coupler@phi;
}";

/// A guess chooses one of the positions in closed form: each of them from a guess near it, also of one unknown.
#[test]
fn guesses_of_closed_forms() {
    let folder = folder(FOUR_BAR);
    let columns = "--columns theta,phi,psi --steps 6";
    for side in ["left", "right"] {
        let expected = folder.run(&format!("table m.linkage --branch phi_psi={side} {columns}")).works("");
        let [phi, psi] = ["phi", "psi"].map(|name| column(&expected, name)[0]);
        for guess in [
            format!("phi={}rad", phi + 0.2),
            format!("psi={}rad", psi - 0.1),
            format!("phi={}rad,psi={}rad", phi + std::f64::consts::TAU, psi + 0.3),
        ] {
            let found = folder.run(&format!("table m.linkage --guess {guess} {columns}")).works("");
            assert_eq!(found, expected, "{side} {guess}");
            if !guess.starts_with("psi") {
                continue;
            }
            let picture = |how: &str| {
                folder.run(&format!("draw m.linkage --at theta=0 {how} -o p.svg")).works("wrote p.svg\n");
                folder.read("p.svg")
            };
            assert_eq!(picture(&format!("--guess {guess}")), picture(&format!("--branch phi_psi={side}")));
            let limits =
                |how: &str| folder.run(&format!("limits m.linkage --at theta=0 {how} --format json")).works("");
            assert_eq!(limits(&format!("--guess {guess}")), limits(&format!("--branch phi_psi={side}")));
        }
    }
    // A choice of --branch holds, and the guess is of the others.
    let both = folder.run(&format!("table m.linkage --branch phi_psi=right --guess phi=40deg {columns}")).works("");
    assert_eq!(both, folder.run(&format!("table m.linkage --branch phi_psi=right {columns}")).works(""));
    let turned = folder.run(&format!("table m.linkage --branch psi_turn=1 --guess phi=40deg {columns}")).output;
    assert!(turned.is_empty() || column(&turned, "psi")[0].is_finite());
    folder
        .run("table m.linkage --guess chi=1")
        .fails(2, "error: FourBar has no unknown `chi`, did you mean `phi`? `linkage names` lists all names\n");
}

/// A group that Newton's method solves, and then a dyad, each from its guess.
#[test]
fn guesses_of_both_kinds() {
    let text = "mechanism Both {
        param a = 1, b = 3, c = 3, d = 3;
        input z in 0..1;
        unknown w, phi, psi;
        equation w + exp(w) = 1 + z;
        loop a@w + b@phi = d@0 + c@psi;
    }";
    let folder = folder(text);
    let columns = "--steps 4 --columns z,w,phi,psi";
    for (side, phi) in [("left", 60), ("right", -60)] {
        let run = |how: &str| folder.run(&format!("table m.linkage --guess w=0 {how} {columns}")).works("");
        assert_eq!(run(&format!("--guess phi={phi}deg")), run(&format!("--branch phi_psi={side}")), "{side}");
    }
    folder
        .run(&format!("table m.linkage --guess phi=1 {columns}"))
        .fails(2, "error: positions of `Both` are found from a guess: write --guess w=VALUE\n");
}

/// A geared train of two dyads: whether the motion of the first row can be followed or not, no other one answers.
#[test]
fn no_later_row_chooses() {
    let text = "mechanism Min {
        param a = 3, c = 1;
        input t;
        unknown p, q, u, r, s;
        loop a@t + c@p = c@90deg + a@q;
        equation u = 2*p - t;
        loop a@u + c@r = c@p + a@s;
    }";
    let folder = folder(text);
    for steps in [1, 4, 16] {
        let ran = folder.run(&format!(
            "table m.linkage --from 120deg --to 280deg --steps {steps} --branch p_q=right,r_s=right --columns p,r --degrees"
        ));
        assert_eq!(ran.code, Some(0), "{}", ran.messages);
        let [p, r] = ["p", "r"].map(|name| column(&ran.output, name)[0]);
        assert!((p - 176.373_571).abs() < 1e-6 && (r + 33.283_351).abs() < 1e-6, "{p} {r}");
    }
}

/// An input with a declared range: a table goes over it, and what is held is at its middle, or at its only end.
#[test]
fn declared_ranges_are_the_usual_values() {
    let cylinder = "mechanism Boom {
        param l = 80, r = 50, d = 100, stroke = 20;
        input z in -stroke..stroke;
        unknown b, c;
        loop l@b + r@c = (d + z, 0);
    }";
    let of_cylinder = folder(cylinder);
    let csv = of_cylinder.run("table m.linkage --steps 4 --columns z,b").works("");
    assert_eq!(column(&csv, "z"), [-20.0, -10.0, 0.0, 10.0, 20.0]);
    // The law of cosines.
    for (z, b) in column(&csv, "z").into_iter().zip(column(&csv, "b")) {
        let d: f64 = 100.0 + z;
        let cosine = (6400.0 + d * d - 2500.0) / (160.0 * d);
        assert!((b.cos() - cosine).abs() < 1e-14, "{z} {b}");
    }
    let wider = of_cylinder.run("table m.linkage --steps 2 --columns z --set stroke=25 --to 0").works("");
    assert_eq!(column(&wider, "z"), [-25.0, -12.5, 0.0]);
    for (command, at) in [
        ("limits m.linkage", "Boom about z = 0\n"),
        ("circuits m.linkage", "z = "),
        ("report m.linkage", "z = 0"),
        ("draw m.linkage -o -", "<svg"),
        ("animate m.linkage --steps 4 -o -", "<svg"),
        ("certify m.linkage", "z from -20 to 20"),
    ] {
        let ran = of_cylinder.run(command);
        assert!(ran.code == Some(0) && ran.output.contains(at), "{command}: {} {}", ran.output, ran.messages);
    }
    let limits = of_cylinder.run("limits m.linkage").works("");
    assert!(limits.contains("z from -20 (the least value of z) to 20 (the largest value of z)"), "{limits}");
    // Angles: the middle, one end, none.
    for (range, first, ends) in [
        ("in -15deg..15deg", "0", [-15.0, 15.0]),
        ("in 30deg..100deg", "65", [30.0, 100.0]),
        ("in 10deg..1000deg", "505", [10.0, 1000.0]),
        ("in 10deg..", "10", [10.0, 370.0]),
        ("in ..90deg", "90", [-270.0, 90.0]),
        ("", "60", [0.0, 360.0]),
    ] {
        let folder = folder(&FOUR_BAR.replace("input theta;", &format!("input theta {range};")));
        let sheet = folder.run("sheet m.linkage --branch phi_psi=left --format text -o -").works("");
        let is_first = |line: &str| line.split_whitespace().eq(["theta", first]);
        assert!(sheet.lines().any(is_first), "{range}: {sheet}");
        // Sixty turns of a motion without its other end take a second.
        if range == "in ..90deg" {
            continue;
        }
        let csv = folder.run("table m.linkage --steps 4 --degrees --columns theta,psi").works("");
        let theta = column(&csv, "theta");
        assert!((theta[0] - ends[0]).abs() < 1e-9 && (theta[4] - ends[1]).abs() < 1e-9, "{range}: {csv}");
        assert!(column(&csv, "psi").iter().all(|psi| psi.is_finite()), "{range}: {csv}");
    }
    // A length with one end, or none.
    for (range, missing) in [("in 0..", "--to"), ("in ..0", "--from"), ("", "--from and --to")] {
        let folder = folder(&cylinder.replace("in -stroke..stroke", range).replace(", stroke = 20", ""));
        folder.run("table m.linkage").fails(2, &format!("error: `z` is a length: write {missing}\n"));
    }
}

/// Circuits end at the ends of a range of more than a turn, as limits do.
#[test]
fn circuits_and_limits_have_the_same_ends() {
    let text = FOUR_BAR.replace("input theta;", "input theta in 10deg..1000deg;");
    let folder = folder(&text);
    let circuits = folder.run("circuits m.linkage --at theta=60deg").works("");
    assert_eq!(circuits.matches("theta from 10° to 1000°, at the ends of ranges").count(), 2, "{circuits}");
    let limits = folder.run("limits m.linkage --at theta=60deg").works("");
    let ends = "theta from 10° (the least value of theta) to 1000° (the largest value of theta)";
    assert_eq!(limits.matches(ends).count(), 2, "{limits}");
}

/// An even function of which crests are between the samples of a path.
#[test]
fn crests_of_outputs_are_limits() {
    let text = "mechanism Wave {
        param l = 1;
        input t;
        unknown p;
        equation p = t;
        point P = l@p;
        output o in -9..0.9 = t/5*sin(50*t);
    }";
    let folder = folder(text);
    let limits = folder.run("limits m.linkage --at t=0.1rad").works("");
    let end = 4.552_3_f64.to_degrees();
    let at: Vec<f64> = limits.split([' ', '°']).filter_map(|word| word.parse().ok()).collect();
    assert!(at.len() >= 3 && (at[1] + end).abs() < 0.01 && (at[2] - end).abs() < 0.01, "{limits}");
    let ran = folder.run("table m.linkage --from=-4.6rad --to 4.6rad --steps 92 --columns t,o");
    assert!(ran.output.lines().count() == 94 && ran.messages.contains("the largest value of o"), "{}", ran.messages);
}

/// A position of equilibrium is said to be off the motion, where it is on another branch or a negative length.
#[test]
fn an_equilibrium_is_on_the_motion_or_it_is_said() {
    let rest = "scene Rest { equilibrium; force (0.3, -1) at P; }";
    // The parallelogram is on the right branch, the antiparallelogram on the left one; both computed independently.
    let parallelogram = format!(
        "mechanism M {{ input z; unknown p, q; loop 1.495@z + 2.359@p = 2.359@0 + 1.495@q; point P = 1.495@z + 2.359@p; {rest} }}"
    );
    let cylinder = format!(
        "mechanism M {{ input c; unknown p, q; loop 4.625@q - 2.541@0.187 = c@p; point P = 1.214@(q - 1.283); {rest} }}"
    );
    let crank =
        format!("mechanism M {{ input z; unknown p, q; loop 1@z + 3@p = 3@0 + 2.5@q; point P = 1@z + 3@p; {rest} }}");
    let asked = [
        (&parallelogram, "--branch p_q=left --at z=-2.315rad", false),
        (&cylinder, "--branch p_q=right --at c=2.099", false),
        (&crank, "--branch p_q=left --at z=-2rad", true),
        (&crank, "--branch p_q=right --at z=-2rad", true),
    ];
    for (text, options, is_on) in asked {
        let ran = folder(text).run(&format!("equilibrium m.linkage --format json {options}"));
        assert_eq!(ran.code, Some(0), "{}", ran.messages);
        assert!(ran.output.contains(&format!("\"on_motion\": {is_on}")), "{options}: {}", ran.output);
        assert_eq!(ran.messages.contains("does not pass this one"), !is_on, "{}", ran.messages);
    }
    // Two inputs move there in a straight line; where that line does not get there, another way may.
    let two = |frame: f64| {
        format!(
            "mechanism M {{ input y, z; unknown p, q; loop 1@y + 3@p = {frame}@0 + 1@z + 3@q; point P = 1@y + 3@p; {rest} }}"
        )
    };
    let ran = folder(&two(3.0)).run("equilibrium m.linkage --format json --branch p_q=left --at y=-2rad,z=-1rad");
    assert!(ran.output.contains("\"on_motion\": true") && ran.messages.is_empty(), "{}{}", ran.output, ran.messages);
}
