//! Nanoseconds a position, with velocity and acceleration, of many positions at once: lanes of several widths, the
//! function for one position, and the same closed forms by hand over arrays of eight without checks; medians of
//! alternating rounds, and their ratios to the code by hand in the same run.
//!
//! `cargo bench --all-features --bench lanes`

#[path = "../by_hand/lanes.rs"]
mod by_hand;
mod long_chain;
mod mechanisms;

use std::hint::black_box;
use std::time::Instant;

use by_hand::Given;
use fearless_simd::{Level, Simd};
use linkage::lanes::{Batch, Lanes};
use linkage::{Elbow, Real, real};
use long_chain::{Chain, ChainBranch, ChainInputs};
use mechanisms::{FourBar, FourBarBranch, FourBarInputs, Jansen, JansenBranch, JansenInputs};

/// Positions of a batch: with its columns it fits the second-level cache.
const COUNT: usize = 256;
const ROUNDS: usize = 201;
const REPEATS: usize = 4;
const RATE: f64 = 41.9;
const ACCELERATION: f64 = 3.7;

/// One way to compute: its name, and the nanoseconds for a position.
type Way<'a> = (String, Box<dyn FnMut() -> f64 + 'a>);

fn way<'a>(name: impl Into<String>, mut work: impl FnMut() + 'a) -> Way<'a> {
    let time = move || {
        let start = Instant::now();
        for _ in 0..REPEATS {
            work();
        }
        start.elapsed().as_secs_f64() * 1e9 / (REPEATS * COUNT) as f64
    };
    (name.into(), Box::new(time))
}

/// Prints the medians and their ratios to the last.
fn table(title: &str, ways: &mut [Way]) {
    let mut times = vec![Vec::new(); ways.len()];
    for _ in 0..ROUNDS {
        for ((_, time), times) in ways.iter_mut().zip(&mut times) {
            times.push(time());
        }
    }
    let median = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2]
    };
    let medians: Vec<f64> = times.into_iter().map(median).collect();
    let by_hand = medians[medians.len() - 1];
    println!("{title}");
    for ((name, _), time) in ways.iter().zip(&medians) {
        println!("  {name:40} {time:7.2} ns {:5.2}", time / by_hand);
    }
}

/// Columns of a batch without angles, points and outputs.
fn columns<M: Lanes>() -> Vec<Vec<M::Scalar>> {
    vec![vec![real(0.0); COUNT]; M::COORDINATES]
}

fn lanes<'a, M: Lanes + 'a, const W: usize>(name: &str, batch: Batch<'a, M>) -> Way<'a>
where
    M::Scalar: 'a,
{
    let (mut found, mut accepted) = (columns::<M>(), vec![false; COUNT]);
    way(name, move || {
        let asked = found.iter_mut().map(|column| Some(column.as_mut_slice()));
        let none = std::iter::repeat_with(|| None).take(M::FOUND.len() - M::COORDINATES);
        let mut list: Vec<_> = asked.chain(none).collect();
        let rejected = black_box(&batch).run_by::<W>(&mut list, &mut accepted).expect("columns of one length");
        assert_eq!(rejected, 0);
    })
}

/// The angles, a little more than a sixth of a radian.
fn angles<T: Real>() -> Vec<T> {
    (0..COUNT).map(|index| real(0.2 + 0.3 * index as f64 / COUNT as f64)).collect()
}

/// Runs code with the vector instructions of the machine.
fn vectorised(run: impl FnOnce()) {
    match Level::new().as_avx2() {
        Some(avx2) => avx2.vectorize(run),
        None => run(),
    }
}

macro_rules! compare {
    ($title:literal, $Mechanism:ident, $Inputs:ident, $branch:expr, $by_hand:expr) => {{
        let (m, branch) = (black_box($Mechanism::default()), $branch);
        let (wide, narrow) = (angles::<f64>(), angles::<f32>());
        let batch = |m, theta| $Mechanism::batch(m, $Inputs { theta }, branch, RATE.into(), ACCELERATION.into());
        let one_design = batch(m.clone(), wide.as_slice()).expect("columns of one length");
        let parameters: Vec<Vec<f64>> = <[f64; _]>::from(m.clone()).map(|number| vec![number; COUNT]).into();
        let each = $Mechanism::from(std::array::from_fn(|place| parameters[place].as_slice()));
        let (rate, acceleration) = (RATE.into(), ACCELERATION.into());
        let many_designs = $Mechanism::batch(each, $Inputs { theta: wide.as_slice() }, branch, rate, acceleration)
            .expect("columns of one length");
        let small = m.clone().map(|number| number as f32);
        let (rate, acceleration) = ((RATE as f32).into(), (ACCELERATION as f32).into());
        let single = $Mechanism::batch(small, $Inputs { theta: narrow.as_slice() }, branch, rate, acceleration)
            .expect("columns of one length");
        let given = Given { angles: &wide, rate: RATE, acceleration: ACCELERATION };
        let (by_hand, mut found) = ($by_hand, columns::<$Mechanism>());
        vectorised(
            #[inline(always)]
            || by_hand(&m, &given, &mut found),
        );
        for (place, &theta) in wide.iter().enumerate() {
            let (alone, theirs) = (one_design.lane(place).expect("a motion"), found.iter().map(|column| column[place]));
            for (ours, theirs) in alone.as_ref().iter().zip(theirs) {
                assert!((ours - theirs).abs() <= 1e-9 * ours.abs().max(1e-3), "{theta}: {ours}, by hand {theirs}");
            }
        }
        let mut ways = [
            lanes::<_, 4>("4 lanes", one_design),
            lanes::<_, 8>("8 lanes", one_design),
            lanes::<_, 16>("16 lanes", one_design),
            lanes::<_, 32>("32 lanes", one_design),
            lanes::<_, 8>("8 lanes, each its own design", many_designs),
            lanes::<_, 16>("16 lanes of f32", single),
            lanes::<_, 32>("32 lanes of f32", single),
            way("kinematics, one position after the other", || {
                for &theta in &wide {
                    black_box(&m.kinematics(black_box(theta), branch, RATE, ACCELERATION).expect("a motion"));
                }
            }),
            way("by hand, 8 lanes, no checks", || {
                vectorised(
                    #[inline(always)]
                    || by_hand(black_box(&m), &given, black_box(&mut found)),
                );
            }),
        ];
        table($title, &mut ways);
    }};
}

fn main() {
    compare!("Four-bar", FourBar, FourBarInputs, FourBarBranch::new(Elbow::Left), |m: &_, given: &_, found: &mut _| {
        by_hand::four_bar(m, given, 1.0, found)
    });
    let sides = [1.0, 1.0, -1.0, -1.0, -1.0];
    let branch = JansenBranch::new(Elbow::Left, Elbow::Left, Elbow::Right, Elbow::Right, Elbow::Left);
    compare!("Jansen leg", Jansen, JansenInputs, branch, |m: &_, given: &_, found: &mut _| by_hand::jansen(
        m, given, sides, found
    ));
    let branch = ChainBranch::all().last().expect("branches");
    compare!("Chain of 16 four-bars", Chain, ChainInputs, branch, |m: &Chain, given: &_, found: &mut _| {
        let lengths: [f64; 64] = m.clone().into();
        let lengths: &[[f64; 4]; 16] = lengths.as_chunks().0.try_into().expect("sixteen");
        by_hand::chain(lengths, given, -1.0, found)
    });
}
