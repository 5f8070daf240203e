//! The places of a mechanism in which names may stand. What other names the mechanisms have contain a zero.

/// A statement for each name.
fn each(names: &[String], statement: impl Fn(&str) -> String) -> String {
    names.iter().map(|name| statement(name)).collect()
}

/// A statement for each name, with the number of the name for other names in it.
fn numbered(names: &[String], statement: impl Fn(&str, usize) -> String) -> String {
    names.iter().enumerate().map(|(number, name)| statement(name, number)).collect()
}

/// The sum of a part for each name, after a first term.
fn sum(names: &[String], part: impl Fn(&str) -> String) -> String {
    names.iter().map(|name| format!(" + {}", part(name))).collect()
}

/// A mechanism with names in all of its places, as many as `places`.
pub struct Template {
    pub what: &'static str,
    pub places: usize,
    /// The names of one place of a mechanism.
    pub most: usize,
    /// The mechanism with a list of names for each place.
    pub mechanism: fn(&[&[String]]) -> String,
}

impl Template {
    /// The mechanism with names in one place only.
    pub fn with(&self, place: usize, names: &[String]) -> String {
        let mut lists: Vec<&[String]> = vec![&[]; self.places];
        lists[place] = names;
        (self.mechanism)(&lists)
    }
}

pub const TEMPLATES: [Template; 4] = [
    Template { what: "kinematic", places: 8, most: 16, mechanism: kinematic },
    Template { what: "dynamic", places: 7, most: 16, mechanism: dynamic },
    Template { what: "driven", places: 1, most: 6, mechanism: |lists| driven(lists[0]) },
    Template { what: "joints", places: 2, most: 4, mechanism: |lists| joints(lists[0], lists[1]) },
];

/// A slider-crank, and all that can be derived of it.
fn kinematic(lists: &[&[String]]) -> String {
    let [parameters, unknowns, lets, points, outputs, derivatives, functions, arguments] = lists else {
        panic!("{lists:?}")
    };
    let parameters = [
        each(parameters, |name| format!("param {name} = 1;")),
        format!("output a0 = x0{};", sum(parameters, |name| format!("{name} * v0"))),
    ];
    let unknowns = [
        each(unknowns, |name| format!("unknown {name}; equation {name} = 2 * v0;")),
        format!("output b0 = x0{};", sum(unknowns, str::to_owned)),
    ];
    let lets =
        [each(lets, |name| format!("let {name} = sin(u0);")), format!("output c0 = x0{};", sum(lets, str::to_owned))];
    let functions = [
        numbered(functions, |name, of| format!("extern fn {name}(x, p) -> ({name}, f0{of}, g0{of}, h0{of}, i0{of});")),
        format!("output d0 = x0{};", sum(functions, |name| format!("{name}(v0, 2)"))),
    ];
    let derivatives = [
        numbered(derivatives, |name, of| {
            format!("extern fn of1{of}0(x, p) -> (f1{of}0, {name}, g1{of}0, h1{of}0, i1{of}0);")
        }),
        format!("output e0 = x0{};", sum(derivatives, |name| format!("{name}(1, 2)"))),
    ];
    let arguments = [
        numbered(arguments, |name, of| {
            format!("extern fn of2{of}0({name}, p0) -> (f2{of}0, g2{of}0, h2{of}0, i2{of}0, j2{of}0);")
        }),
        format!("output g0 = x0{};", numbered(arguments, |_, of| format!(" + f2{of}0(1, 2)"))),
    ];
    let named = [
        each(points, |name| format!("point {name} = (2 * u0, 1);")),
        each(outputs, |name| format!("output {name} = 2 * u0;")),
    ];
    let own = [parameters, unknowns, lets, functions, derivatives, arguments, named].concat().concat();
    format!(
        "pub mechanism M0 {{
            param r0 = 1, l0 = 3;
            input v0;
            unknown u0, x0;
            loop r0@v0 + l0@u0 = (x0, 0);
            {own}
            point P0 = r0@v0;
            output o0 = x0 * sin(u0);
            derive limits, jerk, velocity_ratio_derivatives, sensitivity, lanes, intervals;
        }}"
    )
}

/// A slider-crank with a choice of inputs, a scene of every effect, one with a drive and one at rest.
fn dynamic(lists: &[&[String]]) -> String {
    let [parameters, of_scenes, unknowns, lets, points, bodies, functions] = lists else { panic!("{lists:?}") };
    let own = [
        each(parameters, |name| format!("param {name} = 1;")),
        format!("output a0 = x0{};", sum(parameters, |name| format!("{name} * v0"))),
        each(of_scenes, |name| format!("param {name} = 1;")),
        each(unknowns, |name| format!("coordinate {name}; equation {name} = 2 * v0;")),
        each(lets, |name| format!("let {name} = sin(u0);")),
        each(points, |name| format!("point {name} = (2 * u0, 1);")),
        each(bodies, |name| format!("body {name} {{ mass 1; center P0; }}")),
        numbered(functions, |name, of| format!("extern fn {name}(x, p) -> ({name}, f0{of}, g0{of}, h0{of}, i0{of});")),
    ];
    let effects = [
        each(of_scenes, |name| format!("spring {name} on x0;")),
        format!("stop u0 in -3..1{}, restitution 0.1;", sum(of_scenes, str::to_owned)),
        each(unknowns, |name| format!("torque rate({name}) on {name};")),
        each(points, |name| format!("force (1, t) at {name};")),
        format!("potential x0{};", sum(lets, str::to_owned)),
        format!("potential x0{};", sum(functions, |name| format!("{name}(v0, 2)"))),
    ];
    of_every_effect(&own.concat(), &effects.concat())
}

fn of_every_effect(own: &str, effects: &str) -> String {
    format!(
        "pub mechanism M0 {{
            param r0 = 1, l0 = 3;
            coordinate v0, u0, x0;
            loop r0@v0 + l0@u0 = (x0, 0);
            drive D0 by v0;
            drive E0 by x0;
            point P0 = r0@v0;
            output o0 = x0;
            {own}
            body crank0 {{ mass 2; inertia 0.5; center 0.5 * r0@v0; angle v0; }}
            body rod0 {{ mass 2; inertia 0.5; center r0@v0 + 0.5 * l0@u0; angle u0; }}
            body slider0 {{ mass 2; center (x0, 0); }}
            param g0 = 9.81;
            scene S0 of D0 {{
                inertia;
                gravity (0, -g0);
                spring 3, 0.5 between P0 and (1, 2);
                damper 0.2 on u0;
                torque rate(v0) + t on v0;
                force (0, 1) at P0;
                potential x0^2;
                friction 0.1, 0.2, 5 on u0;
                friction 0.1, 0.02, reaction at P0 on u0 - v0;
                stop x0 in 1..5, restitution 0.5;
                {effects}
                energy;
                power;
                reactions;
            }}
            scene R0 of E0 {{ inertia; drive x0 = 3 + sin(t); power; }}
            scene B0 of D0 {{ gravity (0, -g0); torque 1 on v0; equilibrium; }}
        }}"
    )
}

/// Inputs of scenes, free and driven.
fn driven(names: &[String]) -> String {
    let inputs = each(names, |name| format!("{name}, "));
    let bodies = numbered(names, |name, of| format!("body b0{of} {{ mass 2; center ({name}, 0); }}"));
    let outputs = sum(names, str::to_owned);
    let torques = each(names, |name| format!("torque t + rate({name}) on {name};"));
    let drives = each(names, |name| format!("drive {name} = t;"));
    format!(
        "pub mechanism M0 {{
            param r0 = 1;
            input {inputs}v0;
            unknown u0;
            equation u0 = r0 * sin(v0);
            output o0 = u0{outputs};
            {bodies}
            body crank0 {{ mass 2; inertia 0.5; center 0.5 * r0@v0; angle v0; }}
            body slider0 {{ mass 2; center (u0, 0); }}
            scene S0 {{
                inertia;
                {torques} energy; power; reactions; }}
            scene R0 {{ inertia; drive v0 = t; {drives} power; }}
            scene B0 {{ torque 1 on v0; equilibrium; }}
            derive jerk, lanes, intervals;
        }}"
    )
}

/// The lengths of guides and the points of pins, with their forces.
fn joints(guides: &[String], pins: &[String]) -> String {
    let own = [
        numbered(guides, |name, of| {
            format!(
                "unknown {name}, a0{of}; loop r0@v0 + 4@a0{of} = ({name}, 0); body b0{of} {{ mass 1; center ({name}, 0); }}
                body c0{of} {{ mass 1; inertia 0.1; center r0@v0; angle a0{of}; }}"
            )
        }),
        numbered(pins, |name, of| {
            format!(
                "unknown d0{of}; equation d0{of} = 2 * v0; point {name} = (2 + {of}) * r0@v0;
                body e0{of} {{ mass 1; inertia 0.5; center {name} + 1@d0{of}; angle d0{of}; }}"
            )
        }),
    ]
    .concat();
    let shown =
        [each(guides, |name| format!("reaction on {name};")), each(pins, |name| format!("reaction at {name};"))];
    format!(
        "pub mechanism M0 {{
            param r0 = 1;
            input v0;
            unknown u0;
            equation u0 = 3 * v0;
            output o0 = sin(u0);
            {own}
            body crank0 {{ mass 2; inertia 0.5; center 0.5 * r0@v0; angle v0; }}
            scene S0 {{
                inertia;
                torque t on v0; {} }}
        }}",
        shown.concat()
    )
}

/// The functions that `extern fn` names, and those for as many other names.
pub fn functions(names: &[String], others: usize) -> String {
    let results = "<T: ::linkage::Real>(x: T, p: T) -> (T, T, T, T, T) { (x * p, p, T::zero(), T::zero(), T::zero()) }";
    let others = (0..others).map(|of| format!("pub fn of1{of}0{results} pub fn of2{of}0{results}"));
    each(names, |name| format!("pub fn {name}{results} ")) + &others.collect::<String>()
}

/// A mechanism, a driver and a scene with these names.
pub fn types([mechanism, driver, scene]: [&str; 3]) -> String {
    let text = of_every_effect("derive lanes, intervals;", "");
    let text = text.replace("mechanism M0", &format!("mechanism {mechanism}")).replace("D0", driver);
    text.replace("scene S0", &format!("scene {scene}"))
}

/// A small mechanism, a driver and a scene with these names.
pub fn small_types([mechanism, driver, scene]: [&str; 3]) -> String {
    format!(
        "pub mechanism {mechanism} {{
            coordinate v0, u0;
            equation u0 = 2 * v0;
            drive {driver} by v0;
            point P0 = u0@v0;
            output o0 = u0;
            body b0 {{ mass 1; center P0; }}
            scene {scene} of {driver} {{ inertia; gravity (0, 1); energy; }}
            derive intervals;
        }}"
    )
}

/// Guides of one coordinate, and coordinates and points with the names of the forces that are numbered.
pub const GUIDES: &str = "pub mechanism M0 {
    input v;
    unknown r, a, b, c, d, e, r_2, g, v_rate;
    loop 1@v + r@a = (3, 0);
    loop (0, 3) + r@b = 5@c;
    loop (4, 0) + r@d = 5@e;
    loop 1@v + r_2@g = (0, 2);
    equation v_rate = 2 * v;
    point P = 1@v;
    point P_on_bar = 5@c;
    output o0 = v_rate + r_2;
    body crank { mass 1; inertia 1; center 0.5@v; angle v; }
    body bar { mass 1; inertia 1; center 2@c; angle c; }
    body bar_on_bar { mass 1; inertia 1; center 2@e; angle e; }
    scene S0 {
        inertia;
        reactions; }
    scene R0 { inertia; reaction on r; reaction on r_2; reaction at P_on_bar; }
}";

/// Mechanisms that are mistakes: without coordinates, or without anything.
pub const EMPTY: [&str; 8] = [
    "pub mechanism M0 { coordinate a; point P = 1@a; }",
    "pub mechanism M0 { coordinate a; point P = 1@a; body b { mass 1; center P; } scene S0 { inertia; energy; } }",
    "pub mechanism M0 {}",
    "pub mechanism M0 { param a = 1; }",
    "pub mechanism M0 { param a = 1; derive limits, lanes, jerk, sensitivity, velocity_ratio_derivatives, intervals; }",
    "pub mechanism M0 { drive D0 by q; drive E0 by r; }",
    "pub mechanism M0 { param m = 1; body b { mass m; center (m, 0); } scene S0 { inertia; reactions; energy; power; } }",
    "pub mechanism M0 { point P = (1, 0); output o = 1; scene S0 { gravity (0, 1); equilibrium; } derive lanes; }",
];

/// Mistakes, each planted instead of a text: in the kinematics, of syntax, in a scene.
pub const MISTAKES: [[&str; 2]; 4] = [
    ["output o0 =", "output wrong0 = nothing0; output o0 ="],
    ["inertia;\n", "inertia; torque nothing0 * t on v0;\n"],
    ["output o0 =", "output = 3; output o0 ="],
    ["equilibrium;", "equilibrium; friction on v0;"],
];
