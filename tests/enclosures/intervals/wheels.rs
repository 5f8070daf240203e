//! Wheels: their angles turn together, and motions close after full turns of all of them.

use std::f64::consts::TAU;

use linkage::certify::{self, Certify, CertifyError, End};
use linkage::{Column, linkage};

linkage! {
    /// A slider-crank with a cam on its crankshaft, a wheel of half its speed in the other sense, and a fast one.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Shaft {
        param r = 1, l = 3;
        input theta;
        unknown phi, x, cam, half, fast;
        loop r@theta + l@phi = x@0;
        equation cam = theta;
        equation half = -theta / 2;
        equation fast = 12 * cam - half;
        point Mark = 1@cam + 1@half + 1@fast;
        derive intervals;
    }

    /// A pair of wheels with teeth, and the planet between a sun and an arm on their shafts.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Train {
        param r = 1, l = 3, z1 = 20, z2 = 30;
        input theta;
        unknown phi, x, arm, planet;
        loop r@theta + l@phi = x@0;
        equation z1 * theta + z2 * arm = 0;
        equation (z1 + z2) * arm = z1 * theta + z2 * planet;
        point Mark = 1@arm + 1@planet;
        derive intervals;
    }

    /// A belt over two wheels of one radius, and a rack.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Belt {
        param r = 1, l = 3;
        input theta;
        unknown phi, x, wheel;
        loop r@theta + l@phi = x@0;
        equation r * theta = r * wheel;
        point Mark = 1@wheel;
        derive intervals;
    }

    #[derive(Debug, Clone, PartialEq)]
    mechanism Rack {
        param r = 1;
        input theta;
        unknown x;
        equation x = r * theta;
        point Mark = x@0 + 1@theta;
        derive intervals;
    }

    /// A pair of wheels alone: no sine or vector says that they are angles.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Gears {
        param z1 = 20, z2 = 30;
        input w;
        unknown a;
        equation z1 * w + z2 * a = 0;
        output sum = w + a;
        derive intervals;
    }

    /// A rocker that turns its crank and a cam.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Treadle {
        param a = 40, b = 120, c = 80, d = 100;
        input psi;
        unknown crank, p, cam;
        loop a@crank + b@p = d@0 + c@psi;
        equation cam = 2 * crank;
        point Mark = 1@cam;
        derive intervals;
    }
}

fn shaft(theta: f64) -> ShaftCoordinates {
    let phi = (-theta.sin() / 3.0).asin();
    let x = theta.cos() + 3.0 * phi.cos();
    ShaftCoordinates { theta, phi, x, cam: theta, half: -0.5 * theta, fast: 12.5 * theta }
}

fn train(m: &Train, theta: f64) -> TrainCoordinates {
    let ShaftCoordinates { phi, x, .. } = shaft(theta);
    let arm = -m.z1 / m.z2 * theta;
    TrainCoordinates { theta, phi, x, arm, planet: ((m.z1 + m.z2) * arm - m.z1 * theta) / m.z2 }
}

/// After one turn the wheel of half the speed is at its other side.
#[test]
fn wheels_close_after_turns_of_all_together() {
    let m = Shaft::default();
    let certificate = certify::turn(&m, &shaft(0.3)).unwrap();
    assert_eq!(certificate.end(), &End::Open);
    let certificate = Certify::new(&m).turns(2).turn(&shaft(0.3)).unwrap();
    assert_eq!(certificate.end(), &End::Closed { turns: vec![0, 0, 2, -1, 25] });
    let curve = certify::curve(&m, &shaft(0.3)).unwrap();
    assert_eq!((curve.turns(), curve.input_turns()), ([0, 0, 2, -1, 25].as_slice(), 2));
    assert!(curve.passes(&shaft(0.3 - TAU)) && curve.passes(&shaft(1.3 + 2.0 * TAU)));
}

/// With 20 and 30 teeth the arm turns -2 / 3 of a turn, the planet (50 (-2 / 3) - 20) / 30 = -16 / 9 of one.
#[test]
fn ratios_of_parameters_close_by_their_values() {
    let m = Train::default();
    let end = |m: &Train, turns| Certify::new(m).turns(turns).turn(&train(m, 0.3)).unwrap().end().clone();
    for turns in [1, 3, 8] {
        assert_eq!(end(&m, turns), End::Open);
    }
    assert_eq!(end(&m, 9), End::Closed { turns: vec![0, 0, -6, -16] });
    let curve = certify::curve(&m, &train(&m, 0.3)).unwrap();
    assert_eq!((curve.turns(), curve.input_turns()), ([0, 0, -6, -16].as_slice(), 9));
    // Another unit changes exponents only.
    let scaled = Train { z1: 20.0 * 2_f64.powi(-400), z2: 30.0 * 2_f64.powi(-400), ..m };
    assert_eq!(end(&scaled, 9), End::Closed { turns: vec![0, 0, -6, -16] });
    // The doubles 0.1 and 0.3 are not as 1 to 3: 0.3 / 0.1 is 3 (1 - 2^-53 / 0.9).
    let decimal = Train { z1: 0.1, z2: 0.3, ..m };
    assert_eq!(end(&decimal, 9), End::Open);
    let error = Certify::new(&decimal).most_tests(200).curve(&train(&decimal, 0.3)).err();
    assert!(matches!(error, Some(CertifyError::Exhausted { .. })), "{error:?}");
    // Of all the ratios within tolerances hardly any closes.
    let all = Certify::new(&m).tolerance(1e-9).turns(9).turn(&train(&m, 0.3)).unwrap();
    assert_eq!(all.end(), &End::Open);
}

#[test]
fn a_ratio_that_no_tolerance_changes_closes() {
    let m = Belt::default();
    let ShaftCoordinates { phi, x, .. } = shaft(0.3);
    let start = BeltCoordinates { theta: 0.3, phi, x, wheel: 0.3 };
    let certificate = Certify::new(&m).tolerance(1e-4).turn(&start).unwrap();
    assert_eq!(certificate.end(), &End::Closed { turns: vec![0, 0, 1] });
}

/// The message of a turn that an input cannot have speaks of no number.
#[test]
fn an_input_that_is_no_angle_has_no_turn() {
    let (m, start) = (Gears::default(), GearsCoordinates { w: 0.3, a: -0.2 });
    let error = certify::turn(&m, &start).err().unwrap();
    assert_eq!(error, CertifyError::NoTurn { mechanism: "Gears" });
    assert!(certify::range(&m, &start, 0.3 + TAU).is_ok());
}

#[test]
fn a_rack_goes_on() {
    let m = Rack::default();
    let start = RackCoordinates { theta: 0.3, x: 0.3 };
    assert_eq!(certify::turn(&m, &start).unwrap().end(), &End::Open);
    assert!(matches!(
        Certify::new(&m).most_tests(100).curve(&start).err(),
        Some(CertifyError::Exhausted { boxes: 100, .. })
    ));
}

/// The motion turns back at two dead points of its input, while the crank turns once and its cam twice.
#[test]
fn a_cam_behind_dead_points() {
    let m = Treadle::default();
    let start = m.branches(1.8).unwrap().next().unwrap().pose.coordinates();
    let curve = certify::curve(&m, &start).unwrap();
    let sense = curve.turns()[0];
    assert_eq!((curve.turns(), curve.input_turns()), ([sense, 0, 2 * sense].as_slice(), 0));
    assert_eq!((sense.abs(), curve.dead_points().len()), (1, 2));
}

#[test]
fn psi_repeats_after_the_vectors_of_a_lattice() {
    let m = Train::default();
    let repeats = |m: &Train, [phi, x, arm, planet, theta]: [i64; 5]| {
        Certify::new(m).repeats(&Column::from([phi, x, arm, planet]), &Column::from([theta]))
    };
    for multiple in -3..4 {
        assert!(repeats(&m, [multiple, 0, -6 * multiple, -16 * multiple, 9 * multiple]));
    }
    for wrong in [[0, 0, -2, -5, 3], [0, 0, -6, -15, 9], [0, 0, 0, 0, 1], [0, 0, 1, 0, 0], [0, 1, 0, 0, 0]] {
        assert!(!repeats(&m, wrong), "{wrong:?}");
    }
    let m = Train { z1: 1.0, z2: 1.0, ..m };
    assert!(repeats(&m, [0, 0, -1, -3, 1]));
}

/// Rounding errors grow with an angle: 100 turns are 628 rad.
#[test]
fn many_turns() {
    let m = Train { z1: 7.0, z2: 100.0, ..Train::default() };
    let certificate = Certify::new(&m).turns(100).turn(&train(&m, 0.3)).unwrap();
    // arm -7 / 100, planet (107 (-7 / 100) - 7) / 100 = -0.1449 of a turn each.
    assert_eq!(certificate.end(), &End::Open);
    let inputs = certificate.inputs();
    assert!((inputs.width() - 100.0 * TAU).abs() < 1e-12 * inputs.width());
    let boxes = certificate.boxes();
    assert!(boxes < 700, "{boxes}");
}

/// Sines of angles beyond 1e5 rad have no bounds. No group is singular there.
#[test]
fn a_search_that_ends_names_no_singular_group() {
    let m = Shaft::default();
    let error = certify::range(&m, &shaft(1e5 - 1.0), 1e5 + 1.0).err();
    let Some(CertifyError::Undecided { mechanism: "Shaft", input }) = error else { panic!("{error:?}") };
    assert!((input.middle() - 1e5).abs() < 0.1, "{input:?}");
    assert_eq!(
        CertifyError::Undecided { mechanism: "Shaft", input: 1e5.into() }.to_string(),
        "the motion of Shaft cannot be certified between the inputs 100000.0 and 100000.0, though no group is nearly \
         singular there: the bounds are too wide, as next to a pole or for angles beyond 1e5 rad"
    );
}
