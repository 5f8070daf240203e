//! Numbers with every elementary function, and of a simulation whose step sizes are powers: compiled with the standard library
//! and without it.

use std::fmt::Write;

use linkage::integrate::Dopri5;
use linkage::simulation::{Start, simulate};
use linkage::{Real, linkage};

linkage! {
    #[derive(Debug, Clone)]
    mechanism Every {
        param a = 1.2, b = 0.3, m = 2, k = 30;
        input v;
        unknown u;

        let w = 0.3 + 0.1 * sin(v);

        equation a * u + b * sin(v) = exp(-v) / 2;

        point P = w@(u - 2 * v);
        output f_tan = tan(w);
        output f_asin = asin(w);
        output f_acos = acos(w);
        output f_atan = atan(u * v);
        output f_exp = exp(u / (1 + w));
        output f_ln = ln(w * (2 + cos(v)));
        output f_atan2 = atan2(u + 2, v - 5);
        output f_hypot = hypot(u + 3, v);

        body ball { mass m; center P + (v, 0); }
        scene Swinging { inertia; spring k on v; potential k * ln(2 + cos(v)) * exp(-u * u); }
    }
}

/// Positions in `f64` and `f32`, sines of large angles, and the steps of a simulation, with all digits.
pub fn text() -> String {
    let (every, mut text) = (Every::default(), String::new());
    let single = every.clone().map(|number: f64| number as f32);
    let mut add = |line: &dyn std::fmt::Debug| writeln!(text, "{line:?}").expect("a text");
    for step in -200..200 {
        let v = 0.0173 * f64::from(step);
        add(&every.motion(&EveryCoordinates { v, u: 1.0 - v }, 1.0, 0.5));
        add(&single.motion(&EveryCoordinates { v: v as f32, u: 1.0 - v as f32 }, 1.0, 0.5));
        add(&((1e6 * v).sine_cosine(), (1e100 * v).sine_cosine()));
    }
    let scene = Swinging::default();
    let start = Start { t: 0.0, q: EveryCoordinates { v: 0.3, u: 0.2 }, input_rates: 1.0 };
    let motion = simulate(&scene, start, 3.0, 1e-8).and_then(|motion| motion.method::<Dopri5>());
    let mut motion = motion.expect("a scene that moves");
    while let Some(state) = motion.advance().expect("a step") {
        add(&(state.t, state.q.v, state.q.u, state.rates.v));
    }
    text
}
