//! Random contacts: every motion that is found satisfies all laws, and errors are confirmed by an independent search.

use super::search::{Kind, Laws};
use super::{Equations, solved};
use linkage_dynamics::contact::{ReducedBearing, ReducedContact, ReducedEquations, ReducedReaction};
use linkage_dynamics::{ContactLaw, Mode, MotionError};
use linkage_runtime::nalgebra::{SMatrix, SVector};
use linkage_runtime::{Column, D, Matrix};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// Frictions by the reactions of pins and guides, given frictions and stops, at rest and moving.
fn random<const V: usize, const C: usize>(random: &mut SmallRng) -> Equations<V, C> {
    let mut root = SMatrix::<f64, V, V>::from_fn(|_, _| random.random_range(-0.5..0.5));
    (0..V).for_each(|i| root[(i, i)] += 1.5);
    let mass = root * root.transpose();
    let forces = SVector::<f64, V>::from_fn(|_, _| random.random_range(-3.0..3.0));
    // The friction of most problems is moderate; in some Painleve's paradox is likely.
    let most = if random.random_range(0..3) == 0 { 1.5 } else { 0.25 };
    let names = ["first", "second", "third", "fourth", "fifth"];
    let mut rows: Vec<SVector<f64, V>> = vec![];
    for place in 0..C {
        let row = if place > 0 && random.random_range(0..6) == 0 {
            rows[random.random_range(0..place)] * random.random_range(-2.0..2.0)
        } else {
            SVector::from_fn(|_, _| random.random_range(-1.5..1.5))
        };
        rows.push(row);
    }
    let contacts = Column::from_fn(|place| {
        let rate = f64::from(random.random_range(-1..2_i32) * random.random_range(0..2_i32));
        let (law, drift) = match random.random_range(0..6) {
            0 => (ContactLaw::Friction { limit: random.random_range(0.0..1.5) }, rate),
            1 => (ContactLaw::Stop { lower: 0.0, upper: 1.0, restitution: 0.0 }, 0.0),
            _ => (ContactLaw::Bearing { factor: random.random_range(0.0..most) }, rate),
        };
        let value = [0.0, 1.0, 0.5][random.random_range(0..3)];
        ReducedContact { name: names[place], value, row: rows[place].into(), drift, bias: 0.0, law }
    });
    let bearings = contacts.map(|contact| {
        let ContactLaw::Bearing { .. } = contact.law else { return None };
        let is_guide = random.random_range(0..2) == 0;
        let mut row = || ReducedReaction {
            constant: random.random_range(-4.0..4.0),
            accelerations: Column::from_fn(|_| random.random_range(-1.0..1.0)),
            contacts: Column::from_fn(|_| random.random_range(-1.0..1.0)),
        };
        Some(ReducedBearing { components: [row(), if is_guide { ReducedReaction::zero((D, D)) } else { row() }] })
    });
    ReducedEquations {
        scene: "Random",
        coordinates: Column::repeat("z"),
        mass: Matrix::from(mass),
        forces: forces.into(),
        rates: Column::zeros(),
        contacts,
        bearings,
    }
}

/// The numbers of outcomes.
#[derive(Debug, Default)]
struct Outcomes {
    motions: usize,
    unique: usize,
    redundant: usize,
    none: usize,
    several: usize,
    undecided: usize,
    confirmed_none: usize,
    confirmed_several: usize,
    searched_none: usize,
    searched_several: usize,
    impossible: usize,
}

impl Outcomes {
    fn add<const V: usize, const C: usize>(&mut self, equations: &Equations<V, C>, seed: u64) {
        let Some(laws) = Laws::new(equations) else { return };
        let pins = laws.kinds.iter().filter(|kind| matches!(kind, Kind::Bearing(..))).count();
        let angles = if pins <= 1 { 64 } else { 24 };
        let is_small = pins <= 2;
        match solved(equations) {
            Ok((contacts, motion)) => {
                self.motions += 1;
                self.redundant += usize::from(!motion.are_unique);
                check(equations, &laws, &contacts.modes, (&motion.acceleration, &motion.forces), seed);
                if is_small && seed.is_multiple_of(4) {
                    let goes = laws.along_all(motion.forces.as_slice());
                    for other in laws.motions(angles, 1e-9) {
                        let scale = |place: usize| laws.scale(place, motion.forces.as_slice());
                        let equal = (0..C).all(|at| (other[at] - goes[at]).abs() <= 1e-6 * scale(at));
                        assert!(equal, "{seed}: {other:?} and {goes:?} of {equations:#?}");
                    }
                    self.unique += 1;
                }
            }
            Err(MotionError::NoMotion { contact, .. }) => {
                self.none += 1;
                assert!(laws.names.contains(&contact));
                if is_small {
                    self.searched_none += 1;
                    let found = laws.motions(angles, 1e-10);
                    assert!(found.is_empty(), "{seed}: {found:?} of {equations:#?}");
                    self.confirmed_none += 1;
                }
            }
            Err(MotionError::SeveralMotions { contact, .. }) => {
                self.several += 1;
                assert!(laws.names.contains(&contact));
                if is_small {
                    self.searched_several += 1;
                    self.confirmed_several += usize::from(laws.motions(angles, 1e-9).len() > 1);
                }
            }
            Err(MotionError::UndecidedMotion { .. }) => self.undecided += 1,
            Err(MotionError::NoContactForces { .. }) => self.impossible += 1,
            Err(error) => panic!("{seed}: {error}"),
        }
    }
}

/// Checks M z'' = Q + S' f, each law, and that each mode is that of its contact.
fn check<const V: usize, const C: usize>(
    equations: &Equations<V, C>,
    laws: &Laws,
    modes: &Column<Mode, linkage_runtime::D<C>>,
    (acceleration, forces): (&Column<f64, linkage_runtime::D<V>>, &Column<f64, linkage_runtime::D<C>>),
    seed: u64,
) {
    let mut left = equations.mass * *acceleration - equations.forces;
    let mut size = equations.forces.largest() + (equations.mass.abs() * acceleration.abs()).largest();
    for (contact, &force) in equations.contacts.iter().zip(forces) {
        left -= contact.row * force;
        size += (contact.row * force).largest();
    }
    assert!(left.largest() <= 1e-11 * size, "{seed}: {left:?} of {equations:#?}");
    let violation = laws.violation(forces.as_slice());
    assert!(violation <= 1e-9, "{seed}: {violation:e} {modes:?} {forces:?} of {equations:#?}");
    let most = forces.largest();
    for (place, contact) in equations.contacts.iter().enumerate() {
        // R from its definition.
        let limit = match (contact.law, &equations.bearings[place]) {
            (ContactLaw::Bearing { factor }, Some(ReducedBearing { components })) => {
                let [x, y] =
                    components.map(|row| row.constant + row.accelerations.dot(acceleration) + row.contacts.dot(forces));
                factor * x.hypot(y)
            }
            (ContactLaw::Friction { limit }, _) => limit,
            _ => f64::INFINITY,
        };
        let (goes, force) = (contact.row.dot(acceleration), forces[place]);
        let stands = goes.abs() <= 1e-9 * laws.scale(place, forces.as_slice());
        let slack = 1e-9 * most.max(if limit.is_finite() { limit } else { 0.0 });
        let fits = match modes[place] {
            Mode::Stick => contact.drift == 0.0 && stands && force.abs() <= limit + slack,
            Mode::SlipForward => (force + limit).abs() <= slack && contact.drift >= 0.0,
            Mode::SlipBackward => (force - limit).abs() <= slack && contact.drift <= 0.0,
            Mode::AtLower => contact.value == 0.0 && stands && force >= -slack,
            Mode::AtUpper => contact.value == 1.0 && stands && force <= slack,
            Mode::Open => force == 0.0,
        };
        assert!(fits, "{seed}: {place} {:?} {goes} {force} {limit} of {equations:#?}", modes[place]);
    }
}

/// `TRIALS` sets the number of problems of each of the twelve sizes.
#[test]
fn every_motion_satisfies_every_law() {
    let trials: u64 = linkage_trials::count("TRIALS", 20, if cfg!(debug_assertions) { 20 } else { 1000 });
    let mut outcomes = Outcomes::default();
    for seed in 0..trials {
        let source = &mut SmallRng::seed_from_u64(seed);
        outcomes.add(&random::<1, 1>(source), seed);
        outcomes.add(&random::<1, 2>(source), seed);
        outcomes.add(&random::<1, 3>(source), seed);
        outcomes.add(&random::<2, 1>(source), seed);
        outcomes.add(&random::<2, 2>(source), seed);
        outcomes.add(&random::<2, 3>(source), seed);
        outcomes.add(&random::<2, 4>(source), seed);
        outcomes.add(&random::<2, 5>(source), seed);
        outcomes.add(&random::<3, 2>(source), seed);
        outcomes.add(&random::<3, 3>(source), seed);
        outcomes.add(&random::<3, 4>(source), seed);
        outcomes.add(&random::<3, 5>(source), seed);
    }
    println!("{outcomes:#?}");
    let all = 12 * trials as usize;
    assert!(outcomes.motions > all / 2 && outcomes.none > 0 && outcomes.several > 0, "{outcomes:?}");
    assert!(outcomes.undecided * 25 <= all, "{outcomes:?}");
    assert!(outcomes.confirmed_several * 100 >= outcomes.searched_several * 95, "{outcomes:?}");
}
