//! Quantities as far as a text says them: an angle, the rate of one, a length.

use linkage_compiler::budget::Budget;
use linkage_compiler::model::{Measure, output_angles};
use linkage_compiler::text;

/// The quantity of each parameter of a text and of its scenes, with its default.
fn parameters(text: &str) -> Vec<(String, Measure, Option<String>)> {
    let compiled = text::compile(text, &Budget::default(), |_| ()).unwrap_or_else(|wrong| panic!("{text}: {wrong:?}"));
    let mechanism = &compiled[0].mechanism;
    let all = mechanism.parameters.iter().chain(mechanism.scene_parameters.iter());
    all.map(|of| (of.name.text.clone(), of.measure, of.default_in_words())).collect()
}

fn measure(text: &str, name: &str) -> (Measure, Option<String>) {
    let found = parameters(text).into_iter().find(|(other, ..)| other == name);
    found.map(|(_, measure, default)| (measure, default)).unwrap_or_else(|| panic!("{text} has no {name}"))
}

#[test]
fn the_unit_of_a_default_says_what_it_is() {
    for (default, expected, written) in [
        ("60rpm", Measure::Rate, "60rpm"),
        ("-60rpm", Measure::Rate, "-60rpm"),
        ("2*30rpm", Measure::Rate, "2*pi"),
        ("30rpm + 30rpm", Measure::Rate, "2*pi"),
        ("45deg", Measure::Angle, "45deg"),
        ("7rad", Measure::Angle, "7rad"),
        ("-0.5", Measure::Number, "-0.5"),
        ("60rpm/30rpm", Measure::Number, "2"),
        ("1/60rpm", Measure::Number, "1/2/pi"),
    ] {
        let text = format!("mechanism M {{ param a = {default}; input x; output o = a*x; }}");
        let (found, default) = measure(&text, "a");
        assert_eq!(found, expected, "{text}");
        if !written.contains("/pi") {
            assert_eq!(default.as_deref(), Some(written), "{text}");
        }
    }
}

/// A component of a load is no length, but where it is one as well.
#[test]
fn loads_are_no_lengths() {
    let with = |scene: &str| {
        format!(
            "mechanism M {{ param l = 2, g = 9.81, f = 3, both = 1; input th; point P = l@th; \
             body rod {{ mass 1; inertia 1; center P; angle th; }} scene drop {{ inertia; {scene} }} }}"
        )
    };
    for (scene, name, expected) in [
        ("gravity (0, -g); force (f, both) at P;", "g", Measure::Number),
        ("gravity (0, -g); force (f, both) at P;", "f", Measure::Number),
        ("gravity g@(-90deg); force f@th at (both, 0);", "g", Measure::Number),
        ("gravity g@(-90deg); force f@th at (both, 0);", "f", Measure::Number),
        ("gravity g@(-90deg); force f@th at (both, 0);", "both", Measure::Length),
        ("gravity (0, -g); force (f, both) at P + (both, 0);", "both", Measure::Length),
        ("gravity (0, -g); force (both, f) at P;", "l", Measure::Length),
    ] {
        assert_eq!(measure(&with(scene), name).0, expected, "{scene} {name}");
    }
    let plain =
        "mechanism M { param a = 1, b = 2, n = 3; input th; unknown x; equation x = n*th; point P = (a, b*x); }";
    assert_eq!(measure(plain, "a").0, Measure::Length);
    assert_eq!(measure(plain, "n").0, Measure::Number);
}

/// True for jumps that differ by their rounding.
fn close(found: Option<Option<f64>>, expected: Option<Option<f64>>) -> bool {
    let pair = found.flatten().zip(expected.flatten());
    pair.is_some_and(|(found, expected)| (found - expected).abs() <= 2.0 * f64::EPSILON * expected)
}

/// The jump of an output that is an angle, at a turn of the `atan2` in it.
#[test]
fn outputs_that_are_angles() {
    let turn = std::f64::consts::TAU;
    for (output, expected) in [
        ("p - q", Some(None)),
        ("(p - q)/2", Some(None)),
        ("3*(p - (q + 90deg)/2)/4", Some(None)),
        ("abs(p - q)/2 + abs((p + q)/3)", Some(None)),
        ("pi/2 - (p + pi)/2", Some(None)),
        ("2*bend", Some(None)),
        ("(atan2(sin(p), cos(p)) - q)/2", Some(Some(turn / 2.0))),
        ("(atan2(sin(p), cos(p)) + 4*(atan(s) + 5*atan2(s, l))/5)/2", Some(Some(turn / 2.0))),
        ("0.1*atan2(sin(p), cos(p)) - 0.3*atan2(s, l)", Some(Some(turn / 10.0))),
        // Jumps of a half and of 6/5 of a turn.
        ("(atan2(sin(p), cos(p)) + 4*(atan(s) + 3*atan2(s, l))/5)/2", Some(None)),
        ("abs(atan2(sin(p), cos(p)))", Some(None)),
        ("l*p", None),
        ("(l*p + s)/2", None),
        ("p*q", None),
        ("s/l", None),
        ("(s + l)/2", None),
        ("exp(p)", None),
        ("p/s", None),
    ] {
        let text = format!(
            "mechanism M {{ param l = 3, bend = 20deg; input th; unknown p, q, s; loop l@th + l@p = l@q + (s, 0); \
             equation q = p/2; output o = {output} + 0*l*bend; }}"
        );
        let compiled = text::compile(&text, &Budget::default(), |_| ());
        let compiled = compiled.unwrap_or_else(|wrong| panic!("{text}: {wrong:?}"));
        let found = output_angles(&compiled[0].mechanism)[0];
        let jump = found.map(|angle| angle.jump);
        assert!(jump == expected || close(jump, expected), "{output}: {found:?}");
        assert_eq!(found.is_some_and(|angle| angle.jumps_differ), output.contains("3*atan2(s, l))/5"), "{output}");
    }
}
