//! Functions of other languages, and what to write for them.

/// The functions, and their advice.
const FUNCTIONS: [(&[&str], &str); 17] = [
    (&["arcsin", "asin2", "arcsen"], "write `asin(x)`"),
    (&["arccos"], "write `acos(x)`"),
    (&["arctan", "atg", "arctg"], "write `atan(x)`"),
    (&["arctan2"], "write `atan2(y, x)`"),
    (&["tg"], "write `tan(x)`"),
    (&["sen"], "write `sin(x)`"),
    (&["log"], "write `ln(x)` for the natural logarithm"),
    (&["log10", "log2"], "write `ln(x)/ln(10)` or `ln(x)/ln(2)`"),
    (&["pow", "power", "powf"], "write `x^n` with an integer `n`, or `sqrt(x)`"),
    (&["square", "sqr", "cube"], "write `x^2` or `x^3`"),
    (&["cot", "sec", "csc"], "write it with `sin`, `cos` and `tan`, as in `1/tan(x)`"),
    (&["sinh", "cosh", "tanh"], "write it with `exp`, as in `(exp(x) - exp(-x))/2`"),
    (
        &["max", "min", "sign", "signum", "sgn", "floor", "ceil", "round", "mod", "rem", "clamp", "heaviside"],
        "it has no derivative everywhere; declare a user function with `extern fn`",
    ),
    (
        &["length", "len", "magnitude", "mag", "modulus", "dist", "distance"],
        "write `norm(V)`, or `norm(Q - P)` for a distance",
    ),
    (
        &["radians", "deg2rad", "to_radians", "rad", "deg", "degrees", "to_degrees"],
        "angles are in radians; write `20deg` for a number in degrees",
    ),
    (&["vec", "vec2", "vector", "vector2", "point2"], "write a vector as `(x, y)` or `r@phi`"),
    (&["polar", "cis", "rot", "rotate"], "write `r@phi`, or `(x, y)@phi` for a rotated vector"),
];

/// Functions of motion, and what to write for them.
const MOTION: [&str; 8] = ["diff", "derivative", "ddt", "der", "d", "velocity", "vel", "dt"];

/// The advice for a function of another language.
pub(super) fn for_function(name: &str) -> Option<&'static str> {
    let lower = name.to_lowercase();
    if MOTION.contains(&lower.as_str()) {
        return Some("rates are emitted for all points and outputs; in the laws of a scene write `rate(x)`");
    }
    FUNCTIONS.iter().find(|(names, _)| names.contains(&lower.as_str())).map(|(_, advice)| *advice)
}
