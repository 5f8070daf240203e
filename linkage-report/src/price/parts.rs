//! The functions that a step of a simulation calls, timed.

use std::hint::black_box;

use linkage_dynamics::{Scene, StateColumn};
use linkage_runtime::{Dim, Mechanism};

use super::timing::{Time, Timed, in_turn};

/// The cost of a function of the scene.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PartPrice {
    /// The function.
    pub name: String,
    /// The time of a call; its ratio is to `derivative`.
    pub time: Option<Time>,
}

/// The number of states at which functions are timed.
const TIMED: usize = 32;

/// A function with its name.
type Call<'a> = (&'static str, Box<dyn Fn() + 'a>);

/// The functions that a step calls.
pub(super) fn parts<S: Scene<Scalar = f64>>(
    scene: &S,
    times: &[f64],
    states: &[StateColumn<S>],
    (rounds, span): (usize, f64),
) -> Vec<PartPrice> {
    let every = states.len().div_ceil(TIMED).max(1);
    let at: Vec<(f64, &StateColumn<S>)> = times.iter().copied().zip(states).step_by(every).collect();
    let at = &at;
    // The rates are those of the state, as a simulation has them.
    let with_rates: Vec<_> = at
        .iter()
        .filter_map(|(t, y)| {
            let derivative = scene.derivative(*t, y).ok()?;
            Some((*t, scene.parts_of(y).q, S::rate_parts(&derivative).rates))
        })
        .collect();
    let with_rates = &with_rates;
    let mut works: Vec<Call<'_>> = vec![(
        "derivative: position, M, Q and accelerations",
        Box::new(move || {
            for (t, y) in at {
                let _ = black_box(scene.derivative(*t, black_box(y)));
            }
        }),
    )];
    works.push((
        "pose: sines and cosines",
        Box::new(move || {
            for (_, y) in at {
                black_box(scene.mechanism().pose_at(&scene.parts_of(black_box(y)).q));
            }
        }),
    ));
    works.push((
        "project: onto the constraints, once a step",
        Box::new(move || {
            for (_, y) in at {
                let _ = black_box(scene.project(black_box(y)));
            }
        }),
    ));
    if scene.contact_count().count() > 0 {
        works.push((
            "contacts: laws of frictions and stops",
            Box::new(move || {
                for (t, q, rates) in with_rates {
                    let _ = black_box(scene.contacts(*t, black_box(q), rates));
                }
            }),
        ));
    }
    if scene.has_bearings() {
        works.push((
            "bearings: forces in joints with friction",
            Box::new(move || {
                for (t, q, rates) in with_rates {
                    let _ = black_box(scene.bearings(*t, black_box(q), rates));
                }
            }),
        ));
    }
    let evaluations = at.len();
    let timed = works.iter().map(|(_, pass)| Timed { pass: &**pass, evaluations, base: 0 });
    let times = in_turn(&timed.collect::<Vec<_>>(), rounds, span);
    let parts = works.iter().zip(times).map(|((name, _), time)| PartPrice { name: (*name).to_owned(), time });
    parts.collect()
}
