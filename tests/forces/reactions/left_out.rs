//! Joints whose forces leave out those of equations: the docs of their fields and the sheet name the equations.

use linkage::{Document, linkage};

/// A pinion that drives a rack, and a rocker by a rod that is written as a distance.
macro_rules! rack {
    ($read:ident) => {
        $read! {
            pub mechanism Rack {
                param r = 0.1, b = 0.3, d = 0.2, l = 0.35, m = 1, j = 0.01, g = 9.81, torque = 10;
                input phi;
                unknown s, psi;
                equation s = r * phi;
                equation norm((d, 0) + r@phi - b@psi) = l;
                point Pivot = (d, 0);
                body pinion { mass m; inertia j; center (d, 0); angle phi; }
                body bar { mass m; center (s, -r); }
                body rocker { mass m; inertia j; center (b/2)@psi; angle psi; }
                scene Lifting {
                    inertia;
                    gravity (0, -g);
                    torque torque on phi;
                    reaction at Pivot;
                    reaction at (0, 0);
                    reaction on s;
                }
            }
        }
    };
}

rack!(linkage);

/// The tooth presses on the pinion and on the rack; the rod is a distance of points, which carries its force.
#[test]
fn equations_of_scalars_are_named() {
    let emitted = linkage_compiler::expand(rack!(stringify).parse().unwrap(), &"::linkage".parse().unwrap());
    let emitted = emitted.to_string();
    let doc_of = |field: &str| emitted.split(&format!("pub {field} :")).next().unwrap().rsplit("doc").next().unwrap();
    let text = Lifting::<f64>::DERIVATION.to_text();
    for (field, title, is_left_out) in [
        ("pivot_on_pinion", "the pin at Pivot on pinion", true),
        ("s_normal", "the guide of s, ground on bar", true),
        ("origin_on_rocker", "the pin at the origin on rocker", false),
    ] {
        let equation = "the forces of `s - phi*r = 0`";
        let doc = doc_of(field).replace("The forces", "the forces");
        assert_eq!(doc.contains(equation), is_left_out, "{field}");
        let lines: Vec<&str> = text.lines().filter(|line| line.trim_start().starts_with(title)).collect();
        assert!(matches!(lines[..], [line] if line.ends_with(equation) == is_left_out), "{lines:?}");
    }
}
