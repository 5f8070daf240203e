//! Over intervals the formulas contain the values of the derivation's expressions in 48 digits.

use linkage::Interval;
use linkage_gallery::listed::Named as _;
use linkage_oracle::Oracle;
use linkage_oracle::precise::{Big, big};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::intervals::formulas::{At, Enclosable, is_known, nodes};
use crate::intervals::poses;

/// At numbers, where only rounding errors make an interval wide.
pub fn of_points(of: &Enclosable) {
    let mut oracle = Oracle::of(of);
    let nodes = nodes(&mut oracle);
    let known = is_known(&oracle, &nodes);
    let tape = oracle.tape(&nodes);
    let mut widths = Vec::new();
    oracle.at_samples(poses(), |_, sample| {
        let found = of.values(&At::of(sample, &oracle.derivation).map(Interval::from));
        contain(&found, &oracle.precisely(&tape, sample));
        let sizes = oracle.magnitudes(sample, &nodes);
        for (place, interval) in found.iter().enumerate() {
            if known[place] && sizes[place] > 0.0 {
                assert!(interval.width().is_finite(), "nothing is known of number {place}");
                widths.push(interval.width() / (f64::EPSILON * sizes[place]));
            }
        }
    });
    widths.sort_by(f64::total_cmp);
    if let (Some(median), Some(most)) = (widths.get(widths.len() / 2), widths.last()) {
        println!("{}: {} numbers, widths in ulps: median {median:.1}, most {most:.1}", of.name(), widths.len());
    }
}

/// Over wide intervals of coordinates and rates, and narrow ones of parameters: at random numbers inside.
pub fn of_boxes(of: &Enclosable) {
    let mut oracle = Oracle::of(of);
    let nodes = nodes(&mut oracle);
    let tape = oracle.tape(&nodes);
    let mut random = SmallRng::seed_from_u64(linkage_trials::seed(20_091_122));
    oracle.at_samples(poses(), |_, sample| {
        let radius = 10_f64.powf(random.random_range(-6.0..0.5));
        let of_parameters = if random.random() { 1e-3 * radius } else { 0.0 };
        let around = |value: f64, radius: f64| Interval::around(value, radius).unwrap();
        let at = At::of(sample, &oracle.derivation);
        let wide = At {
            parameters: at.parameters.iter().map(|&value| around(value, of_parameters)).collect(),
            ..at.map(|value| around(value, radius))
        };
        let found = of.values(&wide);
        for _ in 0..3 {
            let mut inner = |value: f64, radius: f64| value + radius * random.random_range(-1.0..1.0);
            let other = oracle.moved(sample, |parameter| inner(parameter, of_parameters), |coordinate| coordinate);
            let other = oracle.moved(&other, |parameter| parameter, |coordinate| inner(coordinate, radius));
            contain(&found, &oracle.precisely(&tape, &other));
        }
    });
}

/// Asserts that each interval contains its number, up to the last digits of 48.
pub fn contain(found: &[Interval], exact: &[Big]) {
    assert_eq!(found.len(), exact.len());
    for (place, (interval, exact)) in found.iter().zip(exact).enumerate() {
        let [least, most] = [interval.least(), interval.most()].map(|bound| bound.is_finite().then(|| big(bound)));
        let is_inside = least.is_none_or(|least| least <= *exact) && most.is_none_or(|most| *exact <= most);
        assert!(is_inside, "number {place}, {exact}, is outside {interval:?}");
    }
}
