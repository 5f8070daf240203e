//! Mechanisms followed along their motion.

use std::f64::consts::{PI, TAU};

use linkage::continuation::{AtChangePoint, Direction, Event, Options, Path};
use linkage::{Error, Mechanism, linkage};

include!("mechanisms/freudenstein_roth.rs");
include!("mechanisms/coupled_wheels.rs");
include!("mechanisms/four_bar.rs");

/// Limit points of Freudenstein and Roth's equations: `continuation_freudenstein_roth.rs` has the source.
#[test]
fn limit_points_of_freudenstein_and_roth() {
    let m = FoldsOfX3::default();
    let start = FreudensteinRothCoordinates { x1: 15.0, x2: -2.0, x3: 0.0 };
    let mut path = Path::new(&m, &start, Direction::Increasing).unwrap();
    for _ in 0..400 {
        let step = path.advance_watching(|_, rates| rates.x1).unwrap();
        println!("{:?} {:?} {:?}", step.length, step.position, step.event);
        if step.position.x3 > 1.0 && step.position.x2 > 3.0 {
            break;
        }
    }
}

#[test]
fn parallelogram() {
    let m = CoupledWheels::default();
    let start = CoupledWheelsCoordinates { theta: 0.4, rod: 0.0, follower: 0.4 };
    let mut path = Path::new(&m, &start, Direction::Increasing).unwrap();
    for _ in 0..60 {
        let step = path.advance().unwrap();
        println!("{:?} {:?} {:?}", step.length, step.position, step.event);
    }
    for k in 0..30 {
        let step = path.advance_to(PI * f64::from(k) / 4.0).unwrap();
        println!("{:?} {:?} {:?}", step.length, step.position, step.event);
    }
}
