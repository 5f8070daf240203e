//! Simulations and positions of equilibrium of scenes in files: the figures of the examples in Rust, and a lamp by its torques.

use std::fs;

use serde_json::Value;

use super::folder::Folder;

/// A lamp on a spring-balanced arm.
const LAMP: &str = "mechanism Lamp {
    param l = 0.4, a = 0.1, h = 0.15, m = 1, g = 9.81, k = 400, free = 0.05, c = 0.5, slack;
    input phi;
    point Tip = l@phi;
    let length = sqrt((a*cos(phi))^2 + (a*sin(phi) - h)^2);
    output spring_length = length;
    body lamp { mass m; inertia 1e-3; center Tip; angle phi; }
    scene Rest { gravity (0, -g); spring k, free on length; equilibrium; }
    scene Swing { inertia; gravity (0, -g); spring k, free on length; damper c on phi; }
    scene Loose { gravity (0, -g); spring k, slack on length; equilibrium; }
}";

const TWO: &str = "mechanism Two {
    param k = 3;
    input x, y;
    body ball { mass 1; center (x, y); }
    scene Driven { inertia; spring k on y; drive x = 2 * t + abs(t - 1); }
    scene Held { gravity (0, -1); spring k on y; drive x = t; equilibrium; }
}";

fn folder() -> Folder {
    let folder = Folder::new();
    for (name, of) in
        [("door_closer", "machines"), ("compressor", "machines"), ("engine", "machines"), ("four_bar", "linkages")]
    {
        let path = format!("{}/../examples/{of}/{name}.linkage", env!("CARGO_MANIFEST_DIR"));
        folder.write(&format!("{name}.linkage"), fs::read(path).unwrap());
    }
    folder.write("lamp.linkage", LAMP);
    folder.write("two.linkage", TWO);
    folder
}

/// A table in JSON.
struct Table(Value);

impl Table {
    fn of(folder: &Folder, arguments: &str) -> Self {
        let ran = folder.run(&format!("{arguments} --format json"));
        assert_eq!(ran.code, Some(0), "{}", ran.messages);
        Self(serde_json::from_str(&ran.output).unwrap())
    }

    fn column(&self, name: &str) -> Vec<f64> {
        let columns = self.0["columns"].as_array().unwrap();
        let column = columns.iter().find(|column| column["name"] == name).unwrap_or_else(|| panic!("{name}"));
        column["values"].as_array().unwrap().iter().map(|value| value.as_f64().unwrap_or(f64::NAN)).collect()
    }

    fn largest(&self, name: &str) -> f64 {
        self.column(name).iter().fold(0.0, |most: f64, number| most.max(number.abs()))
    }

    /// The times of an event.
    fn times(&self, name: &str) -> Vec<f64> {
        let marks = self.0["marks"].as_array().unwrap();
        marks.iter().filter(|mark| mark["name"] == name).map(|mark| mark["at"].as_f64().unwrap()).collect()
    }
}

#[track_caller]
fn close(found: f64, expected: f64, error: f64) {
    assert!((found - expected).abs() <= error, "{found} is not {expected}");
}

/// The times and speeds that the example `door_closer` prints.
#[test]
fn a_door_that_closes() {
    let folder = folder();
    let run = "simulate door_closer.linkage --at door=100deg --to 6 --tolerance 1e-12";
    let table = Table::of(&folder, &format!("{run} --own-steps"));
    let hits = table.times("stop on door is hit");
    let speeds = [0.478729, 0.141645, 0.047016, 0.016163, 0.005622];
    for ((hit, at), speed) in hits.iter().zip([4.213621, 4.437298, 4.508044, 4.531964, 4.540236]).zip(speeds) {
        close(*hit, at, 5e-7);
        // The rates at an event are those before it.
        let row = table.column("time").iter().position(|time| time == hit).unwrap();
        close(table.column("door_rate")[row], -speed, 5e-7);
    }
    assert_eq!(hits.len(), 15);
    close(table.times("stop on door holds")[0], 4.544670, 5e-7);
    let energy: Vec<f64> = table
        .column("kinetic_energy")
        .iter()
        .zip(table.column("potential_energy"))
        .map(|(one, other)| one + other)
        .collect();
    close(energy[0] - energy[energy.len() - 1], 32.997186239, 5e-10);
    // Equal steps of time end at rest too.
    let table = Table::of(&folder, &format!("{run} --steps 12 --columns time,door,door_rate"));
    let [time, door, rate] = ["time", "door", "door_rate"].map(|name| table.column(name));
    assert_eq!((time.len(), time[12], rate[12]), (13, 6.0, 0.0));
    assert!(door[12].abs() < 1e-20);
}

/// The loads that the example `compressor` prints.
#[test]
fn a_compressor_at_constant_speed() {
    let folder = folder();
    let turn = std::f64::consts::TAU / 150.0;
    let table = Table::of(&folder, &format!("simulate compressor.linkage --branch psi_z=far --to {turn} --steps 720"));
    for (name, expected, error) in [
        ("pressure", 0.8e6, 5e3),
        ("phi_torque", 88.0, 0.05),
        ("piston_pin_on_rod", 3326.0, 0.5),
        ("crank_pin_on_rod", 3093.0, 0.5),
        ("z_normal", 526.0, 0.5),
        ("bearing_on_crank", 3001.0, 0.5),
    ] {
        close(table.largest(name), expected, error);
    }
    // The counterweight and the mass on the balance shaft that it finds.
    let balanced = "--set counterweight=0.605,balance=0.300";
    let run = format!("simulate compressor.linkage --branch psi_z=far --to {turn} --steps 720 {balanced}");
    close(Table::of(&folder, &run).largest("bearing_on_crank"), 3375.0, 1.0);
}

/// The speed, the forces of the last cycle and the energy that the example `engine` prints.
#[test]
fn an_engine_on_its_brake() {
    let folder = folder();
    let start = "simulate engine.linkage --scene Running --branch psi_z=far --at phi=0 --rate phi=200";
    let table = Table::of(&folder, &format!("{start} --to 1.051433277821996 --tolerance 1e-13 --own-steps"));
    let [phi, rate] = ["phi", "phi_rate"].map(|name| table.column(name));
    let last = phi.len() - 1;
    // The example ends its steps at all corners of its gas laws, and its balance of energy is right to 1e-6 J.
    close(phi[last], 40.0 * std::f64::consts::TAU, 5e-8);
    close(rate[last], 231.09215321186463, 1e-8);
    let energy = |row: usize| table.column("kinetic_energy")[row] + table.column("potential_energy")[row];
    close(energy(last) - energy(0), 365.348203, 5e-6);
    let in_cycle = phi.partition_point(|phi| *phi < 38.0 * std::f64::consts::TAU);
    let largest = |name: &str| table.column(name)[in_cycle..].iter().fold(0.0, |most: f64, one| most.max(one.abs()));
    // The example reads them at eight times within each step.
    for (name, expected) in [
        ("pressure", 3.58e6),
        ("piston_on_rod", 18.68e3),
        ("pin_on_rod", 17.34e3),
        ("bearing_on_crank", 18.87e3),
        ("z_normal", 2.09e3),
        ("phi_acceleration", 6479.0),
    ] {
        close(largest(name) / expected, 1.0, 3e-3);
    }
}

/// The torques of weight and spring about the pivot.
fn torque(phi: f64, [m, k]: [f64; 2]) -> f64 {
    let (a, h) = (0.1, 0.15);
    let length = (a * a + h * h - 2.0 * a * h * phi.sin()).sqrt();
    let pull = k * (length - 0.05);
    pull * a * h * phi.cos() / length - m * 9.81 * 0.4 * phi.cos()
}

#[test]
fn a_lamp_in_equilibrium() {
    let folder = folder();
    for (m, k) in [(1.0, 400.0), (1.2, 500.0)] {
        let run = |form: &str| {
            folder.run(&format!("equilibrium lamp.linkage --scene Rest --at phi=30deg --set m={m},k={k} {form}"))
        };
        let found: Value = serde_json::from_str(&run("--format json").works("")).unwrap();
        let [phi, length] = ["coordinates", "outputs"].map(|of| found[of][0]["value"].as_f64().unwrap());
        assert!(torque(phi, [m, k]).abs() < 1e-12 && phi.cos() > 0.1, "{phi}");
        close(length, (0.1_f64 * 0.1 + 0.15 * 0.15 - 2.0 * 0.1 * 0.15 * phi.sin()).sqrt(), 1e-15);
        let text = run("").works("");
        assert!(text.starts_with("Rest: the forces are in equilibrium, stable or not, at\n  phi "), "{text}");
        // A swing with damping ends there.
        let swing = format!("simulate lamp.linkage --scene Swing --at phi=30deg --to 60 --steps 1 --set m={m},k={k}");
        close(Table::of(&folder, &swing).column("phi")[1], phi, 1e-7);
    }
}

/// Driven inputs are where their laws are, at a kink too, and at rest at any time.
#[test]
fn driven_inputs() {
    let folder = folder();
    let table = Table::of(&folder, "simulate two.linkage --scene Driven --at y=1 --from 1 --to 2 --steps 4");
    let times = [1.0, 1.25, 1.5, 1.75, 2.0];
    for (t, y) in times.into_iter().zip(table.column("y")) {
        close(y, (3.0_f64.sqrt() * (t - 1.0)).cos(), 1e-8);
    }
    for (t, x) in times.into_iter().zip(table.column("x")) {
        close(x, 2.0 * t + (t - 1.0), 1e-14);
    }
    assert_eq!(table.column("x_rate"), [3.0; 5]);
    let rest = folder.run("equilibrium two.linkage --scene Held --at x=0,y=0 --time 2 --format json").works("");
    let rest: Value = serde_json::from_str(&rest).unwrap();
    let [x, y] = [0, 1].map(|place: usize| rest["coordinates"][place]["value"].as_f64().unwrap());
    close(x, 2.0, 0.0);
    close(y, -1.0 / 3.0, 1e-15);
}

/// A page has the charts of all that there is, names of a text as text, and no script.
#[test]
fn a_page_of_charts() {
    let folder = folder();
    let ran = folder.run("simulate door_closer.linkage --at door=100deg --to 6 -o door.html");
    assert!(ran.messages.ends_with("6 more events, the last at 4.544670 s: stop on door holds\n"), "{}", ran.messages);
    let page = folder.read("door.html");
    for heading in ["Events", "Coordinates", "Points", "Outputs", "Frictions and stops", "Energy"] {
        assert!(page.contains(&format!("<h2>{heading}</h2>")), "{heading}");
    }
    assert!(
        page.contains("stop on door is hit at 4.213621, 4.437298,")
            && page.contains(" s, and 3 more until 4.544670 s.")
    );
    assert!(!page.contains("<script") && !page.contains("<h2>Drives"));
    folder.run("simulate compressor.linkage --branch psi_z=far --to 0.02 -o turn.html").works("wrote turn.html\n");
    let page = folder.read("turn.html");
    assert!(
        page.contains("<h2>Drives</h2>")
            && page.contains("<h2>Forces in joints</h2>")
            && page.contains("bearing_on_crank")
    );
}

#[test]
fn a_summary_over_time() {
    let folder = folder();
    let run = "simulate two.linkage --scene Driven --at y=1 --from 1 --to 2 --summary --columns x,x_rate";
    let text = folder.run(run).works("");
    assert_eq!(
        text,
        "column  minimum  at time [s]  maximum  at time [s]  swing\n     x        2            1        5            2      3\nx_rate        3            1        3            1      0\n"
    );
}

#[test]
fn what_cannot_be_simulated() {
    let folder = folder();
    for (arguments, code, message) in [
        ("simulate four_bar.linkage --to 1", 2, "`FourBar` has no scene: write one into its text"),
        ("simulate engine.linkage --to 1", 2, "`Engine` has the scenes `Running` and `Motored`: write --scene NAME"),
        ("simulate lamp.linkage --scene Rest --to 1", 2, "the scene `Rest` has no `inertia;`"),
        ("simulate lamp.linkage --scene Swung --to 1", 2, "Lamp has no scene `Swung`, did you mean `Swing`?"),
        ("equilibrium door_closer.linkage", 2, "the scene `Closing` has no `equilibrium;`"),
        ("equilibrium lamp.linkage", 2, "`Lamp` has the scenes `Rest` and `Loose`: write --scene NAME"),
        ("equilibrium lamp.linkage --scene Loose", 2, "the parameter `slack` has no value: write --set slack=VALUE"),
        ("simulate door_closer.linkage --to 1 --set mm=4", 2, "DoorCloser has no parameter `mm`"),
        (
            "simulate door_closer.linkage --to 1 --set widest=110",
            2,
            "`widest` is an angle, and 110 radians are more than a turn",
        ),
        ("simulate door_closer.linkage --to 0", 2, "--from and --to are equal"),
        ("simulate door_closer.linkage --to 10deg", 2, "--to is a plain number, and this is a unit of angles"),
        ("simulate door_closer.linkage --to 1 --columns dor", 2, "the table has no column `dor`; near names: `door`"),
        ("simulate door_closer.linkage --to 1 --rate dor=1", 2, "DoorCloser has no input `dor`, did you mean `door`?"),
        ("simulate door_closer.linkage --to 1 --at door=1,door=2", 2, "--at has `door` twice"),
        ("simulate door_closer.linkage --to 1 --summary -o a.html", 2, "a page has all charts: leave out --summary"),
        ("simulate door_closer.linkage --to 1 -o a.pdf", 2, "a simulation is CSV, JSON, text or HTML"),
        (
            "simulate door_closer.linkage --to -1",
            1,
            "Closing has a stop on door and cannot be simulated backwards in time",
        ),
        ("simulate door_closer.linkage --to 1 --at door=150deg", 1, "DoorCloser cannot be assembled at door = 150°"),
        ("simulate door_closer.linkage --to 1 --tolerance 1e-20", 1, "the relative tolerance is 1e-20"),
        ("simulate two.linkage --scene Driven --to 1", 2, "the input `y` has no value: write --at y=VALUE"),
        ("simulate two.linkage --scene Driven --to 1 --at x=4,y=1", 1, "Driven"),
        ("simulate two.linkage --scene Driven --to 1 --at y=1 --rate y=2rpm", 2, "`y` is a length"),
    ] {
        let ran = folder.run(arguments);
        assert!(ran.code == Some(code) && ran.output.is_empty(), "{arguments}: {ran:?}");
        assert!(ran.messages.starts_with(&format!("error: {message}")), "{arguments}: {}", ran.messages);
    }
}

/// The rows before the end of a motion are printed, and the exit code says that there is an end.
#[test]
fn a_motion_that_ends() {
    let folder = folder();
    folder.write(
        "pole.linkage",
        "mechanism Pole {
        input x;
        body ball { mass 1; center (x, 0); }
        scene Falling { inertia; potential -1 / x; }
    }",
    );
    let ran = folder.run("simulate pole.linkage --at x=1 --to 5 --steps 5 --columns time,x");
    assert_eq!(ran.code, Some(1));
    assert!(ran.messages.starts_with("error: the motion ends at 1.1107"), "{}", ran.messages);
    let rows: Vec<&str> = ran.output.lines().collect();
    assert!(rows.len() == 7 && rows[1] == "0,1" && rows[3] == "2," && rows[6] == "5,", "{rows:?}");
}

/// Stops whose gap ends or whose bounds cross: the error names effect and time, and the rows before it stay.
#[test]
fn stops_without_a_gap() {
    let folder = folder();
    folder.write(
        "gaps.linkage",
        "mechanism Gaps { param low = -1, high = 1; input x; body b { mass 1; center (x, 0); } \
         scene Root { inertia; torque -1 on x; stop sqrt(x) in -1..5, restitution 1; } \
         scene Sine { inertia; torque -1 on x; stop asin(x) in -1..2, restitution 1; } \
         scene Crossed { inertia; stop x in low..high, restitution 1; } }",
    );
    for (arguments, rows, message) in [
        (
            "Root --at x=0.5",
            "0,0.5\n0.6,0.32\n1.2,\n",
            "the motion ends at 1.000000 s: stop on sqrt(x) of Root is not a finite number",
        ),
        (
            "Sine --at x=0.95 --rate x=0.5",
            "0,0.95\n0.6,\n1.2,\n",
            "the motion ends at 0.112702 s: stop on asin(x) of Sine is not a finite number",
        ),
        (
            "Crossed --at x=0 --set low=2",
            "",
            "the stop on x in Crossed is from 2 to 1: the first must be less than the second",
        ),
    ] {
        let ran = folder
            .run(&format!("simulate gaps.linkage --to 1.2 --steps 2 --columns time,x --digits 12 --scene {arguments}"));
        assert_eq!((ran.code, ran.messages), (Some(1), format!("error: {message}\n")));
        assert_eq!(ran.output.split_once('\n').map_or("", |(_, rows)| rows), rows);
    }
}

/// At an impact a point has no acceleration: a message says which rows have empty cells, and why.
#[test]
fn cells_without_a_number_are_named() {
    let folder = folder();
    folder.write(
        "wall.linkage",
        "mechanism Wall {
        input x;
        point P = (x, 0);
        body ball { mass 1; center P; }
        scene Bouncing { inertia; gravity (-10, 0); stop x in 0..9, restitution 0.5; }
    }",
    );
    let ran = folder.run("simulate wall.linkage --at x=5 --to 1.5 --own-steps --columns time,P_acceleration_x");
    assert_eq!(ran.code, Some(0));
    let messages: Vec<&str> = ran.messages.lines().collect();
    assert_eq!(messages[0], "at 1.000000 s: stop on x is hit");
    assert!(messages[1].starts_with("1 row has empty cells; the first, at 1.000000 s: "), "{messages:?}");
}

/// Laws with one kink of the state near the start, where the time is known far more finely than the state.
#[test]
fn kinks_near_the_start() {
    let folder = folder();
    folder.write(
        "bumper.linkage",
        "mechanism Bumper { param m = 1, k = 1e3, b = 0.1; input s; body a { mass m; center (s, 0); } \
         scene S { inertia; torque -k*(s - b + abs(s - b))/2 on s; } }",
    );
    let last = |arguments: &str, columns: &[&str]| -> Vec<f64> {
        let table = Table::of(&folder, &format!("simulate {arguments} --steps 1 --tolerance 1e-10"));
        columns.iter().map(|column| *table.column(column).last().unwrap()).collect()
    };
    // Half a period of the spring, then back.
    let frequency = 1e3_f64.sqrt();
    for gap in [1.1e-3, 1e-3, 1e-4, 1e-5, 1e-7, 1e-10, 1e-13, 1e-15, 0.0] {
        let found = last(&format!("bumper.linkage --at s={} --rate s=1 --to 0.15", 0.1 - gap), &["s", "s_rate"]);
        close(found[0], 0.1 - (0.15 - gap - std::f64::consts::PI / frequency), 1e-8);
        close(found[1], -1.0, 1e-7);
    }
    // A slider in a slotted arm, whose rate passes zero with its kink: a constant torque on each side, and resistance of the air,
    // which has a second derivative that jumps.
    folder.write(
        "arm.linkage",
        "mechanism Arm { input th; unknown p, x; loop 0.71@th = 1.62@0 + x@p - 0.489@(p + 90deg); \
         body b { inertia 1; angle th; } scene Dry { inertia; torque -abs(rate(p)) on p; } \
         scene Air { inertia; torque -0.3*rate(p)*abs(rate(p)) on p; } }",
    );
    for scene in ["Dry", "Air"] {
        let columns = ["th", "th_rate"];
        // From where the kink is far, to the start and on.
        let run = |from: &str, rate: f64, to: f64| {
            last(&format!("arm.linkage --scene {scene} --at th={from}rad --rate th={rate} --to {to}"), &columns)
        };
        let mut angle = 1.6;
        let mut rate = -1.0;
        for to in [0.1, 0.05, 0.012, 0.001, 0.0006, 0.0001] {
            let [next, after] = run(&angle.to_string(), rate, to)[..] else { panic!() };
            (angle, rate) = (next, after);
        }
        let whole = run("1.6", -1.0, 0.1 + 0.05 + 0.012 + 0.001 + 0.0006 + 0.0001);
        close(angle, whole[0], 1e-9);
        close(rate, whole[1], 1e-8);
        for from in ["1.436", "1.4365", "1.44", "1.45"] {
            let halves = run(from, -1.0, 0.25);
            let halves = run(&halves[0].to_string(), halves[1], 0.25);
            let whole = run(from, -1.0, 0.5);
            close(halves[0], whole[0], 1e-9);
            close(halves[1], whole[1], 1e-8);
        }
    }
    // The engine from where its valves and its gas have their kinks.
    for degrees in ["-20.1", "-20.0001", "-19.9"] {
        last(&format!("engine.linkage --scene Running --at phi={degrees}deg --rate phi=150 --to 0.01"), &["phi"]);
    }
}

/// A kink in every few milliseconds, in steps that would be longer: each is passed, and the motion has the work of the force.
#[test]
fn kinks_in_every_step() {
    let folder = folder();
    folder.write(
        "ribs.linkage",
        "mechanism Ribs { param k = 147; input s; body b { mass 1; center (s, 0); } \
         scene Rough { inertia; torque -abs(sin(k*s)) on s; } scene Drag { inertia; torque -rate(s)*abs(sin(k*s)) on s; } \
         scene Sheet { inertia; torque -atan2(sin(k*s), 2 + cos(s)) on s; } }",
    );
    // The forces, with a rate.
    type Force = fn(f64, f64) -> f64;
    let ribs: Force = |s, _| -(147.0 * s).sin().abs();
    let drag: Force = |s, v| -v * (147.0 * s).sin().abs();
    let sheet: Force = |s, _| -(147.0 * s).sin().atan2(2.0 + s.cos());
    for (scene, force) in [("Rough", ribs), ("Drag", drag), ("Sheet", sheet)] {
        for tolerance in [1e-4, 1e-7] {
            let question = "simulate ribs.linkage --at s=0.01 --rate s=4 --to 1 --own-steps";
            let table = Table::of(&folder, &format!("{question} --scene {scene} --tolerance {tolerance}"));
            let [s, rate] = ["s", "s_rate"].map(|column| *table.column(column).last().unwrap());
            // v dv = f ds and dt = ds / v, by the rule of midpoints in some thousand parts of each wave.
            const PARTS: u32 = 100_000;
            let part = (s - 0.01) / f64::from(PARTS);
            let (mut v, mut t) = (4.0, 0.0);
            for place in 0..PARTS {
                let middle = 0.01 + (f64::from(place) + 0.5) * part;
                let half = v + 0.5 * part * force(middle, v) / v;
                t += part / half;
                v += part * force(middle, half) / half;
            }
            // The tolerance is that of each step, here for a rate of 4.
            let all = table.column("time").len() as f64 * 4.0 * tolerance;
            close(t, 1.0, all);
            close(rate, v, all);
        }
    }
}

/// A row at the time of a kink is that before it, and a friction whose limit grows from zero at a place holds a body at rest.
#[test]
fn rows_and_frictions_at_kinks() {
    let folder = folder();
    folder.write(
        "k.linkage",
        "mechanism K { param m = 1; input s; body a { mass m; center (s, 0); } \
         scene S { inertia; torque (t - 0.4)/abs(t - 0.4) on s; } scene D { inertia; drive s = abs(t - 0.4); } \
         scene F { inertia; torque 1 on s; friction 0.5 + abs(t - 0.4) - (t - 0.4), 0.5 on s; } }",
    );
    let table = Table::of(&folder, "simulate k.linkage --scene S --at s=0 --to 1 --steps 5");
    for (row, t) in [0.0, 0.2, 0.4, 0.6, 0.8, 1.0].into_iter().enumerate() {
        let after = f64::max(t - 0.4, 0.0);
        let before = t - after;
        close(table.column("s")[row], -before * before / 2.0 - before * after + after * after / 2.0, 1e-14);
        close(table.column("s_rate")[row], after - before, 1e-14);
        close(table.column("s_acceleration")[row], if t > 0.4 { 1.0 } else { -1.0 }, 1e-14);
    }
    let table = Table::of(&folder, "simulate k.linkage --scene D --at s=0.4 --rate s=-1 --to 1 --steps 5");
    close(table.column("s")[2], 0.0, 1e-15);
    close(table.column("s_rate")[2], -1.0, 1e-15);
    let table = Table::of(&folder, "simulate k.linkage --scene F --at s=0 --to 1 --steps 5");
    assert!(table.column("s_rate").iter().all(|rate| rate.is_finite()));
    folder.write(
        "rising.linkage",
        "mechanism Rising { param k = 1; input x, z; body a { mass 1; center (x, 0); } body c { mass 1; center (z, 0); } \
         scene Held { inertia; friction k, abs(x) + x on z; } \
         scene Pulled { inertia; torque 0.5 on z; friction k, abs(x) + x on z; } }",
    );
    let table = Table::of(&folder, "simulate rising.linkage --scene Held --at x=-0.1,z=0 --rate x=1 --to 1 --steps 4");
    close(table.column("x")[4], 0.9, 1e-12);
    assert_eq!((table.largest("z"), table.largest("z_rate")), (0.0, 0.0));
    // Pulled by 1/2 until x = 0, then against 2 x too, where x = u: z' = 0.05 + u/2 - u^2 until it is zero.
    let table =
        Table::of(&folder, "simulate rising.linkage --scene Pulled --at x=-0.1,z=0 --rate x=1 --to 1.1 --steps 11");
    let rest = (0.5 + (0.25_f64 + 0.2).sqrt()) / 2.0;
    let after = |u: f64| 0.0025 + 0.05 * u + u * u / 4.0 - u * u * u / 3.0;
    for (row, z) in table.column("z").into_iter().enumerate() {
        let u = 0.1 * row as f64 - 0.1;
        close(z, if u < 0.0 { (u + 0.1).powi(2) / 4.0 } else { after(u.min(rest)) }, 1e-8);
    }
}

/// A parallelogram near its change point, where positions are interpolated: all loops hold to rounding errors in every row, also
/// that of a slider which is not singular there.
#[test]
fn rows_near_a_change_point_hold() {
    let folder = folder();
    folder.write(
        "parallelogram.linkage",
        "mechanism Parallelogram { input z; unknown a, b, c, s; loop 0.692@z + 3.54@a = 0.692@0 + 3.54@b; \
         loop 1.831@z + 3.234@c = 1.377@0 + s@0.75 + 0.27@(0.75 + 90deg); point P = 1.831@z + 3.234@c; \
         body coupler { mass 1; inertia 0.5; center P; angle a; } scene Fall { inertia; gravity (0, -1); } }",
    );
    let command =
        "simulate parallelogram.linkage --branch=a_b=right,c_s=near --at=z=-0.293rad --to=1.5 --steps=6 --rate=z=0.4";
    let rows = Table::of(&folder, command);
    let [z, a, b, c, s] = ["z", "a", "b", "c", "s"].map(|name| rows.column(name));
    assert_eq!(z.len(), 7);
    for row in 0..z.len() {
        let (turned, right) = (0.75 + 0.5 * std::f64::consts::PI, -std::f64::consts::PI);
        let first = [(0.692, z[row]), (3.54, a[row]), (0.692, right), (3.54, b[row] + right)];
        let second = [(1.831, z[row]), (3.234, c[row]), (1.377, right), (s[row], 0.75 + right), (0.27, turned + right)];
        for terms in [&first[..], &second[..]] {
            let largest = terms.iter().fold(0.0_f64, |largest, (length, _)| largest.max(length.abs()));
            for part in [f64::cos, f64::sin] {
                let residual: f64 = terms.iter().map(|(length, angle)| length * part(*angle)).sum();
                close(residual / largest, 0.0, 8.0 * f64::EPSILON);
            }
        }
    }
}

/// A column for what the scene asks for, names with commas, a kink that empties its own cells alone, and a limit of steps.
#[test]
fn columns_of_scenes() {
    let folder = folder();
    folder.write(
        "columns.linkage",
        "mechanism Columns { param m = 2, c = 3, f = 5; input x, y; body a { mass m; center (x, 0); } \
         body b { mass m; center (y, 0); } output o = abs(x - 0.05); output p = 2*x; \
         scene Pushed { inertia; force (f, 0) at (x, 0); damper c on x; power; } \
         scene Stopped { inertia; stop atan2(y - x, 1) in -2..2, restitution 0; } \
         scene Driven { inertia; drive x = 0.1*t; } }",
    );
    let of = |columns: &str, more: &str| {
        let command = format!("simulate columns.linkage --at x=0,y=0 --to 1 --steps 4 --columns {columns} {more}");
        folder.run(&command)
    };
    let power = of("x_rate,applied_power,dissipated_power", "--scene Pushed").works("");
    for row in power.lines().skip(1) {
        let numbers: Vec<f64> = row.split(',').map(|number| number.parse().unwrap()).collect();
        close(numbers[1], 5.0 * numbers[0], 1e-12);
        close(numbers[2], 3.0 * numbers[0] * numbers[0], 1e-12);
    }
    let mut command =
        folder.command("simulate columns.linkage --scene Stopped --at x=0,y=0 --to 1 --steps 1 --format text");
    let output = command.args(["--columns", "y, stop on atan2(y - x, 1) ,x"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(text, "y  stop on atan2(y - x, 1)  x\n0                        0  0\n0                        0  0\n");
    let message = "1 row has empty cells; the first, at 0.500000 s: a kink, where there is no o_rate, o_acceleration\n";
    let rows = of("o,o_rate,p,p_rate", "--scene Driven --digits 9").works(message);
    let cells: Vec<&str> = rows.lines().nth(3).unwrap().split(',').collect();
    assert_eq!(cells[1..], ["", "0.1", "0.2"], "{rows}");
    close(cells[0].parse().unwrap(), 0.0, 1e-15);
    let few = of("x", "--scene Pushed --most-steps 2 --tolerance 1e-12").messages;
    assert!(few.contains("the limit of 2 steps is reached at ") && few.contains("or more steps"), "{few}");
}

/// A gap that oscillates many times in a step, since the motion is uniform: the cam of a wheel on a cart comes to a wall, and a
/// sine of the place. The first impacts are known from roots in 31 digits.
#[test]
fn no_impact_between_samples_is_missed() {
    let folder = folder();
    folder.write(
        "cam.linkage",
        "mechanism Cam { param m = 1, j = 0.01, r = 0.1, wall = 1; input x, phi; body cart { mass m; center (x, 0); } \
         body wheel { inertia j; angle phi; } scene Going { inertia; stop x + r*cos(phi) in -10..wall, restitution 0.5; } }",
    );
    folder.write(
        "sine.linkage",
        "mechanism Sine { param m = 1; input x; body b { mass m; center (x, 0); } \
         scene Going { inertia; stop x/5*sin(20*x) in -2..0.9, restitution 1; } }",
    );
    for tolerance in ["1e-3", "1e-6", "1e-9", "1e-12"] {
        let first = |command: &str| {
            let run = folder.run(&format!("simulate {command} --own-steps --tolerance={tolerance}"));
            let (_, after) = run.messages.split_once("at ").unwrap_or_else(|| panic!("{}", run.messages));
            after.split_once(" s: stop on ").unwrap_or_else(|| panic!("{after}")).0.to_owned()
        };
        assert_eq!(first("cam.linkage --at x=0,phi=0.3 --rate x=0.3,phi=20 --to 4"), "3.089155", "{tolerance}");
        assert_eq!(first("sine.linkage --at x=0 --rate x=1 --to 5"), "4.773909", "{tolerance}");
    }
}

/// A heavy block follows a light one that is pushed to a wall: the light one strikes the wall and the heavy one in turn, at
/// intervals that shrink to nothing, and takes 0.827 of the rate with each two impacts. Both rest at the wall, wherever it is.
#[test]
fn two_stops_in_turn() {
    let folder = folder();
    folder.write(
        "turn.linkage",
        "mechanism Turn { param heavy = 10, light = 1, push = 1, wall = 0, e = 0.9; input x, y; \
         body a { mass heavy; center (x, 0); } body b { mass light; center (y, 0); } \
         scene Pushed { inertia; force (push, 0) at (y, 0); stop y in wall - 9..wall, restitution e; \
         stop y - x in 0..9, restitution 0; } }",
    );
    for (wall, precision) in [(0.0, 1e-12), (1000.0, 1e-9), (100_000.0, 1e-7)] {
        let [x, y] = [wall - 1.0, wall - 0.2];
        let of = |more: &str| {
            let command = format!("simulate turn.linkage --set wall={wall} --at x={x},y={y} --rate x=1 --to 2 {more}");
            Table::of(&folder, &command)
        };
        let rates = of("--own-steps").column("x_rate");
        let mut distinct = rates.clone();
        distinct.dedup_by(|one, other| (*one - *other).abs() < 1e-6);
        // One impact after the other, by hand: of the block with the wall, then with the other one.
        let known = [1.0, 0.880_520, 0.718_999, 0.594_398];
        known.iter().zip(&distinct).for_each(|(known, found)| close(*found, *known, 1e-5));
        let rows = of("--steps 8");
        for name in ["x", "y"] {
            close(*rows.column(name).last().unwrap() - wall, 0.0, precision);
            close(*rows.column(&format!("{name}_rate")).last().unwrap(), 0.0, 0.0);
        }
    }
}
