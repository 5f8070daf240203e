//! Tables: angles, corners of motions, guesses, summaries and values.

use super::folder::Folder;

/// The numbers of a column of a CSV.
fn column(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines();
    let place =
        lines.next().unwrap().split(',').position(|head| head == name).unwrap_or_else(|| panic!("{name}: {csv}"));
    lines.map(|line| line.split(',').nth(place).unwrap().parse().unwrap_or(f64::NAN)).collect()
}

/// The largest step between two rows.
fn largest_step(column: &[f64]) -> f64 {
    column.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max)
}

const CRANKS: &str = "mechanism Cranks {
    param ground = 30, crank = 80, coupler = 70, rocker = 60, gear = 2, bend = 20deg;
    input theta;
    unknown phi, psi;
    loop crank@theta + coupler@phi = ground@0 + rocker@psi;
    point B = crank@theta;
    output turn = 2*psi - theta/2 + 10deg;
    output seen = atan2(y(B), x(B) + ground/2);
    output bent = psi + bend;
    output arc = rocker * psi;
    output geared = gear * psi;
    output ratio = psi / 2 + rocker;
}";

/// Outputs are followed as unknowns are, and those that are angles are in degrees.
#[test]
fn outputs_that_are_angles() {
    let folder = Folder::new();
    folder.write("cranks.linkage", CRANKS);
    let names = ["turn", "seen", "bent", "arc", "geared", "ratio"];
    let columns = format!("psi,psi_rate,{},turn_rate", names.join(","));
    let run = |more: &str| {
        folder.run(&format!("table cranks.linkage --to 720deg --steps 72 --rate 1 --columns {columns} {more}"))
    };
    let radians = run("").works("");
    let degrees = run("--degrees").works("");
    let head = "psi [deg],psi_rate [deg/s],turn [deg],seen [deg],bent [deg],arc,geared,ratio,turn_rate [deg/s]";
    assert_eq!(degrees.lines().next(), Some(head));
    // A double crank: two turns of the input are two of each.
    let of = |name: &str| column(&radians, name);
    let turns = |name: &str| (of(name)[72] - of(name)[0]) / std::f64::consts::TAU;
    for (name, expected) in [("psi", 2.0), ("turn", 3.0), ("seen", 2.0), ("bent", 2.0), ("arc", 120.0), ("geared", 4.0)]
    {
        assert!((turns(name) - expected).abs() < 1e-12 * expected, "{name}: {}", turns(name));
        assert!(largest_step(&of(name)) < turns(name) * std::f64::consts::TAU / 20.0, "{name}");
    }
    let turned = column(&degrees, "turn [deg]");
    assert!(of("turn").iter().zip(turned).all(|(one, other)| (one.to_degrees() - other).abs() <= 1e-13 * other.abs()));
    let json = run("--degrees --format json").works("");
    assert_eq!(json.matches("\"unit\":\"deg\"").count(), 4, "{json}");
}

const PARALLEL: &str = "mechanism Parallel {
    param ground = 40, crank = 20, rocker = 20;
    input theta;
    unknown phi, psi;
    loop crank@theta + ground@phi = ground@0 + rocker@psi;
    point B = crank@theta;
    point C = (ground, 0) + rocker@psi;
}";

/// A parallelogram stays one where its links are on one line, and says where other motions cross it.
#[test]
fn change_points_are_named() {
    let folder = Folder::new();
    folder.write("parallel.linkage", PARALLEL);
    let passed = |at: &str| {
        let kind = if at.contains(',') { "change points" } else { "a change point" };
        format!(
            "at theta = {at} the motion passes {kind}: it goes on smoothly, and other motions cross it; `linkage circuits` lists \
             them\n"
        )
    };
    for steps in [1, 7, 36, 120] {
        let run = |of: &str, range: &str| folder.run(&format!("{of} parallel.linkage {range} --steps {steps}"));
        // The change point is within a step, or in one of the rows.
        let csv = run("table", "--from 1deg --to 357deg").works(&passed("180°"));
        let [theta, psi] = ["theta", "psi"].map(|name| column(&csv, name));
        assert!(theta.iter().zip(&psi).all(|(theta, psi)| (theta - psi).abs() <= 1e-13), "{csv}");
        let film = run("animate", "--from 1deg --to 357deg");
        assert!(steps == 1 || film.messages.starts_with(&passed("180°")), "{}", film.messages);
        // On one side there is none, in both directions.
        run("table", "--from 1deg --to 179deg").works("");
        run("table", "--from 359deg --to 180.5deg").works("");
    }
    folder.run("table parallel.linkage --from 300deg --to 20deg --steps 30").works(&passed("180°"));
    // A change point at an end is the place where the other motion could begin. There the rates are those of the motion.
    let turn = folder.run("table parallel.linkage --steps 4 --rate 3").works(&passed("0°, 180°, 360°"));
    assert!(column(&turn, "psi_rate").iter().all(|rate| (rate - 3.0).abs() <= 1e-9), "{turn}");
    // The crossed linkage stays crossed: psi turns the other way.
    let crossed = folder.run("table parallel.linkage --branch phi_psi=right --from 1deg --to 357deg --steps 60");
    let csv = crossed.works(&passed("180°"));
    let psi = column(&csv, "psi");
    assert!(psi.windows(2).all(|pair| pair[1] < pair[0]) && largest_step(&psi) < 0.4, "{psi:?}");
    // Nearly the same links have no change point: they turn quickly, or do not get across.
    folder.run("table parallel.linkage --set rocker=20.001 --from 1deg --to 357deg --steps 36").works("");
}

/// Two equal links of a slider-crank: at its change point the slider stays at 0, where its errors have no scale of their own.
#[test]
fn a_length_can_stay_at_zero() {
    let folder = Folder::new();
    folder.write(
        "kite.linkage",
        "mechanism Kite { param r = 1; input phi; unknown psi, s; loop r@phi + r@psi = (s, 0); }",
    );
    for steps in [7, 12, 120] {
        let ran = folder.run(&format!("table kite.linkage --from 1deg --to 179deg --steps {steps}"));
        assert_eq!(ran.messages.matches("change point").count(), 1, "{}", ran.messages);
        assert!(ran.messages.contains("at phi = 90° the motion passes a change point"), "{}", ran.messages);
        folder.run(&format!("table kite.linkage --from 91deg --to 179deg --steps {steps}")).works("");
    }
}

/// A gap that no row falls into.
#[test]
fn gaps_between_rows_are_named() {
    let folder = Folder::new();
    folder.write("cranks.linkage", CRANKS);
    // The crank passes 180 degrees where crank + ground <= coupler + rocker.
    let ran = folder.run("table cranks.linkage --set crank=100.01 --from 90deg --to 269deg --steps 7");
    assert_eq!(ran.code, Some(0));
    let cosine: f64 = (100.01_f64.powi(2) + 900.0 - 130.0_f64.powi(2)) / (2.0 * 100.01 * 30.0);
    let end = cosine.acos().to_degrees();
    let message = format!(
        "between theta = {end:.4}° and {:.4}° there is no position: the motion does not get across; end with \
         `--to {end:.4}deg`\n",
        360.0 - end
    );
    assert_eq!(ran.messages, message);
}

/// A smooth motion has none, with few rows and with many.
#[test]
fn smooth_motions_have_no_change_points() {
    let examples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/linkages");
    let folder = Folder::new();
    folder.write("cranks.linkage", CRANKS);
    let mut files: Vec<std::path::PathBuf> =
        std::fs::read_dir(examples).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.push(folder.path("cranks.linkage"));
    for file in files {
        let (name, file) = (file.file_stem().unwrap().to_string_lossy().into_owned(), file.display());
        // What moves: the range of a length, and a driver where there are several.
        let more = match name.as_str() {
            "chebyshev" => ["--mechanism ChebyshevCoupler", "--mechanism ChebyshevRocker"].as_slice(),
            "slider_crank" => &["--mechanism Compressor", "--mechanism Engine --from 2.01 --to 3.99"],
            "pantograph" => &["--at y=1 --from 2 --to 6", "--at x=2 --along y --from 5 --to 2"],
            "rack_steering" => &["--from -400deg --to 400deg"],
            _ => &[""],
        };
        for (more, steps) in more.iter().flat_map(|more| [7, 36, 120].map(|steps| (more, steps))) {
            let ran = folder.run(&format!("table {file} {more} --steps {steps}"));
            assert!(!ran.messages.contains("change point"), "{name} {more} {steps}: {}", ran.messages);
        }
    }
}

/// Four angles are solved together.
const SIX_BAR: &str = "mechanism SixBar {
    param a = 1, bx = 0.5, by = -1, p = 4, q = 4.25, cd = 1.5, ex = 2, ey = 2, r = 2.5, gx = 5, gy = -2;
    input theta;
    unknown alpha, beta, tau, rho;
    let first = a@theta + p@alpha;
    loop first + cd@tau = (bx, by)@theta + q@beta;
    loop first + (ex, ey)@tau = (gx, gy) + r@rho;
    point C = first;
    point E = (gx, gy) + r@rho;
    output turn = tau - theta;
}";

#[test]
fn positions_without_closed_form_follow_a_motion() {
    let folder = Folder::new();
    folder.write("six.linkage", SIX_BAR);
    let columns = ["alpha", "beta", "tau", "rho"];
    let table = |more: &str| folder.run(&format!("table six.linkage {more}")).works("");
    let close = |one: f64, other: f64| (one - other).abs() <= 1e-12 * (1.0 + other.abs());
    // The number means the first row, and a turn closes, with few rows and with many.
    let few = table("--branch alpha_beta_tau_rho=2 --steps 1");
    let many = table("--branch alpha_beta_tau_rho=2 --steps 60");
    for name in columns {
        let [few, many] = [&few, &many].map(|csv| column(csv, name));
        assert!(
            close(few[0], many[0]) && close(few[1], many[60]) && close(many[60], many[0]),
            "{name}: {few:?} {many:?}"
        );
        assert!(largest_step(&many) < 0.3, "{name}");
    }
    // A guess in the neighbourhood is the same motion.
    let guess = |more: &str| {
        format!("--guess alpha=-30deg,beta=-30deg --guess tau=-105deg,rho=-70deg --steps 60 --format csv {more}")
    };
    let guessed = table(&guess(""));
    assert!(
        columns.iter().all(|name| column(&guessed, name).iter().zip(column(&many, name)).all(|(a, b)| close(*a, b)))
    );
    // It can begin anywhere.
    let backwards = table(&guess("--from 360deg --to 0"));
    let last = column(&backwards, "rho")[60];
    assert!(close(last, column(&many, "rho")[0]), "{last}");
    // A motion ends where it ends, and never jumps to another one.
    let ran = folder.run("table six.linkage --steps 36");
    assert_eq!(ran.code, Some(0));
    // From 320 degrees on it is at the positions of -40 degrees on.
    let message = "18 of 37 rows have no position; the motion of SixBar ends at theta = 130.8629° and 318.7205° (dead point of \
                   alpha, beta, tau, rho)\n";
    assert_eq!(ran.messages, message);
    for picture in ["draw", "animate"] {
        folder
            .run(&format!("{picture} six.linkage --guess alpha=-30deg,beta=-30deg,tau=-105deg,rho=-70deg"))
            .works("wrote six.svg\n");
        assert!(folder.read("six.svg").starts_with("<svg"));
    }
}

#[test]
fn guesses_that_are_wrong() {
    let folder = Folder::new();
    folder.write("six.linkage", SIX_BAR);
    folder.write("cranks.linkage", CRANKS);
    for (arguments, message) in [
        (
            "six.linkage --guess alpha=1",
            "positions of `SixBar` are found from a guess: write --guess beta=VALUE,tau=VALUE,rho=VALUE",
        ),
        (
            "six.linkage --guess alpa=1",
            "SixBar has no unknown `alpa`, did you mean `alpha`? `linkage names` lists all names",
        ),
        ("six.linkage --guess alpha=7", "`alpha` is an angle, and 7 radians are more than a turn: write `7deg`"),
        ("cranks.linkage --guess phi=7", "`phi` is an angle, and 7 radians are more than a turn: write `7deg`"),
        (
            "six.linkage --guess alpha=1,beta=1,tau=1,rho=1 --branch alpha_beta_tau_rho=1",
            "--guess and --branch alpha_beta_tau_rho choose the same position: leave out one",
        ),
    ] {
        folder.run(&format!("table {arguments}")).fails(2, &format!("error: {message}\n"));
    }
}

/// One unknown, which has no direction.
#[test]
fn lengths_are_guessed() {
    let folder = Folder::new();
    folder.write("odd.linkage", "mechanism Odd { param a = 1; input phi; unknown s; equation s + exp(s) = a*phi; }");
    let csv = folder.run("table odd.linkage --from 0 --to 1 --steps 4 --guess s=-0.5").works("");
    let [phi, s] = ["phi", "s"].map(|name| column(&csv, name));
    assert!(phi.iter().zip(&s).all(|(phi, s)| (s + s.exp() - phi).abs() <= 1e-15), "{csv}");
}

#[test]
fn names_of_a_mechanism() {
    let folder = Folder::new();
    folder.write("cranks.linkage", CRANKS);
    folder.write("six.linkage", SIX_BAR);
    folder.write("two.linkage", super::folder::SLIDER_CRANK);
    let text = folder.run("names cranks.linkage").works("");
    for line in [
        "Cranks",
        "parameters (--set)",
        "  bend     20deg  angle in radians",
        "inputs (--at, --along)",
        "  theta  angle in radians",
        "  phi_psi   left or right   The joint of phi and psi is left or right of the line from B to (ground, 0).",
        "  psi_turn  a whole number  The whole turns that are added to psi, 0 without it.",
        "  time                                  with --rate, in s",
        "  phi, psi                              each with _rate, _acceleration",
    ] {
        assert!(text.lines().any(|other| other == line), "{line}:\n{text}");
    }
    assert!(!text.contains("--guess"));
    let json: serde_json::Value =
        serde_json::from_str(&folder.run("names six.linkage --format json").works("")).unwrap();
    let of = |list: &str| json[0][list].as_array().unwrap().iter().filter_map(|name| name.as_str()).collect::<Vec<_>>();
    assert_eq!(of("guess"), ["alpha", "beta", "tau", "rho"]);
    assert_eq!(json[0]["branch"][0]["name"], "alpha_beta_tau_rho");
    // They are the columns of the table.
    let csv = folder.run("table six.linkage --steps 1 --to 1 --rate 1").works("");
    assert_eq!(csv.lines().next().unwrap().replace("time [s]", "time"), of("columns").join(","));
    // All drivers of a file, or one of them.
    let names = |more: &str| folder.run(&format!("names two.linkage {more}")).works("");
    let heads = |text: &str| text.lines().filter(|line| ["Crank", "Piston"].contains(line)).count();
    assert_eq!([heads(&names("")), heads(&names("--mechanism Piston"))], [2, 1]);
}

#[test]
fn summaries() {
    let folder = Folder::new();
    folder.write("two.linkage", super::folder::SLIDER_CRANK);
    let run = |more: &str| {
        folder.run(&format!("table two.linkage --mechanism Crank --steps 360 --summary --degrees {more}")).works("")
    };
    let text = "\
column  minimum  at phi [deg]  maximum  at phi [deg]  swing
     s        2           180        4             0      2
";
    assert_eq!(run("--columns s"), text);
    // All columns; those of rates with a rate.
    let csv = run("--format csv");
    assert_eq!(csv.lines().next(), Some("column,minimum,at phi [deg],maximum,at phi [deg],swing"));
    assert!(csv.contains("\nPin_y,-1,270,1,90,2\n"), "{csv}");
    assert_eq!([csv.lines().count(), run("--format csv --rate 1").lines().count()], [5, 14]);
    let json: serde_json::Value = serde_json::from_str(&run("--format json --columns s")).unwrap();
    assert_eq!(
        (&json[0]["column"], &json[0]["swing"], &json[0]["at_minimum"]),
        (&"s".into(), &2.0.into(), &180.0.into())
    );
}

#[test]
fn lists_of_values() {
    let folder = Folder::new();
    folder.write("cranks.linkage", CRANKS);
    let run = |arguments: &str| folder.run(&format!("table cranks.linkage {arguments}"));
    let one =
        run("--set ground=31,crank=81 --branch phi_psi=right,psi_turn=1 --from pi/6 --to 2*pi --steps 3").works("");
    let other = run(
        "--set ground=31 --set crank=81 --branch phi_psi=right --branch psi_turn=1 --from 30deg --to 360deg --steps 3",
    );
    assert_eq!(one, other.works(""));
    let spaced =
        folder.command("table cranks.linkage --steps 1").args(["--columns", " theta , psi "]).output().unwrap();
    assert!(spaced.stdout.starts_with(b"theta,psi\n"));
    for (arguments, message) in [
        ("--set ground=1,ground=2", "--set has `ground` twice: write it once"),
        ("--branch phi_psi=left --branch phi_psi=right", "--branch has `phi_psi` twice: write it once"),
        ("--at theta=1,theta=2 --along theta", "--at has `theta` twice: write it once"),
        ("--columns time", "`time` is a column of a motion with a rate: write --rate VALUE"),
        (
            "--columns B",
            "the table has no column `B`; near names: `B_x`, `B_y`, `B_velocity_x`, `B_velocity_y`, `B_speed` and \
          `B_acceleration_x`; `linkage names` lists all columns",
        ),
        ("--rate 0", "at --rate 0, `theta` does not move: leave it out, or write such as 45rpm"),
        ("--rate=-1", "at this --rate `theta` falls, and it grows from --from to --to: change the sign or the ends"),
        (
            "--from 1 --to 0 --rate 1",
            "at this --rate `theta` grows, and it falls from --from to --to: change the sign or the ends",
        ),
        ("-o t.xlsx", "a table is CSV, JSON or text: write -o NAME.csv, NAME.json or NAME.txt, not `.xlsx`"),
    ] {
        run(arguments).fails(2, &format!("error: {message}\n"));
    }
    // Time goes on from 0, also where the input falls.
    let down = run("--from 1 --to 0 --rate=-0.5 --steps 2 --columns time").works("");
    assert_eq!(down, "time [s]\n0\n1\n2\n");
    // The ending of the file is the form.
    run("--steps 1 -o t.json").works("wrote t.json\n");
    assert!(folder.read("t.json").starts_with("{\"columns\""));
    run("--steps 1 --columns theta,psi -o t.txt").works("wrote t.txt\n");
    assert!(folder.read("t.txt").starts_with("  theta"), "{}", folder.read("t.txt"));
}

/// One output has a kink in a row; the position is there, and so are all other numbers.
#[test]
fn a_kink_leaves_the_other_cells() {
    let folder = Folder::new();
    folder.write(
        "kink.linkage",
        "mechanism Kink { input x; unknown p; equation p = 2*x; point P = x@30deg; output o = abs(x - 0.5); output q = p + x; }",
    );
    let command = "table kink.linkage --along x --from 0 --to 1 --steps 4 --columns x,P_x,o,o_rate,q,q_rate --digits 9";
    // At rest nothing has a rate. Numbers are those next to the kink, some units in the last place away.
    let rows = folder.run(command).works("");
    assert_eq!(rows.lines().nth(3), Some("0.5,0.433012702,8.8817842e-16,0,1.5,0"), "{rows}");
    let message = "at x = 0.5 there is a kink, and no o_rate\n";
    let rows = folder.run(&format!("{command} --rate 2")).works(message);
    assert_eq!(rows.lines().nth(3), Some("0.5,0.433012702,8.8817842e-16,,1.5,6"), "{rows}");
    // What is not asked for is not named.
    folder.run("table kink.linkage --along x --from 0 --to 1 --steps 4 --rate 2 --columns q_rate").works("");
}
