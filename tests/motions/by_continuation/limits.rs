//! The limits of an input: the first dead point on either side.

use std::f64::consts::{PI, TAU};

use rand::SeedableRng;
use rand::rngs::SmallRng;

use linkage::limits::Limit;

use crate::by_continuation::continuation::{End as Outcome, Equations, Passed, Position};
use crate::by_continuation::count;
use crate::by_continuation::families::{Family, Slider, Stephenson, Watt, start};

/// The end of a branch on a motion.
#[derive(Debug)]
enum End {
    /// The input reverses.
    DeadPoint(f64),
    /// Motions cross within the step from this input: the motion goes on on another branch, and another motion on this one.
    ChangePoint(f64),
    /// There is none in a turn.
    None,
}

fn first_end(equations: &Equations, from: &Position, sign: f64) -> End {
    let (signs, mut last, mut end) = (equations.signs(from), *from, End::None);
    let outcome = equations.follow(from, sign, |passed| {
        match passed {
            Passed::DeadPoint(at) if equations.regularity(&at) > 1e-3 => end = End::DeadPoint(at[0]),
            Passed::DeadPoint(_) => end = End::ChangePoint(last[0]),
            Passed::Step(at) if equations.signs(&at) != signs => end = End::ChangePoint(last[0]),
            Passed::Step(at) => last = at,
            Passed::Start(_) => return true,
        }
        !matches!(end, End::None)
    });
    // At a change point where the input reverses, too, the steps end.
    let is_stuck = outcome != Outcome::Closed && matches!(end, End::None) && equations.regularity(&last) < 1e-2;
    if is_stuck { End::ChangePoint(last[0]) } else { end }
}

/// The comparisons, those in which the motion leaves the branch, those that disagree, and errors.
#[derive(Debug, Default)]
struct Counts {
    all: usize,
    crossed: usize,
    wrong: usize,
    errors: usize,
}

impl Counts {
    fn add<M: Family>(&mut self, m: &M, input: f64) {
        let Ok(modes) = m.all_positions(M::Inputs::from([input].into())) else {
            self.errors += 1;
            return;
        };
        let modes: Vec<_> = modes.collect();
        let equations = m.equations();
        for (branch, q) in modes {
            // A motion may consist of singular positions.
            let from = M::position(&q);
            if equations.regularity(&from) < 1e-6 {
                continue;
            }
            let limits = match m.limits_at(&q, branch) {
                Ok(limits) => limits,
                Err(error) => {
                    println!("{input} {m:?} {q:?}: {error}");
                    self.errors += 1;
                    continue;
                }
            };
            for (limit, sign) in [(limits.lower, -1.0), (limits.upper, 1.0)] {
                self.all += 1;
                let expected = first_end(&equations, &from, sign);
                // How far a limit lies beyond an input.
                let beyond = |end: f64| limit.input().map_or(f64::INFINITY, |found| (found - end) * sign);
                let is_right = match expected {
                    End::DeadPoint(end) if (end - input).abs() < TAU => beyond(end).abs() < 1e-7,
                    End::ChangePoint(end) if (end - input).abs() < TAU => {
                        self.crossed += 1;
                        beyond(end) > -1e-7
                    }
                    _ => limit == Limit::Unlimited,
                };
                if !is_right {
                    println!("{input} {m:?} {q:?}: {limit:?}, by steps {expected:?}");
                    self.wrong += 1;
                }
            }
        }
    }
}

fn compare<M: Family>(seed: u64) -> [usize; 2] {
    let random = &mut SmallRng::seed_from_u64(seed);
    let mut counts = Counts::default();
    for number in 0..count() {
        let (m, input) = (M::random(random, number % 2 == 1), start(random));
        counts.add(&m, input);
    }
    println!("{} {counts:?}", M::NAME);
    [counts.wrong, counts.errors]
}

#[test]
fn limits_of_random_linkages() {
    for found in [compare::<Stephenson>(4), compare::<Watt>(5), compare::<Slider>(6)] {
        assert_eq!(found, [0; 2]);
    }
}

/// Newton's method fails a degree away, at v = -0.5958, in the middle of the motion; its limit was computed independently.
#[test]
fn a_motion_by_newton_goes_on() {
    let [a, b, c, d] = [1.0566932436125949, 0.8910333918817807, 2.2085551982431575, 2.7034759670747053];
    let [px, py, e, f]: [f64; 4] = [-2.4091713001660704, -2.3939305376697324, 3.011039616197003, 3.0998559765894207];
    let m = Stephenson { a, b, c, d, px, py, e, f, x: -2.8697686637750834, y: 2.496530644839991 };
    let modes = m.branches(-0.5342388007183341).unwrap().map(|mode| (mode.branch, mode.pose.coordinates()));
    let (branch, q) = modes.into_iter().find(|(_, q)| f64::abs(q.t - 1.2170849726) < 1e-8).unwrap();
    let lower = m.limits(&q, branch).unwrap().lower;
    let input = lower.input().unwrap();
    assert!(f64::abs(input + 2.5877263718) < 1e-9, "{lower:?}");
}

/// Motions that touch within one group by Newton's method go on; where a link is longer or shorter by a little, they go on
/// apart, or turn back before a gap whose width is the fourth root of the difference.
#[test]
fn touches_and_gaps_within_a_group() {
    let touching = [
        ([1.0, 1.5, 1.5, 1.0, 2.5, 0.5, 2.5, 1.5, 2.5, 0.5], 3.578459920132878),
        ([3.5, 2.0, 3.5, 2.0, 0.5, -1.0, 3.0, 1.0, 2.0, -1.0], 3.60137734563229),
        ([4.5, 3.0, 5.0, 3.5, 2.5, -1.0, 4.0, 4.5, -2.0, -0.5], 5.143345347380866),
    ];
    let (differences, least): (&[f64], _) =
        if linkage_trials::is_outer() { (&[0.0, 1e-4, 1e-6, 1e-8], 200) } else { (&[0.0, 1e-6], 100) };
    let mut counts = Counts::default();
    for (lengths, input) in touching {
        for &difference in differences {
            for sign in [1.0, -1.0] {
                let [a, b, c, d, px, py, e, f, x, y] = lengths;
                let d = d + sign * difference;
                counts.add(&Stephenson { a, b, c, d, px, py, e, f, x, y }, input);
            }
        }
    }
    println!("{counts:?}");
    assert!(counts.all > least && counts.crossed < counts.all / 2, "{counts:?}");
    assert_eq!([counts.wrong, counts.errors], [0; 2]);
}

/// A gap between two motions that turn into each other: both have the same limit, at a distance from the middle that is
/// proportional to the fourth root of the difference from a touch.
#[test]
fn motions_that_nearly_touch_turn_back() {
    for difference in [1e-6, 1e-10, 1e-12, 1e-13] {
        let [a, b, c, d, px, py, e, f, x, y] = [4.5, 3.0, 5.0, 3.5 + difference, 2.5, -1.0, 4.0, 4.5, -2.0, -0.5];
        let m = Stephenson { a, b, c, d, px, py, e, f, x, y };
        let modes = m.branches(5.143345347380866).unwrap().map(|mode| (mode.branch, mode.pose.coordinates()));
        let lower = modes.filter(|(_, q)| f64::abs(q.t) > 3.1).map(|(branch, q)| m.limits(&q, branch).unwrap().lower);
        let inputs: Vec<f64> = lower.filter_map(|lower| lower.input()).collect();
        let ratios: Vec<f64> = inputs.iter().map(|input| (input - 1.5 * PI) / difference.powf(0.25)).collect();
        println!("{difference:e} {inputs:?} {ratios:?}");
        assert!(ratios.len() == 2 && ratios.iter().all(|ratio| (ratio - 3.086).abs() < 0.06), "{ratios:?}");
        assert!((inputs[0] - inputs[1]).abs() < 1e-6, "{inputs:?}");
    }
}
