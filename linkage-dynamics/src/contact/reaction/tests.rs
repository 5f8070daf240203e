//! Slipping forces and forces of redundant contacts, in problems with known forces.

use super::admissible::{Existence, HeldForces, quadratic};
use super::budget::Budget;
use super::family::Family;
use super::problem::Problem;
use super::search::Cell;
use super::slip::{Roots, Slips};
use crate::contact::{ReducedBearing, ReducedContact, ReducedEquations, ReducedReaction};
use crate::{ContactLaw, Mode};
use linkage_runtime::{Column, D, Matrix};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// A vector of this length in any direction.
fn vector(random: &mut SmallRng, length: f64) -> [f64; 2] {
    let (sine, cosine) = random.random_range(0.0..core::f64::consts::TAU).sin_cos();
    [length * cosine, length * sine]
}

/// Two pins that slip, and two solutions t: at both the reactions R have |R| = t / c in any direction, so that
/// p_1 (t_1 - t_1') = R - R' - p_2 (t_2 - t_2') and r = R - p t.
fn pins(random: &mut SmallRng) -> (Slips<f64, D<2>>, [Column<f64, D<2>>; 2]) {
    let t: [Column<f64, D<2>>; 2] = [0, 1].map(|_| Column::from_fn(|_| random.random_range(0.1..2.0)));
    let mut slips = Slips::none(D);
    slips.count = 2;
    for row in 0..2 {
        slips.factors[row] = random.random_range(0.2..1.5);
        let [one, other] = t.map(|t| vector(random, t[row] / slips.factors[row]));
        let second = vector(random, 1.0);
        let change = t[0] - t[1];
        let first = [0, 1].map(|k| (one[k] - other[k] - second[k] * change[1]) / change[0]);
        slips.by[row] = [first, second].into();
        slips.base[row] = [0, 1].map(|k| one[k] - first[k] * t[0][0] - second[k] * t[0][1]);
    }
    (slips, t)
}

/// The greatest error of t = c |r + P t|, relative to its terms.
fn error(slips: &Slips<f64, D<2>>, t: &Column<f64, D<2>>) -> f64 {
    (0..2).fold(0.0, |most: f64, row| {
        let [x, y] = [0, 1].map(|k| slips.base[row][k] + slips.by[row][0][k] * t[0] + slips.by[row][1][k] * t[1]);
        let size = [0, 1]
            .map(|k| slips.base[row][k].abs() + slips.by[row][0][k].abs() * t[0] + slips.by[row][1][k].abs() * t[1]);
        most.max((t[row] - slips.factors[row] * x.hypot(y)).abs() / (t[row] + slips.factors[row] * (size[0] + size[1])))
    })
}

/// True if t was found: solutions closer to each other than 1.5e-8 count as one.
fn contains(roots: &Roots<f64, D<2>>, t: &Column<f64, D<2>>) -> bool {
    roots.as_slice().iter().any(|root| (*root - *t).largest() <= 1e-6 * t.largest())
}

#[test]
fn both_solutions_of_two_pins_are_found() {
    let mut incomplete = 0;
    for seed in 0..200 {
        let (slips, planted) = pins(&mut SmallRng::seed_from_u64(seed));
        let roots = slips.solve(&mut Budget::new());
        for root in roots.as_slice() {
            assert!(error(&slips, root) <= 1e-11, "{seed}: {:e}", error(&slips, root));
        }
        let are_found = planted.iter().all(|t| contains(&roots, t));
        assert!(are_found || !roots.is_complete, "{seed}: {planted:?} of {:?}", roots.as_slice());
        incomplete += usize::from(!roots.is_complete);
    }
    // The search gives up about one in twenty.
    assert!(incomplete <= 20, "{incomplete}");
}

/// In homogeneous coordinates, of which s or a t is 1: s and t at a solution.
fn on_face(t: &Column<f64, D<2>>, fixed: Option<usize>) -> (f64, Column<f64, D<2>>) {
    let scale = fixed.map_or(1.0, |at| t[at].recip());
    (scale, *t * scale)
}

/// Cells near a solution: what decides one is a solution in it, enlarged by a quarter, and not one beyond it.
#[test]
fn a_cell_is_decided_by_its_own_solution() {
    let (mut decided, mut beyond) = (0, 0);
    for seed in 0..2000 {
        let random = &mut SmallRng::seed_from_u64(seed);
        let (slips, [planted, _]) = pins(random);
        let fixed = [None, Some(0), Some(1)][random.random_range(0..3)];
        let (scale, t) = on_face(&planted, fixed);
        let size = 10.0_f64.powf(random.random_range(-3.0..-0.5));
        let mut near = |at: Option<usize>, value: f64| {
            let radius = if fixed == at { 0.0 } else { size * random.random_range(0.5..1.0) };
            [value + radius * random.random_range(-2.0..2.0), radius]
        };
        let own_scale = near(None, scale);
        let own = Column::<_, D<2>>::from_fn(|at| near(Some(at), t[at]));
        let cell = Cell { scale: own_scale, centre: own.map(|of| of[0]), radius: own.map(|of| of[1]) };
        let mut roots = Roots::none(D);
        if !slips.is_decided(&cell, fixed, 1.0, &mut roots) {
            continue;
        }
        // Solutions are accurate to 1e-9.
        let is_in = |root: &Column<f64, D<2>>, share: f64| {
            let (scale, t) = on_face(root, fixed);
            let is_near = |[centre, radius]: [f64; 2], value: f64| (value - centre).abs() <= share * radius + 1e-9;
            is_near(cell.scale, scale) && (0..2).all(|at| is_near(own[at], t[at]))
        };
        decided += usize::from(!roots.as_slice().is_empty());
        beyond += usize::from(!is_in(&planted, 1.0));
        assert!(roots.as_slice().iter().all(|root| is_in(root, 1.25)), "{seed}: {:?} of {cell:?}", roots.as_slice());
        assert!(!is_in(&planted, 1.0) || contains(&roots, &planted), "{seed}: {planted:?} of {cell:?}");
    }
    assert!(decided > 100 && beyond > 100, "{decided} {beyond}");
}

/// The places where a force f + f' y meets its limit |r + r' y|: at two given y, or where it touches it.
#[test]
fn a_force_meets_its_limit_at_the_roots() {
    for seed in 0..1000 {
        let random = &mut SmallRng::seed_from_u64(seed);
        let force: [f64; 2] = [0, 1].map(|_| random.random_range(-2.0..2.0));
        let at = |y: f64| force[0] + force[1] * y;
        let [one, other] = [0, 1].map(|_| random.random_range(-3.0..3.0));
        let check = |[start, end]: [[f64; 2]; 2]| {
            let slope = [0, 1].map(|k| (end[k] - start[k]) / (other - one));
            let found = quadratic(force, [0, 1].map(|k| start[k] - slope[k] * one), slope);
            for y in [one, other] {
                assert!(is_root(&found, y), "{seed}: {y} of {found:?}");
            }
        };
        check([vector(random, at(one)), vector(random, at(other))]);
        // A guide.
        check([[at(one), 0.0], [-at(other), 0.0]]);
        // The reaction is the force, turned, and a part across it that is zero at one y.
        let [x, y] = vector(random, 1.0);
        let across = random.random_range(0.5..2.0);
        let turned = |along: f64, across: f64| [along * x - across * y, along * y + across * x];
        let found = quadratic(force, turned(force[0], -across * one), turned(force[1], across));
        assert!(is_root(&found, one), "{seed}: {one} of {found:?}");
    }
}

/// True if a root is this y. Two equal roots are accurate to half of the digits only.
fn is_root(found: &[Option<f64>], y: f64) -> bool {
    found.iter().flatten().any(|root| (root - y).abs() <= 64.0 * f64::EPSILON.sqrt() * (1.0 + y.abs()))
}

type Equations = ReducedEquations<f64, D<1>, D<3>>;
type Forces = Column<f64, D<3>>;

/// A mass of 1 that three frictions hold, two of them redundant, and forces with which it stands. Each is this share of
/// its limit. The limits of the first frictions are given, the others depend on the reactions of pins and guides.
fn stuck(random: &mut SmallRng, givens: usize, shares: [f64; 3]) -> (Equations, Forces) {
    let forces = Forces::from_fn(|_| random.random_range(-2.0..2.0));
    let rows = Forces::from_fn(|_| random.random_range(-1.5..1.5));
    let mut bearings = Column::repeat(None);
    let contacts = Column::from_fn(|place| {
        let limit = forces[place].abs() / shares[place];
        let law = if place < givens {
            ContactLaw::Friction { limit }
        } else {
            let is_guide = random.random_range(0..3) == 0;
            let mut row = || ReducedReaction {
                constant: random.random_range(-2.0..2.0),
                accelerations: [random.random_range(-1.0..1.0)].into(),
                contacts: Column::from_fn(|_| random.random_range(-4.0..4.0)),
            };
            let components = [row(), if is_guide { ReducedReaction::zero((D, D)) } else { row() }];
            bearings[place] = Some(ReducedBearing { components });
            ContactLaw::Bearing { factor: limit / at_rest(&components, &forces) }
        };
        let name = ["first", "second", "third"][place];
        ReducedContact { name, value: 0.0, row: [rows[place]].into(), drift: 0.0, bias: 0.0, law }
    });
    let equations = ReducedEquations {
        scene: "Stuck",
        coordinates: ["z"].into(),
        mass: Matrix::identity(),
        forces: [-rows.dot(&forces)].into(),
        rates: Column::zeros(),
        contacts,
        bearings,
    };
    (equations, forces)
}

/// |R| without accelerations.
fn at_rest(components: &[ReducedReaction<f64, D<1>, D<3>>; 2], forces: &Forces) -> f64 {
    let [x, y] = components.map(|row| row.constant + row.contacts.dot(forces));
    x.hypot(y)
}

/// True if the mass stands and each force is within its limit. Sums may be off by 1e-12 of their terms: that is about four
/// times the 1024 ulps that a held force may be off by.
fn hold(equations: &Equations, forces: &Forces) -> bool {
    let rows = equations.contacts.map(|contact| contact.row[0]);
    let terms = rows.component_mul(forces);
    let rounding = 1e-12 * terms.abs().sum();
    let is_within = |place: usize| {
        let (limit, size) = match (equations.contacts[place].law, &equations.bearings[place]) {
            (ContactLaw::Bearing { factor }, Some(ReducedBearing { components })) => {
                let sizes = components.map(|row| row.constant.abs() + row.contacts.abs().dot(&forces.abs()));
                (factor * at_rest(components, forces), factor * (sizes[0] + sizes[1]))
            }
            (ContactLaw::Friction { limit }, _) => (limit, limit),
            _ => (0.0, 0.0),
        };
        forces[place].abs() <= limit + 1e-12 * size + rounding / rows[place].abs()
    };
    (terms.sum() + equations.forces[0]).abs() <= rounding && (0..3).all(is_within)
}

/// Runs `test` on the search for held forces and on their family.
fn with_family<R>(
    equations: &Equations,
    test: impl FnOnce(&HeldForces<'_, f64, D<1>, D<3>, &'static str>, &Family<f64, D<3>>) -> R,
) -> R {
    let modes = Column::repeat(Mode::Stick);
    let problem = Problem::new(equations).unwrap();
    let held = HeldForces { problem: &problem, modes: &modes, is_bounded: Column::repeat(true) };
    test(&held, &Family::new(&problem, &modes))
}

/// True if forces of a grid hold, which is narrow near zero and wide far away.
fn some_hold(equations: &Equations) -> bool {
    let rows = equations.contacts.map(|contact| contact.row[0]);
    let grid = (-60..=60).map(|k| (f64::from(k) / 12.0).sinh());
    grid.clone().any(|first| {
        grid.clone().any(|second| {
            let third = -(equations.forces[0] + rows[0] * first + rows[1] * second) / rows[2];
            hold(equations, &[first, second, third].into())
        })
    })
}

/// The known forces hold the mass if none exceeds its limit; in a third of the problems some may.
#[test]
fn redundant_forces_are_found_or_excluded() {
    let (mut excluded, mut undecided) = (0, 0);
    for seed in 0..900 {
        let random = &mut SmallRng::seed_from_u64(seed);
        let most = if seed % 3 == 0 { 3.0 } else { 0.98 };
        let (givens, shares) = (random.random_range(0..3), [0, 1, 2].map(|_| random.random_range(0.5..most)));
        let (equations, known) = stuck(random, givens, shares);
        let is_held = shares.iter().all(|share| *share < 1.0);
        match with_family(&equations, |held, family| held.admissible(family, &mut Budget::new())) {
            Existence::Found(forces) => assert!(hold(&equations, &forces), "{seed}: {forces:?} of {equations:#?}"),
            _ if is_held => panic!("{seed}: {known:?} of {equations:#?}"),
            Existence::Excluded => {
                assert!(!some_hold(&equations), "{seed}: {equations:#?}");
                excluded += 1;
            }
            Existence::Undecided => undecided += 1,
        }
    }
    assert!(excluded > 50 && undecided * 50 <= excluded, "{excluded} {undecided}");
}

/// Given frictions hold a load up to the sum of their limits.
#[test]
fn edges_of_given_limits_have_forces_up_to_their_sum() {
    for seed in 0..1000 {
        let random = &mut SmallRng::seed_from_u64(seed);
        let (mut equations, _) = stuck(random, 3, [1.0; 3]);
        let sum = equations.contacts.iter().fold(0.0, |sum, contact| match contact.law {
            ContactLaw::Friction { limit } => sum + contact.row[0].abs() * limit,
            _ => sum,
        });
        for share in [0.1, 0.5, 0.9, 1.0 - 1e-6, 1.0 + 1e-6, 2.0] {
            equations.forces = [sum * share].into();
            let found = with_family(&equations, |held, family| held.on_edges(family));
            assert_eq!(found.is_some(), share < 1.0, "{seed} {share}");
            assert!(found.is_none_or(|forces| hold(&equations, &forces)), "{seed} {share}: {found:?}");
        }
    }
}

/// Each force can be set to a level, and the mass still stands.
#[test]
fn a_family_has_members_with_a_given_force() {
    for seed in 0..1000 {
        let random = &mut SmallRng::seed_from_u64(seed);
        let (equations, _) = stuck(random, 3, [1.0; 3]);
        with_family(&equations, |_, family| {
            assert_eq!(family.spares, 2);
            for place in 0..3 {
                let level = random.random_range(-3.0..3.0);
                let slopes = family.columns.map(|column| column[place]);
                let fixed = family.fixed(family.base[place] - level, &slopes).unwrap();
                assert_eq!(fixed.spares, 1);
                let forces = fixed.at(&[random.random_range(-3.0..3.0), 0.0, 0.0].into());
                let terms = equations.contacts.map(|contact| contact.row[0]).component_mul(&forces);
                assert!((forces[place] - level).abs() <= 1e-13 * forces.largest(), "{seed}: {level} of {forces:?}");
                assert!((terms.sum() + equations.forces[0]).abs() <= 1e-13 * terms.abs().sum(), "{seed}: {forces:?}");
            }
            assert!(family.fixed(1.0, &Column::zeros()).is_none());
        });
    }
}
