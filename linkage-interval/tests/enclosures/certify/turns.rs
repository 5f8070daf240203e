//! Full turns and ranges of the input.

use std::f64::consts::{PI, TAU};

use linkage_interval::Interval;
use linkage_interval::certify::{self, Certificate, Certify, CertifyError, End};
use linkage_trials::count;

use crate::certify::loops::{Loops, Shape, exactly};
use crate::certify::random::{Random, four_bar, is_angle_in};
use crate::certify::shapes::{FourBar, HalfSpeed, Jansen, SliderCrank};

/// The position with its rocker above, or below.
fn start(lengths: [f64; 4], side: f64, input: f64) -> <Loops<FourBar, f64> as linkage_runtime::Mechanism>::Coordinates {
    Loops::<FourBar, f64>::at(four_bar(lengths, side, input).unwrap(), input)
}

fn turn(lengths: [f64; 4], input: f64) -> Result<Certificate<Loops<FourBar, f64>>, CertifyError> {
    certify::turn(&Loops::new(lengths), &start(lengths, 1.0, input))
}

/// Each figure is the one measured: more boxes would show that the tubes became wider.
#[test]
fn boxes_of_four_bars_of_the_literature() {
    for (lengths, input, boxes) in [([80.0, 20.0, 50.0, 70.0], 0.35, 13), ([100.0, 40.0, 120.0, 80.0], 0.7, 18)] {
        let certificate = turn(lengths, input).unwrap();
        assert_eq!(certificate.end(), &End::Closed { turns: vec![0, 0] });
        assert!(certificate.boxes() <= boxes, "{}", certificate.boxes());
        assert!(certificate.tests() < 2 * boxes);
    }
}

/// The two motions of a flat parallelogram are apart by about the root of e.
#[test]
fn parallelograms_near_their_change_point() {
    for (e, boxes) in [(1e-1, 19), (1e-2, 29), (1e-4, 52), (1e-6, 74)] {
        let certificate = turn([3.0, 1.0, 3.0, 1.0 + e], 0.5).unwrap();
        assert!(certificate.is_closed());
        assert!(certificate.boxes() <= boxes, "{e} {}", certificate.boxes());
    }
}

#[test]
fn a_parallelogram_has_no_certificate_at_its_change_point() {
    match turn([3.0, 1.0, 3.0, 1.0], 0.5) {
        Err(CertifyError::Singular { input, group: "phi, psi", .. }) => {
            assert!((input.middle() - PI).abs() < 1e-6, "{input:?}");
        }
        other => panic!("{:?}", other.err()),
    }
}

#[test]
fn jansens_leg() {
    let lengths = [38.0, 41.5, 39.3, 40.1, 55.8, 39.4, 36.7, 65.7, 49.0, 50.0, 61.9, 7.8, 15.0];
    let angles = [1.22704, 2.46589, 2.73271, -2.7142, -1.28584, -2.31548, -1.16473, 2.64571, -1.32367, -1.90792];
    let certificate =
        certify::turn(&Loops::<Jansen, f64>::new(lengths), &Loops::<Jansen, f64>::at(angles, 0.0)).unwrap();
    assert!(certificate.is_closed());
    assert!(certificate.boxes() <= 32);
    // The leg is a cascade of dyads: angles of b, c and then of d at a crank angle of 1 by the law of cosines.
    let pin = [15.0 * 1_f64.cos() + 38.0, 15.0 * 1_f64.sin() + 7.8];
    let found = certificate.unknowns_at(exactly(1.0)).unwrap();
    let b = crate::certify::random::dyad(pin, 41.5, 50.0, 1.0).unwrap()[0];
    let c = crate::certify::random::dyad(pin, 39.3, 61.9, -1.0).unwrap()[0];
    let d = b + ((41.5_f64 * 41.5 + 40.1 * 40.1 - 55.8 * 55.8) / (2.0 * 41.5 * 40.1)).acos();
    for (place, exact) in [(0, b), (4, c), (2, d)] {
        assert!(is_angle_in(exact, found[place], 1e-12), "{place} {exact} {:?}", found[place]);
    }
}

/// The link turns half as fast as the crank: after a turn it is at its other position.
#[test]
fn a_turn_arrives_at_another_position() {
    let mechanism = Loops::<HalfSpeed, f64>::new([2.0]);
    let [here, there] = [0.3, 0.3 + PI].map(|angle| Loops::<HalfSpeed, f64>::at([angle, 2.0], 0.6));
    assert_eq!(certify::turn(&mechanism, &here).unwrap().end(), &End::Open);
    let turn = Certify::new(&mechanism).positions([here, there]);
    assert_eq!(turn.turn(&here).unwrap().end(), &End::Arrives { position: 1, turns: vec![0, 0] });
    assert_eq!(turn.turn(&there).unwrap().end(), &End::Arrives { position: 0, turns: vec![1, 0] });
    assert_eq!(turn.turns(2).turn(&here).unwrap().end(), &End::Closed { turns: vec![1, 0] });
}

#[test]
fn a_range_in_both_directions() {
    let lengths = [100.0, 40.0, 120.0, 80.0];
    let mechanism = Loops::<FourBar, f64>::new(lengths);
    for to in [2.5, -2.5] {
        let certificate = certify::range(&mechanism, &start(lengths, -1.0, 0.3), to).unwrap();
        assert_eq!(certificate.inputs(), exactly(0.3).hull(exactly(to)));
        assert!(certificate.unknowns_at(exactly(1.1 * to)).is_none());
        let exact = four_bar(lengths, -1.0, to).unwrap();
        let found = certificate.unknowns_at(exactly(to)).unwrap();
        assert!(exact.iter().zip(&found).all(|(&angle, &found)| is_angle_in(angle, found, 1e-14)));
        assert!(found.iter().all(|angle| angle.width() < 1e-13));
    }
}

/// No position in closed form is outside the tubes, and none of the tubes is much wider than the motion in it.
#[test]
fn sampled_positions_are_in_the_tubes() {
    let mut random = Random(3);
    let lengths = [100.0, 40.0, 120.0, 80.0];
    let certificate = turn(lengths, 0.7).unwrap();
    let tubes: Vec<_> = certificate.tubes().collect();
    let quantities = certificate.quantities();
    for _ in 0..count("POSES", 400, 2000) {
        let input = random.between(0.7, 0.7 + TAU);
        let exact = four_bar(lengths, 1.0, input).unwrap();
        let within = |(range, angles): &&(Interval, _)| {
            let _: &linkage_runtime::Column<Interval, _> = angles;
            range.contains(input)
        };
        let (range, angles) = tubes.iter().find(within).unwrap();
        assert!(exact.iter().zip(angles).all(|(&angle, &found)| is_angle_in(angle, found, 1e-12)));
        assert!(angles.iter().all(|angle| angle.width() < 2.0 * range.width()));
        let [phi, psi] = exact;
        let pin = [40.0 * input.cos() + 120.0 * phi.cos(), 40.0 * input.sin() + 120.0 * phi.sin()];
        for (value, found) in pin.into_iter().zip(&quantities) {
            assert!(found.least.least() - 1e-12 <= value && value <= found.largest.most() + 1e-12);
        }
        assert!(is_angle_in(phi - psi, quantities[2].values(), 1e-12));
    }
}

/// Angles have equal digits in every unit of length, and lengths are multiples.
#[test]
fn certificates_do_not_depend_on_the_unit_of_length() {
    let in_unit = |unit: f64| {
        let mechanism = Loops::<SliderCrank, f64>::new([1.0, 3.0, 0.25].map(|length| length * unit));
        let certificate = certify::turn(&mechanism, &Loops::<SliderCrank, f64>::at([-0.2, 3.5 * unit], 0.7)).unwrap();
        let of_tube = |(input, unknowns): (Interval, linkage_runtime::Column<Interval, <SliderCrank as Shape>::U>)| {
            let [angle, length] = [unknowns[0], unknowns[1]];
            let bounds = [input, angle].map(|x| [x.least(), x.most()]);
            [bounds[0], bounds[1], [length.least() / unit, length.most() / unit]]
        };
        certificate.tubes().map(of_tube).collect::<Vec<_>>()
    };
    let one = in_unit(1.0);
    for exponent in [-40, 300] {
        assert_eq!(in_unit(2_f64.powi(exponent)), one);
    }
}
