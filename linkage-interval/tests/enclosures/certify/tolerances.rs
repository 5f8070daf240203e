//! Parameters within tolerances.

use linkage_interval::certify::{self, Certificate, Certify, Enclosure};
use linkage_runtime::{Column, Dim};
use linkage_trials::count;

use crate::certify::loops::{Loops, Shape};
use crate::certify::random::{four_bar, six_bar};
use crate::certify::shapes::{FourBar, SixBar, SliderCrank};

/// The tolerance of the tests, relative to each length.
const TOLERANCE: f64 = 1e-3;

/// The largest width of the enclosures divided by that of the values at the corners of the box of the parameters.
const MOST: f64 = 1.2;

/// Certifies a turn for all lengths within the tolerance, and compares the smallest and largest values of the first
/// `quantities` with those at the corners: no corner is outside, and the enclosure is not much wider than all of them.
fn compare<S: Shape>(parameters: Column<f64, S::P>, start: Column<f64, S::U>, quantities: usize) {
    let nominal = Loops::<S, f64>::new(parameters);
    let start = Loops::<S, f64>::at(start, 0.7);
    let certificate = Certify::new(&nominal).tolerance(TOLERANCE).turn(&start).unwrap();
    assert!(certificate.is_closed());
    let of = |certificate: &Certificate<Loops<S, f64>>| -> Vec<Enclosure> {
        (0..quantities).filter_map(|place| certificate.quantity(place)).collect()
    };
    let found = of(&certificate);
    let mut corners = vec![[f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY]; quantities];
    for corner in 0_u32..1 << S::P::CAPACITY {
        let sign = |place: usize| if corner >> place & 1 == 1 { 1.0 } else { -1.0 };
        let at = Column::from_fn(|place| parameters[place] * (1.0 + sign(place) * TOLERANCE));
        let at_corner = certify::turn(&Loops::<S, f64>::new(at), &start).unwrap();
        for (range, one) in corners.iter_mut().zip(of(&at_corner)) {
            let [a, b, c, d] = *range;
            let (least, largest) = (one.least.middle(), one.largest.middle());
            *range = [a.min(least), b.max(least), c.min(largest), d.max(largest)];
        }
    }
    for ([a, b, c, d], all) in corners.iter().zip(&found) {
        let [least, largest] = [all.least.width() / (b - a), all.largest.width() / (d - c)];
        println!("least {least:.3}, largest {largest:.3} of the corners, {} evaluations", all.evaluations);
        assert!(
            all.least.contains(*a) && all.least.contains(*b) && all.largest.contains(*c) && all.largest.contains(*d)
        );
        assert!(least < MOST && largest < MOST);
    }
}

#[test]
fn four_bar_within_tolerances() {
    let lengths = [100.0, 40.0, 120.0, 80.0];
    let quantities = if count("CORNERS", 0, 1) > 0 { 3 } else { 1 };
    compare::<FourBar>(lengths.into(), four_bar(lengths, 1.0, 0.7).unwrap().into(), quantities);
}

#[test]
fn slider_crank_within_tolerances() {
    compare::<SliderCrank>([1.0, 3.0, 0.2].into(), [-0.2, 3.5].into(), 1);
}

/// The 1024 corners take a minute.
#[test]
fn six_bar_within_tolerances() {
    if count("CORNERS", 0, 1) == 0 {
        return;
    }
    let (first, second) = ([1.0, 0.25, 1.0, 0.8], [0.6, 0.3, 0.9, 0.8, 0.7, 0.4]);
    let lengths = [1.0, 0.25, 1.0, 0.8, 0.6, 0.3, 0.9, 0.8, 0.7, 0.4];
    compare::<SixBar>(lengths.into(), six_bar(first, second, 0.7).unwrap().into(), 2);
}
