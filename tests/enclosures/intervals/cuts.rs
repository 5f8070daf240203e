//! Functions with cuts and poles inside a box: angles of vectors that meet the negative x axis, and tangents.

use std::f64::consts::{PI, TAU};

use linkage::certify::{self, CertifyError};
use linkage::linkage;

linkage! {
    /// An equation that jumps by 4 pi where P passes the negative x axis.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Wheel {
        param r = 1, h = 0.9999, w = 3;
        input t;
        unknown x;
        let P = (-w, h) + r@t;
        equation x = 2 * angle(P);
        derive intervals;
    }

    /// Outputs of a crank-rocker that jump: a direction, and a tangent at its pole.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Crank {
        param a = 40, b = 120, c = 80, d = 100;
        input t;
        unknown p, q;
        loop a@t + b@p = d@0 + c@q;
        output dir = angle(a@t + (30, 10)@p);
        output slope = tan(q);
        output level = angle(b@p);
        derive intervals;
    }
}

/// The only solution of the equation at t = 3 pi / 2 is -2 pi.
#[test]
fn a_jump_of_an_equation_closes_no_motion() {
    let m = Wheel::default();
    let x = 2.0 * (0.9999 + 0.3_f64.sin()).atan2(-3.0 + 0.3_f64.cos());
    let Err(error) = certify::turn(&m, &WheelCoordinates { t: 0.3, x }) else { panic!("it jumps") };
    let CertifyError::NoBounds { group: "x", input, .. } = error else { panic!("{error}") };
    assert!(input.least() > 4.6 && input.most() < 4.8, "{error}");
    // Above the axis it closes.
    let m = Wheel { h: 1.0001, ..m };
    let x = 2.0 * (1.0001 + 0.3_f64.sin()).atan2(-3.0 + 0.3_f64.cos());
    assert!(certify::turn(&m, &WheelCoordinates { t: 0.3, x }).is_ok());
}

#[test]
fn outputs_that_jump_have_both_sides() {
    let m = Crank::default();
    let start = m.branches(0.7).unwrap().next().unwrap();
    let found = certify::turn(&m, &start.pose.coordinates()).unwrap().quantities();
    // In the order of the outputs.
    let [dir, slope, level] = found.as_slice() else { panic!("{found:?}") };
    for step in 0..20_000 {
        let values = m.outputs(&m.assemble(TAU * f64::from(step) / 2e4, start.branch).unwrap()).unwrap();
        for (enclosure, value) in [dir, slope, level].into_iter().zip([values.dir, values.slope, values.level]) {
            assert!(enclosure.least.least() <= value && value <= enclosure.largest.most(), "{enclosure:?} {value}");
        }
    }
    assert!(!dir.is_sharp && !slope.is_sharp && level.is_sharp, "{found:?}");
    assert!(dir.largest.most() <= PI.next_up() && dir.least.least() >= (-PI).next_down());
}
