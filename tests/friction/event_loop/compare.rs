//! A simulation against the oracle, within what a moved start changes.
//!
//! The bound of a coordinate or rate at a time is the sum of
//! - a thousand tolerances of its size;
//! - if the error is beyond that, the largest change that a moved start makes in the oracle: a thousand times the change by
//!   one tolerance, or the change by a thousand tolerances if that is more. Coordinates, rates and the time of the start
//!   are moved, and the motion again on its way: see `Kick`.
//!
//! If an impact comes first or second, or does not come at all, within a thousand tolerances, this bound has the size of
//! the motion itself: the comparison then says nothing, and is counted as lenient.

use std::collections::BTreeMap;

use linkage::simulation::{Simulation, State};
use linkage::{Mechanism, MotionError, Scene};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::event_loop::oracle::{Kick, Model, N, Start, Track, free_acceleration, track};

/// The tolerances of the simulations.
const TOLERANCES: [f64; 3] = [1e-6, 1e-9, 1e-11];
/// The times at which each is compared.
const TIMES: usize = 13;
/// The allowed error, in tolerances.
const ALLOWED: f64 = 1000.0;
/// The directions in which the start is moved, each both ways.
const DIRECTIONS: usize = 2;
/// A bound above this part of the size says nothing.
const LENIENT: f64 = 0.1;

/// The most steps of a simulation.
const MOST_STEPS: usize = 10_000;

/// The coordinates and rates of a scene at one time.
pub type Observed = (Vec<f64>, Vec<f64>);

/// A family of random scenes.
pub trait Family: Sized + std::fmt::Debug {
    const NAME: &'static str;
    type Model: Model;

    /// A random scene; half of them have `round` numbers.
    fn random(random: &mut SmallRng, round: bool) -> Self;
    fn model(&self) -> Self::Model;
    fn start(&self) -> Start;
    fn end(&self) -> f64;
    /// True for each coordinate of the scene that is an angle.
    fn angles() -> Vec<bool>;
    /// The states of the simulation at these times.
    fn simulate(&self, times: &[f64], tolerance: f64) -> Result<Vec<Observed>, MotionError>;
}

/// The counts of a family.
#[derive(Debug, Default)]
pub struct Counts {
    pub runs: usize,
    pub compared: usize,
    pub sensitive: usize,
    pub lenient: usize,
    pub lenient_runs: usize,
    pub collapsed: usize,
    pub beyond: usize,
    pub errors: BTreeMap<String, usize>,
    pub not_followed: BTreeMap<String, usize>,
    pub events: usize,
    pub largest: f64,
}

/// The scenes of a family that are known to agree.
const KNOWN: u64 = 1667;

/// Compares a sixth of so many scenes, those of a family.
pub fn compared<F: Family>(scenes: u64) -> Counts {
    let only: Option<u64> = std::env::var("ONLY").ok().map(|number| number.parse().unwrap());
    let count = scenes.div_ceil(6);
    // From another scene for each commit.
    let first = linkage_trials::seed(0) % KNOWN;
    let numbers = (first..first + count).map(|number| number % KNOWN.max(count));
    compared_by_number::<F>(numbers.filter(|number| only.is_none_or(|only| only == *number)))
}

/// Compares the scenes of a family with these numbers.
pub fn compared_by_number<F: Family>(numbers: impl IntoIterator<Item = u64>) -> Counts {
    let mut counts = Counts::default();
    for number in numbers {
        let mut random = SmallRng::seed_from_u64(0x5eed + number);
        let family = F::random(&mut random, number % 2 == 0);
        compare(&family, number, &mut random, &mut counts);
    }
    println!("{}: {counts:?}", F::NAME);
    counts
}

fn compare<F: Family>(family: &F, number: u64, random: &mut SmallRng, counts: &mut Counts) {
    let (model, start, end) = (family.model(), family.start(), family.end());
    let mut times: Vec<f64> = (0..TIMES).map(|_| random.random_range(start.t..end)).collect();
    times.sort_by(f64::total_cmp);
    let exact = match track(&model, &start, &times, None) {
        Ok(exact) => exact,
        Err(what) => {
            println!("{} {number}: {what} {family:?}", F::NAME);
            *counts.not_followed.entry(what.split(" at ").next().unwrap_or_default().into()).or_default() += 1;
            return;
        }
    };
    counts.events += exact.events.len();
    if std::env::var("ONLY").is_ok() {
        println!("oracle: {:?}", exact.events);
    }
    let collapse = exact.collapse.unwrap_or(f64::INFINITY);
    let exact = observed(&model, &times, &exact);
    let sizes = sizes::<F>(&model, &start, &exact);
    let kicks: Vec<Kick> = (0..DIRECTIONS)
        .flat_map(|_| {
            let mut sign = || random.random_range(-1.0..1.0_f64).signum() * random.random_range(0.5..1.0);
            let kick = Kick { size: 1.0, x: [(); N].map(|()| sign()), v: [(); N].map(|()| sign()), t: sign() };
            [kick, Kick { size: -1.0, ..kick }]
        })
        .collect();
    let changes = |size: f64| -> Vec<Observed> {
        let mut most = exact.iter().map(|(q, rates)| (vec![0.0; q.len()], vec![0.0; rates.len()])).collect::<Vec<_>>();
        for kick in &kicks {
            let Ok(moved) = track(&model, &start, &times, Some(&Kick { size: kick.size * size, ..*kick })) else {
                most.iter_mut().for_each(|(q, rates)| [q, rates].into_iter().for_each(|all| all.fill(f64::INFINITY)));
                continue;
            };
            for (most, (moved, exact)) in most.iter_mut().zip(observed(&model, &times, &moved).iter().zip(&exact)) {
                let (q, rates) = differences::<F>(moved, exact);
                for (most, value) in most.0.iter_mut().zip(q).chain(most.1.iter_mut().zip(rates)) {
                    *most = most.max(value);
                }
            }
        }
        most
    };
    for tolerance in TOLERANCES {
        counts.runs += 1;
        let found = match family.simulate(&times, tolerance) {
            Ok(found) => found,
            Err(error) => {
                println!("{} {number} at {tolerance:e}: {error} (collapse {collapse}) {family:?}", F::NAME);
                *counts.errors.entry(kind(&error)).or_default() += 1;
                continue;
            }
        };
        assert_eq!(found.len(), TIMES);
        // What a moved start changes, computed where an error is beyond a thousand tolerances of its size.
        let mut moved: Option<[Vec<Observed>; 2]> = None;
        let (mut is_lenient, mut is_beyond) = (false, false);
        for (at, found) in found.iter().enumerate() {
            let (q, rates) = differences::<F>(found, &exact[at]);
            for (part, errors) in [q, rates].iter().enumerate() {
                for (i, &error) in errors.iter().enumerate() {
                    let size = if part == 0 { sizes.0[i] } else { sizes.1[i] };
                    let mut bound = ALLOWED * tolerance * size;
                    counts.compared += 1;
                    if error <= bound {
                        counts.largest = counts.largest.max(error / bound);
                        continue;
                    }
                    let moved = moved.get_or_insert_with(|| [tolerance, ALLOWED * tolerance].map(changes));
                    let [small, large] = [0, 1].map(|n| if part == 0 { moved[n][at].0[i] } else { moved[n][at].1[i] });
                    bound += (ALLOWED * small).max(large);
                    counts.sensitive += 1;
                    if bound > LENIENT * size {
                        counts.lenient += 1;
                        is_lenient = true;
                        continue;
                    }
                    if error > bound && times[at] >= collapse {
                        counts.collapsed += 1;
                        continue;
                    }
                    counts.largest = counts.largest.max(error / bound);
                    if error > bound || error.is_nan() {
                        if !is_beyond {
                            println!(
                                "{} {number} at {tolerance:e}, t = {}, {} {i}: {error:e} of {bound:e}, {:?} for {:?}, {family:?}",
                                F::NAME,
                                times[at],
                                ["coordinate", "rate"][part],
                                found,
                                exact[at],
                            );
                        }
                        is_beyond = true;
                    }
                }
            }
        }
        counts.lenient_runs += usize::from(is_lenient);
        counts.beyond += usize::from(is_beyond);
    }
}

/// The states of a simulation at these times.
pub fn states<'a, S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>> + 'a>(
    simulate: impl Fn() -> Result<Simulation<'a, S>, MotionError>,
    times: &[f64],
    observed: impl Fn(&State<S>) -> Observed,
) -> Result<Vec<Observed>, MotionError> {
    if std::env::var("ONLY").is_ok() {
        let mut motion = simulate()?.most_steps(MOST_STEPS);
        println!("simulation:");
        let start = motion.state();
        println!("    {:.17} {:?} {:?}", start.t, start.contacts, observed(start));
        while let Some(state) = motion.advance()? {
            for change in state.changes() {
                println!("    {:.17} {change:?} {:?}", state.t, observed(&state));
            }
        }
    }
    simulate()?
        .most_steps(MOST_STEPS)
        .at(times.iter().copied())
        .map(|state| state.map(|state| observed(&state)))
        .collect()
}

fn kind(error: &MotionError) -> String {
    format!("{error:?}").split([' ', '(']).next().unwrap_or_default().into()
}

fn observed<M: Model>(model: &M, times: &[f64], track: &Track) -> Vec<Observed> {
    times.iter().zip(&track.points).map(|(&t, point)| model.observed(t, &point.x, &point.v)).collect()
}

/// The differences of coordinates, of angles up to whole turns, and of rates.
fn differences<F: Family>(a: &Observed, b: &Observed) -> Observed {
    let turn = 2.0 * std::f64::consts::PI;
    let q = a.0.iter().zip(&b.0).zip(F::angles()).map(|((a, b), is_angle)| {
        let gap = a - b;
        if is_angle { (gap - turn * (gap / turn).round()).abs() } else { gap.abs() }
    });
    (q.collect(), a.1.iter().zip(&b.1).map(|(a, b)| (a - b).abs()).collect())
}

/// The sizes of coordinates and rates: those of the motion, at least those to which the tolerance of a simulation is relative:
/// a length or a radian, for rates that times the angular frequency of the start.
fn sizes<F: Family>(model: &F::Model, start: &Start, exact: &[Observed]) -> Observed {
    let scales = model.scales();
    let mut lengths: Vec<f64> =
        F::angles().into_iter().map(|is_angle| if is_angle { 1.0 } else { scales.length }).collect();
    let acceleration = free_acceleration(model, start);
    let little = 1e-6 * scales.step;
    let (mut x, mut v) = (start.x, start.v);
    for i in 0..N {
        x[i] += v[i] * little;
        v[i] += acceleration[i] * little;
    }
    let (_, before) = model.observed(start.t, &start.x, &start.v);
    let (_, after) = model.observed(start.t + little, &x, &v);
    let mut frequency = 1.0 / scales.time;
    for ((before, after), length) in before.iter().zip(&after).zip(&lengths) {
        let urge = ((after - before) / little / length).abs().sqrt();
        frequency = frequency.max(before.abs() / length).max(urge);
    }
    let mut rates: Vec<f64> = lengths.iter().map(|length| length * frequency).collect();
    for (at_q, at_rates) in exact {
        for ((size, value), is_angle) in lengths.iter_mut().zip(at_q).zip(F::angles()) {
            *size = if is_angle { *size } else { size.max(value.abs()) };
        }
        for (size, value) in rates.iter_mut().zip(at_rates) {
            *size = size.max(value.abs());
        }
    }
    (lengths, rates)
}

/// A number between two bounds; a round one is a multiple of a tenth of the range, rounded to two digits.
pub fn number(random: &mut SmallRng, round: bool, [low, high]: [f64; 2]) -> f64 {
    let value: f64 = random.random_range(low..high);
    if !round {
        return value;
    }
    let unit = 10_f64.powf(((high - low) / 5.0).log10().floor());
    ((value / unit).round() * unit * 1e6).round() / 1e6
}

/// A coefficient of restitution: in round scenes 0, 0.5 or 1.
pub fn restitution(random: &mut SmallRng, round: bool) -> f64 {
    if round { [0.0, 0.5, 1.0][random.random_range(0..3)] } else { random.random_range(0.0..0.9) }
}
