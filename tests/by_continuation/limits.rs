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
