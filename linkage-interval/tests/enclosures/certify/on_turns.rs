//! Angles that go on where `atan2` jumps, against sums of small steps.

use std::f64::consts::{PI, TAU};

use linkage_interval::Interval;
use linkage_interval::certify::{self, Certify, Enclosure};
use linkage_trials::count;

use crate::certify::loops::{Loops, Shape};
use crate::certify::random::{Random, four_bar};
use crate::certify::shapes::Directions;

type Bar = Loops<Directions, f64>;

/// The directions at the positions of a motion one after another, each on the turn of the one before.
fn followed(lengths: [f64; 4], positions: impl Iterator<Item = (f64, [f64; 2])>) -> Vec<Vec<f64>> {
    let [_, crank, coupler, _] = lengths;
    let mut last: Option<[f64; 3]> = None;
    let angles = positions.map(|(input, [phi, _])| {
        let pin = [crank * input.cos() + coupler * phi.cos(), crank * input.sin() + coupler * phi.sin()];
        let own = [input.sin().atan2(input.cos()), (-phi.sin()).atan2(-phi.cos()), pin[1].atan2(pin[0])];
        let near = |(own, last): (f64, f64)| own + ((last - own) / TAU).round() * TAU;
        let now = last.map_or(own, |last| std::array::from_fn(|place| near((own[place], last[place]))));
        last = Some(now);
        Directions::DIRECTIONS.iter().map(|terms| terms.iter().map(|&(factor, of)| factor * now[of]).sum()).collect()
    });
    angles.collect()
}

/// All values are in the bounds, and the bounds are as near as steps are short.
fn compare(found: Enclosure, place: usize, all: &[Vec<f64>], slack: f64) {
    let values = all.iter().map(|values| values[place]);
    let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(value), high.max(value)));
    let rounding = 1e-9 * (1.0 + low.abs().max(high.abs()));
    let Enclosure { least, largest, is_sharp, .. } = found;
    assert!(is_sharp, "{place} {found}");
    assert!(least.least() <= low + rounding && high - rounding <= largest.most(), "{place} {found} {low} {high}");
    assert!(low - least.least() < slack && largest.most() - high < slack, "{place} {found} {low} {high}");
}

#[test]
fn directions_of_random_cranks() {
    let mut random = Random(5);
    const STEPS: u32 = 2000;
    let mut crossed = 0;
    for trial in 0..count("DIRECTIONS", 4, 100) {
        let mut lengths = [1.0, random.between(0.1, 0.3), random.between(0.8, 1.2), random.between(0.6, 1.0)];
        // All links of every other one turn about its short ground.
        lengths.swap(0, trial % 2);
        let (input, side) = (random.between(-PI, PI), if random.between(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 });
        let Some(unknowns) = four_bar(lengths, side, input) else { continue };
        let Ok(certificate) = certify::turn(&Bar::new(lengths), &Bar::at(unknowns, input)) else { continue };
        let inputs = (0..=STEPS).map(|step| input + TAU * f64::from(step) / f64::from(STEPS));
        let all = followed(lengths, inputs.map(|input| (input, four_bar(lengths, side, input).unwrap())));
        for place in 0..Directions::DIRECTIONS.len() {
            let found = certificate.quantity_on_turns(Directions::FIRST + place).unwrap();
            compare(found, place, &all, 1e-4);
        }
        crossed += usize::from(all.iter().any(|values| values[1].abs() > PI));
        // The crank turns once, from its own angle.
        let crank = certificate.quantity_on_turns(Directions::FIRST).unwrap();
        assert!((crank.least.middle() - input).abs() < 1e-8 && (crank.largest.middle() - input - TAU).abs() < 1e-8);
        // A coordinate does not jump.
        assert_eq!(certificate.quantity_on_turns(0), certificate.quantity(0));
        assert_eq!(certificate.quantity_on_turns(12), None);
    }
    assert!(crossed > 0);
}

/// No link of the first turns; the coupler of the second does, while its input goes to and fro.
#[test]
fn directions_along_curves() {
    const STEPS: u32 = 5000;
    for (lengths, coupler_turns) in [([4.0, 3.0, 2.0, 2.5], 0), ([4.0, 3.0, 1.0, 3.5], 1)] {
        let [ground, crank, coupler, rocker] = lengths;
        let limit =
            |distance: f64| ((crank * crank + ground * ground - distance * distance) / (2.0 * crank * ground)).acos();
        // The second keeps away from the line of its ground.
        let most = limit(coupler + rocker);
        let least = if coupler_turns == 0 { -most } else { limit(rocker - coupler) };
        let (middle, half) = (0.5 * (most + least), 0.5 * (most - least));
        let start = -0.3_f64;
        let place = |step: u32| {
            let s = start + TAU * f64::from(step) / f64::from(STEPS);
            let side = if s.cos() < 0.0 { -1.0 } else { 1.0 };
            let input = middle + half * (1.0 - 1e-12) * s.sin();
            (input, four_bar(lengths, side, input).unwrap())
        };
        let (input, unknowns) = place(0);
        let curve = certify::curve(&Bar::new(lengths), &Bar::at(unknowns, input)).unwrap();
        assert_eq!(curve.turns()[0].abs(), coupler_turns);
        let all = followed(lengths, (0..=STEPS).map(place));
        for place in 0..Directions::DIRECTIONS.len() {
            let found = curve.quantity_on_turns(Directions::FIRST + place).unwrap();
            compare(found, place, &all, 1e-4);
        }
        if coupler_turns == 1 {
            let coupler = curve.quantity_on_turns(Directions::FIRST + 1).unwrap();
            assert!((coupler.largest.middle() - coupler.least.middle()) >= TAU - 1e-9, "{coupler}");
        }
    }
}

/// The bounds for all lengths within tolerances contain those at their corners, and are little wider.
#[test]
fn directions_within_tolerances() {
    let lengths = [1.0, 0.3, 1.1, 0.8];
    let start = |lengths| Bar::at(four_bar(lengths, 1.0, 2.0).unwrap(), 2.0);
    let of = |certify: Certify<'_, Bar>, start| {
        let found = certify.turn(&start).unwrap();
        [0, 1].map(|place| found.quantity_on_turns(Directions::FIRST + place).unwrap())
    };
    let all = of(Certify::new(&Bar::new(lengths)).tolerance(1e-3), start(lengths));
    let mut corners = [None::<[Interval; 2]>; 2];
    for corner in 0_u32..16 {
        let at: [f64; 4] =
            std::array::from_fn(|place| lengths[place] * if corner >> place & 1 == 1 { 1.001 } else { 0.999 });
        for ((found, all), corner) in of(Certify::new(&Bar::new(at)), start(at)).into_iter().zip(&all).zip(&mut corners)
        {
            assert!(found.least.is_within(all.least) && found.largest.is_within(all.largest), "{found} {all}");
            let both = [found.least, found.largest];
            *corner = Some(corner.map_or(both, |[least, largest]| [least.hull(both[0]), largest.hull(both[1])]));
        }
    }
    for (all, corners) in all.iter().zip(corners.into_iter().flatten()) {
        let rounding = 2e-6;
        assert!(all.least.width() <= 1.3 * corners[0].width() + rounding, "{all} {corners:?}");
        assert!(all.largest.width() <= 1.3 * corners[1].width() + rounding, "{all} {corners:?}");
    }
}

/// A crank and a coupler of one length in line: the pin stays in the origin, and has no direction.
#[test]
fn a_direction_at_the_origin() {
    let start = Bar::at([1.0 + PI, PI], 1.0);
    let certificate = certify::range(&Bar::new([2.0, 1.0, 1.0, 2.0]), &start, 2.0).unwrap();
    let found = [0, 1, 5].map(|place| certificate.quantity_on_turns(Directions::FIRST + place).is_some());
    assert_eq!(found, [true, true, false]);
}

/// The rate of an angle does not jump with it.
#[test]
fn rates_over_a_jump() {
    let lengths = [1.0, 0.3, 1.1, 0.8];
    let start = Bar::at(four_bar(lengths, 1.0, 3.1).unwrap(), 3.1);
    let certificate = certify::range(&Bar::new(lengths), &start, 3.2).unwrap();
    let rate = certificate.quantity_ratios()[Directions::FIRST].values();
    assert!(rate.contains(1.0) && rate.width() < 1e-6, "{rate}");
}
