//! The names that the compiler gives to effects and joints, in Italian. They are made of a few English words around the
//! names of a mechanism.

/// The name of an effect or of a joint.
pub(super) fn italian(name: &str) -> String {
    if name.starts_with("the ") { joint(name) } else { effect(name) }
}

/// `spring 2 between P and Q`, `friction on phi`, `body Rod`: a word, a number if there are several, and what it acts on.
pub(super) fn effect(name: &str) -> String {
    let (first, mut rest) = name.split_once(' ').unwrap_or((name, ""));
    let word = match first {
        "body" => "corpo",
        "spring" => "molla",
        "damper" => "smorzatore",
        "torque" => "coppia",
        "force" => "forza",
        "potential" => "potenziale",
        "friction" => "attrito",
        "stop" => "arresto",
        _ => return name.to_owned(),
    };
    let mut words = vec![word.to_owned()];
    let number = rest.split(' ').next().filter(|number| number.parse::<u32>().is_ok());
    if let Some(number) = number {
        words.push(number.to_owned());
        rest = rest[number.len()..].trim_start();
    }
    words.extend(if let Some(scalar) = rest.strip_prefix("on ") {
        Some(format!("su {}", operand(scalar)))
    } else if let Some(point) = rest.strip_prefix("at ") {
        Some(format!("in {}", operand(point)))
    } else if let Some((from, to)) = rest.strip_prefix("between ").and_then(|ends| ends.split_once(" and ")) {
        Some(format!("tra {} e {}", operand(from), operand(to)))
    } else {
        (!rest.is_empty()).then(|| operand(rest).to_owned())
    });
    words.join(" ")
}

/// The scalar or the point on which an effect acts, by its name or its formula if that is short.
fn operand(text: &str) -> &str {
    match text {
        "an expression" => "un'espressione",
        "a point" => "un punto",
        _ => text,
    }
}

/// `the pin at P on rod`, `the guide of s, ground on piston`, with the equations whose forces are left out.
pub(super) fn joint(name: &str) -> String {
    let (place, left_out) = match name.split_once(", without the forces of ") {
        Some((place, equations)) => (place, format!(", senza le forze di {equations}")),
        None => (name, String::new()),
    };
    let Some((place, on)) = place.strip_prefix("the ").and_then(|place| place.rsplit_once(" on ")) else {
        return name.to_owned();
    };
    let on = if on == "ground" { "sul telaio".to_owned() } else { format!("sul membro {on}") };
    let joint = if let Some(joint) = place.strip_prefix("pin at ") {
        match joint.strip_prefix("the joint of ") {
            Some(links) => format!("cerniera tra {}", links.replace(" and ", " e ").replace("ground", "telaio")),
            None if joint == "the origin" => "cerniera nell'origine".to_owned(),
            None => format!("cerniera in {joint}"),
        }
    } else if let Some((coordinate, guide)) = place.strip_prefix("guide of ").and_then(|of| of.split_once(", ")) {
        let guide = if guide == "ground" { "telaio" } else { guide };
        format!("guida di {coordinate}, {guide}")
    } else {
        return name.to_owned();
    };
    format!("{joint} {on}{left_out}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_effects() {
        for (english, expected) in [
            ("body Rod", "corpo Rod"),
            ("spring on theta4", "molla su theta4"),
            ("spring 2 between a point and Q", "molla 2 tra un punto e Q"),
            ("damper on an expression", "smorzatore su un'espressione"),
            ("force 1 at P", "forza 1 in P"),
            ("torque on theta2", "coppia su theta2"),
            ("potential k*x^2/2", "potenziale k*x^2/2"),
            ("friction on s", "attrito su s"),
            ("stop 3 on an expression", "arresto 3 su un'espressione"),
            ("stop", "arresto"),
            ("lever on s", "lever on s"),
        ] {
            assert_eq!(italian(english), expected);
        }
    }

    #[test]
    fn names_of_joints() {
        for (english, expected) in [
            ("the pin at P on rod", "cerniera in P sul membro rod"),
            ("the pin at the origin on ground", "cerniera nell'origine sul telaio"),
            ("the pin at the joint of rod and piston on rod", "cerniera tra rod e piston sul membro rod"),
            ("the guide of s, ground on piston", "guida di s, telaio sul membro piston"),
            (
                "the pin at P on rod, without the forces of `a - b = 0`",
                "cerniera in P sul membro rod, senza le forze di `a - b = 0`",
            ),
            ("the cam", "the cam"),
        ] {
            assert_eq!(italian(english), expected);
        }
    }
}
