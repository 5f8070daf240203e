//! Smallest and largest values over a motion.

use linkage_interval::certify;

use crate::loops::Loops;
use crate::shapes::FourBar;

/// The transmission angle of a four-bar is extreme where the crank is in line with the ground:
/// cos mu = (b^2 + c^2 - (d -+ a)^2) / (2 b c).
#[test]
fn transmission_angle_of_nortons_four_bar() {
    let [ground, crank, coupler, rocker] = [100.0, 40.0, 120.0, 80.0];
    let four_bar = Loops::<FourBar, f64>::new([ground, crank, coupler, rocker]);
    let certificate = certify::turn(&four_bar, &Loops::<FourBar, f64>::at([0.35, 1.0], 0.7)).unwrap();
    let time = std::time::Instant::now();
    let found = certificate.quantities();
    println!("{found:?} {:?}", time.elapsed());
    println!("{:?} {:?}", certificate.velocity_ratios(), time.elapsed());
    println!("{:?} {:?}", certificate.quantity_ratios(), time.elapsed());
    let angle = |distance: f64| {
        let [b, c]: [f64; 2] = [coupler, rocker];
        ((b * b + c * c - distance * distance) / (2.0 * b * c)).acos()
    };
    println!("{} {}", angle(ground - crank), angle(ground + crank));
}
