//! Mistakes in a mechanism whose program names no coordinate.

use super::Mistake;

#[rustfmt::skip]
pub const PENDULUM: &[Mistake] = &[
    ("t_as_input", "input phi;\n        point P = l@phi;\n        body bob { mass m; center P; inertia m * l^2; angle phi; }", "input «t»;\n        point P = l@t;\n        body bob { mass m; center P; inertia m * l^2; angle t; }"),
    ("t_as_second_input", "input phi;", "input phi, «t»; output both = phi + t;"),
    ("t_as_unknown", "input phi;", "input phi; unknown «t»; equation t = 2 * phi;"),
    ("t_as_used_parameter", "l = 2;\n        input phi;\n        point P = l@phi;\n        body bob { mass m; center P; inertia m * l^2; angle phi; }", "«t» = 2;\n        input phi;\n        point P = t@phi;\n        body bob { mass m; center P; inertia m * t^2; angle phi; }"),
    ("keyword_as_unknown", "input phi;", "input phi; unknown «type»; equation type = 2 * phi; point E = l@type;"),
    ("keyword_as_input", "input phi;\n        point P = l@phi;\n        body bob { mass m; center P; inertia m * l^2; angle phi; }", "input «type»;\n        point P = l@type;\n        body bob { mass m; center P; inertia m * l^2; angle type; }"),
];
