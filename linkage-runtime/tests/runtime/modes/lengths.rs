//! Groups with unknown lengths: sliders on guides of known direction, and on guides that turn with one direction.

use linkage_runtime::PositionError;
use linkage_runtime::modes::{Loops, Memory, Modes, Unknown};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::modes::group::{Number, angles, butterfly, closed, distance, evaluate, random_triad, times, turned};

/// A group with lengths.
#[derive(Debug, Clone, Copy)]
pub struct Sliding<const L: usize, const N: usize> {
    pub loops: Loops<f64, L, N>,
    pub are: [Unknown<f64>; N],
}

impl<const L: usize, const N: usize> Sliding<L, N> {
    /// The group of these factors with lengths in place of some directions, closed at this position.
    pub fn new(mut factors: [[Number; N]; L], are: [Unknown<f64>; N], position: &[f64; N]) -> Self {
        for (place, _) in are.iter().enumerate().filter(|(_, unknown)| **unknown != Unknown::Angle) {
            factors.iter_mut().for_each(|row| row[place] = [0.0; 2]);
        }
        let mut loops = closed(factors, position);
        for (unknown, length) in are.iter().zip(position) {
            let Unknown::Length { in_loop, along, with } = *unknown else { continue };
            let turn = with.map_or([1.0, 0.0], |place| turned(1.0, position[place]));
            let part = times(along, turn);
            for (constant, part) in loops.constants[in_loop].iter_mut().zip(part) {
                *constant -= part * length;
            }
        }
        Self { loops, are }
    }

    pub fn evaluate(&self, values: [f64; N]) -> ([f64; N], [f64; N], [[f64; N]; N]) {
        let (mut residuals, mut scales, mut columns) = evaluate(&self.loops, values);
        for (place, (unknown, length)) in self.are.iter().zip(values).enumerate() {
            let Unknown::Length { in_loop, along, with } = *unknown else { continue };
            let turn = with.map_or([1.0, 0.0], |place| turned(1.0, values[place]));
            let part = times(along, turn);
            for axis in 0..2 {
                let row = 2 * in_loop + axis;
                residuals[row] += part[axis] * length;
                scales[row] += (along[0].abs() + along[1].abs()) * length.abs();
                columns[place][row] = part[axis];
                if let Some(place) = with {
                    columns[place][row] += if axis == 0 { -part[1] * length } else { part[0] * length };
                }
            }
        }
        (residuals, scales, columns)
    }

    pub fn modes(&self) -> Result<Modes<f64, N>, PositionError> {
        let mut memory = Memory::default();
        memory.modes_with_lengths("Group", "t", self.loops, self.are, |all| all, |all| self.evaluate(all))
    }

    pub fn all(&self) -> Result<Vec<[f64; N]>, PositionError> {
        self.modes().map(|modes| modes.as_slice().to_vec())
    }
}

fn check<const L: usize, const N: usize>(
    lengths: &[(usize, usize, Option<usize>)],
    factors: impl Fn(&mut SmallRng) -> [[Number; N]; L],
) {
    let mut random = SmallRng::seed_from_u64(11);
    let (mut largest, mut counts) = (0.0_f64, [0; 21]);
    for case in 0..linkage_trials::count("MODES_WITH_LENGTHS", 50, 200) {
        let mut position: [f64; N] = angles(&mut random);
        let mut are = [Unknown::Angle; N];
        for &(place, in_loop, with) in lengths {
            let along = turned(random.random_range(0.5..2.0), random.random_range(-3.0..3.0));
            are[place] = Unknown::Length { in_loop, along, with };
            position[place] = random.random_range(-2.0..2.0);
        }
        let group = Sliding::new(factors(&mut random), are, &position);
        let found = group.all().unwrap_or_else(|error| panic!("case {case}: {error}"));
        let error = found.iter().map(|one| distance(one, &position)).fold(f64::INFINITY, f64::min);
        assert!(error < 1e-9, "case {case} misses its position by {error:e}");
        largest = largest.max(error);
        assert!(found.len().is_multiple_of(2));
        counts[found.len()] += 1;
        // Newton's method finds no other.
        for _ in 0..20 {
            let mut start: [f64; N] = angles(&mut random);
            for (value, unknown) in start.iter_mut().zip(&are) {
                if *unknown != Unknown::Angle {
                    *value = random.random_range(-4.0..4.0);
                }
            }
            let newton = linkage_runtime::position::newton_group("Group", "t", start, |all| group.evaluate(all));
            let Ok(newton) = newton else { continue };
            let known = found.iter().map(|one| distance(one, &newton)).fold(f64::INFINITY, f64::min);
            assert!(known < 1e-6, "case {case}: {newton:?} is not in {found:?}");
        }
    }
    println!("{lengths:?}: largest error {largest:e}, by number of positions {counts:?}");
}

#[test]
fn a_slider_on_a_fixed_guide() {
    check::<2, 4>(&[(2, 0, None)], random_triad);
    check::<3, 6>(&[(5, 2, None)], butterfly);
}

#[test]
fn a_slider_on_a_guide_that_turns() {
    check::<2, 4>(&[(2, 0, Some(0))], random_triad);
    check::<2, 4>(&[(3, 1, Some(1))], random_triad);
    check::<3, 6>(&[(4, 1, Some(1))], butterfly);
}

#[test]
fn two_sliders() {
    check::<2, 4>(&[(2, 0, None), (3, 1, None)], random_triad);
    check::<2, 4>(&[(2, 0, Some(0)), (3, 1, Some(0))], random_triad);
    check::<2, 4>(&[(2, 0, Some(0)), (3, 1, None)], random_triad);
    check::<3, 6>(&[(4, 1, None), (5, 2, None)], butterfly);
}
