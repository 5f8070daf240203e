//! Nanoseconds for a position of a four-bar in closed form, emitted and written by hand, and with velocity and
//! acceleration: medians of alternating rounds.
//!
//! `cargo bench --bench position`

use std::hint::black_box;
use std::time::Instant;

use linkage::nalgebra::{Complex, UnitComplex};
use linkage::{Elbow, InputValues, PositionError, Real, linkage};

linkage! {
    /// No angle of this mechanism is read, so none is computed.
    #[derive(Debug, Clone, PartialEq)]
    mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;

        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;

        point C = l2@theta2 + l3@theta3;
    }
}

/// The directions of coupler and rocker, and their determinant.
struct Hand {
    coupler: [f64; 2],
    rocker: [f64; 2],
    determinant: f64,
}

/// Hand-written for speed: C from B by the half chord of the triangle B C D.
#[inline(never)]
fn by_hand(m: &FourBar, theta2: f64) -> Option<Hand> {
    from_sine(m, theta2.sin_cos())
}

/// Hand-written, with the inlined sine of this crate.
#[inline(never)]
fn by_hand_inlined(m: &FourBar, theta2: f64) -> Option<Hand> {
    from_sine(m, theta2.sine_cosine())
}

#[inline(always)]
fn from_sine(m: &FourBar, (sine, cosine): (f64, f64)) -> Option<Hand> {
    let (dx, dy) = (m.l1 - m.l2 * cosine, -m.l2 * sine);
    let distance = dx * dx + dy * dy;
    let (sum, difference) = (m.l3 + m.l4, m.l3 - m.l4);
    let radicand = (sum * sum - distance) * (distance - difference * difference);
    if radicand < 0.0 {
        return None;
    }
    let across = 0.5 * radicand.sqrt();
    let along = 0.5 * (distance + m.l3 * m.l3 - m.l4 * m.l4);
    let inverse = 1.0 / distance;
    let (x, y) = ((along * dx - across * dy) * inverse, (along * dy + across * dx) * inverse);
    let (by_3, by_4) = (1.0 / m.l3, 1.0 / m.l4);
    Some(Hand { coupler: [x * by_3, y * by_3], rocker: [(dx - x) * by_4, (dy - y) * by_4], determinant: -across })
}

/// Hand-written, with the guarantees of `assemble`: the direction of the input, a typed error, no silent NaN.
#[inline(never)]
fn by_hand_alike(m: &FourBar, theta2: f64) -> Result<FourBarPose, PositionError> {
    let (sine, cosine) = theta2.sin_cos();
    let (dx, dy) = (m.l1 - m.l2 * cosine, -m.l2 * sine);
    let distance = dx * dx + dy * dy;
    let (sum, difference) = (m.l3 + m.l4, m.l3 - m.l4);
    let radicand = (sum * sum - distance) * (distance - difference * difference);
    if radicand < 0.0 {
        return Err(PositionError::Unbuildable {
            mechanism: "FourBar",
            group: "theta3, theta4",
            gap: -radicand,
            inputs: InputValues::default(),
        });
    }
    let across = 0.5 * radicand.sqrt();
    let along = 0.5 * (distance + m.l3 * m.l3 - m.l4 * m.l4);
    let inverse = 1.0 / distance;
    let (x, y) = ((along * dx - across * dy) * inverse, (along * dy + across * dx) * inverse);
    let (by_3, by_4) = (1.0 / m.l3, 1.0 / m.l4);
    let direction = |re, im| UnitComplex::new_unchecked(Complex { re, im });
    let pose = FourBarPose {
        theta2_angle: theta2,
        theta2: direction(cosine, sine),
        theta3: direction(x * by_3, y * by_3),
        theta4: direction((dx - x) * by_4, (dy - y) * by_4),
        determinant: -across,
    };
    let parts = [pose.theta2, pose.theta3, pose.theta4].iter().fold(across, |sum, part| sum + part.re + part.im);
    if parts.is_finite() {
        Ok(pose)
    } else {
        Err(PositionError::NotFinite { mechanism: "FourBar", quantity: "the position" })
    }
}

const LEFT: FourBarBranch = FourBarBranch::new(Elbow::Left);

fn emitted(m: &FourBar, theta2: f64) -> Result<FourBarPose, PositionError> {
    m.assemble(theta2, LEFT)
}

#[inline(never)]
fn emitted_with_motion(m: &FourBar, theta2: f64) -> Option<f64> {
    let pose = m.assemble(theta2, LEFT).ok()?;
    let velocity = m.velocity(&pose, 41.9).ok()?;
    let acceleration = m.acceleration(&pose, &velocity, 0.0).ok()?;
    Some(acceleration.theta3 + acceleration.theta4)
}

/// Newton's method from a guess one degree away.
#[inline(never)]
fn newton(m: &FourBar, guess: &FourBarCoordinates) -> Option<f64> {
    Some(m.solve(guess).ok()?.coordinates.theta3)
}

const COUNT: usize = 20_000;
const ROUNDS: usize = 41;

/// The nanoseconds for one evaluation, over some arguments.
fn time<A, R>(arguments: &[A], work: impl Fn(&A) -> R) -> f64 {
    let start = Instant::now();
    for argument in arguments {
        // By reference: a copy of the result would cost a tenth of the evaluation.
        black_box(&work(black_box(argument)));
    }
    start.elapsed().as_secs_f64() * 1e9 / arguments.len() as f64
}

fn table(title: &str, m: &FourBar, angles: &[f64]) {
    let guesses = angles.iter().map(|&theta2| {
        let pose = emitted(m, theta2 - 0.017).expect("a position");
        FourBarCoordinates { theta2, ..pose.coordinates() }
    });
    let guesses: Vec<_> = guesses.collect();
    let mut rows: [Vec<f64>; 6] = Default::default();
    for _ in 0..ROUNDS {
        rows[0].push(time(angles, |&theta2| m.assemble(theta2, LEFT)));
        rows[1].push(time(angles, |&theta2| by_hand(m, theta2)));
        rows[2].push(time(angles, |&theta2| by_hand_alike(m, theta2)));
        rows[3].push(time(angles, |&theta2| emitted_with_motion(m, theta2)));
        rows[4].push(time(&guesses, |guess| newton(m, guess)));
        rows[5].push(time(angles, |&theta2| by_hand_inlined(m, theta2)));
    }
    let [emitted, hand, alike, motion, newton, inlined] = rows.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2]
    });
    println!("{title}");
    println!("  position, emitted                      {emitted:6.1} ns");
    println!("  by hand, NaN and dead points unnoticed {hand:6.1} ns, emitted / by hand {:.2}", emitted / hand);
    println!("  the same with the sine of this crate   {inlined:6.1} ns, emitted / by hand {:.2}", emitted / inlined);
    println!("  by hand with the same guarantees       {alike:6.1} ns, emitted / by hand {:.2}", emitted / alike);
    println!("  position, velocity, acceleration       {motion:6.1} ns");
    println!("  position by Newton from 1 degree away  {newton:6.1} ns");
}

fn main() {
    let m = FourBar::default();
    let (ours, hand) = (emitted(&m, 0.35).expect("a position"), by_hand(&m, 0.35).expect("a position"));
    assert!((ours.theta3.re - hand.coupler[0]).abs() < 1e-14 && (ours.theta4.im - hand.rocker[1]).abs() < 1e-14);
    assert!((ours.determinant - hand.determinant).abs() < 1e-11);
    let alike = by_hand_alike(&m, 0.35).expect("a position");
    assert!((ours.determinant - alike.determinant).abs() < 1e-11);
    let fraction = |index: usize| index as f64 / COUNT as f64;
    let sweep: Vec<f64> = (0..COUNT).map(|index| 0.2 + 0.3 * fraction(index)).collect();
    // Steps of the golden angle over a turn, so that branches of the library's sine are not predictable.
    let leaps: Vec<f64> = (0..COUNT).map(|index| std::f64::consts::TAU * (0.618_034 * index as f64).fract()).collect();
    table("Angles from 0.2 to 0.5 in small steps", &m, &sweep);
    table("Angles of a turn in large steps", &m, &leaps);
}
