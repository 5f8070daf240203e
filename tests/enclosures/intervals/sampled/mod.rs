//! Certificates of random mechanisms against samples of the emitted positions, bisected towards jumps and extremes.
//!
//! `CERTIFIED=10000 cargo test --release --all-features --test enclosures sampled` for a larger number of parameter sets.

mod mechanisms;

use std::f64::consts::TAU;

use linkage::certify::{Certificate, Certify, CertifyError, Enclosure, End};
use linkage::{Branches, Build, Certifiable, Column, D, Formulas};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use mechanisms::*;

/// Samples of each certificate.
const SAMPLES: usize = 100;
/// Bisections towards each jump.
const BISECTIONS: usize = 40;
/// The parts of a grid towards an extreme, and the number of grids.
const GRID: usize = 8;
const GRIDS: usize = 5;
/// The most local extremes of the samples that are searched.
const PEAKS: usize = 6;
/// The error of a listed position, relative to 1 and its coordinates: half of the digits next to a singular position.
const OF_POSITION: f64 = 1e-7;

/// The numbers of certificates by their end.
#[derive(Debug, Default)]
struct Counts {
    closed: usize,
    open: usize,
    ranges: usize,
    dead: usize,
    curves: usize,
    no_bounds: usize,
    singular: usize,
    undecided: usize,
    sharp: usize,
    values: usize,
}

/// All positions at an input.
fn positions<M>(m: &M, input: f64) -> Vec<M::Coordinates>
where
    M: Branches<Scalar = f64, V = D<1>>,
{
    let all = m.all_positions(M::Inputs::from(Column::from([input])));
    all.map(|all| all.map(|(_, position)| position).collect()).unwrap_or_default()
}

/// A sample of a motion: its input, the unknowns with their turns, the quantities.
struct Sample {
    input: f64,
    unknowns: Vec<f64>,
    values: Vec<f64>,
}

/// A certified motion with its bounds.
struct Motion<'a, M: Certifiable> {
    m: &'a M,
    certificate: Certificate<M>,
    quantities: Vec<Enclosure>,
}

impl<M> Motion<'_, M>
where
    M: Certifiable + Branches<Scalar = f64, V = D<1>> + std::fmt::Debug,
{
    /// The listed position that is nearest to the tube at an input, which must be in it.
    fn sample(&self, input: f64) -> Sample {
        let tube = self.certificate.unknowns_at(input.into()).unwrap();
        let turned = |position: &M::Coordinates| {
            let (unknowns, _) = M::parts(position);
            let all = unknowns.iter().zip(&tube).zip(M::UNKNOWN_ANGLES).map(|((&x, tube), is_angle)| {
                if *is_angle { x + TAU * ((tube.middle() - x) / TAU).round() } else { x }
            });
            all.collect::<Vec<f64>>()
        };
        let distance = |unknowns: &[f64]| {
            let errors = unknowns.iter().zip(&tube).map(|(x, tube)| {
                let outside = (tube.least() - x).max(x - tube.most()).max(0.0);
                outside / (1.0 + x.abs())
            });
            errors.fold(0.0, f64::max)
        };
        let all = positions(self.m, input);
        let nearest = all.iter().map(turned).min_by(|one, other| distance(one).total_cmp(&distance(other)));
        let Some(unknowns) = nearest else { panic!("{:?} has no position at {input:?}", self.m) };
        assert!(distance(&unknowns) < OF_POSITION, "{:?} {input:?}: {unknowns:?} {tube:?}", self.m);
        let formulas = self.m.over::<f64>(Certifiable::parameters(self.m));
        let at = self.m.dims().0.column(|place| unknowns[place]);
        let values: Vec<f64> = formulas.quantities(&at, &Column::from([input])).iter().copied().collect();
        for (value, found) in values.iter().zip(&self.quantities) {
            let slack = OF_POSITION * (1.0 + value.abs());
            let is_in = found.least.least() <= value + slack && found.largest.most() >= value - slack;
            assert!(is_in || !value.is_finite(), "{:?} {input:?}: {value} {found:?}", self.m);
            assert!(value.is_finite() || !found.is_sharp, "{:?} {input:?}: {value} {found:?}", self.m);
        }
        Sample { input, unknowns, values }
    }

    /// Bisects between two samples towards the larger change of a quantity: a jump is approached from both sides.
    fn to_jump(&self, place: usize, [mut one, mut other]: [Sample; 2]) -> usize {
        for _ in 0..BISECTIONS {
            let middle = self.sample(0.5 * (one.input + other.input));
            let change = |from: &Sample| (middle.values[place] - from.values[place]).abs();
            if change(&one) > change(&other) { other = middle } else { one = middle }
        }
        BISECTIONS
    }

    /// The largest value of a quantity times a sign between two inputs, by finer and finer grids.
    fn to_extreme(&self, place: usize, sign: f64, [from, to]: [f64; 2]) -> f64 {
        let (mut from, mut step, mut best) = (from, (to - from) / GRID as f64, f64::NEG_INFINITY);
        for _ in 0..GRIDS {
            let at = |k: usize| (from + step * k as f64).clamp(self.certificate.inputs().least(), to);
            let values: Vec<f64> = (0..=GRID).map(|k| sign * self.sample(at(k)).values[place]).collect();
            let most = (0..=GRID).max_by(|&one, &other| values[one].total_cmp(&values[other])).unwrap();
            best = best.max(values[most]);
            from = at(most.saturating_sub(1));
            step *= 2.0 / GRID as f64;
        }
        best
    }

    fn check(&self, random: &mut SmallRng, counts: &mut Counts) {
        let inputs = self.certificate.inputs();
        let part = inputs.width() / SAMPLES as f64;
        let at = |place: usize, part_of: f64| (inputs.least() + part * (place as f64 + part_of)).min(inputs.most());
        let inside = (1..SAMPLES - 1).map(|place| at(place, random.random_range(0.0..1.0)));
        let at: Vec<f64> = [inputs.least()].into_iter().chain(inside).chain([inputs.most()]).collect();
        let samples: Vec<Sample> = at.iter().map(|&input| self.sample(input)).collect();
        counts.values += samples.len();
        // By the mean-value theorem the rate takes the value of each quotient of differences.
        let rates = self.certificate.velocity_ratios();
        for pair in samples.windows(2) {
            let step = pair[1].input - pair[0].input;
            for (place, rate) in rates.iter().enumerate() {
                let change = pair[1].unknowns[place] - pair[0].unknowns[place];
                let slack = OF_POSITION * (1.0 + pair[0].unknowns[place].abs() + step * rate.values().magnitude());
                let all = rate.values();
                let is_in = change >= step * all.least() - slack && change <= step * all.most() + slack;
                assert!(is_in, "{:?} {:?}: {change} {step} {rate:?}", self.m, pair[0].input);
            }
        }
        for (place_of, found) in self.quantities.iter().enumerate() {
            let value = |sample: &Sample| sample.values[place_of];
            let change = |pair: &[Sample]| (value(&pair[1]) - value(&pair[0])).abs();
            let steepest = samples.windows(2).max_by(|one, other| change(one).total_cmp(&change(other))).unwrap();
            let pair = [0, 1].map(|side| self.sample(steepest[side].input));
            counts.values += self.to_jump(place_of, pair);
            let fastest = rates.iter().fold(1.0, |most: f64, rate| most.max(rate.values().magnitude()));
            for (sign, extreme) in [(1.0, found.largest), (-1.0, -found.least)] {
                let signed = |place: usize| sign * value(&samples[place]);
                let is_peak = |&place: &usize| {
                    let besides = [place.saturating_sub(1), (place + 1).min(SAMPLES - 1)];
                    besides.iter().all(|&beside| signed(beside) <= signed(place))
                };
                let mut peaks: Vec<usize> = (0..SAMPLES).filter(is_peak).collect();
                peaks.sort_by(|&one, &other| signed(other).total_cmp(&signed(one)));
                peaks.truncate(PEAKS);
                counts.values += peaks.len() * GRIDS * (GRID + 1);
                let most = peaks.iter().map(|&place| {
                    let [before, behind] = [place.saturating_sub(1), (place + 1).min(SAMPLES - 1)];
                    self.to_extreme(place_of, sign, [at[before], at[behind]])
                });
                let most = most.fold(f64::NEG_INFINITY, f64::max);
                // A sharp extreme is attained, between samples that are dense enough to find it.
                if found.is_sharp && 2.0 * part * fastest < 1.0 {
                    let slack = 1e-6 * (1.0 + extreme.magnitude());
                    assert!(most >= extreme.least() - slack, "{:?} {place_of}: {most} {found:?}", self.m);
                }
            }
            counts.sharp += usize::from(found.is_sharp);
        }
    }

    /// The motion is closed if, and only if, the listed position at its end is the start after full turns.
    fn check_end(&self, start: &M::Coordinates, turns: u32, counts: &mut Counts) {
        let end = self.sample(self.certificate.inputs().most());
        let (unknowns, _) = M::parts(start);
        let apart: Vec<f64> = end.unknowns.iter().zip(&unknowns).map(|(end, start)| end - start).collect();
        let is_again = apart.iter().zip(M::UNKNOWN_ANGLES).zip(&unknowns).all(|((apart, is_angle), x)| {
            let rest = if *is_angle { apart - TAU * (apart / TAU).round() } else { *apart };
            rest.abs() < OF_POSITION * (1.0 + x.abs() + apart.abs())
        });
        match self.certificate.end() {
            End::Closed { turns: found } => {
                counts.closed += 1;
                let right: Vec<i64> = apart.iter().map(|apart| (apart / TAU).round() as i64).collect();
                assert!(is_again, "{:?} {apart:?}", self.m);
                assert!(
                    found
                        .iter()
                        .zip(&right)
                        .zip(M::UNKNOWN_ANGLES)
                        .all(|((one, other), is_angle)| { one == if *is_angle { other } else { &0 } })
                );
            }
            End::Open => {
                counts.open += 1;
                assert!(!is_again, "{:?} {turns} {apart:?}", self.m);
            }
            end => panic!("{end:?}"),
        }
    }
}

/// A curve through dead points: the listed positions that it passes have their values in its bounds.
fn check_curve<M>(m: &M, start: &M::Coordinates, random: &mut SmallRng, counts: &mut Counts)
where
    M: Certifiable + Branches<Scalar = f64, V = D<1>> + std::fmt::Debug,
{
    let Ok(curve) = Certify::new(m).curve(start) else { return };
    assert!(curve.passes(start) && curve.dead_points().len() % 2 == 0, "{m:?} {start:?}");
    let bounds: Vec<Enclosure> = curve.quantities().iter().copied().collect();
    let inputs = curve.tubes().map(|(inputs, _)| inputs).reduce(|one, other| one.hull(other)).unwrap();
    let formulas = m.over::<f64>(Certifiable::parameters(m));
    for _ in 0..SAMPLES / 4 {
        let input = random.random_range(inputs.least()..inputs.most());
        for position in positions(m, input).into_iter().filter(|position| curve.passes(position)) {
            let (unknowns, inputs) = M::parts(&position);
            for (value, found) in formulas.quantities(&unknowns, &inputs).iter().zip(&bounds) {
                let slack = OF_POSITION * (1.0 + value.abs());
                let is_in = found.least.least() <= value + slack && found.largest.most() >= value - slack;
                assert!(is_in, "{m:?} {input:?}: {value} {found:?}");
            }
            counts.values += 1;
        }
    }
    counts.curves += 1;
}

/// Certificates of the motions through the positions of a mechanism at a random input, over turns and over a range.
fn check<M>(m: &M, random: &mut SmallRng, counts: &mut Counts)
where
    M: Certifiable + Branches<Scalar = f64, V = D<1>> + std::fmt::Debug,
{
    let from = random.random_range(-3.0..3.0);
    let all = positions(m, from);
    if let Some(start) = all.get(random.random_range(0..all.len().max(1))).copied() {
        let turns = random.random_range(0..4);
        let certify = Certify::new(m).turns(turns);
        let to = from + random.random_range(-3.0..3.0);
        let found = if turns == 0 { certify.range(&start, to) } else { certify.turn(&start) };
        match found {
            Ok(certificate) => {
                let quantities = certificate.quantities().iter().copied().collect();
                let motion = Motion { m, certificate, quantities };
                motion.check(random, counts);
                if turns == 0 { counts.ranges += 1 } else { motion.check_end(&start, turns, counts) }
            }
            Err(CertifyError::DeadPoint { limit, .. }) => {
                // Two positions meet there.
                let step = 1e-6 + limit.width();
                let [before, behind] = [-step, step].map(|step| positions(m, limit.middle() + step).len());
                assert!(before != behind, "{m:?} {from:?} {limit:?}: {before} {behind}");
                counts.dead += 1;
                check_curve(m, &start, random, counts);
            }
            Err(CertifyError::NoBounds { .. }) => counts.no_bounds += 1,
            Err(CertifyError::Singular { .. } | CertifyError::NoPosition { .. }) => counts.singular += 1,
            // Before a pole only.
            Err(CertifyError::Undecided { .. } | CertifyError::Exhausted { .. }) => counts.undecided += 1,
            Err(error) => panic!("{m:?} {from:?}: {error}"),
        }
    }
}

type Run = fn(&mut SmallRng, &mut Counts);

/// The mechanisms with their random parameters.
const RUNS: [(&str, Run); 13] = [
    ("Crank", |random, counts| {
        check(&Crank::from(lengths(random, [false, false, false, false, true, true])), random, counts)
    }),
    ("Pointer", |random, counts| check(&Pointer::from(lengths(random, [false, true, true])), random, counts)),
    ("Shaft", |random, counts| check(&Shaft::from(lengths(random, [false, false, true])), random, counts)),
    ("FiveBar", |random, counts| check(&FiveBar::from(lengths(random, [false; 5])), random, counts)),
    ("Train", |random, counts| check(&Train::from(teeth(random)), random, counts)),
    ("Near", |random, counts| check(&Near::from(lengths(random, [false, false, true, true])), random, counts)),
    ("Lifter", |random, counts| check(&Lifter::from(lengths(random, [false, true, false, true])), random, counts)),
    ("Follower", |random, counts| {
        check(&Follower::from(lengths(random, [false, false, false, false, true, true])), random, counts)
    }),
    ("Rope", |random, counts| check(&Rope::from(lengths(random, [false, true, true])), random, counts)),
    ("Tilt", |random, counts| check(&Tilt::from(factor(random)), random, counts)),
    ("Chord", |random, counts| check(&Chord::from(equal(random)), random, counts)),
    ("Block", |random, counts| check(&Block::from(lengths(random, [false, false, true])), random, counts)),
    ("Poles", |random, counts| check(&Poles::from(factor(random)), random, counts)),
];

#[test]
fn no_sample_contradicts_a_certificate() {
    let count = linkage_trials::count("CERTIFIED", RUNS.len(), RUNS.len());
    let random = &mut SmallRng::seed_from_u64(linkage_trials::seed(44));
    for (name, run) in RUNS {
        let mut counts = Counts::default();
        for _ in 0..count.div_ceil(RUNS.len()) {
            run(random, &mut counts);
        }
        println!("{name} {counts:?}");
        assert!(counts.undecided == 0 || name == "Poles");
    }
}

/// At the end of a step by the slider the cam has a width, over which the tube of the next step must hold.
#[test]
fn wheels_pass_dead_points() {
    let m = Shaft { r: 2.450398260718348, l: 1.266870950648332, e: -2.5068308121155116 };
    for start in positions(&m, -1.7) {
        let curve = Certify::new(&m).curve(&start).unwrap();
        assert_eq!((curve.dead_points().len(), curve.input_turns()), (2, 0));
    }
}

/// The unknown u grows from 1.5 to 1.2e6, and its rounding errors with it.
#[test]
fn an_unknown_grows_before_a_pole() {
    let m = Poles { k: 1.0, w: 2.549439218421583 };
    let start = positions(&m, 1.16)[0];
    assert!(Certify::new(&m).range(&start, 3.05).is_ok());
}
