//! The derivative of a scene, emitted and written by hand, for a comparison of instruction counts.
//!
//! `cargo bench --bench twin -- mounted hand 1000` evaluates one of them so many times: the scene is `bare` or
//! `mounted`; the code is `emitted` with other scenes, emitted `alone`, or written by `hand`. `tests/instructions.rs`
//! runs it under callgrind.

use std::hint::black_box;

use linkage::{Column, D, MotionError, MotionErrorOf, PositionError, Real, Scene};

include!("../dev/gallery/src/mechanisms/four_bar_effects.rs");

/// A copy of the mechanism with this scene only.
mod bare {
    linkage::linkage! {
        pub mechanism FourBar {
            param l1 = 0.8, l2 = 0.2, l3 = 0.5, l4 = 0.7;
            param j2 = 0.02, m3 = 2.5, j3 = 0.05, a3 = 0.25, b3 = 0.05, m4 = 3, j4 = 0.1, a4 = 0.35;
            input theta2;
            unknown theta3, theta4;
            loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;

            body crank { inertia j2; angle theta2; }
            body coupler { mass m3; inertia j3; center l2@theta2 + (a3, b3)@theta3; angle theta3; }
            body rocker { mass m4; inertia j4; center l1@0 - a4@theta4; angle theta4; }

            scene Bare { inertia; }
        }
    }
}

/// A copy of the mechanism with this scene only.
mod mounted {
    linkage::linkage! {
        pub mechanism FourBar {
            param l1 = 0.8, l2 = 0.2, l3 = 0.5, l4 = 0.7;
            param j2 = 0.02, m3 = 2.5, j3 = 0.05, a3 = 0.25, b3 = 0.05, m4 = 3, j4 = 0.1, a4 = 0.35, g = 9.81;
            param k = 120, s0 = 0.3, xp = 0.6, yp = 0.9, c = 0.6;
            input theta2;
            unknown theta3, theta4;
            loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
            point C = l2@theta2 + l3@theta3;

            body crank { inertia j2; angle theta2; }
            body coupler { mass m3; inertia j3; center l2@theta2 + (a3, b3)@theta3; angle theta3; }
            body rocker { mass m4; inertia j4; center l1@0 - a4@theta4; angle theta4; }

            scene Mounted { inertia; gravity (0, -g); spring k, s0 between C and (xp, yp); damper c on theta4; }
        }
    }
}

/// q, v'.
type State = Column<f64, D<4>>;

/// The kinematics that every scene of the four-bar uses.
struct Motion {
    /// The links as vectors.
    crank: [f64; 2],
    coupler: [f64; 2],
    /// The direction of the rocker.
    rocker: [f64; 2],
    /// The centre of the coupler's mass from B.
    offset: [f64; 2],
    /// theta3' / theta2' and theta4' / theta2'.
    ratios: [f64; 2],
    /// theta2', theta3', theta4'.
    rates: [f64; 3],
    /// theta3'' and theta4'' at theta2'' = 0.
    biases: [f64; 2],
}

/// The velocity ratios by Cramer's rule, and J u'' = -gamma at theta2'' = 0.
#[inline(always)]
fn motion(m: &FourBar, [a3, b3]: [f64; 2], scene: &'static str, y: &State) -> Result<Motion, PositionError> {
    let FourBar { l2, l3, l4, .. } = *m;
    let [theta3, theta4, theta2, rate] = (*y).into();
    // The sines of this library, so that only the rest of the code is compared. The fourth angle is the transmission
    // angle: its sine is accurate near a dead point, unlike a difference of products.
    let [(s2, c2), (s3, c3), (s4, c4), (transmission, _)] =
        f64::sines_cosines([theta2, theta3, theta4, theta3 - theta4]);
    let size = l3 * l4;
    let determinant = -size * transmission;
    if !(determinant.abs() > 4.0 * f64::EPSILON * size.abs() && determinant.is_finite()) {
        return Err(singular(scene, determinant, size));
    }
    let [x2, y2, x3, y3, x4, y4] = [l2 * c2, l2 * s2, l3 * c3, l3 * s3, l4 * c4, l4 * s4];
    let inverse = 1.0 / determinant;
    let ratios = [(x4 * y2 - y4 * x2) * inverse, (y3 * x2 - x3 * y2) * inverse];
    let rates = [rate, ratios[0] * rate, ratios[1] * rate];
    let [p, q, r] = rates.map(|rate| rate * rate);
    let (gx, gy) = (x2 * p + x3 * q + x4 * r, y2 * p + y3 * q + y4 * r);
    let biases = [(x4 * gx + y4 * gy) * inverse, -(x3 * gx + y3 * gy) * inverse];
    let offset = [a3 * c3 - b3 * s3, a3 * s3 + b3 * c3];
    Ok(Motion { crank: [x2, y2], coupler: [x3, y3], rocker: [c4, s4], offset, ratios, rates, biases })
}

#[cold]
fn singular(scene: &'static str, determinant: f64, size: f64) -> PositionError {
    if determinant.is_finite() && size.is_finite() {
        let regularity = if size == 0.0 { 0.0 } else { (determinant / size).abs() };
        return PositionError::Singular { mechanism: scene, group: "theta3, theta4", regularity };
    }
    PositionError::NotFinite { mechanism: scene, quantity: "the Jacobian" }
}

/// Solves M v'' = Q for M > 0.
#[inline(always)]
fn accelerated(scene: &'static str, mass: f64, force: f64) -> Result<f64, MotionError> {
    if mass > 0.0 && mass < f64::INFINITY {
        return Ok(force / mass);
    }
    Err(without_inertia(scene, mass))
}

#[cold]
fn without_inertia(scene: &'static str, mass: f64) -> MotionError {
    if mass.is_finite() {
        return MotionError::NoInertia { scene, coordinate: "theta2", share: if mass > 0.0 { 1.0 } else { 0.0 } };
    }
    PositionError::NotFinite { mechanism: scene, quantity: "the mass matrix" }.into()
}

/// Returns y' if it is finite; else the error names the first of `parts` that is not.
#[inline(always)]
fn answer<const N: usize>(
    scene: &'static str,
    acceleration: f64,
    [of_2, of_3, of_4]: [f64; 3],
    parts: impl FnOnce() -> [(&'static str, f64); N],
) -> Result<State, MotionError> {
    if !(acceleration + of_3 + of_4).is_finite() {
        not_finite(scene, [acceleration, of_3, of_4], parts)?;
    }
    Ok(State::from([of_3, of_4, of_2, acceleration]))
}

#[cold]
#[inline(never)]
fn not_finite<const N: usize>(
    scene: &'static str,
    results: [f64; 3],
    parts: impl FnOnce() -> [(&'static str, f64); N],
) -> Result<(), PositionError> {
    if results.iter().all(|result| result.is_finite()) {
        return Ok(());
    }
    let guilty = parts().into_iter().find(|(_, part)| !part.is_finite());
    let quantity = guilty.map_or("the acceleration", |(name, _)| name);
    Err(PositionError::NotFinite { mechanism: scene, quantity })
}

/// Inertia alone: M = j2 + m3 G3'^2 + j3 w3^2 + (j4 + m4 a4^2) w4^2, and the same with the biases for Q.
#[inline(never)]
fn bare_by_hand(scene: &Bare, y: &State) -> Result<State, MotionError> {
    let Bare { j2, m3, j3, a3, b3, m4, j4, a4, .. } = *scene;
    let Motion { crank: [x2, y2], offset: [px, py], ratios: [w3, w4], rates, biases: [bias3, bias4], .. } =
        motion(&scene.mechanism, [a3, b3], "Bare", y)?;
    let about_d = j4 + m4 * a4 * a4;
    let (gx, gy) = (-y2 - py * w3, x2 + px * w3);
    let (p, q) = (rates[0] * rates[0], rates[1] * rates[1]);
    let (hx, hy) = (-x2 * p - px * q - py * bias3, -y2 * p - py * q + px * bias3);
    let mass = j2 + m3 * (gx * gx + gy * gy) + j3 * w3 * w3 + about_d * w4 * w4;
    let coupler = m3 * (gx * hx + gy * hy) + j3 * w3 * bias3;
    let rocker = about_d * w4 * bias4;
    let acceleration = accelerated("Bare", mass, -(coupler + rocker))?;
    answer("Bare", acceleration, rates, || [("body coupler", coupler), ("body rocker", rocker)])
}

/// Adds weight, a spring from C to a fixed point, and a damper on the rocker.
#[inline(never)]
fn mounted_by_hand(scene: &Mounted, y: &State) -> Result<State, MotionError> {
    let Mounted { j2, m3, j3, a3, b3, m4, j4, a4, g, k, s0, xp, yp, c, .. } = *scene;
    let Motion {
        crank: [x2, y2],
        coupler: [x3, y3],
        rocker: [c4, _],
        offset: [px, py],
        ratios: [w3, w4],
        rates,
        biases: [bias3, bias4],
    } = motion(&scene.mechanism, [a3, b3], "Mounted", y)?;
    let about_d = j4 + m4 * a4 * a4;
    let (gx, gy) = (-y2 - py * w3, x2 + px * w3);
    let (p, q) = (rates[0] * rates[0], rates[1] * rates[1]);
    let (hx, hy) = (-x2 * p - px * q - py * bias3, g - y2 * p - py * q + px * bias3);
    let mass = j2 + m3 * (gx * gx + gy * gy) + j3 * w3 * w3 + about_d * w4 * w4;
    let coupler = m3 * (gx * hx + gy * hy) + j3 * w3 * bias3;
    let rocker = about_d * w4 * bias4 - m4 * g * a4 * c4 * w4;
    let (dx, dy) = (x2 + x3 - xp, y2 + y3 - yp);
    // `hypot`: squares could overflow or underflow.
    let length = dx.hypot(dy);
    let along = dx * (-y2 - y3 * w3) + dy * (x2 + x3 * w3);
    let spring = -k * (length - s0) * along / length;
    let damper = -c * rates[2] * w4;
    let force = spring + damper - coupler - rocker;
    let acceleration = accelerated("Mounted", mass, force)?;
    answer("Mounted", acceleration, rates, || {
        [
            ("body coupler", coupler),
            ("body rocker", rocker),
            ("spring between C and (xp, yp)", spring),
            ("damper on theta4", damper),
        ]
    })
}

#[inline(never)]
fn emitted<S: Scene<Scalar = f64, State = D<4>>>(scene: &S, y: &State) -> Result<State, MotionErrorOf<S>> {
    scene.derivative(0.0, y)
}

/// Evaluates a derivative `calls` times, at a slightly larger angle each time.
fn evaluate<S>(calls: usize, scene: &S, derivative: impl Fn(&S, &State) -> Result<State, MotionError>) -> f64 {
    let mut y = State::from([0.8, -1.1, 0.5, 12.0]);
    let mut sum = 0.0;
    for _ in 0..calls {
        y[2] += 1e-4;
        sum += black_box(derivative(black_box(scene), black_box(&y))).map_or(f64::NAN, |y| y[3]);
    }
    sum
}

fn main() {
    let given: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let mut given = given.iter().map(String::as_str);
    let (scene, code) = (given.next().unwrap_or("bare"), given.next().unwrap_or("emitted"));
    let calls = given.next().map_or(1000, |calls| calls.parse().expect("a number of calls"));
    let sum = match (scene, code) {
        ("bare", "emitted") => evaluate(calls, &Bare::default(), emitted),
        ("bare", "alone") => evaluate(calls, &bare::Bare::default(), emitted),
        ("bare", "hand") => evaluate(calls, &Bare::default(), bare_by_hand),
        ("mounted", "emitted") => evaluate(calls, &Mounted::default(), emitted),
        ("mounted", "alone") => evaluate(calls, &mounted::Mounted::default(), emitted),
        ("mounted", "hand") => evaluate(calls, &Mounted::default(), mounted_by_hand),
        _ => panic!("unknown arguments: {scene} {code}"),
    };
    println!("{sum:?}");
}
