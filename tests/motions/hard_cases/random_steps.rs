//! Random steps over every mechanism of the gallery and over random four-bars.
//!
//! Known to fail: followers that rely on Newton's method for the nearest position. Each position is compared with the
//! closed form of the branch that the events determine; every other end must be a typed error.

use std::f64::consts::{PI, TAU};

use linkage::continuation::{Along, AlongCoordinates, AtChangePoint, Direction, Event, Options, Path};
use linkage::position::newton;
use linkage::{Assembly, Branches, Build, D, Elbow, Kinematic, Mechanism, PathError, PerInput, UpTo};
use linkage_gallery::four_bar::{FourBar, FourBarBranch};
use linkage_gallery::listed;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::at_run_time;

/// The outcomes of steps.
#[derive(Debug, Default, Clone, Copy)]
struct Count {
    steps: usize,
    dead_points: usize,
    change_points: usize,
    errors: usize,
    silent: usize,
}

impl std::ops::AddAssign for Count {
    fn add_assign(&mut self, other: Self) {
        self.steps += other.steps;
        self.dead_points += other.dead_points;
        self.change_points += other.change_points;
        self.errors += other.errors;
        self.silent += other.silent;
    }
}

/// A step from 1e-6 to 2 radians, either way, evenly by its logarithm.
fn stride(random: &mut SmallRng) -> f64 {
    let size = 2.0 * 10_f64.powf(random.random_range(-6.0..0.0));
    if random.random() { size } else { -size }
}

/// The largest difference of the unknowns: of angles modulo full turns, of lengths relative to the largest.
fn difference<M: Mechanism<Scalar = f64>>(m: &M, one: &M::Coordinates, two: &M::Coordinates) -> f64 {
    let (one, two, angles) = (M::unknowns(one), M::unknowns(two), m.unknown_angles());
    let is_length = |index: &usize| !angles[*index];
    let largest = (0..angles.len()).filter(is_length).map(|index| two[index].abs()).fold(0.0, f64::max);
    let part = |index: usize| match one[index] - two[index] {
        turn if angles[index] => 2.0 * (turn / 2.0).sin().abs(),
        length => length.abs() / largest,
    };
    // If a length is exactly zero in both, there is no difference.
    (0..angles.len()).map(part).filter(|part| !part.is_nan()).fold(0.0, f64::max)
}

/// Sends the input to random values, from one of the positions that `starts` has at an input. Every position on the way
/// must be that of `expected`, from the start of the walk, the last position and the input.
fn walk<M: Mechanism<Scalar = f64, V = D<1>>>(
    m: &M,
    starts: impl Fn(f64, &mut SmallRng) -> Vec<M::Coordinates>,
    expected: impl Fn(&M::Coordinates, &M::Coordinates, f64) -> Option<M::Coordinates>,
    steps: usize,
    random: &mut SmallRng,
) -> Count {
    let mut count = Count::default();
    'starts: while count.steps < steps {
        let all = (0..1000).map(|_| starts(random.random_range(0.0..TAU), random)).find(|all| !all.is_empty());
        let all = all.unwrap_or_else(|| panic!("{}: no position", m.name()));
        let start = all[random.random_range(0..all.len())];
        // Ranges stop a motion anywhere.
        let options = Options { at_change_point: AtChangePoint::Stop, joint_ranges: false, ..Options::default() };
        let mut path = match Path::with(m, &start, Direction::Increasing, options) {
            Ok(path) => path,
            Err(error) => {
                count.steps += 1;
                stop(&mut count, &error);
                continue;
            }
        };
        for _ in 0..50 {
            count.steps += 1;
            let before = path.position();
            let input = M::inputs(&before)[0] + stride(random);
            match path.advance_to(input) {
                Ok(step) => {
                    let is_branch = m.same_branch(&m.pose_at(&start), &m.pose_at(&step.position));
                    let off = expected(&start, &before, input).map(|q| difference(m, &step.position, &q));
                    // The closed form and the follower agree to rounding error, or at a dead point to the root of it.
                    if !is_branch || off.is_none_or(|off| off > 1e-7) {
                        let [before, after] = [before, step.position].map(|q| (M::inputs(&q)[0], M::unknowns(&q)));
                        println!("{} from {before:?} to {after:?}: {off:?}", m.name());
                        count.silent += 1;
                    }
                }
                Err(error) => {
                    stop(&mut count, &error);
                    continue 'starts;
                }
            }
        }
    }
    println!("{}: {count:?}", m.name());
    count
}

/// Counts the end of a walk.
fn stop<N: linkage::Name>(count: &mut Count, error: &PathError<N>) {
    match error {
        PathError::DeadPoint { .. } => count.dead_points += 1,
        PathError::ChangePoint { .. } => count.change_points += 1,
        PathError::Lost { .. } => count.errors += 1,
        error => panic!("{error}"),
    }
}

/// The position of a mechanism without closed form at an input, from another position, by steps so short that Newton's
/// method has no choice: each corrects the tangent by a hundredth of the step at most.
fn by_short_steps<M: Mechanism<Scalar = f64, V = D<1>>>(
    m: &M,
    from: &M::Coordinates,
    input: f64,
) -> Option<M::Coordinates> {
    let (mut q, mut step) = (*from, 0.01);
    loop {
        let left = input - M::inputs(&q)[0];
        if left == 0.0 {
            return Some(q);
        }
        let pose = m.pose_at(&q);
        let ratios = -m.solve_jacobian(&pose, &m.jacobian_inputs(&pose).column(0)).ok()?;
        let length = left.abs().min(step / (1.0 + ratios.largest()));
        let forward = length.copysign(left);
        let next = if length == left.abs() { input } else { M::inputs(&q)[0] + forward };
        let predicted = M::coordinates(M::unknowns(&q) + ratios * forward, [next].into());
        let corrected = (0..6).try_fold(predicted, |q, _| {
            let pose = m.pose_at(&q);
            let correction = m.solve_jacobian(&pose, &m.residual(&pose)).ok()?;
            Some(M::with_unknowns(&q, M::unknowns(&q) - correction))
        })?;
        let correction = (M::unknowns(&corrected) - M::unknowns(&predicted)).largest();
        if correction <= 0.01 * length * (1.0 + ratios.largest()) + 1e-14 {
            (q, step) = (corrected, (2.0 * step).min(0.01));
        } else if step > 1e-12 {
            step /= 2.0;
        } else {
            return None;
        }
    }
}

/// Walks of a mechanism with one input, which has a closed form or is solved by Newton's method.
fn one_input<M>(m: &M, is_closed: bool, steps: usize, random: &mut SmallRng) -> Count
where
    M: Kinematic<Scalar = f64, V = D<1>> + Assembly + Branches,
{
    if !is_closed {
        let starts = |input: f64, random: &mut SmallRng| {
            from_a_random_guess(m, PerInput::<M>::from([input]), random).into_iter().collect()
        };
        return walk(m, starts, |_: &_, before: &_, input| by_short_steps(m, before, input), steps, random);
    }
    let starts = |input: f64, _: &mut SmallRng| positions(m, PerInput::<M>::from([input]));
    // The turns that are nearest to the last position.
    let expected = |start: &M::Coordinates, before: &M::Coordinates, input: f64| {
        let guess = M::with_inputs(before, [input].into());
        Some(M::coordinates_of(&m.assemble_near(&guess, m.branch_of(&m.pose_at(start))).ok()?))
    };
    walk(m, starts, expected, steps, random)
}

/// Walks of a mechanism whose inputs all follow one parameter.
fn several_inputs<M>(m: &M, is_closed: bool, scale: f64, steps: usize, random: &mut SmallRng) -> Count
where
    M: Kinematic<Scalar = f64> + Assembly + Branches + Clone,
{
    let along = Along { mechanism: m.clone(), inputs: |s| round(m, scale, s) };
    let inputs = |parameter: f64| round(m, scale, parameter)[0];
    if !is_closed {
        let starts = |parameter: f64, random: &mut SmallRng| {
            let q = from_a_random_guess(m, inputs(parameter), random);
            q.map(|q| AlongCoordinates { q, parameter }).into_iter().collect()
        };
        return walk(&along, starts, |_: &_, before: &_, s| by_short_steps(&along, before, s), steps, random);
    }
    let starts = |parameter: f64, _: &mut SmallRng| {
        positions(m, inputs(parameter)).into_iter().map(|q| AlongCoordinates { q, parameter }).collect()
    };
    let expected = |start: &AlongCoordinates<_>, _: &AlongCoordinates<_>, parameter: f64| {
        let branch = m.branch_of(&m.pose_at(&along.position(start)));
        let pose = m.assemble(inputs(parameter).into(), branch).ok()?;
        Some(AlongCoordinates { q: M::coordinates_of(&pose), parameter })
    };
    walk(&along, starts, expected, steps, random)
}

/// The positions on all branches.
fn positions<M: Branches<Scalar = f64>>(m: &M, inputs: PerInput<M>) -> Vec<M::Coordinates> {
    m.all_positions(inputs.into()).map(|all| all.map(|(_, q)| q).collect()).unwrap_or_default()
}

/// The position that Newton's method finds at these inputs from random unknowns.
fn from_a_random_guess<M: Kinematic<Scalar = f64>>(
    m: &M,
    inputs: PerInput<M>,
    random: &mut SmallRng,
) -> Option<M::Coordinates> {
    let guess = M::coordinates(m.dims().0.column(|_| random.random_range(-PI..PI)), inputs);
    Some(newton(m, &M::coordinates_of(&m.pose_at(&guess))).ok()?.coordinates)
}

/// Inputs with their first two derivatives by the parameter: angles at different rates, lengths round circles or
/// ellipses that leave the range of the mechanism.
fn round<M: Mechanism<Scalar = f64>>(m: &M, scale: f64, s: f64) -> [PerInput<M>; 3] {
    let parts = |index: usize| {
        let place = index as f64;
        let (sine, cosine) = (s - place * PI / 2.0).sin_cos();
        if m.input_angles()[index] {
            let rate = 1.0 - 0.3 * place;
            [rate * s + place, rate, 0.0]
        } else {
            let radius = 0.9 * scale / (1 + index / 2) as f64;
            [radius * (cosine + f64::from(u8::from(index.is_multiple_of(2)))), -radius * sine, -radius * cosine]
        }
    };
    [0, 1, 2].map(|order| m.dims().1.column(|index| parts(index)[order]))
}

/// Walks of all mechanisms of the gallery, at run time.
///
/// `cam_follower` is lost at times on the return: the law there is a difference of nearly equal numbers and has fewer
/// digits than its scale suggests, which the follower does not take for rounding error.
fn gallery(steps: usize) -> Count {
    let random = &mut SmallRng::seed_from_u64(linkage_trials::seed(7));
    let mut count = Count::default();
    for listed in listed::all() {
        let design = at_run_time::of(listed.file(), listed.name()).design();
        let prepared = design.prepared().expect("a mechanism within the capacities");
        let is_closed = !listed.branches().is_empty();
        // The largest parameter is of the order of the lengths.
        let scale = design.parameters().iter().copied().fold(0.0, f64::max);
        count += match listed.inputs().len() {
            1 => one_input(&prepared.with_inputs::<D<1>>().expect("one input"), is_closed, steps, random),
            _ => {
                let m = prepared.with_inputs::<UpTo<6>>().expect("six inputs at most");
                several_inputs(&m, is_closed, scale, steps, random)
            }
        };
        assert_eq!(prepared.failure(), None, "{}", listed.name());
    }
    count
}

/// Four-bars of random lengths, followed by arc length through all their events.
fn four_bars(steps: usize) -> Count {
    let (random, mut count) = (&mut SmallRng::seed_from_u64(linkage_trials::seed(11)), Count::default());
    while count.steps < steps {
        let m = FourBar::from([(); 4].map(|()| random.random_range(0.2..2.0)));
        let elbow = if random.random() { Elbow::Left } else { Elbow::Right };
        let mut branch = FourBarBranch::new(elbow);
        let Ok(pose) = m.assemble(random.random_range(0.0..TAU), branch) else { continue };
        let longest_step = 10_f64.powf(random.random_range(-2.0..0.0));
        let options = Options { longest_step, ..Options::default() };
        let Ok(path) = Path::with(&m, &pose.coordinates(), Direction::Increasing, options) else { continue };
        for step in path.take(100) {
            count.steps += 1;
            let Ok(step) = step else {
                count.errors += 1;
                break;
            };
            match step.event {
                Some(Event::DeadPoint { .. }) => {
                    count.dead_points += 1;
                    let Elbow::Left = branch.theta3_theta4 else {
                        branch.theta3_theta4 = Elbow::Left;
                        continue;
                    };
                    branch.theta3_theta4 = Elbow::Right;
                }
                None => {
                    let pose = m.pose_at(&step.position);
                    let expected = m.assemble(step.position.theta2, branch).unwrap();
                    let off =
                        (pose.theta3.im - expected.theta3.im).abs().max((pose.theta3.re - expected.theta3.re).abs());
                    if m.branch_of(&pose).theta3_theta4 != branch.theta3_theta4 || off > 1e-6 {
                        println!("{m:?} at {:?}: off by {off:e}", step.position);
                        count.silent += 1;
                    }
                }
                Some(other) => panic!("{other:?}"),
            }
        }
    }
    println!("random four-bars: {count:?}");
    count
}

/// `STEPS=20000 cargo test --release --test motions random_steps` takes so many steps with each mechanism, and forty
/// times as many with four-bars: 2.1 million in a minute.
#[test]
fn no_silent_change() {
    let steps = linkage_trials::count("STEPS", 30, 100);
    let mut count = gallery(steps);
    count += four_bars(40 * steps);
    println!("{count:?}");
    assert_eq!(count.silent, 0);
    assert!(count.dead_points > 30 && count.errors * 100 < count.steps);
}
