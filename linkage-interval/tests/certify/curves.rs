//! Motions through dead points.

use linkage_interval::certify::{self, CertifyError};

use crate::loops::Loops;
use crate::shapes::{DOUBLE_BUTTERFLY, DoubleButterfly, FourBar, Jansen, MODES};

#[test]
fn a_four_bar_without_full_turn() {
    let four_bar = Loops::<FourBar, f64>::new([4.0, 3.0, 2.0, 2.5]);
    let start = Loops::<FourBar, f64>::at([0.5, 1.9], 0.5);
    let limit = ((9.0_f64 + 16.0 - 4.5 * 4.5) / 24.0).acos();
    println!("{:?} {limit}", certify::turn(&four_bar, &start).err());
    let curve = certify::curve(&four_bar, &start).unwrap();
    println!("{} {}", curve.boxes(), curve.tests());
    for point in curve.dead_points() {
        println!("{:?} {:?} {}", point.input, point.unknowns, point.is_largest);
    }
    println!("{:?}", curve.quantities());
}

#[test]
fn double_butterfly_all_eight() {
    let butterfly = Loops::<DoubleButterfly, f64>::new(DOUBLE_BUTTERFLY);
    for mode in MODES {
        let start = Loops::<DoubleButterfly, f64>::at(mode, 0.0);
        let time = std::time::Instant::now();
        match certify::turn(&butterfly, &start) {
            Ok(certificate) => println!("{} {} {:?} {:?}", certificate.boxes(), certificate.tests(), certificate.end(), time.elapsed()),
            Err(error) => println!("{error} {:?}", time.elapsed()),
        }
        let time = std::time::Instant::now();
        match certify::curve(&butterfly, &start) {
            Ok(curve) => {
                println!("  curve {} {} {:?} {} {:?}", curve.boxes(), curve.tests(), curve.turns(), curve.input_turns(), time.elapsed());
                for point in curve.dead_points() {
                    println!("  {:?} {}", point.input, point.is_largest);
                }
            }
            Err(error) => println!("{error} {:?}", time.elapsed()),
        }
    }
}

#[test]
fn jansen() {
    let jansen = Loops::<Jansen, f64>::new([38.0, 41.5, 39.3, 40.1, 55.8, 39.4, 36.7, 65.7, 49.0, 50.0, 61.9, 7.8, 15.0]);
    let start = Loops::<Jansen, f64>::at([1.22704, 2.46589, 2.73271, -2.7142, -1.28584, -2.31548, -1.16473, 2.64571, -1.32367, -1.90792], 0.0);
    let time = std::time::Instant::now();
    match certify::turn(&jansen, &start) {
        Ok(certificate) => println!("{} {} {:?} {:?} {:?}", certificate.boxes(), certificate.tests(), certificate.end(), time.elapsed(), certificate.start()),
        Err(error) => println!("{error} {:?}", time.elapsed()),
    }
}
