//! Why there is no position, in plain words and with the user's names: which link is too short or too long, and by how much.

use super::folder::Folder;

const FOUR_BAR: &str = "mechanism FourBar {
    param l1 = 80, l2 = 20, l3 = 50, L4 = 70;
    input theta2;
    unknown theta3, theta4;
    loop l2@theta2 + l3@theta3 + L4@theta4 = l1@0;
}";

/// The second dyad reaches its frame on one branch of the first one only.
const SIX_BAR: &str = "mechanism SixBar {
    param a = 2, b = 5, c = 5, d = 6, e = 4, f = 4.5;
    input t;
    unknown p, q, r, s;
    loop a@t + b@p = d@0 + c@q;
    loop a@t + b@p + e@r = (d, 12) + f@s;
}";

fn folder() -> Folder {
    let folder = Folder::new();
    let slider =
        "mechanism Slider { param r = 2, l = 3, h = 0.5; input phi; unknown psi, s; loop r@phi + l@psi = (s, h); }";
    let angle = "mechanism Angle { param r = 2, l = 3; input phi; unknown psi; equation r*sin(phi) + l*sin(psi) = 4; }";
    let point = "mechanism Point { param a = 3, b = 2.5, d = 4; input z; unknown x, y; \
                 equation norm((x, y)) = a; equation norm((x - d - z, y)) = b; }";
    let two = "mechanism Two { param l = 3; input t; unknown p, q; loop l@t + (2*l)@p = (l + 9)@0 + l@q; }";
    let guide =
        "mechanism Guide { param a = 1, d = 2, h = 0.5; input t; unknown p, s; loop a@t = d@0 + s@p + h@(p + 90deg); }";
    let all = [
        ("four", FOUR_BAR),
        ("six", SIX_BAR),
        ("slider", slider),
        ("angle", angle),
        ("point", point),
        ("two", two),
        ("guide", guide),
    ];
    for (name, text) in all {
        folder.write(&format!("{name}.linkage"), text);
    }
    folder
}

/// The numbers are those of the law of cosines, computed independently.
#[test]
fn links_that_do_not_reach() {
    let folder = folder();
    for (arguments, message) in [
        (
            "four.linkage --set l2=300",
            "FourBar cannot be assembled at theta2 = 60°: group theta3, theta4 does not close, since `l3` and `L4` together are 149.07 too short: their ends are 269.07 \
             apart",
        ),
        (
            "four.linkage --set l2=80 --at theta2=1deg",
            "FourBar cannot be assembled at theta2 = 1°: group theta3, theta4 does not close, since `L4` is 18.604 too long, or `l3` too short: their ends are only \
             1.3962 apart",
        ),
        (
            "four.linkage --set l2=80,l3=100 --at theta2=1deg",
            "FourBar cannot be assembled at theta2 = 1°: group theta3, theta4 does not close, since `l3` is 28.604 too long, or `L4` too short: their ends are only \
             1.3962 apart",
        ),
        (
            "slider.linkage --set l=1 --at phi=90deg",
            "Slider cannot be assembled at phi = 90°: group psi does not close, since `l` is 0.5 too short: the line on which its end is lies 1.5 away",
        ),
        (
            "slider.linkage --set l=1,h=-0.5 --at phi=90deg",
            "Slider cannot be assembled at phi = 90°: group psi does not close, since `l` is 1.5 too short: the line on which its end is lies 2.5 away",
        ),
        (
            "angle.linkage --at phi=-90deg",
            "Angle cannot be assembled at phi = -90°: group psi does not close, since `l` is 3 too short: the line on which its end is lies 6 away",
        ),
        (
            "point.linkage --at z=3",
            "Point cannot be assembled at z = 3: group x, y does not close, since `a` and `b` together are 1.5 too short: their ends are 7 apart",
        ),
        (
            "two.linkage --at t=180deg",
            "Two cannot be assembled at t = 180°: group p, q does not close, since `2*l` and `l` together are 6 too short: their ends are 15 apart",
        ),
        (
            "guide.linkage --set h=1.25 --at t=0deg",
            "Guide cannot be assembled at t = 0°: group p, s does not close, since its joints are 0.25 too near: they are only 1 apart, and the line that turns \
             lies 1.25 away from one of them",
        ),
    ] {
        folder.run(&format!("draw {arguments}")).fails(1, &format!("error: {message}\n"));
    }
}

/// The first dyad has positions: the branch decides whether the second one has.
#[test]
fn links_of_a_later_group() {
    let folder = folder();
    // At 60 degrees: A = (1, sqrt(3)), D = (6, 0); P is on circles of 5 about both, and the pin is at (6, 12).
    let (ax, ay, dx) = (1.0_f64, 3_f64.sqrt(), 6.0);
    let length = ((dx - ax).powi(2) + ay * ay).sqrt();
    let height = (25.0 - length * length / 4.0).sqrt();
    let (mx, my) = ((ax + dx) / 2.0, ay / 2.0);
    let at = |sign: f64| (mx + sign * height * ay / length, my + sign * height * (dx - ax) / length);
    let distance = |(x, y): (f64, f64)| ((x - 6.0).powi(2) + (y - 12.0).powi(2)).sqrt();
    let [near, far] = [at(1.0), at(-1.0)].map(distance);
    assert!(near < 8.5 && far > 8.5);
    let runs = ["left", "right"].map(|side| folder.run(&format!("draw six.linkage --branch p_q={side}")));
    let failed: Vec<&str> = runs.iter().filter(|ran| ran.code == Some(1)).map(|ran| ran.messages.as_str()).collect();
    let [message] = failed.as_slice() else { panic!("{runs:?}") };
    let five = |value: f64| format!("{value:.4e}").parse::<f64>().unwrap();
    let expected = format!(
        "error: SixBar cannot be assembled at t = 60°: group r, s does not close, since `e` and `f` together are {} too short: their ends are {} apart\n",
        five(far - 8.5),
        five(far)
    );
    assert_eq!(*message, expected);
}

/// No message has a measure of a method, a function of Rust, or radians with all digits.
#[test]
fn messages_are_plain() {
    let folder = folder();
    let odd = "mechanism Odd { param a = 1; input phi; unknown s; equation s + exp(s) = a*phi; }";
    let ranged = "mechanism Ranged { param a = 2, b = 5, c = 5, d = 6; input t in 10deg..100deg; unknown p, q in 100deg..110deg; \
                  loop a@t + b@p = d@0 + c@q; point P = a@t; }";
    let parallel = "mechanism Parallel { param a = 4, b = 2; input t; unknown p, q; loop b@t + a@p = a@0 + b@q; }";
    let triad = "mechanism Triad { param a = 4.9, b = 1.23, c = 4.18, d = 1.52, e = 4.26; input theta; unknown p, q, r, s; \
                 loop a@p + b@q = d@0 + c@r; loop a@p + (0.83, -2.31)@q + e@s = (2.04, 1.17) + 20@theta; }";
    for (name, text) in [("odd", odd), ("ranged", ranged), ("parallel", parallel), ("triad", triad)] {
        folder.write(&format!("{name}.linkage"), text);
    }
    for arguments in [
        "table four.linkage --set l2=300 --steps 4",
        "circuits four.linkage --set l2=300",
        "report four.linkage --set l2=300",
        "draw odd.linkage --at phi=1 --guess s=700",
        "table ranged.linkage --from 20deg --to 90deg --steps 4",
        "limits ranged.linkage --at t=160deg",
        "draw parallel.linkage --at t=0",
        "limits parallel.linkage --at t=0",
        "draw triad.linkage",
        "draw triad.linkage --branch p_q_r_s=40",
    ] {
        let ran = folder.run(arguments);
        let said = ran.messages.clone() + &ran.output;
        for word in
            ["residual", "trials", "relative", "regularity", "Newton", "assemble_near", "`solve`", "::", "most_steps"]
        {
            assert!(!said.contains(word), "{arguments}: {said}");
        }
        // An angle has degrees, and no number in a message more than nine digits.
        let longest = ran.messages.split(|letter: char| !letter.is_ascii_digit()).map(str::len).max();
        assert!(longest.unwrap_or_default() <= 9, "{arguments}: {said}");
    }
    for (arguments, message) in [
        (
            "limits ranged.linkage --at t=160deg",
            "error: at t = 160°, t of Ranged is 160°: it must be between 10° and 100°",
        ),
        ("draw triad.linkage", "error: Triad has no position here: the links of p, q, r, s do not reach each other\n"),
    ] {
        let ran = folder.run(arguments);
        assert!(ran.code == Some(1) && ran.messages.starts_with(message), "{ran:?}");
    }
}

/// Two dyads that lock at the same input: the end has one name on all branches and at both sides.
#[test]
fn mirrored_ends_have_one_name() {
    let folder = Folder::new();
    for lengths in
        ["a = 3, b = 2, c = 2.5, d = 4", "a = 3.3, b = 1.7, c = 2.9, d = 4.4", "a = 1.9, b = 1.3, c = 1.1, d = 3.05"]
    {
        let text = format!(
            "mechanism Twin {{ param {lengths}; input t; unknown P, q, u, v; loop a@t + b@P = d@0 + c@q; \
             loop (2*a)@t + (2*b)@u = (2*d)@0 + (2*c)@v; }}"
        );
        folder.write("twin.linkage", &text);
        let limits = folder.run("limits twin.linkage --at t=30deg").works("");
        assert_eq!(limits.matches("(change point of P, q and u, v)").count(), 8, "{limits}");
        let circuits = folder.run("circuits twin.linkage --at t=30deg").works("");
        assert!(circuits.contains("change point of P, q and u, v at t ="), "{circuits}");
        assert!(!circuits.contains("point of P, q at") && !circuits.contains("point of u, v at"), "{circuits}");
    }
    let ran = folder.run("table twin.linkage --from 30deg --to 90deg --steps 6");
    assert!(ran.messages.contains("51.89338° (change point of P, q and u, v)"), "{ran:?}");
}
