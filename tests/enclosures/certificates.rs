//! Certified motions of emitted mechanisms. `linkage-interval/tests/enclosures/certify` has more, of loops written by hand.

use std::f64::consts::TAU;

use linkage::certify::{self, Certify, CertifyError, End};
use linkage::circuits::Circuits;
use linkage::limits::Limit;
use linkage::{Branches, Certifiable, Column, D, Interval, Mechanism, linkage, position};

use linkage_gallery::cam_rocker::*;
use linkage_gallery::double_butterfly::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::jansen::*;
use linkage_gallery::klann::*;
use linkage_gallery::norton_four_bar::*;
use linkage_gallery::six_bar::*;
use linkage_gallery::stephenson_ii::*;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// All positions at an input.
fn positions<M: Branches<Scalar = f64, V = D<1>>>(m: &M, input: f64) -> Vec<M::Coordinates> {
    let inputs = M::Inputs::from(Column::from([input]));
    m.all_positions(inputs).unwrap().map(|(_, position)| position).collect()
}

/// The certificate of a turn that closes contains the positions of the list and the values of all quantities on the
/// way.
fn turns<M>(m: &M, input: f64, most_boxes: usize)
where
    M: Certifiable + Branches<Scalar = f64, V = D<1>>,
{
    for start in positions(m, input) {
        let certificate = certify::turn(m, &start).unwrap();
        let boxes = certificate.boxes();
        assert!(certificate.is_closed() && boxes <= most_boxes, "{} {boxes}", M::NAME);
        for step in 1..12 {
            let here = input + TAU * f64::from(step) / 12.0;
            let found = certificate.unknowns_at(here.into()).unwrap();
            assert!(found.iter().all(|x| x.width() < 1e-10 * (1.0 + x.magnitude())), "{} {found:?}", M::NAME);
            let is_inside = |position: &M::Coordinates| {
                M::unknowns(position).iter().zip(&found).zip(M::UNKNOWN_ANGLES).all(|((x, found), is_angle)| {
                    let turns = if *is_angle { ((found.middle() - x) / TAU).round() } else { 0.0 };
                    // The listed position has rounding errors of its own.
                    (x + TAU * turns - found.middle()).abs() <= 1e-11 * (1.0 + x.abs())
                })
            };
            assert_eq!(
                positions(m, here).iter().filter(|position| is_inside(position)).count(),
                1,
                "{} {here}",
                M::NAME
            );
        }
    }
}

#[test]
fn full_turns_of_the_gallery() {
    turns(&FourBar::default(), 0.35, 14);
    turns(&NortonFourBar::default(), 0.7, 20);
    turns(&SixBar::default(), 0.3, 40);
}

/// Cascades of five and of three dyads.
#[test]
fn walking_legs() {
    let leg = Jansen::default();
    let angles = [1.227, 2.466, 2.733, -2.714, -1.286, -2.315, -1.165, 2.646, -1.324, -1.908];
    let start = position::newton(&leg, &Jansen::coordinates(angles.into(), [0.0].into())).unwrap().coordinates;
    let certificate = certify::turn(&leg, &start).unwrap();
    assert!(certificate.is_closed() && certificate.boxes() <= 34, "{}", certificate.boxes());
    let leg = Klann::default();
    let closes = |start: &KlannCoordinates| certify::turn(&leg, start).is_ok_and(|certificate| certificate.is_closed());
    assert!(positions(&leg, 0.0).iter().any(closes));
}

/// With the crank in line with the ground the distance of the outer joints is d - a or d + a, and there the transmission
/// angle is extreme: cos mu = (b^2 + c^2 - distance^2) / (2 b c) (Norton, "Design of Machinery", 4.10).
#[test]
fn extreme_transmission_angles() {
    let m = NortonFourBar::default();
    let start = positions(&m, 0.7)[0];
    let enclosures = certify::turn(&m, &start).unwrap().quantities();
    let mu = NortonFourBar::<f64>::QUANTITIES.iter().position(|name| *name == "mu").unwrap();
    let at = |distance: f64| ((m.b * m.b + m.c * m.c - distance * distance) / (2.0 * m.b * m.c)).acos();
    let mut expected = [at(m.d - m.a), at(m.d + m.a)];
    if enclosures[mu].least.most() < 0.0 {
        expected = expected.map(|angle| -angle);
    }
    expected.sort_by(f64::total_cmp);
    assert!(enclosures[mu].is_sharp);
    for (found, expected) in [enclosures[mu].least, enclosures[mu].largest].into_iter().zip(expected) {
        assert!(found.width() <= 2e-9 * expected.abs(), "{found:?}");
        assert!((found.middle() - expected).abs() <= 2e-9 * expected.abs(), "{found:?} {expected}");
    }
}

/// All motions through the positions at an input.
fn certified<M>(m: &M, input: f64) -> Vec<(usize, usize, i64)>
where
    M: Certifiable + Branches<Scalar = f64, V = D<1>>,
{
    let circuits = Circuits::of(m, input, Default::default()).unwrap();
    let certified = Certify::new(m).circuits(&circuits).into_iter();
    certified
        .map(|curve| {
            let curve = curve.unwrap();
            (curve.boxes(), curve.dead_points().len(), curve.input_turns())
        })
        .collect()
}

#[test]
fn circuits_of_the_double_butterfly() {
    let found = certified(&DoubleButterfly::default(), 0.0);
    println!("{found:?}");
    assert_eq!(found.iter().filter(|(_, dead_points, turns)| *dead_points == 0 && *turns == 1).count(), 5);
    assert!(found.iter().any(|(_, dead_points, _)| *dead_points >= 2));
}

#[test]
fn circuits_of_stephensons_chain() {
    let found = certified(&StephensonII::default(), 0.4);
    println!("{found:?}");
    assert!(!found.is_empty());
}

linkage! {
    /// Its dimensions are those of a triad in `tests/motions/circuits` with a full turn that ends on another mode.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Triad {
        param a = 4.9, b = 1.23, c = 4.18, d = 1.52, px = 0.83, py = -2.31, e = 4.26, f = 2.25, fx = 2.04, fy = 1.17;
        input theta;
        unknown alpha, beta, gamma, epsilon;
        loop a@alpha + b@beta = d@0 + c@gamma;
        loop a@alpha + (px, py)@beta + e@epsilon = (fx, fy) + f@theta;
        derive intervals;
    }
}

#[test]
fn a_regular_turn_that_ends_on_another_mode() {
    let m = Triad::default();
    let all = positions(&m, 0.0);
    let ends: Vec<_> = all
        .iter()
        .filter_map(|start| Some(Certify::new(&m).positions(all.iter().copied()).turn(start).ok()?.end().clone()))
        .collect();
    assert!(ends.iter().any(|end| matches!(end, End::Arrives { .. })), "{ends:?}");
}

#[test]
fn user_functions_have_no_certificate() {
    let m = CamRocker::default();
    let start = positions(&m, 0.3)[0];
    match certify::turn(&m, &start).err() {
        Some(CertifyError::UserFunction { group: "psi", function: "turn", .. }) => {}
        other => panic!("{other:?}"),
    }
}

linkage! {
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Bars {
        param a = 1, b = 1, c = 1, d = 1;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = d@0 + c@psi;
        derive limits, intervals;
    }
}

/// The dead points of the certified curve are the emitted limits of the input; without limits the crank turns.
#[test]
fn limits_of_random_four_bars() {
    let mut random = SmallRng::seed_from_u64(11);
    let count = linkage_trials::count("CERTIFICATES", 16, 40);
    let (mut cranks, mut rockers) = (0, 0);
    while cranks + rockers < count {
        let [a, b, c, d] = std::array::from_fn(|_| random.random_range(1.0..10.0));
        let m = Bars { a, b, c, d };
        let input = random.random_range(-3.0..3.0);
        let Some((branch, start)) = m.all_positions(input.into()).unwrap().next() else { continue };
        let limits = m.limits(input, branch).unwrap();
        let curve = match certify::curve(&m, &start) {
            Ok(curve) => curve,
            Err(error) => panic!("{m:?} {input} {error}"),
        };
        let near = |limit: f64| {
            curve.dead_points().iter().any(|point| {
                let turns = ((point.input.middle() - limit) / TAU).round();
                let error = (point.input.middle() - limit - TAU * turns).abs();
                error <= 1e-12 * (1.0 + limit.abs()) + 2.0 * point.input.width()
            })
        };
        match [limits.lower, limits.upper] {
            [Limit::Exact { input: lower, .. }, Limit::Exact { input: upper, .. }] => {
                rockers += 1;
                assert!(near(lower) && near(upper), "{m:?} {limits:?}");
            }
            _ => {
                cranks += 1;
                assert!(curve.dead_points().is_empty() && curve.input_turns().abs() == 1, "{m:?}");
            }
        }
    }
    assert!(cranks > count / 20 && rockers > count / 20, "{cranks} {rockers}");
}

#[test]
fn tolerances_of_all_lengths() {
    let m = NortonFourBar::default();
    let start = positions(&m, 0.7)[0];
    let lengths = m.parameters().map(|length| Interval::around(length, 1e-3 * length).unwrap());
    let certificate = Certify::new(&m).parameters(lengths).turn(&start).unwrap();
    assert!(certificate.is_closed());
    let mu = NortonFourBar::<f64>::QUANTITIES.iter().position(|name| *name == "mu").unwrap();
    let found = certificate.quantities()[mu];
    // The corners of the tolerances.
    let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
    for corner in 0..16 {
        let side = |bit: usize| if corner >> bit & 1 == 1 { 1.001 } else { 0.999 };
        let m = NortonFourBar { a: m.a * side(0), b: m.b * side(1), c: m.c * side(2), d: m.d * side(3) };
        let own = certify::turn(&m, &start).unwrap().quantities()[mu];
        (least, largest) = (least.min(own.least.middle()), largest.max(own.largest.middle()));
    }
    let all = [found.least.least(), found.largest.most()];
    assert!(all[0] <= least && largest <= all[1], "{all:?} {least} {largest}");
    assert!(all[1] - all[0] <= 1.2 * (largest - least), "{all:?} {least} {largest}");
}
