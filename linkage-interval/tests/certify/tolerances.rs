//! Parameters within tolerances.

use linkage_interval::Interval;
use linkage_interval::certify::{self, Certify};
use linkage_runtime::{Column, Dim};

use crate::loops::{Loops, Shape};
use crate::shapes::{FourBar, SliderCrank};

/// The smallest and largest value over a turn of each quantity, over all corners of the box of the parameters, and the
/// enclosures for the box.
fn compare<S: Shape>(parameters: Column<f64, S::P>, start: (Column<f64, S::U>, f64), relative: f64) {
    let nominal = Loops::<S, f64>::new(parameters);
    let start = (start.0, [start.1].into());
    let all = parameters.map(|value| Interval::around(value, value * relative).unwrap());
    let certificate = Certify::new(&nominal).parameters(all).turn(&start).unwrap();
    println!("{} {} {:?}", certificate.boxes(), certificate.tests(), certificate.end());
    let time = std::time::Instant::now();
    let found = certificate.quantities();
    println!("{found:?} {:?}", time.elapsed());
    let mut corners = vec![[f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY]; S::Q::COUNT];
    for corner in 0_u32..1 << S::P::COUNT {
        let sign = |place: usize| if corner >> place & 1 == 1 { 1.0 } else { -1.0 };
        let at = Column::from_fn(|place| parameters[place] * (1.0 + sign(place) * relative));
        let certificate = certify::turn(&Loops::<S, f64>::new(at), &start).unwrap();
        for (range, one) in corners.iter_mut().zip(certificate.quantities().iter()) {
            let [a, b, c, d] = *range;
            let (least, largest) = (one.least.middle(), one.largest.middle());
            *range = [a.min(least), b.max(least), c.min(largest), d.max(largest)];
        }
    }
    for ([a, b, c, d], all) in corners.iter().zip(found.iter()) {
        println!("{} {}", all.least.width() / (b - a), all.largest.width() / (d - c));
    }
}

#[test]
fn four_bar() {
    compare::<FourBar>([100.0, 40.0, 120.0, 80.0].into(), ([0.35, 1.0].into(), 0.7), 1e-3);
}

#[test]
fn slider_crank() {
    compare::<SliderCrank>([1.0, 3.0, 0.2].into(), ([-0.2, 3.5].into(), 0.7), 1e-3);
}
