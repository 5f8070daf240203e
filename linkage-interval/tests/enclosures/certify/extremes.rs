//! Smallest and largest values over a motion.

use std::f64::consts::TAU;

use linkage_interval::Interval;
use linkage_interval::certify::{self, Enclosure};

use crate::certify::loops::Loops;
use crate::certify::random::four_bar;
use crate::certify::shapes::FourBar;

const LENGTHS: [f64; 4] = [100.0, 40.0, 120.0, 80.0];

fn is_within(interval: Interval, value: f64) -> bool {
    let [least, most] = [interval.least(), interval.most()];
    let slack = 1e-14 * value.abs();
    least - slack <= value && value <= most + slack && most - least <= 3e-9 * value.abs()
}

/// The transmission angle is extreme where the crank is in line with the ground,
/// cos mu = (b^2 + c^2 - (d -+ a)^2) / (2 b c), and the pin where the rocker is: at x = 100 +- ...
#[test]
fn transmission_angle_and_pin_of_a_four_bar() {
    let [ground, crank, coupler, rocker] = LENGTHS;
    let start = Loops::<FourBar, f64>::at(four_bar(LENGTHS, 1.0, 0.7).unwrap(), 0.7);
    let found = certify::turn(&Loops::<FourBar, f64>::new(LENGTHS), &start).unwrap().quantities();
    let angle = |distance: f64| {
        -((coupler * coupler + rocker * rocker - distance * distance) / (2.0 * coupler * rocker)).acos()
    };
    assert!(found.iter().all(|found| found.is_sharp && found.evaluations < 400));
    assert!(is_within(found[2].least, angle(ground + crank)), "{found:?}");
    assert!(is_within(found[2].largest, angle(ground - crank)), "{found:?}");
    // The rocker is extreme where crank and coupler are in line: cos psi = (d^2 + c^2 - (b +- a)^2) / (2 d c).
    let x = |distance: f64| ground + (distance * distance - ground * ground - rocker * rocker) / (2.0 * ground);
    assert!(is_within(found[0].least, x(coupler - crank)), "{found:?}");
    assert!(is_within(found[0].largest, x(coupler + crank)), "{found:?}");
}

/// Velocity ratios in closed form, a sin(.) / (c sin(.)), at the inputs of a grid: none is outside, and the largest is
/// within the error of the grid.
#[test]
fn velocity_ratios_of_a_four_bar() {
    let [_, crank, coupler, rocker] = LENGTHS;
    let start = Loops::<FourBar, f64>::at(four_bar(LENGTHS, 1.0, 0.7).unwrap(), 0.7);
    let found = certify::turn(&Loops::<FourBar, f64>::new(LENGTHS), &start).unwrap().velocity_ratios();
    const STEPS: u32 = 20_000;
    let ratios = (0..STEPS).map(|step| {
        let input = TAU * f64::from(step) / f64::from(STEPS);
        let [phi, psi] = four_bar(LENGTHS, 1.0, input).unwrap();
        let sine = (phi - psi).sin();
        [crank * (psi - input).sin() / (coupler * sine), crank * (phi - input).sin() / (rocker * sine)]
    });
    let all: Vec<[f64; 2]> = ratios.collect();
    for (place, Enclosure { least, largest, is_sharp, .. }) in found.iter().enumerate() {
        let (low, high) =
            all.iter().fold((f64::MAX, f64::MIN), |(low, high), ratio| (low.min(ratio[place]), high.max(ratio[place])));
        assert!(*is_sharp);
        assert!(least.least() <= low && high <= largest.most(), "{place} {low} {high} {found:?}");
        // The second derivative is about 1: half of it times the square of the step.
        assert!(low - least.least() < 1e-7 && largest.most() - high < 1e-7, "{place} {low} {high} {found:?}");
    }
}
