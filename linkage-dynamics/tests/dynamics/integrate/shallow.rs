//! Events inside a step that begin and end between two samples of the functions.

use std::cell::Cell;

use linkage_dynamics::MotionError;
use linkage_dynamics::integrate::{Action, Counts, Crossing, Guard, System, dop853, dopri5, watched};
use linkage_runtime::nalgebra::vector;
use linkage_runtime::{Column, D};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use super::{Entries, State, tolerance};

/// A function of time with one minimum, of value -`depth` at `place`.
#[derive(Debug, Clone, Copy)]
struct Dip {
    place: f64,
    width: f64,
    depth: f64,
    shape: u32,
}

impl Dip {
    /// A random one in the first unit of time, with a depth from 1e-9 to a tenth.
    fn random(random: &mut SmallRng) -> Self {
        Self {
            place: random.random_range(0.0..1.0),
            width: 10.0_f64.powf(random.random_range(-1.5..0.5)),
            depth: 10.0_f64.powf(random.random_range(-9.0..-1.0)),
            shape: random.random_range(0..6),
        }
    }

    /// Value and rate.
    fn at(&self, t: f64) -> [f64; 2] {
        let u = (t - self.place) / self.width;
        let [value, slope] = match self.shape {
            0 => [u * u, 2.0 * u],
            1 => [u.cosh() - 1.0, u.sinh()],
            2 => [1.0 - (-u * u).exp(), 2.0 * u * (-u * u).exp()],
            3 => [u * u / (1.0 + u * u), 2.0 * u / (1.0 + u * u).powi(2)],
            4 => [(1.0 + u * u).sqrt() - 1.0, u / (1.0 + u * u).sqrt()],
            // Asymmetric: steeper on one side.
            _ => [u.exp() - 1.0 - u, u.exp() - 1.0],
        };
        [value - self.depth, slope / self.width]
    }
}

/// y = t with a guard, with or without known rate.
struct Guarded<'a> {
    guard: &'a dyn Fn(f64) -> [f64; 2],
    knows: bool,
    hit: Option<f64>,
    looks: usize,
}

impl System for Guarded<'_> {
    type Scalar = f64;
    type Name = &'static str;
    type N = D<1>;
    type Events = D<0>;
    type Guards = D<1>;

    fn rate(&mut self, _: f64, _: &Entries<1>) -> Result<Entries<1>, MotionError> {
        Ok([1.0].into())
    }

    fn events(&mut self, _: f64, _: &Entries<1>) -> Result<Entries<0>, MotionError> {
        Ok([].into())
    }

    fn guards(&mut self, _: f64, y: &Entries<1>) -> Result<Column<Guard<f64>, D<1>>, MotionError> {
        self.looks += 1;
        let [value, rate] = (self.guard)(y[0]);
        Ok([Guard { value, rate: self.knows.then_some(rate) }].into())
    }

    fn at_event(&mut self, _: usize, t: f64, _: &Entries<1>) -> Result<Action<Entries<1>>, MotionError> {
        self.hit = Some(t);
        Ok(Action::Stop)
    }
}

/// The time at which the guard ends the motion, its evaluations and the cost, with steps of this length.
fn guarded(guard: &dyn Fn(f64) -> [f64; 2], knows: bool, step: f64) -> (Option<f64>, usize, Counts) {
    let system = Guarded { guard, knows, hit: None, looks: 0 };
    let mut motion = dop853(system, (0.0, vector![0.0]), 1.0, tolerance(1e-9)).unwrap();
    motion = motion.first_step(step).unwrap().largest_step(step).unwrap();
    motion.finish(|_, _| true).unwrap();
    (motion.system().hit, motion.system().looks, motion.counts())
}

/// Does the same with a user-defined event.
fn recorded(function: &dyn Fn(f64) -> [f64; 2], crossing: Crossing, parts: usize, step: f64) -> Vec<f64> {
    let looks = Cell::new(0);
    let system = watched(
        |_, _: &State<1>| Ok(vector![1.0]),
        [crossing],
        |_, y: &State<1>| {
            looks.set(looks.get() + 1);
            Ok([function(y[0])[0]])
        },
        |_, _, _| Ok(Action::Record),
    );
    let motion = dopri5(system, (0.0, vector![0.0]), 1.0, tolerance(1e-9)).unwrap();
    let motion = motion.event_parts(parts).first_step(step).unwrap().largest_step(step).unwrap();
    motion.map(Result::unwrap).filter(|step| step.event.is_some()).map(|step| step.t).collect()
}

/// The times at which the function falls and rises through zero, by bisection around its minimum.
fn zeros(dip: &Dip) -> [Option<f64>; 2] {
    let zero = |outer: f64| {
        let (mut above, mut below) = (outer, dip.place);
        if dip.at(above)[0] <= 0.0 {
            return None;
        }
        for _ in 0..200 {
            let middle = 0.5 * (above + below);
            if dip.at(middle)[0] > 0.0 { above = middle } else { below = middle }
        }
        Some(below)
    };
    [zero(0.0), zero(1.0)]
}

/// Guards, half of them with known rates: each is found at its exact time. `DIPS` is their number.
#[test]
fn one_minimum_in_a_step_is_never_missed() {
    let mut random = SmallRng::seed_from_u64(20_261_122);
    let mut found = [0; 3];
    let mut looks = [0; 4];
    let all = linkage_trials::count("DIPS", 2_000, 10_000);
    while found[0] < all {
        let dip = Dip::random(&mut random);
        let [Some(falls), rises] = zeros(&dip) else { continue };
        let knows = found[0] % 2 == 0;
        // Skip crossings that are closer together than the square root of rounding error.
        let bound = 1e-14 + 1e-15 / dip.at(falls)[1].abs();
        let (hit, by_dip, _) = guarded(&|t| dip.at(t), knows, 1.0);
        let (_, by_line, _) = guarded(&|t| [2.0 - t, -1.0], knows, 1.0);
        looks[usize::from(knows)] += by_dip;
        looks[2 + usize::from(knows)] += by_line;
        let hit = hit.unwrap_or_else(|| panic!("{} {dip:?}", found[0]));
        assert!((hit - falls).abs() < bound, "{hit} and {falls}");
        found[0] += 1;
        // As an event in either direction, and rising only.
        let both = recorded(&|t| dip.at(t), Crossing::Either, 4, 1.0);
        let expected: Vec<_> = [Some(falls), rises].into_iter().flatten().collect();
        assert_eq!(both.len(), expected.len(), "{both:?} {expected:?}");
        assert!(both.iter().zip(&expected).all(|(a, b)| (a - b).abs() < bound), "{both:?} {expected:?}");
        found[1] += 1;
        let up = recorded(&|t| dip.at(t), Crossing::Rising, 4, 1.0);
        assert_eq!(up.len(), usize::from(rises.is_some()), "{up:?} {rises:?} {dip:?} {both:?}");
        found[2] += 1;
    }
    let [by_values, by_rates, monotone, by_rates_monotone] = looks.map(|looks| 2.0 * looks as f64 / all as f64);
    println!("none of {found:?} missed; evaluations a step with rates {by_rates:.1}, with values {by_values:.1}");
    println!("compared with {by_rates_monotone:.1} and {monotone:.1} without an extremum");
}

/// The oscillator x = a sin(w t) and a wall just below a: each contact lasts a small fraction of a step.
#[test]
fn an_oscillator_grazes_its_wall() {
    let first = |frequency: f64, place: f64, relative: f64, knows: bool| {
        let system = Wall { frequency, place, knows, hit: None };
        let start = (0.0, vector![0.0, frequency]);
        let mut motion = dop853(system, start, 6.0 / frequency, tolerance(relative)).unwrap();
        motion.finish(|_, _| true).unwrap();
        (motion.system().hit.map(|t| t * frequency), motion.counts())
    };
    let mut random = SmallRng::seed_from_u64(7);
    for _ in 0..linkage_trials::count("GRAZES", 300, 1000) {
        let shallow = 10.0_f64.powf(random.random_range(-11.0..-1.0));
        // The wall is still met with this error of the position.
        let relative = (1e-3 * shallow).clamp(1e-14, 1e-5);
        let frequency = 10.0_f64.powf(random.random_range(-1.0..1.0));
        for knows in [true, false] {
            let (hit, counts) = first(frequency, 1.0 - shallow, relative, knows);
            let exact = (1.0 - shallow).asin();
            let hit = hit.unwrap_or_else(|| panic!("{shallow:e} missed at {relative:e}, {counts:?}"));
            // The time error is the position error divided by the slope.
            let bound = 100.0 * relative / (2.0 * shallow).sqrt();
            assert!((hit - exact).abs() < bound, "{shallow:e}: {:e} of {bound:e}", hit - exact);
            let (beyond, counts) = first(frequency, 1.0 + shallow, relative, knows);
            assert_eq!(beyond, None, "{shallow:e} {relative:e} {counts:?}");
        }
    }
}

/// x'' = -w^2 x with the wall x < `place`, as a guard.
struct Wall {
    frequency: f64,
    place: f64,
    knows: bool,
    hit: Option<f64>,
}

impl System for Wall {
    type Scalar = f64;
    type Name = &'static str;
    type N = D<2>;
    type Events = D<0>;
    type Guards = D<1>;

    fn rate(&mut self, _: f64, y: &Entries<2>) -> Result<Entries<2>, MotionError> {
        Ok([y[1], -self.frequency * self.frequency * y[0]].into())
    }

    fn events(&mut self, _: f64, _: &Entries<2>) -> Result<Entries<0>, MotionError> {
        Ok([].into())
    }

    fn guards(&mut self, _: f64, y: &Entries<2>) -> Result<Column<Guard<f64>, D<1>>, MotionError> {
        Ok([Guard { value: self.place - y[0], rate: self.knows.then_some(-y[1]) }].into())
    }

    fn at_event(&mut self, _: usize, t: f64, _: &Entries<2>) -> Result<Action<Entries<2>>, MotionError> {
        self.hit = Some(t);
        Ok(Action::Stop)
    }
}

/// Sums of sines with several extrema in a step, the deepest 1e-4 of the amplitude below zero: the fraction of missed
/// events, by the number of minima and the parts of the step. Of guards with known rates none is missed.
#[test]
fn of_several_extrema_in_a_step_some_are_missed() {
    let mut random = SmallRng::seed_from_u64(3);
    let mut missed = [[[0_u32; 2]; 4]; 6];
    let trials = if cfg!(debug_assertions) { 2000 } else { 20_000 };
    for trial in 0..trials {
        let fastest = [3.0, 6.0, 12.0][trial % 3];
        let terms: Vec<[f64; 3]> = (0..4)
            .map(|k| {
                [
                    random.random_range(-1.0..1.0),
                    f64::from(k + 1) * random.random_range(0.5..fastest),
                    random.random_range(0.0..6.3),
                ]
            })
            .collect();
        let sum = |t: f64| {
            terms.iter().fold([0.0, 0.0], |[value, slope], [size, fast, phase]| {
                let (sine, cosine) = (fast * t + phase).sin_cos();
                [value + size * sine, slope + size * fast * cosine]
            })
        };
        let grid: Vec<f64> = (0..=2000).map(|i| sum(f64::from(i) / 2000.0)[0]).collect();
        let lowest = (1..2000).min_by(|&a, &b| grid[a].total_cmp(&grid[b])).unwrap();
        let turns = (1..2000).filter(|&i| (grid[i] < grid[i - 1]) != (grid[i + 1] < grid[i])).count();
        let ends = grid[0].min(grid[2000]);
        let height = grid.iter().fold(f64::MIN, |most, value| most.max(*value)) - grid[lowest];
        let depth = 1e-4 * height;
        // Positive at both ends, and below zero at one of its minima.
        if turns == 0 || ends - grid[lowest] < 2.0 * depth || grid[lowest] >= ends {
            continue;
        }
        let function = |t: f64| {
            let [value, slope] = sum(t);
            [value - grid[lowest] - depth, slope]
        };
        let class = turns.min(6) - 1;
        for (count, found) in missed[class].iter_mut().zip([
            guarded(&function, true, 1.0).0.is_some(),
            guarded(&function, false, 1.0).0.is_some(),
            !recorded(&function, Crossing::Falling, 4, 1.0).is_empty(),
            !recorded(&function, Crossing::Falling, 16, 1.0).is_empty(),
        ]) {
            count[0] += u32::from(!found);
            count[1] += 1;
        }
    }
    for (turns, counts) in missed.iter().enumerate() {
        let share = counts.map(|[missed, all]| 100.0 * f64::from(missed) / f64::from(all.max(1)));
        println!(
            "{} extrema: of {} missed {share:.2?} %: by its rate, by values, an event, one in 16 parts",
            turns + 1,
            counts[0][1]
        );
    }
    // By its rate none is missed, whatever the number.
    assert!(missed.iter().all(|[[missed, _], ..]| *missed == 0), "{missed:?}");
    // The documented values: none with one extremum, 0.1 % with two, 1 % with three; 0.06 % with sixteen parts.
    assert!(missed[0].iter().all(|[missed, _]| *missed == 0), "{missed:?}");
    for (counts, most) in missed[1..].iter().zip([0.002, 0.015, 0.06, 0.3, 0.7]) {
        let within = |[missed, all]: [u32; 2], most: f64| f64::from(missed) <= most * f64::from(all);
        assert!(counts.iter().all(|&count| within(count, most)) && within(counts[3], 0.001), "{missed:?}");
    }
}

/// The cost of searching for a minimum relative to sampling alone: an oscillator far from its wall and near it.
#[test]
fn what_looking_costs() {
    for knows in [true, false] {
        let mut looks = [0; 3];
        let mut evaluations = [0; 3];
        for (i, place) in [3.0, 1.000_001].into_iter().enumerate() {
            let system = Counted { wall: Wall { frequency: 1.0, place, knows, hit: None }, looks: 0 };
            let mut motion = dop853(system, (0.0, vector![0.0, 1.0]), 1000.0, tolerance(1e-9)).unwrap();
            motion.finish(|_, _| true).unwrap();
            (looks[i], evaluations[i]) = (motion.system().looks, motion.counts().evaluations);
            looks[2] = motion.counts().accepted;
        }
        let mut alone =
            dop853(|_: f64, y: &State<2>| Ok(vector![y[1], -y[0]]), (0.0, vector![0.0, 1.0]), 1000.0, tolerance(1e-9))
                .unwrap();
        alone.finish(|_, _| true).unwrap();
        evaluations[2] = alone.counts().evaluations;
        println!(
            "rate known {knows}: {looks:?} guard evaluations far, near, steps; {evaluations:?} evaluations of the rate far, near, alone"
        );
        assert!(evaluations[1] as f64 <= 1.2 * evaluations[2] as f64);
    }
}

struct Counted {
    wall: Wall,
    looks: usize,
}

impl System for Counted {
    type Scalar = f64;
    type Name = &'static str;
    type N = D<2>;
    type Events = D<0>;
    type Guards = D<1>;

    fn rate(&mut self, t: f64, y: &Entries<2>) -> Result<Entries<2>, MotionError> {
        self.wall.rate(t, y)
    }

    fn events(&mut self, t: f64, y: &Entries<2>) -> Result<Entries<0>, MotionError> {
        self.wall.events(t, y)
    }

    fn guards(&mut self, t: f64, y: &Entries<2>) -> Result<Column<Guard<f64>, D<1>>, MotionError> {
        self.looks += 1;
        self.wall.guards(t, y)
    }
}
