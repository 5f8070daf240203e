//! Angles that an equation takes as numbers: every command answers for the position that is asked for, on its turn.
//!
//! Expected values were computed apart, dyad by dyad, and for the wheel before two loops by a continuation by small steps.

use serde_json::Value;

use super::folder::Folder;

/// A wheel between two dyads: its angle has other turns than its direction.
const BETWEEN: &str = "mechanism Between {
    param a = 1, c = 3;
    input t;
    unknown p, q, u, r, s;
    loop a@t + c@p = 3.5@0 + 2.5@q;
    equation u = 2*p - t;
    loop a@u + c@r = 3.5@0 + 2.5@s;
}";

/// A wheel before two loops that are solved together.
const BEFORE: &str = "mechanism Before {
    param a = 1.318787, b = 0.694, c = 0.75474, d = 1.037, e = 0.926, f = 1.655198, h = 1.143275, k = 1.26;
    input z;
    unknown w, t, p, s, u;
    equation w = 3*z;
    point Z = 1@z;
    loop a@t + b@p - c@s - d@0 = 0;
    loop a@t + e@(p - 1.263) + f@u - h@w - k@0 = 0;
}";

/// The wheel between two dyads with a spring that counts its turns.
const SPRING: &str = "mechanism Between {
    param a = 1, c = 3, m = 1, g = 9.81, k = 0.2, j = 1;
    input theta;
    unknown p, q, u, r, s;
    loop a@theta + c@p = 3.5@0 + 2.5@q;
    equation u = 2*p - theta;
    loop a@u + c@r = 3.5@0 + 2.5@s;
    point C = a@u + c@r;
    body tip { mass m; center C; }
    body crank { inertia j; angle theta; }
    scene Hung { inertia; gravity (0, -g); spring k on u; equilibrium; energy; }
}";

fn folder() -> Folder {
    let folder = Folder::new();
    for (name, text) in [
        ("between", BETWEEN.to_owned()),
        ("once", BETWEEN.replace("2*p - t", "p - t")),
        ("before", BEFORE.to_owned()),
        ("spring", SPRING.to_owned()),
    ] {
        folder.write(&format!("{name}.linkage"), text);
    }
    folder
}

fn json(folder: &Folder, arguments: &str) -> Value {
    serde_json::from_str(&folder.run(&format!("{arguments} --format json")).works("")).unwrap()
}

/// A column of a table in JSON, in degrees.
fn column(table: &Value, name: &str) -> Vec<f64> {
    let found = table["columns"].as_array().unwrap().iter().find(|column| column["name"] == name);
    let values = found.unwrap_or_else(|| panic!("{name}: {table}"))["values"].as_array().unwrap().iter();
    values.map(|value| value.as_f64().unwrap().to_degrees()).collect()
}

#[track_caller]
fn near(found: f64, expected: f64, error: f64) {
    assert!((found - expected).abs() < error, "{found} is not {expected}");
}

const RIGHT: &str = "--branch p_q=right,r_s=right";

#[test]
fn a_wheel_between_groups() {
    let folder = folder();
    for name in ["between", "once"] {
        for degrees in (10..360).step_by(90).chain([100]) {
            let limits = json(&folder, &format!("limits {name}.linkage --at t={degrees}deg"));
            let positions = limits["positions"].as_array().unwrap();
            assert_eq!(positions.len(), 4);
            for position in positions {
                assert_eq!((&position["closes_after_turns"], &position["fails"]), (&Value::from(1), &Value::Null));
            }
        }
    }
    let table = json(&folder, &format!("table between.linkage {RIGHT} --from 100deg --to 140deg --steps 1"));
    let [p, u, r] = ["p", "u", "r"].map(|name| column(&table, name));
    near(u[0], 2.0 * p[0] - 100.0, 1e-11);
    near(r[0], -40.388_062_265_324_54, 1e-9);
    near(r[1], -44.912_752_346_746_66, 1e-9);
    for steps in [12, 120] {
        let table = json(
            &folder,
            &format!("table between.linkage {RIGHT} --from 100deg --to 460deg --steps {steps} --columns u,r"),
        );
        let [u, r] = ["u", "r"].map(|name| column(&table, name));
        near(r[0], -40.388_062_265_324_54, 1e-9);
        near(*r.last().unwrap(), r[0], 1e-9);
        near(*u.last().unwrap(), u[0] - 360.0, 1e-9);
    }
    // On another turn the position is the same.
    let table = json(&folder, &format!("table between.linkage {RIGHT} --from 3700deg --to 3740deg --steps 1"));
    near(column(&table, "r")[0], -40.388_062_265_324_54, 1e-9);
    let film = folder.run(&format!("animate between.linkage {RIGHT} --from 100deg --to 460deg --steps 12 -o film.svg"));
    assert_eq!(film.code, Some(0), "{}", film.messages);
}

#[test]
fn a_wheel_before_loops() {
    let folder = folder();
    // Modes 0 and 1, 2 and 3, 4 and 5 meet at the dead points.
    let ends = [[233.2615, 390.703], [212.5522, 274.6732], [113.2615, 270.703]];
    let limits = json(&folder, "limits before.linkage --at z=4.359rad");
    let positions = limits["positions"].as_array().unwrap();
    assert_eq!(positions.len(), 6);
    for (place, position) in positions.iter().enumerate() {
        for (end, expected) in ["from", "to"].iter().zip(ends[place / 2]) {
            near(position[end]["input"].as_f64().unwrap().to_degrees(), expected, 1e-3);
            assert_eq!(position[end]["group"], "t, p, s, u", "{position}");
        }
        near(position["unknowns"][0].as_f64().unwrap(), 3.0 * 4.359, 1e-14);
    }
    let mode = "--branch t_p_s_u=0";
    let table = json(&folder, &format!("table before.linkage {mode} --from 4.359rad --to 4.36rad --steps 1"));
    near(column(&table, "t")[0], -65.93, 5e-3);
    near(column(&table, "w")[1], (3.0_f64 * 4.36).to_degrees(), 1e-11);
    let proof = json(&folder, &format!("certify before.linkage {mode} --from 4.359rad --to 4.4rad"));
    for end in ["least", "largest"] {
        let bounds = proof["velocity_ratios"][0][end].as_array().unwrap();
        bounds.iter().for_each(|bound| near(bound.as_f64().unwrap(), 3.0, 1e-14));
    }
    // The wheel is never the group that locks.
    let ran = folder.run(&format!("certify before.linkage {mode} --from 4.359rad"));
    assert!(ran.code == Some(1) && ran.messages.contains("a dead point of t, p, s, u;"), "{}", ran.messages);
}

#[test]
fn a_spring_on_a_wheel() {
    let folder = folder();
    let found = folder.run(&format!("equilibrium spring.linkage {RIGHT} --at theta=100deg")).works("");
    // The least energy of the motion through this position.
    assert!(found.contains("theta  158.8781°\n") && found.contains("u      -232.98°\n"), "{found}");
    let table = json(&folder, &format!("simulate spring.linkage {RIGHT} --at theta=100deg --to 0.2 --steps 2"));
    near(column(&table, "r")[0], -40.388_062_265_324_54, 1e-9);
    let [theta, p, u] = ["theta", "p", "u"].map(|name| column(&table, name));
    for row in 0..3 {
        near(u[row], 2.0 * p[row] - theta[row], 1e-7);
    }
}

/// An equation of angles makes its other terms angles: the input of a wheel has a turn, and so has one of several wheels.
#[test]
fn angles_by_equations() {
    let folder = Folder::new();
    let end = "\n    point Mark = 3@psi;\n    derive intervals;\n}";
    for (name, text, turns) in [
        ("pair", "mechanism Wheels { input theta; unknown psi; equation 2 * psi = -theta;", 2),
        (
            "train",
            "mechanism Wheels { input theta; unknown c, b, psi; equation 3*b = c; equation psi = b/2; equation c = -theta;",
            6,
        ),
        ("sum", "mechanism Wheels { input theta; unknown c, psi; equation c + theta = 4*psi; equation c = theta;", 2),
    ] {
        folder.write(&format!("{name}.linkage"), format!("{text}{end}"));
        let names = folder.run(&format!("names {name}.linkage")).works("");
        assert!(names.contains("theta  angle in radians\n"), "{names}");
        let statement = |turns: u32| folder.run(&format!("certify {name}.linkage --turns {turns}")).works("");
        let closed = statement(turns);
        assert!(closed.contains(", at its start again\n"), "{closed}");
        assert!(!statement(turns - 1).contains("at its start again"), "{name}");
    }
    // A rack with a number for its radius is a length, and a product may be anything.
    for text in [
        "mechanism Rack { input s; unknown psi; equation 2 * psi = s; loop_ }",
        "mechanism Rack { param k = 2; input x; unknown psi; equation psi = k*x; point P = 1@psi; }",
    ] {
        let text = text.replace("loop_", "point P = 1@psi + (s, 0);");
        folder.write("rack.linkage", text);
        assert!(folder.run("names rack.linkage").works("").contains("length or number\n"));
    }
}
