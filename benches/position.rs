//! Position in closed form, beside the best that one writes by hand: nanoseconds a position of a four-bar
//! without angles, and with velocity and acceleration; interleaved, medians.
//!
//! `cargo bench --bench position`

use std::hint::black_box;
use std::time::Instant;

use linkage::{Elbow, linkage};

linkage! {
    /// Nobody asks for an angle here.
    #[derive(Debug, Clone, PartialEq)]
    mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;

        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;

        point C = l2@theta2 + l3@theta3;
    }
}

/// Directions of the coupler and of the rocker, and their determinant.
struct Hand {
    coupler: [f64; 2],
    rocker: [f64; 2],
    determinant: f64,
}

/// As one would write it: C from B by the half chord of the triangle B C D.
#[inline(never)]
fn by_hand(m: &FourBar, theta2: f64) -> Option<Hand> {
    let (sine, cosine) = theta2.sin_cos();
    let (dx, dy) = (m.l1 - m.l2 * cosine, -m.l2 * sine);
    let distance = dx * dx + dy * dy;
    let (sum, difference) = (m.l3 + m.l4, m.l3 - m.l4);
    let radicand = (sum * sum - distance) * (distance - difference * difference);
    if radicand < 0.0 {
        return None;
    }
    let across = -0.5 * radicand.sqrt();
    let along = 0.5 * (distance + m.l3 * m.l3 - m.l4 * m.l4);
    let inverse = 1.0 / distance;
    let (x, y) = ((along * dx + across * dy) * inverse, (along * dy - across * dx) * inverse);
    let (by_3, by_4) = (1.0 / m.l3, 1.0 / m.l4);
    Some(Hand { coupler: [x * by_3, y * by_3], rocker: [(dx - x) * by_4, (dy - y) * by_4], determinant: across })
}

#[inline(never)]
fn emitted(m: &FourBar, theta2: f64) -> Option<FourBarPose> {
    m.assemble(theta2, FourBarBranch { theta3_theta4: Elbow::Left }).ok()
}

#[inline(never)]
fn emitted_with_motion(m: &FourBar, theta2: f64) -> Option<f64> {
    let pose = m.assemble(theta2, FourBarBranch { theta3_theta4: Elbow::Left }).ok()?;
    let velocity = m.velocity(&pose, 41.9).ok()?;
    let acceleration = m.acceleration(&pose, &velocity, 0.0).ok()?;
    Some(acceleration.theta3 + acceleration.theta4)
}

#[inline(never)]
fn newton(m: &FourBar, theta2: f64) -> Option<f64> {
    let guess = FourBarCoordinates { theta2, theta3: 1.2, theta4: -0.9 };
    Some(m.solve(&guess).ok()?.coordinates.theta3)
}

const COUNT: usize = 20_000;
const ROUNDS: usize = 41;

fn time<R>(work: impl Fn(f64) -> R) -> f64 {
    let start = Instant::now();
    for index in 0..COUNT {
        black_box(work(black_box(0.2 + 0.3 * index as f64 / COUNT as f64)));
    }
    start.elapsed().as_secs_f64() * 1e9 / COUNT as f64
}

fn main() {
    let m = FourBar::default();
    let (ours, hand) = (emitted(&m, 0.35).expect("a position"), by_hand(&m, 0.35).expect("a position"));
    assert!((ours.theta3.re - hand.coupler[0]).abs() < 1e-14 && (ours.theta4.im - hand.rocker[1]).abs() < 1e-14);
    assert!((ours.determinant - hand.determinant).abs() < 1e-11);
    let mut rows: [Vec<f64>; 4] = Default::default();
    for _ in 0..ROUNDS {
        rows[0].push(time(|theta2| emitted(&m, theta2)));
        rows[1].push(time(|theta2| by_hand(&m, theta2)));
        rows[2].push(time(|theta2| emitted_with_motion(&m, theta2)));
        rows[3].push(time(|theta2| newton(&m, theta2)));
    }
    let [emitted, hand, motion, newton] = rows.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2]
    });
    println!("position, emitted               {emitted:7.1} ns");
    println!("position, by hand               {hand:7.1} ns, emitted / by hand {:.2}", emitted / hand);
    println!("position, velocity, acceleration {motion:6.1} ns");
    println!("position by Newton from a guess {newton:7.1} ns");
}
