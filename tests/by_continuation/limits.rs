//! The limits of an input: the first dead point on either side.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand::rngs::SmallRng;

use crate::continuation::Passed;
use crate::count;
use crate::families::{Family, Slider, Stephenson, Watt, start};

fn compare<M: Family>(seed: u64) -> [usize; 2] {
    let random = &mut SmallRng::seed_from_u64(seed);
    let [mut all, mut crossed, mut wrong, mut errors] = [0; 4];
    for number in 0..count() {
        let (m, input) = (M::random(random, number % 2 == 1), start(random));
        let Ok(modes) = m.all_positions(M::Inputs::from([input].into())) else {
            errors += 1;
            continue;
        };
        let modes: Vec<_> = modes.collect();
        let equations = m.equations();
        for (branch, q) in modes {
            // A motion may consist of singular positions.
            if equations.regularity(&M::position(&q)) < 1e-6 {
                continue;
            }
            let limits = match m.limits_at(&q, branch) {
                Ok(limits) => limits,
                Err(error) => {
                    println!("{number} {input} {m:?} {q:?}: {error}");
                    errors += 1;
                    continue;
                }
            };
            for (limit, sign) in [(limits.lower, -1.0), (limits.upper, 1.0)] {
                all += 1;
                let mut expected = None;
                let from = M::position(&q);
                equations.follow(&from, sign, |passed| match passed {
                    Passed::DeadPoint(at) => {
                        expected = Some(at[0]);
                        true
                    }
                    Passed::Start(_) => true,
                    Passed::Step(_) => false,
                });
                let expected = expected.filter(|end| (end - input).abs() < TAU);
                let is_right = match (limit.input(), expected) {
                    (Some(found), Some(expected)) => (found - expected).abs() < 1e-7,
                    (None, None) => true,
                    _ => false,
                };
                if is_right {
                    continue;
                }
                // At a change point a branch leaves the motion.
                let mut least = f64::INFINITY;
                equations.follow(&from, sign, |passed| {
                    if let Passed::Step(at) = passed {
                        least = equations.regularity(&at).min(least);
                    }
                    matches!(passed, Passed::DeadPoint(_) | Passed::Start(_))
                });
                if number % 2 == 1 && least < 0.05 {
                    crossed += 1;
                    continue;
                }
                println!("{number} {input} {m:?} {q:?}: {limit:?}, by steps {expected:?}");
                wrong += 1;
            }
        }
    }
    println!("{} {all} limits, {crossed} beyond a change point, {wrong} wrong, {errors} errors", M::NAME);
    [wrong, errors]
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
